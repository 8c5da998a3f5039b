#include "core/cfc_filter.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast {
namespace {

constexpr double samples_a_class = 10;
constexpr double lead_in = 4; // times 1 / CFC: what the start of a pass leaves has died by e^-36

struct TwoPoles {
  double a0, b1, b2;

  TwoPoles(double interval, int cfc) {
    const double wd = 2 * std::numbers::pi * cfc * 2.0775, wa = std::tan(0.5 * wd * interval);
    const double q = 1 + std::numbers::sqrt2 * wa + wa * wa;
    a0 = wa * wa / q;
    b1 = -2 * (wa * wa - 1) / q;
    b2 = (-1 + std::numbers::sqrt2 * wa - wa * wa) / q;
  }

  /// Once over the samples, in place, from rest at the first of them.
  template <class Iterator> void pass(Iterator begin, Iterator end) const {
    double x1 = *begin, x2 = x1, y1 = x1, y2 = x1;
    for (Iterator at = begin; at != end; ++at) {
      const double x = *at, y = a0 * (x + 2 * x1 + x2) + b1 * y1 + b2 * y2;
      x2 = x1;
      x1 = x;
      y2 = y1;
      y1 = y;
      *at = y;
    }
  }
};

/// Sample k of a record that begins at rest and is mirrored at its end.
double from_rest(std::span<const double> x, long k) {
  const long last = static_cast<long>(x.size()) - 1, at = k <= last ? k : 2 * last - k;
  return at < 0 ? 0.0 : x[static_cast<std::size_t>(at)];
}

} // namespace

double longest_interval(int cfc) { return 1 / (samples_a_class * cfc); }

std::vector<double> cfc_filtered(std::span<const double> samples, double interval, int cfc) {
  if (!(interval > 0) || interval > longest_interval(cfc) * (1 + 1e-12)) {
    throw Error(fmt::format("samples {:g} s apart are too few for a CFC {} filter; at most {:g} s", interval, cfc, longest_interval(cfc)));
  }
  if (samples.empty()) {
    return {};
  }
  const auto lead = static_cast<long>(std::ceil(lead_in / (cfc * interval)));
  const auto count = static_cast<long>(samples.size());
  std::vector<double> x;
  x.reserve(static_cast<std::size_t>(count + 2 * lead));
  for (long k = -lead; k < count + lead; ++k) {
    x.push_back(from_rest(samples, k));
  }
  const TwoPoles filter(interval, cfc);
  filter.pass(x.begin(), x.end());
  filter.pass(x.rbegin(), x.rend());
  return {x.begin() + lead, x.end() - lead};
}

} // namespace ballast
