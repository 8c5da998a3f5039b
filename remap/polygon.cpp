#include "remap/polygon.hpp"

namespace ballast::remap {

namespace {

template <int Dim> double dot(const Point<Dim>& a, const Point<Dim>& b) {
  double sum = 0.0;
  for (int d = 0; d < Dim; ++d)
    sum += a[d] * b[d];
  return sum;
}

template <int Dim> Point<Dim> between(const Point<Dim>& a, const Point<Dim>& b, double t) {
  Point<Dim> p;
  for (int d = 0; d < Dim; ++d)
    p[d] = (1.0 - t) * a[d] + t * b[d];
  return p;
}

Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Sutherland-Hodgman: keeps n.x <= alpha.
Polygon<2> clipped(const Polygon<2>& polygon, const Normal<2>& n, double alpha) {
  Polygon<2> kept;
  for (int k = 0; k < polygon.count; ++k) {
    const Point<2>& a = polygon.points[k];
    const Point<2>& b = polygon.points[(k + 1) % polygon.count];
    const double above_a = dot<2>(n, a) - alpha;
    const double above_b = dot<2>(n, b) - alpha;
    if (above_a <= 0.0)
      kept.append(a);
    if ((above_a < 0.0 && above_b > 0.0) || (above_a > 0.0 && above_b < 0.0))
      kept.append(between<2>(a, b, above_a / (above_a - above_b)));
  }
  return kept.count >= 3 ? kept : Polygon<2>{};
}

Polygon<2> unit_square() {
  Polygon<2> square;
  for (const Point<2>& p : {Point<2>{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
    square.append(p);
  return square;
}

template <int Dim, class Cell> void map_polygon(const Cell& cell, Polygon<Dim>& polygon) {
  for (int k = 0; k < polygon.count; ++k)
    polygon.points[k] = map_to_cell(cell, polygon.points[k]);
}

Point<3> cube_corner(int corner) {
  return {double(corner & 1), double((corner >> 1) & 1), double((corner >> 2) & 1)};
}

// The plane's points on the cube's 12 edges, unordered. A corner in the plane counts as below it,
// so each cut edge gives one point and a plane that only touches gives none or coincident ones.
Polygon<3> edge_crossings(const Interface<3>& interface) {
  Polygon<3> cut;
  for (int corner = 0; corner < 8; ++corner)
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis) & 1)
        continue;
      const Point<3> a = cube_corner(corner);
      const Point<3> b = cube_corner(corner | (1 << axis));
      const double above_a = dot<3>(interface.n, a) - interface.alpha;
      const double above_b = dot<3>(interface.n, b) - interface.alpha;
      if ((above_a > 0.0) != (above_b > 0.0))
        cut.append(between<3>(a, b, above_a / (above_a - above_b)));
    }
  return cut;
}

// Orders the corners of a convex polygon by angle around its centre, counter-clockwise about n.
void sort_around(Polygon<3>& polygon, const Normal<3>& n) {
  Point<3> middle{};
  for (int k = 0; k < polygon.count; ++k)
    for (int d = 0; d < 3; ++d)
      middle[d] += polygon.points[k][d] / polygon.count;
  int thin = 0; // the axis least along n is farthest from degenerate
  for (int d = 1; d < 3; ++d)
    if (std::abs(n[d]) < std::abs(n[thin]))
      thin = d;
  Point<3> axis{};
  axis[thin] = 1.0;
  const double length = std::sqrt(dot<3>(n, n));
  const Point<3> u = cross(axis, n);
  const Point<3> v = cross(n, u);
  const auto angle = [&](const Point<3>& p) {
    const Point<3> r = {p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]};
    return std::atan2(dot<3>(r, v) / length, dot<3>(r, u));
  };
  // Insertion sort: at most 6 points.
  for (int k = 1; k < polygon.count; ++k)
    for (int at = k; at > 0 && angle(polygon.points[at]) < angle(polygon.points[at - 1]); --at)
      std::swap(polygon.points[at], polygon.points[at - 1]);
}

} // namespace

Point<2> map_to_cell(const Quad& cell, const Point<2>& reference) {
  const Point<2> low = between<2>(cell[0], cell[1], reference[0]);
  const Point<2> high = between<2>(cell[3], cell[2], reference[0]);
  return between<2>(low, high, reference[1]);
}

Point<3> map_to_cell(const Hexahedron& cell, const Point<3>& reference) {
  std::array<Point<3>, 4> edge;
  for (int k = 0; k < 4; ++k)
    edge[k] = between<3>(cell[2 * k], cell[2 * k + 1], reference[0]);
  const Point<3> low = between<3>(edge[0], edge[1], reference[1]);
  const Point<3> high = between<3>(edge[2], edge[3], reference[1]);
  return between<3>(low, high, reference[2]);
}

Polygon<2>
material_polygon(const Quad& cell, const Interface<2>* inner, const Interface<2>* outer) {
  Polygon<2> part = unit_square();
  if (inner)
    part = clipped(part, {-inner->n[0], -inner->n[1]}, -inner->alpha);
  if (outer)
    part = clipped(part, outer->n, outer->alpha);
  map_polygon(cell, part);
  return part;
}

Polygon<3> interface_facet(const Hexahedron& cell, const Interface<3>& interface) {
  Polygon<3> facet = edge_crossings(interface);
  if (facet.count < 3)
    return {};
  sort_around(facet, interface.n);
  map_polygon(cell, facet);
  return facet;
}

Polygon<2> interface_facet(const Quad& cell, const Interface<2>& interface) {
  const Polygon<2> square = unit_square();
  std::array<Point<2>, 2> ends{};
  int found = 0; // bit 0: the start, where the outline leaves the material; bit 1: the end
  for (int k = 0; k < 4; ++k) {
    const Point<2>& a = square.points[k];
    const Point<2>& b = square.points[(k + 1) % 4];
    const double above_a = dot<2>(interface.n, a) - interface.alpha;
    const double above_b = dot<2>(interface.n, b) - interface.alpha;
    if ((above_a > 0.0) == (above_b > 0.0))
      continue;
    const int end = above_a > 0.0 ? 1 : 0;
    ends[end] = between<2>(a, b, above_a / (above_a - above_b));
    found |= 1 << end;
  }
  if (found != 3)
    return {};
  Polygon<2> segment;
  for (const Point<2>& p : ends)
    segment.append(p);
  map_polygon(cell, segment);
  return segment;
}

double polygon_area(const Polygon<2>& polygon) {
  double twice = 0.0;
  for (int k = 0; k < polygon.count; ++k) {
    const Point<2>& a = polygon.points[k];
    const Point<2>& b = polygon.points[(k + 1) % polygon.count];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

double polygon_area(const Polygon<3>& polygon) {
  Point<3> twice{};
  for (int k = 1; k + 1 < polygon.count; ++k) {
    Point<3> a, b;
    for (int d = 0; d < 3; ++d) {
      a[d] = polygon.points[k][d] - polygon.points[0][d];
      b[d] = polygon.points[k + 1][d] - polygon.points[0][d];
    }
    const Point<3> normal = cross(a, b);
    for (int d = 0; d < 3; ++d)
      twice[d] += normal[d];
  }
  return 0.5 * std::sqrt(dot<3>(twice, twice));
}

} // namespace ballast::remap
