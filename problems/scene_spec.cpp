#include "problems/scene_spec.hpp"

#include "problems/mapped_fractions.hpp"
#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

const std::vector<std::string>& gauge_quantities() {
  static const std::vector<std::string> names = {"pressure",
                                                 "velocity",
                                                 "acceleration",
                                                 "density",
                                                 "specific_energy",
                                                 "position",
                                                 "plastic_strain",
                                                 "damage",
                                                 "deviatoric_stress"};
  return names;
}

const std::vector<std::string>& field_quantities() {
  static const std::vector<std::string> names = {"material",
                                                 "volume_fraction",
                                                 "density",
                                                 "pressure",
                                                 "velocity",
                                                 "speed",
                                                 "specific_energy",
                                                 "sound_speed",
                                                 "plastic_strain",
                                                 "damage",
                                                 "deviatoric_stress",
                                                 "viscosity"};
  return names;
}

bool sides_go_along(const Motion& motion) {
  return motion.policy == MotionPolicy::lagrangian || (motion.policy == MotionPolicy::relax && !motion.fixed_boundary);
}

std::string name_of(Geometry geometry) {
  switch (geometry) {
  case Geometry::planar:
    return "planar";
  case Geometry::axisymmetric:
    return "axisymmetric";
  case Geometry::three_d:
    break;
  }
  return "3d";
}

std::vector<std::string> axis_names(Geometry geometry) {
  if (geometry == Geometry::axisymmetric) {
    return {"r", "z"};
  }
  return geometry == Geometry::planar ? std::vector<std::string>{"x", "y"}
                                      : std::vector<std::string>{"x", "y", "z"};
}

std::vector<std::string> mesh_axis_names(const SceneSpec& scene) {
  switch (scene.map.kind) {
  case MapKind::rectilinear:
    break;
  case MapKind::polar:
    return {"radius", "angle"};
  case MapKind::cylindrical:
    return {"radius", "angle", "z"};
  case MapKind::spherical:
    return {"angle", "radius"};
  case MapKind::disc:
  case MapKind::ball_section:
    return {"u", "v"};
  case MapKind::rod:
  case MapKind::turned:
    return {"u", "v", "z"};
  case MapKind::turned_section:
    return {"u", "z"};
  case MapKind::ball:
    return {"u", "v", "w"};
  }
  return axis_names(scene.geometry);
}

Dimension mesh_axis_dimension(const MeshMap& map, int axis) {
  switch (map.kind) {
  case MapKind::rectilinear:
    break;
  case MapKind::polar:
  case MapKind::cylindrical:
    return axis == 1 ? Dimension::angle : Dimension::length;
  case MapKind::spherical:
    return axis == 0 ? Dimension::angle : Dimension::length;
  case MapKind::disc:
  case MapKind::ball_section:
  case MapKind::ball:
    return Dimension::none;
  case MapKind::rod:
  case MapKind::turned:
    return axis == 2 ? Dimension::length : Dimension::none;
  case MapKind::turned_section:
    return axis == 1 ? Dimension::length : Dimension::none;
  }
  return Dimension::length;
}

Bounds mesh_bounds(const SceneSpec& scene) {
  Bounds box;
  const auto& lines = scene.mesh_lines;
  const auto dim = static_cast<std::size_t>(dimensions(scene.geometry));
  const bool sized = mesh_axis_dimension(scene.map, 0) != Dimension::none || scene.map.outer_radius > 0 || !scene.map.outline.empty();
  for (std::size_t d = 0; d < dim; ++d) {
    if (lines[d].empty() || !sized) {
      return {};
    }
    box.lo[d] = scene.map.curved() ? box.hi[d] : lines[d].front();
    box.hi[d] = scene.map.curved() ? -box.lo[d] : lines[d].back();
  }
  constexpr int n = 36; // parts of an axis; right angles of quarters, halves and three quarters are among their ends
  const auto at = [&](std::size_t d, int q) { return d < dim ? lines[d].front() + (lines[d].back() - lines[d].front()) * q / n : 0.0; };
  for (int k = 0; scene.map.curved() && k <= (dim == 3 ? n : 0); ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const Point p = place(scene.map, {at(0, i), at(1, j), at(2, k)});
        for (std::size_t d = 0; d < dim; ++d) {
          box.lo[d] = std::min(box.lo[d], p[d]);
          box.hi[d] = std::max(box.hi[d], p[d]);
        }
      }
    }
  }
  return box;
}

Point RadialVelocity::operator()(const Point& x) const {
  Point d = x - centre;
  if (along >= 0) {
    d[static_cast<std::size_t>(along)] = 0;
  }
  const double distance = std::sqrt(dot(d, d));
  if (!(distance > 0)) {
    return {};
  }
  const double u = speed * (power == 0 ? 1.0 : std::pow(at / distance, power)) / distance;
  return {u * d[0], u * d[1], u * d[2]};
}

Point Body::velocity_at(const Point& x) const {
  Point u = velocity;
  if (radial) {
    const Point v = (*radial)(x);
    u = {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
  }
  return u;
}

std::size_t cell_count(const SceneSpec& scene) {
  std::size_t cells = 1;
  for (int axis = 0; axis < dimensions(scene.geometry); ++axis) {
    const std::size_t nodes = scene.mesh_lines[static_cast<std::size_t>(axis)].size();
    cells *= nodes > 0 ? nodes - 1 : 0;
  }
  return cells;
}

void body_fractions(const SceneSpec& scene,
                    const Point& lo,
                    const Point& hi,
                    std::span<double> shares) {
  std::vector<const Shape*> shapes;
  shapes.reserve(scene.bodies.size());
  for (const Body& body : scene.bodies) {
    shapes.push_back(&body.shape);
  }
  if (scene.map.curved()) {
    mapped_fractions(shapes, scene.map, scene.geometry, lo, hi, shares);
  } else {
    visible_fractions(shapes, scene.geometry, lo, hi, shares);
  }
}

} // namespace ballast
