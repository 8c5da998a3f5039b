// Shapes a scene is filled with, and the volume fraction of a mesh cell they cover.
//
// A point has three coordinates, in the order of the mesh axes: planar (x, y, 0), axisymmetric
// (r, z, 0), three-d (x, y, z). A shape is a solid in that space; a 2D scene sees its section with
// the third coordinate 0. So in an axisymmetric scene a sphere on the axis is a sphere, off the
// axis a ring.
//
// Fractions: a cell is decided whole by the signed distance of its centre where that is possible;
// otherwise it is split at aligned faces, lines are cast through each part along the axis that
// crosses the surface most squarely, cut exactly where they meet a surface, and summed
// (axisymmetric: weighted with r). Error below 1e-3 of a cell for shapes that are smooth on the
// cell's scale; aligned faces are exact. A closed surface of facets is asked through the few facets
// that are in the cell. Voxels are exact against each other and against boxes.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace ballast {

using Point = std::array<double, 3>;

/// Mesh axes: planar x, y; axisymmetric r, z; three_d x, y, z.
enum class Geometry { planar, axisymmetric, three_d };

/// 2 or 3.
inline int dimensions(Geometry geometry) {
  return geometry == Geometry::three_d ? 3 : 2;
}

/// Corners `from` < `to`; infinite extents are allowed.
struct Box {
  Point from, to;
};

struct Sphere {
  Point centre;
  double radius;
};

/// Solid round cylinder on the segment from - to.
struct Cylinder {
  Point from, to;
  double radius;
};

/// Outline [z, r] from base to tip (z never decreases, straight between points), turned about the
/// line through `origin` (where z = 0) along the unit vector `axis`.
struct Revolved {
  Point origin, axis;
  std::vector<std::array<double, 2>> profile;
};

/// All points x with (x - point) . outward < 0.
struct HalfSpace {
  Point point, outward;
};

/// Corners centre +- half[0] axes[0] +- half[1] axes[1] +- half[2] axes[2], the axes of length 1 and
/// square to each other: a box that has been turned. Infinite extents are allowed.
struct TurnedBox {
  Point centre;
  std::array<Point, 3> axes;
  Point half;
};

class ClosedSurface;
struct SurfacePiece;

/// A solid inside a closed surface of facets; 3D scenes only.
struct Surface {
  std::shared_ptr<const ClosedSurface> whole;
  std::shared_ptr<const SurfacePiece> piece; ///< what the cell in hand sees of it, or none
};

class VoxelSolid;

/// Voxels of an image that have one of the labels wanted; 3D scenes only.
struct Voxels {
  std::shared_ptr<const VoxelSolid> solid;
};

struct Shape;

/// All of (intersection), any of (union), or the first without the others (difference).
struct Combination {
  enum class Kind { unite, intersect, subtract };
  Kind kind;
  std::vector<Shape> parts;
};

struct Shape {
  std::variant<Box, Sphere, Cylinder, Revolved, HalfSpace, Combination, TurnedBox, Surface, Voxels> form;
};

/// Smallest known aligned box around a shape; infinite where it is.
struct Bounds {
  Point lo{-std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity(),
           -std::numeric_limits<double>::infinity()};
  Point hi{std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
};
Bounds bounds(const Shape& shape);

/// Negative inside, positive outside, |value| never more than the distance to the surface (m).
double signed_distance(const Shape& shape, const Point& p);
/// The same as signed_distance < 0, faster.
bool contains(const Shape& shape, const Point& p);

/// Share of the cell lo..hi that `shape` covers, 0 to 1 (axisymmetric: of its volume); exactly 0 or
/// 1 where the surface misses the cell.
double fraction(const Shape& shape, Geometry geometry, const Point& lo, const Point& hi);

/// Do intersections and differences leave nothing of the shape? Looked at within its bounds, within `around` where they are infinite
/// (and not at all where both are); what is thinner than all lines through a piece of 1/16 (2D: 1/64) of them may pass for nothing.
bool is_empty(const Shape& shape, Geometry geometry, const Bounds& around);

/// Shares of the cell that each of `shapes` shows, later shapes replacing earlier ones; what no
/// shape covers is 1 minus their sum. `shares` has one entry a shape.
void visible_fractions(std::span<const Shape* const> shapes,
                       Geometry geometry,
                       const Point& lo,
                       const Point& hi,
                       std::span<double> shares);

/// One line for tables: "revolved profile of 44 points".
std::string describe(const Shape& shape);

} // namespace ballast
