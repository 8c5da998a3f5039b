// Graded mesh lines of one axis: sizes at chosen places, geometric in between, ends met exactly.
#pragma once

#include <vector>

namespace ballast {

/// Stretches from - to[0] - to[1] ... `size` holds the cell size at each `to`, or at `from` and
/// each `to`; with one entry a `to`, the first stretch is uniform.
struct AxisPlan {
  double from = 0;
  std::vector<double> to;
  std::vector<double> size;
};

/// Cells this plan makes; a double, so that absurd plans can be refused before any memory is taken.
double planned_cells(const AxisPlan& plan);

/// Largest ratio of neighbouring cells.
double steepest_ratio(const AxisPlan& plan);

/// Node coordinates, ascending, planned_cells + 1 of them.
std::vector<double> mesh_lines(const AxisPlan& plan);

} // namespace ballast
