#include "tests/exact/sedov.hpp"

#include "tests/exact/find_root.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ballast::exact {
namespace {

/// Integral over [0, 1] of an integrand that may have algebraic ends (tanh-sinh, step 1/32).
template <class Integrand> double integrate_unit(Integrand&& integrand) {
  constexpr double step = 1.0 / 32.0;
  constexpr int half_count = 112; // |t| <= 3.5: the weights fall to 1e-21
  double sum = 0.0;
  for (int i = -half_count; i <= half_count; ++i) {
    const double t = step * i;
    const double argument = 0.5 * std::numbers::pi * std::sinh(t);
    const double x = 1.0 / (1.0 + std::exp(-2.0 * argument));
    const double cosh_argument = std::cosh(argument);
    const double weight = 0.25 * std::numbers::pi * std::cosh(t) / (cosh_argument * cosh_argument);
    sum += weight * integrand(x);
  }
  return step * sum;
}

/// Area of the unit sphere in j dimensions; planar counts one side.
double unit_area(int dimension) {
  const double areas[] = {1.0, 2.0 * std::numbers::pi, 4.0 * std::numbers::pi};
  return areas[dimension - 1];
}

} // namespace

Sedov::Sedov(Geometry geometry, double gamma, double density, double energy)
    : dimension_(static_cast<int>(geometry)), gamma_(gamma), density_(density), energy_(energy),
      delta_(2.0 / (dimension_ + 2)), shock_V_(2.0 / (gamma + 1.0)),
      slope_D_(dimension_ * (gamma - 1.0) + 2.0),
      radius_w_((gamma - 1.0) / (2.0 * gamma + dimension_ - 2.0)),
      radius_D_(delta_ - (gamma + 1.0) / slope_D_ - radius_w_),
      density_w_(dimension_ / (2.0 * gamma + dimension_ - 2.0)),
      density_D_(dimension_ * (gamma + 1.0) / slope_D_ - 1.0 - density_w_) {
  if (!(density > 0.0) || !(energy > 0.0) || !(gamma > 1.0)) {
    throw std::invalid_argument("Sedov: needs density > 0, energy > 0, gamma > 1");
  }
  if (!(dimension_ + 2 - slope_D_ * shock_V_ > 0.0)) {
    throw std::invalid_argument("Sedov: spherical needs gamma < 7 (vacuum at the origin)");
  }
  alpha_ = unit_area(dimension_) * delta_ * delta_ *
           integrate_unit([this](double x) { return energy_integrand(x); });
}

/// h(V) of the header; log1p keeps it exact through gamma = 2.
double Sedov::singular_factor(double V) const {
  const double q = dimension_ * V / ((dimension_ + 2) * (1.0 - V));
  const double excess = gamma_ - 2.0;
  return excess == 0.0 ? -q : std::log1p(-excess * q) / excess;
}

Sedov::Similarity Sedov::similarity(double log_w) const {
  const double shock_D = dimension_ + 2 - slope_D_ * shock_V_;
  Similarity s{};
  s.w = (gamma_ * shock_V_ - 1.0) * std::exp(log_w);
  s.V = (1.0 + s.w) / gamma_;
  s.D = dimension_ + 2 - slope_D_ * s.V;
  const double log_V = std::log(s.V / shock_V_);
  const double log_D = std::log(s.D / shock_D);
  const double log_h = -2.0 * (singular_factor(s.V) - singular_factor(shock_V_));
  s.log_radius_factor = -delta_ * log_V + radius_D_ * log_D;
  s.log_density = density_w_ * log_w + density_D_ * log_D + log_h;
  s.pressure =
      (1.0 - s.V) / (1.0 - shock_V_) *
      std::exp(dimension_ * delta_ * log_V + (2.0 * radius_D_ + density_D_) * log_D + log_h);
  return s;
}

/// Energy density times xi^(j-1) d xi / dx, in units of rho0 (delta R / t)^2, over
/// x = (w/w2)^(j a): in x the integrand is finite at the origin.
double Sedov::energy_integrand(double x) const {
  const double log_w = std::log(x) / (dimension_ * radius_w_);
  const Similarity s = similarity(log_w);
  const double log_xi = radius_w_ * log_w + s.log_radius_factor;
  const double shock_density = (gamma_ + 1.0) / (gamma_ - 1.0);
  const double kinetic = 0.5 * shock_density * s.V * s.V * std::exp(s.log_density + 2.0 * log_xi);
  const double internal = 2.0 / (gamma_ * gamma_ - 1.0) * s.pressure;
  // d log xi / d log w
  const double log_slope =
      (gamma_ * (1.0 - s.V) + s.w * (gamma_ - 2.0 * (1.0 - s.V) / s.V)) / (gamma_ * s.D);
  return (kinetic + internal) * std::exp(dimension_ * s.log_radius_factor) * log_slope /
         (dimension_ * radius_w_);
}

double Sedov::shock_radius(double time) const {
  return std::pow(energy_ * time * time / (alpha_ * density_), 1.0 / (dimension_ + 2));
}

double Sedov::shock_speed(double time) const {
  return delta_ * shock_radius(time) / time;
}

FlowState Sedov::shock_state(double time) const {
  const double speed = shock_speed(time);
  return {density_ * (gamma_ + 1.0) / (gamma_ - 1.0),
          shock_V_ * speed,
          shock_V_ * density_ * speed * speed};
}

FlowState Sedov::at(double radius, double time) const {
  const double shock = shock_radius(time);
  if (radius > shock) {
    return {density_, 0.0, 0.0};
  }
  const FlowState behind = shock_state(time);
  if (radius == 0.0) {
    return {0.0, 0.0, behind.pressure * similarity(-HUGE_VAL).pressure};
  }
  const double log_xi = std::log(radius / shock);
  const auto residual = [&](double log_w) {
    return radius_w_ * log_w + similarity(log_w).log_radius_factor - log_xi;
  };
  double low = log_xi / radius_w_ - 1.0;
  while (residual(low) > 0.0) {
    low *= 2.0; // ends: the power of w takes the residual to minus infinity
  }
  const RootResult root = find_root(residual, low, 0.0);
  const Similarity s = similarity(root.converged ? root.value : 0.0);
  return {behind.density * std::exp(s.log_density),
          delta_ * radius / time * s.V,
          behind.pressure * s.pressure};
}

} // namespace ballast::exact
