// Deck: a TOML file as a tree of nodes that remember where they stand, and the list of everything
// that is wrong with it. Nothing stops at the first error: callers read on and end with
// throw_if_errors().
//
// Reading against a key table (core/deck_keys.hpp) turns quantities into SI numbers and adds
// defaults in place, so that after a clean read the tree *is* the resolved deck.
#pragma once

#include "core/error.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ballast {

/// Line and column count from 1; line 0: not from the file, `setting` then holds the --set text.
struct DeckPlace {
  int line = 0;
  int column = 0;
  int length = 1; ///< characters the caret underlines
  std::string setting;
};

/// One value of the deck.
struct DeckNode {
  enum class Kind { number, integer, flag, text, array, table };
  Kind kind = Kind::table;
  DeckPlace place;     ///< of the value
  DeckPlace key_place; ///< of its key, where it has one
  std::string key;     ///< full path: "body[1].velocity"
  double number = 0;   ///< of number and integer
  bool flag = false;
  std::string text;
  std::vector<DeckNode> items;                          ///< of array
  std::vector<std::pair<std::string, DeckNode>> fields; ///< of table, in deck order
  bool defaulted = false; ///< not in the deck: put there by the key table
  bool bad = false;       ///< an error has been reported for it: not to be used

  DeckNode* find(std::string_view name);
  const DeckNode* find(std::string_view name) const;
  bool is_table() const { return kind == Kind::table; }
  bool is_array() const { return kind == Kind::array; }
  bool is_text() const { return kind == Kind::text; }
  bool is_number() const { return kind == Kind::number || kind == Kind::integer; }
};

/// What a user would call this value: "the text \"x\"", "an array", "a table".
std::string describe(const DeckNode& node);

struct DeckError {
  DeckPlace place;
  std::string key;
  std::string message;
  std::string allowed; ///< what would be right, may be empty
};

class Deck {
public:
  /// Reads a file; `overrides` are "key.path=value" texts of --set. A file that cannot be opened
  /// throws Error; everything else that is wrong becomes an entry of errors().
  static Deck load(const std::string& path, const std::vector<std::string>& overrides = {});
  static Deck
  parse(std::string text, std::string name, const std::vector<std::string>& overrides = {});

  DeckNode& root() { return root_; }
  const DeckNode& root() const { return root_; }
  const std::string& name() const { return name_; }
  /// The file as read, for its hash.
  const std::string& text() const { return text_; }
  /// A path in the deck, relative to the deck's folder.
  std::string resolve_path(const std::string& path) const;

  /// Reports the node's value; marks the node bad.
  void fail(DeckNode& node, std::string message, std::string allowed = {});
  /// Reports the node's key (unknown, not wanted here); marks the node bad.
  void fail_key(DeckNode& node, std::string message, std::string allowed = {});
  void fail(DeckError error);
  const std::vector<DeckError>& errors() const { return errors_; }
  bool clean() const { return errors_.empty(); }
  /// All errors in deck order: file:line:col: key: message, the source line, a caret, what is
  /// allowed.
  std::string error_report() const;
  /// Throws Error(error_report()) if anything is wrong.
  void throw_if_errors() const;

private:
  std::string show(const DeckError& error) const;
  void apply(const std::string& setting);

  std::string name_, text_;
  DeckNode root_;
  std::vector<DeckError> errors_;
};

/// The tree as TOML text; numbers with all digits, so that reading it back gives the same scene.
std::string write_toml(const DeckNode& root);

/// The entry of `known` nearest to `word` if it is near enough to be meant, else empty.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

} // namespace ballast
