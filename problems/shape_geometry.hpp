// What the parts of the shapes' geometry share: vectors, axes, profiles. Not for readers of shapes.
#pragma once

#include "problems/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ballast {

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Point axis_of(const Cylinder& c) {
  Point a = c.to - c.from;
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}
/// The mesh axis a unit vector lies along, or -1.
inline int aligned_with(const Point& a) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(std::abs(a[k]) - 1) < 1e-12) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

/// First profile segment that can reach z: index i of points i, i + 1.
inline std::size_t segment_at(const Revolved& r, double z) {
  const auto above =
      std::upper_bound(r.profile.begin(), r.profile.end(), z, [](double value, const auto& point) {
        return value < point[0];
      });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, above - r.profile.begin()) - 1);
}

Bounds bounds_of(const Cylinder& c);

// ---- closed surfaces (problems/shape_surface.cpp) ----

double distance_to(const Surface& s, const Point& p);
bool holds(const Surface& s, const Point& p);
const Bounds& bounds_of(const Surface& s);
/// Any surface among the shape's parts?
bool has_surface(const Shape& shape);
/// The same shape for points of the box lo..hi, its surfaces cut down to the facets there.
Shape seen_from(const Shape& shape, const Point& lo, const Point& hi);
/// Does the surface itself come into the box?
bool enters(const Surface& s, const Point& lo, const Point& hi);

// ---- voxels (problems/shape_voxels.cpp) ----

double distance_to(const Voxels& v, const Point& p);
bool holds(const Voxels& v, const Point& p);
const Bounds& bounds_of(const Voxels& v);
/// Share of the box lo..hi, 0 to 1; what is within rounding of either is it.
double covered_share(const Voxels& v, const Point& lo, const Point& hi);
/// Any voxels among the shape's parts?
bool has_voxels(const Shape& shape);
/// Nothing but voxels and boxes along the axes, so that planes square to them cut it into boxes?
bool made_of_boxes(const Shape& shape);
/// Those planes across axis k between lo and hi.
void box_planes(const Shape& shape, std::size_t k, double lo, double hi, std::vector<double>& out);

} // namespace ballast
