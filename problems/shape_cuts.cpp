#include "problems/shape_cuts.hpp"

#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {
namespace {

void cut(const Box& box, const Line& line, Cuts& cuts) {
  cuts.add(box.from[line.k]);
  cuts.add(box.to[line.k]);
}

void cut(const Sphere& s, const Line& line, Cuts& cuts) {
  Point d = line.p - s.centre;
  d[line.k] = 0;
  const double c = s.centre[line.k], half2 = s.radius * s.radius - dot(d, d);
  if (half2 > 0) {
    cuts.add(c - std::sqrt(half2));
    cuts.add(c + std::sqrt(half2));
  }
}

/// The line relative to a solid of revolution: along(t) = z0 + za t, rho^2(t) = |d + t e|^2 -
/// along^2.
struct Relative {
  double z0, za, d2, dk;
  Relative(const Line& line, const Point& origin, const Point& axis) {
    Point d = line.p - origin;
    d[line.k] = -origin[line.k]; // so that t is the coordinate itself
    z0 = dot(d, axis);
    za = axis[line.k];
    d2 = dot(d, d);
    dk = d[line.k];
  }
  /// t where rho = r0 + slope (along - z_ref).
  void cone(double r0, double slope, double z_ref, Cuts& cuts) const {
    const double m2 = 1 + slope * slope, base = r0 + slope * (z0 - z_ref);
    cuts.add_roots(1 - m2 * za * za, dk - z0 * za - slope * za * base, d2 - z0 * z0 - base * base);
  }
  void plane(double z, Cuts& cuts) const {
    if (za != 0) {
      cuts.add((z - z0) / za);
    }
  }
};

void cut(const Cylinder& c, const Line& line, Cuts& cuts) {
  const Point a = axis_of(c), end = c.to - c.from;
  const Relative relative(line, c.from, a);
  relative.cone(c.radius, 0, 0, cuts);
  relative.plane(0, cuts);
  relative.plane(dot(end, a), cuts);
}

void cut(const Revolved& r, const Line& line, Cuts& cuts) {
  const Relative relative(line, r.origin, r.axis);
  const double at_lo = relative.z0 + relative.za * line.lo,
               at_hi = relative.z0 + relative.za * line.hi;
  const double z_lo = std::min(at_lo, at_hi), z_hi = std::max(at_lo, at_hi);
  relative.plane(r.profile.front()[0], cuts);
  relative.plane(r.profile.back()[0], cuts);
  for (std::size_t i = segment_at(r, z_lo); i + 1 < r.profile.size(); ++i) {
    const auto& a = r.profile[i];
    const auto& b = r.profile[i + 1];
    if (a[0] > z_hi) {
      break;
    }
    if (b[0] > a[0]) {
      relative.cone(a[1], (b[1] - a[1]) / (b[0] - a[0]), a[0], cuts);
    }
    relative.plane(a[0], cuts);
  }
}

void cut(const HalfSpace& h, const Line& line, Cuts& cuts) {
  Point d = line.p - h.point;
  d[line.k] = -h.point[line.k];
  if (h.outward[line.k] != 0) {
    cuts.add(-dot(d, h.outward) / h.outward[line.k]);
  }
}

void cut(const TurnedBox& box, const Line& line, Cuts& cuts) {
  Point d = line.p - box.centre;
  d[line.k] = -box.centre[line.k];
  for (std::size_t i = 0; i < 3; ++i) {
    const double slope = box.axes[i][line.k], at = dot(d, box.axes[i]);
    if (slope != 0 && std::isfinite(box.half[i])) {
      cuts.add((-box.half[i] - at) / slope);
      cuts.add((box.half[i] - at) / slope);
    }
  }
}

void cut(const Combination& c, const Line& line, Cuts& cuts) {
  for (const Shape& part : c.parts) {
    cut(part, line, cuts);
  }
}
void jumps(const Box& box, std::size_t j, bool, std::vector<double>& out) {
  out.insert(out.end(), {box.from[j], box.to[j]});
}
void jumps(const Sphere& s, std::size_t j, bool flat, std::vector<double>& out) {
  if (flat) {
    out.insert(out.end(), {s.centre[j] - s.radius, s.centre[j] + s.radius});
  }
}
void jumps(const Cylinder& c, std::size_t j, bool flat, std::vector<double>& out) {
  const int k = aligned_with(axis_of(c));
  if (k == static_cast<int>(j) || (k >= 0 && flat)) {
    const Bounds b = bounds_of(c);
    out.insert(out.end(), {b.lo[j], b.hi[j]});
  }
}
void jumps(const Revolved& r, std::size_t j, bool flat, std::vector<double>& out) {
  const int k = aligned_with(r.axis);
  if (k < 0) {
    return;
  }
  for (const auto& point : r.profile) {
    if (static_cast<std::size_t>(k) == j) {
      out.push_back(r.origin[j] + r.axis[j] * point[0]);
    } else if (flat) {
      out.insert(out.end(), {r.origin[j] - point[1], r.origin[j] + point[1]});
    }
  }
}
void jumps(const HalfSpace& h, std::size_t j, bool, std::vector<double>& out) {
  if (aligned_with(h.outward) == static_cast<int>(j)) {
    out.push_back(h.point[j]);
  }
}
void jumps(const TurnedBox& box, std::size_t j, bool, std::vector<double>& out) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (aligned_with(box.axes[i]) == static_cast<int>(j)) {
      out.insert(out.end(), {box.centre[j] - box.half[i], box.centre[j] + box.half[i]});
    }
  }
}
void jumps(const Surface& s, std::size_t j, bool, std::vector<double>& out) {
  ballast::jumps(s, j, out);
}
/// None: an image has any number of planes, a cell few (problems/shape_fractions asks for those).
void jumps(const Voxels&, std::size_t, bool, std::vector<double>&) {}
void jumps(const Combination& c, std::size_t j, bool flat, std::vector<double>& out) {
  for (const Shape& part : c.parts) {
    jumps(part, j, flat, out);
  }
}

} // namespace

void cut(const Shape& shape, const Line& line, Cuts& cuts) {
  std::visit([&](const auto& form) { cut(form, line, cuts); }, shape.form);
}

void jumps(const Shape& shape, std::size_t j, bool flat, std::vector<double>& out) {
  std::visit([&](const auto& form) { jumps(form, j, flat, out); }, shape.form);
}

} // namespace ballast
