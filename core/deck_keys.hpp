// Key tables: one table says what a deck section may hold; it reads the section, and it prints the
// reference (docs/deck.md). A key that is not in the table is an error.
#pragma once

#include "core/deck.hpp"
#include "core/units.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace ballast {

enum class KeyKind {
  quantity,   ///< number, or text with a unit
  quantities, ///< list of quantities
  integer,
  flag,
  text,
  texts,
  choice,  ///< one of `choices`
  choices, ///< list of them
  table,   ///< another section
  tables,  ///< [[section]]
  special, ///< read by code of its own; `doc` says what it takes
  planned  ///< named in the design, refused with "not available yet"
};

/// Open or closed bounds, SI.
struct KeyRange {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool lo_open = false;
};
inline KeyRange positive() {
  return {0, std::numeric_limits<double>::infinity(), true};
}
inline KeyRange not_negative() {
  return {.lo = 0};
}

struct KeySpec {
  std::string name;
  KeyKind kind = KeyKind::text;
  std::string doc;
  Dimension dimension = Dimension::none;
  KeyRange range{};
  std::string fallback{}; ///< default, as a --set value ("1 atm", "a, b" for lists); empty: none
  bool required = false;
  std::vector<std::string> choices{};
  std::size_t min_count = 0, max_count = std::numeric_limits<std::size_t>::max();
};

struct SectionSpec {
  std::string header; ///< as in a deck: "[mesh]", "[[body]]", "" for the top
  std::string doc;
  std::vector<KeySpec> keys;
  const KeySpec* find(std::string_view name) const;
};

/// A section that has been read: values in SI. Keys that are absent or wrong are not there.
class Section {
public:
  Section(DeckNode& node, const SectionSpec& spec) : node_(&node), spec_(&spec) {}
  bool has(std::string_view key) const;
  double number(std::string_view key,
                double absent = std::numeric_limits<double>::quiet_NaN()) const;
  int integer(std::string_view key) const;
  bool flag(std::string_view key) const;
  std::string text(std::string_view key, std::string absent = {}) const;
  std::vector<double> numbers(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;
  /// Position of a choice's value among the choices of its key.
  int choice(std::string_view key) const;
  DeckNode* node(std::string_view key) const;
  DeckNode& self() const { return *node_; }

private:
  DeckNode* good(std::string_view key) const;
  DeckNode* node_;
  const SectionSpec* spec_;
};

/// Checks `node` against `spec`, converts quantities to SI and adds defaults in place.
Section read_section(Deck& deck, DeckNode& node, const SectionSpec& spec);

/// One quantity or a list of them, converted to SI in place; false (and an error) if that cannot
/// be.
bool read_quantity(Deck& deck, DeckNode& node, Dimension dimension, const KeyRange& range = {});
bool read_quantities(Deck& deck,
                     DeckNode& node,
                     Dimension dimension,
                     const KeyRange& range = {},
                     std::size_t min_count = 0,
                     std::size_t max_count = std::numeric_limits<std::size_t>::max());
/// Numbers of an array that read_quantities accepted.
std::vector<double> numbers_of(const DeckNode& array);

/// "a, b or c"
std::string one_of(const std::vector<std::string>& names);

/// "above 0 m", "from 1 to 3"; empty: any value.
std::string range_text(const KeyRange& range, Dimension dimension);

/// Markdown of the given sections.
std::string key_reference(const std::vector<const SectionSpec*>& sections);

} // namespace ballast
