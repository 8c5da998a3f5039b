// Keys of the mesh: lines, boundaries, motion.
#include "problems/scene_keys.hpp"

namespace ballast::scene_keys {

using enum KeyKind;

const SectionSpec& mesh() {
  static const SectionSpec spec = {
      "[mesh]",
      "One table an axis (below), and:",
      {{.name = "refine",
        .kind = quantity,
        .doc = "every cell size is divided by it, every count of cells times it: for studies of the resolution",
        .range = {0.01, 100},
        .fallback = "1"},
       {.name = "map",
        .kind = choice,
        .doc = "a curvilinear starting mesh and its axes. planar: `polar` (`radius`, `angle` from the x axis), `disc` (`u`, `v`); axisymmetric: "
               "`spherical` (`angle` from the axis at z > 0, `radius`), `ball` (`u` along r, `v` along z); 3d: `cylindrical` (`radius`, `angle`, `z`), `rod` (`u`, `v`, "
               "`z`), `ball` (`u`, `v`, `w`); axisymmetric and 3d: `turned` (`u` or `u`, `v`, and `z`), the solid of an `outline` turned about z. Angles in deg or rad; a radius starts above 0. `u`, `v`, `w` go from -1 to 1 (edge to edge) or from or to 0 (a plane of "
               "symmetry through the centre), whatever the size; no cell of theirs is degenerate (docs/numerics.md 1). A side is symmetric where it is a plane "
               "through the centre, at angles that are multiples of 90 deg or u, v, w = 0, unless it says otherwise; curved and slanted sides are `free`; "
               "`symmetry` and `wall` need a plane across a coordinate axis. Not with `follow`, `numerics.sliding` or `results.target`",
        .fallback = "rectilinear",
        .choices = {"rectilinear", "polar", "disc", "spherical", "cylindrical", "rod", "ball", "turned"}},
       {.name = "outer_radius",
        .kind = quantity,
        .doc = "disc, rod, ball: radius of the curved edge; required there",
        .dimension = Dimension::length,
        .range = positive()},
       {.name = "centre",
        .kind = quantities,
        .doc = "of a map; one coordinate an axis, of cylindrical and rod x and y; default the origin; not of `turned`, which has a tip",
        .dimension = Dimension::length,
        .min_count = 2,
        .max_count = 3},
       {.name = "outline", .kind = table, .doc = "turned: the solid that the mesh fits (below); required there"}}};
  return spec;
}

const SectionSpec& mesh_outline() {
  static const SectionSpec spec = {
      "[mesh.outline]",
      "Of a `turned` mesh: nodes with u (or the larger of u and v) = 1 lie on the outline, straight between its points; `z` goes from end to end of it unless the "
      "deck says less: `outline = { use = \"bullet/m882\", tip = [\"0 mm\", \"0 mm\"] }` fits the bullet and nothing else.",
      {{.name = "use", .kind = choice, .doc = "the outside of a library part", .choices = {"bullet/m80", "bullet/m882"}},
       {.name = "file", .kind = text, .doc = "or a CSV beside the deck; header `z_mm,r_mm` (or another unit of length), `#` comments"},
       {.name = "profile", .kind = special, .doc = "or the points here: `[[\"0 mm\", \"3 mm\"], ...]`; z rises, r above 0"},
       {.name = "tip",
        .kind = quantities,
        .doc = "where its last point's z is on its axis, as a body's `tip`; default the origin",
        .dimension = Dimension::length,
        .min_count = 2,
        .max_count = 3},
       {.name = "direction", .kind = choice, .doc = "where its z points; default +z", .choices = {"+z", "-z"}}}};
  return spec;
}

namespace {

SectionSpec axis_spec(Dimension dimension) {
  return {
      "[mesh.AXIS]",
      "Lines along one axis: `r = { from = \"0 mm\", to = [\"8 mm\", \"60 mm\"], size = [\"0.25 "
      "mm\", \"2 mm\"] }` is "
      "uniform to 8 mm and then grows geometrically to 2 mm. Ends are met exactly; sizes shrink a "
      "little "
      "where they do not divide a stretch.",
      {{.name = "from",
        .kind = quantity,
        .doc = "low end; a length, an angle or a plain number, as its axis wants; z of a `turned` mesh: default the outline's end",
        .dimension = dimension,
        .required = true},
       {.name = "to",
        .kind = special,
        .doc = "high end, or a rising list of places where `size` is given; required, but for z of a `turned` mesh"},
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
        .doc = "boundary at the low end; default `free`, at r = 0 `symmetry`, of a map as `map` says"},
       {.name = "upper", .kind = special, .doc = "boundary at the high end; default `free`, of a map as `map` says"}}};
}

} // namespace

const SectionSpec& mesh_axis(Dimension dimension) {
  static const SectionSpec length = axis_spec(Dimension::length), angle = axis_spec(Dimension::angle), number = axis_spec(Dimension::none);
  return dimension == Dimension::length ? length : dimension == Dimension::angle ? angle : number;
}

const SectionSpec& boundary() {
  static const SectionSpec spec = {
      "Boundaries (`lower`, `upper`)",
      "A text (`symmetry`, `free`, `wall`, `outflow`, `absorbing`) or a table with these keys. `outflow` lets "
      "material out and waves that arrive head on; what flows back in is the edge cell's. `inflow` "
      "brings a material in at a fixed state; it needs a mesh that is remapped. `absorbing` stands for more of the edge "
      "cell's matter, at rest and at the ambient pressure: it takes waves, in place of far matter.",
      {{.name = "type",
        .kind = choice,
        .doc = "`free` carries the ambient pressure, none where the scene starts with void; `wall` is rigid and frictionless",
        .required = true,
        .choices = {"symmetry", "free", "wall", "inflow", "outflow", "absorbing"}},
       {.name = "velocity",
        .kind = special,
        .doc = "wall: one velocity along the axis (of a map: along the coordinate it is normal to); inflow: one velocity an axis, into the mesh"},
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
        .doc = "lagrangian: never remapped; eulerian: back to the initial mesh; follow: to the initial mesh moved along "
               "with `bodies`; relax: on to a smoothed mesh (harmonic displacement from the initial one)",
        .fallback = "eulerian",
        .choices = {"lagrangian", "eulerian", "follow", "relax"}},
       {.name = "remap_every",
        .kind = integer,
        .doc = "steps between remaps; not with remap_quality, nor with policy lagrangian",
        .range = {1, 1e6},
        .fallback = "1"},
       {.name = "remap_quality",
        .kind = quantity,
        .doc = "instead of remap_every: a remap is due when the shape of a cell, against what the last remap made it, falls below this "
               "(mean ratio, 1: the same but for turns and size, 0: a corner collapsed; stretched to twice the length: 0.8)",
        .range = {0.01, 0.99}},
       {.name = "bodies",
        .kind = texts,
        .doc = "follow: bodies whose materials' centre of mass the mesh goes with"},
       {.name = "axes", .kind = choices, .doc = "follow: axes along which it goes; default: where these bodies have a velocity", .choices = {"z", "x", "y"}},
       {.name = "stretch",
        .kind = choices,
        .doc = "follow: axes along which the mesh also grows and shrinks with these bodies' extent (their root mean square distance from "
               "their centre of mass, or from the axis or symmetry plane)",
        .choices = {"z", "x", "y", "r"}},
       {.name = "boundary",
        .kind = choice,
        .doc = "relax: what the nodes of free sides do, default lagrangian; along walls and symmetry planes they slide either way",
        .choices = {"lagrangian", "fixed"}},
       {.name = "sweeps", .kind = integer, .doc = "relax: smoothing sweeps at each remap, default 4", .range = {1, 1000}}}};
  return spec;
}

} // namespace ballast::scene_keys
