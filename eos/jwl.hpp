// Jones-Wilkins-Lee equation of state of detonation products.
//
//   p = A (1 - w/(R1 V)) exp(-R1 V) + B (1 - w/(R2 V)) exp(-R2 V) + w rho e,   V = rho0 / rho.
// Lee, Hornig, Kury, UCRL-50422 (1968). The products are there from the start (no burn): a charge holds
// its energy `detonation_energy` at rho0 and starts at the pressure of an explosion at constant volume.
// Without one the scene's ambient pressure sets the energy, as for any other material.
// c^2 is exact. Far expanded it tends to the ideal gas w rho e. The two exponentials cost twice what
// Mie-Grueneisen does (eos/row_exp). Known flaw: at e below the energy of the cold curve c^2 may be negative.
#pragma once

#include "eos/row_exp.hpp"

namespace ballast {

struct Jwl {
  double rho0 = 1630;          ///< of the unreacted explosive, kg/m3
  double A = 0, B = 0;         ///< Pa
  double R1 = 4, R2 = 1;       ///< dimensionless
  double omega = 0.3;          ///< Grueneisen parameter of the products
  double detonation_energy = 0; ///< at rho0, J/kg; 0: by the ambient pressure

  [[gnu::always_inline]] double pressure(double rho, double e) const {
    const Curve c = curve(rho);
    return c.p + omega * rho * e;
  }
  [[gnu::always_inline]] double sound_speed_squared(double rho, double e) const {
    const Curve c = curve(rho);
    return c.dp + omega * e + omega * (c.p + omega * rho * e) / rho;
  }
  double energy(double rho, double p) const { return (p - curve(rho).p) / (omega * rho); }

private:
  struct Curve {
    double p, dp; // pressure at e = 0 and its derivative by density
  };
  [[gnu::always_inline]] Curve curve(double rho) const {
    const double v = rho0 / rho, x1 = R1 * v, x2 = R2 * v;
    const double a = A * row_exp(-x1), b = B * row_exp(-x2);
    return {a * (1 - omega / x1) + b * (1 - omega / x2),
            (a * (x1 - omega - omega / x1) + b * (x2 - omega - omega / x2)) / rho};
  }
};

} // namespace ballast
