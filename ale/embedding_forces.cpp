// Forces of cut cells: pressure by the gradient of the open part, deviator by its share of the whole cell.
#include "ale/corner_force.hpp"
#include "ale/embedding.hpp"
#include "ale/scene.hpp"
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

/// Node velocities at the cell's corners.
template <int Dim>
std::array<std::array<double, Dim>, 1 << Dim> corner_velocities(const Grid& g, const std::array<RowField, Dim>& velocity, const std::array<int, 3>& cell) {
  std::array<std::array<double, Dim>, 1 << Dim> u{};
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto step = corner_step<Dim>(p);
    for (std::size_t d = 0; d < Dim; ++d) {
      u[static_cast<std::size_t>(p)][d] = velocity[d].row(g.node_row(cell[1] + step[1], cell[2] + step[2]))[cell[0] + step[0]];
    }
  }
  return u;
}

template <int Dim> const NodeFoot<Dim>* foot_at(const Embedding<Dim>& e, const CutCell<Dim>& c, int p) {
  const int at = c.foot[static_cast<std::size_t>(p)];
  return at < 0 ? nullptr : &e.now.feet[static_cast<std::size_t>(at)];
}

/// The foot by which a corner's node is tied.
template <int Dim> const NodeFoot<Dim>* foot_of_node(const Embedding<Dim>& e, const Grid& g, const CutCell<Dim>& c, int p) {
  const auto step = corner_step<Dim>(p);
  const int at = e.now.foot_of[node_at(g, g.node_row(c.cell[1] + step[1], c.cell[2] + step[2]), c.cell[0] + step[0])];
  return at < 0 ? nullptr : &e.now.feet[static_cast<std::size_t>(at)];
}

template <int Dim> double dot(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    sum += a[d] * b[d];
  }
  return sum;
}

/// Rate at which a node's level grows, m/s.
template <int Dim> double level_rate(const Scene<Dim>& scene, const NodeFoot<Dim>& f, const std::array<double, Dim>& u) {
  return dot<Dim>(f.foot.normal, u) - surface_speed<Dim>(scene, f, f.foot.normal);
}

/// A cut cell's levels and positions at a half step.
template <int Dim> LevelCell<Dim> half_way(const Scene<Dim>& scene, const Embedding<Dim>& e, const Block<Dim>& b, const CutCell<Dim>& c, double half,
                                           const std::array<std::array<double, Dim>, 1 << Dim>& u) {
  LevelCell<Dim> cell = level_cell<Dim>(b.grid, b.position, e.now, c.cell);
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto at = static_cast<std::size_t>(p);
    for (std::size_t d = 0; d < Dim; ++d) {
      cell.x[at][d] += half * u[at][d];
    }
    if (const NodeFoot<Dim>* f = foot_at(e, c, p)) {
      cell.level[at] += half * level_rate<Dim>(scene, *f, u[at]);
    }
  }
  return cell;
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
std::array<double, 6> half_deviator<3>(const Block<3>& b, const CutCell<3>& c, double, const WholeCell<3>&, const std::array<std::array<double, 3>, 8>&) {
  const int i = c.cell[0];
  const double xx = b.stress[0].row(c.row)[i], yy = b.stress[1].row(c.row)[i];
  return {xx, yy, -xx - yy, b.stress[3].row(c.row)[i], b.stress[4].row(c.row)[i], b.stress[2].row(c.row)[i]};
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

/// dT/dt of a cut cell, m3/s.
template <int Dim>
double opening_rate(const Scene<Dim>& scene, const Embedding<Dim>& e, const CutCell<Dim>& c, const OpenPart<Dim>& part,
                    const std::array<std::array<double, Dim>, 1 << Dim>& u) {
  double rate = 0;
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto at = static_cast<std::size_t>(p);
    rate += dot<Dim>(part.at_node[at], u[at]);
    if (const NodeFoot<Dim>* f = foot_at(e, c, p)) {
      rate += part.at_level[at] * level_rate<Dim>(scene, *f, u[at]);
    }
  }
  return rate;
}

/// What one cell pushes the nodes of layers with, for a unit of pressure.
template <int Dim> struct BodyPushes {
  struct Push {
    int stack;
    std::size_t node;
    std::array<double, Dim> force;
  };
  std::array<Push, (1 << Dim) * BodyFoot<Dim>::most> push = {};
  std::size_t count = 0;

  void add(const NodeFoot<Dim>& f, const std::array<double, Dim>& direction, double along) {
    for (std::size_t q = 0; q < f.foot.node.size(); ++q) {
      std::size_t at = 0;
      while (at < count && (push[at].stack != f.stack || push[at].node != f.foot.node[q])) {
        ++at;
      }
      if (at == count) {
        push[count++] = {f.stack, f.foot.node[q], {}};
      }
      for (std::size_t d = 0; d < Dim; ++d) {
        push[at].force[d] += f.foot.weight[q] * along * direction[d];
      }
    }
  }
  double mobility(const Scene<Dim>& scene) const {
    double sum = 0;
    for (std::size_t at = 0; at < count; ++at) {
      const Push& p = push[at];
      const double size = std::sqrt(dot<Dim>(p.force, p.force));
      if (size > 0) {
        std::array<double, Dim> along = p.force;
        for (double& a : along) {
          a /= size;
        }
        const Layers<Dim>& l = scene.layers[static_cast<std::size_t>(p.stack)];
        sum += size * size / (l.stack.mass[p.node] + l.load.mass_along(p.node, along));
      }
    }
    return sum;
  }
};

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

template <int Dim> double closing_rate(const Scene<Dim>& scene, const Embedding<Dim>& e, const CutCell<Dim>& c) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const OpenPart<Dim> part = open_part(level_cell<Dim>(b.grid, b.position, e.now, c.cell), b.axisymmetric);
  return -opening_rate<Dim>(scene, e, c, part, corner_velocities<Dim>(b.grid, b.velocity, c.cell)) / part.volume;
}

namespace {

template <int Dim> bool is_sliver(const Block<Dim>& b, const CutCell<Dim>& c) { return b.volume.row(c.row)[c.cell[0]] < sliver_share * c.whole; }

/// A cell's room and how much it changes, with its root's if it is a sliver.
struct Pool {
  double volume, change;
};
template <int Dim> Pool pool_of(const Scene<Dim>& scene, const Embedding<Dim>& e, const Block<Dim>& b, const CutCell<Dim>& c, double half, double then, double volume) {
  Pool pool{volume, then - volume};
  if (c.root >= 0) {
    const int r = b.grid.cell_row(c.root_cell[1], c.root_cell[2]), kind = e.kind_of(b.grid, r, c.root_cell[0]);
    CutCell<Dim> root;
    root.cell = c.root_cell;
    root.foot.fill(-1);
    if (kind >= 0) {
      root = e.cut[static_cast<std::size_t>(kind)];
    }
    const auto u = corner_velocities<Dim>(b.grid, b.velocity, c.root_cell);
    pool.volume += b.volume.row(r)[c.root_cell[0]];
    pool.change += open_volume(half_way<Dim>(scene, e, b, root, half, u), b.axisymmetric) - open_volume(half_way<Dim>(scene, e, b, root, 0, u), b.axisymmetric);
  }
  return pool;
}

} // namespace

constexpr double most_growth = 1.1; ///< of a sliver's room up to the half step, with its root's pressure

template <int Dim> static CutForce<Dim> cut_force(const Scene<Dim>& scene, const Embedding<Dim>& e, const CutCell<Dim>& c, double dt) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const int i = c.cell[0];
  const auto u = corner_velocities<Dim>(b.grid, b.velocity, c.cell);
  const LevelCell<Dim> half = half_way<Dim>(scene, e, b, c, 0.5 * dt, u);
  CutForce<Dim> out;
  out.half = open_part(half, b.axisymmetric);
  const double volume = b.volume.row(c.row)[i];
  const Pool pool = pool_of(scene, e, b, c, 0.5 * dt, out.half.volume, volume);
  out.compression = pool.change / pool.volume;
  if (out.half.volume > most_growth * volume) { // a sliver that opens by itself: it has no one's pressure but its own
    out.compression = std::max(out.compression, (out.half.volume - volume) / volume);
  }
  // A body does not pull; beside void nothing presses, whatever balances the deviator along the void's surface.
  const bool hollow = !(b.modulus.row(c.row)[i] > 0);
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
  e.force.clear();
  for (const CutCell<Dim>& c : e.cut) {
    e.force.push_back(cut_force(scene, e, c, dt));
  }
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

template <int Dim> void embedded_rates(const Embedding<Dim>& e, Block<Dim>& b) {
  const Grid& g = b.grid;
  for (int k = 0; k < g.cells[2]; ++k) {
    for (int j = 0; j < g.cells[1]; ++j) {
      const int r = g.cell_row(j, k);
      for (int i = 0; i < g.cells[0]; ++i) {
        const int kind = e.kind_of(g, r, i);
        for (std::size_t d = 0; d < Dim && kind != open_cell; ++d) {
          b.strain_rate[d].row(r)[i] *= kind >= 0 ? b.volume.row(r)[i] / e.cut[static_cast<std::size_t>(kind)].whole : 0.0;
        }
      }
    }
  }
}

/// Viscosity by the rate at which the open part closes over the cell's width; the stable step from the cell's own frequency,
/// w^2 = K/T (sum of B_p^2/M_p over what its pressure moves), twice that with its neighbours: 2 / (sqrt(2) w).
template <int Dim> void limit_embedded(Scene<Dim>& scene, Embedding<Dim>& e, DtLimit& limit) {
  const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  const double quadratic = scene.numerics.quadratic_q * (2.0 / 3.0), linear = scene.numerics.linear_q;
  for (CutCell<Dim>& c : e.cut) {
    const int i = c.cell[0];
    const double density = b.density.row(c.row)[i], sound = b.wave_speed.row(c.row)[i], modulus = b.modulus.row(c.row)[i];
    c.viscosity = 0;
    if (!(density > 0 && modulus > 0)) {
      continue;
    }
    const auto u = corner_velocities<Dim>(g, b.velocity, c.cell);
    const OpenPart<Dim> part = open_part(level_cell<Dim>(g, b.position, e.now, c.cell), b.axisymmetric);
    // A sliver closes with its root: over a thousandth of a cell's crossing time.
    const double moment = 1e-3 * c.width / sound;
    const Pool pool = c.root < 0 ? Pool{part.volume, opening_rate<Dim>(scene, e, c, part, u)}
                                 : pool_of(scene, e, b, c, moment, open_volume(half_way<Dim>(scene, e, b, c, moment, u), b.axisymmetric), part.volume);
    const double rate = pool.change / pool.volume / (c.root < 0 ? 1 : moment);
    double active = 0;
    if (rate < 0) {
      const double jump = -rate * c.width, a = quadratic * jump, lin = linear * sound * std::min(1.0, jump / (1e-7 * sound));
      active = a + std::sqrt(a * a + lin * lin);
      c.viscosity = density * jump * active;
    }
    double mobility = 0;
    BodyPushes<Dim> pushes;
    for (int p = 0; p < (1 << Dim); ++p) {
      const auto at = static_cast<std::size_t>(p);
      const auto to = corner_step<Dim>(p);
      const double mass = b.node_mass.row(g.node_row(c.cell[1] + to[1], c.cell[2] + to[2]))[c.cell[0] + to[0]];
      const NodeFoot<Dim>* f = foot_at(e, c, p);
      std::array<double, Dim> force = part.at_node[at];
      if (f != nullptr) {
        for (std::size_t d = 0; d < Dim; ++d) {
          force[d] += part.at_level[at] * f->foot.normal[d];
        }
        pushes.add(*f, f->foot.normal, -part.at_level[at]);
        const NodeFoot<Dim>& own = *foot_of_node(e, g, c, p);
        if (own.tied) {
          const double along = dot<Dim>(force, own.tie);
          pushes.add(own, own.carry, along);
          for (std::size_t d = 0; d < Dim; ++d) {
            force[d] -= along * own.tie[d];
          }
        }
      }
      mobility += mass > 0 ? dot<Dim>(force, force) / mass : 0.0;
    }
    mobility += pushes.mobility(scene);
    const double stiff = (density * (sound * sound + 4 * active * active)) / pool.volume;
    const double dt = scene.numerics.cfl * std::sqrt(2.0) / std::sqrt(stiff * mobility);
    if (dt < limit.dt) {
      limit = {dt, e.block, c.cell, b.owner_row(c.row)[i], DtCause::sound};
    }
    const double most = scene.numerics.max_volume_change;
    if (rate < 0 && -rate * limit.dt > most) {
      limit = {most / -rate, e.block, c.cell, b.owner_row(c.row)[i], DtCause::volume_change};
    }
  }
  for (const NodeFoot<Dim>& f : e.now.feet) { // a body travels less than half a cell
    const double speed = std::abs(surface_speed<Dim>(scene, f, f.foot.normal));
    const double width = 0.4 * e.least_width;
    if (speed * limit.dt > width) {
      limit = {width / speed, e.block, {-1, -1, -1}, -1, DtCause::volume_change};
    }
  }
}

#define BALLAST_INSTANTIATE(D)                                                                                        \
  template double surface_speed<D>(const Scene<D>&, const NodeFoot<D>&, const std::array<double, D>&);                \
  template double surface_way<D>(const Scene<D>&, const Embedding<D>&, const NodeFoot<D>&);                           \
  template double closing_rate<D>(const Scene<D>&, const Embedding<D>&, const CutCell<D>&);                           \
  template void cut_forces<D>(const Scene<D>&, Embedding<D>&, double);                                                \
  template void override_forces<D>(const Scene<D>&, const Embedding<D>&, int, int, const CornerRows<D>&);     \
  template void override_work<D>(const Scene<D>&, const Embedding<D>&, int, int, double, const WorkRows<D>&);         \
  template void embedded_rates<D>(const Embedding<D>&, Block<D>&);                                                    \
  template void limit_embedded<D>(Scene<D>&, Embedding<D>&, DtLimit&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
