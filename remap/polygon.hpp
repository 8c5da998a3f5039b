#pragma once
// Reconstructed materials as polygons, for pictures: the unit square or cube is clipped by its
// planes and the corners are mapped to the physical cell.
//
//   Only corners are mapped (bilinear or trilinear), edges are drawn straight: exact for
//   parallelograms, else curved by the cell's own distortion.

#include "remap/onion.hpp"

namespace ballast::remap {

template <int Dim> using Point = std::array<double, Dim>;

// A convex polygon, corners in order; counter-clockwise in 2D. A square cut twice has 6 corners at
// most, a plane cuts a cube in 6; one spare each for a corner met twice in round-off.
template <int Dim> struct Polygon {
  static constexpr int capacity = 8;
  std::array<Point<Dim>, capacity> points{};
  int count = 0;

  void append(const Point<Dim>& p) {
    if (count < capacity)
      points[count++] = p;
  }
};

// Corners of the physical cell: a quad counter-clockwise from (0, 0), a hexahedron at i + 2j + 4k.
using Quad = std::array<Point<2>, 4>;
using Hexahedron = std::array<Point<3>, 8>;

Point<2> map_to_cell(const Quad& cell, const Point<2>& reference);
Point<3> map_to_cell(const Hexahedron& cell, const Point<3>& reference);

// The part of a cell between two interfaces: outside inner (nullptr: from the start) and inside
// outer (nullptr: to the end). Material k of onion_interfaces has inner k - 1 and outer k. Empty:
// count 0.
Polygon<2> material_polygon(const Quad& cell, const Interface<2>* inner, const Interface<2>* outer);

// The facet of an interface in the cell, counter-clockwise seen from the tip of n in the unit cube.
// count 0 where the plane misses the cell or only touches it.
Polygon<3> interface_facet(const Hexahedron& cell, const Interface<3>& interface);

// The same in 2D: a segment of 2 points, the material on its left.
Polygon<2> interface_facet(const Quad& cell, const Interface<2>& interface);

double polygon_area(const Polygon<2>& polygon); // signed, positive counter-clockwise
double polygon_area(const Polygon<3>& polygon);

} // namespace ballast::remap
