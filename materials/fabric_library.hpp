// Named fabrics. They stand beside the named materials (materials/library): a fabric has no equation of state, but a thickness.
#pragma once

#include "materials/fabric.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ballast {

/// A vest: law, geometry and where the numbers are from. Areal density = density x thickness.
struct FabricMaterial {
  std::string name;
  FabricModel model;
  double thickness = 0;   ///< of the whole vest at rest, m
  int plies = 1;          ///< of the vest; the law describes them as one body
  std::string source;     ///< where each number is from
  std::string confidence; ///< S, R, D, K1, K2 or K3, as docs/materials.md explains
};

/// The named fabric, or nullptr.
const FabricMaterial* find_fabric(std::string_view name);

/// All names, in the order of docs/materials.md.
std::vector<std::string> fabric_names();

/// Several lines: law, densities, thickness, source and confidence.
std::string describe(const FabricMaterial& fabric);

} // namespace ballast
