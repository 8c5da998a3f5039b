// Shapes turned about a point and moved:
//   x -> about + R (x - about) + offset
// The result is a shape like any other: nothing is turned while cells are filled. Right angles are
// exact: a box stays a box. Voxels turn by right angles only.
#pragma once

#include "problems/shapes.hpp"

namespace ballast {

/// Rows of a proper rotation, R x = (rows[0] . x, rows[1] . x, rows[2] . x).
using Rotation = std::array<Point, 3>;

struct Placement {
  Rotation turn{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point about{};
  Point offset{};
};

/// About `axis` (any length but 0) by `angle` (rad), right-handed (Rodrigues).
Rotation rotation_about(const Point& axis, double angle);
/// About x, then y, then z, axes fixed in space, by angles[0], [1], [2] (rad).
Rotation rotation_xyz(const Point& angles);

Point turned(const Rotation& turn, const Point& direction);
Point placed(const Placement& placement, const Point& point);
Shape placed(const Placement& placement, const Shape& shape);
/// Can the shape be turned so? Voxels by right angles only: what is asked first is never refused by placed.
bool can_turn(const Rotation& turn, const Shape& shape);

} // namespace ballast
