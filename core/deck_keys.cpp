// Reads and checks the values of a section by its key table.
#include "core/deck_keys.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

/// "a length, with a unit (m, mm, ...) or a bare number in m; above 0 m"
std::string wanted(Dimension dimension, const KeyRange& range) {
  const std::string span = range_text(range, dimension);
  const std::string tail = span.empty() ? "" : "; " + span;
  if (dimension == Dimension::none) {
    return "a number" + tail;
  }
  return fmt::format("{} with a unit ({}) or a bare number in {}{}",
                     name_of(dimension),
                     allowed_units(dimension),
                     si_unit(dimension),
                     tail);
}

bool in_range(double value, const KeyRange& range) {
  return (range.lo_open ? value > range.lo : value >= range.lo) && value <= range.hi;
}

bool check_kind(Deck& deck, DeckNode& node, bool right, const std::string& allowed) {
  if (!right) {
    deck.fail(node, fmt::format("{} is not wanted here", describe(node)), allowed);
  }
  return right;
}

bool check_choice(Deck& deck, DeckNode& node, const std::vector<std::string>& choices) {
  if (!check_kind(deck, node, node.is_text(), one_of(choices))) {
    return false;
  }
  if (std::find(choices.begin(), choices.end(), node.text) != choices.end()) {
    return true;
  }
  const std::string meant = nearest(node.text, choices);
  deck.fail(node,
            fmt::format("\"{}\" is not known here{}",
                        node.text,
                        meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)),
            one_of(choices));
  return false;
}

bool check_integer(Deck& deck, DeckNode& node, const KeySpec& spec) {
  const std::string span = range_text(spec.range, Dimension::none);
  const std::string allowed = "a whole number" + (span.empty() ? "" : ", " + span);
  const bool whole =
      node.is_number() && std::abs(node.number) < 2e9 && std::floor(node.number) == node.number;
  if (!check_kind(deck, node, whole, allowed)) {
    return false;
  }
  node.kind = DeckNode::Kind::integer;
  if (!in_range(node.number, spec.range)) {
    deck.fail(node, fmt::format("{:.0f} is out of range", node.number), allowed);
    return false;
  }
  return true;
}

bool check_texts(Deck& deck, DeckNode& node, const KeySpec& spec) {
  const bool closed = spec.kind == KeyKind::choices;
  const std::string allowed = closed ? "a list of " + one_of(spec.choices) : "a list of texts";
  if (!check_kind(deck, node, node.is_array(), allowed)) {
    return false;
  }
  bool good = true;
  for (DeckNode& item : node.items) {
    good = (closed ? check_choice(deck, item, spec.choices)
                   : check_kind(deck, item, item.is_text(), allowed)) &&
           good;
  }
  return good;
}

bool check_tables(Deck& deck, DeckNode& node, const KeySpec& spec) {
  const std::string allowed = fmt::format("[[{}]] tables", spec.name);
  bool good = check_kind(deck, node, node.is_array(), allowed);
  for (DeckNode& item : node.items) {
    good = check_kind(deck, item, item.is_table(), allowed) && good;
  }
  return good;
}

void check_value(Deck& deck, DeckNode& node, const KeySpec& spec) {
  bool good = true;
  switch (spec.kind) {
  case KeyKind::quantity:
    good = read_quantity(deck, node, spec.dimension, spec.range);
    break;
  case KeyKind::quantities:
    good = read_quantities(deck, node, spec.dimension, spec.range, spec.min_count, spec.max_count);
    break;
  case KeyKind::integer:
    good = check_integer(deck, node, spec);
    break;
  case KeyKind::flag:
    good = check_kind(deck, node, node.kind == DeckNode::Kind::flag, "true or false");
    break;
  case KeyKind::text:
    good = check_kind(deck, node, node.is_text(), "a text in quotes");
    break;
  case KeyKind::choice:
    good = check_choice(deck, node, spec.choices);
    break;
  case KeyKind::texts:
  case KeyKind::choices:
    good = check_texts(deck, node, spec);
    break;
  case KeyKind::table:
    good = check_kind(deck, node, node.is_table(), "a table");
    break;
  case KeyKind::tables:
    good = check_tables(deck, node, spec);
    break;
  case KeyKind::special:
    break;
  case KeyKind::planned:
    deck.fail_key(node, "not available yet", "leave it out");
    good = false;
  }
  node.bad = node.bad || !good;
}

std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t comma = std::min(text.find(", ", at), text.size());
    out.push_back(text.substr(at, comma - at));
    at = comma + 2;
  }
  return out;
}

DeckNode text_node(const std::string& text, const std::string& key) {
  DeckNode node;
  node.kind = DeckNode::Kind::text;
  node.text = text;
  node.key = key;
  node.defaulted = true;
  return node;
}

/// The default of a key as if it stood in the deck.
DeckNode default_node(const KeySpec& spec, const std::string& key) {
  DeckNode node = text_node(spec.fallback, key);
  if (spec.kind == KeyKind::integer) {
    node.kind = DeckNode::Kind::integer;
    node.number = std::stod(spec.fallback);
  } else if (spec.kind == KeyKind::flag) {
    node.kind = DeckNode::Kind::flag;
    node.flag = spec.fallback == "true";
  } else if (spec.kind == KeyKind::texts || spec.kind == KeyKind::choices ||
             spec.kind == KeyKind::quantities) {
    node.kind = DeckNode::Kind::array;
    for (const std::string& item : listed(spec.fallback)) {
      node.items.push_back(text_node(item, key));
    }
  }
  return node;
}

std::vector<std::string> key_names(const SectionSpec& spec) {
  std::vector<std::string> names;
  for (const KeySpec& key : spec.keys) {
    if (key.kind != KeyKind::planned) {
      names.push_back(key.name);
    }
  }
  return names;
}

void refuse_unknown(Deck& deck, DeckNode& field, const std::string& name, const SectionSpec& spec) {
  const std::vector<std::string> names = key_names(spec);
  const std::string meant = nearest(name, names);
  deck.fail_key(field,
                meant.empty() ? "unknown key"
                              : fmt::format("unknown key; did you mean \"{}\"?", meant),
                one_of(names));
}

void add_absent(Deck& deck, DeckNode& node, const KeySpec& spec) {
  const std::string key = node.key.empty() ? spec.name : node.key + "." + spec.name;
  if (spec.required) {
    deck.fail({node.place, key, "missing", spec.doc});
    return;
  }
  if (!spec.fallback.empty()) {
    DeckNode fallback = default_node(spec, key);
    check_value(deck, fallback, spec);
    node.fields.emplace_back(spec.name, std::move(fallback));
  }
}

} // namespace

std::string one_of(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    out += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return out;
}

bool read_quantity(Deck& deck, DeckNode& node, Dimension dimension, const KeyRange& range) {
  const std::string allowed = wanted(dimension, range);
  if (!check_kind(deck, node, node.is_number() || node.is_text(), allowed)) {
    return false;
  }
  std::string shown = node.is_text() ? "\"" + node.text + "\"" : fmt::format("{:g}", node.number);
  if (node.is_text()) {
    const Quantity q = parse_quantity(node.text, dimension);
    if (!q.ok()) {
      deck.fail(node, q.problem, allowed);
      return false;
    }
    node.number = q.value;
    node.text.clear();
  }
  node.kind = DeckNode::Kind::number;
  if (!in_range(node.number, range)) {
    deck.fail(node, shown + " is out of range", allowed);
    return false;
  }
  if (!std::isfinite(node.number)) {
    deck.fail(node, shown + " is not finite", allowed);
    return false;
  }
  return true;
}

bool read_quantities(Deck& deck,
                     DeckNode& node,
                     Dimension dimension,
                     const KeyRange& range,
                     std::size_t min_count,
                     std::size_t max_count) {
  const std::string count = min_count == max_count ? fmt::format("{} ", min_count) : std::string{};
  const std::string allowed =
      fmt::format("a list of {}values, each: {}", count, wanted(dimension, range));
  if (!check_kind(deck, node, node.is_array(), allowed)) {
    return false;
  }
  bool good = true;
  for (DeckNode& item : node.items) {
    good = read_quantity(deck, item, dimension, range) && good;
  }
  if (node.items.size() < min_count || node.items.size() > max_count) {
    deck.fail(node, fmt::format("{} values given", node.items.size()), allowed);
    return false;
  }
  node.bad = node.bad || !good;
  return good;
}

std::vector<double> numbers_of(const DeckNode& array) {
  std::vector<double> out;
  for (const DeckNode& item : array.items) {
    out.push_back(item.number);
  }
  return out;
}

Section read_section(Deck& deck, DeckNode& node, const SectionSpec& spec) {
  for (auto& [name, field] : node.fields) {
    const KeySpec* key = spec.find(name);
    if (key == nullptr) {
      refuse_unknown(deck, field, name, spec);
    } else {
      check_value(deck, field, *key);
    }
  }
  for (const KeySpec& key : spec.keys) {
    if (node.find(key.name) == nullptr) {
      add_absent(deck, node, key);
    }
  }
  return {node, spec};
}

} // namespace ballast
