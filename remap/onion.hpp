#pragma once
// Onion-skin reconstruction: M materials in a cell, in priority order, split by M - 1 planes.
//
//   Material k lies outside the planes before it and inside plane k; plane k holds the cumulated
//   fraction of materials 0..k, so its normal comes from that sum's stencil (Youngs 1982). The last
//   material (void in the deck's order) takes what is left.
//
// Known compromise: planes may cross inside the cell. Over the whole cell each material still has
// its fraction, but within a slab the later material yields to the earlier one, so slabs that tile
// the cell may hold more than the fraction of a middle material: donors must cap what they give.

#include "remap/normal.hpp"

namespace ballast::remap {

// Material on the side n.x <= alpha of the unit cube, n out of it.
template <int Dim> struct Interface {
  Normal<Dim> n;
  double alpha;
};

// cumulated: count stencils of stencil_size<Dim> values, one after the other; stencil k holds the
// sums of fractions 0..k, clipped to [0, 1] here. Fills interfaces[count].
template <int Dim>
void onion_interfaces(NormalMethod method,
                      const double* cumulated,
                      int count,
                      Interface<Dim>* interfaces);

// volumes[count + 1] of the materials in the slab lo <= x[axis] <= hi of the unit cube: none is
// negative, and in any order they add up to (hi - lo) exactly: all are multiples of its last bit,
// and the largest absorbs round-off (at most count bits). lo and hi must lie in [0, 1]; hi <= lo
// gives zeros.
template <int Dim>
void slab_volumes(
    const Interface<Dim>* interfaces, int count, int axis, double lo, double hi, double* volumes);

} // namespace ballast::remap
