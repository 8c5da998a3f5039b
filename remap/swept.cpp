// Swept volumes: what each face covers on its way from `from` to `to`, exactly (the quad or hexahedron
// of its old and new nodes), so that a cell's new volume minus its old is the sum over its faces.
#include "remap/internal.hpp"

#include "core/hex_geometry.hpp"

namespace ballast::remap {

namespace {

template <bool Axisymmetric>
void swept_row(const Mesh<2>& m, int axis, int j, const std::array<RowField, 2>& from, const std::array<RowField, 2>& to, double* out) {
  const Grid& g = m.grid;
  const int far = axis == 0 ? 1 : 0, step = axis == 0 ? 0 : 1; // the face's second node
  const int r0 = g.node_row(j, 0), r1 = g.node_row(j + far, 0);
  const double *ax0 = from[0].row(r0), *ay0 = from[1].row(r0), *bx0 = to[0].row(r0), *by0 = to[1].row(r0);
  const double *ax1 = from[0].row(r1) + step, *ay1 = from[1].row(r1) + step;
  const double *bx1 = to[0].row(r1) + step, *by1 = to[1].row(r1) + step;
  const int count = g.cells[0] + (axis == 0 ? 1 : 0);
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    QuadGeometry<Axisymmetric> q{};
    if (axis == 0) {
      q = {{ax0[i], bx0[i], bx1[i], ax1[i]}, {ay0[i], by0[i], by1[i], ay1[i]}};
    } else {
      q = {{ax0[i], ax1[i], bx1[i], bx0[i]}, {ay0[i], ay1[i], by1[i], by0[i]}};
    }
    const bool moved = ax0[i] != bx0[i] || ay0[i] != by0[i] || ax1[i] != bx1[i] || ay1[i] != by1[i];
    out[i] = moved ? q.volume() : 0.0;
  }
}

void swept_row(const Mesh<3>& m, int axis, int j, int k, const std::array<RowField, 3>& from, const std::array<RowField, 3>& to, double* out) {
  const Grid& g = m.grid;
  // The face's four nodes, as (di, dj, dk), in the order that makes a right-handed hexahedron.
  static constexpr int face[3][4][3] = {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}},
                                        {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}},
                                        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  // Hexahedron corner of face node q at the old and at the new position.
  static constexpr int old_corner[3][4] = {{0, 3, 7, 4}, {0, 1, 5, 4}, {0, 1, 2, 3}};
  static constexpr int new_corner[3][4] = {{1, 2, 6, 5}, {3, 2, 6, 7}, {4, 5, 6, 7}};
  const double *a[3][4], *b[3][4];
  for (int q = 0; q < 4; ++q) {
    const int* f = face[axis][q];
    const int r = g.node_row(j + f[1], k + f[2]);
    for (std::size_t d = 0; d < 3; ++d) {
      a[d][q] = from[d].row(r) + f[0];
      b[d][q] = to[d].row(r) + f[0];
    }
  }
  const int count = g.cells[0] + (axis == 0 ? 1 : 0);
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    HexGeometry h;
    bool moved = false;
#pragma GCC unroll 4
    for (int q = 0; q < 4; ++q) {
      const int o = old_corner[axis][q], n = new_corner[axis][q];
      h.x[o] = a[0][q][i];
      h.y[o] = a[1][q][i];
      h.z[o] = a[2][q][i];
      h.x[n] = b[0][q][i];
      h.y[n] = b[1][q][i];
      h.z[n] = b[2][q][i];
      moved = moved || h.x[o] != h.x[n] || h.y[o] != h.y[n] || h.z[o] != h.z[n];
    }
    out[i] = moved ? h.volume() : 0.0;
  }
}

} // namespace

template <int Dim>
void compute_swept(Mesh<Dim>& m, ThreadPool& pool, const std::array<RowField, Dim>& from, const std::array<RowField, Dim>& to) {
  const Grid& g = m.grid;
  for (int axis = 0; axis < Dim; ++axis) {
    RowField& swept = m.swept[static_cast<std::size_t>(axis)];
    const int top_j = g.cells[1] + (axis == 1 ? 1 : 0);
    if constexpr (Dim == 2) {
      parallel_ranges(pool, top_j, [&](int begin, int end, int) {
        for (int j = begin; j < end; ++j) {
          double* out = swept.row(g.cell_row(j, 0));
          m.axisymmetric ? swept_row<true>(m, axis, j, from, to, out) : swept_row<false>(m, axis, j, from, to, out);
        }
      });
    } else {
      const int top_k = g.cells[2] + (axis == 2 ? 1 : 0);
      parallel_ranges(pool, top_k, [&](int begin, int end, int) {
        for (int k = begin; k < end; ++k) {
          for (int j = 0; j < top_j; ++j) {
            swept_row(m, axis, j, k, from, to, swept.row(g.cell_row(j, k)));
          }
        }
      });
    }
  }
}

template void compute_swept<2>(Mesh<2>&, ThreadPool&, const std::array<RowField, 2>&, const std::array<RowField, 2>&);
template void compute_swept<3>(Mesh<3>&, ThreadPool&, const std::array<RowField, 3>&, const std::array<RowField, 3>&);

} // namespace ballast::remap
