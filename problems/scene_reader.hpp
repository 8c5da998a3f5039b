// From a deck to a SceneSpec. All errors of the deck are collected and thrown as one Error.
#pragma once

#include "core/deck.hpp"
#include "problems/scene_spec.hpp"

#include <string>
#include <vector>

namespace ballast {

struct ReadScene {
  SceneSpec scene;
  std::string
      resolved; ///< the deck with every default, in SI: TOML that reads back to the same scene
  std::string source; ///< the deck as written, for its hash
};

/// Reads and validates a deck file; `overrides` are "key.path=value". Throws Error.
ReadScene read_scene(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same for a deck already loaded; errors stay in the deck, the scene is then not to be used.
SceneSpec read_scene(Deck& deck);

} // namespace ballast
