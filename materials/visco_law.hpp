// The viscoelastic laws of tissue as one type.
//
// State: plain rows of doubles, state_count of them (six a tensor), named by state_names, set_rest at the start. All may be
// mixed by mass in a remap: deviators and strains are mean values; Bergstroem-Boyce tensors stay positive definite and are
// made unimodular at the start of the next step. The free energy of a mean is not its parts' mean: less, but for Fung's
// law, whose energy is convex in the strain alone, less or more.
#pragma once

#include "materials/visco_bergstroem_boyce.hpp"
#include "materials/visco_fung.hpp"
#include "materials/visco_power_law.hpp"
#include "materials/visco_prony.hpp"

#include <variant>

namespace ballast {

using TissueLaw = std::variant<Prony, PowerLawZener, FungQlv, BergstroemBoyce>;

inline std::size_t state_count(const TissueLaw& law) {
  return std::visit([](const auto& m) { return state_count(m); }, law);
}
inline std::vector<std::string> state_names(const TissueLaw& law) {
  return std::visit([](const auto& m) { return state_names(m); }, law);
}
inline void set_rest(const TissueLaw& law, std::span<double> state) {
  std::visit([&](const auto& m) { set_rest(m, state); }, law);
}
/// Pa, of the fastest deformation at rest: for the sound speed.
inline double instant_shear(const TissueLaw& law) {
  return std::visit([](const auto& m) { return instant_shear(m); }, law);
}

} // namespace ballast
