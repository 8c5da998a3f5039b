// LayersSpec: a stack of fabric layers as a deck describes it, resolved and validated, in SI.
#pragma once

#include "ale/layers/layer_stack.hpp"

#include <array>
#include <string>
#include <vector>

namespace ballast {

struct LayersSpec {
  std::string name;
  std::string fabric;
  FabricModel model;            ///< its density that of this stack
  int plies = 1, layers = 1, through = 1;
  double thickness = 0;         ///< of the stack at rest, m
  double front = 0;             ///< m along the last axis; the stack lies behind it as the shot goes
  double direction = 1;         ///< of the shot along the last axis, +1 or -1: layers count from the front
  std::array<std::vector<double>, 2> lines; ///< in the plane, m; the second only in 3D
  std::array<std::array<LayerEdge, 2>, 2> edge = {{{LayerEdge::free, LayerEdge::free}, {LayerEdge::free, LayerEdge::free}}};
  double edge_stiffness = 0;    ///< N/m for a metre of edge
  double friction = 0;
  LayerHourglass hourglass;
  LayerGuard guard;
  LayerViscosity viscosity;
  double cfl = 0.7;
  int subcycles = 0;            ///< to one step of the mesh; 0: as many as the stack's stable step asks
  int debris = -1;              ///< index into SceneSpec::materials: what torn cloth becomes; none: particles
  double rate_time = 1e-6;      ///< s, of fabrics with a rate factor

  double density() const { return ballast::density(model); }
  double areal_density() const { return density() * thickness; } ///< kg/m2
  /// Ends along the last axis, m.
  double low() const { return direction > 0 ? front : front - thickness; }
  double high() const { return direction > 0 ? front + thickness : front; }
};

} // namespace ballast
