// Closed surfaces among the shapes: distance, inside, cuts of lines, and what a cell sees of them.
#include "problems/closed_surface.hpp"
#include "problems/shape_cuts.hpp"
#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {
namespace {

/// Where the line meets the plane of a facet, if that is in the facet or within rounding of it.
void cut_facet(const Facet& f, const Line& line, Cuts& cuts) {
  const std::size_t k = line.k, i = (k + 1) % 3, j = (k + 2) % 3;
  std::array<double, 3> w{};
  double whole = 0, size2 = 0;
  for (std::size_t q = 0; q < 3; ++q) {
    const Point& a = f[(q + 1) % 3];
    const Point& b = f[(q + 2) % 3];
    w[q] = (a[i] - line.p[i]) * (b[j] - line.p[j]) - (a[j] - line.p[j]) * (b[i] - line.p[i]);
    whole += w[q];
    size2 = std::max({size2, (a[i] - b[i]) * (a[i] - b[i]), (a[j] - b[j]) * (a[j] - b[j])});
  }
  const double slack = 1e-9 * size2;
  const bool positive = std::all_of(w.begin(), w.end(), [&](double x) { return x >= -slack; });
  const bool negative = std::all_of(w.begin(), w.end(), [&](double x) { return x <= slack; });
  if (std::abs(whole) > 1e-12 * size2 && (positive || negative)) {
    cuts.add((w[0] * f[0][k] + w[1] * f[1][k] + w[2] * f[2][k]) / whole);
  }
}

/// Facets that a query about the box of a line or of everything has to look at.
std::vector<Facet> facets_along(const Surface& s, const Line& line) {
  Point lo = line.p, hi = line.p;
  lo[line.k] = line.lo;
  hi[line.k] = line.hi;
  std::vector<Facet> out;
  s.whole->facets_in(lo, hi, out);
  return out;
}

} // namespace

double distance_to(const Surface& s, const Point& p) {
  double d = std::numeric_limits<double>::infinity();
  if (s.piece) {
    for (const Facet& f : s.piece->facets) {
      d = std::min(d, facet_distance(p, f));
    }
  }
  d = std::isfinite(d) ? d : s.whole->distance(p);
  return holds(s, p) ? -d : d;
}

bool holds(const Surface& s, const Point& p) {
  return s.piece ? s.piece->contains(p, *s.whole) : s.whole->contains(p);
}

const Bounds& bounds_of(const Surface& s) {
  return s.whole->box();
}

void cut(const Surface& s, const Line& line, Cuts& cuts) {
  if (s.piece) {
    for (const Facet& f : s.piece->facets) {
      cut_facet(f, line, cuts);
    }
    return;
  }
  for (const Facet& f : facets_along(s, line)) {
    cut_facet(f, line, cuts);
  }
}

/// Facets square to axis j, of the piece only: a whole surface may have any number of them.
void jumps(const Surface& s, std::size_t j, std::vector<double>& out) {
  constexpr std::size_t many = 8; // in one cell: leave stairs finer than that to the lines
  std::vector<double> planes;
  for (std::size_t q = 0; s.piece && q < s.piece->facets.size(); ++q) {
    const Facet& f = s.piece->facets[q];
    const auto [lo, hi] = std::minmax({f[0][j], f[1][j], f[2][j]});
    const Bounds b = bounds_of(f);
    const double size = std::max({b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], b.hi[2] - b.lo[2]});
    if (hi - lo <= 1e-9 * size && std::find(planes.begin(), planes.end(), lo) == planes.end()) {
      planes.push_back(lo);
    }
  }
  if (planes.size() <= many) {
    out.insert(out.end(), planes.begin(), planes.end());
  }
}

bool has_surface(const Shape& shape) {
  if (const auto* c = std::get_if<Combination>(&shape.form)) {
    return std::any_of(c->parts.begin(), c->parts.end(), has_surface);
  }
  return std::holds_alternative<Surface>(shape.form);
}

Shape seen_from(const Shape& shape, const Point& lo, const Point& hi) {
  Shape out = shape;
  if (auto* s = std::get_if<Surface>(&out.form)) {
    s->piece = std::make_shared<const SurfacePiece>(*s->whole, lo, hi);
  } else if (auto* c = std::get_if<Combination>(&out.form)) {
    for (Shape& part : c->parts) {
      part = seen_from(part, lo, hi);
    }
  }
  return out;
}

bool enters(const Surface& s, const Point& lo, const Point& hi) {
  return s.whole->enters(lo, hi);
}

} // namespace ballast
