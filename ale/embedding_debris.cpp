#include "ale/embedding_debris.hpp"

#include "ale/embedding_cells.hpp"
#include "ale/embedding_remap.hpp"
#include "ale/phases.hpp"

#include <utility>

namespace ballast {

namespace {

constexpr double stays = 1e-6;     ///< of a node's mass: it goes on having one
constexpr double most_of_void = 0.9; ///< of a cell's void, taken at once

/// Nodes that no element is left at.
template <int Dim> std::vector<char> free_nodes(const LayerStack<Dim>& s) {
  std::vector<char> free(s.node_count(), 1);
  for (int level = 0; level < s.grid.levels(); ++level) {
    for (int j = 0; j < (Dim == 3 ? s.grid.elements[1] : 1); ++j) {
      for (int i = 0; i < s.grid.elements[0]; ++i) {
        for (int corner = 0; corner < (1 << Dim) && s.alive[s.element(i, j, level)] != 0; ++corner) {
          const int up = corner >> (Dim - 1) & 1, along = corner & 1, across = Dim == 3 ? corner >> 1 & 1 : 0;
          free[s.node(i + along, j + across, s.plane_below(level) + up)] = 0;
        }
      }
    }
  }
  return free;
}

template <int Dim> class Shedder {
public:
  Shedder(Scene<Dim>& scene, const Embedding<Dim>& e, Block<Dim>& b) : scene_(scene), e_(e), b_(b) {
    for (std::size_t a = 0; a < Dim; ++a) {
      for (int n = 0; n <= b.grid.cells[a]; ++n) {
        const int r = b.grid.node_row(a == 1 ? n : 0, a == 2 ? n : 0);
        lines_[a].push_back(b.position[a].row(r)[a == 0 ? n : 0]);
      }
    }
  }

  bool run() {
    bool any = false;
    for (Layers<Dim>& l : scene_.layers) {
      if (l.debris < 0 || l.ledger.eroded_elements == 0) {
        continue;
      }
      const std::vector<char> free = free_nodes(l.stack);
      for (std::size_t n = 0; n < free.size(); ++n) {
        any = (free[n] != 0 && shed(l, n)) || any;
      }
    }
    return any;
  }

private:
  /// The open cell near a stack that a place lies in.
  bool cell_of(const std::array<double, Dim>& x, std::array<int, 3>& cell) const {
    cell = {0, 0, 0};
    for (std::size_t a = 0; a < Dim; ++a) {
      const auto above = std::upper_bound(lines_[a].begin(), lines_[a].end(), x[a]) - lines_[a].begin();
      if (above == 0 || above == static_cast<std::ptrdiff_t>(lines_[a].size())) {
        return false;
      }
      cell[a] = static_cast<int>(above) - 1;
    }
    const int along = cell[Dim - 1];
    return along >= e_.rows.begin && along + 1 < e_.rows.end && e_.kind_of(b_.grid, b_.grid.cell_row(cell[1], cell[2]), cell[0]) == open_cell;
  }

  bool shed(Layers<Dim>& l, std::size_t n) {
    std::array<double, Dim> x{}, u{};
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] = l.stack.position[d][n];
      u[d] = l.stack.velocity[d][n];
    }
    std::array<int, 3> cell{};
    double& has = l.stack.mass[n];
    const double spare = has - stays * l.whole_mass[n];
    const bool pulled = std::any_of(l.stack.force.begin(), l.stack.force.end(), [&](const std::vector<double>& f) { return f[n] != 0; }); // by what holds the edge
    if (!(spare > stays * l.whole_mass[n]) || pulled || !cell_of(x, cell)) {
      return false;
    }
    MaterialSlot& slot = b_.materials[static_cast<std::size_t>(l.debris)];
    TileStore& gap = b_.materials.back().store;
    const int r = b_.grid.cell_row(cell[1], cell[2]), i = cell[0];
    const double volume = b_.volume.row(r)[i], room = most_of_void * std::as_const(gap).row(field::fraction, r)[i] * volume;
    const double mass = std::min(spare, room * slot.reference.rho);
    if (!(mass > stays * l.whole_mass[n])) {
      return false;
    }
    const double heat = push(slot, cell, mass, u);
    slot.store.allocate(slot.store.tile_of(r));
    const double share = mass / slot.reference.rho / volume, before = slot.store.row(field::mass, r)[i], all = before + mass;
    for (int f = field::energy; f < slot.store.conserved(); ++f) { // what it remembers is that of rest: zero
      double& value = slot.store.row(f, r)[i];
      value = (before * value + (f == field::energy ? mass * slot.reference.e + heat : 0.0)) / all;
    }
    slot.store.row(field::fraction, r)[i] += share;
    slot.store.row(field::mass, r)[i] = all;
    gap.row(field::fraction, r)[i] -= share;
    has -= mass;
    compute_owner(b_, r, {i, i + 1});
    scene_.ledger.energy_out -= mass * slot.reference.e; // it brings what its material has at rest
    scene_.ledger.mass_out[static_cast<std::size_t>(l.debris)] -= mass;
    return true;
  }

  /// Gives a mass of velocity u to a cell's nodes; the kinetic energy (J) that this costs.
  double push(const MaterialSlot& slot, const std::array<int, 3>& cell, double mass, const std::array<double, Dim>& u) {
    double lost = 0;
    for (int p = 0; p < (1 << Dim); ++p) {
      const auto step = corner_step<Dim>(p);
      int bits = 0;
      for (int a = 0; a < Dim; ++a) {
        bits |= step[static_cast<std::size_t>(a)] << a;
      }
      const std::array<int, 3> node = {cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]};
      lost += push_node(slot.slides, node, mass * corner_share(b_, bits, cell[0], cell[1], cell[2]), u);
    }
    return lost;
  }

  double push_node(bool slides, const std::array<int, 3>& node, double mass, const std::array<double, Dim>& u) {
    const int r = b_.grid.node_row(node[1], node[2]), n = node[0];
    double& all = b_.node_mass.row(r)[n];
    const bool two = b_.any_sliding();
    const double sliding = two ? b_.sliding.node_mass.row(r)[n] : 0.0, own = slides ? sliding : all - sliding;
    double lost = 0;
    std::array<double, Dim> of_slide{}, of_rest{};
    for (std::size_t d = 0; d < Dim; ++d) {
      of_slide[d] = velocity_of(b_, true, d, r, n);
      of_rest[d] = velocity_of(b_, false, d, r, n);
      double& v = slides ? of_slide[d] : of_rest[d];
      const double way = holds(node, d) ? 0.0 : u[d]; // a wall takes what goes into it
      scene_.ledger.momentum_out[d] += mass * (u[d] - way);
      lost += 0.5 * (own * mass / (own + mass) * (way - v) * (way - v) + mass * (u[d] * u[d] - way * way));
      v = (own * v + mass * way) / (own + mass);
    }
    all += mass;
    if (two && slides) {
      b_.sliding.node_mass.row(r)[n] += mass;
    }
    const double follows = two ? remap::node_follows(b_.sliding.node_mass.row(r)[n], all) : 0.0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double jump = of_slide[d] - of_rest[d];
      b_.velocity[d].row(r)[n] = two ? of_rest[d] + follows * jump : of_rest[d];
      if (two) {
        b_.sliding.jump[d].row(r)[n] = jump;
      }
    }
    return lost;
  }

  /// Is the node on a side that fixes its velocity along d?
  bool holds(const std::array<int, 3>& node, std::size_t d) const {
    bool held = false;
    for (int axis = 0; axis < Dim; ++axis) {
      const int at = node[static_cast<std::size_t>(axis)];
      for (const int side : {0, 1}) {
        held = held || (at == (side == 0 ? 0 : b_.grid.cells[static_cast<std::size_t>(axis)]) && b_.boundary.fixes_normal_velocity(axis, side) &&
                        b_.boundary.normal_of(axis, side) == static_cast<int>(d));
      }
    }
    return held;
  }

  Scene<Dim>& scene_;
  const Embedding<Dim>& e_;
  Block<Dim>& b_;
  std::array<std::vector<double>, Dim> lines_;
};

} // namespace

template <int Dim> void shed_debris(Scene<Dim>& scene, const Embedding<Dim>& e, Block<Dim>& b) {
  if (!Shedder<Dim>(scene, e, b).run()) {
    return;
  }
  compute_node_mass(b, *scene.pool);
  if (b.any_sliding()) {
    settle_jumps(b, *scene.pool);
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    exchange_nodes(b.grid, b.boundary, static_cast<int>(d), b.velocity[d]);
  }
}

template void shed_debris<2>(Scene<2>&, const Embedding<2>&, Block<2>&);
template void shed_debris<3>(Scene<3>&, const Embedding<3>&, Block<3>&);

} // namespace ballast
