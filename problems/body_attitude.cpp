// Attitude of a bullet: how its flight and its axis lean, and where it hits.
//
// With d the direction it is shot in (the inward normal of the target's face) and s the way it
// leans (`towards`, square to d), all turns are about the tip, in the plane of d and s:
//   flight  = d cos(obliquity) + s sin(obliquity)
//   axis    = d cos(obliquity + yaw) + s sin(obliquity + yaw)
//   tip    += hit_offset s
// The tip stays the point that hits; the centre of mass comes to lie a little off the line of
// flight through it (its distance from the tip times sin(yaw)).
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include "problems/shape_geometry.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr const char* keys[] = {"yaw", "obliquity", "hit_offset"};

/// The first key that says the bullet is not straight, or none.
const char* leaning_key(const Section& in) {
  for (const char* key : keys) {
    if (in.number(key, 0) != 0) {
      return key;
    }
  }
  return nullptr;
}

/// Along the axis after the direction's own: x to y, y to z, z to x.
Point next_axis(const Point& direction) {
  Point side{};
  for (std::size_t k = 0; k < 3; ++k) {
    side[(k + 1) % 3] = std::abs(direction[k]);
  }
  return side;
}

std::optional<Point> read_side(Deck& deck, const Section& in, const SceneSpec& scene, const Point& direction) {
  if (!in.has("towards")) {
    return next_axis(direction);
  }
  const auto side = read_direction(deck, in.text("towards"), scene.geometry, *in.node("towards"));
  if (side && dot(*side, direction) != 0) {
    deck.fail(*in.node("towards"), fmt::format("{} lies along the direction of the shot", in.text("towards")), "an axis square to it");
    return std::nullopt;
  }
  return side;
}

/// A plane of symmetry that the bullet leans across would mirror it.
bool check_symmetry(Deck& deck, const Section& in, const SceneSpec& scene, const Point& side) {
  const auto k = static_cast<std::size_t>(aligned_with(side));
  const auto& sides = scene.boundaries[k];
  if (sides[0].kind != BoundaryKind::symmetry && sides[1].kind != BoundaryKind::symmetry) {
    return true;
  }
  const std::string name = axis_names(scene.geometry)[k];
  deck.fail(*in.node(leaning_key(in)),
            fmt::format("leans along {}, across a plane of symmetry of the scene", name),
            fmt::format("0, or a mesh on both sides of {} = 0 without that symmetry (the other one may stay)", name));
  return false;
}

} // namespace

std::optional<Attitude> read_attitude(Deck& deck, const Section& in, const SceneSpec& scene, const Point& direction, const Point& tip) {
  Attitude out;
  const char* key = leaning_key(in);
  if (scene.geometry != Geometry::three_d && (key != nullptr || in.has("towards"))) {
    deck.fail(*in.node(key != nullptr ? key : "towards"),
              fmt::format("a bullet that leans or hits off the axis in a scene that is {}", name_of(scene.geometry)),
              "0, or geometry = \"3d\" with symmetry across the plane it leans in: half a model");
    return std::nullopt;
  }
  if (scene.geometry != Geometry::three_d) {
    return out;
  }
  const auto side = read_side(deck, in, scene, direction);
  if (!side || (key != nullptr && !check_symmetry(deck, in, scene, *side))) {
    return std::nullopt;
  }
  if (key == nullptr) {
    return out; // to the last bit what it was
  }
  const double obliquity = in.number("obliquity", 0), offset = in.number("hit_offset", 0);
  const Point about = cross(direction, *side);
  out.aim = obliquity != 0 ? direction : Point{};
  out.flight = rotation_about(about, obliquity);
  out.body = {rotation_about(about, obliquity + in.number("yaw", 0)), tip, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    out.body.offset[k] = offset * (*side)[k];
  }
  return out;
}

} // namespace ballast
