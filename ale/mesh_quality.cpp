#include "ale/mesh_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ballast {

namespace {

using Nodes2 = const double* const (&)[2][2]; // [component][row of the cell]

/// Edges from corner (ci, cj) of cell i along both axes, lower end first: [axis][component].
struct Edges2 {
  double e[2][2];
};
[[gnu::always_inline]] inline Edges2 edges(Nodes2 x, int i, int ci, int cj) {
  return {{{x[0][cj][i + 1] - x[0][cj][i], x[1][cj][i + 1] - x[1][cj][i]},
           {x[0][1][i + ci] - x[0][0][i + ci], x[1][1][i + ci] - x[1][0][i + ci]}}};
}

/// 2 det A det R / (g22 a11 - 2 g12 a12 + g11 a22), a and g the edges' scalar products.
[[gnu::always_inline]] inline double corner_quality(const Edges2& a, const Edges2& r) {
  const auto dot = [](const double (&p)[2], const double (&q)[2]) { return p[0] * q[0] + p[1] * q[1]; };
  const double det_a = a.e[0][0] * a.e[1][1] - a.e[0][1] * a.e[1][0], det_r = r.e[0][0] * r.e[1][1] - r.e[0][1] * r.e[1][0];
  const double norm = dot(r.e[1], r.e[1]) * dot(a.e[0], a.e[0]) - 2 * dot(r.e[0], r.e[1]) * dot(a.e[0], a.e[1]) + dot(r.e[0], r.e[0]) * dot(a.e[1], a.e[1]);
  return 2 * det_a * det_r / norm;
}

} // namespace

void row_quality(const Grid& g, const std::array<RowField, 2>& mesh, const std::array<RowField, 2>& reference, int j, int, double* quality) {
  const double *x[2][2], *y[2][2];
  for (std::size_t d = 0; d < 2; ++d) {
    for (int q = 0; q < 2; ++q) {
      x[d][q] = mesh[d].row(g.node_row(j + q, 0));
      y[d][q] = reference[d].row(g.node_row(j + q, 0));
    }
  }
#pragma omp simd
  for (int i = 0; i < g.cells[0]; ++i) {
    double least = 1;
#pragma GCC unroll 4
    for (int c = 0; c < 4; ++c) {
      const double q = corner_quality(edges(x, i, c & 1, c >> 1), edges(y, i, c & 1, c >> 1));
      least = q < least ? q : least;
    }
    quality[i] = least;
  }
}

namespace {

struct Edges3 {
  double e[3][3]; ///< [axis][component]
};
using Rows3 = std::array<std::array<const double*, 4>, 3>; // [component][row, dj + 2 dk]

Edges3 edges(const Rows3& x, int i, int c) {
  const int ci = c & 1, rest = c >> 1;
  Edges3 out{};
  for (std::size_t d = 0; d < 3; ++d) {
    const auto at = [&](int di, int row) { return x[d][static_cast<std::size_t>(row)][i + di]; };
    out.e[0][d] = at(1, rest) - at(0, rest);
    out.e[1][d] = at(ci, rest | 1) - at(ci, rest & 2);
    out.e[2][d] = at(ci, rest | 2) - at(ci, rest & 1);
  }
  return out;
}

void cross(const double (&a)[3], const double (&b)[3], double (&out)[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}
double dot(const double (&a)[3], const double (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// R^-1 has the rows cross(r1, r2) / det R ...: |T|^2 = sum over components of the squares of A R^-1.
double corner_quality(const Edges3& a, const Edges3& r) {
  double dual[3][3], normal[3];
  cross(r.e[1], r.e[2], dual[0]);
  cross(r.e[2], r.e[0], dual[1]);
  cross(r.e[0], r.e[1], dual[2]);
  cross(a.e[1], a.e[2], normal);
  const double det_r = dot(r.e[0], dual[0]), det = dot(a.e[0], normal) / det_r;
  double norm = 0;
  for (int p = 0; p < 3; ++p) {
    for (int q = 0; q < 3; ++q) {
      const double t = (a.e[0][p] * dual[0][q] + a.e[1][p] * dual[1][q] + a.e[2][p] * dual[2][q]) / det_r;
      norm += t * t;
    }
  }
  return det > 0 ? 3 * std::cbrt(det * det) / norm : det;
}

} // namespace

void row_quality(const Grid& g, const std::array<RowField, 3>& mesh, const std::array<RowField, 3>& reference, int j, int k, double* quality) {
  Rows3 x{}, y{};
  for (std::size_t d = 0; d < 3; ++d) {
    for (int q = 0; q < 4; ++q) {
      x[d][static_cast<std::size_t>(q)] = mesh[d].row(g.node_row(j + (q & 1), k + (q >> 1)));
      y[d][static_cast<std::size_t>(q)] = reference[d].row(g.node_row(j + (q & 1), k + (q >> 1)));
    }
  }
  for (int i = 0; i < g.cells[0]; ++i) {
    quality[i] = 1;
    for (int c = 0; c < 8; ++c) {
      quality[i] = std::min(quality[i], corner_quality(edges(x, i, c), edges(y, i, c)));
    }
  }
}

template <int Dim> void row_thickness(const Grid& g, const std::array<RowField, Dim>& mesh, int j, int k, double* thickness) {
  for (int i = 0; i < g.cells[0]; ++i) {
    double t[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, Dim == 2 ? 1.0 : 0.0}}; // mid lines [axis][component]; in 2D a unit across the plane
    for (int c = 0; c < (1 << Dim); ++c) {
      const int r = g.node_row(j + (c >> 1 & 1), k + (c >> 2));
      for (int a = 0; a < Dim; ++a) {
        for (std::size_t d = 0; d < Dim; ++d) {
          t[a][d] += ((c >> a & 1) != 0 ? 1 : -1) * mesh[d].row(r)[i + (c & 1)] / (1 << (Dim - 1));
        }
      }
    }
    double side[3], largest = 0, content = 0;
    for (int a = 0; a < Dim; ++a) {
      cross(t[(a + 1) % 3], t[(a + 2) % 3], side);
      content = dot(t[a], side);
      largest = std::max(largest, dot(side, side));
    }
    thickness[i] = largest > 0 ? content / std::sqrt(largest) : 0.0;
  }
}

/// Least of what row(j, k, values) gives for all rows of cells.
template <class Row> double least_of(const Grid& g, ThreadPool& pool, double most, Row&& row) {
  std::vector<double> least(static_cast<std::size_t>(g.slabs()), most);
  parallel_ranges(pool, g.slabs(), [&](int begin, int end, int) {
    std::vector<double> values(static_cast<std::size_t>(g.cells[0]));
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        row(j, k, values.data());
        least[static_cast<std::size_t>(s)] = std::min(least[static_cast<std::size_t>(s)], *std::min_element(values.begin(), values.end()));
      }
    }
  });
  return *std::min_element(least.begin(), least.end());
}

template <int Dim>
double mesh_quality(const Grid& g, const std::array<RowField, Dim>& mesh, const std::array<RowField, Dim>& reference, ThreadPool& pool) {
  return least_of(g, pool, 1.0, [&](int j, int k, double* out) { row_quality(g, mesh, reference, j, k, out); });
}

template <int Dim> double least_thickness(const Grid& g, const std::array<RowField, Dim>& mesh, ThreadPool& pool) {
  return least_of(g, pool, std::numeric_limits<double>::infinity(), [&](int j, int k, double* out) { row_thickness<Dim>(g, mesh, j, k, out); });
}

template <int Dim>
double largest_stray(const Grid& g, const std::array<RowField, Dim>& mesh, const std::array<RowField, Dim>& reference, ThreadPool& pool) {
  std::vector<double> largest(static_cast<std::size_t>(g.slabs()) + 1, 0.0);
  parallel_ranges(pool, g.slabs() + 1, [&](int begin, int end, int) {
    for (int plane = begin; plane < end; ++plane) {
      double& most = largest[static_cast<std::size_t>(plane)];
      for (int q = 0; q < (Dim == 3 ? g.cells[1] + 1 : 1); ++q) {
        const int index[3] = {0, Dim == 3 ? q : plane, Dim == 3 ? plane : 0};
        const int r = g.node_row(index[1], index[2]);
        for (int a = 0; a < Dim; ++a) { // to the next node, or at the end from the one before
          const int step = a > 0 && index[a] == g.cells[static_cast<std::size_t>(a)] ? -1 : 1;
          const int next = a == 0 ? r : r + step * g.node_row_stride(a);
          for (int i = 0; i <= g.cells[0]; ++i) {
            const int ni = a > 0 ? i : i < g.cells[0] ? i + 1 : i - 1;
            double along = 0, square = 0;
            for (std::size_t d = 0; d < Dim; ++d) {
              const double edge = reference[d].row(next)[ni] - reference[d].row(r)[i];
              along += edge * (mesh[d].row(r)[i] - reference[d].row(r)[i]);
              square += edge * edge;
            }
            most = square > 0 ? std::max(most, std::abs(along) / square) : most;
          }
        }
      }
    }
  });
  return *std::max_element(largest.begin(), largest.end());
}

template void row_thickness<2>(const Grid&, const std::array<RowField, 2>&, int, int, double*);
template void row_thickness<3>(const Grid&, const std::array<RowField, 3>&, int, int, double*);
template double least_thickness<2>(const Grid&, const std::array<RowField, 2>&, ThreadPool&);
template double least_thickness<3>(const Grid&, const std::array<RowField, 3>&, ThreadPool&);
template double largest_stray<2>(const Grid&, const std::array<RowField, 2>&, const std::array<RowField, 2>&, ThreadPool&);
template double largest_stray<3>(const Grid&, const std::array<RowField, 3>&, const std::array<RowField, 3>&, ThreadPool&);
template double mesh_quality<2>(const Grid&, const std::array<RowField, 2>&, const std::array<RowField, 2>&, ThreadPool&);
template double mesh_quality<3>(const Grid&, const std::array<RowField, 3>&, const std::array<RowField, 3>&, ThreadPool&);

} // namespace ballast
