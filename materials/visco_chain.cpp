#include "materials/visco_chain.hpp"

#include <cmath>

namespace ballast {

namespace {

bool neo_hookean(const ChainSpring& s) { return std::isinf(s.lock_stretch); }

/// Langevin function and its derivative; x > 0.05 keeps coth x - 1/x clear of cancellation.
double langevin_slope(double beta, double value) { return 1 - value * value - 2 * value / beta; }

/// x beta - integral of x: beta dx integrated from 0.
double chain_integral(double x, double beta) {
  return x * beta - (beta + std::log1p(-std::exp(-2 * beta)) - std::log(2 * beta));
}

} // namespace

double inverse_langevin(double x) {
  const double x2 = x * x;
  if (x < 0.05) { // the series' next term is below 1e-15
    return x * (3 + x2 * (9.0 / 5 + x2 * (297.0 / 175 + x2 * (1539.0 / 875 + x2 * (126117.0 / 67375 + x2 * (43733439.0 / 21896875))))));
  }
  if (!(x < 1)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // Kroeger 2015, 3e-3, then Newton.
  double beta = (3 * x - x / 5 * (6 * x2 + x2 * x2 - 2 * x2 * x2 * x2)) / (1 - x2);
  for (int it = 0; it < 3; ++it) {
    const double value = 1 / std::tanh(beta) - 1 / beta;
    beta -= (value - x) / langevin_slope(beta, value);
  }
  return beta;
}

SpringModulus spring_modulus(const ChainSpring& spring, double trace) {
  if (neo_hookean(spring)) {
    return {spring.shear, 0};
  }
  const double lam = std::sqrt(trace / 3), x = lam / spring.lock_stretch;
  const double beta = inverse_langevin(x);
  const double value = spring.shear * beta / (lam * inverse_langevin(1 / spring.lock_stretch));
  const double stiffens = x / (beta * langevin_slope(beta, x)) - 1; // d ln value / d ln lam
  return {value, value * stiffens / (2 * trace)};
}

double spring_energy(const ChainSpring& spring, double trace) {
  if (neo_hookean(spring)) {
    return 0.5 * spring.shear * (trace - 3);
  }
  const double at_rest = 1 / spring.lock_stretch, x = std::sqrt(trace / 3) / spring.lock_stretch;
  const double beta0 = inverse_langevin(at_rest);
  return 3 * spring.shear * spring.lock_stretch / beta0 * (chain_integral(x, inverse_langevin(x)) - chain_integral(at_rest, beta0));
}

} // namespace ballast
