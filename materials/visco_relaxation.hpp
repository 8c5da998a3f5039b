// One exponential relaxation over a step: s' = a - s/tau with constant a and tau, x = dt/tau.
//
//   s(t) = s_n + (s_inf - s_n) phi(t),  phi = 1 - exp(-t/tau),  s_inf = a tau.
// Integrals over the step as fractions of dt: of phi (first), of phi^2 (second). Small x by series, so that their
// differences keep all digits.
#pragma once

#include <cmath>

namespace ballast {

struct Relaxation {
  double decay;  ///< exp(-x)
  double share;  ///< phi/x: of a dt that arrives; 1 at x = 0
  double first;  ///< mean of phi / x; 1/2 at 0
  double second; ///< mean of phi^2 / x^2; 1/3 at 0
};

/// x >= 0, infinity excluded. Relative error of each: 1e-14.
inline Relaxation relaxation(double x) {
  const double gone = -std::expm1(-x);
  if (x > 0.3) {
    const double share = gone / x, first = (1 - share) / x;
    return {1 - gone, share, first, (1 - share - 0.5 * gone * share) / (x * x)};
  }
  // share = sum (-x)^k/(k+1)!, first = sum (-x)^k/(k+2)!, second = sum (2^(k+2) - 2) (-x)^k/(k+3)!
  double share = 0, first = 0, second = 0, term = 1, power = 2;
  for (int k = 0; k < 13; ++k) {
    power *= 2;
    share += term;
    first += term / (k + 2);
    second += (power - 2) * term / ((k + 2) * (k + 3));
    term *= -x / (k + 2);
  }
  return {1 - gone, share, first, second};
}

} // namespace ballast
