#pragma once

/// Impact of two half-spaces without strength whose shocks follow a cubic law (SI),
///   Us = c0 + s1 u + s2 (u/Us) u + s3 (u/Us)^2 u,  that is  u = c0 eta / (1 - s1 eta - s2 eta^2 - s3 eta^3),
/// eta = u/Us = 1 - rho0/rho. Behind a shock from p = 0, e = 0: p = rho0 Us u, e = u^2/2. Impedance matching
/// as in mie_gruneisen_impact.hpp, which is the case s2 = s3 = 0. Reference: Steinberg, UCRL-MA-106439 (1996).

namespace ballast::exact {

struct CubicHugoniot {
  double density, sound_speed, s1, s2, s3;
};

struct ShockedState {
  double velocity, shock_speed, pressure, density, energy; ///< shock speed relative to the unshocked material
};

/// State behind a shock of particle velocity u > 0. Throws std::invalid_argument where the fit has ended (eta > 0.7).
[[nodiscard]] ShockedState shocked(const CubicHugoniot& material, double u);

struct CubicImpact {
  ShockedState flyer, target; ///< flyer: velocities in its own frame, of a shock running into it
  double velocity = 0;        ///< of the interface, laboratory
};
/// Flyer at `speed` on a target at rest.
[[nodiscard]] CubicImpact cubic_impact(const CubicHugoniot& flyer, const CubicHugoniot& target, double speed);

} // namespace ballast::exact
