// Linear bulk: p = p0 + K (rho/rho0 - 1) + gamma0 rho0 e.
//
// With gamma0 = 0 (default) the pressure depends on density alone. Mass, momentum and total energy are
// conserved as by any other material: the work goes into e, which then only keeps the books, and shock heat
// does not push back. A scene sets p0 to its ambient pressure, so that the material rests there with e = 0.
// c^2 = K/rho0 + gamma0 p rho0/rho^2: constant for gamma0 = 0, in tension too. No pressure can be asked of the
// energy then: energy() gives 0. For acoustics and small strains.
#pragma once

namespace ballast {

struct LinearBulk {
  double rho0 = 1000;  ///< kg/m3
  double K = 2.2e9;    ///< Pa
  double gamma0 = 0;   ///< Grueneisen parameter; 0: barotropic
  double p0 = 0;       ///< pressure at rho0 and e = 0, Pa

  [[gnu::always_inline]] double pressure(double rho, double e) const {
    return p0 + K * (rho / rho0 - 1) + gamma0 * rho0 * e;
  }
  [[gnu::always_inline]] double sound_speed_squared(double rho, double e) const {
    return K / rho0 + gamma0 * rho0 * pressure(rho, e) / (rho * rho);
  }
  double energy(double rho, double p) const {
    return gamma0 > 0 ? (p - p0 - K * (rho / rho0 - 1)) / (gamma0 * rho0) : 0.0;
  }
};

} // namespace ballast
