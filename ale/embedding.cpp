// Where the bodies are: levels of nodes, kinds of cells, open volumes.
#include "ale/embedding.hpp"

#include "ale/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

constexpr double reach_in_edges = 2.2;   ///< of a node's longest edge: all nodes of cut cells and of their neighbours
constexpr double least_open = 1e-10;     ///< of a cell: less is covered
constexpr double alike = 0.1;            ///< of a root, at least, is what fills most of its sliver
constexpr double largest_jump = 0.02;    ///< of a cell: what its room may grow beyond what its nodes and the body moved
constexpr double keeps_of_room = 0.85;   ///< of what a cell's materials fill, at least, when a body takes their room

/// Longest and shortest edge at a node, m.
template <int Dim> std::array<double, 2> edges_at(const Grid& g, const std::array<RowField, Dim>& x, int i, int j, int k) {
  double longest = 0, shortest = std::numeric_limits<double>::infinity();
  const int index[3] = {i, j, k};
  for (int a = 0; a < Dim; ++a) {
    for (const int side : {-1, 1}) {
      int to[3] = {i, j, k};
      to[a] += side;
      if (to[a] < 0 || to[a] > g.cells[static_cast<std::size_t>(a)]) {
        continue;
      }
      double square = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double dx = x[d].row(g.node_row(to[1], to[2]))[to[0]] - x[d].row(g.node_row(index[1], index[2]))[index[0]];
        square += dx * dx;
      }
      longest = std::max(longest, std::sqrt(square));
      shortest = std::min(shortest, std::sqrt(square));
    }
  }
  return {longest, shortest};
}

template <int Dim, class Visit> void for_nodes(const Grid& g, Visit&& body) {
  for (int k = 0; k <= (Dim == 3 ? g.cells[2] : 0); ++k) {
    for (int j = 0; j <= g.cells[1]; ++j) {
      for (int i = 0; i <= g.cells[0]; ++i) {
        body(i, j, k);
      }
    }
  }
}

template <int Dim, class Visit> void for_cells(const Grid& g, Visit&& body) {
  for (int k = 0; k < g.cells[2]; ++k) {
    for (int j = 0; j < g.cells[1]; ++j) {
      for (int i = 0; i < g.cells[0]; ++i) {
        body(i, j, k);
      }
    }
  }
}

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

/// Corners of a cell outside bodies.
template <int Dim> int open_corners(const Grid& g, const Levels<Dim>& levels, int i, int j, int k) {
  int count = 0;
  for (int q = 0; q < (1 << (Dim - 1)); ++q) {
    const double* level = levels.level.row(g.node_row(j + (q & 1), k + (q >> 1))) + i;
    count += (level[0] > 0 ? 1 : 0) + (level[1] > 0 ? 1 : 0);
  }
  return count;
}

template <int Dim> double whole_volume(const Block<Dim>& b, const std::array<RowField, Dim>& x, int i, int j, int k) {
  std::vector<double> v(static_cast<std::size_t>(i + 1));
  cell_volumes(b, x, j, k, {i, i + 1}, v.data());
  return v.back();
}

} // namespace

template <int Dim> std::vector<LayerBody<Dim>> bodies_of(const Scene<Dim>& scene, const Embedding<Dim>& e) {
  std::vector<LayerBody<Dim>> out;
  for (std::size_t s = 0; s < scene.layers.size(); ++s) {
    out.emplace_back(scene.layers[s].stack, e.alive[s], e.least_thickness[s], e.bin);
    out.back().set_longest_reach(reach_in_edges * e.longest_edge);
  }
  return out;
}

template <int Dim>
Levels<Dim> find_levels(const Grid& g, const std::array<RowField, Dim>& position, const std::vector<LayerBody<Dim>>& bodies, const Levels<Dim>* before) {
  Levels<Dim> out;
  out.level = RowField::of_nodes(g, 1.0);
  out.foot_of.assign(static_cast<std::size_t>(g.node_pitch()) * static_cast<std::size_t>(g.node_rows()), -1);
  double longest = 0; // far from the stacks edges may be longer: there nothing is near
  for (const LayerBody<Dim>& body : bodies) {
    longest = std::max(longest, body.longest_reach());
  }
  for_nodes<Dim>(g, [&](int i, int j, int k) {
    const int r = g.node_row(j, k);
    std::array<double, Dim> x{};
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] = position[d].row(r)[i];
    }
    bool near = false;
    for (const LayerBody<Dim>& body : bodies) {
      near = near || body.near(x, longest);
    }
    if (!near) {
      return;
    }
    const double reach = reach_in_edges * edges_at<Dim>(g, position, i, j, k)[0];
    NodeFoot<Dim> best{{}, -1, r, i, -1, false, {}, {}};
    for (std::size_t s = 0; s < bodies.size(); ++s) {
      BodyFoot<Dim> f;
      if (bodies[s].foot(x, reach, f) && (best.stack < 0 || f.level < best.foot.level)) {
        best.foot = f;
        best.stack = static_cast<int>(s);
      }
    }
    double& level = out.level.row(r)[i];
    if (best.stack >= 0) {
      level = best.foot.level;
      out.foot_of[node_at(g, r, i)] = static_cast<int>(out.feet.size());
      out.feet.push_back(best);
      BodyFoot<Dim> far;
      const auto body = static_cast<std::size_t>(best.stack);
      if (!(level > 0) && best.foot.side < 2 && bodies[body].foot(x, 2 * reach, far, 1 - best.foot.side)) {
        out.feet.back().other = static_cast<int>(out.feet.size());
        out.feet.push_back({far, best.stack, r, i, -1, false, {}, {}});
      }
      return;
    }
    bool inside = false;
    if (before != nullptr) {
      inside = !(before->level.row(r)[i] > 0);
    } else {
      for (const LayerBody<Dim>& body : bodies) {
        inside = inside || body.inside(x);
      }
    }
    level = inside ? -reach : reach;
  });
  return out;
}

template <int Dim> int open_side(const Grid& g, const Levels<Dim>& levels, std::span<const std::array<int, 3>> nodes) {
  int side = -1;
  for (const std::array<int, 3>& n : nodes) {
    const int r = g.node_row(n[1], n[2]), at = levels.foot_of[node_at(g, r, n[0])];
    if (at < 0 || !(levels.level.row(r)[n[0]] > 0)) {
      continue;
    }
    const int here = levels.feet[static_cast<std::size_t>(at)].foot.side;
    if (here > 1 || (side >= 0 && here != side)) {
      return -1;
    }
    side = here;
  }
  return side;
}

template <int Dim> double level_on(const Grid& g, const Levels<Dim>& levels, const std::array<int, 3>& n, int side) {
  const int r = g.node_row(n[1], n[2]), at = foot_on(levels, node_at(g, r, n[0]), side);
  return at < 0 ? levels.level.row(r)[n[0]] : levels.feet[static_cast<std::size_t>(at)].foot.level;
}

template <int Dim>
LevelCell<Dim> level_cell(const Grid& g, const std::array<RowField, Dim>& position, const Levels<Dim>& levels, const std::array<int, 3>& cell, std::array<int, 1 << Dim>* feet) {
  LevelCell<Dim> out;
  std::array<std::array<int, 3>, 1 << Dim> nodes;
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto step = corner_step<Dim>(p);
    nodes[static_cast<std::size_t>(p)] = {cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]};
  }
  const int side = open_side<Dim>(g, levels, nodes);
  for (std::size_t p = 0; p < nodes.size(); ++p) {
    const int r = g.node_row(nodes[p][1], nodes[p][2]), i = nodes[p][0];
    for (std::size_t d = 0; d < Dim; ++d) {
      out.x[p][d] = position[d].row(r)[i];
    }
    out.level[p] = level_on<Dim>(g, levels, nodes[p], side);
    if (feet != nullptr) {
      (*feet)[p] = foot_on(levels, node_at(g, r, i), side);
    }
  }
  return out;
}

template <int Dim>
void find_cells(const Block<Dim>& b, const std::array<RowField, Dim>& position, const Levels<Dim>& levels, std::vector<int>& kind, std::vector<CutCell<Dim>>& cut) {
  const Grid& g = b.grid;
  kind.assign(static_cast<std::size_t>(g.cell_pitch()) * static_cast<std::size_t>(g.cell_rows()), open_cell);
  cut.clear();
  for_cells<Dim>(g, [&](int i, int j, int k) {
    const int corners = open_corners<Dim>(g, levels, i, j, k);
    if (corners == 1 << Dim) {
      return;
    }
    int& what = kind[static_cast<std::size_t>(g.cell_row(j, k) * g.cell_pitch() + i + g.ghost[0])];
    if (corners == 0) {
      what = covered_cell;
      return;
    }
    std::array<int, 1 << Dim> feet{};
    const LevelCell<Dim> c = level_cell<Dim>(g, position, levels, {i, j, k}, &feet);
    const double whole = whole_volume<Dim>(b, position, i, j, k);
    if (!(open_volume(c, b.axisymmetric) > least_open * whole)) {
      what = covered_cell;
      return;
    }
    what = static_cast<int>(cut.size());
    cut.push_back({{i, j, k}, g.cell_row(j, k), whole, edges_at<Dim>(g, position, i, j, k)[1], 0, false, -1, {}, feet});
  });
}

template <int Dim> double face_opening(const Grid& g, const Levels<Dim>& levels, int axis, const std::array<int, 3>& above) {
  const auto nodes = face_nodes<Dim>(axis, above);
  const int side = open_side<Dim>(g, levels, nodes);
  std::array<double, 1 << (Dim - 1)> level{};
  for (std::size_t q = 0; q < nodes.size(); ++q) {
    level[q] = level_on<Dim>(g, levels, nodes[q], side);
  }
  return open_share<Dim>(level);
}

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

template <int Dim> static void keep_alive(const Scene<Dim>& scene, Embedding<Dim>& e) {
  e.alive.clear();
  for (const Layers<Dim>& l : scene.layers) {
    e.alive.push_back(l.stack.alive);
  }
}

template <int Dim> void find_bodies(Scene<Dim>& scene, Embedding<Dim>& e) {
  keep_alive(scene, e);
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  e.now = find_levels<Dim>(b.grid, b.position, bodies_of(scene, e), nullptr);
  find_cells<Dim>(b, b.position, e.now, e.kind, e.cut);
}

/// No cell may have open corners on both sides of a body: its thickness is a diagonal of the cells around it.
template <int Dim> static void find_least_thickness(const Scene<Dim>& scene, const Block<Dim>& b, Embedding<Dim>& e) {
  constexpr double spare = 1.05;
  const Grid& g = b.grid;
  e.bin = std::numeric_limits<double>::infinity();
  e.least_thickness.clear();
  for (const Layers<Dim>& l : scene.layers) {
    const LayerStack<Dim>& s = l.stack;
    const std::size_t count = s.node(0, 0, 1);
    std::vector<double> least(count, 0.0);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t n = 0; n < s.node_count(); ++n) {
      low = std::min(low, s.position[Dim - 1][n]);
      high = std::max(high, s.position[Dim - 1][n]);
    }
    for_nodes<Dim>(g, [&](int i, int j, int k) {
      const int r = g.node_row(j, k);
      const double at = b.position[Dim - 1].row(r)[i];
      const double edge = edges_at<Dim>(g, b.position, i, j, k)[0], slack = 2 * edge;
      if (at < low - slack || at > high + slack) {
        return;
      }
      e.bin = std::min(e.bin, 2 * edge);
      e.longest_edge = std::max(e.longest_edge, edge);
      for (std::size_t n = 0; n < count; ++n) {
        double off = 0;
        for (std::size_t d = 0; d + 1 < Dim; ++d) {
          off = std::max(off, std::abs(b.position[d].row(r)[i] - s.position[d][n]));
        }
        if (off <= 1.5 * edge) {
          least[n] = std::max(least[n], spare * std::sqrt(static_cast<double>(Dim)) * edge);
        }
      }
    });
    // Columns beyond the mesh bound faces that reach into it.
    const double most = least.empty() ? 0.0 : *std::max_element(least.begin(), least.end());
    std::replace(least.begin(), least.end(), 0.0, most);
    e.least_thickness.push_back(std::move(least));
  }
}

template <int Dim> void prepare_embedding(Scene<Dim>& scene, Embedding<Dim>& e) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  if (e.least_thickness.empty()) {
    find_least_thickness(scene, b, e);
  }
  find_bodies(scene, e);
  for_cells<Dim>(g, [&](int i, int j, int k) {
    const int r = g.cell_row(j, k), kind = e.kind_of(g, r, i);
    if (kind == covered_cell) {
      empty_cell(b, r, i);
    } else if (kind >= 0) {
      const double whole = b.volume.row(r)[i], open = open_volume(level_cell<Dim>(g, b.position, e.now, {i, j, k}), b.axisymmetric);
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

/// Volumes that have changed though nothing moved: elements have gone. Void takes their room.
template <int Dim> static void take_room(Block<Dim>& b, Embedding<Dim>& e) {
  const Grid& g = b.grid;
  for (const CutCell<Dim>& c : e.cut) {
    const int r = c.row, i = c.cell[0];
    const double open = open_volume(level_cell<Dim>(g, b.position, e.now, c.cell), b.axisymmetric);
    double& volume = b.volume.row(r)[i];
    if (std::abs(open - volume) > 1e-12 * c.whole) {
      const std::vector<double> parts = holds_mass(b, r, i) ? volumes_of(b, r, i, volume) : std::vector<double>(b.materials.size(), 0.0);
      volume = std::max(open, keeps_of_room * (volume - parts.back()));
      set_volumes(b, r, i, volume, parts);
    }
  }
}

template <int Dim> void update_cells(Scene<Dim>& scene, Embedding<Dim>& e) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  const std::vector<int> before = e.kind;
  keep_alive(scene, e);
  e.now = find_levels<Dim>(g, b.position, bodies_of(scene, e), &e.now);
  find_cells<Dim>(b, b.position, e.now, e.kind, e.cut);
  take_room(b, e);
  for_cells<Dim>(g, [&](int i, int j, int k) { // cells that have come free
    const int r = g.cell_row(j, k);
    const std::size_t at = e.cell_at(g, r, i);
    if (e.kind[at] == open_cell && before[at] != open_cell) {
      const double whole = whole_volume<Dim>(b, b.position, i, j, k);
      double& volume = b.volume.row(r)[i];
      if (std::abs(whole - volume) > 1e-12 * whole) {
        const std::vector<double> parts = holds_mass(b, r, i) ? volumes_of(b, r, i, volume) : std::vector<double>(b.materials.size(), 0.0);
        volume = whole;
        set_volumes(b, r, i, whole, parts);
      }
    }
  });
  find_roots(b, e);
}

template <int Dim> void embedded_volumes(Scene<Dim>& scene, Embedding<Dim>& e) {
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  const Grid& g = b.grid;
  e.next = find_levels<Dim>(g, b.next_position, bodies_of(scene, e), &e.now);
  const Levels<Dim>& next = e.next;
  for_cells<Dim>(g, [&](int i, int j, int k) {
    if (open_corners<Dim>(g, next, i, j, k) == 1 << Dim) {
      return;
    }
    const LevelCell<Dim> c = level_cell<Dim>(g, b.next_position, next, {i, j, k});
    const int r = g.cell_row(j, k);
    double& volume = b.next_volume.row(r)[i];
    const double open = c.covered() ? 0.0 : open_volume(c, b.axisymmetric), old = b.volume.row(r)[i];
    if (!holds_mass(b, r, i)) {
      volume = open > least_open * volume ? open : volume;
      return;
    }
    // Where a body's shape jumps (a face folds, a foot goes elsewhere) what is there neither stretches nor is crushed with it: more room
    // becomes void in the next step, less is taken bit by bit, and what a body would bury waits for the remap to hand it on.
    const double gap = b.materials.back().store.row(field::fraction, r)[i], held = (1 - gap) * old;
    const int kind = e.kind_of(g, r, i);
    const bool alone = kind >= 0 && is_sliver(e, b, r, i) && e.cut[static_cast<std::size_t>(kind)].root < 0; // no one's material flows after it
    const double moved = kind >= 0 ? 2 * (e.force[static_cast<std::size_t>(kind)].half.volume - old) : 0.0;
    const double most = alone ? held * (1 + largest_jump) : std::max(old + moved, held) + largest_jump * std::max(volume, old);
    volume = open > 0 ? std::clamp(open, keeps_of_room * held, std::max(most, gap > 0 ? open : 0.0)) : old;
  });
}

#define BALLAST_INSTANTIATE(D)                                                                                                                       \
  template std::vector<LayerBody<D>> bodies_of<D>(const Scene<D>&, const Embedding<D>&);                                                                  \
  template Levels<D> find_levels<D>(const Grid&, const std::array<RowField, D>&, const std::vector<LayerBody<D>>&, const Levels<D>*);                     \
  template LevelCell<D> level_cell<D>(const Grid&, const std::array<RowField, D>&, const Levels<D>&, const std::array<int, 3>&, std::array<int, 1 << D>*); \
  template int open_side<D>(const Grid&, const Levels<D>&, std::span<const std::array<int, 3>>);                                                       \
  template double level_on<D>(const Grid&, const Levels<D>&, const std::array<int, 3>&, int);                                                           \
  template void find_cells<D>(const Block<D>&, const std::array<RowField, D>&, const Levels<D>&, std::vector<int>&, std::vector<CutCell<D>>&);       \
  template double face_opening<D>(const Grid&, const Levels<D>&, int, const std::array<int, 3>&);                                                    \
  template void find_bodies<D>(Scene<D>&, Embedding<D>&);                                                                                            \
  template void prepare_embedding<D>(Scene<D>&, Embedding<D>&);                                                                                      \
  template void update_cells<D>(Scene<D>&, Embedding<D>&);                                                                                           \
  template void embedded_volumes<D>(Scene<D>&, Embedding<D>&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
