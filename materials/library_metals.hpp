// Private to the library: the metals with a failure model or Steinberg-Guinan strength.
#pragma once

#include "materials/material.hpp"

#include <vector>

namespace ballast {

/// specific_energy not yet set.
std::vector<Material> modelled_metals();

} // namespace ballast
