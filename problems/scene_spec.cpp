#include "problems/scene_spec.hpp"

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
  visible_fractions(shapes, scene.geometry, lo, hi, shares);
}

} // namespace ballast
