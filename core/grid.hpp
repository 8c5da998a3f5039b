// Grid: the logical shape of a block (cells, nodes, ghosts) and how rows of it are numbered.
//
// i runs fastest. A row is one line of cells (or nodes) along i; rows are numbered j fastest, ghosts
// included, so row(j, k) is valid for -ghost <= j < cells + ghost. In 2D there is one plane, k = 0.
// A slab is the last axis' layer: one row in 2D, a plane of rows in 3D.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace ballast {

struct Grid {
  int dim = 2;
  std::array<int, 3> cells = {1, 1, 1};
  std::array<int, 3> ghost = {2, 2, 0};

  Grid() = default;
  Grid(int dimension, std::array<int, 3> n)
      : dim(dimension), cells{n[0], n[1], dimension == 3 ? n[2] : 1},
        ghost{2, 2, dimension == 3 ? 2 : 0} {}

  int cell_pitch() const { return cells[0] + 2 * ghost[0]; }
  int node_pitch() const { return cells[0] + 1 + 2 * ghost[0]; }
  int cell_rows_per_plane() const { return cells[1] + 2 * ghost[1]; }
  int node_rows_per_plane() const { return cells[1] + 1 + 2 * ghost[1]; }
  int cell_planes() const { return cells[2] + 2 * ghost[2]; }
  int node_planes() const { return dim == 3 ? cells[2] + 1 + 2 * ghost[2] : 1; }
  int cell_rows() const { return cell_rows_per_plane() * cell_planes(); }
  int node_rows() const { return node_rows_per_plane() * node_planes(); }
  int cell_row(int j, int k) const { return (k + ghost[2]) * cell_rows_per_plane() + j + ghost[1]; }
  int node_row(int j, int k) const { return (k + ghost[2]) * node_rows_per_plane() + j + ghost[1]; }

  int slabs() const { return cells[dim - 1]; }
  int rows_per_slab() const { return dim == 3 ? cells[1] : 1; }
  /// (j, k) of row r of slab s.
  std::array<int, 2> in_slab(int s, int r) const {
    return dim == 3 ? std::array<int, 2>{r, s} : std::array<int, 2>{s, 0};
  }
  long cell_count() const { return static_cast<long>(cells[0]) * cells[1] * cells[2]; }
  /// Row offset between neighbours along `axis` (0: none, they share the row).
  int cell_row_stride(int axis) const { return axis == 0 ? 0 : axis == 1 ? 1 : cell_rows_per_plane(); }
  int node_row_stride(int axis) const { return axis == 0 ? 0 : axis == 1 ? 1 : node_rows_per_plane(); }
};

/// One double a cell (or node), ghosts included, by rows.
class RowField {
public:
  RowField() = default;
  RowField(int pitch, int rows, int ghost, double value = 0)
      : pitch_(pitch), ghost_(ghost),
        data_(static_cast<std::size_t>(pitch) * static_cast<std::size_t>(rows), value) {}
  static RowField of_cells(const Grid& g, double value = 0) {
    return {g.cell_pitch(), g.cell_rows(), g.ghost[0], value};
  }
  static RowField of_nodes(const Grid& g, double value = 0) {
    return {g.node_pitch(), g.node_rows(), g.ghost[0], value};
  }

  /// Pointer to i = 0 of a row; -ghost <= i < cells + ghost is valid.
  double* row(int r) { return data_.data() + static_cast<std::ptrdiff_t>(r) * pitch_ + ghost_; }
  const double* row(int r) const {
    return data_.data() + static_cast<std::ptrdiff_t>(r) * pitch_ + ghost_;
  }
  bool empty() const { return data_.empty(); }
  std::vector<double>& data() { return data_; }
  const std::vector<double>& data() const { return data_; }
  void swap(RowField& other) { data_.swap(other.data_); }

private:
  int pitch_ = 0, ghost_ = 0;
  std::vector<double> data_;
};

} // namespace ballast
