#pragma once

/// Collapse of a thick shell, rigid and perfectly plastic (Mises), incompressible: every r0 moves to r with
/// r^n = r0^n - (R0^n - R^n), n = 2 (cylinder, plane strain) or 3 (sphere), speed V (R/r)^(n-1). It stops where the plastic work
///   W = int_V0 Y e dV0,   e = 2/sqrt(3) ln(r0/r) (cylinder), 2 ln(r0/r) (sphere),
/// has taken the kinetic energy 1/2 rho int u^2 dV0. With the elastic range kept (shear modulus G, log strain) the energy by volume is 3/2 G e^2
/// up to e = Y/3G and Y e - Y^2/6G beyond: the radius of largest collapse, before the shell springs back.
/// Cylinder: Verney, in Behaviour of Dense Media under High Dynamic Pressures (1968); sphere: Howell & Ball, J. Comput. Phys. 175
/// (2002) 128. SI.

namespace ballast::exact {

struct Shell {
  bool sphere = false;
  double inner = 0.08, outer = 0.1; ///< m, at t = 0
  double density = 1845;            ///< kg/m3
  double yield = 330e6;             ///< Pa
  double shear_modulus = 0;         ///< Pa, 0: rigid
};

/// Inner radius (m) where it stops; `speed`: inward, of the inner surface at t = 0.
[[nodiscard]] double stopping_radius(const Shell& shell, double speed);

/// Outer radius (m) when the inner one is `inner`.
[[nodiscard]] double outer_radius(const Shell& shell, double inner);

} // namespace ballast::exact
