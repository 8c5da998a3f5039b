// Keys of fabric layers and their fabrics.
#include "problems/scene_keys.hpp"

#include "materials/fabric_library.hpp"

namespace ballast::scene_keys {

using enum KeyKind;

const SectionSpec& layers() {
  static const SectionSpec spec = {
      "[[layers]]",
      "A stack of fabric layers across the last axis, the shot's, its middle on the axis x = y = 0 (r = 0; planar x = 0). Two of `areal_density`, `thickness` and "
      "`density` give the third; what is not given is `plies` times a ply of the named fabric. The same plies over another thickness carry the same load of a width: yarn and in-plane shear stresses go with density (not those of an isotropic fabric). Each layer stands for an equal share of the plies. Several stacks lie one behind the other, apart or face to face; they touch as their layers do, with the larger `friction` of both, and count from the lowest. Where the mesh has a "
      "plane of symmetry x = 0 or y = 0 the stack ends there, too. Around an axis the fabric is quasi-isotropic: yarns along every radius (warp) and every circle (fill); "
      "that is stiffer than woven cloth off its yarns' directions. A mesh whose sides go with what it holds touches the stack with its free sides; in any other (eulerian, follow, relax with a fixed boundary; straight lines only) the stack lies inside it, and bodies at rest that it overlaps make room (docs/embedding.md).",
      {{.name = "name", .kind = text, .doc = "unique; in columns, dumps and files", .fallback = "layers"},
       {.name = "fabric", .kind = text, .doc = "`kevlar_km2_raftenberg` or `kevlar_hooke_wstm` (docs/materials.md), or one of [fabrics]", .required = true},
       {.name = "layers", .kind = integer, .doc = "that slide on each other, at most one a ply", .range = {1, 1000}, .fallback = "5"},
       {.name = "elements_through", .kind = integer, .doc = "elements through a layer", .range = {1, 100}, .fallback = "1"},
       {.name = "plies", .kind = integer, .doc = "of the stack; default as many as its weight makes, the fabric's without one", .range = {1, 1000}},
       {.name = "areal_density", .kind = quantity, .doc = "of the stack", .dimension = Dimension::areal_density, .range = positive()},
       {.name = "thickness", .kind = quantity, .doc = "of the stack at rest", .dimension = Dimension::length, .range = positive()},
       {.name = "density", .kind = quantity, .doc = "areal_density over thickness", .dimension = Dimension::density, .range = positive()},
       {.name = "front", .kind = quantity, .doc = "where the face that meets the shot is, along the last axis; the stack lies behind it as the shot of `results.bullet` goes, without one towards +", .dimension = Dimension::length, .required = true},
       {.name = "half_width", .kind = quantity, .doc = "half the side of a square (3d), the radius (axisymmetric), half the length (planar)", .dimension = Dimension::length, .range = positive(), .required = true},
       {.name = "to", .kind = special, .doc = "a place, or a rising list of places, between the middle and `half_width` where `size` has entries, too"},
       {.name = "size", .kind = special, .doc = "element size in the plane as in [mesh.AXIS], from the middle: at each place of `to` and at `half_width`, the first stretch uniform; or at the middle, too: `size = [\"1 mm\", \"5 mm\"]` grows all the way"},
       {.name = "cells", .kind = integer, .doc = "instead of `size`: that many equal elements from the middle to `half_width`", .range = {.lo = 1}},
       {.name = "refine", .kind = quantity, .doc = "sizes in the plane are divided by it: for studies of the resolution", .range = {0.01, 100}, .fallback = "1"},
       {.name = "edges", .kind = choice, .doc = "what holds the outer edges: nothing, all of their motion, or springs in their plane", .fallback = "free", .choices = {"free", "fixed", "elastic"}},
       {.name = "edge_stiffness", .kind = quantity, .doc = "elastic edges: N/m for a metre of edge", .dimension = Dimension::pressure, .range = positive()},
       {.name = "friction", .kind = quantity, .doc = "Coulomb's coefficient between layers and on what they touch", .range = {0, 2}, .fallback = "0"},
       {.name = "hourglass", .kind = quantity, .doc = "stiffness of the modes without strain, share of the moduli at rest", .range = {0, 1}, .fallback = "0.2"},
       {.name = "hourglass_viscosity", .kind = quantity, .doc = "their damping, of density x wave speed x size", .range = {0, 0.5}, .fallback = "0"},
       {.name = "quadratic_q", .kind = quantity, .doc = "artificial viscosity through the thickness: of density x the square of the speed at which an element's faces come together", .range = {0, 10}, .fallback = "1.5"},
       {.name = "linear_q", .kind = quantity, .doc = "likewise, of density x that speed x the wave speed at rest", .range = {0, 10}, .fallback = "0.06"},
       {.name = "shortest", .kind = quantity, .doc = "of its length at rest: an edge of an element in the plane closes no further (unless contact presses on), where pressed cloth without strength would fold finer than the mesh and turn inside out; 0: no end", .range = {0, 0.9}, .fallback = "0.2"},
       {.name = "least_volume", .kind = quantity, .doc = "of that at rest: below it, in the middle of either surface, an element presses back and does not turn inside out; 0: it may", .range = {0, 0.5}, .fallback = "0.1"},
       {.name = "erode_volume", .kind = quantity, .doc = "of that at rest: an element pressed to less, or turned inside out, is taken as torn through and erodes; 0: only rupture of both families erodes", .range = {0, 0.5}, .fallback = "0"},
       {.name = "erode_when", .kind = choice, .doc = "an element of Raftenberg's fabric erodes once `both` families of yarns are lost, as printed, or `either`: around an axis hoops rarely tear, and cloth without yarns along its radii hangs on as a film", .fallback = "both", .choices = {"both", "either"}},
       {.name = "debris", .kind = text, .doc = "inside a mesh: material that torn cloth becomes, where there is void for it near the stack (docs/embedding.md); without it nodes that no element is left at fly on as particles that touch nothing"},
       {.name = "cfl", .kind = quantity, .doc = "share of the stack's stable step; above 0.7 modes can resonate with the step", .range = {0, 1, true}, .fallback = "0.7"},
       {.name = "subcycles", .kind = special, .doc = "steps of the stack to one of the mesh: `auto`, as many as its own stable step asks, or a whole number", .fallback = "auto"},
       {.name = "yarns", .kind = choice, .doc = "axisymmetric: what lies along radii and circles: `both` is warp along radii and fill along circles; default `both`", .choices = {"both", "warp", "fill"}},
       {.name = "rate_time", .kind = quantity, .doc = "fabrics with a rate factor: time over which rates of extension are smoothed; default 1 us", .dimension = Dimension::time, .range = positive()}}};
  return spec;
}

namespace {

KeySpec fit_key(const char* name, const char* doc, Dimension dimension) {
  return {.name = name, .kind = quantity, .doc = doc, .dimension = dimension};
}

std::vector<KeySpec> fit_keys() {
  return {fit_key("a", "modulus at no strain", Dimension::pressure), fit_key("b", "", Dimension::pressure), fit_key("c", "", Dimension::pressure),
          fit_key("d", "", Dimension::pressure),                     fit_key("e", "", Dimension::none),     fit_key("f", "", Dimension::none)};
}

} // namespace

const SectionSpec& fabric() {
  static const SectionSpec spec = {
      "[fabrics.NAME]",
      "Overrides of the named fabric NAME, or a new one if NAME is new: then `base`, or `law` and its constants, must be given. Laws and the sources of the options: "
      "docs/materials.md. `kevlar_km2_raftenberg` as named is the law as printed, all options off.",
      {{.name = "base", .kind = text, .doc = "start from this named fabric"},
       {.name = "law", .kind = choice, .doc = "of a new fabric: decoupled orthotropic, or isotropic St Venant-Kirchhoff", .choices = {"raftenberg", "hooke"}},
       {.name = "warp", .kind = table, .doc = "Raftenberg: yarns along x (below)"},
       {.name = "fill", .kind = table, .doc = "Raftenberg: yarns along y (below)"},
       {.name = "unload", .kind = quantity, .doc = "Raftenberg: of warp and fill: strain past rupture over which the stress falls to zero; 0.4 as printed, 0.02 for a short ramp", .range = positive()},
       {.name = "transverse", .kind = table, .doc = "Raftenberg: through the thickness (below)"},
       {.name = "transverse_form", .kind = choice, .doc = "Raftenberg: factor of the transverse denominator that is squared: none (A), 1 + 2E (B), q (C)", .choices = {"A", "B", "C"}},
       {.name = "shear_in_plane", .kind = special, .doc = "Raftenberg: a modulus, `awg` (4.14 MPa, locking to 41.4 MPa at 0.25 rad and 345 MPa at 0.35 rad) or a table (below); 1 GPa as printed"},
       {.name = "shear_through", .kind = special, .doc = "Raftenberg: likewise; 50 GPa as printed"},
       {.name = "solid", .kind = special, .doc = "Raftenberg: hand over to a solid once pressed to its density: `true`, `false` or a table (below)"},
       {.name = "secant_unloading", .kind = flag, .doc = "Raftenberg: past rupture back along the secant to the origin"},
       {.name = "rate", .kind = special, .doc = "Raftenberg: yarns stronger with rate: `true`, `false` or a table (below)"},
       {.name = "coupling", .kind = quantity, .doc = "Raftenberg: stiffening of warp and fill stretched together", .dimension = Dimension::pressure, .range = not_negative()},
       {.name = "young", .kind = quantity, .doc = "Hooke", .dimension = Dimension::pressure, .range = positive()},
       {.name = "poisson", .kind = quantity, .doc = "Hooke", .range = {-1, 0.5, true}},
       {.name = "source", .kind = text, .doc = "where the numbers are from"}}};
  return spec;
}

const SectionSpec& yarns() {
  static const SectionSpec spec = [] {
    SectionSpec s = {"[fabrics.NAME.warp], [fabrics.NAME.fill]", "Stress N/q by Green strain E: N = aE + bE^2 + cE^3 + dE^4, q = 1 + eE + fE^2.", fit_keys()};
    s.keys.push_back({.name = "rupture", .kind = quantity, .doc = "Green strain of the largest load", .range = positive()});
    s.keys.push_back({.name = "unload", .kind = quantity, .doc = "further strain over which the stress falls to zero", .range = positive()});
    return s;
  }();
  return spec;
}

const SectionSpec& transverse() {
  static const SectionSpec spec = {"[fabrics.NAME.transverse]", "Stress N/((1 + 2E) q) in compression, one factor squared by `transverse_form`.", fit_keys()};
  return spec;
}

const SectionSpec& shear() {
  static const SectionSpec spec = {
      "[fabrics.NAME.shear_in_plane], [fabrics.NAME.shear_through]",
      "Stress by engineering shear, its slope growing at two angles.",
      {{.name = "modulus", .kind = quantity, .doc = "slope at first", .dimension = Dimension::pressure, .range = not_negative(), .required = true},
       {.name = "stiffer", .kind = quantity, .doc = "slope beyond first_angle", .dimension = Dimension::pressure, .range = not_negative(), .required = true},
       {.name = "stiffest", .kind = quantity, .doc = "slope beyond second_angle", .dimension = Dimension::pressure, .range = not_negative(), .required = true},
       {.name = "first_angle", .kind = quantity, .doc = "", .dimension = Dimension::angle, .range = positive(), .required = true},
       {.name = "second_angle", .kind = quantity, .doc = "", .dimension = Dimension::angle, .range = positive(), .required = true}}};
  return spec;
}

const SectionSpec& solid() {
  static const SectionSpec spec = {
      "[fabrics.NAME.solid]",
      "Pressure K (rho/density - 1) in all directions, above `density`.",
      {{.name = "density", .kind = quantity, .doc = "of the solid", .dimension = Dimension::density, .range = positive(), .fallback = "1440 kg/m3"},
       {.name = "bulk_modulus", .kind = quantity, .doc = "K", .dimension = Dimension::pressure, .range = positive(), .fallback = "8 GPa"}}};
  return spec;
}

const SectionSpec& rate() {
  static const SectionSpec spec = {"[fabrics.NAME.rate]",
                                   "Yarn stress times 1 + C ln(max(rate/reference_rate, 1)).",
                                   {{.name = "C", .kind = quantity, .doc = "", .range = {0, 10}, .fallback = "0.02"},
                                    {.name = "reference_rate", .kind = quantity, .doc = "", .dimension = Dimension::rate, .range = positive(), .fallback = "1 1/s"}}};
  return spec;
}

} // namespace ballast::scene_keys
