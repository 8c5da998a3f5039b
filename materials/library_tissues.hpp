// Private to the library: tissues with memory (materials/visco_law).
#pragma once

#include "materials/material.hpp"

#include <vector>

namespace ballast {

/// specific_energy not yet set.
std::vector<Material> viscoelastic_tissues();

} // namespace ballast
