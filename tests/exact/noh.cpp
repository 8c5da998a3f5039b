#include "tests/exact/noh.hpp"

#include <cmath>

namespace ballast::exact {

double shock_speed(const Noh& problem) {
  return 0.5 * (problem.gamma - 1.0) * problem.inflow_speed;
}

FlowState state_at(const Noh& problem, double radius, double time) {
  const int dimension = static_cast<int>(problem.geometry);
  const double speed = problem.inflow_speed;
  if (radius > shock_speed(problem) * time) {
    const double convergence = std::pow(1.0 + speed * time / radius, dimension - 1);
    return {problem.density * convergence, -speed, 0.0};
  }
  const double jump = (problem.gamma + 1.0) / (problem.gamma - 1.0);
  const double density = problem.density * std::pow(jump, dimension);
  return {density, 0.0, 0.5 * (problem.gamma - 1.0) * density * speed * speed};
}

} // namespace ballast::exact
