// Private to the library: tissues and simulants.
#pragma once

#include "materials/material.hpp"

#include <vector>

namespace ballast {

/// specific_energy not yet set.
std::vector<Material> viscoelastic_tissues(); ///< with memory (materials/visco_law), the first ones
std::vector<Material> torso_tissues();

} // namespace ballast
