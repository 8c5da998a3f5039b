// Artificial viscosity and the stable time step.
//
// Along each logical axis d the velocity jump across a cell is du = e L with the strain rate e = t.grad(u).t/t^2 of the
// mid line t and L = V / |mid surface|; in 3D e = t.du/t^2 with du between the line's ends, which is the same but for
// hourglass motion (the force itself looks at the gradient again: q never drives). In compression
//   q = rho |du'| (a |du'| + sqrt((a du')^2 + (b c)^2)),  du' = (1 - psi) du      (Kuropatenko)
// with a = quadratic_q * 2/3 (the (gamma+1)/4 of a 5/3 gas; s/2 of a solid is 0.7) and b = linear_q. The
// limiter psi = max(0, min((r_l + r_r)/2, 2 r_l, 2 r_r, 1)) compares e with the two neighbours along the
// axis and leaves smooth (linear) compression alone.
// dt = cfl L / sqrt(c^2 + (2 Q)^2) with Q = q / (rho |du|): at most 1.15 of the explicit limit of a damped
// oscillator, L / (Q + sqrt(Q^2 + c^2)), for a CFL number of one.
#include "ale/layer_coupling.hpp"
#include "ale/corner_force.hpp"
#include "ale/embedding.hpp"
#include "ale/phases.hpp"
#include "core/hex_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

std::string name_of(DtCause cause) {
  static const char* const names[] = {
      "sound", "viscosity", "volume change", "growth", "maximum", "end", "retry"};
  return names[static_cast<int>(cause)];
}

namespace {

template <bool Axisymmetric> void rates_2d(Block<2>& b, int j, Span cells) {
  const Grid& g = b.grid;
  const double *x0 = b.position[0].row(g.node_row(j, 0)), *x1 = b.position[0].row(g.node_row(j + 1, 0));
  const double *y0 = b.position[1].row(g.node_row(j, 0)), *y1 = b.position[1].row(g.node_row(j + 1, 0));
  const double *u0 = b.velocity[0].row(g.node_row(j, 0)), *u1 = b.velocity[0].row(g.node_row(j + 1, 0));
  const double *v0 = b.velocity[1].row(g.node_row(j, 0)), *v1 = b.velocity[1].row(g.node_row(j + 1, 0));
  const int r = g.cell_row(j, 0);
  double *e0 = b.strain_rate[0].row(r), *e1 = b.strain_rate[1].row(r);
  double *l0 = b.length[0].row(r), *l1 = b.length[1].row(r);
  const double* volume = b.volume.row(r);
#pragma omp simd
  for (int i = cells.begin; i < cells.end; ++i) {
    const QuadGeometry<Axisymmetric> q{{x0[i], x0[i + 1], x1[i + 1], x1[i]},
                                       {y0[i], y0[i + 1], y1[i + 1], y1[i]}};
    const double u[4] = {u0[i], u0[i + 1], u1[i + 1], u1[i]}, v[4] = {v0[i], v0[i + 1], v1[i + 1], v1[i]};
    double sx[4], sy[4], hoop[4], xx = 0, xy = 0, yx = 0, yy = 0;
    q.gradient(sx, sy, hoop);
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      const double ax = Axisymmetric ? sx[p] - hoop[p] : sx[p];
      xx += u[p] * ax;
      xy += u[p] * sy[p];
      yx += v[p] * ax;
      yy += v[p] * sy[p];
    }
    const double t0x = 0.5 * (q.x[1] + q.x[2] - q.x[0] - q.x[3]), t0y = 0.5 * (q.y[1] + q.y[2] - q.y[0] - q.y[3]);
    const double t1x = 0.5 * (q.x[3] + q.x[2] - q.x[0] - q.x[1]), t1y = 0.5 * (q.y[3] + q.y[2] - q.y[0] - q.y[1]);
    const double a0 = t1x * t1x + t1y * t1y, a1 = t0x * t0x + t0y * t0y;
    e0[i] = (t0x * t0x * xx + t0x * t0y * (xy + yx) + t0y * t0y * yy) / (a1 * volume[i]);
    e1[i] = (t1x * t1x * xx + t1x * t1y * (xy + yx) + t1y * t1y * yy) / (a0 * volume[i]);
    const double area = q.area();
    l0[i] = area / std::sqrt(a0);
    l1[i] = area / std::sqrt(a1);
  }
}

void rates(Block<2>& b, int j, int, Span cells) { b.axisymmetric ? rates_2d<true>(b, j, cells) : rates_2d<false>(b, j, cells); }

struct V3 {
  double x, y, z;
};
[[gnu::always_inline]] inline double dot(const V3& a, const V3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[gnu::always_inline]] inline double area_of(const V3& a, const V3& c) {
  const double nx = a.y * c.z - a.z * c.y, ny = a.z * c.x - a.x * c.z, nz = a.x * c.y - a.y * c.x;
  return std::sqrt(nx * nx + ny * ny + nz * nz);
}

/// Rates and lengths of one hexahedron. A function of its own: locals of the row loop itself would become
/// per-lane arrays and keep it from vectorising.
struct HexRates {
  double rate[3], length[3];
};
[[gnu::always_inline]] inline HexRates hex_rates(const ForceRows<3>& in, int i) {
  static constexpr int line_of[8] = {0, 0, 1, 1, 2, 2, 3, 3}, step_of[8] = {0, 1, 1, 0, 0, 1, 1, 0};
  double x[3][8], u[3][8];
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    const int l = line_of[p], s = i + step_of[p];
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d) {
      x[d][p] = in.x[d][l][s];
      u[d][p] = in.u[d][l][s];
    }
  }
  const HexModes x0 = hex_modes(x[0]), x1 = hex_modes(x[1]), x2 = hex_modes(x[2]);
  const HexModes u0 = hex_modes(u[0]), u1 = hex_modes(u[1]), u2 = hex_modes(u[2]);
  const V3 t0{x0.xi, x1.xi, x2.xi}, t1{x0.eta, x1.eta, x2.eta}, t2{x0.zeta, x1.zeta, x2.zeta};
  const V3 v0{u0.xi, u1.xi, u2.xi}, v1{u0.eta, u1.eta, u2.eta}, v2{u0.zeta, u1.zeta, u2.zeta};
  const double v = in.volume[i];
  return {{dot(v0, t0) / dot(t0, t0), dot(v1, t1) / dot(t1, t1), dot(v2, t2) / dot(t2, t2)},
          {16 * v / area_of(t1, t2), 16 * v / area_of(t2, t0), 16 * v / area_of(t0, t1)}};
}

void rates(Block<3>& b, int j, int k, Span cells) {
  const Grid& g = b.grid;
  const ForceRows<3> in(b, j, k);
  const int r = g.cell_row(j, k);
  double *e0 = b.strain_rate[0].row(r), *e1 = b.strain_rate[1].row(r), *e2 = b.strain_rate[2].row(r);
  double *l0 = b.length[0].row(r), *l1 = b.length[1].row(r), *l2 = b.length[2].row(r);
#pragma omp simd
  for (int i = cells.begin; i < cells.end; ++i) {
    const HexRates h = hex_rates(in, i);
    e0[i] = h.rate[0];
    e1[i] = h.rate[1];
    e2[i] = h.rate[2];
    l0[i] = h.length[0];
    l1[i] = h.length[1];
    l2[i] = h.length[2];
  }
}

[[gnu::always_inline]] inline double limiter(double e, double below, double above) {
  const double safe = std::abs(e) > 1e-300 ? e : 1e-300;
  const double low = below / safe, high = above / safe;
  // Conditionals, not std::min: references to temporaries would keep the loop from vectorising.
  const double mean = 0.5 * (low + high), least = low < high ? 2 * low : 2 * high;
  const double bound = mean < least ? mean : least;
  return bound > 0 ? (bound < 1 ? bound : 1.0) : 0.0;
}

struct ViscosityCoefficients {
  double quadratic, linear;
};

/// Of the sound speed: below it the linear term fades with the jump, else the sign of the round-off of what only moves would set
/// the step.
constexpr double faint = 1e-7;

/// q of one axis of one row, and the step it allows, folded into `dt`.
void viscosity_row(Span cells,
                   const ViscosityCoefficients& c,
                   const double* below,
                   const double* here,
                   const double* above,
                   const double* length,
                   const double* density,
                   const double* wave_speed,
                   const double* modulus,
                   double* viscosity,
                   double* dt) {
  const double quadratic = c.quadratic, linear = c.linear;
#pragma omp simd
  for (int i = cells.begin; i < cells.end; ++i) {
    const double e = here[i];
    const double sound = wave_speed[i];
    // A cell with void has no stiffness (modulus 0): the void absorbs the closing, nothing to smear. Cold
    // gas (p = 0) has none either, but no sound in it: there the quadratic term must act.
    const bool stiff = modulus[i] > 0 || (density[i] > 0 && !(sound > 0));
    const double jump = e < 0 && stiff ? -e * length[i] * (1 - limiter(e, below[i], above[i])) : 0.0;
    const double least = faint * sound + 1e-300, share = jump < least ? jump / least : 1.0;
    const double a = quadratic * jump, lin = linear * sound * share;
    const double speed = a + std::sqrt(a * a + lin * lin);
    const double active = jump > 0 ? speed : 0.0;
    viscosity[i] = density[i] * jump * active;
    const double stable = length[i] / (std::sqrt(4 * active * active + sound * sound) + 1e-300);
    dt[i] = dt[i] < stable ? dt[i] : stable;
  }
}

/// Where two velocities meet, a slanted interface is compression along one axis and the opposite along another: no
/// shock. There q acts by the share of the compression that the cell's volume sees.
template <int Dim> void spare_shear(Block<Dim>& b, int j, int k) {
  const int r = b.grid.cell_row(j, k);
  const double *rho = b.density.row(r), *damped = b.damped_density.row(r);
  const Span cells = b.awake.cells(r);
  for (int i = cells.begin; i < cells.end; ++i) {
    if (damped[i] == rho[i]) {
      continue;
    }
    double rate = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      rate += b.strain_rate[d].row(r)[i];
    }
    if (b.axisymmetric) {
      const double *r0 = b.position[0].row(b.grid.node_row(j, k)), *u0 = b.velocity[0].row(b.grid.node_row(j, k));
      const double *r1 = b.position[0].row(b.grid.node_row(j + 1, k)), *u1 = b.velocity[0].row(b.grid.node_row(j + 1, k));
      rate += (u0[i] + u0[i + 1] + u1[i] + u1[i + 1]) / (r0[i] + r0[i + 1] + r1[i] + r1[i + 1]);
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      const double e = b.strain_rate[d].row(r)[i];
      b.viscosity[d].row(r)[i] *= e < 0 ? std::clamp(rate / e, 0.0, 1.0) : 1.0;
    }
  }
}

/// The cell of a row that strains fastest, as a limit of the step.
template <int Dim> DtLimit fastest_cell(const Block<Dim>& b, int j, int k, double dt, double fastest) {
  const int r = b.grid.cell_row(j, k);
  for (int i = 0; i < b.grid.cells[0]; ++i) {
    for (std::size_t d = 0; d < Dim; ++d) {
      if (std::abs(b.strain_rate[d].row(r)[i]) == fastest) {
        return {dt, 0, {i, j, k}, b.owner_row(r)[i], DtCause::volume_change};
      }
    }
  }
  return {dt, 0, {-1, j, k}, -1, DtCause::volume_change};
}

/// Viscosity of a row's awake cells, the step (for a CFL number of one) that each cell allows, and the row's least.
template <int Dim> void update_row(Block<Dim>& b, const Numerics& n, int j, int k) {
  const Grid& g = b.grid;
  const int r = g.cell_row(j, k);
  const Span cells = b.awake.cells(r);
  const ViscosityCoefficients c{n.quadratic_q * (2.0 / 3.0), n.linear_q};
  double* dt = b.stable_step.row(r);
  std::fill(dt + cells.begin, dt + cells.end, std::numeric_limits<double>::infinity());
  for (std::size_t d = 0; d < Dim; ++d) {
    const RowField& e = b.strain_rate[d];
    const int stride = g.cell_row_stride(static_cast<int>(d)), step = d == 0 ? 1 : 0;
    viscosity_row(cells, c, e.row(r - stride) - step, e.row(r), e.row(r + stride) + step, b.length[d].row(r), b.density.row(r),
                  b.wave_speed.row(r), b.modulus.row(r), b.viscosity[d].row(r), dt);
  }
  if (b.any_sliding()) {
    spare_shear(b, j, k);
  }
  b.row_least[static_cast<std::size_t>(r)] = static_cast<int>(std::min_element(dt, dt + g.cells[0]) - dt);
}

/// Lowers `limit` to what a row allows; of a row asleep it is known.
template <int Dim> void limit_row(Block<Dim>& b, const Numerics& n, int j, int k, DtLimit& limit) {
  const int r = b.grid.cell_row(j, k);
  const Span cells = b.awake.cells(r);
  if (!cells.empty()) {
    update_row(b, n, j, k);
  }
  const int i = b.row_least[static_cast<std::size_t>(r)];
  const double dt = n.cfl * b.stable_step.row(r)[i];
  if (dt < limit.dt) {
    const double sound = b.wave_speed.row(r)[i];
    bool viscous = true; // less than what sound alone allows
    for (const RowField& length : b.length) {
      viscous = viscous && b.stable_step.row(r)[i] * sound < (1 - 1e-6) * length.row(r)[i];
    }
    limit = {dt, 0, {i, j, k}, b.owner_row(r)[i], viscous ? DtCause::viscosity : DtCause::sound};
  }
  double fastest = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    const double* e = b.strain_rate[d].row(r);
#pragma omp simd reduction(max : fastest)
    for (int cell = cells.begin; cell < cells.end; ++cell) {
      fastest = std::max(fastest, std::abs(e[cell]));
    }
  }
  if (n.max_volume_change < limit.dt * fastest) {
    limit = fastest_cell(b, j, k, n.max_volume_change / fastest, fastest);
  }
}

} // namespace

template <int Dim> DtLimit stable_dt(Scene<Dim>& scene) {
  DtLimit best = scene.blocks.empty() ? stable_dt_of_layers(scene) : DtLimit{};
  const Numerics& n = scene.numerics;
  for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
    Block<Dim>& b = scene.blocks[ib];
    const Grid& g = b.grid;
    parallel_awake(*scene.pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
      for (int s = begin; s < end; ++s) {
        for (int q = 0; q < g.rows_per_slab(); ++q) {
          const auto [j, k] = g.in_slab(s, q);
          rates(b, j, k, b.awake.cells(g.cell_row(j, k)));
        }
      }
    });
    Embedding<Dim>* embedded = embedding_of(scene, b);
    if (embedded != nullptr) {
      embedded_rates(*embedded, b, *scene.pool);
    }
    for (auto& f : b.strain_rate) {
      exchange_cells(g, f, &b.awake);
    }
    std::vector<DtLimit> found(static_cast<std::size_t>(g.slabs()));
    parallel_awake(*scene.pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
      for (int s = begin; s < end; ++s) {
        for (int q = 0; q < g.rows_per_slab(); ++q) {
          const auto [j, k] = g.in_slab(s, q);
          limit_row(b, n, j, k, found[static_cast<std::size_t>(s)]);
          found[static_cast<std::size_t>(s)].block = static_cast<int>(ib);
        }
      }
    });
    for (const DtLimit& limit : found) {
      if (limit.dt < best.dt) {
        best = limit;
      }
    }
    if (embedded != nullptr) {
      limit_embedded(scene, *embedded, best);
    }
  }
  return best;
}

template DtLimit stable_dt<2>(Scene<2>&);
template DtLimit stable_dt<3>(Scene<3>&);

} // namespace ballast
