#include "problems/scene_reader.hpp"

#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

/// The table of that name, made empty where the deck has none so that defaults have a place.
DeckNode& table_of(DeckNode& root, const std::string& name) {
  if (DeckNode* found = root.find(name)) {
    return *found;
  }
  DeckNode made;
  made.key = name;
  made.place = root.place;
  made.defaulted = true;
  root.fields.emplace_back(name, std::move(made));
  return root.fields.back().second;
}

void read_ambient(Deck& deck, DeckNode& node, SceneSpec& scene) {
  const Section in = read_section(deck, node, scene_keys::ambient());
  scene.ambient_pressure = in.number("pressure", scene.ambient_pressure);
  scene.ambient_temperature = in.number("temperature", scene.ambient_temperature);
}

/// What has strength has it at the start.
void check_melting(Deck& deck, DeckNode& ambient, const SceneSpec& scene) {
  std::string molten;
  for (const Material& m : scene.materials) {
    if (has_strength(m.strength) && m.melt_temperature > 0 && m.melt_temperature <= scene.ambient_temperature) {
      molten += fmt::format("{}{} melts at {:g} K", molten.empty() ? "" : ", ", m.name, m.melt_temperature);
    }
  }
  if (DeckNode* temperature = ambient.find("temperature"); !molten.empty() && temperature != nullptr) {
    deck.fail(*temperature, fmt::format("at {:g} K these have no strength left: {}", scene.ambient_temperature, molten), "a temperature below, or `strength = \"none\"` for them");
  }
}

/// Onion-skin order: the listed materials, then the rest in order of use.
std::vector<int> interface_order(Deck& deck, DeckNode* list, const SceneSpec& scene) {
  std::vector<int> order = listed_materials(deck, list, scene);
  for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i) {
    if (std::find(order.begin(), order.end(), i) == order.end()) {
      order.push_back(i);
    }
  }
  return order;
}

/// What slides needs something to slide along, and a remap that brings them together.
std::vector<int> sliding_materials(Deck& deck, DeckNode* list, const SceneSpec& scene) {
  const std::vector<int> sliding = listed_materials(deck, list, scene);
  const bool outflow = std::any_of(scene.boundaries.begin(), scene.boundaries.end(), [](const auto& sides) {
    return sides[0].kind == BoundaryKind::outflow || sides[1].kind == BoundaryKind::outflow;
  });
  if (!sliding.empty() && sliding.size() == scene.materials.size() && !bodies_missing(deck, scene)) {
    deck.fail_key(*list, "leaves nothing to slide along", "some of the materials, not all");
  } else if (!sliding.empty() && scene.motion.policy == MotionPolicy::lagrangian) {
    deck.fail_key(*list, "needs a remapped mesh: without a remap nothing slides", "motion.policy = \"eulerian\", or no sliding");
  } else if (!sliding.empty() && scene.motion.policy == MotionPolicy::relax) {
    deck.fail_key(*list, "needs a mesh that is rectilinear after each remap, which a relaxed one is not", "motion.policy = \"eulerian\" or \"follow\", or no sliding");
  } else if (!sliding.empty() && scene.map.curved()) {
    deck.fail_key(*list, "needs a rectilinear mesh: its walls are across the axes", "a mesh without `map`, or no sliding");
  } else if (!sliding.empty() && outflow) {
    deck.fail_key(*list, "does not work with an outflow side: it holds one velocity a node", "other sides (free, wall), or no sliding");
  }
  return sliding;
}

/// The merit factor, checked against what knows no subzones.
double subzonal_pressure(Deck& deck, const Section& in, const SceneSpec& scene) {
  const double merit = in.number("subzonal_pressure", 0);
  if (merit > 0 && (scene.geometry == Geometry::three_d || scene.motion.remaps())) {
    deck.fail_key(*in.node("subzonal_pressure"), "a cell's quarters are known in 2D, as long as the mesh is Lagrangian", "0");
  }
  return merit;
}

/// A smallest step that the largest or the whole run falls short of ends every run in its first step.
void check_steps(Deck& deck, const Section& in, const SceneSpec& scene) {
  const Numerics& n = scene.numerics;
  DeckNode* least = in.node("dt_min");
  if (least != nullptr && scene.end_time > 0 && n.dt_min > scene.end_time) {
    deck.fail(*least, fmt::format("{:g} s is more than the whole run, {:g} s", n.dt_min, scene.end_time), "a time far below every stable step, or leave it out");
  } else if (n.dt_min > n.dt_max) {
    deck.fail(least != nullptr ? *least : *in.node("dt_max"), fmt::format("no step is left between dt_min, {:g} s, and dt_max, {:g} s", n.dt_min, n.dt_max),
              "dt_min below dt_max");
  }
}

void read_numerics(Deck& deck, DeckNode& node, SceneSpec& scene) {
  const Section in = read_section(deck, node, scene_keys::numerics());
  Numerics& n = scene.numerics;
  n.cfl = in.number("cfl", n.cfl);
  n.closure = static_cast<Closure>(in.choice("closure"));
  n.quadratic_q = in.number("quadratic_q", n.quadratic_q);
  n.linear_q = in.number("linear_q", n.linear_q);
  n.hourglass = in.number("hourglass", n.hourglass);
  n.shear_q = in.number("shear_q", n.shear_q);
  n.subzonal_pressure = subzonal_pressure(deck, in, scene);
  scene.energy_return = static_cast<Switch>(in.choice("energy_return"));
  n.normal = static_cast<remap::NormalMethod>(in.choice("normal"));
  scene.interface_order = interface_order(deck, in.node("interface_order"), scene);
  scene.sliding = sliding_materials(deck, in.node("sliding"), scene);
  n.dt_initial = in.number("dt_initial", n.dt_initial);
  n.dt_growth = in.number("dt_growth", n.dt_growth);
  n.dt_max = in.number("dt_max", n.dt_max);
  n.dt_min = in.number("dt_min", n.dt_min);
  check_steps(deck, in, scene);
  n.spall = in.flag("spall");
  n.sleeping = in.flag("sleeping");
  n.tissue.path = std::array{BranchPath::adaptive, BranchPath::mixed, BranchPath::cvode}[static_cast<std::size_t>(in.choice("tissue_path"))];
  n.tissue.tolerance = in.number("tissue_tolerance", n.tissue.tolerance);
  n.tissue.cvode.tolerance = 0.1 * n.tissue.tolerance;
}

/// Checks the length and that the point lies in the mesh.
bool check_gauge_place(Deck& deck, DeckNode& at, const SceneSpec& scene) {
  const std::vector<std::string> names = axis_names(scene.geometry);
  const Bounds mesh = mesh_bounds(scene);
  if (at.items.size() != names.size()) {
    deck.fail(at,
              fmt::format("{} coordinates in a {} scene", at.items.size(), name_of(scene.geometry)),
              fmt::format("{}, one an axis", names.size()));
    return false;
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double x = at.items[k].number;
    if (x < mesh.lo[k] || x > mesh.hi[k]) {
      deck.fail(at.items[k],
                fmt::format("{:g} m lies outside the mesh", x),
                fmt::format("{} from {:g} to {:g} m", names[k], mesh.lo[k], mesh.hi[k]));
      return false;
    }
  }
  return true;
}

void read_gauges(Deck& deck, DeckNode* list, SceneSpec& scene) {
  for (std::size_t i = 0; list != nullptr && i < list->items.size(); ++i) {
    const Section in = read_section(deck, list->items[i], scene_keys::gauge());
    Gauge gauge{in.text("name"), point_of(in.numbers("at")), in.flag("rides"), in.texts("record")};
    for (const Gauge& other : scene.gauges) {
      if (in.has("name") && other.name == gauge.name) {
        deck.fail(*in.node("name"),
                  fmt::format("there is another gauge called \"{}\"", gauge.name),
                  "a name of its own");
        break;
      }
    }
    if (in.has("at") && check_gauge_place(deck, *in.node("at"), scene)) {
      scene.gauges.push_back(std::move(gauge));
    }
  }
}

void read_output(Deck& deck, DeckNode& node, Output& output) {
  const Section in = read_section(deck, node, scene_keys::output());
  output.fields_every = in.number("fields_every", output.fields_every);
  output.fields = in.texts("fields");
  output.history_every = in.number("history_every", output.history_every);
  output.checkpoint_every = in.number("checkpoint_every", output.checkpoint_every);
}

void read_bullet(Deck& deck, DeckNode& list, SceneSpec& scene) {
  scene.results.bullet = listed_bodies(deck, list, scene);
  for (const int body : scene.results.bullet) {
    scene.results.bullet_names.push_back(scene.bodies[static_cast<std::size_t>(body)].name);
  }
}

/// The axis of flight, and the face of the target that meets the bullet first.
void find_shot(SceneSpec& scene) {
  Results& r = scene.results;
  if (r.bullet.empty()) {
    return;
  }
  const Body& first_body = scene.bodies[static_cast<std::size_t>(r.bullet.front())];
  if (first_body.velocity == Point{}) {
    return;
  }
  const Point& u = first_body.aim == Point{} ? first_body.velocity : first_body.aim;
  const auto axis = static_cast<std::size_t>(
      std::max_element(
          u.begin(), u.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }) -
      u.begin());
  r.shot_axis = static_cast<int>(axis);
  r.shot_direction = first_body.velocity[axis] < 0 ? -1 : 1;
  for (const Body& b : scene.bodies) {
    if (b.material < 0 || b.material != r.target) {
      continue;
    }
    const Bounds extent = bounds(b.shape);
    const double face = r.shot_direction > 0 ? extent.lo[axis] : extent.hi[axis];
    const bool first = std::isnan(r.target_face) || r.shot_direction * (face - r.target_face) < 0;
    r.target_face = first ? face : r.target_face;
  }
}

void read_results(Deck& deck, DeckNode& node, SceneSpec& scene) {
  const Section in = read_section(deck, node, scene_keys::results());
  if (DeckNode* bullet = in.node("bullet")) {
    read_bullet(deck, *bullet, scene);
  }
  if (in.has("target") && scene.map.curved()) {
    deck.fail_key(*in.node("target"), "a cavity is measured along rows across the shot", "a mesh without `map`");
  } else if (in.has("target")) {
    std::vector<std::string> names;
    for (const Material& m : scene.materials) {
      names.push_back(m.name);
    }
    const auto at = std::find(names.begin(), names.end(), in.text("target"));
    if (at == names.end() && bodies_missing(deck, scene)) {
      return; // it may be of one of those
    }
    if (at == names.end()) {
      deck.fail(*in.node("target"),
                fmt::format("\"{}\" is in no body", in.text("target")),
                one_of(names));
    } else {
      scene.results.target = static_cast<int>(at - names.begin());
    }
  }
  find_shot(scene);
}

void read_background(Deck& deck, const Section& top, MaterialBook& book, SceneSpec& scene) {
  DeckNode* node = top.node("background");
  if (node == nullptr) {
    return;
  }
  scene.background = book.index(deck, node->text, *node).value_or(-1);
  if (scene.background >= 0 && scene.ambient_pressure == 0 && book.used().size() > 1 &&
      std::holds_alternative<IdealGas>(book.used()[static_cast<std::size_t>(scene.background)].eos)) {
    deck.fail(*node, fmt::format("{} at no pressure beside other materials: it would have neither stiffness nor warmth", node->text),
              "an `ambient.pressure`, or `void`");
  }
  if (scene.bodies.empty() && scene.background < 0 && deck.clean()) {
    deck.fail(
        {top.self().place, "body", "the scene is empty", "at least one [[body]], or a background"});
  }
}

/// Tables that every scene has, given or not; a value of another type has been reported already.
DeckNode* usable(DeckNode& root, const std::string& name) {
  DeckNode& node = table_of(root, name);
  return node.is_table() ? &node : nullptr;
}

} // namespace

SceneSpec read_scene(Deck& deck) {
  SceneSpec scene;
  if (!deck.clean()) {
    return scene; // not even TOML
  }
  DeckNode& root = deck.root();
  for (const char* name : {"ambient", "motion", "numerics", "output"}) {
    table_of(root, name); // before any pointer into the tree is kept
  }
  const Section top = read_section(deck, root, scene_keys::top());
  scene.title = top.text("title");
  scene.end_time = top.number("end_time", 0);
  constexpr double hopeless = 1e-10; // of the run: with such steps it would not end
  scene.numerics.dt_min = hopeless * scene.end_time;
  if (DeckNode* ambient = usable(root, "ambient")) {
    read_ambient(deck, *ambient, scene);
  }
  MaterialBook book(deck, top.node("materials"), scene.ambient_pressure, scene.ambient_temperature);
  if (DeckNode* motion = usable(root, "motion")) {
    read_motion(deck, *motion, scene.motion);
  }
  if (DeckNode* output = usable(root, "output")) {
    read_output(deck, *output, scene.output);
  }
  if (const DeckNode* numerics = root.find("numerics")) { // what bodies may start with depends on it
    const DeckNode* spall = numerics->find("spall");
    scene.numerics.spall = spall == nullptr || spall->kind != DeckNode::Kind::flag || spall->flag;
  }
  const bool has_geometry = top.has("geometry");
  if (has_geometry) {
    scene.geometry = static_cast<Geometry>(top.choice("geometry"));
    if (DeckNode* symmetry = top.node("symmetry");
        symmetry != nullptr && scene.geometry != Geometry::three_d && !symmetry->items.empty()) {
      deck.fail_key(*symmetry, "only in a 3d scene", "`lower = \"symmetry\"` in [mesh.AXIS]");
    }
    // The mesh first, so that bodies and gauges can be placed against it; an inflow's material then
    // follows those of the bodies only if bodies name it too.
    if (DeckNode* mesh = top.node("mesh")) {
      read_mesh(deck, *mesh, top.texts("symmetry"), book, scene);
      if (DeckNode* symmetry = top.node("symmetry"); symmetry != nullptr && scene.map.curved() && !symmetry->items.empty()) {
        deck.fail_key(*symmetry, "only with a rectilinear mesh", "sides of [mesh.AXIS]: planes through the centre are symmetric");
      }
    }
    read_bodies(deck, top.node("body"), book, scene);
    read_background(deck, top, book, scene);
    scene.materials = book.used();
    if (DeckNode* motion = usable(root, "motion")) {
      read_follow(deck, *motion, scene);
    }
    read_gauges(deck, top.node("gauge"), scene);
    if (DeckNode* results = top.node("results")) {
      read_results(deck, *results, scene);
    }
    read_layers(deck, top.node("layers"), top.node("fabrics"), book, scene);
    scene.materials = book.used();
    if (DeckNode* ambient = usable(root, "ambient")) {
      check_melting(deck, *ambient, scene);
    }
    if (DeckNode* injury = top.node("injury")) {
      read_injury(deck, *injury, scene);
    }
  }
  if (DeckNode* numerics = usable(root, "numerics")) {
    read_numerics(deck, *numerics, scene);
  }
  return scene;
}

ReadScene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  Deck deck = Deck::load(path, overrides);
  SceneSpec scene = read_scene(deck);
  deck.throw_if_errors();
  return {std::move(scene), write_toml(deck.root()), deck.text()};
}

} // namespace ballast
