#include "problems/scene_keys.hpp"

#include "problems/scene_spec.hpp"

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

} // namespace

const SectionSpec& top() {
  static const SectionSpec spec = {
      "Top level",
      "What the scene is. A deck is TOML; a quantity is text with a unit (`\"823 m/s\"`) or a bare "
      "number in "
      "SI. Unknown and duplicate keys are errors.",
      {{.name = "title", .kind = text, .doc = "one line for tables and pictures", .required = true},
       {.name = "geometry",
        .kind = choice,
        .doc =
            "planar (axes x, y), axisymmetric (axes r, z, turned about r = 0) or 3d (axes x, y, z)",
        .required = true,
        .choices = {"planar", "axisymmetric", "3d"}},
       {.name = "symmetry",
        .kind = choices,
        .doc =
            "axes whose low side is a plane of symmetry; the same as `lower = \"symmetry\"` there",
        .choices = {"x", "y", "z"}},
       {.name = "end_time",
        .kind = quantity,
        .doc = "when the run ends",
        .dimension = Dimension::time,
        .range = positive(),
        .required = true},
       {.name = "ambient",
        .kind = table,
        .doc = "pressure and temperature of everything at the start; where there is void, there is vacuum: nothing presses from it or from a free side"},
       {.name = "background",
        .kind = text,
        .doc = "material where no body is, or `void`",
        .fallback = "void"},
       {.name = "body",
        .kind = tables,
        .doc = "pieces of the initial state; **later bodies replace earlier ones where they "
               "overlap**"},
       {.name = "mesh",
        .kind = table,
        .doc = "one table an axis: `mesh.r`, `mesh.z`",
        .required = true},
       {.name = "motion", .kind = table, .doc = "how the mesh moves"},
       {.name = "materials", .kind = table, .doc = "overrides of named materials, and new ones"},
       {.name = "numerics", .kind = table, .doc = "methods and their coefficients"},
       {.name = "gauge", .kind = tables, .doc = "points that record"},
       {.name = "output", .kind = table, .doc = "what is written and how often"},
       {.name = "results", .kind = table, .doc = "what summary.json reports of this scene"},
       {.name = "layers", .kind = planned, .doc = "Lagrangian stacks with slidelines"}}};
  return spec;
}

const SectionSpec& ambient() {
  static const SectionSpec spec = {"[ambient]",
                                   "State of every body that does not give its own.",
                                   {{.name = "pressure",
                                     .kind = quantity,
                                     .doc = "also the reference of gauge pressures",
                                     .dimension = Dimension::pressure,
                                     .range = not_negative(),
                                     .fallback = "1 atm"},
                                    {.name = "temperature",
                                     .kind = quantity,
                                     .doc = "where thermal softening counts from",
                                     .dimension = Dimension::temperature,
                                     .range = positive(),
                                     .fallback = "293 K"}}};
  return spec;
}

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

namespace {
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

const SectionSpec& mesh_axis() {
  static const SectionSpec spec = {
      "[mesh.AXIS]",
      "Lines along one axis: `r = { from = \"0 mm\", to = [\"8 mm\", \"60 mm\"], size = [\"0.25 "
      "mm\", \"2 mm\"] }` is "
      "uniform to 8 mm and then grows geometrically to 2 mm. Ends are met exactly; sizes shrink a "
      "little "
      "where they do not divide a stretch.",
      {{.name = "from",
        .kind = quantity,
        .doc = "low end",
        .dimension = Dimension::length,
        .required = true},
       {.name = "to",
        .kind = special,
        .doc = "high end, or a rising list of places where `size` is given; required"},
       {.name = "size",
        .kind = special,
        .doc = "cell size at each `to` (the first stretch is uniform), or at `from` and each `to`; "
               "required unless "
               "`cells` is given"},
       {.name = "cells",
        .kind = integer,
        .doc = "instead of `size`: that many equal cells",
        .range = {.lo = 1}},
       {.name = "lower",
        .kind = special,
        .doc = "boundary at the low end; default `free`, at r = 0 `symmetry`"},
       {.name = "upper", .kind = special, .doc = "boundary at the high end; default `free`"}}};
  return spec;
}

const SectionSpec& boundary() {
  static const SectionSpec spec = {
      "Boundaries (`lower`, `upper`)",
      "A text (`symmetry`, `free`, `wall`, `outflow`) or a table with these keys. `outflow` lets "
      "material out and waves that arrive head on; what flows back in is the edge cell's. `inflow` "
      "brings a material in at a fixed state; it needs an eulerian mesh. `absorbing` is not "
      "available yet.",
      {{.name = "type",
        .kind = choice,
        .doc = "`free` carries the ambient pressure, none where the scene starts with void; `wall` is rigid and frictionless",
        .required = true,
        .choices = {"symmetry", "free", "wall", "inflow", "outflow"}},
       {.name = "velocity",
        .kind = special,
        .doc = "wall: one velocity along the axis; inflow: one velocity an axis, into the mesh"},
       {.name = "material", .kind = text, .doc = "inflow: what comes in"},
       {.name = "density",
        .kind = quantity,
        .doc = "inflow; the material's if absent",
        .dimension = Dimension::density,
        .range = positive()},
       {.name = "pressure",
        .kind = quantity,
        .doc = "inflow; ambient if absent",
        .dimension = Dimension::pressure}}};
  return spec;
}

const SectionSpec& motion() {
  static const SectionSpec spec = {
      "[motion]",
      "The mesh always takes a Lagrangian step; this says what happens after it.",
      {{.name = "policy",
        .kind = choice,
        .doc = "lagrangian: never remapped; eulerian: back to the initial mesh; relax and follow "
               "are not available "
               "yet",
        .fallback = "eulerian",
        .choices = {"lagrangian", "eulerian", "relax", "follow"}},
       {.name = "remap_every",
        .kind = integer,
        .doc = "steps between remaps (eulerian)",
        .range = {1, 1e6},
        .fallback = "1"}}};
  return spec;
}

const SectionSpec& material() {
  static const SectionSpec spec = {
      "[materials.NAME]",
      "Overrides of the named material NAME (docs/materials.md), or a new one if NAME is new: then "
      "`base`, or `eos` "
      "and `density`, must be given.",
      {{.name = "base", .kind = text, .doc = "start from this named material"},
       {.name = "density",
        .kind = quantity,
        .doc = "initial; also the reference density of Mie-Grueneisen",
        .dimension = Dimension::density,
        .range = positive()},
       {.name = "eos",
        .kind = choice,
        .doc = "equation of state",
        .choices = {"ideal_gas", "stiffened_gas", "mie_gruneisen"}},
       {.name = "gamma",
        .kind = quantity,
        .doc = "ideal and stiffened gas",
        .range = {1, 100, true}},
       {.name = "p_infinity",
        .kind = quantity,
        .doc = "stiffened gas",
        .dimension = Dimension::pressure,
        .range = not_negative()},
       {.name = "c0",
        .kind = quantity,
        .doc = "Mie-Grueneisen: Us = c0 + s up",
        .dimension = Dimension::velocity,
        .range = positive()},
       {.name = "s", .kind = quantity, .doc = "Mie-Grueneisen", .range = {0, 10}},
       {.name = "gamma0", .kind = quantity, .doc = "Mie-Grueneisen", .range = {0, 10, true}},
       {.name = "gamma_constant",
        .kind = flag,
        .doc = "Mie-Grueneisen: keep Gamma constant instead of Gamma rho"},
       {.name = "strength",
        .kind = choice,
        .doc = "flow stress model",
        .choices = {"none", "linear_hardening", "johnson_cook"}},
       {.name = "shear_modulus",
        .kind = quantity,
        .doc = "with any strength",
        .dimension = Dimension::pressure,
        .range = positive()},
       {.name = "yield",
        .kind = quantity,
        .doc = "linear hardening",
        .dimension = Dimension::pressure,
        .range = positive()},
       {.name = "hardening",
        .kind = quantity,
        .doc = "linear hardening: slope by plastic strain",
        .dimension = Dimension::pressure,
        .range = not_negative()},
       {.name = "A",
        .kind = quantity,
        .doc = "Johnson-Cook",
        .dimension = Dimension::pressure,
        .range = positive()},
       {.name = "B",
        .kind = quantity,
        .doc = "Johnson-Cook",
        .dimension = Dimension::pressure,
        .range = not_negative()},
       {.name = "n", .kind = quantity, .doc = "Johnson-Cook", .range = {0, 10, true}},
       {.name = "C", .kind = quantity, .doc = "Johnson-Cook", .range = {0, 10}},
       {.name = "m", .kind = quantity, .doc = "Johnson-Cook", .range = {0, 10, true}},
       {.name = "reference_rate",
        .kind = quantity,
        .doc = "Johnson-Cook",
        .dimension = Dimension::rate,
        .range = positive()},
       {.name = "specific_heat",
        .kind = quantity,
        .doc = "for temperatures",
        .dimension = Dimension::specific_heat,
        .range = positive()},
       {.name = "melt_temperature",
        .kind = quantity,
        .doc = "thermal softening ends in it",
        .dimension = Dimension::temperature,
        .range = positive()},
       {.name = "spall_pressure",
        .kind = quantity,
        .doc = "void opens below it; negative",
        .dimension = Dimension::pressure,
        .range = {.hi = 0}},
       {.name = "source", .kind = text, .doc = "where the numbers are from"}}};
  return spec;
}

const SectionSpec& numerics() {
  static const SectionSpec spec = {
      "[numerics]",
      "Methods and coefficients; docs/numerics.md says what they do.",
      {{.name = "cfl",
        .kind = quantity,
        .doc = "share of the stable step",
        .range = {0, 1, true},
        .fallback = "0.5"},
       {.name = "closure",
        .kind = choice,
        .doc = "how mixed cells share a volume change",
        .fallback = "pressure_relaxation",
        .choices = {"pressure_relaxation", "tipton", "equal_strain"}},
       {.name = "quadratic_q",
        .kind = quantity,
        .doc = "artificial viscosity, factor on the Kuropatenko coefficient",
        .range = {0, 10},
        .fallback = "1.0"},
       {.name = "linear_q",
        .kind = quantity,
        .doc = "artificial viscosity, factor on the sound speed",
        .range = {0, 10},
        .fallback = "0.5"},
       {.name = "hourglass",
        .kind = quantity,
        .doc = "viscous hourglass coefficient",
        .range = {0, 1},
        .fallback = "0.06"},
       {.name = "energy_return",
        .kind = choice,
        .doc = "kinetic energy lost in the remap becomes heat; auto: on in scenes without strength",
        .fallback = "auto",
        .choices = {"auto", "on", "off"}},
       {.name = "normal",
        .kind = choice,
        .doc = "interface normals",
        .fallback = "elvira",
        .choices = {"elvira", "mixed_youngs_centred", "youngs"}},
       {.name = "interface_order",
        .kind = texts,
        .doc = "materials in onion-skin order, innermost first; default: as bodies first name "
               "them. Void is last"},
       {.name = "dt_initial",
        .kind = quantity,
        .doc = "first step; default the stable one",
        .dimension = Dimension::time,
        .range = positive()},
       {.name = "dt_growth",
        .kind = quantity,
        .doc = "largest growth from step to step",
        .range = {1, 10, true},
        .fallback = "1.1"},
       {.name = "dt_max",
        .kind = quantity,
        .doc = "largest step; default none",
        .dimension = Dimension::time,
        .range = positive()},
       {.name = "spall",
        .kind = flag,
        .doc = "void opens below a material's spall pressure",
        .fallback = "true"}}};
  return spec;
}

const SectionSpec& gauge() {
  static const SectionSpec spec = {
      "[[gauge]]",
      "A point whose values go to history.csv.",
      {{.name = "name", .kind = text, .doc = "unique", .required = true},
       {.name = "at",
        .kind = quantities,
        .doc = "one coordinate an axis, inside the mesh",
        .dimension = Dimension::length,
        .required = true,
        .min_count = 2,
        .max_count = 3},
       {.name = "rides",
        .kind = flag,
        .doc = "moves with the material, else fixed in space",
        .fallback = "false"},
       {.name = "record",
        .kind = choices,
        .doc = "what is recorded",
        .fallback = "pressure, velocity",
        .choices = gauge_quantities()},
       {.name = "filter", .kind = planned, .doc = "CFC filters"}}};
  return spec;
}

const SectionSpec& output() {
  static const SectionSpec spec = {
      "[output]",
      "Start and end are always written.",
      {{.name = "fields_every",
        .kind = quantity,
        .doc = "between VTK dumps; default none between start and end",
        .dimension = Dimension::time,
        .range = positive()},
       {.name = "fields",
        .kind = choices,
        .doc = "what the dumps hold",
        .fallback = "material, pressure, speed, density",
        .choices = field_quantities()},
       {.name = "history_every",
        .kind = quantity,
        .doc = "between rows of history.csv; default every step",
        .dimension = Dimension::time,
        .range = positive()},
       {.name = "checkpoint_every",
        .kind = quantity,
        .doc = "wall clock between checkpoints; default only at the end",
        .dimension = Dimension::time,
        .range = positive()}}};
  return spec;
}

const SectionSpec& results() {
  static const SectionSpec spec = {
      "[results]",
      "Scene-specific results in summary.json.",
      {{.name = "bullet",
        .kind = texts,
        .doc = "bodies that together are the bullet: speed, mass, extents and depth are reported"},
       {.name = "target",
        .kind = text,
        .doc = "material whose cavity, energy gain and pressure are reported"}}};
  return spec;
}

std::string reference() {
  std::string out = "# Deck reference\n\nGenerated by `ballast deck-reference` from the table that "
                    "parses decks; do not "
                    "edit. Units:\n\n| quantity | units (the first is SI) |\n|---|---|\n";
  for (int d = 1; d <= static_cast<int>(Dimension::rate); ++d) {
    const auto dimension = static_cast<Dimension>(d);
    out += "| " + std::string(name_of(dimension)) + " | " + allowed_units(dimension) + " |\n";
  }
  return out + key_reference({&top(),
                              &ambient(),
                              &body(),
                              &shape(),
                              &box(2),
                              &sphere(2),
                              &cylinder(2),
                              &revolved(2),
                              &half_space(2),
                              &mesh_axis(),
                              &boundary(),
                              &motion(),
                              &material(),
                              &numerics(),
                              &gauge(),
                              &output(),
                              &results()});
}

} // namespace ballast::scene_keys
