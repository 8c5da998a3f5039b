// Corner forces of one slab of cells, private to the force pass (ale/lagrange_step).
#pragma once

#include "ale/corner_force.hpp"
#include "core/awake.hpp"

#include <algorithm>
#include <vector>

namespace ballast {

/// Corner forces of one slab, rolling: rows padded so that neighbours outside the block read zeros.
template <int Dim> class CornerSlab {
public:
  explicit CornerSlab(const Grid& g)
      : pitch_(g.cells[0] + 2), rows_(Dim == 3 ? g.cells[1] + 2 : 1),
        data_(static_cast<std::size_t>(components * pitch_ * rows_), 0.0), clean_(static_cast<std::size_t>(rows_), 1) {}

  /// Row r (-1 .. n in 3D, 0 in 2D), for some of its cells to be written; it is zero elsewhere.
  CornerRows<Dim> row_for(int r, Span cells) {
    const int at = Dim == 3 ? r + 1 : 0;
    if (cells.count() < pitch_ - 2) {
      clear(at);
    }
    clean_[static_cast<std::size_t>(at)] = cells.empty() ? 1 : 0;
    return row(r);
  }
  CornerRows<Dim> row(int r) {
    CornerRows<Dim> out{};
    for (int p = 0; p < (1 << Dim); ++p) {
      for (int d = 0; d < Dim; ++d) {
        out.f[p][d] = data_.data() + ((Dim == 3 ? r + 1 : 0) * components + p * Dim + d) * pitch_ + 1;
      }
    }
    return out;
  }
  void clear() {
    for (int at = 0; at < rows_; ++at) {
      clear(at);
    }
  }
  void swap(CornerSlab& other) {
    data_.swap(other.data_);
    clean_.swap(other.clean_);
  }

private:
  static constexpr int components = Dim << Dim;

  void clear(int at) {
    if (clean_[static_cast<std::size_t>(at)] == 0) {
      double* first = data_.data() + at * components * pitch_;
      std::fill(first, first + components * pitch_, 0.0);
      clean_[static_cast<std::size_t>(at)] = 1;
    }
  }

  int pitch_, rows_;
  std::vector<double> data_;
  std::vector<char> clean_; ///< by row: all zero
};

/// Sums the corners at node row q of the plane between `below` and `here`, per component.
template <int Dim>
void gather(CornerSlab<Dim>& below, CornerSlab<Dim>& here, int q, Span nodes, double* const (&force)[Dim]) {
  const auto add = [&](const CornerRows<Dim>& rows, int at_i, int at_im1) {
    for (int d = 0; d < Dim; ++d) {
      const double *a = rows.f[at_i][d], *c = rows.f[at_im1][d] - 1;
      double* f = force[d];
#pragma omp simd
      for (int i = nodes.begin; i < nodes.end; ++i) {
        f[i] += a[i] + c[i];
      }
    }
  };
  if constexpr (Dim == 2) {
    add(here.row(0), 0, 1);
    add(below.row(0), 3, 2);
  } else {
    add(here.row(q), 0, 1);
    add(here.row(q - 1), 3, 2);
    add(below.row(q), 4, 5);
    add(below.row(q - 1), 7, 6);
  }
}

} // namespace ballast
