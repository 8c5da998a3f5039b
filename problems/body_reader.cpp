// [[body]]: bodies described in the deck and library parts.
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

struct Context {
  Deck& deck;
  MaterialBook& book;
  SceneSpec& scene;
  std::size_t dim() const { return static_cast<std::size_t>(dimensions(scene.geometry)); }
};

void refuse(Context c,
            const Section& in,
            std::initializer_list<const char*> keys,
            const char* why) {
  for (const char* key : keys) {
    if (in.has(key)) {
      c.deck.fail_key(*in.node(key), why);
    }
  }
}

bool require(Context c, const Section& in, const char* key) {
  if (in.self().find(key) == nullptr) {
    c.deck.fail(
        {in.self().place, in.self().key + "." + key, "missing", scene_keys::body().find(key)->doc});
    return false;
  }
  return in.has(key);
}

/// Density, pressure and energy of a body: given, else the material's and the ambient.
void set_state(Context c, const Section& in, Body& body) {
  if (body.material < 0) {
    refuse(c, in, {"density", "pressure", "specific_energy"}, "a void has no state");
    return;
  }
  const Material& m = c.scene.materials[static_cast<std::size_t>(body.material)];
  body.density = in.number("density", m.density);
  if (in.has("specific_energy")) {
    if (in.has("pressure")) {
      c.deck.fail_key(*in.node("specific_energy"),
                      "contradicts pressure",
                      "one of pressure and specific_energy");
      return;
    }
    body.specific_energy = in.number("specific_energy");
    body.pressure = pressure(m.eos, body.density, body.specific_energy);
  } else {
    const StartState start = start_state(c.deck, in, m, body.density, c.scene.ambient_pressure);
    body.specific_energy = start.specific_energy;
    body.pressure = start.pressure;
  }
  const double c2 = sound_speed_squared(m.eos, body.density, body.specific_energy);
  constexpr double rounding = 1e-9; // of the stiffness
  if (c2 > 0 && c.scene.numerics.spall && body.pressure < m.spall_pressure - rounding * body.density * c2) {
    DeckNode* given = in.has("pressure") ? in.node("pressure") : in.has("specific_energy") ? in.node("specific_energy") : in.node("density");
    c.deck.fail(given != nullptr ? *given : in.self(),
                fmt::format("{:g} Pa is below the spall pressure of {}, {:g} Pa: void would open everywhere in the first step", body.pressure, m.name, m.spall_pressure),
                "a pressure above it, or numerics.spall = false");
  }
  if (!(c2 > 0)) {
    c.deck.fail(
        {in.self().place,
         in.self().key,
         fmt::format(
             "{} has no sound speed at {:g} kg/m3, {:g} Pa", m.name, body.density, body.pressure),
         "a density and pressure its equation of state can hold"});
  }
}

/// A body outside the mesh is a mistake in one of the two.
bool check_place(Context c, const Section& in, const Body& body) {
  const Bounds b = bounds(body.shape), mesh = mesh_bounds(c.scene);
  const std::vector<std::string> names = axis_names(c.scene.geometry);
  for (std::size_t k = 0; k < c.dim(); ++k) {
    const bool radius = c.scene.geometry == Geometry::axisymmetric && k == 0;
    if (c.scene.motion.policy == MotionPolicy::follow && !radius) {
      continue; // the mesh may come by
    }
    if (b.lo[k] >= mesh.hi[k] || b.hi[k] <= mesh.lo[k]) {
      c.deck.fail({in.self().place,
                   in.self().key,
                   fmt::format("body \"{}\" lies outside the mesh along {} ({:g} to {:g} m)",
                               body.name,
                               names[k],
                               b.lo[k],
                               b.hi[k]),
                   fmt::format("{} from {:g} to {:g} m", names[k], mesh.lo[k], mesh.hi[k])});
      return false;
    }
  }
  const bool reached = c.scene.motion.policy == MotionPolicy::follow || !std::holds_alternative<Voxels>(body.shape.form) || !std::isfinite(mesh.lo[0]) ||
                       fraction(body.shape, c.scene.geometry, mesh.lo, mesh.hi) > 0;
  if (!reached) { // about the mesh, with a hole where it is
    c.deck.fail(*in.node("shape"), fmt::format("no voxel of body \"{}\" lies in the mesh", body.name), "a mesh where the label is, or an `offset` that brings it there");
  }
  return reached;
}

bool add(Context c, const Section& in, Body body) {
  for (const Body& other : c.scene.bodies) {
    if (other.name == body.name) {
      DeckNode* name = in.node("name");
      c.deck.fail({name != nullptr ? name->place : in.self().place,
                   in.self().key + ".name",
                   fmt::format("there is another body called \"{}\"", body.name),
                   "a name of its own"});
      return false;
    }
  }
  const bool placed = check_place(c, in, body);
  c.scene.bodies.push_back(std::move(body));
  return placed;
}

/// velocity_radial = { speed, at, centre, power, axis }.
std::optional<RadialVelocity> read_radial(Context c, DeckNode& node) {
  const Section in = read_section(c.deck, node, scene_keys::velocity_radial(c.dim()));
  RadialVelocity u;
  if (in.has("axis")) {
    const std::vector<std::string> names = axis_names(c.scene.geometry);
    const auto at = std::find(names.begin(), names.end(), in.text("axis"));
    const bool off_axis = c.scene.geometry == Geometry::axisymmetric && in.text("axis") != "z";
    if (at == names.end() || off_axis || c.scene.geometry == Geometry::planar) {
      c.deck.fail(*in.node("axis"), fmt::format("no axis to take a radius from in a {} scene", name_of(c.scene.geometry)),
                  c.scene.geometry == Geometry::planar ? "leave it out" : c.dim() == 2 ? "z" : one_of(names));
      return std::nullopt;
    }
    u.along = static_cast<int>(at - names.begin());
  }
  u.speed = in.number("speed", 0);
  u.centre = point_of(in.numbers("centre"));
  const bool around_a_line = c.scene.geometry == Geometry::planar || u.along >= 0;
  u.power = in.number("power", around_a_line ? 1 : 2);
  u.at = in.number("at", 1);
  if (u.power != 0 && in.self().find("at") == nullptr) {
    c.deck.fail({node.place, node.key + ".at", "missing; where is the speed that?", "a radius, or power = 0: the same speed everywhere"});
    return std::nullopt;
  }
  return u;
}

/// A speed that grows without bound towards the centre has no place in a body that holds it.
void check_radial(Context c, const Section& in, const Body& body) {
  if (body.radial && body.radial->power > 0 && contains(body.shape, body.radial->centre)) {
    c.deck.fail(*in.node("velocity_radial"), "the body holds the centre, where this speed has no bound", "a hollow body, or a power of 0 or below");
  }
}

bool leans(const Section& in) {
  return in.has("yaw") || in.has("obliquity") || in.has("hit_offset");
}

/// The direction of a shot, an axis; its errors are at `direction`.
std::optional<Point> shot_direction(Context c, const Section& in) {
  DeckNode* direction = in.node("direction");
  return read_direction(c.deck,
                        in.text("direction", default_direction(c.scene.geometry)),
                        c.scene.geometry,
                        direction != nullptr ? *direction : in.self());
}

/// `tip`, one coordinate an axis; absent: the origin.
std::optional<Point> read_tip(Context c, const Section& in) {
  const std::vector<double> tip = in.numbers("tip");
  if (in.has("tip") && tip.size() != c.dim()) {
    c.deck.fail(*in.node("tip"),
                fmt::format("{} coordinates in a {} scene", tip.size(), name_of(c.scene.geometry)),
                fmt::format("{}, one an axis", c.dim()));
    return std::nullopt;
  }
  return point_of(tip);
}

/// A radial velocity keeps its centre and axis where the deck says, whichever way the body turns or goes.
bool check_radial_lean(Context c, const Section& in, const Body& body) {
  for (const char* key : {"yaw", "obliquity", "hit_offset"}) {
    if (body.radial && in.number(key, 0) != 0) {
      c.deck.fail_key(*in.node(key), "would not turn or move the `velocity_radial` of this body with it", "0, or no `velocity_radial`");
      return false;
    }
  }
  return true;
}

/// A described body that leans: all bodies of one bullet turn about one point, so that is asked for.
bool lean(Context c, const Section& in, Body& body) {
  if (!leans(in)) {
    return true;
  }
  if (!check_radial_lean(c, in, body)) {
    return false;
  }
  const bool turns = in.number("yaw", 0) != 0 || in.number("obliquity", 0) != 0;
  if (turns && c.scene.geometry == Geometry::three_d && in.self().find("tip") == nullptr) {
    c.deck.fail({in.self().place, in.self().key + ".tip", "missing", "the point the body turns about: the bullet's tip, the same for all its bodies"});
    return false;
  }
  const auto direction = shot_direction(c, in);
  const auto tip = read_tip(c, in);
  const auto attitude = direction && tip ? read_attitude(c.deck, in, c.scene, *direction, *tip) : std::nullopt;
  if (!attitude) {
    return false;
  }
  if (!can_turn(attitude->body.turn, body.shape)) {
    c.deck.fail(*in.node("shape"), "voxels turn by right angles only, and this body leans", "no yaw and no obliquity, or another shape");
    return false;
  }
  body.shape = placed(attitude->body, body.shape);
  body.velocity = turned(attitude->flight, body.velocity);
  body.aim = attitude->aim;
  return true;
}

void read_plain(Context c, const Section& in) {
  refuse(c, in, {"core", "jacket"}, "belongs to library parts (`use`)");
  if (!leans(in)) {
    refuse(c, in, {"tip", "direction"}, "belongs to library parts (`use`), or to a body with a yaw, an obliquity or a hit_offset");
  }
  const bool named = require(c, in, "name");
  Body body;
  body.name = in.text("name");
  std::optional<int> material;
  if (require(c, in, "material")) {
    material = c.book.index(c.deck, in.text("material"), *in.node("material"));
  }
  std::optional<Shape> shape;
  if (require(c, in, "shape")) {
    shape = read_shape(c.deck, *in.node("shape"), c.scene.geometry);
  }
  if (DeckNode* velocity = in.node("velocity")) {
    if (read_quantities(c.deck, *velocity, Dimension::velocity, scene_keys::speeds(), c.dim(), c.dim())) {
      body.velocity = point_of(numbers_of(*velocity));
    }
  }
  if (DeckNode* radial = in.node("velocity_radial")) {
    body.radial = read_radial(c, *radial);
  }
  if (!named || !material || !shape) {
    return;
  }
  body.material = *material;
  body.shape = std::move(*shape);
  check_radial(c, in, body);
  if (!lean(c, in, body)) {
    return;
  }
  if (std::holds_alternative<Combination>(body.shape.form) && is_empty(body.shape, c.scene.geometry, mesh_bounds(c.scene))) {
    c.deck.fail(*in.node("shape"), "the shape is empty: its intersections and differences leave nothing of it", "parts that overlap, and less taken away");
    return;
  }
  c.scene.materials = c.book.used();
  set_state(c, in, body);
  add(c, in, std::move(body));
}

void read_part(Context c, const Section& in) {
  refuse(c,
         in,
         {"material", "shape", "velocity_radial", "density", "pressure", "specific_energy"},
         "a library part brings its own (`core` and `jacket` change its materials)");
  const Part& part = *find_part(in.text("use"));
  const std::optional<Point> axis = shot_direction(c, in);
  double speed = 0;
  if (DeckNode* velocity = in.node("velocity")) {
    read_quantity(c.deck, *velocity, Dimension::velocity, scene_keys::speeds());
    speed = in.number("velocity", 0);
  }
  const std::optional<Point> tip = read_tip(c, in);
  if (!axis || !tip) {
    return;
  }
  if (c.scene.geometry == Geometry::axisymmetric && (*tip)[0] != 0) {
    c.deck.fail(in.node("tip")->items[0], "an axisymmetric bullet flies on the axis", "r = 0");
    return;
  }
  const std::optional<Attitude> attitude = read_attitude(c.deck, in, c.scene, *axis, *tip);
  if (!attitude) {
    return;
  }
  Point origin = *tip;
  Point velocity{};
  for (std::size_t k = 0; k < 3; ++k) {
    origin[k] -= part.length * (*axis)[k];
    velocity[k] = speed * (*axis)[k];
  }
  for (const PartBody& piece : part.bodies) {
    DeckNode* chosen = in.node(piece.name);
    const auto material = c.book.index(
        c.deck, in.text(piece.name, piece.material), chosen != nullptr ? *chosen : in.self());
    if (!material) {
      continue;
    }
    Body body;
    body.name = in.has("name") ? in.text("name") + "." + piece.name : piece.name;
    body.material = *material;
    body.velocity = turned(attitude->flight, velocity);
    body.aim = attitude->aim;
    body.shape = Shape{Revolved{origin, *axis, piece.outline}};
    if (!piece.hollow.empty()) {
      body.shape = Shape{Combination{Combination::Kind::subtract,
                                     {body.shape, Shape{Revolved{origin, *axis, piece.hollow}}}}};
    }
    body.shape = placed(attitude->body, body.shape);
    c.scene.materials = c.book.used();
    set_state(c, in, body);
    if (!add(c, in, std::move(body))) {
      return; // one mistake, one error
    }
  }
}

} // namespace

void read_bodies(Deck& deck, DeckNode* list, MaterialBook& book, SceneSpec& scene) {
  if (list == nullptr) {
    return;
  }
  const Context c{deck, book, scene};
  for (DeckNode& node : list->items) {
    const Section in = read_section(deck, node, scene_keys::body());
    if (node.find("use") == nullptr) {
      read_plain(c, in);
    } else if (in.has("use")) {
      read_part(c, in);
    }
  }
}

} // namespace ballast
