// Shear and hoop parts of the artificial viscosity (numerics.shear_q): where q resists the compression of a mid line, its coefficient
// mu_d = q_d / |e_d| (Pa s) resists the shear between mid lines, and in RZ the hoop compression, as well, as in Newton's fluid.
//
// Along mid lines alone a shock that runs along a row of cells has no tie to the rows beside it: a column that lags or leads grows into a
// jet (the carbuncle). Near an axis of symmetry sigma_rr without sigma_tt = sigma_rr pulls by (sigma_rr - sigma_tt) / r. The stress is
//   sigma = 2 f mu (t0.D.t1) (t0 t1 + t1 t0),  mu the larger of the two axes' mu_d min(1, (L' / L_d)^2),  |t| = 1,
//   sigma_tt = f mu e_tt, compression only, at most the sum of the axes' q.
// It takes energy (sigma:D = 4 f mu (t0.D.t1)^2) and vanishes with q: at rest, in expansion, in smooth compression, in rigid motion.
// With f <= 1 no mode of a cell is damped faster than by q alone (one-point gradients: kx^2 + ky^2 + |kx ky| <= 1 for kx = sin a cos b,
// ky = cos a sin b); in cells longer than wide the factor (L' / L)^2 keeps it so. The step needs no other limit.
// After Kolev and Rieben, J. Comput. Phys. 228 (2009) 8336; Campbell and Shashkov, J. Comput. Phys. 172 (2001) 739.
#pragma once

namespace ballast {

/// Coefficient of one axis, Pa s: its q over the rate of compression (1/s); zero where nothing is compressed.
[[gnu::always_inline]] inline double viscous_coefficient(double q, double rate) { return rate < 0 ? q / -rate : 0.0; }

/// Coefficient of the shear between two mid lines of squared lengths s0, s1: the larger of the axes', each by at most the square of the
/// ratio of the lengths.
[[gnu::always_inline]] inline double shear_coefficient(double mu0, double mu1, double s0, double s1) {
  const double m0 = mu0 * (s1 < s0 ? s1 / s0 : 1.0), m1 = mu1 * (s0 < s1 ? s0 / s1 : 1.0);
  return m0 > m1 ? m0 : m1;
}

/// Hoop stress's q (Pa): coefficients and q of the two axes, rate u_r / r (1/s).
[[gnu::always_inline]] inline double hoop_viscosity(double mu, double rate, double most) {
  const double q = rate < 0 ? -mu * rate : 0.0;
  return q < most ? q : most;
}

} // namespace ballast
