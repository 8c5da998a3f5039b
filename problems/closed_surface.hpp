// A solid bounded by flat triangles (from an STL file), and the piece of one that a cell sees.
//
// Inside or not: a point is inside if a ray from it crosses the surface an odd number of times. A
// ray that passes within rounding of a facet's rim decides nothing: another direction is taken, and
// should all of them fail, the winding number (van Oosterom, Strackee 1983)
//   w = 1/(4 pi) sum over facets of their solid angle
// does. Inside a cell only the facets there count: the way from a point whose side is known to the
// asked one stays in the cell, which is convex.
#pragma once

#include "problems/facet_tree.hpp"

#include <memory>

namespace ballast {

class ClosedSurface {
public:
  /// `mesh` has passed surface_flaw().
  explicit ClosedSurface(FacetMesh mesh);
  ClosedSurface(const ClosedSurface&) = delete;
  ClosedSurface& operator=(const ClosedSurface&) = delete;

  const FacetMesh& mesh() const { return mesh_; }
  const Bounds& box() const { return box_; }
  bool contains(const Point& p) const;
  /// To the nearest facet, never negative (m).
  double distance(const Point& p) const { return tree_.distance(p); }
  /// Does the surface come into the box lo..hi? Touching from outside, within rounding, is not in.
  bool enters(const Point& lo, const Point& hi) const;
  void facets_in(const Point& lo, const Point& hi, std::vector<Facet>& out) const;

private:
  FacetMesh mesh_;
  Bounds box_;
  FacetTree tree_;
};

/// What a box sees of a surface: its facets there, and on which side two of its points lie.
struct SurfacePiece {
  std::vector<Facet> facets;
  std::array<Point, 2> known{};
  std::array<bool, 2> inside{};

  SurfacePiece(const ClosedSurface& surface, const Point& lo, const Point& hi);
  /// For points of that box; `whole` is asked where the way there passes a rim.
  bool contains(const Point& p, const ClosedSurface& whole) const;
};

} // namespace ballast
