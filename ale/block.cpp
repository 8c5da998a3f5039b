#include "ale/block.hpp"

#include "ale/subzonal_pressure.hpp"
#include "core/rows.hpp"
#include "core/hex_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace ballast {

namespace {

constexpr int cells_per_tile = 4096;

/// Calls visit(row, i, {i, j, k}) for every node, ghosts included.
template <class Visit> void for_nodes_and_ghosts(const Grid& g, Visit&& visit) {
  for (int k = -g.ghost[2]; k < g.node_planes() - g.ghost[2]; ++k) {
    for (int j = -g.ghost[1]; j <= g.cells[1] + g.ghost[1]; ++j) {
      const int r = g.node_row(j, k);
      for (int i = -g.ghost[0]; i <= g.cells[0] + g.ghost[0]; ++i) {
        visit(r, i, std::array<int, 3>{i, j, k});
      }
    }
  }
}

/// Nodes of a mapped mesh. Ghosts lie as far beyond the boundary node as their mirror images before it.
template <int Dim> void place_mapped_nodes(Block<Dim>& b, const std::array<std::vector<double>, 3>& lines) {
  const Grid& g = b.grid;
  const auto at = [&](const std::array<int, 3>& index) {
    std::array<double, 3> q = {0, 0, 0};
    for (std::size_t d = 0; d < Dim; ++d) {
      q[d] = lines[d][static_cast<std::size_t>(index[d])];
    }
    return place(b.map, q);
  };
  for_nodes_and_ghosts(g, [&](int r, int i, const std::array<int, 3>& index) {
    std::array<int, 3> edge = {0, 0, 0}, image = {0, 0, 0};
    for (std::size_t d = 0; d < Dim; ++d) {
      edge[d] = std::clamp(index[d], 0, g.cells[d]);
      image[d] = std::clamp(2 * edge[d] - index[d], 0, g.cells[d]);
    }
    const auto e = at(edge), m = edge == index ? e : at(image);
    for (std::size_t d = 0; d < Dim; ++d) {
      b.target[d].row(r)[i] = edge == index ? e[d] : 2 * e[d] - m[d];
    }
  });
}

template <int Dim> void set_shares_and_normals(Block<Dim>& b, const std::array<std::vector<double>, 3>& lines) {
  const Grid& g = b.grid;
  for (int d = 0; d < Dim; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const std::vector<double>& line = lines[axis];
    b.low_share[axis].assign(static_cast<std::size_t>(g.cells[axis] + 2 * g.ghost[axis]), 0.5);
    for (int i = 0; i < g.cells[axis]; ++i) {
      const auto q = static_cast<std::size_t>(i);
      b.low_share[axis][static_cast<std::size_t>(i + g.ghost[axis])] = low_share(b.map, b.axisymmetric, d, line[q], line[q + 1]);
    }
    b.boundary.normal[axis] = {normal_component(b.map, d, line.front()), normal_component(b.map, d, line.back())};
  }
}

template <int Dim>
void place_nodes(Block<Dim>& b, const std::array<std::vector<double>, 3>& lines) {
  const Grid& g = b.grid;
  const auto line = [&](int axis, int i) {
    const auto& l = lines[static_cast<std::size_t>(axis)];
    const int n = static_cast<int>(l.size()) - 1;
    const auto at = [&](int q) { return l[static_cast<std::size_t>(q)]; };
    // Ghost nodes mirror about the boundary node.
    return i < 0 ? 2 * at(0) - at(std::min(-i, n)) : i > n ? 2 * at(n) - at(std::max(2 * n - i, 0)) : at(i);
  };
  for_nodes_and_ghosts(g, [&](int r, int i, const std::array<int, 3>& index) {
    for (std::size_t d = 0; d < Dim; ++d) {
      b.target[d].row(r)[i] = line(static_cast<int>(d), index[d]);
    }
  });
}

/// Mass of the nodes of row (j, k), all or that of what slides, from the rows of cells around it.
template <int Dim> void gather_node_mass(Block<Dim>& b, int j, int k, bool sliding) {
  const Grid& g = b.grid;
  double* m = (sliding ? b.sliding.node_mass : b.node_mass).row(g.node_row(j, k));
  const Span nodes = b.awake.nodes(g.node_row(j, k));
  if (nodes.empty()) {
    return;
  }
  std::fill(m + nodes.begin, m + nodes.end, 0.0);
  const Span as_low = {nodes.begin, std::min(nodes.end, g.cells[0])}, as_high = {std::max(nodes.begin - 1, 0), nodes.end - 1};
  const double* low0 = b.low_share[0].data() + g.ghost[0];
  for (int side = 0; side < (1 << (Dim - 1)); ++side) {
    const int dj = side & 1, dk = side >> 1; // 1: the cells below the node
    const int cj = j - dj, ck = k - dk;
    if (cj < 0 || cj >= g.cells[1] || ck < 0 || ck >= g.cells[2]) {
      continue;
    }
    const auto share = [&](std::size_t axis, int cell, int high) {
      const double low = b.low_share[axis][static_cast<std::size_t>(cell + g.ghost[axis])];
      return high ? 1 - low : low;
    };
    double row_share = share(1, cj, dj);
    if constexpr (Dim == 3) {
      row_share *= share(2, ck, dk);
    }
    const int r = g.cell_row(cj, ck);
    for (const MaterialSlot& slot : b.materials) {
      if (slot.is_void || (sliding && !slot.slides) || !slot.store.has_row(r)) {
        continue;
      }
      const double* mass = slot.store.row(field::mass, r);
      for (int i = as_low.begin; i < as_low.end; ++i) {
        m[i] += row_share * (low0[i] * mass[i]);
      }
      for (int i = as_high.begin; i < as_high.end; ++i) {
        m[i + 1] += row_share * ((1 - low0[i]) * mass[i]);
      }
    }
  }
}

template <int Dim> void allocate_sliding(Block<Dim>& b) {
  const auto slides = [](const MaterialSlot& slot) { return slot.slides; };
  if (std::none_of(b.materials.begin(), b.materials.end(), slides)) {
    return;
  }
  remap::Sliding<Dim>& s = b.sliding;
  std::transform(b.materials.begin(), b.materials.end(), std::back_inserter(s.material), slides);
  s.node_mass = s.loss = RowField::of_nodes(b.grid);
  for (auto* nodes : {&s.jump, &s.next_jump, &s.velocity, &s.next_velocity}) {
    nodes->fill(RowField::of_nodes(b.grid));
  }
  s.mass_flux.fill(RowField::of_cells(b.grid));
  s.cell_mass = b.damped_density = RowField::of_cells(b.grid);
}

} // namespace

template <int Dim>
void allocate_block(Block<Dim>& b, const std::array<std::vector<double>, 3>& lines) {
  std::array<int, 3> n = {1, 1, 1};
  for (std::size_t d = 0; d < Dim; ++d) {
    n[d] = static_cast<int>(lines[d].size()) - 1;
  }
  b.grid = Grid(Dim, n);
  const Grid& g = b.grid;
  b.awake = Awake(g);
  for (auto* nodes : {&b.position, &b.velocity, &b.next_position, &b.next_velocity, &b.target}) {
    nodes->fill(RowField::of_nodes(g));
  }
  b.node_mass = RowField::of_nodes(g);
  b.map.curved() ? place_mapped_nodes(b, lines) : place_nodes(b, lines);
  set_shares_and_normals(b, lines);
  b.position = b.target;
  b.row_least.assign(static_cast<std::size_t>(g.cell_rows()), 0);
  for (auto* f : {&b.stable_step, &b.volume, &b.next_volume, &b.density, &b.pressure, &b.modulus, &b.wave_speed}) {
    *f = RowField::of_cells(g);
  }
  for (auto* fs : {&b.strain_rate, &b.length, &b.viscosity}) {
    fs->fill(RowField::of_cells(g));
  }
  for (auto* fs : {&b.swept, &b.mass_flux}) {
    fs->fill(RowField::of_cells(g));
  }
  b.owner.assign(static_cast<std::size_t>(g.cell_pitch()) * static_cast<std::size_t>(g.cell_rows()), 0);
  const int rows_per_tile = std::max(1, cells_per_tile / g.cell_pitch());
  bool strength = false;
  for (MaterialSlot& slot : b.materials) {
    slot.strength = !slot.is_void && has_strength(slot.material.strength);
    strength = strength || slot.strength;
    slot.damages = slot.strength && slot.material.failure.has_value() && tissue_law(slot.material.strength) == nullptr;
    slot.compacts = !slot.is_void && std::holds_alternative<PAlpha>(slot.material.eos);
    slot.variable_shear = slot.strength && has_variable_shear(slot.material.strength);
    slot.shear = slot.strength ? shear_modulus(slot.material.strength) : 0;
    const TissueLaw* tissue = slot.strength ? tissue_law(slot.material.strength) : nullptr;
    slot.memories = tissue != nullptr ? static_cast<int>(state_count(*tissue)) / 6 : 0;
    const int memory = tissue != nullptr ? 1 + slot.memories * memory_components<Dim> : 0;
    const int history = slot.strength ? stress_components<Dim> + 1 + (slot.damages ? 1 : 0) + memory : 0;
    const int compaction = slot.compacts ? 1 : 0;
    const int derived = slot.is_void ? 0 : slot.strength ? 3 + (slot.variable_shear ? 1 : 0) : 2;
    slot.store = TileStore(g, rows_per_tile, slot.is_void ? 1 : 3 + history + compaction, derived);
  }
  allocate_sliding(b);
  if (strength) {
    b.stress.fill(RowField::of_cells(g));
    b.shear = b.flow_stress = RowField::of_cells(g);
  }
  for (int k = 0; k < g.cells[2]; ++k) {
    for (int j = 0; j < g.cells[1]; ++j) {
      cell_volumes(b, b.position, j, k, {0, g.cells[0]}, b.volume.row(g.cell_row(j, k)));
    }
  }
  exchange_cells(g, b.volume);
  b.target_volume = b.volume;
}

template <int Dim> void mark_subzones(Block<Dim>& b) {
  if constexpr (Dim == 2) {
    if (b.motion.remaps()) {
      return;
    }
    b.skew.fill(RowField::of_cells(b.grid));
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      const int low = b.grid.node_row(j, 0), high = b.grid.node_row(j + 1, 0), r = b.grid.cell_row(j, 0);
      for (int i = 0; i < b.grid.cells[0]; ++i) {
        double x[2][4];
        for (std::size_t d = 0; d < 2; ++d) {
          const double *x0 = b.target[d].row(low), *x1 = b.target[d].row(high);
          x[d][0] = x0[i], x[d][1] = x0[i + 1], x[d][2] = x1[i + 1], x[d][3] = x1[i];
        }
        const QuadModes m = quad_modes(x[0], x[1]);
        b.skew[0].row(r)[i] = m.along_i();
        b.skew[1].row(r)[i] = m.along_j();
      }
    }
  }
}

template <int Dim> void target_volumes(Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  parallel_ranges(pool, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        cell_volumes(b, b.target, j, k, {0, g.cells[0]}, b.target_volume.row(g.cell_row(j, k)));
      }
    }
  });
  exchange_cells(g, b.target_volume);
}

template <int Dim> void compute_node_mass(Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  const int planes = g.slabs() + 1, rows = Dim == 3 ? g.cells[1] + 1 : 1;
  parallel_awake(pool, &b.awake, planes, [&](int begin, int end, int) {
    for (int plane = begin; plane < end; ++plane) {
      for (int q = 0; q < rows; ++q) {
        const int j = Dim == 3 ? q : plane, k = Dim == 3 ? plane : 0;
        gather_node_mass(b, j, k, false);
        if (b.any_sliding()) {
          gather_node_mass(b, j, k, true);
        }
      }
    }
  });
}

template <int Dim> void compute_owner(Block<Dim>& b, int row, Span cells) {
  std::int8_t* owner = b.owner_row(row);
  std::fill(owner + cells.begin, owner + cells.end, mixed_cell);
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    if (!b.materials[m].store.has_row(row)) {
      continue;
    }
    mark_owner(std::as_const(b.materials[m].store).row(field::fraction, row), static_cast<int>(m), cells.begin, cells.end, owner);
  }
}

void RowRuns::scan(const std::int8_t* owner, Span cells) {
  pure.clear();
  mixed.clear();
  if (cells.empty()) {
    return;
  }
  if (const int sole = sole_owner(owner + cells.begin, cells.count()); sole >= 0) {
    pure.push_back({sole, cells.begin, cells.end});
    return;
  }
  for (int i = cells.begin; i < cells.end;) {
    if (owner[i] == mixed_cell) {
      mixed.push_back(i++);
      continue;
    }
    int end = i + 1;
    while (end < cells.end && owner[end] == owner[i]) {
      ++end;
    }
    pure.push_back({owner[i], i, end});
    i = end;
  }
}

void cell_volumes(const Block<2>& b, const std::array<RowField, 2>& x, int j, int, Span cells, double* volume) {
  const Grid& g = b.grid;
  const double *x0 = x[0].row(g.node_row(j, 0)), *x1 = x[0].row(g.node_row(j + 1, 0));
  const double *y0 = x[1].row(g.node_row(j, 0)), *y1 = x[1].row(g.node_row(j + 1, 0));
  const auto loop = [&](auto axisymmetric) {
#pragma omp simd
    for (int i = cells.begin; i < cells.end; ++i) {
      const QuadGeometry<decltype(axisymmetric)::value> q{{x0[i], x0[i + 1], x1[i + 1], x1[i]},
                                                          {y0[i], y0[i + 1], y1[i + 1], y1[i]}};
      volume[i] = q.volume();
    }
  };
  b.axisymmetric ? loop(std::true_type{}) : loop(std::false_type{});
}

namespace {
/// A function of its own keeps the row loop vectorising (docs/performance.md).
[[gnu::always_inline]] inline double hexahedron_volume(const double* const (&p)[3][4], int i) {
  static constexpr int row_of[8] = {0, 0, 1, 1, 2, 2, 3, 3}, step[8] = {0, 1, 1, 0, 0, 1, 1, 0};
  HexGeometry h;
#pragma GCC unroll 8
  for (int c = 0; c < 8; ++c) {
    h.x[c] = p[0][row_of[c]][i + step[c]];
    h.y[c] = p[1][row_of[c]][i + step[c]];
    h.z[c] = p[2][row_of[c]][i + step[c]];
  }
  return h.volume();
}
} // namespace

void cell_volumes(const Block<3>& b, const std::array<RowField, 3>& x, int j, int k, Span cells, double* volume) {
  const Grid& g = b.grid;
  const int rows[4] = {g.node_row(j, k), g.node_row(j + 1, k), g.node_row(j, k + 1), g.node_row(j + 1, k + 1)};
  const double* p[3][4];
  for (std::size_t d = 0; d < 3; ++d) {
    for (int c = 0; c < 4; ++c) {
      p[d][c] = x[d].row(rows[c]);
    }
  }
#pragma omp simd
  for (int i = cells.begin; i < cells.end; ++i) {
    volume[i] = hexahedron_volume(p, i);
  }
}

template void allocate_block<2>(Block<2>&, const std::array<std::vector<double>, 3>&);
template void allocate_block<3>(Block<3>&, const std::array<std::vector<double>, 3>&);
template void mark_subzones<2>(Block<2>&);
template void mark_subzones<3>(Block<3>&);
template void target_volumes<2>(Block<2>&, ThreadPool&);
template void target_volumes<3>(Block<3>&, ThreadPool&);
template void compute_node_mass<2>(Block<2>&, ThreadPool&);
template void compute_node_mass<3>(Block<3>&, ThreadPool&);
template void compute_owner<2>(Block<2>&, int, Span);
template void compute_owner<3>(Block<3>&, int, Span);

} // namespace ballast
