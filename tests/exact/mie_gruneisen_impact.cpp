#include "tests/exact/mie_gruneisen_impact.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

namespace ballast::exact {
namespace {

/// Root of a u^2 - b u + c = 0 that tends to c / b as a vanishes (no cancellation for b > 0).
double interface_velocity(const LinearHugoniot& flyer, const LinearHugoniot& target, double speed) {
  const double a = flyer.density * flyer.slope - target.density * target.slope;
  const double b = flyer.density * (flyer.sound_speed + 2.0 * flyer.slope * speed) +
                   target.density * target.sound_speed;
  const double c = flyer.density * (flyer.sound_speed + flyer.slope * speed) * speed;
  return 2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c));
}

double shock_speed(const LinearHugoniot& material, double particle_velocity) {
  return material.sound_speed + material.slope * particle_velocity;
}

double shocked_density(const LinearHugoniot& material, double particle_velocity) {
  const double speed = shock_speed(material, particle_velocity);
  return material.density * speed / (speed - particle_velocity);
}

ImpactStates
match_impedances(const LinearHugoniot& flyer, const LinearHugoniot& target, double speed) {
  const double velocity = interface_velocity(flyer, target, speed);
  const double flyer_jump = speed - velocity;
  const double flyer_shock = shock_speed(flyer, flyer_jump);
  const double target_shock = shock_speed(target, velocity);
  return {.velocity = velocity,
          .pressure = target.density * target_shock * velocity,
          .flyer_shock_speed = flyer_shock,
          .flyer_shock_velocity = speed - flyer_shock,
          .target_shock_velocity = target_shock,
          .flyer_density = shocked_density(flyer, flyer_jump),
          .target_density = shocked_density(target, velocity),
          .flyer_energy = 0.5 * flyer_jump * flyer_jump,
          .target_energy = 0.5 * velocity * velocity};
}

/// c^2 = dp/drho + p / rho^2 dp/de, with dp_H/drho by hand.
double isentropic_sound_speed(const LinearHugoniot& material,
                              GruneisenLaw law,
                              double density,
                              double energy) {
  const double eta = compression(material, density);
  const double eta_slope = material.density / (density * density);
  const double s = hugoniot_slope(material, eta);
  const double pole = 1.0 - s * eta;
  const double on_hugoniot = hugoniot_pressure(material, density);
  const double pressure_slope = material.density * material.sound_speed * material.sound_speed *
                                (1.0 + s * eta) / (pole * pole * pole) * eta_slope;
  const double reference = 0.5 * on_hugoniot * eta / material.density;
  const double reference_slope =
      0.5 * (pressure_slope * eta + on_hugoniot * eta_slope) / material.density;
  const bool constant_gamma = law == GruneisenLaw::constant_gamma;
  const double rho_gamma = material.gruneisen * (constant_gamma ? density : material.density);
  const double growth = constant_gamma ? material.gruneisen * (energy - reference) : 0.0;
  const double p = pressure(material, law, density, energy);
  return std::sqrt(pressure_slope + growth - rho_gamma * reference_slope +
                   p * rho_gamma / (density * density));
}

/// Density, specific energy and velocity along a release.
using Release = std::array<double, 3>;

/// Runge-Kutta, fourth order, 1000 steps.
template <class Rate> Release march(Rate&& rate, Release y, double from, double to) {
  constexpr int steps = 1000;
  const double step = (to - from) / steps;
  const auto moved = [](const Release& start, double h, const Release& slope) -> Release {
    return {start[0] + h * slope[0], start[1] + h * slope[1], start[2] + h * slope[2]};
  };
  for (int i = 0; i < steps; ++i) {
    const double x = from + i * step;
    const Release k1 = rate(x, y);
    const Release k2 = rate(x + 0.5 * step, moved(y, 0.5 * step, k1));
    const Release k3 = rate(x + 0.5 * step, moved(y, 0.5 * step, k2));
    const Release k4 = rate(x + step, moved(y, step, k3));
    y = moved(moved(y, step / 6.0, k1), step / 3.0, k2);
    y = moved(moved(y, step / 3.0, k3), step / 6.0, k4);
  }
  return y;
}

} // namespace

PlateImpact::PlateImpact(const LinearHugoniot& flyer,
                         const LinearHugoniot& target,
                         double impact_speed)
    : flyer_reference_density_(flyer.density), target_reference_density_(target.density),
      impact_speed_(impact_speed), states_(match_impedances(flyer, target, impact_speed)) {
  if (!(impact_speed > 0.0)) {
    throw std::invalid_argument("PlateImpact: needs impact_speed > 0");
  }
}

FlowState PlateImpact::at(double x_over_t) const {
  if (x_over_t < states_.flyer_shock_velocity) {
    return {flyer_reference_density_, impact_speed_, 0.0};
  }
  if (x_over_t > states_.target_shock_velocity) {
    return {target_reference_density_, 0.0, 0.0};
  }
  const bool in_flyer = x_over_t < states_.velocity;
  return {in_flyer ? states_.flyer_density : states_.target_density,
          states_.velocity,
          states_.pressure};
}

double
free_surface_velocity(const LinearHugoniot& material, GruneisenLaw law, double particle_velocity) {
  const auto sound_speed = [&](const Release& y) {
    return isentropic_sound_speed(material, law, y[0], y[1]);
  };
  // de = p / rho^2 d rho, du = -c / rho d rho: the release runs back, u rises as rho falls.
  const auto per_density = [&](double rho, const Release& y) -> Release {
    const double p = pressure(material, law, rho, y[1]);
    return {1.0, p / (rho * rho), -sound_speed(y) / rho};
  };
  // The same over dp = c^2 d rho.
  const auto per_pressure = [&](double p, const Release& y) -> Release {
    const double c = sound_speed(y);
    return {1.0 / (c * c), p / (y[0] * y[0] * c * c), -1.0 / (y[0] * c)};
  };
  const double density = shocked_density(material, particle_velocity);
  Release y{density, 0.5 * particle_velocity * particle_velocity, particle_velocity};
  // p_H has a kink of curvature at rho0, so the march stops there before it goes on to p = 0.
  y = march(per_density, y, density, material.density);
  y[0] = material.density;
  y = march(per_pressure, y, pressure(material, law, y[0], y[1]), 0.0);
  return y[2];
}

} // namespace ballast::exact
