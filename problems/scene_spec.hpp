// SceneSpec: everything a run needs, resolved and validated, in SI. problems/scene_reader makes it
// from a deck; verification runs make it by hand. Nothing here refers to the deck any more.
#pragma once

#include "ale/scene.hpp"
#include "core/mesh_map.hpp"
#include "core/units.hpp"
#include "materials/material.hpp"
#include "problems/injury_spec.hpp"
#include "problems/layers_spec.hpp"
#include "problems/shapes.hpp"

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ballast {

/// One side of the mesh. Symmetry at r = 0 is the axis.
struct Boundary {
  BoundaryKind kind = BoundaryKind::free;
  double wall_velocity = 0;   ///< wall: velocity along the axis it closes, m/s
  int material = -1;          ///< inflow: index into SceneSpec::materials
  Point velocity{};           ///< inflow, m/s
  double density = 0;         ///< inflow, kg/m3
  double pressure = 0;        ///< inflow, Pa
  double specific_energy = 0; ///< inflow, J/kg, from density and pressure
};

/// Velocity along the outward radius from a point, or from an axis through it: speed (at / R)^power. A power of one less than
/// the dimensions the radius spans (1 around an axis, 2 around a point in space) keeps every volume: div u = 0.
struct RadialVelocity {
  double speed = 0; ///< m/s outward, at the distance `at` (m)
  double at = 0;
  double power = 0;
  Point centre{};
  int along = -1; ///< coordinate of the axis that the radius is taken from (mesh axes), -1: from the point itself

  Point operator()(const Point& x) const; ///< zero at the centre
};

/// A piece of the initial state. Later bodies replace earlier ones where they overlap.
struct Body {
  std::string name;
  int material = -1; ///< index into SceneSpec::materials, -1: void (a hole)
  Shape shape;
  Point velocity{};           ///< m/s
  double density = 0;         ///< kg/m3, the material's unless the deck says otherwise
  double pressure = 0;        ///< Pa, ambient unless the deck says otherwise
  double specific_energy = 0; ///< J/kg, from density and pressure unless the deck gives it
  std::optional<RadialVelocity> radial = {}; ///< beside `velocity`
  Point aim = {};             ///< the normal an oblique bullet is shot along; 0: its velocity

  bool moves() const { return velocity != Point{} || (radial && radial->speed != 0); }
  Point velocity_at(const Point& x) const;
};

enum class Switch { automatic, on, off };
/// A point that records. `rides`: moves with the material, else fixed in space.
struct Gauge {
  std::string name;
  Point at{};
  bool rides = false;
  std::vector<std::string> record; ///< of gauge_quantities()
};
using NamedProbe = Gauge;

struct Output {
  double fields_every = std::numeric_limits<double>::infinity();     ///< s; start and end always
  std::vector<std::string> fields;                                   ///< of field_quantities()
  double history_every = 0;                                          ///< s, 0: every step
  double checkpoint_every = std::numeric_limits<double>::infinity(); ///< s of wall clock
};

/// What summary.json reports beyond the ledger. Indices into bodies and materials; empty, -1:
/// nothing.
struct Results {
  std::vector<int> bullet; ///< bodies that together are the bullet: speed, mass, extents, depth
  std::vector<std::string> bullet_names;
  int target = -1; ///< material whose cavity and energy gain are reported
  double target_face =
      std::numeric_limits<double>::quiet_NaN(); ///< depth counts from here along the shot
  int shot_axis = 1;                            ///< mesh axis the bullet flies along
  double shot_direction = 1;                    ///< +1 or -1 on that axis
};

struct SceneSpec {
  std::string title;
  Geometry geometry = Geometry::planar;
  /// Logical coordinates of the nodes along each axis, ascending; third empty in 2D. On a rectilinear mesh they are places (m).
  std::array<std::vector<double>, 3> mesh_lines;
  MeshMap map; ///< what they are on another
  std::array<std::array<Boundary, 2>, 3> boundaries; ///< [axis][0 low side, 1 high side]
  double end_time = 0;                               ///< s
  double ambient_pressure = 101325;                  ///< Pa; also p_ref of the gauge pressures
  double ambient_temperature = 293;                  ///< K
  /// Those in use only, deck overrides applied, specific_energy set from the ambient pressure.
  std::vector<Material> materials;
  std::vector<Body> bodies;
  int background = -1; ///< material where no body is, -1: void
  Motion motion;
  Numerics numerics; ///< its energy_return as the next line resolves it
  /// Kinetic energy lost in the remap goes back to heat. automatic: on without strength, off with it.
  Switch energy_return = Switch::automatic;
  /// Onion-skin order: indices into `materials`, first peeled first; void is last.
  std::vector<int> interface_order;
  /// Indices into `materials`: what keeps its own velocity along interfaces with the rest.
  std::vector<int> sliding;
  std::vector<Gauge> gauges;
  Output output;
  Results results;
  std::vector<LayersSpec> layers;
  std::optional<InjurySpec> injury; ///< nothing: not measured
};

/// Names a deck may list under gauge.record and output.fields.
const std::vector<std::string>& gauge_quantities();
const std::vector<std::string>& field_quantities();

/// Do the sides of a mesh with this motion go with the matter there?
bool sides_go_along(const Motion& motion);
/// Do layers lie in a mesh that moves so, as bodies inside it, instead of touching its sides?
inline bool embeds_layers(const Motion& motion) { return !sides_go_along(motion); }
/// "planar", "axisymmetric", "3d".
std::string name_of(Geometry geometry);
/// Names of the mesh axes, "r", "z" or "x", "y", "z".
std::vector<std::string> axis_names(Geometry geometry);
/// Cells of the mesh, all axes multiplied.
std::size_t cell_count(const SceneSpec& scene);
/// Smallest box that holds the mesh (m); all of space where the mesh is not known (its lines have errors).
Bounds mesh_bounds(const SceneSpec& scene);
/// Names of the mesh's own axes: axis_names, or "radius", "angle" ... of a map.
std::vector<std::string> mesh_axis_names(const SceneSpec& scene);
/// What the mesh's coordinates along an axis are.
Dimension mesh_axis_dimension(const MeshMap& map, int axis);
/// Shares of the cell lo..hi (logical coordinates) that each body shows, later bodies replacing earlier ones.
void body_fractions(const SceneSpec& scene,
                    const Point& lo,
                    const Point& hi,
                    std::span<double> shares);

} // namespace ballast
