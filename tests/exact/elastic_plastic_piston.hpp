#pragma once

#include "tests/exact/linear_hugoniot.hpp"

/// Piston driven at constant velocity into a hypoelastic (Jaumann rate, Wilkins), perfectly plastic
/// half-space at rest, uniaxial strain, Mie-Grueneisen pressure with Gamma constant.
///   elastic:  s_xx = -(4/3) G ln(rho / rho0),  yield at |s_xx| = 2Y/3: rho_y = rho0 exp(Y / 2G)
///   jumps:    (u - u_a)^2 = (sigma - sigma_a) (1/rho_a - 1/rho),
///             e - e_a = (sigma + sigma_a) (1/rho_a - 1/rho) / 2,   sigma = p - s_xx
/// Three regimes: one elastic shock (slow piston); elastic precursor at yield and plastic shock;
/// one overdriven shock once the plastic shock would outrun the precursor. Reference: Udaykumar et
/// al., J. Comput. Phys. 186 (2003) 136; Maire et al., J. Comput. Phys. 235 (2013) 626; Lieberman
/// et al., ExactPack EPpiston. Units: SI. sigma and p are compression-positive, s_xx
/// tension-positive; velocities are laboratory ones.

namespace ballast::exact {

enum class PistonRegime { elastic, two_wave, overdriven };

struct ElasticPlasticState {
  double density;
  double velocity;
  double pressure;
  double specific_energy;
  double deviatoric_stress; ///< s_xx, tension-positive

  [[nodiscard]] double axial_stress() const { return pressure - deviatoric_stress; }
};

class ElasticPlasticPiston {
public:
  struct Material {
    LinearHugoniot hugoniot;
    double shear_modulus;
    double yield_stress;
  };

  /// Throws std::invalid_argument unless piston_velocity, shear_modulus and yield_stress are > 0.
  ElasticPlasticPiston(const Material& material, double piston_velocity);

  [[nodiscard]] PistonRegime regime() const { return regime_; }
  /// State at the elastic limit behind an elastic shock; a property of the material alone.
  [[nodiscard]] const ElasticPlasticState& yield_state() const { return yield_; }
  /// State at the piston.
  [[nodiscard]] const ElasticPlasticState& piston_state() const { return piston_; }
  /// Of an elastic shock to the yield state (elastic regime: to the piston state).
  [[nodiscard]] double elastic_speed() const { return elastic_speed_; }
  /// Of the shock that ends in the piston state (elastic regime: equal to elastic_speed).
  [[nodiscard]] double plastic_speed() const { return plastic_speed_; }

  /// State at x and time > 0; the piston starts at x = 0 and moves to larger x. Behind its face the
  /// piston state is returned.
  [[nodiscard]] ElasticPlasticState at(double x, double time) const;

private:
  Material material_;
  ElasticPlasticState ahead_;
  ElasticPlasticState yield_{};
  ElasticPlasticState piston_{};
  PistonRegime regime_ = PistonRegime::two_wave;
  double elastic_speed_ = 0.0;
  double plastic_speed_ = 0.0;
};

} // namespace ballast::exact
