// CFC filter: the gain of SAE J211-1, no phase, nothing done to what does not oscillate.
#include "core/cfc_filter.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace ballast {
namespace {

constexpr double pi = std::numbers::pi;

struct Response {
  double gain, phase;
};

/// Of a wave with `periods` whole periods in the middle `window` of the record, 6 / CFC from either end.
Response response(int cfc, double interval, long window, long periods) {
  const auto lead = static_cast<long>(6 / (cfc * interval));
  std::vector<double> x;
  const double turn = 2 * pi * static_cast<double>(periods) / static_cast<double>(window);
  for (long k = 0; k < window + 2 * lead; ++k) {
    x.push_back(std::sin(turn * static_cast<double>(k - lead)));
  }
  const std::vector<double> y = cfc_filtered(x, interval, cfc);
  double in = 0, out = 0;
  for (long k = 0; k < window; ++k) {
    const double value = y[static_cast<std::size_t>(k + lead)];
    in += 2 * value * std::sin(turn * static_cast<double>(k)) / static_cast<double>(window);
    out += 2 * value * std::cos(turn * static_cast<double>(k)) / static_cast<double>(window);
  }
  return {std::hypot(in, out), std::atan2(out, in)};
}

double decibels(double gain) { return 20 * std::log10(gain); }

TEST(CfcFilter, GainIsTwiceThatOfTwoButterworthPoles) {
  for (const int cfc : cfc_classes) {
    const double interval = 1.0 / (40.0 * cfc); // the bilinear map bends the axis: that is in the formula
    const double wa = std::tan(pi * 2.0775 * cfc * interval);
    constexpr long window = 4000; // 100 / CFC
    for (const long periods : {10L, 50L, 100L, 166L, 208L, 400L, 800L}) {
      const double f = static_cast<double>(periods) / (static_cast<double>(window) * interval);
      const double exact = 1 / (1 + std::pow(std::tan(pi * f * interval) / wa, 4)); // the square of one pass
      const Response got = response(cfc, interval, window, periods);
      EXPECT_NEAR(got.gain, exact, 1e-12) << cfc << " at " << f; // the ends' part has died by e^-55
      EXPECT_NEAR(got.phase, 0, 1e-9) << cfc << " at " << f;
    }
  }
}

TEST(CfcFilter, LiesInTheCorridorOfTheStandard) {
  for (const int cfc : cfc_classes) {
    const double interval = 1.0 / (600.0 * cfc);
    constexpr long window = 12000; // 20 / CFC: n periods are n / 20 CFC
    EXPECT_NEAR(decibels(response(cfc, interval, window, 2).gain), 0, 0.5);
    const double high = decibels(response(cfc, interval, window, 20).gain);
    EXPECT_GT(high, -1);
    EXPECT_LT(high, 0.5);
    const double low = decibels(response(cfc, interval, window, 33).gain), above = decibels(response(cfc, interval, window, 34).gain);
    EXPECT_GT(low, -3.01); // -3 dB lies at 5/3 CFC, that is 33.3 periods
    EXPECT_LT(above, -3.01);
    for (const int octaves : {1, 2}) { // beyond: falls by 9 to 24 dB an octave from 0.5 and -4 dB at 5/3 CFC
      const double fallen = decibels(response(cfc, interval, window, octaves == 1 ? 67 : 133).gain);
      EXPECT_LT(fallen, 0.5 - 9 * octaves);
      EXPECT_GT(fallen, -4 - 24 * octaves);
    }
  }
}

TEST(CfcFilter, ConstantAndRampPassUnchanged) {
  for (const int cfc : cfc_classes) {
    const double interval = 1.0 / (100.0 * cfc);
    std::vector<double> level(2000, 3.5), ramp;
    for (std::size_t k = 0; k < level.size(); ++k) {
      ramp.push_back(1 + 0.01 * static_cast<double>(k));
    }
    const std::vector<double> same = cfc_filtered(level, interval, cfc), still = cfc_filtered(ramp, interval, cfc);
    for (std::size_t k = 600; k < 1400; ++k) { // 6 / CFC from either end
      EXPECT_NEAR(same[k], level[k], 1e-10); // round-off times the filter's memory
      EXPECT_NEAR(still[k], ramp[k], 1e-9);
    }
  }
}

TEST(CfcFilter, ShortRecordsHaveTheirLength) {
  for (const std::size_t count : {0UL, 1UL, 2UL, 7UL}) { // shorter than the filter's memory
    EXPECT_EQ(cfc_filtered(std::vector<double>(count, 0.0), 1e-5, 1000), std::vector<double>(count, 0.0));
  }
}

TEST(CfcFilter, RunsTheSameBothWays) {
  std::vector<double> pulse(14000, 0.0);
  for (std::size_t k = 6900; k < 7000; ++k) { // 6 / CFC from either end
    pulse[k] = static_cast<double>(k - 6900);
  }
  std::vector<double> turned(pulse.rbegin(), pulse.rend());
  std::vector<double> back = cfc_filtered(turned, 1e-6, 1000);
  std::reverse(back.begin(), back.end());
  const std::vector<double> forth = cfc_filtered(pulse, 1e-6, 1000);
  for (std::size_t k = 0; k < pulse.size(); ++k) {
    EXPECT_NEAR(back[k], forth[k], 1e-10);
  }
}

TEST(CfcFilter, ImpactAtTheStartIsFilteredAsAnyOther) {
  constexpr std::size_t count = 12000, middle = 6000; // 6 / CFC on either side
  std::vector<double> first(count, 0.0), later(count, 0.0);
  for (std::size_t k = 0; k < 40; ++k) {
    first[k] = later[middle + k] = 1e6 * (1 + 0.5 * std::sin(static_cast<double>(k)));
  }
  const std::vector<double> a = cfc_filtered(first, 1e-6, 1000), b = cfc_filtered(later, 1e-6, 1000);
  for (std::size_t k = 0; k < middle; ++k) {
    EXPECT_NEAR(a[k], b[middle + k], 1e-6);
  }
  EXPECT_LT(*std::max_element(a.begin(), a.end()), 0.3 * first[0]); // 40 us are short for 1650 Hz
}

TEST(CfcFilter, AtTheEndALevelGoesOn) {
  std::vector<double> step(9000, 0.0);
  std::fill(step.begin() + 4500, step.end(), 2.0); // 4.5 / CFC before the end
  EXPECT_NEAR(cfc_filtered(step, 1e-6, 1000).back(), 2.0, 1e-9);
}

TEST(CfcFilter, RefusesSamplesTooFarApart) {
  const std::vector<double> x(100, 1.0);
  EXPECT_NO_THROW(cfc_filtered(x, 1e-4, 1000));
  EXPECT_THROW(cfc_filtered(x, 1.01e-4, 1000), Error);
  EXPECT_THROW(cfc_filtered(x, 0, 1000), Error);
}

} // namespace
} // namespace ballast
