#include "tests/exact/riemann.hpp"

#include "tests/exact/find_root.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ballast::exact {
namespace {

double total_pressure(const GasState& gas, double pressure) {
  return pressure + gas.p_infinity;
}

double sound_speed(const GasState& gas) {
  return std::sqrt(gas.gamma * total_pressure(gas, gas.pressure) / gas.density);
}

double gamma_ratio(const GasState& gas) {
  return (gas.gamma - 1.0) / (gas.gamma + 1.0);
}

/// Mass flux through the shock to `pressure`: Q^2 = (P* + (g-1)/(g+1) P) (g+1) rho / 2.
double shock_mass_flux(const GasState& gas, double pressure) {
  const double head =
      total_pressure(gas, pressure) + gamma_ratio(gas) * total_pressure(gas, gas.pressure);
  return std::sqrt(0.5 * (gas.gamma + 1.0) * gas.density * head);
}

/// Velocity jump |u* - u| over the wave to `pressure`, positive for a shock.
double velocity_jump(const GasState& gas, double pressure) {
  if (pressure > gas.pressure) {
    return (pressure - gas.pressure) / shock_mass_flux(gas, pressure);
  }
  const double total = total_pressure(gas, gas.pressure);
  if (total == 0.0) {
    return 0.0; // cold gas cannot expand
  }
  const double expansion = std::max(total_pressure(gas, pressure), 0.0) / total;
  const double power = std::pow(expansion, 0.5 * (gas.gamma - 1.0) / gas.gamma);
  return 2.0 * sound_speed(gas) / (gas.gamma - 1.0) * (power - 1.0);
}

double density_behind(const GasState& gas, double pressure) {
  const double total = total_pressure(gas, gas.pressure);
  const double star = std::max(total_pressure(gas, pressure), 0.0);
  if (pressure > gas.pressure) {
    const double ratio = gamma_ratio(gas);
    return gas.density * (star + ratio * total) / (ratio * star + total);
  }
  return total == 0.0 ? gas.density : gas.density * std::pow(star / total, 1.0 / gas.gamma);
}

void check(const GasState& gas) {
  if (!(gas.density > 0.0) || !(gas.gamma > 1.0) || !(gas.pressure + gas.p_infinity >= 0.0)) {
    throw std::invalid_argument("Riemann: needs density > 0, gamma > 1, p + p_inf >= 0");
  }
}

} // namespace

Riemann::Riemann(GasState left, GasState right) {
  check(left);
  check(right);
  const auto closing_speed = [&](double pressure) {
    return velocity_jump(left, pressure) + velocity_jump(right, pressure) + right.velocity -
           left.velocity;
  };
  const double floor = -std::min(left.p_infinity, right.p_infinity);
  vacuum_ = closing_speed(floor) > 0.0;
  star_pressure_ = floor;
  if (!vacuum_) {
    double high = std::max({total_pressure(left, left.pressure),
                            total_pressure(right, right.pressure),
                            left.density * left.velocity * left.velocity,
                            right.density * right.velocity * right.velocity});
    while (closing_speed(high) < 0.0) {
      high *= 2.0;
    }
    const RootResult root = find_root(closing_speed, floor, high);
    if (!root.converged) {
      throw std::invalid_argument("Riemann: no star pressure (state not finite)");
    }
    star_pressure_ = root.value;
  }
  left_ = make_side(left, -1.0, star_pressure_);
  right_ = make_side(right, 1.0, star_pressure_);
  star_velocity_ = 0.5 * (left_.star_velocity + right_.star_velocity);
  waves_ = {-left_.head, -left_.tail, star_velocity_, right_.tail, right_.head};
}

Riemann::Side Riemann::make_side(const GasState& gas, double direction, double star_pressure) {
  Side side{gas, direction, 0.0, density_behind(gas, star_pressure), 0.0, 0.0};
  side.star_velocity = gas.velocity + direction * velocity_jump(gas, star_pressure);
  if (star_pressure > gas.pressure) {
    side.head = direction * gas.velocity + shock_mass_flux(gas, star_pressure) / gas.density;
    side.tail = side.head;
    return side;
  }
  // Riemann invariant: c* = c + (g-1)/2 (jump), free of the 0/0 of sqrt(g P*/rho*) at a vacuum.
  const double speed = sound_speed(gas);
  const double star_speed = speed + 0.5 * (gas.gamma - 1.0) * velocity_jump(gas, star_pressure);
  side.head = direction * gas.velocity + speed;
  side.tail = direction * side.star_velocity + star_speed;
  return side;
}

FlowState Riemann::sample(const Side& side, double x_over_t) const {
  const GasState& gas = side.gas;
  const double ray = side.direction * x_over_t; // outward
  if (ray >= side.head) {
    return {gas.density, gas.velocity, gas.pressure};
  }
  if (ray <= side.tail) {
    return {side.star_density, side.star_velocity, star_pressure_};
  }
  // Inside the fan: outward velocity w + c = ray and w - 2c/(g-1) constant.
  const double speed = sound_speed(gas);
  const double outward = side.direction * gas.velocity;
  const double local = speed + gamma_ratio(gas) * (ray - outward - speed);
  const double ratio = std::max(local, 0.0) / speed;
  const double density = gas.density * std::pow(ratio, 2.0 / (gas.gamma - 1.0));
  const double total =
      total_pressure(gas, gas.pressure) * std::pow(ratio, 2.0 * gas.gamma / (gas.gamma - 1.0));
  return {density, side.direction * (ray - local), total - gas.p_infinity};
}

Riemann::Sample Riemann::at(double x_over_t) const {
  const bool in_left = x_over_t < star_velocity_;
  if (vacuum_ && x_over_t > left_.star_velocity && x_over_t < right_.star_velocity) {
    return {0.0, x_over_t, star_pressure_, in_left};
  }
  const FlowState state = sample(in_left ? left_ : right_, x_over_t);
  return {state.density, state.velocity, state.pressure, in_left};
}

} // namespace ballast::exact
