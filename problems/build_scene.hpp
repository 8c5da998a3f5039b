// From a SceneSpec to a Scene: block, materials, fills, velocities, boundaries, method.
#pragma once

#include "ale/simulation.hpp"
#include "problems/scene_spec.hpp"

namespace ballast {

/// Where the materials of a SceneSpec sit in the block (onion-skin order, void last).
struct SlotMap {
  std::vector<int> slot; ///< by index into SceneSpec::materials
};
SlotMap slot_map(const SceneSpec& spec);

/// Throws Error when a scene cannot be built (a cell without material where void is not possible).
template <int Dim> Scene<Dim> build_scene(const SceneSpec& spec, int threads);

} // namespace ballast
