#include "tests/exact/elastic_plastic_piston.hpp"

#include "tests/exact/find_root.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ballast::exact {
namespace {

using Material = ElasticPlasticPiston::Material;
using State = ElasticPlasticState;

double deviatoric_stress(const Material& material, double density) {
  const double elastic =
      -4.0 / 3.0 * material.shear_modulus * std::log(density / material.hugoniot.density);
  return std::max(elastic, -2.0 / 3.0 * material.yield_stress);
}

/// State of `density` behind a shock into `ahead`: the energy jump and p = a + b e, both linear.
State shocked_to(const Material& material, const State& ahead, double density) {
  const auto law = GruneisenLaw::constant_gamma;
  const double half_volume_drop = 0.5 * (1.0 / ahead.density - 1.0 / density);
  const double cold = pressure(material.hugoniot, law, density, 0.0);
  const double slope = material.hugoniot.gruneisen * density;
  const double s_xx = deviatoric_stress(material, density);
  const double energy =
      (ahead.specific_energy + (cold - s_xx + ahead.axial_stress()) * half_volume_drop) /
      (1.0 - slope * half_volume_drop);
  State state{density, 0.0, cold + slope * energy, energy, s_xx};
  const double jump = 2.0 * half_volume_drop * (state.axial_stress() - ahead.axial_stress());
  state.velocity = ahead.velocity + std::copysign(std::sqrt(std::abs(jump)), jump);
  return state;
}

/// Largest density a shock can reach: pole of the Hugoniot or of the energy jump, whichever first.
double density_limit(const Material& material, const State& ahead) {
  const LinearHugoniot& eos = material.hugoniot;
  const double hugoniot_pole =
      eos.slope > 1.0 ? eos.density * eos.slope / (eos.slope - 1.0) : HUGE_VAL;
  const double energy_pole = ahead.density * (1.0 + 2.0 / eos.gruneisen);
  return std::min(hugoniot_pole, energy_pole);
}

State shocked_to_velocity(const Material& material, const State& ahead, double velocity) {
  const auto excess = [&](double density) {
    return shocked_to(material, ahead, density).velocity - velocity;
  };
  // Outwards in small steps: near the limit the solution leaves its physical branch.
  const double step = 0.02 * (density_limit(material, ahead) - ahead.density);
  double high = ahead.density + step;
  for (int i = 2; i < 50 && excess(high) < 0.0; ++i) {
    high = ahead.density + i * step;
  }
  const RootResult root = find_root(excess, ahead.density, high);
  if (!root.converged) {
    throw std::invalid_argument("ElasticPlasticPiston: no shock reaches the piston velocity");
  }
  State state = shocked_to(material, ahead, root.value);
  state.velocity = velocity;
  return state;
}

/// Laboratory speed from the mass jump: rho (S - u) = rho_a (S - u_a).
double shock_speed(const State& ahead, const State& behind) {
  return (behind.density * behind.velocity - ahead.density * ahead.velocity) /
         (behind.density - ahead.density);
}

} // namespace

ElasticPlasticPiston::ElasticPlasticPiston(const Material& material, double piston_velocity)
    : material_(material), ahead_{material.hugoniot.density, 0.0, 0.0, 0.0, 0.0} {
  if (!(piston_velocity > 0.0) || !(material.shear_modulus > 0.0) ||
      !(material.yield_stress > 0.0)) {
    throw std::invalid_argument(
        "ElasticPlasticPiston: needs piston_velocity, shear_modulus, yield_stress > 0");
  }
  const double strain = 0.5 * material.yield_stress / material.shear_modulus;
  yield_ = shocked_to(material, ahead_, material.hugoniot.density * std::exp(strain));
  elastic_speed_ = shock_speed(ahead_, yield_);
  if (piston_velocity <= yield_.velocity) {
    regime_ = PistonRegime::elastic;
    piston_ = shocked_to_velocity(material, ahead_, piston_velocity);
    elastic_speed_ = plastic_speed_ = shock_speed(ahead_, piston_);
    return;
  }
  piston_ = shocked_to_velocity(material, yield_, piston_velocity);
  plastic_speed_ = shock_speed(yield_, piston_);
  if (plastic_speed_ >= elastic_speed_) {
    regime_ = PistonRegime::overdriven;
    piston_ = shocked_to_velocity(material, ahead_, piston_velocity);
    plastic_speed_ = shock_speed(ahead_, piston_);
  }
}

ElasticPlasticState ElasticPlasticPiston::at(double x, double time) const {
  if (x <= plastic_speed_ * time) {
    return piston_;
  }
  return regime_ == PistonRegime::two_wave && x <= elastic_speed_ * time ? yield_ : ahead_;
}

} // namespace ballast::exact
