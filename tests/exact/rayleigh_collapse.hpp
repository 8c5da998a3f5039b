#pragma once

/// Rayleigh's collapse of an empty spherical cavity in an incompressible liquid at pressure p far away:
///   kinetic energy 2 pi rho R^3 R'^2 = work of the pressure, so R'^2 = (2 p / 3 rho) ((R0/R)^3 - 1);
///   whole time 0.91468 R0 sqrt(rho/p).
/// Reference: Lord Rayleigh, Phil. Mag. 34 (1917) 94. SI.

namespace ballast::exact {

/// Time (s) until the radius has fallen from `radius` (m) to `share` of it, 0 <= share <= 1; pressure in Pa, density in kg/m3.
[[nodiscard]] double rayleigh_time(double radius, double pressure, double density, double share);

} // namespace ballast::exact
