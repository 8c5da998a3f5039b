#include "core/deck.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <toml++/toml.h>

namespace ballast {
namespace {

DeckPlace place_of(const toml::source_region& region) {
  DeckPlace place{
      static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), 1, {}};
  if (region.end.line == region.begin.line && region.end.column > region.begin.column) {
    place.length = static_cast<int>(region.end.column - region.begin.column);
  }
  return place;
}

DeckNode converted(const toml::node& from, const std::string& key);

void convert_table(const toml::table& from, DeckNode& to) {
  to.kind = DeckNode::Kind::table;
  for (const auto& [name, child] : from) {
    const std::string field(name.str());
    DeckNode node = converted(child, to.key.empty() ? field : to.key + "." + field);
    node.key_place = place_of(name.source());
    to.fields.emplace_back(field, std::move(node));
  }
  // toml++ sorts by name; a deck keeps the order it was written in.
  std::stable_sort(to.fields.begin(), to.fields.end(), [](const auto& a, const auto& b) {
    const DeckPlace &x = a.second.key_place, &y = b.second.key_place;
    return std::pair(x.line, x.column) < std::pair(y.line, y.column);
  });
}

DeckNode converted(const toml::node& from, const std::string& key) {
  DeckNode to;
  to.key = key;
  to.place = place_of(from.source());
  if (const auto* table = from.as_table()) {
    convert_table(*table, to);
  } else if (const auto* array = from.as_array()) {
    to.kind = DeckNode::Kind::array;
    for (const toml::node& child : *array) {
      to.items.push_back(converted(child, fmt::format("{}[{}]", key, to.items.size())));
    }
  } else if (const auto* integer = from.as_integer()) {
    to.kind = DeckNode::Kind::integer;
    to.number = static_cast<double>(integer->get());
  } else if (const auto* number = from.as_floating_point()) {
    to.kind = DeckNode::Kind::number;
    to.number = number->get();
  } else if (const auto* flag = from.as_boolean()) {
    to.kind = DeckNode::Kind::flag;
    to.flag = flag->get();
  } else if (const auto* text = from.as_string()) {
    to.kind = DeckNode::Kind::text;
    to.text = text->get();
  } else { // dates and times: no key takes one
    std::ostringstream shown;
    shown << toml::node_view<const toml::node>(from);
    to.kind = DeckNode::Kind::text;
    to.text = shown.str();
  }
  return to;
}

/// A --set value: TOML where it is TOML, else text ("0.5 mm" needs no quotes).
DeckNode setting_value(const std::string& text, const std::string& key) {
  try {
    const toml::table table = toml::parse("v = " + text);
    if (table.size() == 1) {
      return converted(*table.get("v"), key);
    }
  } catch (const toml::parse_error&) {
  }
  DeckNode node;
  node.kind = DeckNode::Kind::text;
  node.text = text;
  node.key = key;
  return node;
}

void mark(DeckNode& node, const DeckPlace& place) {
  node.place = node.key_place = place;
  for (DeckNode& item : node.items) {
    mark(item, place);
  }
  for (auto& [name, field] : node.fields) {
    mark(field, place);
  }
}

/// The entry of an array that a path part names: its number or the `name` of a table in it.
DeckNode* entry_of(DeckNode& array, const std::string& part) {
  std::size_t index = 0;
  const auto [end, status] = std::from_chars(part.data(), part.data() + part.size(), index);
  if (status == std::errc{} && end == part.data() + part.size()) {
    return index < array.items.size() ? &array.items[index] : nullptr;
  }
  for (DeckNode& item : array.items) {
    const DeckNode* name = item.find("name");
    if (name != nullptr && name->is_text() && name->text == part) {
      return &item;
    }
  }
  return nullptr;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) {
    parts.push_back(part);
  }
  return parts;
}

} // namespace

DeckNode* DeckNode::find(std::string_view name) {
  for (auto& [field, node] : fields) {
    if (field == name) {
      return &node;
    }
  }
  return nullptr;
}

const DeckNode* DeckNode::find(std::string_view name) const {
  return const_cast<DeckNode*>(this)->find(name);
}

Deck Deck::load(const std::string& path, const std::vector<std::string>& overrides) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (!in || std::filesystem::is_directory(path)) {
    throw Error(fmt::format("{}: cannot be read as a deck (no such file, or not readable)", path));
  }
  text << in.rdbuf();
  return parse(text.str(), path, overrides);
}

Deck Deck::parse(std::string text, std::string name, const std::vector<std::string>& overrides) {
  Deck deck;
  deck.name_ = std::move(name);
  deck.text_ = std::move(text);
  deck.root_.place = {1, 1, 1, {}};
  try {
    convert_table(toml::parse(deck.text_, deck.name_), deck.root_);
  } catch (const toml::parse_error& error) {
    deck.fail({place_of(error.source()), "", std::string(error.description()), "valid TOML 1.0"});
    return deck;
  }
  for (const std::string& setting : overrides) {
    deck.apply(setting);
  }
  return deck;
}

void Deck::apply(const std::string& setting) {
  const DeckPlace place{0, 0, 1, setting};
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    fail({place, "", "not of the form key.path=value", "for example --set mesh.r.size=\"0.5 mm\""});
    return;
  }
  const std::string path = setting.substr(0, equals);
  DeckNode* at = &root_;
  for (const std::string& part : split(path, '.')) {
    DeckNode* next = nullptr;
    if (at->is_array()) {
      next = entry_of(*at, part);
      if (next == nullptr) {
        fail({place,
              path,
              fmt::format("{} has no entry \"{}\"", at->key, part),
              fmt::format("0 to {}, or the name of an entry",
                          static_cast<int>(at->items.size()) - 1)});
        return;
      }
    } else if (at->is_table()) {
      next = at->find(part);
      if (next == nullptr) {
        DeckNode made;
        made.key = at->key.empty() ? part : at->key + "." + part;
        made.place = made.key_place = place;
        at->fields.emplace_back(part, std::move(made));
        next = &at->fields.back().second;
      }
    } else {
      fail({place, path, fmt::format("{} is {}, it holds no keys", at->key, describe(*at)), {}});
      return;
    }
    at = next;
  }
  *at = setting_value(setting.substr(equals + 1), at->key);
  mark(*at, place);
}

std::string Deck::resolve_path(const std::string& path) const {
  const std::filesystem::path p(path);
  return p.is_absolute() ? path : (std::filesystem::path(name_).parent_path() / p).string();
}

} // namespace ballast
