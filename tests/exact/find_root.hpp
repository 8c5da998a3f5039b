#pragma once

/// Bisection down to neighbouring doubles. Slow (about 60 evaluations) and never wrong: an exact
/// solution is set up once per test, so robustness is worth more than speed.

namespace ballast::exact {

struct RootResult {
  double value;
  bool converged; ///< false: no sign change between the ends
  int iterations;
};

/// Root of `residual` in [low, high]; `residual` may rise or fall, and must change sign.
template <class Residual>
[[nodiscard]] RootResult find_root(Residual&& residual, double low, double high) {
  constexpr int max_iterations = 2100; // every exponent and every bit of a double
  const double at_low = residual(low);
  const double at_high = residual(high);
  if (at_low == 0.0) {
    return {low, true, 0};
  }
  if (at_high == 0.0) {
    return {high, true, 0};
  }
  if (!((at_low < 0.0 && at_high > 0.0) || (at_low > 0.0 && at_high < 0.0))) {
    return {low, false, 0};
  }
  const bool falls = at_low > 0.0;
  for (int iteration = 1; iteration <= max_iterations; ++iteration) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) {
      return {middle, true, iteration};
    }
    const bool below_root = (residual(middle) < 0.0) != falls;
    (below_root ? low : high) = middle;
  }
  return {0.5 * (low + high), false, max_iterations};
}

} // namespace ballast::exact
