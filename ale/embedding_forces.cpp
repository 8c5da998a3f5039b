// Forces of cut cells: pressure by the gradient of the open part, deviator by its share of the whole cell.
#include "ale/corner_force.hpp"
#include "ale/embedding_motion.hpp"
#include "core/hex_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

/// A whole cell's volume gradient, its hoop part, and its volume.
template <int Dim> struct WholeCell {
  std::array<std::array<double, Dim>, 1 << Dim> s = {};
  std::array<double, 1 << Dim> hoop = {};
  double volume = 0;
};

template <bool Axisymmetric> WholeCell<2> whole_quad(const LevelCell<2>& c) {
  QuadGeometry<Axisymmetric> q{};
  for (std::size_t p = 0; p < 4; ++p) {
    q.x[p] = c.x[p][0];
    q.y[p] = c.x[p][1];
  }
  double sx[4], sy[4], hoop[4];
  q.gradient(sx, sy, hoop);
  WholeCell<2> out;
  out.volume = q.volume();
  for (std::size_t p = 0; p < 4; ++p) {
    out.s[p] = {sx[p], sy[p]};
    out.hoop[p] = Axisymmetric ? hoop[p] : 0.0;
  }
  return out;
}
WholeCell<2> whole_cell(const LevelCell<2>& c, bool axisymmetric) { return axisymmetric ? whole_quad<true>(c) : whole_quad<false>(c); }

WholeCell<3> whole_cell(const LevelCell<3>& c, bool) {
  HexGeometry h{};
  for (std::size_t p = 0; p < 8; ++p) {
    h.x[p] = c.x[p][0];
    h.y[p] = c.x[p][1];
    h.z[p] = c.x[p][2];
  }
  double bx[8], by[8], bz[8];
  h.gradient(bx, by, bz);
  WholeCell<3> out;
  for (std::size_t p = 0; p < 8; ++p) {
    out.s[p] = {bx[p], by[p], bz[p]};
    out.volume += (c.x[p][0] * bx[p] + c.x[p][1] * by[p] + c.x[p][2] * bz[p]) / 3;
  }
  return out;
}

/// The symmetric deviator at the half step, 2D: xx yy xy hoop; 3D: xx yy zz yz xz xy.
template <int Dim> std::array<double, Dim == 2 ? 4 : 6> half_deviator(const Block<Dim>& b, const CutCell<Dim>& c, double dt, const WholeCell<Dim>& w,
                                                                      const std::array<std::array<double, Dim>, 1 << Dim>& u);

template <>
std::array<double, 4> half_deviator<2>(const Block<2>& b, const CutCell<2>& c, double dt, const WholeCell<2>& w, const std::array<std::array<double, 2>, 4>& u) {
  double gxx = 0, gxy = 0, gyy = 0, gtt = 0;
  for (std::size_t p = 0; p < 4; ++p) {
    const double ax = w.s[p][0] - w.hoop[p];
    gxx += u[p][0] * ax;
    gxy += u[p][0] * w.s[p][1] + u[p][1] * ax;
    gyy += u[p][1] * w.s[p][1];
    gtt += u[p][0] * w.hoop[p];
  }
  const int i = c.cell[0];
  const double mean = (gxx + gyy + gtt) / 3, g = b.shear.row(c.row)[i] * dt / w.volume, flow = b.flow_stress.row(c.row)[i];
  const double sxx = b.stress[0].row(c.row)[i] + g * (gxx - mean), syy = b.stress[1].row(c.row)[i] + g * (gyy - mean);
  const double sxy = b.stress[2].row(c.row)[i] + 0.5 * g * gxy;
  const double squared = 3 * (sxx * sxx + syy * syy + sxx * syy + sxy * sxy);
  const double cut = squared > flow * flow ? flow / std::sqrt(squared) : 1.0;
  return {cut * sxx, cut * syy, cut * sxy, -cut * (sxx + syy)};
}

template <>
std::array<double, 6> half_deviator<3>(const Block<3>& b, const CutCell<3>& c, double dt, const WholeCell<3>& w, const std::array<std::array<double, 3>, 8>& u) {
  std::array<double, 9> g{}; // volume times du_i/dx_j
  for (std::size_t p = 0; p < 8; ++p) {
    for (std::size_t n = 0; n < 9; ++n) {
      g[n] += u[p][n / 3] * w.s[p][n % 3];
    }
  }
  const int i = c.cell[0];
  const double mean = (g[0] + g[4] + g[8]) / 3, rate = b.shear.row(c.row)[i] * dt / w.volume, flow = b.flow_stress.row(c.row)[i];
  const double xx = b.stress[0].row(c.row)[i] + rate * (g[0] - mean), yy = b.stress[1].row(c.row)[i] + rate * (g[4] - mean);
  const double xy = b.stress[2].row(c.row)[i] + 0.5 * rate * (g[1] + g[3]), yz = b.stress[3].row(c.row)[i] + 0.5 * rate * (g[5] + g[7]);
  const double xz = b.stress[4].row(c.row)[i] + 0.5 * rate * (g[2] + g[6]);
  const double squared = 3 * (xx * xx + yy * yy + xx * yy + xy * xy + yz * yz + xz * xz);
  const double cut = squared > flow * flow ? flow / std::sqrt(squared) : 1.0;
  return {cut * xx, cut * yy, -cut * (xx + yy), cut * yz, cut * xz, cut * xy};
}

void add_deviator(const WholeCell<2>& w, const std::array<double, 4>& s, double share, CutForce<2>& out) {
  for (std::size_t p = 0; p < 4; ++p) {
    const double ax = w.s[p][0] - w.hoop[p];
    out.corner[p][0] -= share * (s[0] * ax + s[2] * w.s[p][1] + s[3] * w.hoop[p]);
    out.corner[p][1] -= share * (s[2] * ax + s[1] * w.s[p][1]);
  }
}
void add_deviator(const WholeCell<3>& w, const std::array<double, 6>& s, double share, CutForce<3>& out) {
  for (std::size_t p = 0; p < 8; ++p) {
    const auto& n = w.s[p];
    out.corner[p][0] -= share * (s[0] * n[0] + s[5] * n[1] + s[4] * n[2]);
    out.corner[p][1] -= share * (s[5] * n[0] + s[1] * n[1] + s[3] * n[2]);
    out.corner[p][2] -= share * (s[4] * n[0] + s[3] * n[1] + s[2] * n[2]);
  }
}

} // namespace

template <int Dim> double surface_speed(const Scene<Dim>& scene, const NodeFoot<Dim>& f, const std::array<double, Dim>& along) {
  const LayerStack<Dim>& s = scene.layers[static_cast<std::size_t>(f.stack)].stack;
  double speed = 0;
  for (std::size_t q = 0; q < f.foot.node.size(); ++q) {
    for (std::size_t d = 0; d < Dim; ++d) {
      speed += f.foot.weight[q] * s.velocity[d][f.foot.node[q]] * along[d];
    }
  }
  return speed;
}

constexpr double most_growth = 1.1; ///< of a sliver's room up to the half step, with its root's pressure

template <int Dim> static CutForce<Dim> cut_force(const Scene<Dim>& scene, const Embedding<Dim>& e, const CutCell<Dim>& c, double dt) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const int i = c.cell[0];
  const auto u = corner_velocities<Dim>(b.grid, b.velocity, c.cell);
  const LevelCell<Dim> half = half_way<Dim>(scene, e, b, c, 0.5 * dt, u);
  CutForce<Dim> out;
  out.half = open_part(half, b.axisymmetric);
  const double volume = b.volume.row(c.row)[i];
  const Pool pool = pool_of(scene, e, b, c, 0.5 * dt, out.half.volume - c.open, volume);
  out.compression = pool.change / pool.volume;
  if (out.half.volume > most_growth * c.open) { // a sliver that opens by itself: it has no one's pressure but its own
    out.compression = std::max(out.compression, (out.half.volume - c.open) / c.open);
  }
  // A body does not pull; beside void nothing presses, whatever balances the deviator along the void's surface.
  const bool hollow = !(b.modulus.row(c.row)[i] > 0) || is_wisp(b, c);
  const double now = b.pressure.row(c.row)[i], modulus = b.modulus.row(c.row)[i];
  const double pressed = hollow ? -b.reference_pressure : std::max(now - modulus * out.compression, -b.reference_pressure);
  out.compression = hollow ? 0.0 : (now - pressed) / modulus; // the closure works with the pressure that acts
  const double p = pressed + (hollow ? 0.0 : c.viscosity);
  for (int q = 0; q < (1 << Dim); ++q) {
    const auto at = static_cast<std::size_t>(q);
    out.push[at] = p * out.half.at_level[at];
    const NodeFoot<Dim>* f = foot_at(e, c, q);
    for (std::size_t d = 0; d < Dim; ++d) {
      out.corner[at][d] = p * out.half.at_node[at][d] + (f != nullptr ? out.push[at] * f->foot.normal[d] : 0.0);
    }
  }
  if (b.any_strength() && !hollow && !is_sliver(b, c)) {
    const WholeCell<Dim> w = whole_cell(half, b.axisymmetric);
    add_deviator(w, half_deviator<Dim>(b, c, dt, w, u), volume / w.volume, out);
  }
  return out;
}

template <int Dim> void cut_forces(const Scene<Dim>& scene, Embedding<Dim>& e, double dt) {
  e.force.resize(e.cut.size());
  parallel_ranges(*scene.pool, static_cast<int>(e.cut.size()), [&](int begin, int end, int) {
    for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n) {
      e.force[n] = cut_force(scene, e, e.cut[n], dt);
    }
  });
}

template <int Dim> void override_forces(const Scene<Dim>& scene, const Embedding<Dim>& e, int j, int k, const CornerRows<Dim>& out) {
  const Grid& g = scene.blocks[static_cast<std::size_t>(e.block)].grid;
  const int r = g.cell_row(j, k);
  for (int i = 0; i < g.cells[0]; ++i) {
    const int kind = e.kind_of(g, r, i);
    if (kind == open_cell) {
      continue;
    }
    CutForce<Dim> f{};
    if (kind >= 0) {
      f = e.force[static_cast<std::size_t>(kind)];
    }
    for (std::size_t p = 0; p < f.corner.size(); ++p) {
      for (std::size_t d = 0; d < Dim; ++d) {
        out.f[p][d][i] = f.corner[p][d];
      }
    }
  }
}

template <int Dim> void override_work(const Scene<Dim>& scene, const Embedding<Dim>& e, int j, int k, double dt, const WorkRows<Dim>& out) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  const int r = g.cell_row(j, k);
  for (int i = 0; i < g.cells[0]; ++i) {
    const int kind = e.kind_of(g, r, i);
    if (kind == open_cell) {
      continue;
    }
    out.swept_volume[i] = out.compression[i] = out.work[i] = 0;
    if (kind == covered_cell) {
      continue;
    }
    const CutCell<Dim>& c = e.cut[static_cast<std::size_t>(kind)];
    const CutForce<Dim>& f = e.force[static_cast<std::size_t>(kind)];
    const auto u = corner_velocities<Dim>(g, b.velocity, c.cell), next = corner_velocities<Dim>(g, b.next_velocity, c.cell);
    out.compression[i] = f.compression;
    const bool slack = is_sliver(b, c) || !(b.modulus.row(c.row)[i] > 0);
    out.compression[i] = f.compression;
    for (double* component : out.gradient) { // of a sliver the whole cell's strain means nothing
      if (component != nullptr && slack) {
        component[i] = 0;
      }
    }
    for (int p = 0; p < (1 << Dim); ++p) {
      const auto at = static_cast<std::size_t>(p);
      double along = 0;
      const NodeFoot<Dim>* foot = foot_at(e, c, p);
      for (std::size_t d = 0; d < Dim; ++d) {
        const double dx = 0.5 * dt * (u[at][d] + next[at][d]);
        out.swept_volume[i] += f.half.at_node[at][d] * dx;
        out.work[i] -= f.corner[at][d] * dx;
        along += foot != nullptr ? foot->foot.normal[d] * dx : 0.0;
      }
      if (foot != nullptr) {
        const double moved = surface_way(scene, e, *foot);
        out.swept_volume[i] += f.half.at_level[at] * (along - moved);
        out.work[i] += f.push[at] * moved;
      }
    }
  }
}

template <int Dim> double surface_way(const Scene<Dim>& scene, const Embedding<Dim>& e, const NodeFoot<Dim>& f) {
  const auto s = static_cast<std::size_t>(f.stack);
  double way = 0;
  for (std::size_t q = 0; q < f.foot.node.size(); ++q) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const std::size_t n = f.foot.node[q];
      way += f.foot.weight[q] * (scene.layers[s].stack.position[d][n] - e.start[s][d][n]) * f.foot.normal[d];
    }
  }
  return way;
}

#define BALLAST_INSTANTIATE(D) \
  template double surface_speed<D>(const Scene<D>&, const NodeFoot<D>&, const std::array<double, D>&); \
  template double surface_way<D>(const Scene<D>&, const Embedding<D>&, const NodeFoot<D>&); \
  template void cut_forces<D>(const Scene<D>&, Embedding<D>&, double); \
  template void override_forces<D>(const Scene<D>&, const Embedding<D>&, int, int, const CornerRows<D>&); \
  template void override_work<D>(const Scene<D>&, const Embedding<D>&, int, int, double, const WorkRows<D>&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
