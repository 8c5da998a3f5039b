// Outlines of a planar or axisymmetric stack of layers: around each run of columns that still hold something, along the lower faces, up the rim,
// back along the upper ones (ale/embed/layer_body).
//
// The face of a column is that of its first or last layer left. Where that changes, at the edge of a hole, layers may have slid and parted: the
// outline goes along the inner layer to where the outer one's edge lies over it, or, where the gap between the two is wide enough for the mesh to see
// (`least_thickness`), on to where it is not, and back along the outer layer's other face. A flap of that kind that is thinner than a mesh sees is
// taken as that thick, as any body is. Gaps that wide elsewhere are outlines of their own, so that one that is pinched off stays what it was.
#pragma once

#include "ale/layers/layer_stack.hpp"

#include <array>
#include <vector>

namespace ballast {

/// A point of an outline, between two nodes of a plane.
struct OutlineVertex {
  std::array<std::size_t, 2> node;
  std::array<double, 2> weight;
  std::array<double, 2> x;
  double offset; ///< m, outward: what the body is made thicker
  int side;      ///< of the face to the next vertex along the layers: 0 lower, 1 upper
};

struct Outline {
  std::vector<OutlineVertex> lower, upper;   ///< both along the layers
  bool goes_on_low = false, goes_on_high = false; ///< beyond its ends: a plane of symmetry, or what holds the stack's edge
  std::vector<std::vector<OutlineVertex>> gaps;   ///< closed: wide ones between two layers, away from holes
};

std::vector<Outline> find_outlines(const LayerStack<2>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness);

} // namespace ballast
