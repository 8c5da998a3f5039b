#include "problems/shape_placement.hpp"

#include "core/error.hpp"
#include "problems/closed_surface.hpp"
#include "problems/shape_geometry.hpp"
#include "problems/voxel_solid.hpp"

#include <cmath>

namespace ballast {
namespace {

/// cos and sin of right angles without their rounding.
double clean(double x) {
  return std::abs(x) < 1e-15 ? 0.0 : std::abs(std::abs(x) - 1) < 1e-15 ? std::copysign(1.0, x) : x;
}

Rotation product(const Rotation& a, const Rotation& b) {
  Rotation out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out[i][j] = clean(a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]);
    }
  }
  return out;
}

bool is_identity(const Rotation& r) {
  return r == Placement{}.turn;
}

/// Only right angles: every row along an axis.
bool keeps_axes(const Rotation& r) {
  return aligned_with(r[0]) >= 0 && aligned_with(r[1]) >= 0 && aligned_with(r[2]) >= 0;
}

/// The middle of a box; 0 along axes it fills.
Point middle(const Box& box) {
  Point m{};
  for (std::size_t k = 0; k < 3; ++k) {
    m[k] = std::isfinite(box.to[k] - box.from[k]) ? 0.5 * (box.from[k] + box.to[k]) : 0.0;
  }
  return m;
}

Shape place(const Placement& at, const Box& box) {
  if (keeps_axes(at.turn)) {
    const Point a = placed(at, box.from), b = placed(at, box.to);
    Box out = box;
    for (std::size_t k = 0; k < 3; ++k) {
      out.from[k] = std::min(a[k], b[k]);
      out.to[k] = std::max(a[k], b[k]);
    }
    return Shape{out};
  }
  TurnedBox out{placed(at, middle(box)), {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    Point axis{};
    axis[i] = 1;
    out.axes[i] = turned(at.turn, axis);
    out.half[i] = 0.5 * (box.to[i] - box.from[i]);
  }
  return Shape{out};
}

Shape place(const Placement& at, TurnedBox box) {
  box.centre = placed(at, box.centre);
  for (Point& axis : box.axes) {
    axis = turned(at.turn, axis);
  }
  return Shape{box};
}

Shape place(const Placement& at, const Sphere& s) {
  return Shape{Sphere{placed(at, s.centre), s.radius}};
}

Shape place(const Placement& at, const Cylinder& c) {
  return Shape{Cylinder{placed(at, c.from), placed(at, c.to), c.radius}};
}

Shape place(const Placement& at, Revolved r) {
  r.origin = placed(at, r.origin);
  r.axis = turned(at.turn, r.axis);
  return Shape{std::move(r)};
}

Shape place(const Placement& at, const HalfSpace& h) {
  return Shape{HalfSpace{placed(at, h.point), turned(at.turn, h.outward)}};
}

Shape place(const Placement& at, const Surface& s) {
  FacetMesh mesh = s.whole->mesh();
  for (Point& p : mesh.vertices) {
    p = placed(at, p);
  }
  return Shape{Surface{std::make_shared<const ClosedSurface>(std::move(mesh)), nullptr}};
}

Shape place(const Placement& at, const Voxels& v) {
  if (!keeps_axes(at.turn)) {
    throw Error("voxels turn by right angles only");
  }
  const Point corner = placed(at, v.solid->corner());
  return Shape{Voxels{std::make_shared<const VoxelSolid>(is_identity(at.turn) ? v.solid->moved(corner) : v.solid->turned(at.turn, corner))}};
}

Shape place(const Placement& at, Combination c) {
  for (Shape& part : c.parts) {
    part = placed(at, part);
  }
  return Shape{std::move(c)};
}

} // namespace

Rotation rotation_about(const Point& axis, double angle) {
  const double length = std::sqrt(dot(axis, axis));
  const Point e{axis[0] / length, axis[1] / length, axis[2] / length};
  const double c = clean(std::cos(angle)), s = clean(std::sin(angle));
  Rotation r{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      r[i][j] = (i == j ? c : 0.0) + (1 - c) * e[i] * e[j];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    r[j][i] += s * e[k];
    r[i][j] -= s * e[k];
  }
  for (Point& row : r) {
    for (double& x : row) {
      x = clean(x);
    }
  }
  return r;
}

Rotation rotation_xyz(const Point& angles) {
  Rotation r = Placement{}.turn;
  for (std::size_t k = 0; k < 3; ++k) {
    Point axis{};
    axis[k] = 1;
    r = product(rotation_about(axis, angles[k]), r);
  }
  return r;
}

Point turned(const Rotation& turn, const Point& d) {
  Point out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out[i] += turn[i][j] == 0 ? 0.0 : turn[i][j] * d[j]; // 0 of an infinite extent is 0
    }
  }
  return out;
}

Point placed(const Placement& at, const Point& p) {
  if (is_identity(at.turn)) {
    return p + at.offset; // no rounding about the pivot
  }
  return at.about + turned(at.turn, p - at.about) + at.offset;
}

bool can_turn(const Rotation& turn, const Shape& shape) {
  return keeps_axes(turn) || !has_voxels(shape);
}

Shape placed(const Placement& at, const Shape& shape) {
  return std::visit([&](const auto& form) { return place(at, form); }, shape.form);
}

} // namespace ballast
