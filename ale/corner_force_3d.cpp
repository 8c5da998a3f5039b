#include "ale/corner_force.hpp"
#include "ale/shear_viscosity.hpp"
#include "core/hex_geometry.hpp"

#include <cmath>
#include <type_traits>

namespace ballast {

template <> ForceRows<3>::ForceRows(const Block<3>& b, int j, int k) {
  const Grid& g = b.grid;
  const int r = g.cell_row(j, k);
  for (std::size_t d = 0; d < 3; ++d) {
    for (int line = 0; line < 4; ++line) {
      const int nodes = g.node_row(j + (line & 1), k + (line >> 1));
      x[d][line] = b.position[d].row(nodes);
      u[d][line] = b.velocity[d].row(nodes);
    }
    viscosity[d] = b.viscosity[d].row(r);
    rate[d] = b.strain_rate[d].row(r);
  }
  skew[0] = skew[1] = nullptr;
  pressure = b.pressure.row(r);
  modulus = b.modulus.row(r);
  volume = b.volume.row(r);
  damped_density = (b.any_sliding() ? b.damped_density : b.density).row(r);
  wave_speed = b.wave_speed.row(r);
  for (std::size_t s = 0; s < 5; ++s) {
    stress[s] = b.any_strength() ? b.stress[s].row(r) : nullptr;
  }
  shear = b.any_strength() ? b.shear.row(r) : nullptr;
  flow_stress = b.any_strength() ? b.flow_stress.row(r) : nullptr;
}

namespace {

constexpr int line_of[8] = {0, 0, 1, 1, 2, 2, 3, 3}; // node row of a corner
constexpr int step_of[8] = {0, 1, 1, 0, 0, 1, 1, 0}; // and its offset along i

struct HalfStepHex {
  double sx[8], sy[8], sz[8], fx[8], fy[8], fz[8];
  double volume, compression;
};

template <bool Strength, bool ShearQ>
[[gnu::always_inline]] inline void
half_step(const ForceRows<3>& in, const ForceCoefficients& c, int i, HalfStepHex& h) {
  const double half = 0.5 * c.dt;
  HexGeometry g;
  double ux[8], uy[8], uz[8];
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    const int l = line_of[p], s = i + step_of[p];
    ux[p] = in.u[0][l][s];
    uy[p] = in.u[1][l][s];
    uz[p] = in.u[2][l][s];
    g.x[p] = in.x[0][l][s] + half * ux[p];
    g.y[p] = in.x[1][l][s] + half * uy[p];
    g.z[p] = in.x[2][l][s] + half * uz[p];
  }
  g.gradient(h.sx, h.sy, h.sz);
  h.volume = g.volume(h.sx);
  h.compression = (h.volume - in.volume[i]) / in.volume[i];
  const double p_half = in.pressure[i] - in.modulus[i] * h.compression;
  double xx = -p_half, yy = -p_half, zz = -p_half, xy = 0, yz = 0, xz = 0;

  const HexModes mx = hex_modes(g.x), my = hex_modes(g.y), mz = hex_modes(g.z);
  const double along[3][3] = {{mx.xi, my.xi, mz.xi}, {mx.eta, my.eta, mz.eta}, {mx.zeta, my.zeta, mz.zeta}};
  double edges = 0; // mean squared edge length x 48 (a cube root of the volume would not vectorise)
  // Velocity gradient times volume, du_a/dx_b.
  double lxx = 0, lxy = 0, lxz = 0, lyx = 0, lyy = 0, lyz = 0, lzx = 0, lzy = 0, lzz = 0;
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    lxx += ux[p] * h.sx[p];
    lxy += ux[p] * h.sy[p];
    lxz += ux[p] * h.sz[p];
    lyx += uy[p] * h.sx[p];
    lyy += uy[p] * h.sy[p];
    lyz += uy[p] * h.sz[p];
    lzx += uz[p] * h.sx[p];
    lzy += uz[p] * h.sy[p];
    lzz += uz[p] * h.sz[p];
  }
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const double ax = along[d][0], ay = along[d][1], az = along[d][2], squared = ax * ax + ay * ay + az * az;
    edges += squared;
    const double rate = ax * (lxx * ax + (lxy + lyx) * ay) + ay * (lyy * ay + (lyz + lzy) * az) + az * (lzz * az + (lxz + lzx) * ax);
    const double some = in.viscosity[d][i] / squared, q = rate < 0 ? some : 0.0; // never against what it resists
    xx -= q * ax * ax;
    yy -= q * ay * ay;
    zz -= q * az * az;
    xy -= q * ax * ay;
    yz -= q * ay * az;
    xz -= q * ax * az;
  }
  if constexpr (ShearQ) {
    const double part = in.damped_density[i] > 0 ? c.shear_q / h.volume : 0.0; // where two velocities meet shear is sliding
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d) {
      const int o = d == 2 ? 0 : d + 1;
      const double ax = along[d][0], ay = along[d][1], az = along[d][2], bx = along[o][0], by = along[o][1], bz = along[o][2];
      const double s0 = ax * ax + ay * ay + az * az, s1 = bx * bx + by * by + bz * bz;
      const double mu = shear_coefficient(viscous_coefficient(in.viscosity[d][i], in.rate[d][i]),
                                          viscous_coefficient(in.viscosity[o][i], in.rate[o][i]), s0, s1);
      const double vx = 2 * lxx * bx + (lxy + lyx) * by + (lxz + lzx) * bz, vy = (lxy + lyx) * bx + 2 * lyy * by + (lyz + lzy) * bz;
      const double vz = (lxz + lzx) * bx + (lyz + lzy) * by + 2 * lzz * bz;
      const double tau = part * mu * (ax * vx + ay * vy + az * vz) / (s0 * s1);
      xx += 2 * tau * ax * bx;
      yy += 2 * tau * ay * by;
      zz += 2 * tau * az * bz;
      xy += tau * (ax * by + ay * bx);
      yz += tau * (ay * bz + az * by);
      xz += tau * (ax * bz + az * bx);
    }
  }
  if constexpr (Strength) {
    const double mean = (lxx + lyy + lzz) / 3, gm = in.shear[i] * c.dt / h.volume;
    const double sxx = in.stress[0][i] + gm * (lxx - mean), syy = in.stress[1][i] + gm * (lyy - mean);
    const double sxy = in.stress[2][i] + 0.5 * gm * (lxy + lyx), syz = in.stress[3][i] + 0.5 * gm * (lyz + lzy);
    const double sxz = in.stress[4][i] + 0.5 * gm * (lxz + lzx);
    const double squared = 3 * (sxx * sxx + syy * syy + sxx * syy + sxy * sxy + syz * syz + sxz * sxz);
    const double flow = in.flow_stress[i];
    const double cut = squared > flow * flow ? flow / std::sqrt(squared) : 1.0;
    xx += cut * sxx;
    yy += cut * syy;
    zz -= cut * (sxx + syy);
    xy += cut * sxy;
    yz += cut * syz;
    xz += cut * sxz;
  }
  // Hourglass: gamma_m = mode_m - S.g_m with g_m = sum mode_m x / V. Summed over the corners, the part with S is
  // a (not symmetric) stress, and the modes' sums are butterflies.
  const HexModes mu = hex_modes(ux), mv = hex_modes(uy), mw = hex_modes(uz);
  const double per_volume = 1 / h.volume;
  const double drag = c.hourglass * in.damped_density[i] * in.wave_speed[i] * in.volume[i] / std::sqrt(edges * (1.0 / 48));
  double txx = xx, txy = xy, txz = xz, tyx = xy, tyy = yy, tyz = yz, tzx = xz, tzy = yz, tzz = zz;
  double hx[4], hy[4], hz[4];
#pragma GCC unroll 4
  for (int m = 0; m < 4; ++m) {
    const double gx = mx.hourglass[m] * per_volume, gy = my.hourglass[m] * per_volume, gz = mz.hourglass[m] * per_volume;
    hx[m] = drag * (mu.hourglass[m] - (lxx * gx + lxy * gy + lxz * gz));
    hy[m] = drag * (mv.hourglass[m] - (lyx * gx + lyy * gy + lyz * gz));
    hz[m] = drag * (mw.hourglass[m] - (lzx * gx + lzy * gy + lzz * gz));
    txx -= hx[m] * gx;
    txy -= hx[m] * gy;
    txz -= hx[m] * gz;
    tyx -= hy[m] * gx;
    tyy -= hy[m] * gy;
    tyz -= hy[m] * gz;
    tzx -= hz[m] * gx;
    tzy -= hz[m] * gy;
    tzz -= hz[m] * gz;
  }
  double bx[8], by[8], bz[8];
  hourglass_at_corners(hx, bx);
  hourglass_at_corners(hy, by);
  hourglass_at_corners(hz, bz);
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    h.fx[p] = -(txx * h.sx[p] + txy * h.sy[p] + txz * h.sz[p] + bx[p]);
    h.fy[p] = -(tyx * h.sx[p] + tyy * h.sy[p] + tyz * h.sz[p] + by[p]);
    h.fz[p] = -(tzx * h.sx[p] + tzy * h.sy[p] + tzz * h.sz[p] + bz[p]);
  }
}

template <bool Strength, bool ShearQ>
void force_row(const ForceRows<3>& rows, const ForceCoefficients& c, int count, const CornerRows<3>& rows_out) {
  const ForceRows<3> in = rows;
  const CornerRows<3> out = rows_out;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    HalfStepHex h;
    half_step<Strength, ShearQ>(in, c, i, h);
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      out.f[p][0][i] = h.fx[p];
      out.f[p][1][i] = h.fy[p];
      out.f[p][2][i] = h.fz[p];
    }
  }
}

template <bool Strength, bool ShearQ>
void work_row(const ForceRows<3>& rows,
              const double* const (&next)[3][4],
              const ForceCoefficients& c,
              int count,
              const WorkRows<3>& rows_out) {
  const ForceRows<3> in = rows;
  const WorkRows<3> out = rows_out;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    HalfStepHex h;
    half_step<Strength, ShearQ>(in, c, i, h);
    double swept = 0, work = 0, g[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      const int l = line_of[p], s = i + step_of[p];
      const double dx = 0.5 * c.dt * (in.u[0][l][s] + next[0][l][s]);
      const double dy = 0.5 * c.dt * (in.u[1][l][s] + next[1][l][s]);
      const double dz = 0.5 * c.dt * (in.u[2][l][s] + next[2][l][s]);
      swept += h.sx[p] * dx + h.sy[p] * dy + h.sz[p] * dz;
      work -= h.fx[p] * dx + h.fy[p] * dy + h.fz[p] * dz;
      if constexpr (Strength) {
        g[0] += dx * h.sx[p];
        g[1] += dx * h.sy[p];
        g[2] += dx * h.sz[p];
        g[3] += dy * h.sx[p];
        g[4] += dy * h.sy[p];
        g[5] += dy * h.sz[p];
        g[6] += dz * h.sx[p];
        g[7] += dz * h.sy[p];
        g[8] += dz * h.sz[p];
      }
    }
    out.swept_volume[i] = swept;
    out.compression[i] = h.compression;
    out.work[i] = work;
    if constexpr (Strength) {
      const double per_volume = 1 / h.volume;
#pragma GCC unroll 9
      for (int q = 0; q < 9; ++q) {
        out.gradient[q][i] = g[q] * per_volume;
      }
    }
  }
}

template <class Function> void dispatch(const Block<3>& b, const ForceCoefficients& c, Function&& f) {
  using std::false_type, std::true_type;
  if (c.shear_q > 0) {
    b.any_strength() ? f(true_type{}, true_type{}) : f(false_type{}, true_type{});
  } else {
    b.any_strength() ? f(true_type{}, false_type{}) : f(false_type{}, false_type{});
  }
}

} // namespace

template <>
void corner_forces<3>(const Block<3>& block,
                      const ForceRows<3>& in,
                      const ForceCoefficients& c,
                      int count,
                      const CornerRows<3>& out) {
  dispatch(block, c, [&](auto strength, auto shear_q) { force_row<strength.value, shear_q.value>(in, c, count, out); });
}

template <>
void corner_work<3>(const Block<3>& block,
                    const ForceRows<3>& in,
                    const double* const (&next)[3][4],
                    const ForceCoefficients& c,
                    int count,
                    const WorkRows<3>& out) {
  dispatch(block, c, [&](auto strength, auto shear_q) { work_row<strength.value, shear_q.value>(in, next, c, count, out); });
}

} // namespace ballast
