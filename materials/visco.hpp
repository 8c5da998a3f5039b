// One step of a row of any tissue, for whoever carries its state through a step and a remap (ale/tissue_update).
#pragma once

#include "materials/visco_integrator.hpp"
#include "materials/visco_law.hpp"

namespace ballast {

/// An instantaneous elastic strain (symmetric, traceless, small) of one cell; its stress changes by 2 G times it, G the instant
/// modulus, Bergstroem-Boyce's at small strains only. `state`: state_count values.
void strain_at_once(const TissueLaw& law, const Sym& strain, std::span<double> state);

/// One step of a row; linear and quasi-linear laws do without the integrator. What comes out without a number is a failure for all.
[[nodiscard]] inline std::optional<TissueFailure> advance(const TissueLaw& law, TissueIntegrator& integrator, const ViscoRow& row) {
  std::optional<TissueFailure> failure;
  if (const auto* prony = std::get_if<Prony>(&law)) {
    advance(*prony, row);
  } else if (const auto* fung = std::get_if<FungQlv>(&law)) {
    advance(*fung, row);
  } else if (const auto* power = std::get_if<PowerLawZener>(&law)) {
    failure = integrator.advance(*power, row);
  } else {
    failure = integrator.advance(std::get<BergstroemBoyce>(law), row);
  }
  if (const int lost = failure ? -1 : first_without_number(row); lost >= 0) {
    failure = TissueFailure{lost, 0, 0, 1, load_sym(row, 0, static_cast<std::size_t>(lost))};
  }
  return failure;
}

} // namespace ballast
