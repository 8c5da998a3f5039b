// [[layers]]: stacks of fabric layers.
#include "problems/fabric_reader.hpp"
#include "problems/line_reader.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

struct Context {
  Deck& deck;
  const FabricBook& book;
  SceneSpec& scene;
  MaterialBook& materials;
  std::size_t dim() const { return static_cast<std::size_t>(dimensions(scene.geometry)); }
  std::size_t across() const { return dim() - 1; } ///< axes in the plane of the layers; the last is the shot's
};

/// Does the mesh end at a plane of symmetry where this coordinate is 0?
bool cut_at_zero(const SceneSpec& scene, std::size_t component) {
  const auto dim = static_cast<std::size_t>(dimensions(scene.geometry));
  for (std::size_t axis = 0; axis < dim; ++axis) {
    for (std::size_t side = 0; side < 2 && !scene.mesh_lines[axis].empty(); ++side) {
      Point q{};
      for (std::size_t d = 0; d < dim; ++d) {
        q[d] = scene.mesh_lines[d].empty() ? 0.0 : scene.mesh_lines[d].back();
      }
      q[axis] = side == 0 ? scene.mesh_lines[axis].front() : scene.mesh_lines[axis].back();
      if (scene.boundaries[axis][side].kind == BoundaryKind::symmetry && normal_component(scene.map, static_cast<int>(axis), q[axis]) == static_cast<int>(component) &&
          place(scene.map, q)[component] == 0) {
        return true;
      }
    }
  }
  return false;
}

/// The same plies over another thickness: as much yarn carries the load of a width. Stresses of yarns and of their shear go with
/// density; the transverse law by strain and an isotropic solid are as they are.
void spread(FabricModel& model, double denser) {
  if (auto* law = std::get_if<RaftenbergFabric>(&model)) {
    for (YarnFamily* y : {&law->warp, &law->fill}) {
      for (double* k : {&y->fit.a, &y->fit.b, &y->fit.c, &y->fit.d}) {
        *k *= denser;
      }
    }
    for (double* k : {&law->in_plane.modulus, &law->in_plane.stiffer, &law->in_plane.stiffest, &law->coupling}) {
      *k *= denser;
    }
  }
}

/// Of the three only two are free; what is not given is that of `plies` plies of the fabric.
bool read_weight(Context c, const Section& in, const FabricMaterial& fabric, LayersSpec& out) {
  for (const char* key : {"areal_density", "thickness", "density", "plies"}) {
    if (in.self().find(key) != nullptr && !in.has(key)) {
      return false; // reported
    }
  }
  const bool known = fabric.thickness > 0; // of a new fabric nothing is known of its plies
  out.plies = in.has("plies") ? in.integer("plies") : known ? fabric.plies : out.layers;
  const bool a = in.has("areal_density"), t = in.has("thickness"), d = in.has("density");
  double areal = in.number("areal_density"), thickness = in.number("thickness"), rho = in.number("density");
  const double ply = known ? density(fabric.model) * fabric.thickness / fabric.plies : 0.0; // kg/m2
  if (known && a && !in.has("plies")) {
    out.plies = static_cast<int>(std::max(1L, std::lround(areal / ply)));
  }
  if (!known && a + t + d < 2) {
    c.deck.fail({in.self().place, in.self().key + ".thickness", fmt::format("missing; nothing is known of the plies of \"{}\"", out.fabric), "two of areal_density, thickness and density"});
    return false;
  }
  const double share = known ? static_cast<double>(out.plies) / fabric.plies : 0.0;
  if (!t) {
    thickness = a && d ? areal / rho : share * fabric.thickness;
  }
  if (!a) {
    areal = d ? rho * thickness : share * density(fabric.model) * fabric.thickness;
  }
  constexpr double printed = 1e-3; // four printed digits
  if (d && std::abs(areal - rho * thickness) > printed * areal) {
    c.deck.fail(*in.node("density"), fmt::format("{:g} kg/m3 contradicts areal_density over thickness: {:g} kg/m2 / {:g} m = {:g} kg/m3", rho, areal, thickness, areal / thickness),
                "two of areal_density, thickness and density");
    return false;
  }
  rho = d ? rho : areal / thickness;
  constexpr double weave = 0.05; // plies of one cloth weigh the same within that
  if (known && in.has("plies") && std::abs(rho * thickness - out.plies * ply) > weave * rho * thickness) {
    c.deck.fail(*in.node("plies"), fmt::format("{} plies of \"{}\" weigh {:.4g} kg/m2, the stack {:.4g} kg/m2", out.plies, out.fabric, out.plies * ply, rho * thickness),
                fmt::format("plies = {}, another weight, or a fabric of its own in [fabrics]", std::max(1L, std::lround(rho * thickness / ply))));
    return false;
  }
  if (known) {
    spread(out.model, rho / density(fabric.model));
    out.plies = in.has("plies") ? out.plies : static_cast<int>(std::max(1L, std::lround(rho * thickness / ply)));
  }
  std::visit([rho](auto& law) { law.density = rho; }, out.model);
  out.thickness = thickness;
  if (out.layers > out.plies) {
    DeckNode& blame = *in.node(in.node("layers")->defaulted && in.has("plies") ? "plies" : "layers");
    c.deck.fail(blame, fmt::format("{} layers of {} plies", out.layers, out.plies), "at most one layer a ply, or more `plies`");
    return false;
  }
  return true;
}

/// "both" leaves warp along radii and fill along circles.
void choose_yarns(Context c, const Section& in, LayersSpec& out) {
  if (!in.has("yarns")) {
    return;
  }
  auto* law = std::get_if<RaftenbergFabric>(&out.model);
  if (c.scene.geometry != Geometry::axisymmetric || law == nullptr) {
    c.deck.fail_key(*in.node("yarns"), law == nullptr ? "an isotropic fabric has no yarns" : fmt::format("in a {} scene yarns lie along the axes", name_of(c.scene.geometry)), "leave it out");
    return;
  }
  const std::string yarns = in.text("yarns");
  if (yarns == "warp") {
    law->fill = law->warp;
  } else if (yarns == "fill") {
    law->warp = law->fill;
  }
}

void check_fabric(Context c, const Section& in, const LayersSpec& out) {
  try {
    check(out.model, out.name);
  } catch (const Error& error) {
    c.deck.fail(*in.node("fabric"), error.what(), "another density, or constants that go with it");
  }
}

/// Lines from the middle to the half width, mirrored where the stack is whole.
bool read_plane(Context c, const Section& in, LayersSpec& out) {
  if (!in.has("half_width") || !check_size_or_cells(c.deck, in)) {
    return false;
  }
  LinePlaces places;
  if (DeckNode* to = in.node("to")) {
    places.to = read_places(c.deck, *to, Dimension::length, positive());
    for (std::size_t i = 0; i < places.to.size(); ++i) {
      places.nodes.push_back(&entry(*to, i));
    }
    if (places.to.empty()) {
      return false;
    }
  }
  places.to.push_back(in.number("half_width"));
  places.nodes.push_back(in.node("half_width"));
  const std::vector<double> half = lines_through(c.deck, in, places, in.number("refine", 1), Dimension::length);
  for (std::size_t axis = 0; axis < c.across() && !half.empty(); ++axis) {
    std::vector<double>& lines = out.lines[axis];
    const bool cut = c.scene.geometry == Geometry::axisymmetric || cut_at_zero(c.scene, axis);
    for (std::size_t i = half.size(); !cut && i-- > 1;) {
      lines.push_back(-half[i]);
    }
    lines.insert(lines.end(), half.begin(), half.end());
    out.edge[axis][0] = cut ? LayerEdge::symmetry : out.edge[axis][1];
  }
  return !half.empty();
}

void read_edges(Context c, const Section& in, LayersSpec& out) {
  const std::string kind = in.text("edges", "free");
  const LayerEdge edge = kind == "fixed" ? LayerEdge::fixed : kind == "elastic" ? LayerEdge::elastic : LayerEdge::free;
  for (std::size_t axis = 0; axis < c.across(); ++axis) {
    out.edge[axis] = {edge, edge};
  }
  out.edge_stiffness = in.number("edge_stiffness", 0);
  if (edge == LayerEdge::elastic && in.self().find("edge_stiffness") == nullptr) {
    c.deck.fail({in.self().place, in.self().key + ".edge_stiffness", "missing; elastic edges need it", "N/m for a metre of edge"});
  } else if (edge != LayerEdge::elastic && in.has("edge_stiffness")) {
    c.deck.fail_key(*in.node("edge_stiffness"), fmt::format("has no effect on {} edges", kind), "edges = \"elastic\", or leave it out");
  }
}

void read_methods(Context c, const Section& in, LayersSpec& out) {
  out.friction = in.number("friction", 0);
  out.hourglass.stiffness = in.number("hourglass", out.hourglass.stiffness);
  out.hourglass.viscosity = in.number("hourglass_viscosity", out.hourglass.viscosity);
  out.guard.shortest = in.number("shortest", out.guard.shortest);
  out.guard.volume = in.number("least_volume", out.guard.volume);
  out.guard.torn = in.number("erode_volume", out.guard.torn);
  out.guard.either = in.has("erode_when") && in.node("erode_when")->text == "either";
  out.viscosity.quadratic = in.number("quadratic_q", out.viscosity.quadratic);
  out.viscosity.linear = in.number("linear_q", out.viscosity.linear);
  out.cfl = in.number("cfl", out.cfl);
  out.rate_time = in.number("rate_time", out.rate_time);
  const auto* law = std::get_if<RaftenbergFabric>(&out.model);
  if (in.has("rate_time") && (law == nullptr || !law->rate)) {
    c.deck.fail_key(*in.node("rate_time"), fmt::format("{} has no rate factor", out.fabric), "a fabric with `rate`, or leave it out");
  }
  DeckNode* steps = in.node("subcycles");
  if (steps == nullptr || (steps->is_text() && steps->text == "auto")) {
    return;
  }
  constexpr KeyRange counts = {1, 10000};
  if (!steps->is_number() || std::floor(steps->number) != steps->number || steps->number < counts.lo || steps->number > counts.hi) {
    c.deck.fail(*steps, steps->is_number() ? fmt::format("{:g} steps to one of the mesh", steps->number) : fmt::format("{} is not wanted here", describe(*steps)), "\"auto\", or a whole number from 1 to 10000");
    return;
  }
  out.subcycles = static_cast<int>(steps->number);
}

/// Place of the stack at rest.
Bounds extent(Context c, const LayersSpec& out) {
  Bounds b;
  b.lo[2] = -1, b.hi[2] = 1; // of a 2D scene, which sees the section at 0
  for (std::size_t axis = 0; axis < c.across(); ++axis) {
    b.lo[axis] = out.lines[axis].front();
    b.hi[axis] = out.lines[axis].back();
  }
  b.lo[c.across()] = out.low();
  b.hi[c.across()] = out.high();
  return b;
}

bool meet(Bounds a, const Bounds& b, std::size_t dim, Bounds& common) {
  common = a;
  for (std::size_t k = 0; k < dim; ++k) {
    common.lo[k] = std::max(a.lo[k], b.lo[k]);
    common.hi[k] = std::min(a.hi[k], b.hi[k]);
    if (!(common.lo[k] < common.hi[k])) {
      return false;
    }
  }
  return true;
}

/// Two things cannot be in one place.
void check_room(Context c, const Section& in, const LayersSpec& out) {
  const Bounds mine = extent(c, out);
  Bounds common;
  constexpr double some = 1e-9; // of the common box: rounding
  for (const Body& body : c.scene.bodies) {
    if (embeds_layers(c.scene.motion) && !body.moves()) {
      continue; // it makes room
    }
    if (body.material >= 0 && meet(mine, bounds(body.shape), c.dim(), common) && fraction(body.shape, c.scene.geometry, common.lo, common.hi) > some) {
      c.deck.fail(*in.node("front"), fmt::format("the stack, from {:g} to {:g} m, overlaps body \"{}\"", out.low(), out.high(), body.name), "a front where there is room, or another place for the body");
      return;
    }
  }
}

/// What flies must meet the stack, and across it: along the last axis, and narrower.
void check_shot(Context c, const Section& in, const LayersSpec& out) {
  const Results& r = c.scene.results;
  const std::vector<std::string> names = axis_names(c.scene.geometry);
  for (std::size_t q = 0; q < c.scene.bodies.size(); ++q) {
    const Body& body = c.scene.bodies[q];
    const bool bullet = r.bullet.empty() ? body.moves() && body.material >= 0 : std::find(r.bullet.begin(), r.bullet.end(), static_cast<int>(q)) != r.bullet.end();
    if (!bullet) {
      continue;
    }
    if (!r.bullet.empty() && r.shot_axis != static_cast<int>(c.across())) {
      c.deck.fail({in.self().place, in.self().key, fmt::format("\"{}\" flies along {}; layers lie across {}", body.name, names[static_cast<std::size_t>(r.shot_axis)], names.back()),
                   fmt::format("a shot along {}", names.back())});
      return;
    }
    const Bounds b = bounds(body.shape);
    const bool missed = out.direction > 0 ? out.high() <= b.lo[c.across()] : out.low() >= b.hi[c.across()];
    if (missed) {
      c.deck.fail(*in.node("front"), fmt::format("the stack, from {:g} to {:g} m, lies behind \"{}\", which flies away from it", out.low(), out.high(), body.name), "a front ahead of the shot");
      return;
    }
    for (std::size_t axis = 0; axis < c.across(); ++axis) {
      const double reach = std::max(b.hi[axis], -b.lo[axis]), half = out.lines[axis].back();
      if (std::isfinite(reach) && reach > half) {
        c.deck.fail(*in.node("half_width"), fmt::format("{:g} m is less than the reach of \"{}\" along {}, {:g} m", half, body.name, names[axis], reach), "a stack wider than what strikes it");
        return;
      }
    }
  }
}

bool check_count(Context c, const Section& in, const LayersSpec& out) {
  double elements = static_cast<double>(out.layers) * out.through;
  for (std::size_t axis = 0; axis < c.across(); ++axis) {
    elements *= static_cast<double>(out.lines[axis].size() - 1);
  }
  if (elements > most_cells) {
    c.deck.fail({in.self().place, in.self().key, fmt::format("makes {:.3g} elements", elements), "2e8 elements at most"});
  }
  return elements <= most_cells;
}

/// Only letters and digits tell names apart.
std::string file_name(std::string name) {
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

/// Stacks are told apart by name and lie one behind the other, with or without room between.
void check_apart(Context c, const Section& in, const LayersSpec& out) {
  for (const LayersSpec& other : c.scene.layers) {
    if (file_name(other.name) == file_name(out.name)) { // in files and columns
      c.deck.fail(*in.node("name"), fmt::format("two stacks are called \"{}\"{}", out.name, other.name == out.name ? "" : fmt::format(" and \"{}\": their files would be the same", other.name)), "a name of its own for each");
      return;
    }
    const double common = std::min(out.high(), other.high()) - std::max(out.low(), other.low());
    constexpr double touching = 1e-9; // of a thickness: rounding
    if (common > touching * std::min(out.thickness, other.thickness)) {
      c.deck.fail(*in.node("front"), fmt::format("the stack, from {:g} to {:g} m, overlaps \"{}\", from {:g} to {:g} m", out.low(), out.high(), other.name, other.low(), other.high()),
                  fmt::format("front = {:g} m, where \"{}\" ends, or beyond", out.direction > 0 ? other.high() : other.low(), other.name));
      return;
    }
  }
}

/// What torn cloth becomes.
void read_debris(Context c, const Section& in, LayersSpec& out) {
  if (!in.has("debris")) {
    return;
  }
  DeckNode& node = *in.node("debris");
  if (!embeds_layers(c.scene.motion)) {
    c.deck.fail_key(node, "only of a stack inside a mesh", "leave it out, or a motion whose mesh stays behind");
  } else if (const std::optional<int> index = c.materials.index(c.deck, node.text, node)) {
    out.debris = *index;
    const auto& bodies = c.scene.bodies;
    const auto same = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.material == *index; });
    if (*index < 0) {
      c.deck.fail_key(node, "void holds no mass", "a material, or leave it out");
    } else if (same != bodies.end() || c.scene.background == *index) {
      c.deck.fail_key(node, fmt::format("\"{}\" is what {} is of: its results would count torn cloth", node.text, same != bodies.end() ? fmt::format("body \"{}\"", same->name) : "the background"),
                      "a material of its own: one of [materials] with it as `base`");
    } else if (c.scene.motion.policy == MotionPolicy::relax) {
      c.deck.fail_key(node, "only in a mesh of straight lines throughout", "leave it out, or motion.policy = \"eulerian\" or \"follow\"");
    }
  }
}

void read_one(Context c, DeckNode& node) {
  const std::size_t errors_before = c.deck.errors().size();
  const Section in = read_section(c.deck, node, scene_keys::layers());
  LayersSpec out;
  out.name = in.text("name");
  out.fabric = in.text("fabric");
  out.layers = in.integer("layers");
  out.through = in.integer("elements_through");
  out.front = in.number("front", 0);
  out.direction = c.scene.results.shot_direction;
  const FabricMaterial* fabric = in.has("fabric") ? c.book.find(c.deck, out.fabric, *in.node("fabric")) : nullptr;
  const bool sound = fabric != nullptr && in.has("layers") && in.has("elements_through") && in.has("front");
  if (fabric != nullptr) {
    out.model = fabric->model;
    choose_yarns(c, in, out);
    read_methods(c, in, out);
  }
  read_edges(c, in, out);
  read_debris(c, in, out);
  const bool flat = read_plane(c, in, out);
  if (!sound || !flat || !read_weight(c, in, *fabric, out)) {
    return;
  }
  check_fabric(c, in, out);
  if (c.deck.errors().size() > errors_before || !check_count(c, in, out)) {
    return;
  }
  check_apart(c, in, out);
  check_room(c, in, out);
  check_shot(c, in, out);
  c.scene.layers.push_back(std::move(out));
}

} // namespace

void read_layers(Deck& deck, DeckNode* list, DeckNode* fabrics, MaterialBook& materials, SceneSpec& scene) {
  const FabricBook book(deck, fabrics);
  for (std::size_t i = 0; list != nullptr && i < list->items.size(); ++i) {
    read_one({deck, book, scene, materials}, list->items[i]);
  }
  std::stable_sort(scene.layers.begin(), scene.layers.end(), [](const LayersSpec& a, const LayersSpec& b) { return a.low() < b.low(); });
  if (!scene.layers.empty() && deck.clean() && embeds_layers(scene.motion) && scene.map.curved()) { // their room is found along straight lines
    const DeckNode& first = list->items.front();
    deck.fail({first.place, first.key, "layers lie inside a mesh of straight lines only, and this one has a map", "no mesh.map; or motion.policy = \"lagrangian\", or \"relax\" with its boundary lagrangian"});
  }
}

} // namespace ballast
