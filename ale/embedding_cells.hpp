// Walking a mesh beside bodies, private to ale/.
#pragma once

#include "ale/embedding.hpp"
#include "ale/lagrange_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

inline constexpr double least_open = 1e-10; ///< of a cell: less is covered

/// Of the width of cells across it, what a body is thick at least: cells are stretched until the next remap, layers bend.
inline constexpr double spare_thickness = 1.4;

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

/// Along each coordinate: how far a node's neighbours are, one along every axis of the grid, m.
template <int Dim> std::array<double, Dim> extents_at(const Grid& g, const std::array<RowField, Dim>& x, int i, int j, int k) {
  std::array<double, Dim> out{};
  const int row = g.node_row(j, k);
  for (int a = 0; a < Dim; ++a) {
    std::array<double, Dim> most{};
    for (const int side : {-1, 1}) {
      int to[3] = {i, j, k};
      to[a] += side;
      if (to[a] < 0 || to[a] > g.cells[static_cast<std::size_t>(a)]) {
        continue;
      }
      const int r = g.node_row(to[1], to[2]);
      for (std::size_t d = 0; d < Dim; ++d) {
        most[d] = std::max(most[d], std::abs(x[d].row(r)[to[0]] - x[d].row(row)[i]));
      }
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      out[d] += most[d];
    }
  }
  return out;
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

/// Rows that hold all of both.
inline Span both_rows(const Span& a, const Span& b) {
  return a.empty() ? b : b.empty() ? a : Span{std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

/// Rows (j, k) of the cells beside some rows of nodes along the last axis.
struct RowsBeside {
  Span lines, planes;
  int count() const { return lines.count() * planes.count(); }
  std::array<int, 2> at(int n) const { return {lines.begin + n % lines.count(), planes.begin + n / lines.count()}; }
};
template <int Dim> RowsBeside rows_beside(const Grid& g, const Span& rows) {
  const Span beside = rows.empty() ? Span{0, 0} : Span{std::max(0, rows.begin - 1), std::min(g.cells[Dim - 1], rows.end)};
  return Dim == 3 ? RowsBeside{{0, g.cells[1]}, beside} : RowsBeside{beside, {0, 1}};
}

/// Calls body(n, j, k) for those rows on all threads, which take turns: n counts them. It may change its own row only.
template <class Visit> void parallel_rows(ThreadPool& pool, const RowsBeside& rows, Visit&& body) {
  parallel_turns(pool, rows.count(), [&](int n) {
    const auto [j, k] = rows.at(n);
    body(n, j, k);
  });
}

/// Cells beside these rows of nodes along the last axis.
template <int Dim, class Visit> void for_cells_beside(const Grid& g, const Span& rows, Visit&& body) {
  const RowsBeside beside = rows_beside<Dim>(g, rows);
  for (int n = 0; n < beside.count(); ++n) {
    const auto [j, k] = beside.at(n);
    for (int i = 0; i < g.cells[0]; ++i) {
      body(i, j, k);
    }
  }
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
  thread_local std::vector<double> v;
  v.resize(static_cast<std::size_t>(b.grid.cells[0]));
  cell_volumes(b, x, j, k, {i, i + 1}, v.data());
  return v[static_cast<std::size_t>(i)];
}

/// The velocity (m/s) at which a wall holds this component of a node's, or null.
template <int Dim> const double* held_along(const Block<Dim>& b, const std::array<int, 3>& node, std::size_t component) {
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const int at = side == 0 ? 0 : b.grid.cells[static_cast<std::size_t>(axis)];
      if (node[static_cast<std::size_t>(axis)] == at && b.boundary.fixes_normal_velocity(axis, side) && b.boundary.normal_of(axis, side) == static_cast<int>(component)) {
        return &b.boundary.at(axis, side).velocity;
      }
    }
  }
  return nullptr;
}

/// All that is at a node moves faster by `change` (m/s) in one component; J of kinetic energy that it gains.
template <int Dim> double shift_velocity(Block<Dim>& b, std::size_t d, int r, int i, double change) {
  const double mean = mean_velocity<Dim>(b, b.velocity, b.sliding.jump, d, r, i);
  b.velocity[d].row(r)[i] += change;
  return b.node_mass.row(r)[i] * change * (mean + 0.5 * change);
}

} // namespace ballast
