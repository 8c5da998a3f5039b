// Outlines of a planar or axisymmetric stack: every run of a layer's elements that are left is a closed loop, and the body is what all of them
// cover together, with the slits between layers that no mesh is to see (ale/embed/layer_body). Loops move as the layers do, so nothing jumps when
// layers slide, part, meet or tear but what has gone itself.
//
// A stretch of a loop is hidden where it lies in another layer, or that layer's face closer than `seen` times `least_thickness`; the rest of all loops is the body's
// surface. Where what is left between two such surfaces is thinner than `least_thickness`, the body is taken as that thick.
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
  int side;      ///< of the stretch to the next vertex: 0 lower, 1 upper, 2 rim; none if both faces go on: -1 straight (what holds the edge), -2 as in a mirror
  bool hidden;   ///< the same stretch
};

/// Along a layer's lower face, up the rim, back along the upper face; closed.
using Outline = std::vector<OutlineVertex>;

/// `own` (m, by node of a plane): what the stack itself must be thick, where others lie against it; empty: all of `least_thickness`.
std::vector<Outline> find_outlines(const LayerStack<2>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, const std::vector<double>& own = {});

} // namespace ballast
