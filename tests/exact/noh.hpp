#pragma once

#include "tests/exact/flow_state.hpp"

/// Noh's implosion: a cold ideal gas (p = 0, e = 0) falls with uniform speed on the origin (planar:
/// on a wall) and a shock of constant speed runs out.
///   shock speed (gamma - 1) u0 / 2; behind it u = 0, e = u0^2 / 2,
///   rho = rho0 ((gamma + 1)/(gamma - 1))^j; ahead rho = rho0 (1 + u0 t / r)^(j - 1).
/// Reference: W. F. Noh, J. Comput. Phys. 72 (1987) 78. Units: any consistent set.

namespace ballast::exact {

struct Noh {
  Geometry geometry = Geometry::planar;
  double gamma = 5.0 / 3.0;
  double density = 1.0;      ///< uniform at t = 0
  double inflow_speed = 1.0; ///< positive, towards the origin
};

[[nodiscard]] double shock_speed(const Noh& problem);

/// State at radius > 0 and time > 0; velocity is radial, positive outwards.
[[nodiscard]] FlowState state_at(const Noh& problem, double radius, double time);

} // namespace ballast::exact
