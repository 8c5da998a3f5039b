// Boundaries of a block, one kind an axis and side, and the exchange that fills ghosts.
#pragma once

#include "core/awake.hpp"
#include "core/grid.hpp"

#include <array>
#include <span>

namespace ballast {

/// symmetry: no normal velocity, mirrored ghosts (also the axis r = 0). wall: rigid, frictionless, may
/// move along its normal. free: no traction beyond the reference pressure. outflow: as if the block went
/// on unchanged. inflow: the ghosts hold a prescribed state, which remaps sweep in. absorbing: more of the same beyond, at rest
/// and at the reference pressure (ale/absorbing).
enum class BoundaryKind { symmetry, free, wall, inflow, outflow, absorbing };

/// What stands beyond an inflow side: one material, free of deviator and history.
struct InflowState {
  int material = -1;                ///< of the block
  double density = 0;               ///< kg/m3
  double specific_energy = 0;       ///< J/kg
  std::array<double, 3> velocity{}; ///< m/s
};

struct BoundarySide {
  BoundaryKind kind = BoundaryKind::symmetry;
  double velocity = 0; ///< along its normal (BoundarySet::normal): of a moving wall or an inflow, m/s
  InflowState inflow{};
};

inline BoundarySide inflow_side(int axis, const InflowState& state) {
  return {BoundaryKind::inflow, state.velocity[static_cast<std::size_t>(axis)], state};
}

struct BoundarySet {
  std::array<std::array<BoundarySide, 2>, 3> side; ///< [axis][low, high]
  /// The velocity component each side's normal points along; -1: none, it is curved. On a rectilinear mesh that of its axis.
  std::array<std::array<int, 2>, 3> normal = {{{0, 0}, {1, 1}, {2, 2}}};

  bool fixes_normal_velocity(int axis, int s) const {
    const BoundaryKind k = at(axis, s).kind;
    return k == BoundaryKind::symmetry || k == BoundaryKind::wall || k == BoundaryKind::inflow;
  }
  const BoundarySide& at(int axis, int s) const {
    return side[static_cast<std::size_t>(axis)][static_cast<std::size_t>(s)];
  }
  int normal_of(int axis, int s) const { return normal[static_cast<std::size_t>(axis)][static_cast<std::size_t>(s)]; }
  /// Material may cross (an eulerian block's face there is swept or fed).
  bool open(int axis, int s) const {
    const BoundaryKind k = at(axis, s).kind;
    return k == BoundaryKind::free || k == BoundaryKind::outflow || k == BoundaryKind::inflow || k == BoundaryKind::absorbing;
  }
  bool any(BoundaryKind kind) const {
    bool found = false;
    for (const auto& axis : side) {
      found = found || axis[0].kind == kind || axis[1].kind == kind;
    }
    return found;
  }
};

/// Cell index that ghost cell `i` (outside [0, n)) mirrors; clamped for blocks thinner than the ghosts.
constexpr int mirrored_cell(int i, int n) {
  const int m = i < 0 ? -1 - i : 2 * n - 1 - i;
  return m < 0 ? 0 : m >= n ? n - 1 : m;
}
/// Node index (0..n) that ghost node `i` mirrors.
constexpr int mirrored_node(int i, int n) {
  const int m = i < 0 ? -i : 2 * n - i;
  return m < 0 ? 0 : m > n ? n : m;
}

/// Fills the ghosts of one cell row at both its ends; `a` points to i = 0, or is null.
inline void mirror_row(const Grid& g, double* a, double sign) {
  const int n = g.cells[0];
  for (int q = 1; a != nullptr && q <= g.ghost[0]; ++q) {
    a[-q] = sign * a[mirrored_cell(-q, n)];
    a[n - 1 + q] = sign * a[mirrored_cell(n - 1 + q, n)];
  }
}

/// Fills the ghosts of cell rows beyond both sides of one axis: `row(j, k)` must return the pointer to i = 0, or
/// null to skip. sign is -1 for a component that a mirror at that axis turns round.
template <class Row> void mirror_cells_along(const Grid& g, int axis, double sign, Row&& row) {
  const int n0 = g.cells[0], g0 = g.ghost[0];
  if (axis == 0) {
    for (int k = 0; k < g.cells[2]; ++k) {
      for (int j = 0; j < g.cells[1]; ++j) {
        mirror_row(g, row(j, k), sign);
      }
    }
    return;
  }
  const auto copy = [&](int j, int k, int js, int ks) {
    double* to = row(j, k);
    const double* from = row(js, ks);
    for (int i = -g0; to && i < n0 + g0; ++i) {
      to[i] = from ? sign * from[i] : 0.0;
    }
  };
  const int n = g.cells[static_cast<std::size_t>(axis)];
  for (int q = 1; q <= g.ghost[static_cast<std::size_t>(axis)]; ++q) {
    for (const int to : {-q, n - 1 + q}) {
      const int from = mirrored_cell(to, n);
      if (axis == 1) {
        for (int k = 0; k < g.cells[2]; ++k) {
          copy(to, k, from, k);
        }
      } else {
        for (int j = -g.ghost[1]; j < g.cells[1] + g.ghost[1]; ++j) {
          copy(j, to, j, from);
        }
      }
    }
  }
}

/// The same beyond every side, edges and corners included; sign by axis.
template <class Row> void mirror_cells(const Grid& g, const std::array<double, 3>& sign, Row&& row) {
  for (int axis = 0; axis < g.dim; ++axis) {
    mirror_cells_along(g, axis, sign[static_cast<std::size_t>(axis)], row);
  }
}

/// Fills the ghosts of a node field; sign as in mirror_cells for sides that fix the normal velocity,
/// the prescribed velocity beyond an inflow, zero gradient on the others. `awake`: only of rows awake.
void exchange_nodes(const Grid& g, const BoundarySet& boundary, int component, RowField& f, const Awake* awake = nullptr);

/// Fills the ghosts of a cell field that a mirror leaves unchanged. `awake`: only of rows awake.
void exchange_cells(const Grid& g, RowField& f, const Awake* awake = nullptr);

} // namespace ballast
