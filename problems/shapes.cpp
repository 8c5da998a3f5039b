// Distances, bounds and names of shapes.
#include "problems/closed_surface.hpp"
#include "problems/shape_geometry.hpp"
#include "problems/voxel_solid.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Position along the axis and distance from it.
std::array<double, 2> turned(const Revolved& r, const Point& p) {
  const Point d = p - r.origin;
  const double z = dot(d, r.axis);
  return {z, std::sqrt(std::max(0.0, dot(d, d) - z * z))};
}

double segment_distance(const std::array<double, 2>& p,
                        const std::array<double, 2>& a,
                        const std::array<double, 2>& b) {
  const double dz = b[0] - a[0], dr = b[1] - a[1];
  const double length2 = dz * dz + dr * dr;
  const double t =
      length2 > 0 ? std::clamp(((p[0] - a[0]) * dz + (p[1] - a[1]) * dr) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - t * dz, p[1] - a[1] - t * dr);
}

bool inside_outline(const Revolved& r, const std::array<double, 2>& p) {
  if (p[0] <= r.profile.front()[0] || p[0] >= r.profile.back()[0]) {
    return false;
  }
  const std::size_t i = segment_at(r, p[0]);
  const auto& a = r.profile[i];
  const auto& b = r.profile[i + 1];
  const double share = b[0] > a[0] ? (p[0] - a[0]) / (b[0] - a[0]) : 0.0;
  return p[1] < a[1] + share * (b[1] - a[1]);
}

// ---- signed distance ----

/// Position along the axes of a turned box, from its centre.
Point turned(const TurnedBox& box, const Point& p) {
  const Point d = p - box.centre;
  return {dot(d, box.axes[0]), dot(d, box.axes[1]), dot(d, box.axes[2])};
}

double distance_to(const Box& box, const Point& p) {
  double inside = -infinity, outside2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::max(box.from[k] - p[k], p[k] - box.to[k]);
    inside = std::max(inside, d);
    outside2 += d > 0 ? d * d : 0.0;
  }
  return inside > 0 ? std::sqrt(outside2) : inside;
}

double distance_to(const TurnedBox& box, const Point& p) {
  const Point& h = box.half;
  return distance_to(Box{{-h[0], -h[1], -h[2]}, h}, turned(box, p));
}

double distance_to(const Sphere& s, const Point& p) {
  const Point d = p - s.centre;
  return std::sqrt(dot(d, d)) - s.radius;
}

double distance_to(const Cylinder& c, const Point& p) {
  const Point a = axis_of(c), d = p - c.from, end = c.to - c.from;
  const double along = dot(d, a);
  const double radial = std::sqrt(std::max(0.0, dot(d, d) - along * along)) - c.radius;
  return std::max({radial, -along, along - dot(end, a)});
}

double distance_to(const Revolved& r, const Point& p) {
  const auto q = turned(r, p);
  const std::array<double, 2> base{r.profile.front()[0], 0.0}, tip{r.profile.back()[0], 0.0};
  double d = std::min(segment_distance(q, base, r.profile.front()),
                      segment_distance(q, tip, r.profile.back()));
  for (std::size_t i = 0; i + 1 < r.profile.size(); ++i) {
    d = std::min(d, segment_distance(q, r.profile[i], r.profile[i + 1]));
  }
  return inside_outline(r, q) ? -d : d;
}

double distance_to(const HalfSpace& h, const Point& p) {
  return dot(p - h.point, h.outward);
}

double distance_to(const Combination& c, const Point& p) {
  double d = signed_distance(c.parts.front(), p);
  for (std::size_t i = 1; i < c.parts.size(); ++i) {
    const double other = signed_distance(c.parts[i], p);
    switch (c.kind) {
    case Combination::Kind::unite:
      d = std::min(d, other);
      break;
    case Combination::Kind::intersect:
      d = std::max(d, other);
      break;
    case Combination::Kind::subtract:
      d = std::max(d, -other);
      break;
    }
  }
  return d;
}

// ---- inside or not ----

template <class Form> bool holds(const Form& form, const Point& p) {
  return distance_to(form, p) < 0;
}
bool holds(const Revolved& r, const Point& p) {
  return inside_outline(r, turned(r, p));
}
bool holds(const Combination& c, const Point& p) {
  const auto in = [&](const Shape& part) { return contains(part, p); };
  switch (c.kind) {
  case Combination::Kind::unite:
    return std::any_of(c.parts.begin(), c.parts.end(), in);
  case Combination::Kind::intersect:
    return std::all_of(c.parts.begin(), c.parts.end(), in);
  case Combination::Kind::subtract:
    break;
  }
  return in(c.parts.front()) && std::none_of(c.parts.begin() + 1, c.parts.end(), in);
}

// ---- bounds ----

Bounds bounds_of(const Box& box) {
  return {box.from, box.to};
}

Bounds bounds_of(const Sphere& s) {
  Bounds b{s.centre, s.centre};
  for (std::size_t k = 0; k < 3; ++k) {
    b.lo[k] -= s.radius;
    b.hi[k] += s.radius;
  }
  return b;
}

/// Round a segment from - to along `axis` with the given radius.
Bounds tube(const Point& from, const Point& to, const Point& axis, double radius) {
  Bounds b;
  for (std::size_t k = 0; k < 3; ++k) {
    const double reach = radius * std::sqrt(std::max(0.0, 1 - axis[k] * axis[k]));
    b.lo[k] = std::min(from[k], to[k]) - reach;
    b.hi[k] = std::max(from[k], to[k]) + reach;
  }
  return b;
}

Bounds bounds_of(const Revolved& r) {
  Point from = r.origin, to = r.origin;
  double radius = 0;
  for (const auto& point : r.profile) {
    radius = std::max(radius, point[1]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    from[k] += r.profile.front()[0] * r.axis[k];
    to[k] += r.profile.back()[0] * r.axis[k];
  }
  return tube(from, to, r.axis, radius);
}

Bounds bounds_of(const TurnedBox& box) {
  Bounds b{box.centre, box.centre};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double reach = box.axes[i][k] == 0 ? 0.0 : std::abs(box.axes[i][k]) * box.half[i];
      b.lo[k] -= reach;
      b.hi[k] += reach;
    }
  }
  return b;
}

Bounds bounds_of(const HalfSpace& h) {
  Bounds b;
  const int k = aligned_with(h.outward);
  if (k >= 0) {
    const auto i = static_cast<std::size_t>(k);
    (h.outward[i] > 0 ? b.hi : b.lo)[i] = h.point[i];
  }
  return b;
}

Bounds bounds_of(const Combination& c) {
  Bounds b = bounds(c.parts.front());
  if (c.kind == Combination::Kind::subtract) {
    return b;
  }
  const bool unite = c.kind == Combination::Kind::unite;
  for (std::size_t i = 1; i < c.parts.size(); ++i) {
    const Bounds other = bounds(c.parts[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      b.lo[k] = unite ? std::min(b.lo[k], other.lo[k]) : std::max(b.lo[k], other.lo[k]);
      b.hi[k] = unite ? std::max(b.hi[k], other.hi[k]) : std::min(b.hi[k], other.hi[k]);
    }
  }
  return b;
}

} // namespace

Bounds bounds_of(const Cylinder& c) {
  return tube(c.from, c.to, axis_of(c), c.radius);
}

Bounds bounds(const Shape& shape) {
  return std::visit([](const auto& form) -> Bounds { return bounds_of(form); }, shape.form);
}

bool contains(const Shape& shape, const Point& p) {
  return std::visit([&](const auto& form) { return holds(form, p); }, shape.form);
}

double signed_distance(const Shape& shape, const Point& p) {
  return std::visit([&](const auto& form) { return distance_to(form, p); }, shape.form);
}

namespace {
std::string describe_one(const Box&) {
  return "box";
}
std::string describe_one(const Sphere& s) {
  return fmt::format("sphere, radius {:g} m", s.radius);
}
std::string describe_one(const Cylinder& c) {
  return fmt::format("cylinder, radius {:g} m", c.radius);
}
std::string describe_one(const Revolved& r) {
  return fmt::format("revolved profile of {} points", r.profile.size());
}
std::string describe_one(const HalfSpace&) {
  return "half space";
}
std::string describe_one(const TurnedBox&) {
  return "box, turned";
}
std::string describe_one(const Surface& s) {
  const FacetMesh& mesh = s.whole->mesh();
  return fmt::format("surface of {} facets, {:g} m3", mesh.facets.size(), enclosed_volume(mesh));
}
std::string describe_one(const Voxels& v) {
  return fmt::format("{} voxels, {:g} m3", v.solid->count(), v.solid->volume());
}
std::string describe_one(const Combination& c) {
  const char* names[] = {"union", "intersection", "difference"};
  return fmt::format("{} of {} shapes", names[static_cast<int>(c.kind)], c.parts.size());
}
} // namespace

std::string describe(const Shape& shape) {
  return std::visit([](const auto& form) { return describe_one(form); }, shape.form);
}

} // namespace ballast
