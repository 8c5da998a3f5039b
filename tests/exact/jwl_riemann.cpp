#include "tests/exact/jwl_riemann.hpp"

#include "tests/exact/find_root.hpp"

#include <cmath>
#include <stdexcept>

namespace ballast::exact {

namespace {
double cold_curve(const JwlLaw& m, double density) {
  const double v = m.rho0 / density;
  return m.A * (1 - m.omega / (m.R1 * v)) * std::exp(-m.R1 * v) + m.B * (1 - m.omega / (m.R2 * v)) * std::exp(-m.R2 * v);
}

/// Pressure behind a shock into `far` that compresses it to `density`.
double hugoniot(const JwlLaw& m, const FlowState& far, double density) {
  const double e0 = jwl_energy(m, far.density, far.pressure), half = 0.5 * (1 / far.density - 1 / density);
  // p = f + w rho (e0 + (p + p0) half)
  return (cold_curve(m, density) + m.omega * density * (e0 + far.pressure * half)) / (1 - m.omega * density * half);
}
} // namespace

double jwl_energy(const JwlLaw& m, double density, double pressure) {
  return (pressure - cold_curve(m, density)) / (m.omega * density);
}

double JwlRiemann::isentrope(const Side& side, double density, double& sound) const {
  const JwlLaw& m = law_;
  const double v0 = m.rho0 / side.far.density, v = m.rho0 / density;
  const auto exponentials = [&](double x, double power) {
    return m.A * std::pow(m.R1, power) * std::exp(-m.R1 * x) + m.B * std::pow(m.R2, power) * std::exp(-m.R2 * x);
  };
  const double c = (side.far.pressure - exponentials(v0, 0)) * std::pow(v0, 1 + m.omega);
  const double slope = exponentials(v, 1) + (1 + m.omega) * c * std::pow(v, -2 - m.omega); // -dp/dV
  sound = std::sqrt(slope * v / density);
  return exponentials(v, 0) + c * std::pow(v, -1 - m.omega);
}

/// Velocity behind the part of a rarefaction that has come down to `density`.
double JwlRiemann::rarefied_velocity(const Side& side, double density) const {
  constexpr int steps = 400;
  const double low = std::log(density), high = std::log(side.far.density), h = (high - low) / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    double c = 0;
    isentrope(side, std::exp(low + h * i), c);
    sum += c * (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2);
  }
  return side.far.velocity - side.direction * sum * h / 3;
}

/// Velocity behind the wave of `side` when it ends at `pressure`.
double JwlRiemann::jump(const Side& side, double pressure, double& density) const {
  const FlowState& far = side.far;
  if (pressure > far.pressure) {
    const double most = far.density * (1 + 2 / law_.omega); // where 1 - w rho half vanishes
    density = find_root([&](double rho) { return hugoniot(law_, far, rho) - pressure; }, far.density, most * (1 - 1e-12)).value;
    return far.velocity + side.direction * std::sqrt((pressure - far.pressure) * (1 / far.density - 1 / density));
  }
  double c = 0;
  density = find_root([&](double rho) { return isentrope(side, rho, c) - pressure; }, 1e-6 * far.density, far.density).value;
  return rarefied_velocity(side, density);
}

void JwlRiemann::finish(Side& side) const {
  jump(side, star_pressure_, side.star_density);
  side.shock = star_pressure_ > side.far.pressure;
  if (side.shock) {
    const FlowState& far = side.far;
    side.head = side.tail = (side.star_density * star_velocity_ - far.density * far.velocity) / (side.star_density - far.density);
    return;
  }
  double c0 = 0, c = 0;
  isentrope(side, side.far.density, c0);
  isentrope(side, side.star_density, c);
  side.head = side.far.velocity + side.direction * c0;
  side.tail = star_velocity_ + side.direction * c;
}

JwlRiemann::JwlRiemann(const JwlLaw& law, const FlowState& left, const FlowState& right) : law_(law) {
  left_.far = left;
  left_.direction = -1;
  right_.far = right;
  double density = 0;
  const double low = 1e-6 * std::fmin(left.pressure, right.pressure), high = 1e3 * std::fmax(left.pressure, right.pressure);
  const RootResult root = find_root([&](double p) { return jump(left_, p, density) - jump(right_, p, density); }, low, high);
  if (!root.converged) {
    throw std::runtime_error("JwlRiemann: no star pressure");
  }
  star_pressure_ = root.value;
  star_velocity_ = 0.5 * (jump(left_, star_pressure_, density) + jump(right_, star_pressure_, density));
  finish(left_);
  finish(right_);
}

FlowState JwlRiemann::at(double x_over_t) const { return sample(x_over_t < star_velocity_ ? left_ : right_, x_over_t); }

FlowState JwlRiemann::sample(const Side& side, double x_over_t) const {
  const double s = side.direction;
  if (s * x_over_t >= s * side.head) {
    return side.far;
  }
  if (side.shock || s * x_over_t <= s * side.tail) {
    return {side.star_density, star_velocity_, star_pressure_};
  }
  double c = 0;
  const auto off = [&](double rho) {
    isentrope(side, rho, c);
    return rarefied_velocity(side, rho) + s * c - x_over_t;
  };
  const double rho = find_root(off, side.star_density, side.far.density).value;
  return {rho, rarefied_velocity(side, rho), isentrope(side, rho, c)};
}

} // namespace ballast::exact
