// The faces of a stack's layers in 3D: lower and upper ones, and rims where elements end or have gone. What another layer covers is hidden, the rest is
// the surface of the body that all layers make together (ale/embed/layer_body), with the slits between them that no mesh is to see.
//
// A quadrilateral that is hidden in part is cut into smaller ones, each hidden or not by its middle.
#pragma once

#include "ale/layers/layer_stack.hpp"
#include "core/threads.hpp"

#include <array>
#include <vector>

namespace ballast {

/// A node of a layer's lower or upper face.
struct SkinVertex {
  std::array<double, 3> x = {}, normal = {}; ///< m; sum of its layer's faces' unit normals there
  double offset = 0;                         ///< m, outward: what the body is made thicker
};

/// A quadrilateral of four nodes, or a part of it. Parameters: 0 to 1 from the first corner to the second, and to the fourth.
struct SkinPatch {
  std::array<std::size_t, 4> node; ///< of the stack; turning right-handed about the way out
  std::array<int, 4> vertex;       ///< the same in Skin::vertices
  std::array<double, 2> low = {0, 0}, high = {1, 1}; ///< its own part
  int side;                                          ///< 0 lower, 1 upper, 2 rim
  bool hidden = false;
};

struct Skin {
  std::vector<SkinVertex> vertices; ///< by layer, lower and upper face, j, i; those of no face: zero
  std::vector<SkinPatch> patches;
};

/// `own` as in ale/embed/outline. The same for any pool.
Skin find_skin(const LayerStack<3>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, ThreadPool& pool, const std::vector<double>& own = {});

/// Weights of a quadrilateral's corners at a place.
inline std::array<double, 4> corner_weights(double u, double v) { return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v}; }

} // namespace ballast
