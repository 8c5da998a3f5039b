// Shape tables of a deck.
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Context {
  Deck& deck;
  Geometry geometry;
  std::size_t dim() const { return static_cast<std::size_t>(dimensions(geometry)); }
};

std::optional<Shape> read_box(Context c, DeckNode& node) {
  const Section in = read_section(c.deck, node, scene_keys::box(c.dim()));
  if (!in.has("from") || !in.has("to")) {
    return std::nullopt;
  }
  Box box{point_of(in.numbers("from")), point_of(in.numbers("to"))};
  for (std::size_t k = 0; k < c.dim(); ++k) {
    if (box.to[k] <= box.from[k]) {
      c.deck.fail(in.node("to")->items[k],
                  fmt::format("{:g} m is not above `from`, {:g} m", box.to[k], box.from[k]),
                  "a high corner above the low one on every axis");
      return std::nullopt;
    }
  }
  if (c.dim() == 2) {
    box.from[2] = -infinity;
    box.to[2] = infinity;
  }
  return Shape{box};
}

std::optional<Shape> read_sphere(Context c, DeckNode& node) {
  const Section in = read_section(c.deck, node, scene_keys::sphere(c.dim()));
  if (!in.has("centre") || !in.has("radius")) {
    return std::nullopt;
  }
  return Shape{Sphere{point_of(in.numbers("centre")), in.number("radius")}};
}

std::optional<Shape> read_cylinder(Context c, DeckNode& node) {
  const Section in = read_section(c.deck, node, scene_keys::cylinder(c.dim()));
  if (!in.has("from") || !in.has("to") || !in.has("radius")) {
    return std::nullopt;
  }
  const Cylinder cylinder{
      point_of(in.numbers("from")), point_of(in.numbers("to")), in.number("radius")};
  if (cylinder.from == cylinder.to) {
    c.deck.fail(*in.node("to"), "the same point as `from`", "two different ends");
    return std::nullopt;
  }
  if (c.geometry == Geometry::axisymmetric && (cylinder.from[0] != 0 || cylinder.to[0] != 0)) {
    c.deck.fail(*in.node(cylinder.from[0] != 0 ? "from" : "to"),
                "an axisymmetric cylinder lies on the axis",
                "r = 0 at both ends; a box in (r, z) makes a tube");
    return std::nullopt;
  }
  return Shape{cylinder};
}

std::optional<Shape> read_half_space(Context c, DeckNode& node) {
  const Section in = read_section(c.deck, node, scene_keys::half_space(c.dim()));
  if (!in.has("point") || !in.has("outward")) {
    return std::nullopt;
  }
  HalfSpace half{point_of(in.numbers("point")), point_of(in.numbers("outward"))};
  const double length = std::hypot(half.outward[0], half.outward[1], half.outward[2]);
  if (length == 0) {
    c.deck.fail(*in.node("outward"), "has no direction", "a normal that is not zero");
    return std::nullopt;
  }
  for (double& component : half.outward) {
    component /= length;
  }
  return Shape{half};
}

std::optional<Shape> read_revolved(Context c, DeckNode& node) {
  const Section in = read_section(c.deck, node, scene_keys::revolved(c.dim()));
  std::optional<Profile> profile = read_profile(c.deck, in);
  const Point origin = point_of(in.numbers("origin"));
  DeckNode* direction = in.node("direction");
  const auto axis = read_direction(c.deck,
                                   in.text("direction", default_direction(c.geometry)),
                                   c.geometry,
                                   direction != nullptr ? *direction : node);
  if (c.geometry == Geometry::axisymmetric && origin[0] != 0) {
    c.deck.fail(*in.node("origin"), "an axisymmetric outline turns about the axis", "r = 0");
    return std::nullopt;
  }
  if (!profile || !axis) {
    return std::nullopt;
  }
  return Shape{Revolved{origin, *axis, std::move(*profile)}};
}

std::optional<Shape> read_combination(Context c, DeckNode& list, Combination::Kind kind) {
  if (!list.is_array() || list.items.size() < 2) {
    c.deck.fail(list,
                list.is_array() ? fmt::format("{} shapes given", list.items.size())
                                : fmt::format("{} is not wanted here", describe(list)),
                "a list of two or more shapes");
    return std::nullopt;
  }
  Combination out{kind, {}};
  bool good = true;
  for (DeckNode& item : list.items) {
    std::optional<Shape> part = read_shape(c.deck, item, c.geometry);
    good = good && part.has_value();
    if (part) {
      out.parts.push_back(std::move(*part));
    }
  }
  return good ? std::optional<Shape>(Shape{std::move(out)}) : std::nullopt;
}

std::optional<Shape> read_form(Context c, const std::string& kind, DeckNode& inner) {
  if (kind == "box") {
    return read_box(c, inner);
  }
  if (kind == "sphere") {
    return read_sphere(c, inner);
  }
  if (kind == "cylinder") {
    return read_cylinder(c, inner);
  }
  if (kind == "revolved") {
    return read_revolved(c, inner);
  }
  if (kind == "half_space") {
    return read_half_space(c, inner);
  }
  if (kind == "stl") {
    return read_surface(c.deck, inner, c.geometry);
  }
  if (kind == "voxels") {
    return read_voxels(c.deck, inner, c.geometry);
  }
  return read_combination(c,
                          inner,
                          kind == "union"          ? Combination::Kind::unite
                          : kind == "intersection" ? Combination::Kind::intersect
                                                   : Combination::Kind::subtract);
}

} // namespace

Point point_of(const std::vector<double>& values) {
  Point p{};
  for (std::size_t k = 0; k < std::min<std::size_t>(3, values.size()); ++k) {
    p[k] = values[k];
  }
  return p;
}

std::string default_direction(Geometry geometry) {
  return geometry == Geometry::planar ? "+x" : "+z";
}

std::optional<Point>
read_direction(Deck& deck, const std::string& text, Geometry geometry, DeckNode& blame) {
  const std::vector<std::string> names = axis_names(geometry);
  std::vector<std::string> allowed;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (geometry == Geometry::axisymmetric && k == 0) {
      continue; // nothing but the axis can be turned about
    }
    allowed.push_back("+" + names[k]);
    allowed.push_back("-" + names[k]);
    if (text.substr(1) == names[k]) {
      Point axis{};
      axis[k] = text.front() == '-' ? -1 : 1;
      return axis;
    }
  }
  deck.fail(blame,
            fmt::format("{} is no direction of a {} scene", text, name_of(geometry)),
            one_of(allowed));
  return std::nullopt;
}

std::optional<Shape> read_shape(Deck& deck, DeckNode& node, Geometry geometry) {
  const Context c{deck, geometry};
  if (!node.is_table()) {
    deck.fail(node,
              fmt::format("{} is not a shape", describe(node)),
              "a table such as { sphere = { centre = [...], radius = \"3 mm\" } }");
    return std::nullopt;
  }
  const Section in = read_section(deck, node, scene_keys::shape());
  const auto is_form = [](const auto& field) { return field.first != "rotate" && field.first != "offset"; };
  const auto forms = std::count_if(node.fields.begin(), node.fields.end(), is_form);
  if (forms != 1) {
    deck.fail({node.place,
               node.key,
               fmt::format("{} shapes in one table", forms),
               "exactly one; use union for several"});
    return std::nullopt;
  }
  auto& [kind, inner] = *std::find_if(node.fields.begin(), node.fields.end(), is_form);
  if (inner.bad) {
    return std::nullopt;
  }
  const std::optional<Shape> form = read_form(c, kind, inner);
  return form ? read_placed(deck, in, geometry, *form) : std::nullopt;
}

} // namespace ballast
