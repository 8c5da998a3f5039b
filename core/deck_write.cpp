#include "core/deck.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

/// Shortest text that reads back to the same bits, always a TOML float.
std::string number_text(double value) {
  std::string out = fmt::format("{}", value);
  return out.find_first_of(".einf") == std::string::npos ? out + ".0" : out;
}

std::string value_text(const DeckNode& node) {
  std::string out;
  switch (node.kind) {
  case DeckNode::Kind::number:
    return number_text(node.number);
  case DeckNode::Kind::integer:
    return fmt::format("{:.0f}", node.number);
  case DeckNode::Kind::flag:
    return node.flag ? "true" : "false";
  case DeckNode::Kind::text:
    return quoted(node.text);
  case DeckNode::Kind::array:
    for (const DeckNode& item : node.items) {
      out += (out.empty() ? "" : ", ") + value_text(item);
    }
    return "[" + out + "]";
  case DeckNode::Kind::table:
    for (const auto& [name, field] : node.fields) {
      out += (out.empty() ? " " : ", ") + key_text(name) + " = " + value_text(field);
    }
  }
  return "{" + out + " }";
}

bool is_table_list(const DeckNode& node) {
  return node.is_array() && !node.items.empty() &&
         std::all_of(
             node.items.begin(), node.items.end(), [](const DeckNode& n) { return n.is_table(); });
}

void write_fields(const DeckNode& table, std::string& out) {
  for (const auto& [name, field] : table.fields) {
    out += fmt::format("{} = {}\n", key_text(name), value_text(field));
  }
}

} // namespace

std::string write_toml(const DeckNode& root) {
  std::string out;
  for (const auto& [name, field] : root.fields) { // plain values first: TOML wants it so
    if (!field.is_table() && !is_table_list(field)) {
      out += fmt::format("{} = {}\n", key_text(name), value_text(field));
    }
  }
  for (const auto& [name, field] : root.fields) {
    if (field.is_table()) {
      out += fmt::format("\n[{}]\n", key_text(name));
      write_fields(field, out);
    } else if (is_table_list(field)) {
      for (const DeckNode& item : field.items) {
        out += fmt::format("\n[[{}]]\n", key_text(name));
        write_fields(item, out);
      }
    }
  }
  return out;
}

} // namespace ballast
