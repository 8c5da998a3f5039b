#pragma once

#include "tests/exact/flow_state.hpp"
#include "tests/exact/linear_hugoniot.hpp"

/// Impact of two half-spaces without strength: a flyer (left, moving right) on a target at rest.
/// Impedance matching: with u the interface velocity,
///   rho_f (c_f + s_f (V - u)) (V - u) = rho_t (c_t + s_t u) u,
/// and behind each shock p = rho0 U_s u_p, rho = rho0 U_s / (U_s - u_p), e = u_p^2 / 2.
/// Both sides start at p = 0, e = 0; then the Grueneisen law does not enter before the release.
/// Reference: Meyers, Dynamic Behavior of Materials (1994), ch. 4. Units: SI.

namespace ballast::exact {

/// The shocked states and the laboratory velocities of the two shocks and the interface.
struct ImpactStates {
  double velocity;              ///< of the interface
  double pressure;              ///< at the interface
  double flyer_shock_speed;     ///< relative to the unshocked flyer, positive
  double flyer_shock_velocity;  ///< laboratory; negative runs left
  double target_shock_velocity; ///< laboratory
  double flyer_density;
  double target_density;
  double flyer_energy; ///< specific internal energy, J/kg
  double target_energy;
};

class PlateImpact {
public:
  /// Throws std::invalid_argument unless impact_speed > 0.
  PlateImpact(const LinearHugoniot& flyer, const LinearHugoniot& target, double impact_speed);

  [[nodiscard]] const ImpactStates& states() const { return states_; }

  /// State on the ray x/t, x measured from the interface at impact; valid until a release arrives.
  [[nodiscard]] FlowState at(double x_over_t) const;

private:
  double flyer_reference_density_;
  double target_reference_density_;
  double impact_speed_;
  ImpactStates states_;
};

/// Velocity of a free surface after a shock of particle velocity `particle_velocity` (first
/// release, to p = 0 along the isentrope): u_fs = u_p + int dp / (rho c), de = p / rho^2 d rho,
/// by Runge-Kutta (converged to 1e-12). Close to 2 u_p. The release ends in a hot expanded state,
/// so the choice of p_H below rho0 (linear_hugoniot.hpp) enters.
[[nodiscard]] double
free_surface_velocity(const LinearHugoniot& material, GruneisenLaw law, double particle_velocity);

} // namespace ballast::exact
