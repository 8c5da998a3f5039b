// The scalar equation of the radial return, solved for any flow stress that does not fall with strain.
#pragma once

#include "materials/strength.hpp"

#include <cmath>

namespace ballast {

/// Root d of a residual that falls from r_low > 0 at 0 to r_high <= 0 at `high`, to |residual| <= tolerance.
///
/// Regula falsi with the Illinois weight, halved by ratio every third time, and from the thirtieth on.
template <class Residual>
[[nodiscard]] PlasticIncrement falling_root(double high, double r_low, double r_high, double tolerance, Residual&& residual) {
  double low = 0;
  constexpr double far = 1e4; // the root may be 1e-30 where ep is 0
  const auto between = [&] { return low == 0 ? high / far : high > far * low ? std::sqrt(low * high) : 0.5 * (low + high); };
  int side = 0;
  double d = high;
  for (int it = 1; it <= 100; ++it) {
    d = it % 3 == 0 || it > 30 ? between() : (low * r_high - high * r_low) / (r_high - r_low);
    const double r = residual(d);
    if (std::abs(r) <= tolerance || high - low <= 1e-15 * high) {
      return {d, true, it};
    }
    if (r > 0) {
      low = d;
      r_low = r;
      r_high *= side == 1 ? 0.5 : 1.0;
      side = 1;
    } else {
      high = d;
      r_high = r;
      r_low *= side == -1 ? 0.5 : 1.0;
      side = -1;
    }
  }
  return {d, false, 100};
}

/// Root d of trial - 3 G d = flow(d) on [0, trial/3G]; 0 when trial does not exceed flow(0).
///
/// B ep^n has an infinite slope at 0 and the rate factor a kink that is as steep, so Newton is not safe.
template <class Flow> [[nodiscard]] PlasticIncrement solve_return(double trial, double shear, Flow&& flow) {
  const double at_rest = flow(0.0);
  if (trial <= at_rest) {
    return {0.0};
  }
  const double high = trial / (3 * shear), r_high = -flow(high);
  return falling_root(high, trial - at_rest, r_high, 1e-11 * trial, [&](double d) { return trial - 3 * shear * d - flow(d); });
}

} // namespace ballast
