// The start-up table's part about stacks of fabric layers.
#pragma once

#include "problems/scene_spec.hpp"

#include <string>

namespace ballast {

/// What a stack is and costs, before it is built.
struct LayersCost {
  double elements = 0, nodes = 0;
  double mass = 0;  ///< kg of the part in the scene; planar: kg/m; around an axis the whole
  double bytes = 0;
  double step = 0;  ///< s: cfl times the stable step at rest
  double steps = 0; ///< of that length to the end time
  double core_seconds = 0; ///< without contact, on one core like those of docs/performance.md
};
LayersCost layers_cost(const LayersSpec& layers, const SceneSpec& scene);

/// Lines of a table; empty without layers.
std::string layers_table(const SceneSpec& scene);

} // namespace ballast
