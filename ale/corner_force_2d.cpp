#include "ale/corner_force.hpp"
#include "ale/shear_viscosity.hpp"
#include "ale/subzonal_pressure.hpp"
#include "core/hex_geometry.hpp"

#include <cmath>
#include <type_traits>

namespace ballast {

template <> ForceRows<2>::ForceRows(const Block<2>& b, int j, int k) {
  const Grid& g = b.grid;
  for (std::size_t d = 0; d < 2; ++d) {
    for (int line = 0; line < 2; ++line) {
      x[d][line] = b.position[d].row(g.node_row(j + line, k));
      u[d][line] = b.velocity[d].row(g.node_row(j + line, k));
    }
    viscosity[d] = b.viscosity[d].row(g.cell_row(j, k));
    rate[d] = b.strain_rate[d].row(g.cell_row(j, k));
    skew[d] = b.skew[d].empty() ? nullptr : b.skew[d].row(g.cell_row(j, k));
  }
  const int r = g.cell_row(j, k);
  pressure = b.pressure.row(r);
  modulus = b.modulus.row(r);
  volume = b.volume.row(r);
  damped_density = (b.any_sliding() ? b.damped_density : b.density).row(r);
  wave_speed = b.wave_speed.row(r);
  for (std::size_t s = 0; s < 3; ++s) {
    stress[s] = b.any_strength() ? b.stress[s].row(r) : nullptr;
  }
  shear = b.any_strength() ? b.shear.row(r) : nullptr;
  flow_stress = b.any_strength() ? b.flow_stress.row(r) : nullptr;
}

namespace {

/// What acts beside pressure, strength, q and the viscous hourglass control.
enum class Extra { none, shear_q, subzones }; // subzones: and shear_q

template <bool Axisymmetric> struct HalfStepQuad {
  double sx[4], sy[4], hoop[4], fx[4], fy[4];
  double volume, compression;
};

/// All of a cell at the half step. Inlined into both row loops.
template <bool Axisymmetric, bool Strength, Extra extra>
[[gnu::always_inline]] inline void
half_step(const ForceRows<2>& in, const ForceCoefficients& c, int i, HalfStepQuad<Axisymmetric>& h) {
  const double half = 0.5 * c.dt;
  const double ux[4] = {in.u[0][0][i], in.u[0][0][i + 1], in.u[0][1][i + 1], in.u[0][1][i]};
  const double uy[4] = {in.u[1][0][i], in.u[1][0][i + 1], in.u[1][1][i + 1], in.u[1][1][i]};
  QuadGeometry<Axisymmetric> q{{in.x[0][0][i], in.x[0][0][i + 1], in.x[0][1][i + 1], in.x[0][1][i]},
                               {in.x[1][0][i], in.x[1][0][i + 1], in.x[1][1][i + 1], in.x[1][1][i]}};
#pragma GCC unroll 4
  for (int p = 0; p < 4; ++p) {
    q.x[p] += half * ux[p];
    q.y[p] += half * uy[p];
  }
  q.gradient(h.sx, h.sy, h.hoop);
  h.volume = q.volume();
  h.compression = (h.volume - in.volume[i]) / in.volume[i];
  const double p_half = in.pressure[i] - in.modulus[i] * h.compression;

  // Directions of the mid lines: t0 along i, t1 along j.
  const double t0x = q.x[1] + q.x[2] - q.x[0] - q.x[3], t0y = q.y[1] + q.y[2] - q.y[0] - q.y[3];
  const double t1x = q.x[3] + q.x[2] - q.x[0] - q.x[1], t1y = q.y[3] + q.y[2] - q.y[0] - q.y[1];
  const double q0 = in.viscosity[0][i] / (t0x * t0x + t0y * t0y);
  const double q1 = in.viscosity[1][i] / (t1x * t1x + t1y * t1y);
  double xx = -p_half - q0 * t0x * t0x - q1 * t1x * t1x;
  double yy = -p_half - q0 * t0y * t0y - q1 * t1y * t1y;
  double xy = -q0 * t0x * t0y - q1 * t1x * t1y;
  double tt = -p_half;
  double gxx = 0, gxy = 0, gyy = 0, gtt = 0;
  if constexpr (Strength || extra != Extra::none) {
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      const double ax = Axisymmetric ? h.sx[p] - h.hoop[p] : h.sx[p];
      gxx += ux[p] * ax;
      gxy += ux[p] * h.sy[p] + uy[p] * ax;
      gyy += uy[p] * h.sy[p];
      if constexpr (Axisymmetric) {
        gtt += ux[p] * h.hoop[p];
      }
    }
  }
  if constexpr (extra != Extra::none) {
    const double s0 = t0x * t0x + t0y * t0y, s1 = t1x * t1x + t1y * t1y;
    const double part = in.damped_density[i] > 0 ? c.shear_q : 0.0; // where two velocities meet shear is sliding
    const double mu0 = viscous_coefficient(in.viscosity[0][i], in.rate[0][i]), mu1 = viscous_coefficient(in.viscosity[1][i], in.rate[1][i]);
    const double shear = t0x * gxx * t1x + 0.5 * gxy * (t0x * t1y + t0y * t1x) + t0y * gyy * t1y; // t0.D.t1 V
    const double tau = 2 * part * shear_coefficient(mu0, mu1, s0, s1) * shear / (h.volume * s0 * s1);
    xx += 2 * tau * t0x * t1x;
    yy += 2 * tau * t0y * t1y;
    xy += tau * (t0x * t1y + t0y * t1x);
    if constexpr (Axisymmetric) {
      const double mu = mu0 * t0x * t0x / s0 + mu1 * t1x * t1x / s1, most = q0 * t0x * t0x + q1 * t1x * t1x; // their radial parts
      tt -= part * hoop_viscosity(mu, gtt / h.volume, most);
    }
  }
  if constexpr (Strength) {
    const double mean = (gxx + gyy + gtt) / 3, g = in.shear[i] * c.dt / h.volume;
    const double sxx = in.stress[0][i] + g * (gxx - mean), syy = in.stress[1][i] + g * (gyy - mean);
    const double sxy = in.stress[2][i] + 0.5 * g * gxy;
    const double squared = 3 * (sxx * sxx + syy * syy + sxx * syy + sxy * sxy); // of the equivalent stress
    const double flow = in.flow_stress[i];
    const double cut = squared > flow * flow ? flow / std::sqrt(squared) : 1.0;
    xx += cut * sxx;
    yy += cut * syy;
    xy += cut * sxy;
    tt -= cut * (sxx + syy);
  }
  // Hourglass mode Gamma = (1, -1, 1, -1), orthogonal to linear fields by the planar gradient.
  const double area = q.area();
  const double gx = q.x[0] - q.x[1] + q.x[2] - q.x[3], gy = q.y[0] - q.y[1] + q.y[2] - q.y[3];
  const double per_area = 0.5 / area;
  double gamma[4], hx = 0, hy = 0;
#pragma GCC unroll 4
  for (int p = 0; p < 4; ++p) {
    const int n = (p + 1) & 3, m = (p + 3) & 3;
    const double sign = p & 1 ? -1.0 : 1.0;
    gamma[p] = sign - (gx * (q.y[n] - q.y[m]) + gy * (q.x[m] - q.x[n])) * per_area;
    hx += gamma[p] * ux[p];
    hy += gamma[p] * uy[p];
  }
  // A mode decays at drag |Gamma|^2 / corner mass = 64 * hourglass c/L in 3D; four corners give 16, hence 4.
  const double drag =
      4 * c.hourglass * in.damped_density[i] * in.wave_speed[i] * in.volume[i] / std::sqrt(area);
#pragma GCC unroll 4
  for (int p = 0; p < 4; ++p) {
    const double ax = Axisymmetric ? h.sx[p] - h.hoop[p] : h.sx[p];
    h.fx[p] = -(xx * ax + xy * h.sy[p]) - drag * hx * gamma[p];
    h.fy[p] = -(xy * ax + yy * h.sy[p]) - drag * hy * gamma[p];
    if constexpr (Axisymmetric) {
      h.fx[p] -= tt * h.hoop[p];
    }
  }
  if constexpr (extra == Extra::subzones) {
    const double all = c.subzonal, damped = in.damped_density[i];
    double merit = damped > 0 ? all : 0.0;
    if constexpr (Strength) {
      const double flow = in.flow_stress[i];
      merit = flow > 0 ? 0.0 : merit;
    }
    const double stiffness = merit * in.modulus[i] * h.volume / area;
    const SubzonalForce f = subzonal_force(quad_modes(q.x, q.y), stiffness, in.skew[0][i], in.skew[1][i]);
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      const double s = p == 1 || p == 2 ? 1.0 : -1.0, z = p > 1 ? 1.0 : -1.0;
      h.fx[p] += s * f.ix + z * f.jx + s * z * f.skew_x;
      h.fy[p] += s * f.iy + z * f.jy + s * z * f.skew_y;
    }
  }
}

template <bool Axisymmetric, bool Strength, Extra extra>
void force_row(const ForceRows<2>& in, const ForceCoefficients& c, int count, const CornerRows<2>& out) {
  double* f[4][2];
  for (int p = 0; p < 4; ++p) {
    f[p][0] = out.f[p][0];
    f[p][1] = out.f[p][1];
  }
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    HalfStepQuad<Axisymmetric> h;
    half_step<Axisymmetric, Strength, extra>(in, c, i, h);
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      f[p][0][i] = h.fx[p];
      f[p][1][i] = h.fy[p];
    }
  }
}

template <bool Axisymmetric, bool Strength, Extra extra>
void work_row(const ForceRows<2>& in,
              const double* const (&next)[2][2],
              const ForceCoefficients& c,
              int count,
              const WorkRows<2>& out) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    HalfStepQuad<Axisymmetric> h;
    half_step<Axisymmetric, Strength, extra>(in, c, i, h);
    double swept = 0, work = 0, g[5] = {0, 0, 0, 0, 0};
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      const int line = p >> 1, s = p == 1 || p == 2 ? 1 : 0;
      const double dx = 0.5 * c.dt * (in.u[0][line][i + s] + next[0][line][i + s]);
      const double dy = 0.5 * c.dt * (in.u[1][line][i + s] + next[1][line][i + s]);
      swept += h.sx[p] * dx + h.sy[p] * dy;
      work -= h.fx[p] * dx + h.fy[p] * dy;
      if constexpr (Strength) {
        const double ax = Axisymmetric ? h.sx[p] - h.hoop[p] : h.sx[p];
        g[0] += dx * ax;
        g[1] += dx * h.sy[p];
        g[2] += dy * ax;
        g[3] += dy * h.sy[p];
        if constexpr (Axisymmetric) {
          g[4] += dx * h.hoop[p];
        }
      }
    }
    out.swept_volume[i] = swept;
    out.compression[i] = h.compression;
    out.work[i] = work;
    if constexpr (Strength) {
      const double per_volume = 1 / h.volume;
#pragma GCC unroll 5
      for (int q = 0; q < 5; ++q) {
        out.gradient[q][i] = g[q] * per_volume;
      }
    }
  }
}

template <class Function> void dispatch(const ForceCoefficients& c, Function&& f) {
  if (c.subzonal > 0) {
    f(std::integral_constant<Extra, Extra::subzones>{});
  } else {
    c.shear_q > 0 ? f(std::integral_constant<Extra, Extra::shear_q>{}) : f(std::integral_constant<Extra, Extra::none>{});
  }
}

template <class Function> void dispatch(const Block<2>& b, const ForceCoefficients& c, Function&& f) {
  using std::false_type, std::true_type;
  dispatch(c, [&](auto extra) {
    if (b.axisymmetric) {
      b.any_strength() ? f(true_type{}, true_type{}, extra) : f(true_type{}, false_type{}, extra);
    } else {
      b.any_strength() ? f(false_type{}, true_type{}, extra) : f(false_type{}, false_type{}, extra);
    }
  });
}

} // namespace

template <>
void corner_forces<2>(const Block<2>& block,
                      const ForceRows<2>& in,
                      const ForceCoefficients& c,
                      int count,
                      const CornerRows<2>& out) {
  dispatch(block, c, [&](auto axisymmetric, auto strength, auto extra) {
    force_row<axisymmetric.value, strength.value, extra.value>(in, c, count, out);
  });
}

template <>
void corner_work<2>(const Block<2>& block,
                    const ForceRows<2>& in,
                    const double* const (&next)[2][2],
                    const ForceCoefficients& c,
                    int count,
                    const WorkRows<2>& out) {
  dispatch(block, c, [&](auto axisymmetric, auto strength, auto extra) {
    work_row<axisymmetric.value, strength.value, extra.value>(in, next, c, count, out);
  });
}

} // namespace ballast
