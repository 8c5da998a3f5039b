#include "problems/injury_measure.hpp"

#include "problems/place_in_cell.hpp"

#include <algorithm>
#include <numeric>

namespace ballast {
namespace {

constexpr double half_full = 0.5, all_but_gone = 0.01;

template <int Dim> double fraction_in(const Block<Dim>& b, const MaterialSlot& slot, const std::array<int, 3>& cell) {
  const int r = b.grid.cell_row(cell[1], cell[2]);
  return !slot.is_void && slot.store.has_row(r) ? slot.store.row(field::fraction, r)[cell[0]] : 0.0;
}

template <int Dim> std::array<double, 3> middle_of(const Block<Dim>& b, int i, int j, int k) {
  std::array<double, 3> x = {0, 0, 0};
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const int r = b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1));
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] += b.position[d].row(r)[i + (corner & 1)] / (1 << Dim);
    }
  }
  return x;
}

/// Row `n` of the block's cell rows, j fastest.
template <int Dim> std::array<int, 2> row_number(const Block<Dim>& b, int n) { return {n % b.grid.cells[1], n / b.grid.cells[1]}; }
template <int Dim> int row_count(const Block<Dim>& b) { return b.grid.cells[1] * b.grid.cells[2]; }

template <int Dim> PressurePeak highest_in_row(const Block<Dim>& b, const TileStore& store, bool all, int j, int k) {
  PressurePeak peak;
  const int r = b.grid.cell_row(j, k);
  if (!store.has_row(r)) {
    return peak;
  }
  const Span cells = all ? Span{0, b.grid.cells[0]} : b.awake.cells(r);
  const double *fraction = store.row(field::fraction, r), *pressure = b.pressure.row(r);
  int where = -1;
  for (int i = cells.begin; i < cells.end; ++i) {
    const double p = pressure[i] + b.reference_pressure;
    if (fraction[i] >= half_full && p > peak.pressure) {
      peak.pressure = p;
      where = i;
    }
  }
  if (where >= 0) {
    peak.at = middle_of(b, where, j, k);
  }
  return peak;
}

/// Velocity along an axis of what a slot holds, for the nodes of a row of nodes from `begin` to `end`.
template <int Dim> void node_velocities(const Block<Dim>& b, const MaterialSlot& slot, std::size_t axis, int row, Span nodes, double* out) {
  for (int i = nodes.begin; i < nodes.end; ++i) {
    out[i] = velocity_of(b, slot.slides, axis, row, i);
  }
}

template <int Dim> double momentum_in_row(const Block<Dim>& b, const MaterialSlot& slot, std::size_t axis, int j, int k) {
  const int r = b.grid.cell_row(j, k);
  const Span cells = slot.store.has_row(r) ? b.awake.cells(r) : Span{}; // the others rest
  if (cells.empty()) {
    return 0;
  }
  const double* mass = slot.store.row(field::mass, r);
  std::vector<double> u(static_cast<std::size_t>(b.grid.cells[0]) + 1);
  double sum = 0;
  for (int side = 0; side < (1 << (Dim - 1)); ++side) { // the rows of nodes around the row of cells
    node_velocities(b, slot, axis, b.grid.node_row(j + (side & 1), k + (side >> 1)), {cells.begin, cells.end + 1}, u.data());
    for (int i = cells.begin; i < cells.end; ++i) {
      const auto n = static_cast<std::size_t>(i);
      sum += mass[i] > 0 ? mass[i] * (corner_share(b, 2 * side, i, j, k) * u[n] + corner_share(b, 2 * side + 1, i, j, k) * u[n + 1]) : 0.0;
    }
  }
  return sum;
}

} // namespace

template <int Dim> PressurePeak highest_pressure(const Block<Dim>& b, int slot, bool all, ThreadPool& pool) {
  const TileStore& store = b.materials[static_cast<std::size_t>(slot)].store;
  std::vector<PressurePeak> parts(static_cast<std::size_t>(pool.size()));
  parallel_ranges(pool, row_count(b), [&](int begin, int end, int thread) {
    PressurePeak& part = parts[static_cast<std::size_t>(thread)];
    for (int n = begin; n < end; ++n) {
      const auto [j, k] = row_number(b, n);
      const PressurePeak row = highest_in_row(b, store, all, j, k);
      part = row.pressure > part.pressure ? row : part;
    }
  });
  PressurePeak peak;
  for (const PressurePeak& part : parts) { // in the order of the rows: of equal ones the first
    peak = part.pressure > peak.pressure ? part : peak;
  }
  return peak;
}

template <int Dim> double material_momentum(const Block<Dim>& b, const std::vector<int>& slots, int axis, ThreadPool& pool) {
  std::vector<double> rows(static_cast<std::size_t>(row_count(b)), 0.0);
  parallel_ranges(pool, row_count(b), [&](int begin, int end, int) {
    for (int n = begin; n < end; ++n) {
      const auto [j, k] = row_number(b, n);
      for (const int s : slots) {
        rows[static_cast<std::size_t>(n)] += momentum_in_row(b, b.materials[static_cast<std::size_t>(s)], static_cast<std::size_t>(axis), j, k);
      }
    }
  });
  return std::accumulate(rows.begin(), rows.end(), 0.0);
}

template <int Dim> int fullest_slot(const Block<Dim>& b, const std::array<int, 3>& cell) {
  int fullest = -1;
  double most = 0;
  for (std::size_t s = 0; s < b.materials.size(); ++s) {
    const double part = fraction_in(b, b.materials[s], cell);
    fullest = part > most ? static_cast<int>(s) : fullest;
    most = std::max(most, part);
  }
  return fullest;
}

template <int Dim> bool holds(const Block<Dim>& b, const std::array<int, 3>& cell, int slot) {
  return slot >= 0 && fraction_in(b, b.materials[static_cast<std::size_t>(slot)], cell) >= all_but_gone;
}

template <int Dim> bool beyond_mesh(const Block<Dim>& b, const std::array<int, 3>& cell, const std::array<double, 3>& at) {
  std::array<bool, Dim> first{}, last{};
  for (std::size_t d = 0; d < Dim; ++d) {
    first[d] = cell[d] == 0;
    last[d] = cell[d] == b.grid.cells[d] - 1;
  }
  if (b.map.curved()) { // its axes are not those of space: any side may face any way
    const auto any = [](const auto& of) { return std::find(of.begin(), of.end(), true) != of.end(); };
    const bool edge = any(first) || any(last);
    first.fill(edge);
    last.fill(edge);
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    const auto x = node_range(b, static_cast<int>(d), cell);
    const double margin = 0.5 * (x[1] - x[0]);
    if ((first[d] && at[d] < x[0] - margin) || (last[d] && at[d] > x[1] + margin)) {
      return true;
    }
  }
  return false;
}

template PressurePeak highest_pressure<2>(const Block<2>&, int, bool, ThreadPool&);
template PressurePeak highest_pressure<3>(const Block<3>&, int, bool, ThreadPool&);
template double material_momentum<2>(const Block<2>&, const std::vector<int>&, int, ThreadPool&);
template double material_momentum<3>(const Block<3>&, const std::vector<int>&, int, ThreadPool&);
template int fullest_slot<2>(const Block<2>&, const std::array<int, 3>&);
template int fullest_slot<3>(const Block<3>&, const std::array<int, 3>&);
template bool holds<2>(const Block<2>&, const std::array<int, 3>&, int);
template bool holds<3>(const Block<3>&, const std::array<int, 3>&, int);
template bool beyond_mesh<2>(const Block<2>&, const std::array<int, 3>&, const std::array<double, 3>&);
template bool beyond_mesh<3>(const Block<3>&, const std::array<int, 3>&, const std::array<double, 3>&);

} // namespace ballast
