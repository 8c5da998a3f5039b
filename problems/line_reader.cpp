#include "problems/line_reader.hpp"

#include "problems/mesh_lines.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast {
namespace {

constexpr double steepest_allowed = 1.5;

/// "3 m", "90 deg", "1": a coordinate along an axis, for messages.
std::string spoken(double value, Dimension dimension) {
  if (dimension == Dimension::angle) {
    return fmt::format("{:g} deg", value * 180 / std::numbers::pi);
  }
  return fmt::format("{:g}{}", value, dimension == Dimension::none ? "" : " m");
}

bool check_rising(Deck& deck, const LinePlaces& places, Dimension dimension) {
  for (std::size_t i = 0; i < places.to.size(); ++i) {
    const double before = i == 0 ? places.from : places.to[i - 1];
    if (places.to[i] <= before) {
      deck.fail(*places.nodes[i],
                fmt::format("{} is not above {}", spoken(places.to[i], dimension), spoken(before, dimension)),
                "places that rise from `from`");
      return false;
    }
  }
  return true;
}

bool check_sizes(Deck& deck, const AxisPlan& plan, DeckNode& size, Dimension dimension) {
  const std::size_t n = plan.to.size();
  if (plan.size.size() != n && plan.size.size() != n + 1) {
    deck.fail(size,
              fmt::format("{} sizes for {} places", plan.size.size(), n),
              fmt::format("{} (one a place) or {} (one at `from` too)", n, n + 1));
    return false;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = i + plan.size.size() - n;
    const double stretch = plan.to[i] - (i == 0 ? plan.from : plan.to[i - 1]);
    if (plan.size[at] > stretch * (1 + 1e-9)) {
      deck.fail(entry(size, at),
                fmt::format("{} is more than its stretch of {}", spoken(plan.size[at], dimension), spoken(stretch, dimension)),
                "a size that fits its stretch at least once");
      return false;
    }
  }
  if (planned_cells(plan) > most_cells) {
    deck.fail(size,
              fmt::format("makes {:.3g} cells along one axis", planned_cells(plan)),
              "2e8 cells at most");
    return false;
  }
  if (steepest_ratio(plan) > steepest_allowed) {
    deck.fail(size,
              fmt::format("neighbouring cells differ by a factor {:.2f}", steepest_ratio(plan)),
              fmt::format("{:g} at most: a longer stretch or nearer sizes", steepest_allowed));
    return false;
  }
  return true;
}

std::vector<double> equal_lines(double from, double to, int cells) {
  std::vector<double> nodes;
  for (int i = 0; i < cells; ++i) {
    nodes.push_back(from + (to - from) * i / cells);
  }
  nodes.push_back(to);
  return nodes;
}

} // namespace

bool check_size_or_cells(Deck& deck, const Section& in) {
  DeckNode* size = in.node("size");
  DeckNode& self = in.self();
  if ((size == nullptr) != (self.find("cells") == nullptr)) {
    return true;
  }
  deck.fail({size == nullptr ? self.place : size->key_place,
             self.key + ".size",
             size == nullptr ? "missing" : "contradicts cells",
             "either `size` or `cells`"});
  return false;
}

DeckNode& entry(DeckNode& node, std::size_t i) {
  return node.is_array() ? node.items[i] : node;
}

std::vector<double> read_places(Deck& deck, DeckNode& node, Dimension dimension, const KeyRange& range) {
  if (node.is_array()) {
    return read_quantities(deck, node, dimension, range, 1) ? numbers_of(node) : std::vector<double>{};
  }
  return read_quantity(deck, node, dimension, range) ? std::vector<double>{node.number} : std::vector<double>{};
}

std::vector<double> lines_through(Deck& deck, const Section& in, const LinePlaces& places, double refine, Dimension dimension) {
  DeckNode* size = in.node("size");
  AxisPlan plan{places.from, places.to, {}};
  if (size != nullptr) {
    for (const double s : read_places(deck, *size, dimension, positive())) {
      plan.size.push_back(s / refine);
    }
  }
  if ((size != nullptr && plan.size.empty()) || !check_rising(deck, places, dimension)) {
    return {};
  }
  if (size != nullptr) {
    return check_sizes(deck, plan, *size, dimension) ? mesh_lines(plan) : std::vector<double>{};
  }
  if (!in.has("cells")) {
    return {};
  }
  if (in.integer("cells") * refine > most_cells || plan.to.size() > 1) {
    deck.fail(*in.node("cells"),
              "needs one place in `to`",
              "2e8 cells at most, equal between `from` and `to`");
    return {};
  }
  return equal_lines(plan.from, plan.to[0], static_cast<int>(std::max(1.0, std::round(in.integer("cells") * refine))));
}

std::vector<double> read_lines(Deck& deck, const Section& in, double refine, Dimension dimension) {
  DeckNode* to = in.node("to");
  DeckNode& self = in.self();
  if (to == nullptr) {
    deck.fail({self.place, self.key + ".to", "missing", "the high end, or a rising list of places"});
  }
  if (!check_size_or_cells(deck, in) || to == nullptr) {
    return {};
  }
  LinePlaces places{in.number("from"), read_places(deck, *to, dimension, {}), {}};
  for (std::size_t i = 0; i < places.to.size(); ++i) {
    places.nodes.push_back(&entry(*to, i));
  }
  if (places.to.empty() || !in.has("from")) {
    if (DeckNode* size = in.node("size")) {
      read_places(deck, *size, dimension, positive()); // for its own errors
    }
    return {};
  }
  return lines_through(deck, in, places, refine, dimension);
}

} // namespace ballast
