#include "tests/exact/shell_collapse.hpp"

#include "tests/exact/find_root.hpp"

#include <cmath>

namespace ballast::exact {

namespace {

int order(const Shell& s) { return s.sphere ? 3 : 2; }

/// Integral over the initial wall of f(r0) r0^(n-1), by Simpson's rule.
template <class Function> double over_wall(const Shell& s, Function&& f) {
  constexpr int parts = 2000;
  const double h = (s.outer - s.inner) / parts;
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const double r = s.inner + i * h, weight = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * f(r) * std::pow(r, order(s) - 1);
  }
  return sum * h / 3;
}

/// Energy by volume of equivalent strain e.
double stored(const Shell& s, double e) {
  if (s.shear_modulus > 0 && e < s.yield / (3 * s.shear_modulus)) {
    return 1.5 * s.shear_modulus * e * e;
  }
  return s.yield * e - (s.shear_modulus > 0 ? s.yield * s.yield / (6 * s.shear_modulus) : 0.0);
}

} // namespace

double stopping_radius(const Shell& s, double speed) {
  const int n = order(s);
  const double kinetic = over_wall(s, [&](double r) { return 0.5 * s.density * std::pow(speed * std::pow(s.inner / r, n - 1), 2); });
  const auto left = [&](double inner) {
    const double moved = std::pow(s.inner, n) - std::pow(inner, n), per_turn = s.sphere ? 2.0 : 2 / std::sqrt(3.0);
    return kinetic - over_wall(s, [&](double r0) { return stored(s, -per_turn / n * std::log1p(-moved / std::pow(r0, n))); });
  };
  return find_root(left, 1e-6 * s.inner, s.inner).value;
}

double outer_radius(const Shell& s, double inner) {
  const int n = order(s);
  return std::pow(std::pow(s.outer, n) - std::pow(s.inner, n) + std::pow(inner, n), 1.0 / n);
}

} // namespace ballast::exact
