// Pressures of a quadrilateral's four subzones (numerics.subzonal_pressure): what restores a cell that hourglass motion has distorted,
// where the viscous control only slows it. Caramana and Shashkov, J. Comput. Phys. 142 (1998) 521, by modes.
//
// Mid lines cut the cell in quarters of volume V_p = A / 4 (1 + s_p a + s'_p b), s, s' the corner's signs along i and j,
//   a = t0 x h / (2 t0 x t1),  b = h x t1 / (2 t0 x t1),  h = x0 - x1 + x2 - x3.
// Each keeps its share of the mass, v0_p of the first mesh: its pressure differs from the cell's by dp_p = merit K (v0_p / v_p - 1), and
// F_q = sum_p dp_p dV_p/dx_q, the exact gradient, times the depth V / A in RZ (planar quarters: a linear motion changes no v_p, and feels
// no force in RZ either). The forces of a cell sum to zero, the work pass takes their work from the cell. At the first mesh dp is zero to
// the bit. v_p in the denominator is not below 0.3: c / (L v), the frequency, stays in the step's limit at CFL 0.5.
#pragma once

namespace ballast {

/// Mid lines t0, t1 and hourglass vector h of a quadrilateral, each four times that of the map on [-1, 1]^2.
struct QuadModes {
  double t0x, t0y, t1x, t1y, hx, hy;

  double cross() const { return t0x * t1y - t0y * t1x; }
  double along_i() const { return 0.5 * (t0x * hy - t0y * hx) / cross(); } ///< a
  double along_j() const { return 0.5 * (hx * t1y - hy * t1x) / cross(); } ///< b
};

[[gnu::always_inline]] inline QuadModes quad_modes(const double (&x)[4], const double (&y)[4]) {
  return {(x[1] - x[0]) + (x[2] - x[3]), (y[1] - y[0]) + (y[2] - y[3]), (x[3] - x[0]) + (x[2] - x[1]), (y[3] - y[0]) + (y[2] - y[1]),
          (x[0] - x[3]) + (x[2] - x[1]), (y[0] - y[3]) + (y[2] - y[1])};
}

/// Forces (N) of a cell's subzones on its modes: corner p feels (s, s', s s').(i, j, skew), s and s' its signs along i and j.
struct SubzonalForce {
  double ix, iy, jx, jy, skew_x, skew_y;
};

/// dp / K of the quarter with signs s, z, at `a`, `b` beyond the first mesh.
[[gnu::always_inline]] inline double quarter_pressure(double s, double z, double a, double b, double da, double db) {
  const double v = 1 + (s * a + z * b);
  return -(s * da + z * db) / (v > 0.3 ? v : 0.3);
}

/// `stiffness` merit K times depth (N/m); a0, b0 of the first mesh.
[[gnu::always_inline]] inline SubzonalForce subzonal_force(const QuadModes& m, double stiffness, double a0, double b0) {
  const double a = m.along_i(), b = m.along_j(), da = a - a0, db = b - b0, k = stiffness * (1.0 / 16);
  const double p0 = k * quarter_pressure(-1, -1, a, b, da, db), p1 = k * quarter_pressure(1, -1, a, b, da, db);
  const double p2 = k * quarter_pressure(1, 1, a, b, da, db), p3 = k * quarter_pressure(-1, 1, a, b, da, db);
  // 16 sum dp V = sum t0 x t1 + pi t0 x h + pj h x t1, by t0, t1 and h.
  const double sum = (p0 + p2) + (p1 + p3), pi = 0.5 * ((p1 + p2) - (p0 + p3)), pj = 0.5 * ((p2 + p3) - (p0 + p1));
  return {sum * m.t1y + pi * m.hy, -(sum * m.t1x + pi * m.hx), -(sum * m.t0y + pj * m.hy), sum * m.t0x + pj * m.hx,
          pj * m.t1y - pi * m.t0y, pi * m.t0x - pj * m.t1x};
}

} // namespace ballast
