#include "tests/exact/rayleigh_collapse.hpp"

#include <cmath>

namespace ballast::exact {

double rayleigh_time(double radius, double pressure, double density, double share) {
  // x = R/R0 = 1 - s^2 takes the root singularity of dt = dx / sqrt(x^-3 - 1) at x = 1 away; Simpson's rule in s.
  const double end = std::sqrt(1 - share);
  constexpr int n = 2000;
  const auto value = [](double s) {
    const double x = 1 - s * s, cube = x * x * x;
    // (1 - x^3) = s^2 (1 + x + x^2)
    return 2 * std::sqrt(cube / (1 + x + x * x));
  };
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * value(end * i / n);
  }
  return radius * std::sqrt(1.5 * density / pressure) * sum * end / (3 * n);
}

} // namespace ballast::exact
