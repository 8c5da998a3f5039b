// `rotate`, `offset` and `stl` of shapes.
#include "problems/closed_surface.hpp"
#include "problems/facet_winding.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"
#include "problems/shape_placement.hpp"
#include "problems/stl_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace ballast {
namespace {

/// Solids that exist about the axis only, in an axisymmetric scene.
bool needs_axis(const Shape& shape) {
  if (const auto* c = std::get_if<Combination>(&shape.form)) {
    return std::any_of(c->parts.begin(), c->parts.end(), needs_axis);
  }
  return std::holds_alternative<Cylinder>(shape.form) || std::holds_alternative<Revolved>(shape.form);
}

std::optional<Rotation> read_turn(Deck& deck, const Section& in, Geometry geometry) {
  const auto complain = [&](const char* what) {
    deck.fail({in.self().place,
               in.self().key,
               what,
               geometry == Geometry::three_d ? "`angle` and `axis`, or `euler`" : "`angle`"});
    return std::nullopt;
  };
  const auto given = [&](const char* key) { return in.self().find(key) != nullptr; };
  if (given("euler")) {
    if (given("angle") || given("axis")) {
      return complain("is given twice");
    }
    return in.has("euler") ? std::optional(rotation_xyz(point_of(in.numbers("euler")))) : std::nullopt;
  }
  if (!given("angle") || (geometry == Geometry::three_d && !given("axis"))) {
    return complain(given("angle") ? "turns about no axis" : "turns by no angle");
  }
  if (geometry != Geometry::three_d) { // counterclockwise in the plane of the section
    return in.has("angle") ? std::optional(rotation_about({0, 0, 1}, in.number("angle"))) : std::nullopt;
  }
  if (!in.has("angle") || !in.has("axis")) {
    return std::nullopt;
  }
  const Point axis = point_of(in.numbers("axis"));
  if (axis == Point{}) {
    deck.fail(*in.node("axis"), "has no direction", "an axis that is not zero");
    return std::nullopt;
  }
  return rotation_about(axis, in.number("angle"));
}

} // namespace

std::optional<double> read_units(Deck& deck, const Section& in) {
  const Quantity unit = parse_quantity("1 " + in.text("units"), Dimension::length);
  if (!unit.ok() || !(unit.value > 0)) {
    deck.fail(*in.node("units"), fmt::format("\"{}\" is no unit of length", in.text("units")), allowed_units(Dimension::length));
    return std::nullopt;
  }
  return unit.value;
}

void pin_file(Deck& deck, const Section& in, const std::string& path, const std::string& checksum) {
  in.node("file")->text = std::filesystem::absolute(path).lexically_normal().string();
  if (in.has("checksum") && in.text("checksum") != checksum) {
    deck.fail(*in.node("checksum"), fmt::format("the file's is {}: it is another one", checksum), "the file that the deck was resolved with, or no checksum");
  } else if (!in.has("checksum")) {
    DeckNode sum;
    sum.kind = DeckNode::Kind::text;
    sum.text = checksum;
    sum.defaulted = true;
    in.self().fields.emplace_back("checksum", std::move(sum));
  }
}

std::optional<Shape> read_surface(Deck& deck, DeckNode& node, Geometry geometry) {
  if (geometry != Geometry::three_d) {
    deck.fail_key(node, fmt::format("a surface of facets in a scene that is {}", name_of(geometry)), "geometry = \"3d\", or another shape");
    return std::nullopt;
  }
  const Section in = read_section(deck, node, scene_keys::stl());
  if (!in.has("file") || !in.has("units")) {
    return std::nullopt;
  }
  const std::optional<double> scale = read_units(deck, in);
  if (!scale) {
    return std::nullopt;
  }
  const std::string path = deck.resolve_path(in.text("file"));
  StlFile file = read_stl(path, *scale);
  FacetMesh mesh = weld(file.facets);
  std::string problem = file.problem.empty() ? surface_flaw(mesh) : file.problem;
  problem = problem.empty() ? self_intersection(mesh) : problem;
  problem = problem.empty() ? shared_space(mesh) : problem;
  if (!problem.empty()) {
    deck.fail(*in.node("file"), problem, "a closed surface: every edge between two facets, all facing out, none cutting another; of several solids each "
                                         "apart from the others, what lies inside another a cavity that faces inwards");
    return std::nullopt;
  }
  pin_file(deck, in, path, file.checksum);
  return Shape{Surface{std::make_shared<const ClosedSurface>(std::move(mesh)), nullptr}};
}

std::optional<Shape> read_placed(Deck& deck, const Section& in, Geometry geometry, const Shape& shape) {
  const auto dim = static_cast<std::size_t>(dimensions(geometry));
  const bool on_axis = geometry == Geometry::axisymmetric && needs_axis(shape);
  Placement placement;
  if (in.has("rotate")) {
    const Section turn = read_section(deck, *in.node("rotate"), scene_keys::rotate(dim));
    if (on_axis) {
      deck.fail_key(*in.node("rotate"), "an axisymmetric cylinder or outline stays on the axis", "geometry = \"3d\", or no rotation");
      return std::nullopt;
    }
    const std::optional<Rotation> rotation = read_turn(deck, turn, geometry);
    if (!rotation) {
      return std::nullopt;
    }
    if (!can_turn(*rotation, shape)) {
      deck.fail_key(*in.node("rotate"), "voxels turn by right angles only", "a right angle, or the image resampled the way it is to lie");
      return std::nullopt;
    }
    placement.turn = *rotation;
    placement.about = point_of(turn.numbers("about"));
  }
  if (in.has("offset")) {
    const std::vector<double> offset = in.numbers("offset");
    if (offset.size() != dim || (on_axis && offset[0] != 0)) {
      deck.fail(*in.node("offset"),
                offset.size() != dim ? fmt::format("{} coordinates in a {} scene", offset.size(), name_of(geometry))
                                     : "an axisymmetric cylinder or outline stays on the axis",
                offset.size() != dim ? fmt::format("{}, one an axis", dim) : "r = 0");
      return std::nullopt;
    }
    placement.offset = point_of(offset);
  }
  return in.has("rotate") || in.has("offset") ? placed(placement, shape) : shape;
}

} // namespace ballast
