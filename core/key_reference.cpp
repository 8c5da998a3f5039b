// Key tables in words: the reference's tables, and ranges as messages name them.
#include "core/deck_keys.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

std::string kind_text(const KeySpec& key) {
  const std::string dimension(name_of(key.dimension));
  switch (key.kind) {
  case KeyKind::quantity:
    return dimension;
  case KeyKind::quantities:
    return key.min_count == key.max_count ? fmt::format("{} x {}", key.min_count, dimension)
                                          : fmt::format("list of {}", dimension);
  case KeyKind::integer:
    return "whole number";
  case KeyKind::flag:
    return "true / false";
  case KeyKind::text:
    return "text";
  case KeyKind::texts:
    return "list of texts";
  case KeyKind::choice:
    return one_of(key.choices);
  case KeyKind::choices:
    return "list of " + one_of(key.choices);
  case KeyKind::table:
    return "table";
  case KeyKind::tables:
    return fmt::format("[[{}]]", key.name);
  case KeyKind::special:
    return "see right";
  case KeyKind::planned:
    break;
  }
  return "not available yet";
}

std::string default_text(const KeySpec& key) {
  if (key.required) {
    return "required";
  }
  return key.fallback.empty() ? "" : "`" + key.fallback + "`";
}

} // namespace

std::string range_text(const KeyRange& range, Dimension dimension) {
  const std::string unit(si_unit(dimension));
  const auto with_unit = [&](double v) {
    return unit.empty() ? fmt::format("{:g}", v) : fmt::format("{:g} {}", v, unit);
  };
  const bool lo = std::isfinite(range.lo), hi = std::isfinite(range.hi);
  if (lo && hi) {
    return fmt::format(
        "{} {} to {}", range.lo_open ? "above" : "from", with_unit(range.lo), with_unit(range.hi));
  }
  if (lo) {
    return fmt::format("{} {}", range.lo_open ? "above" : "at least", with_unit(range.lo));
  }
  return hi ? fmt::format("at most {}", with_unit(range.hi)) : std::string{};
}

std::string key_reference(const std::vector<const SectionSpec*>& sections) {
  std::string out;
  for (const SectionSpec* section : sections) {
    out += fmt::format("\n## {}\n\n{}\n\n", section->header, section->doc);
    out += "| key | takes | range | default | meaning |\n|---|---|---|---|---|\n";
    for (const KeySpec& key : section->keys) {
      out += fmt::format("| `{}` | {} | {} | {} | {} |\n",
                         key.name,
                         kind_text(key),
                         range_text(key.range, key.dimension),
                         default_text(key),
                         key.doc);
    }
  }
  return out;
}

} // namespace ballast
