// What touches a body and how they move together.
#include "ale/embedding_cells.hpp"
#include "ale/scene.hpp"

#include "ale/absorbing.hpp"
#include "ale/embedding_motion.hpp"
#include "ale/layers/layer_account.hpp"
#include "ale/layers/layer_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

constexpr double no_void = 1e-9;     ///< of a cell's open part: less is none
constexpr double tied_within = 0.5;  ///< of a cell's edge: an open node that close to a body is tied

/// What a cell around a node says about its tie.
enum class Say { nothing, free, tied };

template <int Dim> bool has_mass(const Block<Dim>& b, int r, int i) { return b.density.row(r)[i] > 0; }

template <int Dim> bool has_void(const Block<Dim>& b, int r, int i) { return b.materials.back().store.row(field::fraction, r)[i] > no_void; }

/// Void enough to keep what is in a cut cell off the body: of a sliver a trace is less than that.
constexpr double void_of_whole = 1e-4;
template <int Dim> bool keeps_off(const Block<Dim>& b, const CutCell<Dim>& c) {
  const double gap = b.materials.back().store.row(field::fraction, c.row)[c.cell[0]];
  return gap > no_void && gap * b.volume.row(c.row)[c.cell[0]] > void_of_whole * c.whole;
}

template <int Dim> void find_touching(Scene<Dim>& scene, Embedding<Dim>& e, const Block<Dim>& b) {
  const auto find = [&](CutCell<Dim>& c) {
    const int i = c.cell[0];
    c.touches = has_mass(b, c.row, i) && !keeps_off(b, c) && (b.pressure.row(c.row)[i] + b.reference_pressure > 0 || closing_rate(scene, e, c) > 0);
  };
  parallel_ranges(*scene.pool, static_cast<int>(e.cut.size()), [&](int begin, int end, int) {
    for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n) {
      find(e.cut[n]);
    }
  });
}

/// A node is tied if it lies in the body or close to it and something there touches the body; an open one only if nothing around
/// it has void.
template <int Dim> bool is_tied(const Embedding<Dim>& e, const Block<Dim>& b, const NodeFoot<Dim>& f, const std::array<int, 3>& node) {
  const Grid& g = b.grid;
  bool touches = false;
  const bool covered = !(f.foot.level > 0);
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto step = corner_step<Dim>(p);
    const std::array<int, 3> cell = {node[0] - step[0], node[1] - step[1], node[2] - step[2]};
    bool in = true;
    for (std::size_t d = 0; d < Dim; ++d) {
      in = in && cell[d] >= 0 && cell[d] < g.cells[d];
    }
    if (!in) {
      continue;
    }
    const int r = g.cell_row(cell[1], cell[2]), kind = e.kind_of(g, r, cell[0]);
    if (kind >= 0) {
      const CutCell<Dim>& c = e.cut[static_cast<std::size_t>(kind)];
      touches = touches || c.touches;
      if (!covered && (!c.touches || f.foot.level > tied_within * c.width)) {
        return false;
      }
    } else if (kind == open_cell && !covered && (has_void(b, r, cell[0]) || !has_mass(b, r, cell[0]))) {
      return false;
    }
  }
  return touches;
}

constexpr double least_along_wall = 0.3; ///< of the normal: below it a node on a wall is free

/// How a node is tied; false: the wall it lies on faces the body.
template <int Dim> bool find_tie(const Block<Dim>& b, const std::array<int, 3>& node, NodeFoot<Dim>& f) {
  f.tie = f.carry = f.foot.normal;
  bool wall = false;
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const int at = side == 0 ? 0 : b.grid.cells[static_cast<std::size_t>(axis)], component = b.boundary.normal_of(axis, side);
      const bool holds = b.boundary.fixes_normal_velocity(axis, side) || b.boundary.at(axis, side).kind == BoundaryKind::outflow; // what flows out goes as characteristics say
      if (node[static_cast<std::size_t>(axis)] == at && component >= 0 && holds) {
        f.tie[static_cast<std::size_t>(component)] = 0;
        wall = true;
      }
    }
  }
  double square = 0;
  for (const double n : f.tie) {
    square += n * n;
  }
  if (!wall) {
    return true;
  }
  const double length = std::sqrt(square);
  for (std::size_t d = 0; d < Dim; ++d) {
    f.tie[d] = length > 0 ? f.tie[d] / length : 0.0;
    f.carry[d] = length > 0 ? f.foot.normal[d] / length : 0.0; // n.tie = length
  }
  if (b.axisymmetric && b.position[0].row(f.row)[f.index] == 0) { // around it the surface's normals cancel but for the axis' own
    f.carry = f.tie;
  }
  return length > least_along_wall;
}

/// What a wall gives to a body through a node that it holds.
template <int Dim> void book_wall(Ledger& ledger, const NodeFoot<Dim>& f, double impulse) {
  for (std::size_t d = 0; d < Dim; ++d) {
    ledger.momentum_out[d] -= impulse * (f.carry[d] - f.tie[d]);
  }
}

/// The stack's nodes that carry a foot.
template <int Dim> void collect_nodes(Scene<Dim>& scene, const Embedding<Dim>& e) {
  std::vector<std::vector<char>> carries(scene.layers.size());
  for (std::size_t s = 0; s < carries.size(); ++s) {
    carries[s].assign(scene.layers[s].stack.node_count(), 0);
  }
  for (const NodeFoot<Dim>& f : e.now.feet) {
    for (const std::size_t n : f.foot.node) {
      carries[static_cast<std::size_t>(f.stack)][n] = 1;
    }
  }
  for (std::size_t s = 0; s < carries.size(); ++s) {
    LayerLoad<Dim>& load = scene.layers[s].load;
    load.node.clear();
    for (std::size_t n = 0; n < carries[s].size(); ++n) {
      if (carries[s][n] != 0) {
        load.node.push_back(n);
      }
    }
    load.force.assign(load.node.size(), LayerLoad<Dim>::Vector::Zero());
    load.added.assign(load.node.size(), LayerLoad<Dim>::Matrix::Zero());
    load.own.clear();
  }
}

/// Calls body(place in the load's lists, weight) for the nodes of a foot.
template <int Dim, class Visit> void for_foot(const LayerLoad<Dim>& load, const BodyFoot<Dim>& f, Visit&& body) {
  for (std::size_t q = 0; q < f.node.size(); ++q) {
    if (f.weight[q] != 0) {
      body(load.index_of(f.node[q]), f.weight[q]);
    }
  }
}

template <int Dim> typename LayerLoad<Dim>::Vector vector_of(const std::array<double, Dim>& a) { return typename LayerLoad<Dim>::Vector(a.data()); }

template <int Dim> double speed_along(const std::array<RowField, Dim>& velocity, const NodeFoot<Dim>& f) {
  double speed = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    speed += velocity[d].row(f.row)[f.index] * f.tie[d];
  }
  return speed;
}

/// Of the node's mass, along the tie.
template <int Dim> double mean_along(const Block<Dim>& b, const std::array<RowField, Dim>& velocity, const std::array<RowField, Dim>& jump, const NodeFoot<Dim>& f) {
  double speed = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    speed += mean_velocity<Dim>(b, velocity, jump, d, f.row, f.index) * f.tie[d];
  }
  return speed;
}

template <int Dim> void add_along(std::array<RowField, Dim>& field, const NodeFoot<Dim>& f, double amount) {
  for (std::size_t d = 0; d < Dim; ++d) {
    field[d].row(f.row)[f.index] += amount * f.tie[d];
  }
}

/// An absorbing side's force on a node works on the way that the tie leaves it, not on that which absorb_row booked: the rest of it,
/// where its speed along the tie changes by `change`.
template <int Dim> double absorbed_by_tie(const Block<Dim>& b, const NodeFoot<Dim>& f, double change, double dt) {
  const std::array<double, Dim> force = absorbing_force(b, node_of<Dim>(b.grid, f.row, f.index));
  return 0.5 * dt * change * dot<Dim>(force, f.tie);
}

/// Is it the foot of its node, not that on the other side?
template <int Dim> bool is_own(const Embedding<Dim>& e, const Grid& g, const NodeFoot<Dim>& f) { return &e.now.feet[static_cast<std::size_t>(e.now.foot_of[node_at(g, f.row, f.index)])] == &f; }

} // namespace

template <int Dim> Embedding<Dim>* embedding_of(const Scene<Dim>& scene, const Block<Dim>& b) {
  for (const auto& e : scene.embedded) {
    if (&scene.blocks[static_cast<std::size_t>(e->block)] == &b) {
      return e.get();
    }
  }
  return nullptr;
}

template <int Dim> void tie_nodes(Scene<Dim>& scene, Embedding<Dim>& e) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  join_wisps(scene, e, b);
  find_touching(scene, e, b);
  collect_nodes(scene, e);
  e.least_width = std::numeric_limits<double>::infinity();
  for (const CutCell<Dim>& c : e.cut) {
    e.least_width = std::min(e.least_width, c.width);
  }
  e.start.clear();
  e.kinetic.clear();
  std::vector<std::vector<typename LayerLoad<Dim>::Vector>> impulse;
  for (const Layers<Dim>& l : scene.layers) {
    e.start.push_back(l.stack.position);
    e.kinetic.push_back(kinetic_of(l.stack, l.load));
    impulse.emplace_back(l.load.node.size(), LayerLoad<Dim>::Vector::Zero());
  }
  parallel_ranges(*scene.pool, static_cast<int>(e.now.feet.size()), [&](int begin, int end, int) {
    for (auto at = static_cast<std::size_t>(begin); at < static_cast<std::size_t>(end); ++at) {
      NodeFoot<Dim>& f = e.now.feet[at];
      if (is_own(e, b.grid, f)) {
        const std::array<int, 3> node = node_of<Dim>(b.grid, f.row, f.index);
        f.tied = find_tie(b, node, f) && is_tied(e, b, f, node);
      }
    }
  });
  for (const NodeFoot<Dim>& f : e.now.feet) {
    const double mass = b.node_mass.row(f.row)[f.index];
    if (!f.tied || !(mass > 0)) {
      continue;
    }
    const auto s = static_cast<std::size_t>(f.stack);
    const auto n = vector_of<Dim>(f.carry);
    const double excess = speed_along<Dim>(b.velocity, f) - surface_speed<Dim>(scene, f, f.carry);
    for_foot(scene.layers[s].load, f.foot, [&](std::size_t at, double w) {
      scene.layers[s].load.added[at] += w * mass * n * n.transpose();
      impulse[s][at] += w * mass * excess * n;
    });
  }
  for (std::size_t s = 0; s < scene.layers.size(); ++s) {
    Layers<Dim>& l = scene.layers[s];
    l.load.spread(l.stack.node_count());
    const std::vector<unsigned char> held = held_nodes(l.stack);
    for (std::size_t at = 0; at < l.load.node.size(); ++at) {
      const std::size_t n = l.load.node[at];
      const unsigned bits = held[n % held.size()];
      const auto change = pushed<Dim>(l.stack.mass[n], l.load.added[at], impulse[s][at], bits);
      const typename LayerLoad<Dim>::Vector carried = l.load.added[at] * change;
      for (int d = 0; d < Dim; ++d) {
        l.stack.velocity[static_cast<std::size_t>(d)][n] += change[d];
        l.ledger.edge_impulse[static_cast<std::size_t>(d)] -= (bits >> d & 1) != 0 ? impulse[s][at][d] - carried[d] : 0.0;
      }
    }
  }
  for (const NodeFoot<Dim>& f : e.now.feet) {
    const double mass = b.node_mass.row(f.row)[f.index], now = speed_along<Dim>(b.velocity, f), then = surface_speed<Dim>(scene, f, f.carry);
    if (f.tied && mass > 0) {
      scene.ledger.embedded_given -= mass * (then - now) * (mean_along<Dim>(b, b.velocity, b.sliding.jump, f) + 0.5 * (then - now));
      add_along<Dim>(b.velocity, f, then - now);
      book_wall(scene.ledger, f, mass * (now - then));
    } else if (!(f.foot.level > 0) && !(mass > 0) && is_own(e, b.grid, f)) { // nothing hangs on it: it goes along
      for (std::size_t d = 0; d < Dim; ++d) {
        b.velocity[d].row(f.row)[f.index] = 0;
      }
      add_along<Dim>(b.velocity, f, then);
    }
  }
}

template <int Dim> void load_layers(Scene<Dim>& scene, Embedding<Dim>& e, double dt) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  for (const NodeFoot<Dim>& f : e.now.feet) {
    const double mass = b.node_mass.row(f.row)[f.index];
    if (!f.tied || !(mass > 0)) {
      continue;
    }
    const double force = mass * (speed_along<Dim>(b.next_velocity, f) - speed_along<Dim>(b.velocity, f)) / dt;
    LayerLoad<Dim>& load = scene.layers[static_cast<std::size_t>(f.stack)].load;
    for_foot(load, f.foot, [&](std::size_t at, double w) { load.force[at] += w * force * vector_of<Dim>(f.carry); });
  }
  for (std::size_t at_cut = 0; at_cut < e.cut.size(); ++at_cut) {
    const CutCell<Dim>& c = e.cut[at_cut];
    const CutForce<Dim>& cf = e.force[at_cut];
    for (int p = 0; p < (1 << Dim); ++p) {
      const int at = c.foot[static_cast<std::size_t>(p)];
      const double push = cf.push[static_cast<std::size_t>(p)];
      if (at < 0 || push == 0) {
        continue;
      }
      const NodeFoot<Dim>& f = e.now.feet[static_cast<std::size_t>(at)];
      LayerLoad<Dim>& load = scene.layers[static_cast<std::size_t>(f.stack)].load;
      for_foot(load, f.foot, [&](std::size_t q, double w) { load.force[q] -= w * push * vector_of<Dim>(f.foot.normal); });
    }
  }
  for (std::size_t s = 0; s < scene.layers.size(); ++s) {
    Layers<Dim>& l = scene.layers[s];
    put_on(l.stack, l.load);
    book_new_force(l.stack, l.load, dt, l.ledger);
    l.ledger.load_work += kinetic_of(l.stack, l.load) - e.kinetic[s];
  }
}

template <int Dim> void follow_layers(Scene<Dim>& scene, Embedding<Dim>& e, double dt) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  for (Layers<Dim>& l : scene.layers) {
    const double loaded = kinetic_of(l.stack, l.load);
    take_off(l.stack, l.load);
    l.ledger.load_work += kinetic_of(l.stack, l.load) - loaded;
  }
  const bool absorbs = b.boundary.any(BoundaryKind::absorbing);
  double gained = 0; // by the block, of tied nodes and at the surface
  for (const NodeFoot<Dim>& f : e.now.feet) {
    const double mass = b.node_mass.row(f.row)[f.index];
    const double then = surface_speed<Dim>(scene, f, f.carry);
    if (f.tied && mass > 0) {
      const double unbound = speed_along<Dim>(b.next_velocity, f);
      const double mean = 0.5 * (mean_along<Dim>(b, b.velocity, b.sliding.jump, f) + mean_along<Dim>(b, b.next_velocity, b.sliding.next_jump, f));
      gained += mass * (then - unbound) * (mean + 0.5 * (then - unbound));
      scene.ledger.boundary_work += absorbs ? absorbed_by_tie(b, f, then - unbound, dt) : 0.0;
      add_along<Dim>(b.next_velocity, f, then - unbound);
      book_wall(scene.ledger, f, mass * (unbound - then));
      add_along<Dim>(b.next_position, f, 0.5 * dt * (then - unbound));
    } else if (!(f.foot.level > 0) && !(mass > 0) && is_own(e, b.grid, f)) {
      for (std::size_t d = 0; d < Dim; ++d) {
        b.next_velocity[d].row(f.row)[f.index] = then * f.tie[d];
        b.next_position[d].row(f.row)[f.index] = b.position[d].row(f.row)[f.index] + dt * then * f.tie[d];
      }
    }
  }
  for (std::size_t at_cut = 0; at_cut < e.cut.size(); ++at_cut) {
    const CutCell<Dim>& c = e.cut[at_cut];
    const CutForce<Dim>& cf = e.force[at_cut];
    for (int p = 0; p < (1 << Dim); ++p) {
      const int at = c.foot[static_cast<std::size_t>(p)];
      if (at >= 0) {
        gained += cf.push[static_cast<std::size_t>(p)] * surface_way(scene, e, e.now.feet[static_cast<std::size_t>(at)]);
      }
    }
  }
  scene.ledger.embedded_given -= gained;
}

#define BALLAST_INSTANTIATE(D)                                               \
  template Embedding<D>* embedding_of<D>(const Scene<D>&, const Block<D>&);  \
  template void tie_nodes<D>(Scene<D>&, Embedding<D>&);                      \
  template void load_layers<D>(Scene<D>&, Embedding<D>&, double);            \
  template void follow_layers<D>(Scene<D>&, Embedding<D>&, double);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
