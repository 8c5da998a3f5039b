// The viscoelastic laws of tissue as one type, for whoever carries their state through a step and a remap.
//
// State: plain rows of doubles, state_count of them, named by state_names, set_rest at the start. All may be mixed by
// mass in a remap: deviators and strains are mean values; Bergstroem-Boyce tensors stay positive definite and are made
// unimodular at the start of the next step. A mean's free energy is not its parts' mean: less, but for Fung's law of either sign.
#pragma once

#include "materials/visco_fung.hpp"
#include "materials/visco_integrator.hpp"

#include <variant>

namespace ballast {

using TissueLaw = std::variant<Prony, FungQlv, PowerLawZener, BergstroemBoyce>;

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
/// One step of a row; linear and quasi-linear laws do without the integrator.
[[nodiscard]] inline std::optional<TissueFailure> advance(const TissueLaw& law, TissueIntegrator& integrator, const ViscoRow& row) {
  if (const auto* prony = std::get_if<Prony>(&law)) {
    advance(*prony, row);
  } else if (const auto* fung = std::get_if<FungQlv>(&law)) {
    advance(*fung, row);
  } else if (const auto* power = std::get_if<PowerLawZener>(&law)) {
    return integrator.advance(*power, row);
  } else {
    return integrator.advance(std::get<BergstroemBoyce>(law), row);
  }
  return std::nullopt;
}

} // namespace ballast
