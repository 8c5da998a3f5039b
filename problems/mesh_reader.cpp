// [mesh]: graded lines and boundaries of each axis.
#include "problems/line_reader.hpp"
#include "problems/mesh_map_reader.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {


struct Context {
  Deck& deck;
  MaterialBook& book;
  SceneSpec& scene;
  std::size_t dim() const { return static_cast<std::size_t>(dimensions(scene.geometry)); }
};

void read_wall(Context c, const Section& in, Boundary& side) {
  if (DeckNode* velocity = in.node("velocity")) {
    read_quantity(c.deck, *velocity, Dimension::velocity, scene_keys::speeds());
    side.wall_velocity = in.number("velocity", 0);
    if (side.wall_velocity != 0 && !sides_go_along(c.scene.motion)) {
      const bool fixed = c.scene.motion.policy == MotionPolicy::relax;
      c.deck.fail(*velocity, fixed ? "a moving wall on a mesh whose boundary stays where it is" : "a moving wall on a mesh whose sides do not go along with it",
                  fixed ? "motion.boundary = \"lagrangian\", or a wall at rest" : "motion.policy = \"lagrangian\" or \"relax\", or a wall at rest");
    }
  }
}

/// What comes in must come in, and only remaps bring it.
void check_inflow(Context c, const Section& in, std::size_t axis, std::size_t s, const Boundary& side) {
  if (c.scene.motion.policy == MotionPolicy::lagrangian) {
    c.deck.fail(*in.node("type"),
                "nothing flows into a lagrangian mesh: only a remap brings material in",
                "motion.policy = \"eulerian\", or a wall with this velocity");
  } else if (c.scene.motion.policy == MotionPolicy::relax && !c.scene.motion.fixed_boundary) {
    c.deck.fail(*in.node("type"), "nothing flows in where the mesh's boundary goes with the material", "motion.boundary = \"fixed\"");
  } else if (!((s == 0 ? 1 : -1) * side.velocity[axis] > 0)) {
    c.deck.fail(*in.node("velocity"),
                fmt::format("{:g} m/s along {} does not point into the mesh",
                            side.velocity[axis],
                            axis_names(c.scene.geometry)[axis]),
                s == 0 ? "a component above 0 at the lower side" : "a component below 0 at the upper side");
  }
}

void read_inflow(Context c, const Section& in, std::size_t axis, std::size_t s, Boundary& side) {
  for (const char* key : {"material", "velocity"}) {
    if (in.self().find(key) == nullptr) {
      c.deck.fail({in.self().place, in.self().key + "." + key, "missing; an inflow needs it", {}});
    }
  }
  if (DeckNode* velocity = in.node("velocity")) {
    if (read_quantities(c.deck, *velocity, Dimension::velocity, scene_keys::speeds(), c.dim(), c.dim())) {
      side.velocity = point_of(numbers_of(*velocity));
      check_inflow(c, in, axis, s, side);
    }
  }
  if (!in.has("material")) {
    return;
  }
  const auto material = c.book.index(c.deck, in.text("material"), *in.node("material"));
  if (!material) {
    return;
  }
  if (*material < 0) {
    c.deck.fail(*in.node("material"), "nothing can flow in from a void", "a material");
    return;
  }
  side.material = *material;
  c.scene.materials = c.book.used();
  const Material& m = c.scene.materials[static_cast<std::size_t>(*material)];
  side.density = in.number("density", m.density);
  const StartState start = start_state(c.deck, in, m, side.density, c.scene.ambient_pressure);
  side.pressure = start.pressure;
  side.specific_energy = start.specific_energy;
}

void refuse_keys(Context c,
                 const Section& in,
                 std::initializer_list<const char*> keys,
                 const std::string& kind) {
  for (const char* key : keys) {
    if (in.has(key)) {
      c.deck.fail_key(*in.node(key), fmt::format("a {} boundary does not take it", kind));
    }
  }
}

Boundary read_boundary(Context c, DeckNode& node, std::size_t axis, std::size_t s) {
  Boundary side;
  if (node.is_text()) { // a bare word is a table of that type
    DeckNode type = node;
    type.key = node.key;
    node.kind = DeckNode::Kind::table;
    node.text.clear();
    node.fields.emplace_back("type", std::move(type));
  }
  if (!node.is_table()) {
    c.deck.fail(node,
                fmt::format("{} is not a boundary", describe(node)),
                "symmetry, free, wall, outflow or a table");
    return side;
  }
  const Section in = read_section(c.deck, node, scene_keys::boundary());
  if (!in.has("type")) {
    return side;
  }
  const auto kind = static_cast<BoundaryKind>(in.choice("type"));
  if (c.scene.map.curved() && !check_mapped_side(c.deck, *in.node("type"), c.scene, static_cast<int>(axis), static_cast<int>(s), kind)) {
    node.bad = true;
    return side;
  }
  side.kind = kind;
  if (side.kind == BoundaryKind::inflow) {
    read_inflow(c, in, axis, s, side);
    return side;
  }
  refuse_keys(c, in, {"material", "density", "pressure"}, in.text("type"));
  if (side.kind == BoundaryKind::wall) {
    read_wall(c, in, side);
  } else {
    refuse_keys(c, in, {"velocity"}, in.text("type"));
  }
  return side;
}

void add_text(DeckNode& table, const std::string& key, const std::string& text) {
  add_default(table, key, DeckNode::Kind::text).text = text;
}

void read_mapped_sides(Context c, const Section& in, std::size_t axis) {
  DeckNode& table = in.self();
  const char* const keys[2] = {"lower", "upper"};
  for (std::size_t s = 0; s < 2 && !c.scene.mesh_lines[axis].empty(); ++s) {
    const MappedSide side = mapped_side(c.scene, static_cast<int>(axis), static_cast<int>(s));
    if (table.find(keys[s]) == nullptr) {
      add_text(table, keys[s], side.cuts_the_body ? "symmetry" : "free");
    }
    DeckNode& node = *table.find(keys[s]);
    Boundary& b = c.scene.boundaries[axis][s];
    b = read_boundary(c, node, axis, s);
    if (side.axis && !node.bad && b.kind != BoundaryKind::symmetry) {
      c.deck.fail(node, "r = 0 is the axis", "symmetry, or leave it out");
    }
  }
}

void read_sides(Context c, const Section& in, std::size_t axis, bool symmetric) {
  if (c.scene.map.curved()) {
    read_mapped_sides(c, in, axis);
    return;
  }
  DeckNode& table = in.self();
  const bool on_axis = c.scene.geometry == Geometry::axisymmetric && axis == 0;
  const bool starts_at_axis = on_axis && in.number("from", 1) == 0;
  if (table.find("lower") == nullptr) {
    add_text(table, "lower", symmetric || starts_at_axis ? "symmetry" : "free");
  }
  if (table.find("upper") == nullptr) {
    add_text(table, "upper", "free");
  }
  auto& sides = c.scene.boundaries[axis];
  sides[0] = read_boundary(c, *table.find("lower"), axis, 0);
  sides[1] = read_boundary(c, *table.find("upper"), axis, 1);
  DeckNode& lower = *table.find("lower");
  if ((symmetric || starts_at_axis) && !lower.bad && sides[0].kind != BoundaryKind::symmetry) {
    c.deck.fail(lower,
                symmetric ? "contradicts `symmetry` at the top of the deck" : "r = 0 is the axis",
                "symmetry, or leave it out");
  }
  if (on_axis && in.number("from", 0) < 0) {
    c.deck.fail(*in.node("from"), "a radius below 0", "0 or more");
  }
}

} // namespace

void read_mesh(Deck& deck,
               DeckNode& mesh,
               const std::vector<std::string>& symmetry,
               MaterialBook& book,
               SceneSpec& scene) {
  const Context c{deck, book, scene};
  if (!read_map(deck, mesh, scene)) {
    return;
  }
  const std::vector<std::string> names = mesh_axis_names(scene);
  double refine = 1;
  for (auto& [name, node] : mesh.fields) {
    if (name == "map" || name == "outer_radius" || name == "centre" || name == "outline") {
      continue; // read_map
    }
    if (name == "refine") {
      refine = read_quantity(deck, node, Dimension::none, scene_keys::mesh().keys[0].range) ? node.number : 1;
    } else if (std::find(names.begin(), names.end(), name) == names.end()) {
      deck.fail_key(
          node, scene.map.curved() ? std::string("no axis of this map") : fmt::format("no axis of a {} scene", name_of(scene.geometry)), one_of(names));
    }
  }
  double cells = 1;
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    DeckNode* node = mesh.find(names[axis]);
    if (node == nullptr) {
      deck.fail({mesh.place,
                 mesh.key + "." + names[axis],
                 "missing",
                 "a table { from = ..., to = ..., size = ... }"});
      continue;
    }
    if (!node->is_table()) {
      deck.fail(*node,
                fmt::format("{} is not wanted here", describe(*node)),
                "a table { from, to, size }");
      continue;
    }
    const Dimension dimension = mesh_axis_dimension(scene.map, static_cast<int>(axis));
    add_outline_ends(*node, scene, static_cast<int>(axis));
    const Section in = read_section(deck, *node, scene_keys::mesh_axis(dimension));
    scene.mesh_lines[axis] = read_lines(deck, in, refine, dimension);
    if (!check_mapped_axis(deck, *node, scene, static_cast<int>(axis))) {
      scene.mesh_lines[axis].clear();
    }
    const bool symmetric =
        std::find(symmetry.begin(), symmetry.end(), names[axis]) != symmetry.end();
    read_sides(c, in, axis, symmetric);
    cells *= static_cast<double>(std::max<std::size_t>(1, scene.mesh_lines[axis].size()) - 1);
  }
  if (cells > most_cells) {
    deck.fail(
        {mesh.place, mesh.key, fmt::format("makes {:.3g} cells", cells), "2e8 cells at most"});
  }
}

} // namespace ballast
