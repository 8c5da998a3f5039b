// Keys of bodies.
#include "problems/scene_keys.hpp"

namespace ballast::scene_keys {
namespace {

using enum KeyKind;

const std::vector<std::string> directions = {"+x", "-x", "+y", "-y", "+z", "-z"};

SectionSpec radial_spec(std::size_t dim) {
  return {"[body.velocity_radial]",
          "Speed along the outward radius R, `speed` x (`at` / R)^`power`: `velocity_radial = { speed = \"-417.1 m/s\", at = \"80 mm\" }` is a shell whose inner "
          "surface, at 80 mm, moves in with its volume kept everywhere.",
          {{.name = "speed", .kind = quantity, .doc = "outward; below 0: inward", .dimension = Dimension::velocity, .range = speeds(), .required = true},
           {.name = "at", .kind = quantity, .doc = "radius where it is that; required unless `power` is 0", .dimension = Dimension::length, .range = positive()},
           {.name = "power",
            .kind = quantity,
            .doc = "default: the one that keeps volumes, 1 around an axis or in a planar scene, 2 around a point; 0: one speed; -1: every radius in proportion",
            .range = {-4, 4}},
           {.name = "centre",
            .kind = quantities,
            .doc = "point the radius is taken from; default the origin",
            .dimension = Dimension::length,
            .min_count = dim,
            .max_count = dim},
           {.name = "axis", .kind = choice, .doc = "the radius is taken from this axis through `centre` instead; axisymmetric: z", .choices = {"z", "x", "y"}}}};
}

} // namespace

const SectionSpec& body() {
  static const SectionSpec spec = {
      "[[body]]",
      "Either a part described here (`name`, `material`, `shape`) or a library part (`use`, placed "
      "by `tip` and "
      "`direction`). Later bodies replace earlier ones where they overlap.",
      {{.name = "name",
        .kind = text,
        .doc =
            "unique; required unless `use` is given. A library part with a name calls its bodies "
            "`name.core`, ..."},
       {.name = "use",
        .kind = choice,
        .doc =
            "a library part; `bullet/m80` (9.525 g) and `bullet/m882` (8.006 g) make the bodies `core` and `jacket`",
        .choices = {"bullet/m80", "bullet/m882"}},
       {.name = "material",
        .kind = text,
        .doc = "a named material (`ballast materials`), one of [materials], or `void`: a hole"},
       {.name = "shape", .kind = special, .doc = "one of the shapes below"},
       {.name = "velocity",
        .kind = special,
        .doc = "one velocity an axis: `[\"0 m/s\", \"823 m/s\"]`; for a library part one speed "
               "along its `direction`, turned by the obliquity. Default: at rest"},
       {.name = "velocity_radial",
        .kind = table,
        .doc = "beside `velocity`: along the radius from a point or an axis (below); for shells that collapse or expand; "
               "not with a yaw, an obliquity or a hit_offset"},
       {.name = "density",
        .kind = quantity,
        .doc = "initial density, the material's if absent",
        .dimension = Dimension::density,
        .range = positive()},
       {.name = "pressure",
        .kind = quantity,
        .doc = "initial pressure, ambient if absent",
        .dimension = Dimension::pressure},
       {.name = "specific_energy",
        .kind = quantity,
        .doc = "instead of pressure",
        .dimension = Dimension::specific_energy},
       {.name = "tip",
        .kind = quantities,
        .doc = "library part: where its tip is, one coordinate an axis; default the origin. A described "
               "body that leans: the point it is turned about, the same for all bodies of a bullet",
        .dimension = Dimension::length,
        .min_count = 2,
        .max_count = 3},
       {.name = "direction",
        .kind = choice,
        .doc = "library part, or a body that leans: where its tip points; default +z (planar: +x)",
        .choices = directions},
       {.name = "yaw",
        .kind = quantity,
        .doc = "3d: angle between the bullet's axis and its velocity: the body is turned about its tip, "
               "`towards` a side, the velocity is not",
        .dimension = Dimension::angle,
        .range = {-3.1416, 3.1416}},
       {.name = "obliquity",
        .kind = quantity,
        .doc = "3d: angle between the velocity and `direction`, the normal of the target's face: body "
               "and velocity are turned about the tip, `towards` a side",
        .dimension = Dimension::angle,
        .range = {-1.3963, 1.3963}},
       {.name = "hit_offset",
        .kind = quantity,
        .doc = "3d: how far the body, its tip with it, is moved `towards` a side",
        .dimension = Dimension::length},
       {.name = "towards",
        .kind = choice,
        .doc = "3d: the side of yaw, obliquity and hit_offset, square to `direction`; default the next "
               "axis (x to y, y to z, z to x)",
        .choices = directions},
       {.name = "core", .kind = text, .doc = "library part: core material instead of its own"},
       {.name = "jacket",
        .kind = text,
        .doc = "library part: jacket material instead of its own"}}};
  return spec;
}

const SectionSpec& velocity_radial(std::size_t dim) {
  static const SectionSpec flat = radial_spec(2), solid = radial_spec(3);
  return dim == 2 ? flat : solid;
}

} // namespace ballast::scene_keys
