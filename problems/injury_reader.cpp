// [injury]: what is measured, each name found, each number in range.
#include "core/cfc_filter.hpp"
#include "problems/injury_criteria.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr double most_samples = 1e6;       // of a record
constexpr double longest_in_blast = 50e-6; // s: a blast rises and falls in ms, a wall on a squeezed lung is stable up to 0.4 ms

struct Names {
  std::vector<std::string> all;
  int find(const std::string& name) const {
    const auto at = std::find(all.begin(), all.end(), name);
    return at == all.end() ? -1 : static_cast<int>(at - all.begin());
  }
};

Names gauge_names(const SceneSpec& scene) {
  Names names;
  for (const Gauge& g : scene.gauges) {
    names.all.push_back(g.name);
  }
  return names;
}

Names stack_names(const SceneSpec& scene) {
  Names names;
  for (const LayersSpec& l : scene.layers) {
    names.all.push_back(l.name);
  }
  return names;
}

/// Is a gauge or a stack of that name in the deck, though an error has kept it out of the scene?
bool declared(const Deck& deck, const char* section, const std::string& name) {
  const DeckNode* list = deck.root().find(section);
  return list != nullptr && std::any_of(list->items.begin(), list->items.end(), [&](const DeckNode& item) {
           const DeckNode* own = item.find("name");
           return own == nullptr || (own->is_text() && own->text == name);
         });
}

/// In the deck, be it right or wrong.
bool given(const Section& in, const char* key) { return in.self().find(key) != nullptr; }

void fail_name(Deck& deck, DeckNode& node, const std::string& what, const std::vector<std::string>& known) {
  const std::string meant = nearest(node.text, known);
  deck.fail(node, fmt::format("no {} is called \"{}\"{}", what, node.text, meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)),
            known.empty() ? "one that the deck has" : one_of(known));
}

/// A gauge of the deck that rides, -1 (and an error) if it is none.
int riding_gauge(Deck& deck, DeckNode* node, const SceneSpec& scene) {
  if (node == nullptr) {
    return -1;
  }
  const Names gauges = gauge_names(scene);
  const int found = gauges.find(node->text);
  if (found < 0 && !declared(deck, "gauge", node->text)) {
    fail_name(deck, *node, "gauge", gauges.all);
  } else if (found >= 0 && !scene.gauges[static_cast<std::size_t>(found)].rides) {
    deck.fail(*node, fmt::format("gauge \"{}\" stays in its place while the body moves through it", node->text), "a gauge with `rides = true`");
    return -1;
  }
  return found;
}

void read_chest(Deck& deck, const Section& in, SceneSpec& scene, InjurySpec& injury) {
  injury.sternum = riding_gauge(deck, in.node("sternum"), scene);
  injury.spine = riding_gauge(deck, in.node("spine"), scene);
  injury.chest_depth = in.number("chest_depth", 0);
  for (const char* key : {"spine", "chest_depth"}) {
    if (in.has(key) && !given(in, "sternum")) {
      deck.fail_key(*in.node(key), "is nothing without a sternum", "`sternum`, the name of a gauge");
      return;
    }
  }
  if (injury.spine >= 0 && injury.spine == injury.sternum) {
    deck.fail(*in.node("spine"), "is the sternum, too: the deflection would be zero", "another gauge");
  }
}

void read_back_face(Deck& deck, DeckNode* node, SceneSpec& scene, InjurySpec& injury) {
  if (node == nullptr) {
    return;
  }
  injury.back_face = node->text;
  const Names stacks = stack_names(scene), gauges = gauge_names(scene);
  injury.back_stack = stacks.find(node->text);
  if (injury.back_stack < 0 && gauges.find(node->text) >= 0) {
    injury.back_gauge = riding_gauge(deck, node, scene);
  } else if (injury.back_stack < 0 && !declared(deck, "layers", node->text) && !declared(deck, "gauge", node->text)) {
    Names both = stacks;
    both.all.insert(both.all.end(), gauges.all.begin(), gauges.all.end());
    fail_name(deck, *node, "stack of layers or gauge", both.all);
  }
}

void read_accelerations(Deck& deck, const Section& in, SceneSpec& scene, InjurySpec& injury) {
  if (DeckNode* list = in.node("accelerometers")) {
    for (DeckNode& item : list->items) {
      const int gauge = riding_gauge(deck, &item, scene);
      if (gauge >= 0 && std::find(injury.accelerometers.begin(), injury.accelerometers.end(), gauge) != injury.accelerometers.end()) {
        deck.fail(item, fmt::format("\"{}\" is listed twice", item.text), "each gauge once");
      } else if (gauge >= 0) {
        injury.accelerometers.push_back(gauge);
      }
    }
  } else if (injury.sternum >= 0) {
    injury.accelerometers = {injury.sternum};
  }
  for (const std::string& name : in.texts("filters")) {
    injury.filters.push_back(std::stoi(name.substr(3)));
  }
}

/// Gauges of any kind, each once.
void read_blast(Deck& deck, DeckNode* list, const SceneSpec& scene, InjurySpec& injury) {
  const Names gauges = gauge_names(scene);
  for (std::size_t k = 0; list != nullptr && k < list->items.size(); ++k) {
    DeckNode& item = list->items[k];
    const int gauge = gauges.find(item.text);
    if (std::find(injury.blast.begin(), injury.blast.end(), gauge) != injury.blast.end()) {
      deck.fail(item, fmt::format("\"{}\" is listed twice", item.text), "each gauge once");
    } else if (gauge >= 0) {
      injury.blast.push_back(gauge);
    } else if (!declared(deck, "gauge", item.text)) {
      fail_name(deck, item, "gauge", gauges.all);
    }
  }
}

/// A record coarse enough to keep, fine enough to filter.
void read_intervals(Deck& deck, const Section& in, const SceneSpec& scene, InjurySpec& injury) {
  injury.record_every = in.number("record_every", injury.record_every);
  injury.sample_every = in.number("sample_every", injury.sample_every);
  DeckNode *record = in.node("record_every"), *sample = in.node("sample_every");
  if (record == nullptr || sample == nullptr) {
    return; // has had its error
  }
  double longest = std::numeric_limits<double>::infinity();
  if (given(in, "blast_gauges") && injury.record_every > longest_in_blast) {
    deck.fail(*record, fmt::format("{:g} s is too coarse for a chest wall in blast", injury.record_every), fmt::format("at most {:g} s with `blast_gauges`", longest_in_blast));
    return;
  }
  for (const int cfc : injury.filters) {
    longest = std::min(longest, longest_interval(cfc));
  }
  const double strides = injury.sample_every / injury.record_every;
  if (injury.record_every > longest) {
    deck.fail(*record, fmt::format("{:g} s is too coarse for the filters", injury.record_every), fmt::format("at most {:g} s: ten samples to 1 / CFC", longest));
  } else if (scene.end_time / injury.record_every > most_samples) {
    deck.fail(*record, fmt::format("{:.3g} samples up to the end", scene.end_time / injury.record_every), fmt::format("at least {:g} s: a million samples", scene.end_time / most_samples));
  } else if (strides < 0.999 || std::abs(strides - std::round(strides)) > 1e-6 * strides) {
    deck.fail(sample->defaulted ? *record : *sample, fmt::format("sample_every, {:g} s, is no multiple of record_every, {:g} s", injury.sample_every, injury.record_every), "a whole number of recorded intervals to a sample");
  }
}

bool mirrored(const SceneSpec& scene, std::size_t axis) {
  return scene.boundaries[axis][0].kind == BoundaryKind::symmetry || scene.boundaries[axis][1].kind == BoundaryKind::symmetry;
}

/// How many times the scene's part of a body makes the whole: planes of symmetry along the shot halve it.
double copies_of(const SceneSpec& scene, int shot_axis) {
  double copies = 1;
  for (std::size_t axis = 0; scene.geometry == Geometry::three_d && axis < 3; ++axis) {
    copies *= static_cast<int>(axis) != shot_axis && mirrored(scene, axis) ? 2 : 1;
  }
  return copies;
}

/// Where the scene is mirrored along an axis: the axis itself, or the plane of symmetry (of two the lower).
double mirror_of(const SceneSpec& scene, std::size_t axis) {
  if (scene.geometry == Geometry::axisymmetric) {
    return 0;
  }
  const Bounds mesh = mesh_bounds(scene);
  const double plane = scene.boundaries[axis][0].kind == BoundaryKind::symmetry ? mesh.lo[axis] : mesh.hi[axis];
  return std::isfinite(plane) ? plane : 0; // no mesh: has had its error
}

/// How wide a body is across the shot, m: to both sides of planes of symmetry and of the axis.
double diameter_of(const SceneSpec& scene, const Body& body, int shot_axis) {
  const Bounds box = bounds(body.shape);
  double diameter = 0;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimensions(scene.geometry)); ++axis) {
    if (static_cast<int>(axis) == shot_axis) {
      continue;
    }
    const bool half = scene.geometry == Geometry::axisymmetric || mirrored(scene, axis);
    const double middle = half ? mirror_of(scene, axis) : 0.5 * (box.lo[axis] + box.hi[axis]);
    diameter = std::max(diameter, 2 * std::max(std::abs(box.lo[axis] - middle), std::abs(box.hi[axis] - middle)));
  }
  return diameter;
}

/// False (and an error) where the scene does not know the whole mass of what it shows.
bool knows_whole_mass(Deck& deck, DeckNode& node, const SceneSpec& scene, const char* cure) {
  if (scene.geometry == Geometry::planar) {
    deck.fail_key(node, "a planar scene knows masses by the metre only", cure);
  } else if (scene.geometry == Geometry::three_d && scene.map.curved()) {
    deck.fail_key(node, "a wedge of a curved mesh does not know what share of the whole it is", cure);
  } else {
    return true;
  }
  return false;
}

/// What else is of a material of those that hit, or flies otherwise: the energy is that of all their materials hold. Empty: nothing.
std::string stranger_among(const SceneSpec& scene, const std::vector<int>& hit) {
  for (const int h : hit) {
    const Body& first = scene.bodies[static_cast<std::size_t>(h)];
    if (first.material >= 0 && first.material == scene.background) {
      return "what fills the mesh is of the same material";
    }
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      const Body& other = scene.bodies[b];
      const bool listed = std::find(hit.begin(), hit.end(), static_cast<int>(b)) != hit.end();
      if (other.material == first.material && (!listed || other.velocity != first.velocity || other.radial)) {
        return fmt::format("\"{}\" is of the same material and {}", other.name, listed ? "has another velocity" : "not listed");
      }
    }
  }
  return "";
}

/// Bodies that hit; their diameter unless the deck gives one. False (and an error) if they cannot be used.
bool read_bodies_that_hit(Deck& deck, const Section& in, DeckNode& list, SceneSpec& scene, InjurySpec& injury) {
  if (!knows_whole_mass(deck, list, scene, "`impactor_energy` and `impactor_diameter` instead")) {
    return false;
  }
  injury.impactor = listed_bodies(deck, list, scene);
  bool moves = false, solid = true;
  double diameter = 0;
  for (const int b : injury.impactor) {
    const Body& body = scene.bodies[static_cast<std::size_t>(b)];
    moves = moves || body.velocity != Point{};
    solid = solid && body.material >= 0;
    diameter = std::max(diameter, diameter_of(scene, body, injury.axis));
  }
  injury.impactor_diameter = in.number("impactor_diameter", diameter);
  if (list.items.empty()) {
    deck.fail(list, "names no body", "at least one, or leave it out");
  } else if (injury.impactor.size() != list.items.size()) {
    return false; // has had its error
  } else if (!solid) {
    deck.fail(list, "a hole has no energy", "bodies of a material");
  } else if (!moves && !in.has("impactor_energy")) {
    deck.fail(list, "none of these moves at the start", "a body with a velocity, or `impactor_energy`");
  } else if (const std::string stranger = stranger_among(scene, injury.impactor); !stranger.empty() && !in.has("impactor_energy")) {
    deck.fail(list, stranger + ": the energy would be that of both", "`impactor_energy` and `impactor_diameter`, or another material for it");
  } else if (!std::isfinite(injury.impactor_diameter)) {
    deck.fail(list, "has no end across the shot", "`impactor_diameter`");
  } else {
    return true;
  }
  return false;
}

void read_impactor(Deck& deck, const Section& in, SceneSpec& scene, InjurySpec& injury) {
  injury.impactor_energy = in.number("impactor_energy", 0);
  injury.impactor_diameter = in.number("impactor_diameter", 0);
  injury.body_mass = in.number("body_mass", 0);
  injury.wall_thickness = in.number("wall_thickness", injury.body_mass > 0 ? body_wall_thickness(injury.body_mass) : 0);
  injury.copies = copies_of(scene, injury.axis);
  DeckNode* list = in.node("impactor");
  if (list != nullptr && !read_bodies_that_hit(deck, in, *list, scene, injury)) {
    return;
  }
  const bool energy = given(in, "impactor_energy") || list != nullptr, diameter = given(in, "impactor_diameter") || list != nullptr;
  if (energy != diameter) {
    deck.fail_key(*in.self().find(energy ? "impactor_energy" : "impactor_diameter"), fmt::format("needs `{}`, too", energy ? "impactor_diameter" : "impactor_energy"), "both, or `impactor`, a list of bodies");
  } else if (in.has("body_mass") && !energy) {
    deck.fail_key(*in.node("body_mass"), "is nothing without what hits it", "`impactor`, or `impactor_energy` and `impactor_diameter`");
  } else if (in.has("wall_thickness") && !given(in, "body_mass")) {
    deck.fail_key(*in.node("wall_thickness"), "is nothing without `body_mass`", "both");
  }
}

/// How is nothing without what.
void check_asked(Deck& deck, DeckNode& node) {
  const std::vector<std::string> how = {"direction", "filters", "record_every", "sample_every"};
  if (std::all_of(node.fields.begin(), node.fields.end(), [&](const auto& field) { return std::find(how.begin(), how.end(), field.first) != how.end(); })) {
    deck.fail_key(node, "asks for nothing", "`sternum`, `back_face`, `accelerometers`, `organs`, `force_on`, `blast_gauges` or `impactor`, or no [injury]");
  }
}

void read_direction_of(Deck& deck, const Section& in, const SceneSpec& scene, InjurySpec& injury) {
  const bool shot = !scene.results.bullet.empty() && scene.bodies[static_cast<std::size_t>(scene.results.bullet.front())].velocity != Point{};
  injury.axis = shot ? scene.results.shot_axis : dimensions(scene.geometry) - 1;
  injury.direction = shot ? scene.results.shot_direction : 1;
  if (DeckNode* node = in.node("direction")) {
    if (const auto way = node->text.empty() ? std::nullopt : read_direction(deck, node->text, scene.geometry, *node)) {
      for (int axis = 0; axis < 3; ++axis) {
        const double part = (*way)[static_cast<std::size_t>(axis)];
        injury.axis = part != 0 ? axis : injury.axis;
        injury.direction = part != 0 ? part : injury.direction;
      }
    } else if (node->text.empty()) {
      deck.fail(*node, "is empty", "`+z` and the like");
    }
  }
}

} // namespace

void read_injury(Deck& deck, DeckNode& node, SceneSpec& scene) {
  const Section in = read_section(deck, node, scene_keys::injury());
  InjurySpec injury;
  read_direction_of(deck, in, scene, injury);
  read_chest(deck, in, scene, injury);
  read_back_face(deck, in.node("back_face"), scene, injury);
  read_accelerations(deck, in, scene, injury);
  read_blast(deck, in.node("blast_gauges"), scene, injury);
  read_intervals(deck, in, scene, injury);
  injury.organs = listed_materials(deck, in.node("organs"), scene);
  injury.force_on = listed_materials(deck, in.node("force_on"), scene);
  read_impactor(deck, in, scene, injury);
  if (DeckNode* list = in.node("force_on")) {
    if (knows_whole_mass(deck, *list, scene, "no `force_on`, or another mesh") && in.has("filters") && injury.filters.empty()) {
      deck.fail_key(*list, "needs a filter, and `filters` is empty", "at least one, such as `filters = [\"CFC1000\"]`");
    }
  }
  check_asked(deck, node);
  scene.injury = injury;
}

} // namespace ballast
