#include "ale/corner_force.hpp"
#include "core/hex_geometry.hpp"

#include <cmath>

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
  }
  pressure = b.pressure.row(r);
  modulus = b.modulus.row(r);
  volume = b.volume.row(r);
  density = b.density.row(r);
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

/// Four times the mid line of an axis: from the centre of its low to that of its high face.
struct MidLine {
  double x, y, z;
};
[[gnu::always_inline]] inline MidLine mid_line(const HexGeometry& h, const int (&high)[4], const int (&low)[4]) {
  MidLine t{0, 0, 0};
#pragma GCC unroll 4
  for (int q = 0; q < 4; ++q) {
    t.x += h.x[high[q]] - h.x[low[q]];
    t.y += h.y[high[q]] - h.y[low[q]];
    t.z += h.z[high[q]] - h.z[low[q]];
  }
  return t;
}
template <bool Strength>
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

  const MidLine t0 = mid_line(g, {1, 2, 5, 6}, {0, 3, 4, 7});
  const MidLine t1 = mid_line(g, {3, 2, 7, 6}, {0, 1, 4, 5});
  const MidLine t2 = mid_line(g, {4, 5, 6, 7}, {0, 1, 2, 3});
  const MidLine direction[3] = {t0, t1, t2};
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const MidLine& a = direction[d];
    const double q = in.viscosity[d][i] / (a.x * a.x + a.y * a.y + a.z * a.z);
    xx -= q * a.x * a.x;
    yy -= q * a.y * a.y;
    zz -= q * a.z * a.z;
    xy -= q * a.x * a.y;
    yz -= q * a.y * a.z;
    xz -= q * a.x * a.z;
  }
  if constexpr (Strength) {
    double gxx = 0, gyy = 0, gzz = 0, gxy = 0, gyz = 0, gxz = 0;
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      gxx += ux[p] * h.sx[p];
      gyy += uy[p] * h.sy[p];
      gzz += uz[p] * h.sz[p];
      gxy += ux[p] * h.sy[p] + uy[p] * h.sx[p];
      gyz += uy[p] * h.sz[p] + uz[p] * h.sy[p];
      gxz += ux[p] * h.sz[p] + uz[p] * h.sx[p];
    }
    const double mean = (gxx + gyy + gzz) / 3, gm = in.shear[i] * c.dt / h.volume;
    const double sxx = in.stress[0][i] + gm * (gxx - mean), syy = in.stress[1][i] + gm * (gyy - mean);
    const double sxy = in.stress[2][i] + 0.5 * gm * gxy, syz = in.stress[3][i] + 0.5 * gm * gyz;
    const double sxz = in.stress[4][i] + 0.5 * gm * gxz;
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
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    h.fx[p] = -(xx * h.sx[p] + xy * h.sy[p] + xz * h.sz[p]);
    h.fy[p] = -(xy * h.sx[p] + yy * h.sy[p] + yz * h.sz[p]);
    h.fz[p] = -(xz * h.sx[p] + yz * h.sy[p] + zz * h.sz[p]);
  }
  static constexpr double mode[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1}, {1, -1, -1, 1, -1, 1, 1, -1},
                                        {1, -1, 1, -1, 1, -1, 1, -1}, {-1, 1, -1, 1, 1, -1, 1, -1}};
  const double per_volume = 1 / h.volume;
  // Mean edge length from the mid lines (a cube root would not vectorise).
  const double edges = (t0.x * t0.x + t0.y * t0.y + t0.z * t0.z + t1.x * t1.x + t1.y * t1.y + t1.z * t1.z +
                        t2.x * t2.x + t2.y * t2.y + t2.z * t2.z) *
                       (1.0 / 48);
  const double drag = c.hourglass * in.density[i] * in.wave_speed[i] * in.volume[i] / std::sqrt(edges);
#pragma GCC unroll 4
  for (int m = 0; m < 4; ++m) {
    double gx = 0, gy = 0, gz = 0;
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      gx += mode[m][p] * g.x[p];
      gy += mode[m][p] * g.y[p];
      gz += mode[m][p] * g.z[p];
    }
    gx *= per_volume;
    gy *= per_volume;
    gz *= per_volume;
    double gamma[8], hx = 0, hy = 0, hz = 0;
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      gamma[p] = mode[m][p] - (h.sx[p] * gx + h.sy[p] * gy + h.sz[p] * gz);
      hx += gamma[p] * ux[p];
      hy += gamma[p] * uy[p];
      hz += gamma[p] * uz[p];
    }
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      h.fx[p] -= drag * hx * gamma[p];
      h.fy[p] -= drag * hy * gamma[p];
      h.fz[p] -= drag * hz * gamma[p];
    }
  }
}

template <bool Strength>
void force_row(const ForceRows<3>& rows, const ForceCoefficients& c, int count, const CornerRows<3>& rows_out) {
  const ForceRows<3> in = rows;
  const CornerRows<3> out = rows_out;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    HalfStepHex h;
    half_step<Strength>(in, c, i, h);
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      out.f[p][0][i] = h.fx[p];
      out.f[p][1][i] = h.fy[p];
      out.f[p][2][i] = h.fz[p];
    }
  }
}

template <bool Strength>
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
    half_step<Strength>(in, c, i, h);
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

} // namespace

template <>
void corner_forces<3>(const Block<3>& block,
                      const ForceRows<3>& in,
                      const ForceCoefficients& c,
                      int count,
                      const CornerRows<3>& out) {
  block.any_strength() ? force_row<true>(in, c, count, out) : force_row<false>(in, c, count, out);
}

template <>
void corner_work<3>(const Block<3>& block,
                    const ForceRows<3>& in,
                    const double* const (&next)[3][4],
                    const ForceCoefficients& c,
                    int count,
                    const WorkRows<3>& out) {
  block.any_strength() ? work_row<true>(in, next, c, count, out)
                       : work_row<false>(in, next, c, count, out);
}

} // namespace ballast
