// What room bodies leave to cells, and how it comes and goes.
#include "ale/embedding_cells.hpp"
#include "ale/phases.hpp"
#include "ale/traction.hpp"

#include <utility>

namespace ballast {

namespace {

constexpr double alike = 0.1;            ///< of a root, at least, is what fills most of its sliver
constexpr double largest_jump = 0.02;    ///< of its room: what its room may grow beyond what its nodes and the body moved

/// Volumes of the cell's materials become `parts` of `volume`; what is missing is void.
template <int Dim> void set_volumes(Block<Dim>& b, int r, int i, double volume, const std::vector<double>& parts) {
  double sum = 0;
  const auto hole = static_cast<std::size_t>(b.void_index());
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    sum += m == hole ? 0.0 : parts[m];
  }
  const double shrink = sum > volume ? volume / sum : 1.0;
  double left = 1;
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    if (m != hole && b.materials[m].store.has_row(r)) {
      const double f = parts[m] * shrink / volume;
      b.materials[m].store.row(field::fraction, r)[i] = f;
      left -= f;
    }
  }
  TileStore& gap = b.materials[hole].store;
  gap.allocate(gap.tile_of(r));
  gap.row(field::fraction, r)[i] = left > 1e-14 ? left : 0.0;
  compute_owner(b, r, {i, i + 1});
}

template <int Dim> std::vector<double> volumes_of(const Block<Dim>& b, int r, int i, double volume) {
  std::vector<double> parts;
  for (const MaterialSlot& slot : b.materials) {
    parts.push_back(slot.store.row(field::fraction, r)[i] * volume);
  }
  return parts;
}

template <int Dim> bool holds_mass(const Block<Dim>& b, int r, int i) {
  double mass = 0;
  for (const MaterialSlot& slot : b.materials) {
    mass += slot.is_void ? 0.0 : slot.store.row(field::mass, r)[i];
  }
  return mass > 0;
}

/// All of what the cell holds goes; void is left.
template <int Dim> void empty_cell(Block<Dim>& b, int r, int i) {
  for (MaterialSlot& slot : b.materials) {
    for (int f = 0; f < slot.store.conserved() && slot.store.has_row(r) && !slot.is_void; ++f) {
      slot.store.row(f, r)[i] = 0;
    }
  }
  TileStore& gap = b.materials.back().store;
  gap.allocate(gap.tile_of(r));
  gap.row(field::fraction, r)[i] = 1;
}

} // namespace

/// A sliver's root: the neighbour behind its widest opening, weighed by its own room.
template <int Dim> static void find_roots(const Block<Dim>& b, Embedding<Dim>& e) {
  const Grid& g = b.grid;
  for (CutCell<Dim>& c : e.cut) {
    const double volume = b.volume.row(c.row)[c.cell[0]];
    double best = 0;
    c.root = -1;
    std::size_t main = 0; // what fills most of the sliver
    for (std::size_t m = 1; m < b.materials.size(); ++m) {
      const auto f = [&](std::size_t q) { return b.materials[q].store.row(field::fraction, c.row)[c.cell[0]]; };
      main = f(m) > f(main) ? m : main;
    }
    for (int axis = 0; axis < Dim && volume < sliver_share * c.whole; ++axis) {
      for (const int side : {-1, 1}) {
        std::array<int, 3> to = c.cell;
        const auto a = static_cast<std::size_t>(axis);
        to[a] += side;
        if (to[a] < 0 || to[a] >= g.cells[a]) {
          continue;
        }
        const int r = g.cell_row(to[1], to[2]);
        const bool solid = b.materials[main].store.row(field::fraction, r)[to[0]] > alike; // else a sliver is on its own
        const double room = e.kind_of(g, r, to[0]) == covered_cell || !solid ? 0.0 : b.volume.row(r)[to[0]];
        const double opening = face_opening<Dim>(g, e.now, axis, side < 0 ? c.cell : to);
        if (room > volume && opening * room > best) {
          best = opening * room;
          c.root = static_cast<int>(e.cell_at(g, r, to[0]));
          c.root_cell = to;
        }
      }
    }
  }
}

/// True if elements have gone since.
template <int Dim> static bool keep_alive(const Scene<Dim>& scene, Embedding<Dim>& e) {
  const auto before = std::exchange(e.alive, {});
  for (const Layers<Dim>& l : scene.layers) {
    e.alive.push_back(l.stack.alive);
  }
  return e.alive != before;
}

template <int Dim> static void find_bodies_of_alive(Scene<Dim>& scene, Embedding<Dim>& e) {
  find_least_thickness(scene, e);
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  e.now = find_levels<Dim>(b.grid, b.position, bodies_of(scene, e), *scene.pool);
  find_cells<Dim>(b, b.position, e.now, *scene.pool, e.kind, e.cut);
  e.rows = e.now.rows;
}

template <int Dim> void find_bodies(Scene<Dim>& scene, Embedding<Dim>& e) {
  keep_alive(scene, e);
  find_bodies_of_alive(scene, e);
}

template <int Dim> EmbeddingMemory memory_of(const Embedding<Dim>& e) {
  EmbeddingMemory out{e.alive, {}, e.rows, e.pockets};
  for (std::size_t c = 0; c < e.kind.size(); ++c) {
    if (e.kind[c] != open_cell) {
      out.cells.push_back(static_cast<std::int64_t>(c));
    }
  }
  return out;
}

template <int Dim> void find_bodies(Scene<Dim>& scene, Embedding<Dim>& e, const EmbeddingMemory& memory) {
  e.alive = memory.alive;
  e.pockets = memory.pockets;
  find_bodies_of_alive(scene, e);
  e.rows = both_rows(e.rows, memory.rows);
  for (const std::int64_t c : memory.cells) { // the next step frees those that have become open
    int& kind = e.kind.at(static_cast<std::size_t>(c));
    kind = kind == open_cell ? covered_cell : kind;
  }
}

template <int Dim> void prepare_embedding(Scene<Dim>& scene, Embedding<Dim>& e) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  find_bodies(scene, e);
  for_cells<Dim>(g, [&](int i, int j, int k) {
    const int r = g.cell_row(j, k), kind = e.kind_of(g, r, i);
    if (kind == covered_cell) {
      empty_cell(b, r, i);
    } else if (kind >= 0) {
      const double whole = b.volume.row(r)[i], open = e.cut[static_cast<std::size_t>(kind)].open;
      std::vector<double> parts = volumes_of(b, r, i, whole);
      double& gap = parts.back(); // void gives way first
      const double taken = std::min(gap, whole - open), left = whole - gap;
      gap -= taken;
      const double keep = left > 0 ? (open - gap) / left : 1.0;
      for (std::size_t m = 0; m + 1 < parts.size(); ++m) {
        parts[m] *= keep;
        if (b.materials[m].store.has_row(r)) {
          b.materials[m].store.row(field::mass, r)[i] *= keep;
        }
      }
      b.volume.row(r)[i] = open;
      set_volumes(b, r, i, open, parts);
    }
  });
}

/// Volumes that have changed though nothing moved: elements have gone. Void takes their room. True if there were any.
template <int Dim> static bool take_room(Block<Dim>& b, Embedding<Dim>& e) {
  bool changed = false;
  for (const CutCell<Dim>& c : e.cut) {
    const int r = c.row, i = c.cell[0];
    double& volume = b.volume.row(r)[i];
    if (std::abs(c.open - volume) > 1e-12 * c.whole) {
      const std::vector<double> parts = holds_mass(b, r, i) ? volumes_of(b, r, i, volume) : std::vector<double>(b.materials.size(), 0.0);
      volume = std::max(c.open, (1 - e.squeeze) * (volume - parts.back()));
      set_volumes(b, r, i, volume, parts);
      changed = true;
    }
  }
  return changed;
}

template <int Dim> void set_squeeze(const Scene<Dim>& scene, Embedding<Dim>& e, double dt) {
  constexpr double usual = 0.05; // of the time sound takes through the finest cell: ordinary steps are longer
  double square = 0;             // of the fastest material's sound speed at the start
  for (const MaterialSlot& slot : scene.blocks[static_cast<std::size_t>(e.block)].materials) {
    square = slot.is_void ? square : std::max(square, sound_speed_squared(slot.material.eos, slot.reference.rho, slot.reference.e));
  }
  const double width = 0.5 * e.bin;
  e.squeeze = most_squeeze * std::min(1.0, dt * std::sqrt(square) / (usual * width));
}

template <int Dim> void update_cells(Scene<Dim>& scene, Embedding<Dim>& e) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  const std::vector<int> before = std::exchange(e.kind, {});
  if (keep_alive(scene, e)) { // else they are where the last step left them
    find_least_thickness(scene, e);
    e.now = find_levels<Dim>(g, b.position, bodies_of(scene, e), *scene.pool);
  }
  find_cells<Dim>(b, b.position, e.now, *scene.pool, e.kind, e.cut);
  const Span were = std::exchange(e.rows, e.now.rows);
  bool changed = take_room(b, e);
  const auto free_cell = [&](int i, int j, int k) {
    const int r = g.cell_row(j, k);
    const double whole = whole_volume<Dim>(b, b.position, i, j, k);
    double& volume = b.volume.row(r)[i];
    if (std::abs(whole - volume) > 1e-12 * whole) {
      const std::vector<double> parts = holds_mass(b, r, i) ? volumes_of(b, r, i, volume) : std::vector<double>(b.materials.size(), 0.0);
      volume = whole;
      set_volumes(b, r, i, whole, parts);
      changed = true;
    }
  };
  for_cells_beside<Dim>(g, were, [&](int i, int j, int k) {
    const std::size_t at = e.cell_at(g, g.cell_row(j, k), i);
    if (e.kind[at] == open_cell && before[at] != open_cell) {
      free_cell(i, j, k);
    }
  });
  for (const Pocket& p : e.pockets) { // that the last remap found free
    if (e.kind[e.cell_at(g, g.cell_row(p.cell[1], p.cell[2]), p.cell[0])] == open_cell) {
      free_cell(p.cell[0], p.cell[1], p.cell[2]);
    }
  }
  if (changed) {
    update_state(b, *scene.pool);
    update_traction(b, *scene.pool);
  }
  find_roots(b, e);
}

/// Share of a cell at most that the body and its nodes' own motion cover in this step.
template <int Dim> static double entered(const Scene<Dim>& scene, const Embedding<Dim>& e, const Block<Dim>& b, const std::array<int, 3>& cell) {
  constexpr double slanted = 1.5;
  double way = 0;
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto step = corner_step<Dim>(p);
    const int r = b.grid.node_row(cell[1] + step[1], cell[2] + step[2]), n = cell[0] + step[0], at = e.next.foot_of[node_at(b.grid, r, n)];
    if (at < 0) {
      continue;
    }
    const NodeFoot<Dim>& f = e.next.feet[static_cast<std::size_t>(at)];
    double closing = surface_way(scene, e, f);
    for (std::size_t d = 0; d < Dim; ++d) {
      closing -= f.foot.normal[d] * (b.next_position[d].row(r)[n] - b.position[d].row(r)[n]);
    }
    way = std::max(way, closing);
  }
  return std::min(1.0, slanted * way / edges_at<Dim>(b.grid, b.next_position, cell[0], cell[1], cell[2])[1]);
}

template <int Dim> void embedded_volumes(Scene<Dim>& scene, Embedding<Dim>& e) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  find_least_thickness(scene, e);
  e.next = find_levels<Dim>(g, b.next_position, bodies_of(scene, e), *scene.pool);
  const Levels<Dim>& next = e.next;
  const auto find_volume = [&](int i, int j, int k) {
    const int r = g.cell_row(j, k);
    if (open_corners<Dim>(g, next, i, j, k) == 1 << Dim && e.kind_of(g, r, i) == open_cell) {
      return;
    }
    const LevelCell<Dim> c = level_cell<Dim>(g, b.next_position, next, {i, j, k});
    double& volume = b.next_volume.row(r)[i];
    const double open = c.covered() ? 0.0 : open_volume(c, b.axisymmetric), old = b.volume.row(r)[i];
    if (!holds_mass(b, r, i)) {
      volume = open > least_open * volume ? open : volume;
      return;
    }
    // Where a body's shape jumps (a face folds, a foot goes elsewhere) what is there neither stretches nor is crushed with it: more room
    // becomes void in the next step, less is taken bit by bit, and what a body would bury waits for the remap to hand it on.
    const double gap = std::as_const(b).materials.back().store.row(field::fraction, r)[i], held = (1 - gap) * old; // there may be no void near
    const int kind = e.kind_of(g, r, i);
    const bool alone = kind >= 0 && is_sliver(e, b, r, i) && e.cut[static_cast<std::size_t>(kind)].root < 0; // no one's material flows after it
    const double moved = kind >= 0 ? 2 * (e.force[static_cast<std::size_t>(kind)].half.volume - e.cut[static_cast<std::size_t>(kind)].open) : 0.0;
    const double most = alone ? held * (1 + largest_jump) : std::max(old + moved, held) + largest_jump * old;
    const double pressed = kind >= 0 ? moved : -old * entered<Dim>(scene, e, b, {i, j, k});
    const double least = (1 - e.squeeze) * std::min(old + pressed, held);
    volume = open > 0 ? std::clamp(open, least, std::max({most, least, gap > 0 ? open : 0.0})) : old;
    if (kind >= 0 && is_sliver(e, b, r, i)) { // as a pure one is; a mixed one's follows
      e.cut[static_cast<std::size_t>(kind)].scaled = volume / old;
    }
  };
  parallel_rows(*scene.pool, rows_beside<Dim>(g, both_rows(e.rows, next.rows)), [&](int, int j, int k) {
    for (int i = 0; i < g.cells[0]; ++i) {
      find_volume(i, j, k);
    }
  });
}

#define BALLAST_INSTANTIATE(D) \
  template void find_bodies<D>(Scene<D>&, Embedding<D>&); \
  template void find_bodies<D>(Scene<D>&, Embedding<D>&, const EmbeddingMemory&); \
  template EmbeddingMemory memory_of<D>(const Embedding<D>&); \
  template void prepare_embedding<D>(Scene<D>&, Embedding<D>&); \
  template void set_squeeze<D>(const Scene<D>&, Embedding<D>&, double); \
  template void update_cells<D>(Scene<D>&, Embedding<D>&); \
  template void embedded_volumes<D>(Scene<D>&, Embedding<D>&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
