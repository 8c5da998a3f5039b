// [motion]: when the mesh is remapped, and what a following mesh goes with.
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {

/// Axes by name, as indices; those the scene does not have are reported.
std::vector<std::size_t> listed_axes(Deck& deck, const Section& in, const char* key, const std::vector<std::string>& names) {
  std::vector<std::size_t> axes;
  for (const std::string& axis : in.texts(key)) {
    const auto at = std::find(names.begin(), names.end(), axis);
    if (at == names.end()) {
      deck.fail(*in.node(key), fmt::format("no axis {} in a scene with the axes {}", axis, one_of(names)), one_of(names));
      continue;
    }
    axes.push_back(static_cast<std::size_t>(at - names.begin()));
  }
  return axes;
}

bool explicitly(const Section& in, const char* key) {
  return in.has(key) && !in.node(key)->defaulted;
}

/// When a remap is due: by steps or by quality, and never on a lagrangian mesh.
void read_due(Deck& deck, const Section& in, Motion& motion) {
  motion.remap_every = in.integer("remap_every");
  motion.remap_quality = in.number("remap_quality", 0);
  const bool never = motion.policy == MotionPolicy::lagrangian;
  for (const char* key : {"remap_every", "remap_quality"}) {
    if (never && explicitly(in, key)) {
      deck.fail_key(*in.node(key), "has no effect: a lagrangian mesh is never remapped", "another `policy`, or leave it out");
    }
  }
  if (!never && motion.remap_quality > 0 && explicitly(in, "remap_every")) {
    deck.fail_key(*in.node("remap_quality"), "contradicts `remap_every`: a remap is due by one or the other", "one of them");
  }
  if (never || motion.remap_quality > 0) { // no default, either, so that the resolved deck reads back
    std::erase_if(in.self().fields, [](const auto& field) { return field.first == "remap_every" && field.second.defaulted; });
  }
}

} // namespace

void read_motion(Deck& deck, DeckNode& node, Motion& motion) {
  const Section in = read_section(deck, node, scene_keys::motion());
  motion.policy = static_cast<MotionPolicy>(in.choice("policy"));
  read_due(deck, in, motion);
  motion.fixed_boundary = in.has("boundary") && in.text("boundary") == "fixed";
  motion.sweeps = in.has("sweeps") ? in.integer("sweeps") : motion.sweeps;
  for (const char* key : {"boundary", "sweeps"}) {
    if (motion.policy != MotionPolicy::relax && in.has(key)) {
      deck.fail_key(*in.node(key), "only with `policy = \"relax\"`");
    }
  }
}

void read_follow(Deck& deck, DeckNode& node, SceneSpec& scene) {
  Section in(node, scene_keys::motion());
  const std::vector<std::string> names = axis_names(scene.geometry);
  if (scene.motion.policy != MotionPolicy::follow) {
    for (const char* key : {"bodies", "axes", "stretch"}) {
      if (in.has(key)) {
        deck.fail_key(*in.node(key), "only with `policy = \"follow\"`");
      }
    }
    return;
  }
  if (!in.has("bodies") || in.node("bodies")->items.empty()) {
    deck.fail({node.place, node.key + ".bodies", "missing; a mesh that follows needs bodies to go with", {}});
    return;
  }
  Motion& m = scene.motion;
  const std::size_t errors_before = deck.errors().size();
  for (const int body : listed_bodies(deck, *in.node("bodies"), scene)) {
    const Body& b = scene.bodies[static_cast<std::size_t>(body)];
    if (b.material < 0) {
      deck.fail(*in.node("bodies"), fmt::format("\"{}\" is a hole", b.name), "bodies of a material");
      continue;
    }
    if (std::find(m.leaders.begin(), m.leaders.end(), b.material) == m.leaders.end()) {
      m.leaders.push_back(b.material);
    }
    for (std::size_t d = 0; d < names.size(); ++d) {
      m.axes[d] = m.axes[d] || (!in.has("axes") && b.velocity[d] != 0);
    }
  }
  const std::vector<std::string> led = in.texts("bodies");
  for (const Body& b : scene.bodies) { // the mesh knows materials, not bodies
    if (std::find(m.leaders.begin(), m.leaders.end(), b.material) != m.leaders.end() && std::find(led.begin(), led.end(), b.name) == led.end()) {
      deck.fail(*in.node("bodies"), fmt::format("\"{}\" is of a material of theirs and would draw the mesh, too", b.name),
                "all bodies of their materials, or a material of its own (`base`) for the other");
    }
  }
  if (std::find(m.leaders.begin(), m.leaders.end(), scene.background) != m.leaders.end()) {
    deck.fail(*in.node("bodies"), "the background is of a material of theirs", "bodies of other materials");
  }
  for (const std::size_t d : listed_axes(deck, in, "axes", names)) {
    m.axes[d] = true;
  }
  for (const std::size_t d : listed_axes(deck, in, "stretch", names)) {
    m.stretches[d] = true; // about the middle, which then must go along, or from a plane
    const bool from_plane = scene.boundaries[d][0].kind == BoundaryKind::symmetry;
    m.axes[d] = from_plane ? m.axes[d] && in.has("axes") : true; // from a plane it does not go unless it is told to
    if (scene.boundaries[d][1].kind != BoundaryKind::free && scene.boundaries[d][1].kind != BoundaryKind::absorbing) {
      deck.fail(*in.node("stretch"), fmt::format("the mesh would grow along {}, where its upper side is neither free nor absorbing", names[d]), "a free or absorbing side");
    }
  }
  for (std::size_t d = 0; d < names.size(); ++d) {
    const auto lets_through = [&](std::size_t side) {
      const BoundaryKind kind = scene.boundaries[d][side].kind;
      return kind == BoundaryKind::free || kind == BoundaryKind::absorbing;
    };
    const bool free = lets_through(0) && lets_through(1);
    if (m.axes[d] && (!free || (scene.geometry == Geometry::axisymmetric && d == 0))) {
      deck.fail({node.place, node.key + ".axes", fmt::format("the mesh would go along {}, where its sides are neither free nor absorbing", names[d]), "free or absorbing sides along the way"});
    }
  }
  if (deck.errors().size() == errors_before && !bodies_missing(deck, scene) && m.axes == std::array<bool, 3>{} && m.stretches == std::array<bool, 3>{}) {
    deck.fail({node.place, node.key + ".axes", "no way to go: none of the bodies has a velocity", "axes, or bodies that move"});
  }
}

} // namespace ballast
