// [mesh] map: curvilinear starting meshes, what their axes may span and what their sides may be.
#include "problems/mesh_map_reader.hpp"

#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast {

namespace {

struct NamedMap {
  const char* name;
  Geometry geometry;
  MapKind kind;
};
constexpr NamedMap maps[] = {{"polar", Geometry::planar, MapKind::polar},
                             {"disc", Geometry::planar, MapKind::disc},
                             {"spherical", Geometry::axisymmetric, MapKind::spherical},
                             {"ball", Geometry::axisymmetric, MapKind::ball_section},
                             {"cylindrical", Geometry::three_d, MapKind::cylindrical},
                             {"rod", Geometry::three_d, MapKind::rod},
                             {"ball", Geometry::three_d, MapKind::ball},
                             {"turned", Geometry::axisymmetric, MapKind::turned_section},
                             {"turned", Geometry::three_d, MapKind::turned}};

bool is_turned(MapKind kind) { return kind == MapKind::turned || kind == MapKind::turned_section; }

bool has_outer_radius(MapKind kind) {
  return kind == MapKind::disc || kind == MapKind::ball_section || kind == MapKind::rod || kind == MapKind::ball;
}

void read_outer_radius(Deck& deck, DeckNode& mesh, const std::string& name, MeshMap& map) {
  DeckNode* node = mesh.find("outer_radius");
  if (!has_outer_radius(map.kind)) {
    if (node != nullptr) {
      deck.fail_key(*node, fmt::format("a {} mesh does not take it", name));
    }
    return;
  }
  if (node == nullptr) {
    deck.fail({mesh.place, mesh.key + ".outer_radius", fmt::format("missing; a {} mesh needs it", name), "a length above 0"});
  } else if (read_quantity(deck, *node, Dimension::length, positive())) {
    map.outer_radius = node->number;
  }
}

void read_centre(Deck& deck, DeckNode& mesh, Geometry geometry, MeshMap& map) {
  DeckNode* node = mesh.find("centre");
  if (is_turned(map.kind)) {
    if (node != nullptr) {
      deck.fail_key(*node, "a turned mesh does not take it: the outline has a `tip`");
    }
    return;
  }
  const bool round_z = map.kind == MapKind::cylindrical || map.kind == MapKind::rod;
  const std::size_t count = geometry == Geometry::three_d && !round_z ? 3 : 2;
  if (node == nullptr || !read_quantities(deck, *node, Dimension::length, {}, count, count)) {
    return;
  }
  map.centre = point_of(numbers_of(*node));
  if (geometry == Geometry::axisymmetric && map.centre[0] != 0) {
    deck.fail(node->items[0], fmt::format("{:g} m off the axis", map.centre[0]), "r = 0");
  }
}

/// Which end of an axis a complaint about its range is put at.
DeckNode& place_of(DeckNode& axis, const char* key) {
  DeckNode* node = axis.find(key);
  return node != nullptr ? *node : axis;
}

bool check_radius(Deck& deck, DeckNode& axis, const std::vector<double>& lines) {
  if (!(lines.front() > 0)) {
    deck.fail(place_of(axis, "from"), "cells at the centre would have no inner side",
              "above 0: a hole of a small radius; or map = \"disc\", \"rod\" or \"ball\", which have cells at the centre");
    return false;
  }
  return true;
}

bool check_angles(Deck& deck, DeckNode& axis, const std::vector<double>& lines, MapKind kind) {
  constexpr double pi = std::numbers::pi, slack = 1e-12, deg = 180 / pi;
  if (kind == MapKind::spherical && (lines.front() < -slack || lines.back() > pi + slack)) {
    deck.fail(place_of(axis, lines.front() < -slack ? "from" : "to"), "an angle off the half plane r >= 0", "from 0 to 180 deg, taken from the axis");
    return false;
  }
  if (kind != MapKind::spherical && lines.back() - lines.front() > 2 * pi - slack) {
    deck.fail(place_of(axis, "to"), fmt::format("the sector spans {:g} deg and meets itself", (lines.back() - lines.front()) * deg),
              "less than 360 deg: a quarter or a half, symmetric; or map = \"disc\" or \"rod\"");
    return false;
  }
  return true;
}

bool check_square(Deck& deck, DeckNode& axis, const std::vector<double>& lines, bool radial) {
  const auto known = [](double x) { return x == -1 || x == 0 || x == 1; };
  if (!known(lines.front()) || !known(lines.back()) || (radial && lines.front() != 0)) {
    deck.fail(place_of(axis, known(lines.front()) && (!radial || lines.front() == 0) ? "to" : "from"),
              "the curved edge is at -1 and 1, the planes between halves at 0", radial ? "from 0 to 1" : "from -1 or 0 to 0 or 1");
    return false;
  }
  return true;
}

/// The mesh may be a piece of the solid, but has no shape beyond its ends.
bool check_outline_ends(Deck& deck, DeckNode& axis, const std::vector<double>& lines, const Profile& outline) {
  const double slack = 1e-9 * (outline.back()[0] - outline.front()[0]);
  const bool low = lines.front() < outline.front()[0] - slack, high = lines.back() > outline.back()[0] + slack;
  if (low || high) {
    deck.fail(place_of(axis, low ? "from" : "to"), fmt::format("{:g} m is beyond the outline", low ? lines.front() : lines.back()),
              fmt::format("from {:g} to {:g} m, or leave it out", outline.front()[0], outline.back()[0]));
  }
  return !low && !high;
}

} // namespace

DeckNode& add_default(DeckNode& table, const std::string& key, DeckNode::Kind kind) {
  DeckNode node;
  node.kind = kind;
  node.key = table.key + "." + key;
  node.place = table.place;
  node.defaulted = true;
  return table.fields.emplace_back(key, std::move(node)).second;
}

bool read_map(Deck& deck, DeckNode& mesh, SceneSpec& scene) {
  DeckNode* node = mesh.find("map");
  std::vector<std::string> names = {"rectilinear"};
  for (const NamedMap& m : maps) {
    if (m.geometry == scene.geometry) {
      names.emplace_back(m.name);
    }
  }
  const bool plain = node == nullptr || (node->kind == DeckNode::Kind::text && node->text == "rectilinear");
  if (plain) {
    for (const char* key : {"outer_radius", "centre", "outline"}) {
      if (DeckNode* extra = mesh.find(key)) {
        deck.fail_key(*extra, "only with a `map`");
      }
    }
    return true;
  }
  const auto* found = std::find_if(std::begin(maps), std::end(maps), [&](const NamedMap& m) {
    return node->kind == DeckNode::Kind::text && node->text == m.name && m.geometry == scene.geometry;
  });
  if (found == std::end(maps)) {
    deck.fail(*node, fmt::format("{} is no map of {} scenes", describe(*node), name_of(scene.geometry)), one_of(names));
    return false;
  }
  scene.map.kind = found->kind;
  if (scene.motion.policy == MotionPolicy::follow) {
    deck.fail(*node, "a mesh that follows is rectilinear", "motion.policy = \"lagrangian\" or \"eulerian\", or no map");
  }
  read_outer_radius(deck, mesh, found->name, scene.map);
  read_centre(deck, mesh, scene.geometry, scene.map);
  if (is_turned(found->kind)) {
    return read_outline(deck, mesh, scene);
  }
  if (DeckNode* outline = mesh.find("outline")) {
    deck.fail_key(*outline, fmt::format("a {} mesh does not take it", found->name));
  }
  return true;
}

bool check_mapped_axis(Deck& deck, DeckNode& node, const SceneSpec& scene, int axis) {
  const std::vector<double>& lines = scene.mesh_lines[static_cast<std::size_t>(axis)];
  const Dimension dimension = mesh_axis_dimension(scene.map, axis);
  const bool along_z = (axis == 2 && scene.map.kind != MapKind::ball) || (axis == 1 && scene.map.kind == MapKind::turned_section);
  if (along_z && is_turned(scene.map.kind) && !lines.empty()) {
    return check_outline_ends(deck, node, lines, scene.map.outline);
  }
  if (!scene.map.curved() || lines.empty() || along_z) {
    return true;
  }
  if (dimension == Dimension::none) {
    return check_square(deck, node, lines, axis == 0 && (scene.map.kind == MapKind::ball_section || scene.map.kind == MapKind::turned_section));
  }
  return dimension == Dimension::angle ? check_angles(deck, node, lines, scene.map.kind) : check_radius(deck, node, lines);
}

MappedSide mapped_side(const SceneSpec& scene, int axis, int side) {
  const std::vector<double>& lines = scene.mesh_lines[static_cast<std::size_t>(axis)];
  if (lines.empty()) {
    return {};
  }
  const int normal = normal_component(scene.map, axis, side == 0 ? lines.front() : lines.back());
  const bool section = mesh_axis_dimension(scene.map, axis) != Dimension::length; // not a rod's end
  return {normal, normal >= 0 && section, scene.geometry == Geometry::axisymmetric && normal == 0};
}

bool check_mapped_side(Deck& deck, DeckNode& type, const SceneSpec& scene, int axis, int side, BoundaryKind kind) {
  const MappedSide s = mapped_side(scene, axis, side);
  if (s.normal < 0 && kind != BoundaryKind::free) {
    deck.fail(type, "this side is curved or slanted: no velocity component is along its normal",
              mesh_axis_dimension(scene.map, axis) == Dimension::angle ? "free, or an angle that is a multiple of 90 deg" : "free");
    return false;
  }
  if (kind != BoundaryKind::free && kind != BoundaryKind::symmetry && kind != BoundaryKind::wall) {
    deck.fail(type, "only a rectilinear mesh has such sides", "symmetry, free or wall");
    return false;
  }
  return true;
}

} // namespace ballast
