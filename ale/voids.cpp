// Voids: opened by tension (spall), closed where a remap left one that has no right to be.
#include "ale/phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballast {

namespace {

/// Absolute pressure below which a material tears: its spall pressure; what is damaged through pulls no more than a
/// strain of 1e-6 does (zero itself would make voids of round-off).
template <int Dim> double tears_below(const MaterialSlot& slot, int r, int i) {
  const bool broken = slot.damages && has_failed(slot.store.row(field::damage<Dim>, r)[i]);
  return broken ? -1e-6 * slot.store.row(slot.modulus_field(), r)[i] : slot.material.spall_pressure;
}

/// Material of the cell that has failed in tension, or -1. Cells with void are not in tension.
template <int Dim> int failed_material(const Block<Dim>& b, int r, int i) {
  const int owner = b.owner_row(r)[i], hole = b.void_index();
  if (owner == hole) {
    return -1;
  }
  const auto fails = [&](std::size_t m) {
    const MaterialSlot& slot = b.materials[m];
    return slot.store.row(field::fraction, r)[i] > 0 &&
           slot.store.row(slot.pressure_field(), r)[i] + b.reference_pressure < tears_below<Dim>(slot, r, i);
  };
  if (owner >= 0) {
    return fails(static_cast<std::size_t>(owner)) ? owner : -1;
  }
  if (b.materials[static_cast<std::size_t>(hole)].store.row(field::fraction, r)[i] > 0) {
    return -1;
  }
  for (std::size_t m = 0; m + 1 < b.materials.size(); ++m) {
    if (fails(m)) {
      return static_cast<int>(m);
    }
  }
  return -1;
}

/// Every material in tension in the cell goes back to zero pressure; void takes the room it leaves.
template <int Dim> void open_void(Block<Dim>& b, int r, int i) {
  double left = 1;
  for (std::size_t m = 0; m + 1 < b.materials.size(); ++m) {
    MaterialSlot& slot = b.materials[m];
    const double f = std::as_const(slot.store).row(field::fraction, r)[i];
    if (f <= 0) {
      continue;
    }
    const double p = std::as_const(slot.store).row(slot.pressure_field(), r)[i] + b.reference_pressure;
    const double k = std::as_const(slot.store).row(slot.modulus_field(), r)[i];
    const double next = p < 0 ? f * (1 - std::min(0.5, -p / k)) : f;
    slot.store.row(field::fraction, r)[i] = next;
    left -= next;
  }
  b.materials.back().store.row(field::fraction, r)[i] = left;
}

/// Whether one of the cell's nearest `reach` cells along an axis is all void: the cell is at a surface.
template <int Dim> bool near_pure_void(const Block<Dim>& b, const std::array<int, 3>& cell, int reach) {
  const Grid& g = b.grid;
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    for (int step = -reach; step <= reach; ++step) {
      std::array<int, 3> at = cell;
      at[axis] += step;
      if (at[axis] < 0 || at[axis] >= g.cells[axis]) {
        if (b.boundary.at(static_cast<int>(axis), at[axis] < 0 ? 0 : 1).kind == BoundaryKind::free) {
          return true; // a free side is a surface
        }
      } else if (b.owner_row(g.cell_row(at[1], at[2]))[at[0]] == b.void_index()) {
        return true;
      }
    }
  }
  return false;
}

/// Void of the cell and of those face neighbours that are not at a surface, over which a remap spreads a void.
template <int Dim> double spread_void(const Block<Dim>& b, const std::array<int, 3>& cell) {
  const Grid& g = b.grid;
  const TileStore& store = b.materials.back().store;
  double sum = store.row(field::fraction, g.cell_row(cell[1], cell[2]))[cell[0]];
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    for (const int side : {-1, 1}) {
      std::array<int, 3> at = cell;
      at[axis] += side;
      if (at[axis] >= 0 && at[axis] < g.cells[axis]) {
        const double gap = store.row(field::fraction, g.cell_row(at[1], at[2]))[at[0]];
        sum += gap > 0 && !near_pure_void(b, at, 2) ? gap : 0;
      }
    }
  }
  return sum;
}

} // namespace

/// A void that has no right to be: the cell's materials are compressed enough to fill it (a remap brings a
/// void in beside them each step; kept, the cell would push back with the void's pressure however far it is
/// squeezed), or it is a residue that reconstruction left inside a body, which would cut the body's tension for
/// good: small, no pure void beside the cell, and closing it does not bring any material to its spall pressure.
/// A void inside a body counts whole, with what a remap has spread of it: else a spall would heal piece by piece.
template <int Dim> bool to_be_closed(const Block<Dim>& b, int i, int j, int k, bool spall) {
  constexpr double trace = 1e-3;           // what holds less of a cell does not decide whether it tears
  constexpr double largest_residue = 1e-2; // about the spall strain of metals, p_spall / K; the law is below
  const Grid& g = b.grid;
  const int r = g.cell_row(j, k), hole = b.void_index();
  const double gap = b.materials[static_cast<std::size_t>(hole)].store.row(field::fraction, r)[i];
  if (gap <= 0) {
    return false;
  }
  double compliance = 0, expansion = 0, weakest = -std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m + 1 < b.materials.size(); ++m) {
    const MaterialSlot& slot = b.materials[m];
    const double f = slot.store.row(field::fraction, r)[i];
    if (f > 0) {
      const double modulus = slot.store.row(slot.modulus_field(), r)[i];
      if (!(modulus > 0)) {
        return false; // at the end of its EOS: it cannot share in anything
      }
      compliance += f / modulus;
      expansion += f / modulus * (slot.store.row(slot.pressure_field(), r)[i] + b.reference_pressure);
      weakest = f > trace && spall ? std::max(weakest, tears_below<Dim>(slot, r, i)) : weakest;
    }
  }
  if (expansion >= gap) {
    return true;
  }
  if (gap > largest_residue || compliance == 0 || near_pure_void(b, {i, j, k}, 1)) {
    return false;
  }
  const double whole = std::isfinite(weakest) ? spread_void(b, {i, j, k}) : gap; // what cannot spall has nothing to keep open
  return whole <= largest_residue && (expansion - whole) / compliance > weakest;
}

namespace {

/// The materials take the void's room, the soft ones most of it (as the closure shares a volume change).
template <int Dim> void close_void(Block<Dim>& b, int r, int i) {
  double compliance = 0;
  std::vector<double> room(b.materials.size(), 0.0);
  for (std::size_t m = 0; m + 1 < b.materials.size(); ++m) {
    const MaterialSlot& slot = b.materials[m];
    const double f = slot.store.row(field::fraction, r)[i];
    room[m] = f > 0 ? f / slot.store.row(slot.modulus_field(), r)[i] : 0.0;
    compliance += room[m];
  }
  double& gap = b.materials.back().store.row(field::fraction, r)[i];
  for (std::size_t m = 0; m + 1 < b.materials.size(); ++m) {
    if (room[m] > 0) {
      b.materials[m].store.row(field::fraction, r)[i] += gap * room[m] / compliance;
    }
  }
  gap = 0;
}

/// Finds cells in parallel by `wanted(i, j, k)`, then changes them one by one by `change(r, i)`, in order, and
/// evaluates their rows anew. Returns how many.
template <int Dim, class Wanted, class Change>
long change_cells(Block<Dim>& b, ThreadPool& pool, Wanted&& wanted, Change&& change) {
  const Grid& g = b.grid;
  std::vector<std::vector<int>> found(static_cast<std::size_t>(g.slabs() * g.rows_per_slab()));
  parallel_awake(pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const Span cells = b.awake.cells(g.cell_row(j, k));
        for (int i = cells.begin; i < cells.end; ++i) {
          if (wanted(i, j, k)) {
            found[static_cast<std::size_t>(s * g.rows_per_slab() + q)].push_back(i);
          }
        }
      }
    }
  });
  long count = 0;
  std::vector<double> rho(static_cast<std::size_t>(g.cells[0]));
  RowRuns runs;
  for (int s = 0; s < g.slabs(); ++s) {
    for (int q = 0; q < g.rows_per_slab(); ++q) {
      const auto& cells = found[static_cast<std::size_t>(s * g.rows_per_slab() + q)];
      if (cells.empty()) {
        continue;
      }
      const auto [j, k] = g.in_slab(s, q);
      const int r = g.cell_row(j, k);
      for (const int i : cells) {
        change(r, i);
      }
      row_state(b, r, runs, rho);
      throw_if_bad(b, j, k);
      count += static_cast<long>(cells.size());
    }
  }
  return count;
}

} // namespace

template <int Dim> long close_voids(Block<Dim>& b, ThreadPool& pool, bool spall) {
  if (b.void_index() < 0) {
    return 0;
  }
  return change_cells(
      b,
      pool,
      [&](int i, int j, int k) {
        return b.owner_row(b.grid.cell_row(j, k))[i] == mixed_cell && to_be_closed(b, i, j, k, spall);
      },
      [&](int r, int i) { close_void(b, r, i); });
}

template <int Dim> long open_voids(Block<Dim>& b, ThreadPool& pool) {
  const bool any = std::any_of(b.materials.begin(), b.materials.end(),
                               [](const MaterialSlot& s) { return std::isfinite(s.material.spall_pressure) || s.damages; });
  if (!any || b.void_index() < 0) {
    return 0;
  }
  return change_cells(
      b,
      pool,
      [&](int i, int j, int k) {
        const int r = b.grid.cell_row(j, k);
        return b.pressure.row(r)[i] + b.reference_pressure < 0 && failed_material(b, r, i) >= 0;
      },
      [&](int r, int i) {
        TileStore& gap = b.materials.back().store;
        gap.allocate(gap.tile_of(r));
        open_void(b, r, i);
      });
}

template bool to_be_closed<2>(const Block<2>&, int, int, int, bool);
template bool to_be_closed<3>(const Block<3>&, int, int, int, bool);
template long close_voids<2>(Block<2>&, ThreadPool&, bool);
template long close_voids<3>(Block<3>&, ThreadPool&, bool);
template long open_voids<2>(Block<2>&, ThreadPool&);
template long open_voids<3>(Block<3>&, ThreadPool&);

} // namespace ballast
