#include "problems/closed_surface.hpp"

#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ballast {
namespace {

Bounds box_of(const FacetMesh& mesh) {
  Bounds b{mesh.vertices.front(), mesh.vertices.front()};
  for (const Point& p : mesh.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      b.lo[k] = std::min(b.lo[k], p[k]);
      b.hi[k] = std::max(b.hi[k], p[k]);
    }
  }
  return b;
}

/// How often the surface winds around p: 1 inside, 0 outside.
double winding_number(const FacetMesh& mesh, const Point& p) {
  double angle = 0;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const Facet f = mesh.corners(i);
    const Point a = f[0] - p, b = f[1] - p, c = f[2] - p;
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

/// Directions along no edge a drawing is likely to have.
constexpr std::array<Point, 4> directions = {{{0.8017, 0.4271, 0.4183},
                                              {-0.3119, 0.8513, 0.4219},
                                              {0.2713, -0.4937, 0.8263},
                                              {-0.6421, -0.3547, -0.6797}}};

} // namespace

ClosedSurface::ClosedSurface(FacetMesh mesh) : mesh_(std::move(mesh)), box_(box_of(mesh_)), tree_(mesh_) {}

bool ClosedSurface::contains(const Point& p) const {
  for (std::size_t k = 0; k < 3; ++k) {
    if (p[k] <= box_.lo[k] || p[k] >= box_.hi[k]) {
      return false;
    }
  }
  for (const Point& d : directions) {
    const int crossed = tree_.crossings(p, d);
    if (crossed >= 0) {
      return crossed % 2 == 1;
    }
  }
  return winding_number(mesh_, p) > 0.5;
}

bool ClosedSurface::enters(const Point& lo, const Point& hi) const {
  Point a = lo, b = hi;
  for (std::size_t k = 0; k < 3; ++k) {
    const double skin = 1e-9 * (hi[k] - lo[k]);
    a[k] += skin;
    b[k] -= skin;
  }
  return tree_.touches(a, b);
}

void ClosedSurface::facets_in(const Point& lo, const Point& hi, std::vector<Facet>& out) const {
  std::vector<int> found;
  tree_.collect(lo, hi, found);
  for (const int i : found) {
    out.push_back(mesh_.corners(static_cast<std::size_t>(i)));
  }
}

SurfacePiece::SurfacePiece(const ClosedSurface& surface, const Point& lo, const Point& hi) {
  Point a = lo, b = hi;
  for (std::size_t k = 0; k < 3; ++k) {
    const double skin = 1e-6 * (hi[k] - lo[k]); // points on the rim of the box belong to it
    a[k] -= skin;
    b[k] += skin;
  }
  surface.facets_in(a, b, facets);
  constexpr std::array<Point, 2> share = {{{0.5213, 0.4719, 0.5371}, {0.2837, 0.7139, 0.3643}}};
  for (std::size_t q = 0; q < known.size(); ++q) {
    for (std::size_t k = 0; k < 3; ++k) {
      known[q][k] = lo[k] + share[q][k] * (hi[k] - lo[k]);
    }
    inside[q] = surface.contains(known[q]);
  }
}

bool SurfacePiece::contains(const Point& p, const ClosedSurface& whole) const {
  for (std::size_t q = 0; q < known.size(); ++q) {
    const Point d = p - known[q];
    bool in = inside[q], decided = true;
    for (const Facet& f : facets) {
      const Crossing c = crossing(known[q], d, 1.0, f);
      decided = decided && c != Crossing::tie;
      in = in != (c == Crossing::through);
    }
    if (decided) {
      return in;
    }
  }
  return whole.contains(p);
}

} // namespace ballast
