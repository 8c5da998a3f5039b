// What a user is told about a deck that cannot be used.
#include "core/deck.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <numeric>
#include <sstream>

namespace ballast {
namespace {

std::string lower(std::string_view word) {
  std::string out(word);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return out;
}

/// Insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

std::string line_of(const std::string& text, int line) {
  std::istringstream in(text);
  std::string out;
  for (int i = 0; i < line && std::getline(in, out); ++i) {
  }
  while (!out.empty() && (out.back() == '\r' || out.back() == '\n')) {
    out.pop_back();
  }
  std::replace(out.begin(), out.end(), '\t', ' ');
  return out;
}

} // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  const std::string wanted = lower(word);
  std::string best;
  std::size_t best_distance = (word.size() < 4 ? 1 : std::max<std::size_t>(2, word.size() / 3)) + 1;
  for (const std::string& candidate : known) {
    const std::size_t d = edit_distance(wanted, lower(candidate));
    if (d < best_distance) {
      best = candidate;
      best_distance = d;
    }
  }
  return best;
}

std::string describe(const DeckNode& node) {
  switch (node.kind) {
  case DeckNode::Kind::number:
    return fmt::format("the number {:g}", node.number);
  case DeckNode::Kind::integer:
    return fmt::format("the number {:.0f}", node.number);
  case DeckNode::Kind::flag:
    return node.flag ? "true" : "false";
  case DeckNode::Kind::text:
    return fmt::format("the text \"{}\"", node.text);
  case DeckNode::Kind::array:
    return fmt::format("a list of {}", node.items.size());
  case DeckNode::Kind::table:
    break;
  }
  return "a table";
}

void Deck::fail(DeckError error) {
  errors_.push_back(std::move(error));
}

void Deck::fail(DeckNode& node, std::string message, std::string allowed) {
  node.bad = true;
  fail({node.place, node.key, std::move(message), std::move(allowed)});
}

void Deck::fail_key(DeckNode& node, std::string message, std::string allowed) {
  node.bad = true;
  const bool known = node.key_place.line > 0 || !node.key_place.setting.empty();
  fail({known ? node.key_place : node.place, node.key, std::move(message), std::move(allowed)});
}

std::string Deck::show(const DeckError& error) const {
  const DeckPlace& at = error.place;
  const std::string key = error.key.empty() ? "" : error.key + ": ";
  std::string out;
  if (at.line == 0) {
    out = at.setting.empty() ? fmt::format("{}: {}{}\n", name_, key, error.message)
                             : fmt::format("--set {}: {}{}\n", at.setting, key, error.message);
  } else {
    const std::string source = line_of(text_, at.line);
    const auto indent = static_cast<std::size_t>(std::max(0, at.column - 1));
    const std::size_t room = source.size() > indent ? source.size() - indent : 1;
    const std::size_t length =
        std::clamp<std::size_t>(static_cast<std::size_t>(at.length), 1, room);
    out = fmt::format("{}:{}:{}: {}{}\n", name_, at.line, at.column, key, error.message);
    out +=
        fmt::format("  {}\n  {}{}\n", source, std::string(indent, ' '), std::string(length, '^'));
  }
  if (!error.allowed.empty()) {
    out += fmt::format("  allowed: {}\n", error.allowed);
  }
  return out;
}

std::string Deck::error_report() const {
  std::vector<const DeckError*> ordered;
  for (const DeckError& error : errors_) {
    ordered.push_back(&error);
  }
  const auto rank = [](const DeckError* e) {
    return std::tuple(e->place.line == 0, e->place.line, e->place.column);
  };
  std::stable_sort(ordered.begin(), ordered.end(), [&](const DeckError* a, const DeckError* b) {
    return rank(a) < rank(b);
  });
  std::string out;
  for (const DeckError* error : ordered) {
    out += show(*error);
  }
  return out +
         fmt::format("{} error{} in {}\n", errors_.size(), errors_.size() == 1 ? "" : "s", name_);
}

void Deck::throw_if_errors() const {
  if (!clean()) {
    throw Error(error_report());
  }
}

} // namespace ballast
