// Mass that crosses between neighbouring nodes along one axis: the faces of the dual mesh, here called links.
//
// Node p owns the shares w of the masses of its cells, M_p = sum w m. Inside cell c the mass that crosses
// from its lower to its upper node along the axis is G_c = w_high F_low + w_low F_high, with F the face mass fluxes: node
// masses then stay the sum of their shares exactly, whatever the flow.
#pragma once

#include "remap/internal.hpp"

#include <array>
#include <vector>

namespace ballast::remap {

/// The links below the nodes of one row; along axis 0 also the one above the last node. Scratch of one thread: rows are
/// read until the next compute().
template <int Dim> class DualFlux {
public:
  DualFlux(const Mesh<Dim>& mesh, const RowField& cell_mass, const std::array<RowField, Dim>& mass_flux, int axis);

  /// Dual mass flux of the links below the nodes of row (j, k), and the cell masses that their factors take. Both are
  /// linear in what the columns of cells beside the link hold, so those are summed first, weighted by the shares across
  /// the axis: S of masses by layer of cells, T of face fluxes by layer of faces. Then flux = w_high T_low + w_low T_high.
  void compute(int j, int k, Span links);

  int links() const { return links_; }
  const double* flux() const { return flux_.data(); }
  const double* low() const { return low_.data(); } ///< share of the link's cell that goes to its lower node; 0 outside
  const double* high() const { return high_.data(); }
  const double* before() const { return before_; } ///< S of the layer of cells below the link's
  const double* between() const { return between_; }
  const double* after() const { return after_; }

private:
  double* masses(std::size_t q) { return mass_rows_[q].data() + 1; }
  void set_masses(const double* before, const double* between, const double* after) {
    before_ = before;
    between_ = between;
    after_ = after;
  }

  /// out[i] for i in [first, end): sum over the columns of cells around link i of row (j, k), each by its share across the
  /// axis, of the row's value at i + shift (and one column lower where the link has cells on both sides of axis 0). The
  /// index along the sweep's own axis is taken as it is.
  void sum_columns(int j, int k, const RowField& of, int shift, int first, int end, double* out) const;

  /// Share of a cell's mass that goes to its upper (`high`) or lower node along an axis.
  double share_of(int axis, int cell, bool high) const;

  const Mesh<Dim>& m_;
  const RowField& cell_mass_;
  const std::array<RowField, Dim>& mass_flux_;
  int axis_, links_;
  std::vector<double> flux_, low_, high_, faces_low_, faces_high_;
  std::array<std::vector<double>, 3> mass_rows_; ///< S of three layers
  const double *before_ = nullptr, *between_ = nullptr, *after_ = nullptr;
  std::array<int, 2> last_ = {-9, -9}; ///< row of nodes whose links were the last
  Span last_links_;                    ///< and which of them
};

} // namespace ballast::remap
