// Swept volumes: what each face covers on its way from `from` to `to`, exactly, so that a cell's new volume
// minus its old is the sum over its faces. The nodes go one coordinate after the other, in the order of the
// sweeps: a stretch along axes is then a sequence of one-dimensional ones, and split sweeps are exact for
// linear fields (straight paths leave an error dx dy / 2 times the gradient's divergence).
#include "remap/internal.hpp"

#include "core/hex_geometry.hpp"

#include <algorithm>

namespace ballast::remap {

namespace {

/// Node rows of the components, where the nodes are at some time of the motion.
template <int Dim> using Nodes = std::array<const RowField*, Dim>;

template <bool Axisymmetric>
void add_leg(const Grid& g, int axis, int j, Span faces, const Nodes<2>& from, const Nodes<2>& to, double* out) {
  const int far = axis == 0 ? 1 : 0, step = axis == 0 ? 0 : 1; // the face's second node
  const int r0 = g.node_row(j, 0), r1 = g.node_row(j + far, 0);
  const double *ax0 = from[0]->row(r0), *ay0 = from[1]->row(r0), *bx0 = to[0]->row(r0), *by0 = to[1]->row(r0);
  const double *ax1 = from[0]->row(r1) + step, *ay1 = from[1]->row(r1) + step;
  const double *bx1 = to[0]->row(r1) + step, *by1 = to[1]->row(r1) + step;
  const double sign = axis == 0 ? 1 : -1; // the quad's sense of rotation
#pragma omp simd
  for (int i = faces.begin; i < faces.end; ++i) {
    const QuadGeometry<Axisymmetric> q{{ax0[i], bx0[i], bx1[i], ax1[i]}, {ay0[i], by0[i], by1[i], ay1[i]}};
    const bool moved = ax0[i] != bx0[i] || ay0[i] != by0[i] || ax1[i] != bx1[i] || ay1[i] != by1[i];
    out[i] += moved ? sign * q.volume() : 0.0;
  }
}

/// Component d moves, the others stand: the sweep of a bilinear face is the integral of its displacement
/// over its projection, sum_q dx_q (4 J_q + 2 J_next + 2 J_last + J_opposite) / 36 with J twice the
/// projection's triangle areas at the corners. Exact, and a third of a hexahedron's work.
void add_leg(const Grid& g, int axis, int j, int k, int d, Span faces, const Nodes<3>& from, const Nodes<3>& to, double* out) {
  // The face's four nodes, as (di, dj, dk), turning right-handed about +axis.
  static constexpr int face[3][4][3] = {{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}},
                                        {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}},
                                        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const auto du = static_cast<std::size_t>((d + 1) % 3), dv = static_cast<std::size_t>((d + 2) % 3), dx = static_cast<std::size_t>(d);
  const double *a[4], *b[4], *u[4], *v[4];
  for (int q = 0; q < 4; ++q) {
    const int* f = face[axis][q];
    const int r = g.node_row(j + f[1], k + f[2]);
    a[q] = from[dx]->row(r) + f[0];
    b[q] = to[dx]->row(r) + f[0];
    u[q] = from[du]->row(r) + f[0];
    v[q] = from[dv]->row(r) + f[0];
  }
#pragma omp simd
  for (int i = faces.begin; i < faces.end; ++i) {
    double jacobian[4], moved[4], sum = 0;
#pragma GCC unroll 4
    for (int q = 0; q < 4; ++q) {
      const int n = (q + 1) & 3, l = (q + 3) & 3;
      jacobian[q] = (u[n][i] - u[q][i]) * (v[l][i] - v[q][i]) - (u[l][i] - u[q][i]) * (v[n][i] - v[q][i]);
      moved[q] = b[q][i] - a[q][i];
    }
#pragma GCC unroll 4
    for (int q = 0; q < 4; ++q) {
      sum += moved[q] * (4 * jacobian[q] + 2 * (jacobian[(q + 1) & 3] + jacobian[(q + 3) & 3]) + jacobian[(q + 2) & 3]);
    }
    out[i] += sum * (1.0 / 36);
  }
}

template <int Dim> void close_faces(const Mesh<Dim>& m, int axis, int r, Span faces, double* out) {
  if (m.closed != nullptr) {
    const char* closed = (*m.closed)[static_cast<std::size_t>(axis)].data() + static_cast<std::ptrdiff_t>(r) * m.grid.cell_pitch() + m.grid.ghost[0];
    for (int i = faces.begin; i < faces.end; ++i) {
      out[i] = closed[i] != 0 ? 0.0 : out[i];
    }
  }
}

} // namespace

template <int Dim>
void compute_swept(Mesh<Dim>& m, ThreadPool& pool, const std::array<RowField, Dim>& from, const std::array<RowField, Dim>& to, long order) {
  const Grid& g = m.grid;
  std::array<Nodes<Dim>, Dim + 1> leg; // where the nodes are before and after each leg
  for (std::size_t d = 0; d < Dim; ++d) {
    leg[0][d] = &from[d];
  }
  for (int q = 0; q < Dim; ++q) {
    const auto at = static_cast<std::size_t>(q), d = static_cast<std::size_t>(sweep_axis(Dim, q, order));
    leg[at + 1] = leg[at];
    leg[at + 1][d] = &to[d];
  }
  const int slabs = g.cells[Dim - 1] + 1, rows = Dim == 3 ? g.cells[1] + 1 : 1;
  parallel_awake(pool, m.awake, slabs, [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      for (int row = 0; row < rows; ++row) {
        const int j = Dim == 3 ? row : s, k = Dim == 3 ? s : 0;
        for (int axis = 0; axis < Dim; ++axis) {
          if ((axis != 1 && j == g.cells[1]) || (Dim == 3 && axis != 2 && k == g.cells[2])) {
            continue;
          }
          double* out = m.swept[static_cast<std::size_t>(axis)].row(g.cell_row(j, k));
          const Span faces = m.faces(axis, g.cell_row(j, k));
          if (faces.empty()) {
            continue;
          }
          std::fill(out + faces.begin, out + faces.end, 0.0);
          for (std::size_t q = 0; q < Dim; ++q) {
            if constexpr (Dim == 3) {
              add_leg(g, axis, j, k, sweep_axis(Dim, static_cast<int>(q), order), faces, leg[q], leg[q + 1], out);
            } else if (m.axisymmetric) {
              add_leg<true>(g, axis, j, faces, leg[q], leg[q + 1], out);
            } else {
              add_leg<false>(g, axis, j, faces, leg[q], leg[q + 1], out);
            }
          }
          close_faces(m, axis, g.cell_row(j, k), faces, out);
        }
      }
    }
  });
}

template void compute_swept<2>(Mesh<2>&, ThreadPool&, const std::array<RowField, 2>&, const std::array<RowField, 2>&, long);
template void compute_swept<3>(Mesh<3>&, ThreadPool&, const std::array<RowField, 3>&, const std::array<RowField, 3>&, long);

} // namespace ballast::remap
