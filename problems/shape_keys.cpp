// Keys of shapes.
#include "problems/scene_keys.hpp"

#include <array>

namespace ballast::scene_keys {
namespace {

using enum KeyKind;

const std::vector<std::string> directions = {"+x", "-x", "+y", "-y", "+z", "-z"};

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

SectionSpec stl_spec() {
  return {"stl",
          "A closed surface of triangles, 3d scenes only; text or binary. Open edges (holes), edges "
          "of more than two facets, facets without area, neighbours that face opposite ways and "
          "facets that cut each other are refused with their place. Vertices of neighbours agree "
          "to the last digit.",
          {{.name = "file", .kind = text, .doc = "beside the deck", .required = true},
           {.name = "units",
            .kind = text,
            .doc = "what the file's numbers are in, a unit of length: `mm`",
            .required = true},
           {.name = "checksum",
            .kind = text,
            .doc = "of the file, as the resolved deck has it: another file is then refused"}}};
}

SectionSpec voxels_spec() {
  return {"voxels",
          "Labels of a segmented image, 3d scenes only: MetaImage (.mha, .mhd), NRRD (.nrrd, .nhdr) or NIfTI (.nii, .nii.gz) with one "
          "whole number from 0 to 65535 a voxel. x, y and z are those of the file's space, its origin the centre of the first voxel, "
          "which is half a spacing inside the block; `offset` moves it, `rotate` turns it by right angles. An image whose axes do not "
          "lie along x, y and z is refused. A cell takes the volume of the voxels that it shares with them, so that bodies of several "
          "labels of one image fill what those labels fill, to the last digit, whatever the mesh (curved meshes: to the lines cast "
          "through a cell, as for all shapes). Name the same file in each of them.",
          {{.name = "file", .kind = text, .doc = "beside the deck", .required = true},
           {.name = "label",
            .kind = special,
            .doc = "the voxels wanted: `3`, or several labels as one body, `[3, 4]`",
            .required = true},
           {.name = "units",
            .kind = text,
            .doc = "what the file's lengths are in, a unit of length, whatever the file says itself",
            .fallback = "mm"},
           {.name = "checksum",
            .kind = text,
            .doc = "of the image, as the resolved deck has it: another image is then refused"}}};
}

SectionSpec rotate_spec(std::size_t dim) {
  SectionSpec spec = {"rotate",
                      "Beside a shape in its table: `shape = { box = {...}, rotate = { angle = \"30 deg\", axis = "
                      "[0, 0, 1] }, offset = [...] }`. Right-handed, before the offset.",
                      {{.name = "angle",
                        .kind = quantity,
                        .doc = "about `axis`; planar: from x to y; axisymmetric: of the section, from r to z",
                        .dimension = Dimension::angle},
                       point("about", dim, "the point that stays; default the origin", false)}};
  if (dim == 3) {
    spec.keys.push_back({.name = "axis",
                         .kind = quantities,
                         .doc = "3d: what `angle` turns about, any length",
                         .min_count = 3,
                         .max_count = 3});
    spec.keys.push_back({.name = "euler",
                         .kind = quantities,
                         .doc = "3d: instead of angle and axis, angles about x, then y, then z, axes fixed in space",
                         .dimension = Dimension::angle,
                         .min_count = 3,
                         .max_count = 3});
  }
  return spec;
}

} // namespace

const SectionSpec& shape() {
  static const SectionSpec spec = {
      "Shapes",
      "A shape is a table with exactly one of these keys, and `rotate` and `offset` if wanted: `shape = { sphere = { centre = [...], "
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
        .doc = "list of shapes: the first without the others"},
       {.name = "stl", .kind = table, .doc = "3d: inside a closed surface of triangles"},
       {.name = "voxels", .kind = table, .doc = "3d: where an image has a label"},
       {.name = "rotate", .kind = table, .doc = "beside a shape of any kind: turns it, see below"},
       {.name = "offset",
        .kind = quantities,
        .doc = "beside a shape of any kind: moves it, after `rotate`; one length an axis",
        .dimension = Dimension::length,
        .min_count = 2,
        .max_count = 3}}};
  return spec;
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

const SectionSpec& stl() {
  static const SectionSpec spec = stl_spec();
  return spec;
}
const SectionSpec& voxels() {
  static const SectionSpec spec = voxels_spec();
  return spec;
}
const SectionSpec& rotate(std::size_t dim) {
  static const PerDimension specs = {rotate_spec(2), rotate_spec(3)};
  return pick(specs, dim);
}

} // namespace ballast::scene_keys
