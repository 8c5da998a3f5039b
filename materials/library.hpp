// Named materials: every number with its source and confidence mark (docs/materials.md).
//
// specific_energy is that of density at 1 atm; a scene replaces it by its own ambient state.
#pragma once

#include "materials/material.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ballast {

/// The named material, or nullptr.
const Material* find_material(std::string_view name);

/// All names, in the order of docs/materials.md.
std::vector<std::string> material_names();

/// Several lines: models, initial state, spall pressure, source and confidence.
std::string describe(const Material& material);

} // namespace ballast
