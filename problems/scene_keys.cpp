// Keys of a whole scene: its top level, methods, gauges and output.
#include "problems/scene_keys.hpp"

#include "problems/scene_spec.hpp"

namespace ballast::scene_keys {

using enum KeyKind;

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
       {.name = "injury", .kind = table, .doc = "injury measures; research output, not medical advice"},
       {.name = "layers", .kind = tables, .doc = "stacks of fabric layers that stay Lagrangian and slide on each other"},
       {.name = "fabrics", .kind = table, .doc = "overrides of named fabrics, and new ones"}}};
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
                                     .doc = "of everything at the start; below the melting of what has strength",
                                     .dimension = Dimension::temperature,
                                     .range = positive(),
                                     .fallback = "293 K"}}};
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
       {.name = "shear_q",
        .kind = quantity,
        .doc = "part of the artificial viscosity's coefficient that resists shear and hoop compression in shocks, too: against jets "
               "along rows of cells",
        .range = {0, 1},
        .fallback = "0"},
       {.name = "subzonal_pressure",
        .kind = quantity,
        .doc = "merit factor of the pressures of a cell's quarters, which restore distorted cells; cells without strength of Lagrangian "
               "meshes, not 3d",
        .range = {0, 1},
        .fallback = "0"},
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
       {.name = "sliding",
        .kind = texts,
        .doc = "materials that slide along the others without friction: where they meet both keep their own "
               "velocity along the interface, and move as one across it. Those listed stick to each other. "
               "Policies eulerian and follow, without outflow sides; default none, all stick together"},
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
       {.name = "dt_min",
        .kind = quantity,
        .doc = "a stable step that falls below it ends the run as failed; not above dt_max or `end_time`; default 1e-10 of `end_time`",
        .dimension = Dimension::time,
        .range = positive()},
       {.name = "spall",
        .kind = flag,
        .doc = "void opens below a material's spall pressure",
        .fallback = "true"},
       {.name = "sleeping",
        .kind = flag,
        .doc = "cells at rest are passed over, which changes no bit of the results; off only to measure what that saves. Meshes that "
               "follow something and scenes with inflow never sleep",
        .fallback = "true"},
       {.name = "tissue_path",
        .kind = choice,
        .doc = "nonlinear viscoelastic branches (power law, Bergstroem-Boyce): exponential substeps where their own estimate meets the tolerance, "
               "CVODE for the others (mixed) or not (adaptive: they are counted), or CVODE for all",
        .fallback = "mixed",
        .choices = {"adaptive", "mixed", "cvode"}},
       {.name = "tissue_tolerance",
        .kind = quantity,
        .doc = "error of a step's stress over the stress; of CVODE a tenth of it",
        .range = {1e-9, 0.1},
        .fallback = "1e-3"}}};
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
       {.name = "filter", .kind = planned, .doc = "CFC filters of columns; those of peak accelerations are in [injury]"}}};
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
        .doc = "bodies that together are the bullet: speed, mass, extents and depth are reported; in a 3d "
               "scene also, along each axis across the shot without a plane of symmetry, centre of mass "
               "and its deflection, momentum, side force (its rate), tilt and yaw of the axis (the principal "
               "axis of inertia that stands apart from the other two), all of the part inside the mesh"},
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
                              &velocity_radial(2),
                              &shape(),
                              &box(2),
                              &sphere(2),
                              &cylinder(2),
                              &revolved(2),
                              &half_space(2),
                              &stl(),
                              &voxels(),
                              &rotate(3),
                              &mesh(),
                              &mesh_outline(),
                              &mesh_axis(),
                              &boundary(),
                              &motion(),
                              &material(),
                              &layers(),
                              &fabric(),
                              &yarns(),
                              &transverse(),
                              &shear(),
                              &solid(),
                              &rate(),
                              &numerics(),
                              &gauge(),
                              &output(),
                              &results(),
                              &injury()});
}

} // namespace ballast::scene_keys
