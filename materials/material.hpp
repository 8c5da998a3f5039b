// A material: equation of state, strength and failure, with its initial state and where the numbers are from.
#pragma once

#include "eos/eos.hpp"
#include "materials/failure.hpp"
#include "materials/strength.hpp"

#include <limits>
#include <optional>
#include <string>

namespace ballast {

/// All in SI. A void is no Material: it is what the volume fractions leave over.
struct Material {
  std::string name;
  Eos eos = IdealGas{};
  Strength strength = NoStrength{};
  std::optional<JohnsonCookFailure> failure = {}; ///< of materials with strength
  double density = 1;          ///< initial, kg/m3
  double specific_energy = 0;  ///< initial, J/kg; set from the ambient pressure by the scene
  /// Void opens when the pressure falls below this (negative, Pa); minus infinity: never.
  double spall_pressure = -std::numeric_limits<double>::infinity();
  double specific_heat = 0;           ///< J/kg/K, 0: not known
  double conductivity = 0;            ///< of heat, W/m/K: of gases only (ale/work_pass), 0: adiabatic
  double reference_temperature = 293; ///< K
  double melt_temperature = 0;        ///< K, 0: not known
  std::string source;      ///< where each number is from
  std::string confidence;  ///< S, R, D, K1, K2 or K3, as docs/materials.md explains
};

} // namespace ballast
