// The start-up table: what a scene models and what it costs.
#pragma once

#include "problems/scene_spec.hpp"

#include <string>
#include <vector>

namespace ballast {

/// Mass (kg; planar: kg/m) and volume of each body as filled into the mesh, overlaps counted once.
struct Filled {
  double mass = 0;
  double volume = 0;
};
std::vector<Filled> filled_bodies(const SceneSpec& scene);

/// Volume of the cell lo..hi: planar per metre of depth, axisymmetric the whole ring.
double cell_volume(Geometry geometry, const Point& lo, const Point& hi);

/// Steps to the end time if the step stays the smallest cell over the fastest sound speed, times
/// cfl.
double estimated_steps(const SceneSpec& scene);

/// What a run will cost, roughly: memory within a third, time within a factor of two.
struct Cost {
  double cells = 1, steps = 0, bytes_per_cell = 0;
  double core_seconds = 0; ///< on one core like those of docs/performance.md
};
Cost estimated_cost(const SceneSpec& scene);

/// Several tables: geometry, mesh and boundaries, materials, bodies, layers, gauges, numerics.
std::string scene_table(const SceneSpec& scene);

} // namespace ballast
