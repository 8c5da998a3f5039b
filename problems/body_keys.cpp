// Keys of bodies and their shapes.
#include "problems/scene_keys.hpp"

#include <array>

namespace ballast::scene_keys {
namespace {

using enum KeyKind;

KeySpec point(std::string name, std::size_t dim, std::string doc, bool required) {
  return {.name = std::move(name),
          .kind = quantities,
          .doc = std::move(doc),
          .dimension = Dimension::length,
          .required = required,
          .min_count = dim,
          .max_count = dim};
}

/// One table a dimension: points have as many coordinates as the scene.
using PerDimension = std::array<SectionSpec, 2>;
const SectionSpec& pick(const PerDimension& specs, std::size_t dim) {
  return specs[dim - 2];
}

const std::vector<std::string> directions = {"+x", "-x", "+y", "-y", "+z", "-z"};

SectionSpec radial_spec(std::size_t dim) {
  return {"[body.velocity_radial]",
          "Speed along the outward radius R, `speed` x (`at` / R)^`power`: `velocity_radial = { speed = \"-417.1 m/s\", at = \"80 mm\" }` is a shell whose inner "
          "surface, at 80 mm, moves in with its volume kept everywhere.",
          {{.name = "speed", .kind = quantity, .doc = "outward; below 0: inward", .dimension = Dimension::velocity, .required = true},
           {.name = "at", .kind = quantity, .doc = "radius where it is that; required unless `power` is 0", .dimension = Dimension::length, .range = positive()},
           {.name = "power",
            .kind = quantity,
            .doc = "default: the one that keeps volumes, 1 around an axis or in a planar scene, 2 around a point; 0: one speed; -1: every radius in proportion",
            .range = {-4, 4}},
           point("centre", dim, "point the radius is taken from; default the origin", false),
           {.name = "axis", .kind = choice, .doc = "the radius is taken from this axis through `centre` instead; axisymmetric: z", .choices = {"z", "x", "y"}}}};
}

SectionSpec box_spec(std::size_t dim) {
  return {
      "box", "", {point("from", dim, "low corner", true), point("to", dim, "high corner", true)}};
}
SectionSpec sphere_spec(std::size_t dim) {
  return {"sphere",
          "",
          {point("centre", dim, "", true),
           {.name = "radius",
            .kind = quantity,
            .doc = "",
            .dimension = Dimension::length,
            .range = positive(),
            .required = true}}};
}
SectionSpec cylinder_spec(std::size_t dim) {
  return {"cylinder",
          "",
          {point("from", dim, "one end of its axis", true),
           point("to", dim, "the other end", true),
           {.name = "radius",
            .kind = quantity,
            .doc = "",
            .dimension = Dimension::length,
            .range = positive(),
            .required = true}}};
}
SectionSpec revolved_spec(std::size_t dim) {
  return {
      "revolved",
      "Outline points (z, r), z never decreasing, straight in between; closed to the axis at both "
      "ends.",
      {{.name = "file",
        .kind = text,
        .doc = "CSV beside the deck; header `z_mm,r_mm` (or another unit of length), `#` comments"},
       {.name = "profile",
        .kind = special,
        .doc = "or the points here: `[[\"0 mm\", \"3 mm\"], ...]`"},
       point("origin", dim, "where the outline's z = 0 lies; default the origin", false),
       {.name = "direction",
        .kind = choice,
        .doc = "where the outline's z points; default +z (planar: +x)",
        .choices = directions}}};
}
SectionSpec half_space_spec(std::size_t dim) {
  return {"half_space",
          "",
          {point("point", dim, "a point on its surface", true),
           {.name = "outward",
            .kind = quantities,
            .doc = "normal pointing out of the material, any length",
            .required = true,
            .min_count = dim,
            .max_count = dim}}};
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
            "a library part; `bullet/m80` makes the bodies `core` and `jacket`, 9.525 g together",
        .choices = {"bullet/m80"}},
       {.name = "material",
        .kind = text,
        .doc = "a named material (`ballast materials`), one of [materials], or `void`: a hole"},
       {.name = "shape", .kind = special, .doc = "one of the shapes below"},
       {.name = "velocity",
        .kind = special,
        .doc = "one velocity an axis: `[\"0 m/s\", \"823 m/s\"]`; for a library part one speed "
               "along its axis. "
               "Default: at rest"},
       {.name = "velocity_radial",
        .kind = table,
        .doc = "beside `velocity`: along the radius from a point or an axis (below); for shells that collapse or expand"},
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
        .doc = "library part: where its tip is, one coordinate an axis; default the origin",
        .dimension = Dimension::length,
        .min_count = 2,
        .max_count = 3},
       {.name = "direction",
        .kind = choice,
        .doc = "library part: where its tip points; default +z (planar: +x)",
        .choices = directions},
       {.name = "yaw",
        .kind = quantity,
        .doc = "library part, 3d only: turn about its tip, from its direction towards the next "
               "axis (x to y, y "
               "to z, z to x)",
        .dimension = Dimension::angle,
        .range = {-3.1416, 3.1416}},
       {.name = "core", .kind = text, .doc = "library part: core material instead of its own"},
       {.name = "jacket",
        .kind = text,
        .doc = "library part: jacket material instead of its own"}}};
  return spec;
}

const SectionSpec& shape() {
  static const SectionSpec spec = {
      "Shapes",
      "A shape is a table with exactly one of these keys: `shape = { sphere = { centre = [...], "
      "radius = \"3 mm\" } "
      "}`. Shapes nest: `shape = { difference = [ { box = {...} }, { sphere = {...} } ] }`.",
      {{.name = "box", .kind = table, .doc = "sides along the axes"},
       {.name = "sphere",
        .kind = table,
        .doc = "planar: a disc; axisymmetric: off the axis a ring"},
       {.name = "cylinder", .kind = table, .doc = "solid, round; axisymmetric: on the axis"},
       {.name = "revolved", .kind = table, .doc = "an outline turned about an axis"},
       {.name = "half_space", .kind = table, .doc = "everything behind a plane"},
       {.name = "union", .kind = special, .doc = "list of shapes: any of them"},
       {.name = "intersection", .kind = special, .doc = "list of shapes: all of them"},
       {.name = "difference",
        .kind = special,
        .doc = "list of shapes: the first without the others"}}};
  return spec;
}

const SectionSpec& velocity_radial(std::size_t dim) {
  static const PerDimension specs = {radial_spec(2), radial_spec(3)};
  return pick(specs, dim);
}
const SectionSpec& box(std::size_t dim) {
  static const PerDimension specs = {box_spec(2), box_spec(3)};
  return pick(specs, dim);
}
const SectionSpec& sphere(std::size_t dim) {
  static const PerDimension specs = {sphere_spec(2), sphere_spec(3)};
  return pick(specs, dim);
}
const SectionSpec& cylinder(std::size_t dim) {
  static const PerDimension specs = {cylinder_spec(2), cylinder_spec(3)};
  return pick(specs, dim);
}
const SectionSpec& revolved(std::size_t dim) {
  static const PerDimension specs = {revolved_spec(2), revolved_spec(3)};
  return pick(specs, dim);
}
const SectionSpec& half_space(std::size_t dim) {
  static const PerDimension specs = {half_space_spec(2), half_space_spec(3)};
  return pick(specs, dim);
}

} // namespace ballast::scene_keys
