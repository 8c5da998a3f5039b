// Mie-Grueneisen on a cubic Us-up Hugoniot: Us = c0 + s1 up + s2 (up/Us) up + s3 (up/Us)^2 up.
//
// With eta = up/Us = 1 - rho0/rho this is Us = c0/D, D = 1 - s1 eta - s2 eta^2 - s3 eta^3. Compression:
//   p = pH + Gamma rho (e - eH),  pH = rho0 c0^2 eta / D^2,  eH = pH eta / (2 rho0),
//   Gamma rho = rho0 (gamma0 + b mu),  mu = rho/rho0 - 1.
// That is *EOS_GRUNEISEN of LS-DYNA and Steinberg's form (UCRL-MA-106439, 1996) to the letter; b = 0 keeps
// Gamma rho constant, b = gamma0 keeps Gamma. Tension (rho < rho0): pH = rho0 c0^2 mu, eH = 0, Gamma constant
// (LS-DYNA: Gamma rho; hot matter that has expanded would then press as hard at any density);
// pressure and sound speed are continuous at rho0 for e = 0.
// Known flaw: where D or the slope of pH vanishes the fit ends (lead: at eta = 0.76, four times its
// density); sound speed squared is huge or negative there and the step stops.
#pragma once

namespace ballast {

struct CubicGruneisen {
  double rho0 = 1000;             ///< kg/m3
  double c0 = 1500;               ///< m/s
  double s1 = 1.5, s2 = 0, s3 = 0; ///< dimensionless
  double gamma0 = 1;              ///< Grueneisen parameter at rho0
  double b = 0;                   ///< its first-order volume correction

  [[gnu::always_inline]] double pressure(double rho, double e) const {
    const Curve h = curve(rho);
    return h.p + h.g * (e - h.e);
  }
  [[gnu::always_inline]] double sound_speed_squared(double rho, double e) const {
    const Curve h = curve(rho);
    const double p = h.p + h.g * (e - h.e);
    return h.dp - h.g * h.de + h.dg * (e - h.e) + p / (rho * rho) * h.g;
  }
  double energy(double rho, double p) const {
    const Curve h = curve(rho);
    return h.e + (p - h.p) / h.g;
  }

private:
  struct Curve {
    double p, e, g, dp, de, dg; // Hugoniot and Gamma rho with their derivatives by density
  };
  [[gnu::always_inline]] Curve curve(double rho) const {
    const double eta = 1 - rho0 / rho, mu = rho / rho0 - 1, k0 = rho0 * c0 * c0;
    const double d = 1 - eta * (s1 + eta * (s2 + eta * s3));
    const double steepness = eta * (s1 + eta * (2 * s2 + 3 * eta * s3)); // -eta dD/d eta
    const double i = 1 / d, ph = k0 * eta * i * i, dph = k0 * (d + 2 * steepness) * i * i * i;
    const double eta_rho = rho0 / (rho * rho);
    const bool tension = eta < 0;
    // Plain selections of values, so that rows vectorise.
    const double p_pull = k0 * mu, e_push = 0.5 * ph * eta / rho0, g_push = rho0 * (gamma0 + b * mu);
    const double dp_push = dph * eta_rho, de_push = 0.5 * (dph * eta + ph) / rho0 * eta_rho;
    const double p = tension ? p_pull : ph, e = tension ? 0.0 : e_push;
    const double dp = tension ? c0 * c0 : dp_push, de = tension ? 0.0 : de_push;
    const double g_pull = rho * gamma0, g = tension ? g_pull : g_push, dg = tension ? gamma0 : b;
    return {p, e, g, dp, de, dg};
  }
};

} // namespace ballast
