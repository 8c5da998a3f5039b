// The interfaces in a mixed cell with strength: what they part, and the normal that all of them take (ale/traction.hpp).
#pragma once

#include "ale/block.hpp"
#include "ale/closure.hpp"

#include <Eigen/Core>

#include <array>

namespace ballast {

inline constexpr double full_slip = 0.05; ///< of a cell: with less soft matter in it the slip law fades out

/// What a cell holds, the least shear traction first: void, fluids, then by flow stress.
struct CellLayers {
  struct Layer {
    std::size_t material = 0;
    double fraction = 0;
    double traction = 0; ///< shear traction it can carry, Pa
  };
  std::array<Layer, max_materials_in_cell> layer{};
  int count = 0;

  const Layer* begin() const { return layer.data(); }
  const Layer* end() const { return layer.data() + count; }

  /// How much there is to slip on, 0 to 1: a trace of soft matter in a corner does not part what is strong.
  double slip() const;

  /// Shear traction, Pa, that a material which could carry `own` finds here: that of what is softer, if there
  /// is enough of it.
  double carried(double own) const;
};

/// The layers of cell i of a row of cells.
template <int Dim> CellLayers layers_of(const Block<Dim>& block, int row, int i);

/// Unit normal of the interfaces in a cell {i, j, k}, up to its sign: of what is softer against what is stronger, each
/// by how much there is of the lesser. From the gradients of the summed fraction at the cell's corners: their
/// mean (Youngs) where they agree, their spread where both sides of a sheet are in the cell. Zero without one.
template <int Dim>
Eigen::Vector3d interface_normal(const Block<Dim>& block, const CellLayers& layers, const std::array<int, 3>& cell);

} // namespace ballast
