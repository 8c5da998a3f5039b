// [mesh.outline]: the outline that a `turned` mesh fits.
#include "problems/mesh_map_reader.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {

namespace {

/// Outline from its base (z, r).
std::optional<Profile> read_points(Deck& deck, const Section& in) {
  if (!in.has("use")) {
    if (in.self().find("use") != nullptr) {
      return std::nullopt; // reported
    }
    return read_profile(deck, in);
  }
  for (const char* key : {"file", "profile"}) {
    if (in.self().find(key) != nullptr) {
      deck.fail_key(*in.self().find(key), "contradicts `use`");
      return std::nullopt;
    }
  }
  return find_part(in.text("use"))->bodies.back().outline;
}

/// A mesh of lines across the axis has one radius at each z, and no point where all nodes of a line would meet.
bool fits_a_mesh(Deck& deck, const Section& in, const Profile& points) {
  DeckNode* list = in.node("profile");
  DeckNode& blame = list != nullptr ? *list : in.self();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(points[i][1] > 0)) {
      deck.fail(blame, fmt::format("the outline meets the axis at z = {:g} m: all nodes of a line would lie there", points[i][0]),
                "r above 0: a flat, however small, in place of a point");
      return false;
    }
    if (i > 0 && !(points[i][0] > points[i - 1][0])) {
      deck.fail(blame, fmt::format("a step at z = {:g} m: there the outline has two radii", points[i][0]), "z that rises from point to point");
      return false;
    }
  }
  return true;
}

/// Along the mesh's z: from its last point at `tip` backwards, or forwards if it points down.
Profile along_z(const Profile& points, double tip, bool down) {
  Profile out;
  for (const auto& [z, r] : points) {
    const double behind = points.back()[0] - z;
    out.push_back({down ? tip + behind : tip - behind, r});
  }
  if (down) {
    std::reverse(out.begin(), out.end());
  }
  return out;
}

} // namespace

bool read_outline(Deck& deck, DeckNode& mesh, SceneSpec& scene) {
  DeckNode* node = mesh.find("outline");
  if (node == nullptr) {
    deck.fail({mesh.place, mesh.key + ".outline", "missing; a turned mesh needs it", "a table { use = \"bullet/m882\", tip = ... }, or with `file` or `profile`"});
    return false;
  }
  if (!node->is_table()) {
    deck.fail(*node, fmt::format("{} is not wanted here", describe(*node)), "a table { use = \"bullet/m882\", tip = ... }, or with `file` or `profile`");
    return false;
  }
  const Section in = read_section(deck, *node, scene_keys::mesh_outline());
  const auto dim = static_cast<std::size_t>(dimensions(scene.geometry));
  const std::vector<double> tip = in.numbers("tip");
  if (in.has("tip") && tip.size() != dim) {
    deck.fail(*in.node("tip"), fmt::format("{} coordinates in a {} scene", tip.size(), name_of(scene.geometry)), fmt::format("{}, one an axis", dim));
    return false;
  }
  const Point at = point_of(tip);
  if (scene.geometry == Geometry::axisymmetric && at[0] != 0) {
    deck.fail(in.node("tip")->items[0], fmt::format("{:g} m off the axis", at[0]), "r = 0");
    return false;
  }
  const std::optional<Profile> points = read_points(deck, in);
  if (!points || !fits_a_mesh(deck, in, *points)) {
    return false;
  }
  scene.map.outline = along_z(*points, at[dim - 1], in.text("direction", "+z") == "-z");
  scene.map.centre = {at[0], dim == 3 ? at[1] : 0.0, 0};
  return true;
}

void add_outline_ends(DeckNode& axis_table, const SceneSpec& scene, int axis) {
  if (scene.map.outline.empty() || axis != dimensions(scene.geometry) - 1) {
    return;
  }
  const auto add = [&](const char* key, double value) {
    if (axis_table.find(key) != nullptr) {
      return;
    }
    add_default(axis_table, key, DeckNode::Kind::number).number = value;
  };
  add("from", scene.map.outline.front()[0]);
  add("to", scene.map.outline.back()[0]);
}

} // namespace ballast
