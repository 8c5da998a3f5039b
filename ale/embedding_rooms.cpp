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

/// Longest edges along each axis (m) of the cells around a place in the mesh that remaps lead to: of its own and two on either side.
template <int Dim> class EdgeFinder {
public:
  explicit EdgeFinder(const Block<Dim>& b) {
    const Grid& g = b.grid;
    for (std::size_t a = 0; a < Dim; ++a) {
      for (int n = 0; n <= g.cells[a]; ++n) {
        const int r = g.node_row(a == 1 ? n : 0, a == 2 ? n : 0);
        lines_[a].push_back(b.target[a].row(r)[a == 0 ? n : 0]);
      }
      for (int own = 0; own < g.cells[a]; ++own) {
        double longest = 0;
        for (int c = std::max(0, own - 2); c <= std::min(g.cells[a] - 1, own + 2); ++c) {
          longest = std::max(longest, lines_[a][static_cast<std::size_t>(c + 1)] - lines_[a][static_cast<std::size_t>(c)]);
        }
        longest_[a].push_back(longest);
      }
    }
  }
  std::array<double, Dim> at(const std::array<double, Dim>& x) const {
    std::array<double, Dim> longest{};
    for (std::size_t a = 0; a < Dim; ++a) {
      const std::vector<double>& line = lines_[a];
      const auto own = std::upper_bound(line.begin(), line.end(), x[a]) - line.begin() - 1;
      longest[a] = longest_[a][static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(own, 0, static_cast<std::ptrdiff_t>(line.size()) - 2))];
    }
    return longest;
  }

private:
  std::array<std::vector<double>, Dim> lines_, longest_;
};

/// Across the lower or upper face of an element, not unit.
template <int Dim> std::array<double, Dim> across_face(const LayerStack<Dim>& s, int i, int j, int plane) {
  const auto from = [&](int a, int b, int c, int d) { // one node to another
    const std::size_t low = s.node(i + a, j + b, plane), high = s.node(i + c, j + d, plane);
    std::array<double, Dim> out{};
    for (std::size_t n = 0; n < Dim; ++n) {
      out[n] = s.position[n][high] - s.position[n][low];
    }
    return out;
  };
  const std::array<double, Dim> u = from(0, 0, 1, Dim == 3 ? 1 : 0);
  if constexpr (Dim == 2) {
    return {-u[1], u[0]};
  } else {
    const std::array<double, Dim> v = from(1, 0, 0, 1);
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  }
}

/// No cell may have open corners on both sides of a body: across it the body is as thick as the cells around it are wide, wherever it is by now.
template <int Dim> void find_least_thickness(const Scene<Dim>& scene, Embedding<Dim>& e) {
  constexpr double spare = 1.4; // cells are stretched until the next remap, layers bend
  const EdgeFinder<Dim> edges(scene.blocks[static_cast<std::size_t>(e.block)]);
  e.bin = std::numeric_limits<double>::infinity();
  e.longest_edge = 0;
  e.least_thickness.clear();
  for (std::size_t q = 0; q < scene.layers.size(); ++q) {
    const LayerStack<Dim>& s = scene.layers[q].stack;
    const std::size_t count = s.node(0, 0, 1);
    std::vector<double> thickness(count, 0.0);
    const auto visit = [&](std::size_t n, const std::array<double, Dim>& across, double length) {
      std::array<double, Dim> x{};
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d] = s.position[d][n];
      }
      const std::array<double, Dim> edge = edges.at(x);
      double width = 0, longest = 0;
      for (std::size_t d = 0; d < Dim; ++d) {
        width += length > 0 ? std::abs(across[d]) / length * edge[d] : edge[d];
        longest = std::max(longest, edge[d]);
      }
      thickness[n % count] = std::max(thickness[n % count], spare * width);
      e.bin = std::min(e.bin, 2 * longest);
      e.longest_edge = std::max(e.longest_edge, longest);
    };
    for (int level = 0; level < s.grid.levels(); ++level) {
      for (int j = 0; j < (Dim == 3 ? s.grid.elements[1] : 1); ++j) {
        for (int i = 0; i < s.grid.elements[0]; ++i) {
          if (e.alive[q][s.element(i, j, level)] == 0) {
            continue;
          }
          for (const int plane : {s.plane_below(level), s.plane_below(level) + 1}) {
            const std::array<double, Dim> across = across_face<Dim>(s, i, j, plane);
            double square = 0;
            for (const double a : across) {
              square += a * a;
            }
            for (int corner = 0; corner < (1 << (Dim - 1)); ++corner) {
              visit(s.node(i + (corner & 1), j + (corner >> 1), plane), across, std::sqrt(square));
            }
          }
        }
      }
    }
    e.least_thickness.push_back(std::move(thickness));
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

template <int Dim> void find_bodies(Scene<Dim>& scene, Embedding<Dim>& e) {
  keep_alive(scene, e);
  find_least_thickness(scene, e);
  Block<Dim>& b = scene.blocks[static_cast<std::size_t>(e.block)];
  e.now = find_levels<Dim>(b.grid, b.position, bodies_of(scene, e), *scene.pool);
  find_cells<Dim>(b, b.position, e.now, *scene.pool, e.kind, e.cut);
  e.rows = e.now.rows;
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
  double square = 0; // of the fastest material's sound speed at the start
  for (const MaterialSlot& slot : scene.blocks[static_cast<std::size_t>(e.block)].materials) {
    square = slot.is_void ? square : std::max(square, sound_speed_squared(slot.material.eos, slot.reference.rho, slot.reference.e));
  }
  const double width = 0.5 * e.bin, natural = 0.05 * width / std::sqrt(square); // s
  e.squeeze = most_squeeze * std::min(1.0, dt / natural);
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
  template void find_least_thickness<D>(const Scene<D>&, Embedding<D>&); \
  template void find_bodies<D>(Scene<D>&, Embedding<D>&); \
  template void prepare_embedding<D>(Scene<D>&, Embedding<D>&); \
  template void set_squeeze<D>(const Scene<D>&, Embedding<D>&, double); \
  template void update_cells<D>(Scene<D>&, Embedding<D>&); \
  template void embedded_volumes<D>(Scene<D>&, Embedding<D>&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
