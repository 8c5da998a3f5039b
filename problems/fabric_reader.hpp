// [fabrics.NAME]: overrides of named fabrics and new ones.
#pragma once

#include "core/deck.hpp"
#include "materials/fabric_library.hpp"

#include <map>
#include <string>
#include <vector>

namespace ballast {

class FabricBook {
public:
  /// Reads [fabrics]; `table` may be null.
  FabricBook(Deck& deck, DeckNode* table);
  /// The fabric called `name`; nullptr, and an error at `blame`, for an unknown one, without an error for one that is defined wrong.
  /// Constants are checked once a stack has a density.
  const FabricMaterial* find(Deck& deck, const std::string& name, DeckNode& blame) const;

private:
  void define(Deck& deck, const std::string& name, DeckNode& node);
  std::map<std::string, FabricMaterial> defined_;
  std::vector<std::string> broken_;
};

} // namespace ballast
