#include "materials/strength.hpp"

#include "materials/radial_return.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {

double shear_modulus(const Strength& strength) {
  return std::visit(
      [](const auto& m) {
        if constexpr (std::is_same_v<std::decay_t<decltype(m)>, NoStrength>) {
          return 0.0;
        } else if constexpr (std::is_same_v<std::decay_t<decltype(m)>, Viscoelastic>) {
          return instant_shear(m.law);
        } else {
          return m.shear_modulus;
        }
      },
      strength);
}

bool has_strength(const Strength& strength) { return !std::holds_alternative<NoStrength>(strength); }

bool has_variable_shear(const Strength& strength) { return std::holds_alternative<SteinbergGuinan>(strength); }

const TissueLaw* tissue_law(const Strength& strength) {
  const auto* tissue = std::get_if<Viscoelastic>(&strength);
  return tissue != nullptr ? &tissue->law : nullptr;
}

namespace {
std::string describe_one(const NoStrength&) { return "none"; }
std::string describe_one(const LinearHardening& m) {
  return fmt::format("J2, G {:g}, Y {:g}, H {:g} Pa", m.shear_modulus, m.yield, m.hardening);
}
std::string describe_one(const JohnsonCook& m) {
  return fmt::format("Johnson-Cook, G {:g}, A {:g}, B {:g} Pa, n {:g}, C {:g}, m {:g}",
                     m.shear_modulus, m.A, m.B, m.n, m.C, m.m);
}
std::string describe_one(const SteinbergGuinan& m) {
  return fmt::format("Steinberg-Guinan, G {:g}, Y {:g} to {:g} Pa, beta {:g}, n {:g}, G'p {:g}, B {:g} /K, Tm {:g} K, a {:g}",
                     m.shear_modulus, m.yield, m.yield_max, m.beta, m.n, m.shear_per_pressure, m.thermal_softening, m.melt_temperature, m.melt_a);
}
std::string describe_rate(const CowperSymonds& m) {
  return m.matters() ? fmt::format(", Cowper-Symonds {:g} /s, {:g}", m.constant, m.exponent) : "";
}
std::string describe_one(const PowerLawPlastic& m) {
  return fmt::format("power-law hardening, G {:g} Pa, {:g} Pa ({:g} + ep)^{:g}{}", m.shear_modulus, m.coefficient, m.first_strain, m.exponent, describe_rate(m.rate));
}
std::string describe_one(const TabulatedHardening& m) {
  std::string table;
  for (std::size_t i = 0; i < static_cast<std::size_t>(m.points); ++i) {
    table += fmt::format("{}{:g} Pa at {:g}", i > 0 ? ", " : "", m.stress[i], m.strain[i]);
  }
  return fmt::format("tabulated hardening, G {:g} Pa, {}{}", m.shear_modulus, table, describe_rate(m.rate));
}
std::string describe_law(const Prony& m) {
  return fmt::format("Prony, G {:g} Pa, long-term {:g} Pa, {} branches", instant_shear(m), m.long_shear, m.branches);
}
std::string describe_law(const PowerLawZener& m) {
  return fmt::format("power law, G {:g} Pa, long-term {:g} Pa, {} branches", instant_shear(m), m.long_shear, m.branches);
}
std::string describe_law(const FungQlv& m) {
  return fmt::format("Fung, G {:g} Pa, stiffening {:g}, {} branches", m.shear, m.stiffening, m.branches);
}
std::string describe_law(const BergstroemBoyce& m) {
  return fmt::format("Bergstroem-Boyce, G {:g} Pa, rate {:g} /s at {:g} Pa, m {:g}", instant_shear(m), m.rate, m.base, m.exponent);
}
std::string describe_one(const Viscoelastic& m) {
  return std::visit([](const auto& law) { return describe_law(law); }, m.law);
}
} // namespace

std::string describe(const Strength& strength) {
  return std::visit([](const auto& m) { return describe_one(m); }, strength);
}

double flow_stress(const LinearHardening& m, const FlowState& s, double increment) {
  return m.yield + m.hardening * (s.plastic_strain + increment);
}

PlasticIncrement plastic_increment(const LinearHardening& m, const FlowState& s, double trial) {
  const double excess = trial - flow_stress(m, s, 0);
  return {excess > 0 ? excess / (3 * m.shear_modulus + m.hardening) : 0.0};
}

double flow_stress(const JohnsonCook& m, const FlowState& s, double increment) {
  const double ep = s.plastic_strain + increment;
  const double warmer = m.start_temperature - m.reference_temperature + s.thermal_energy / m.specific_heat;
  const double homologous = std::clamp(warmer / (m.melt_temperature - m.reference_temperature), 0.0, 1.0);
  const double softening = homologous > 0 ? 1 - std::pow(homologous, m.m) : 1.0;
  const double rate = s.dt > 0 ? increment / s.dt / m.reference_rate : 0.0;
  const double hardening = m.A + (ep > 0 ? m.B * std::pow(ep, m.n) : 0.0);
  return hardening * (1 + m.C * std::log(std::max(rate, 1.0))) * softening;
}

PlasticIncrement plastic_increment(const JohnsonCook& m, const FlowState& s, double trial) {
  return solve_return(trial, m.shear_modulus, [&](double d) { return flow_stress(m, s, d); });
}

double flow_stress(const SteinbergGuinan& m, const FlowState& s, double increment) {
  const double hardened = m.yield * std::pow(1 + m.beta * (s.plastic_strain + increment), m.n);
  return std::min(hardened, m.yield_max) * s.stiffening;
}

PlasticIncrement plastic_increment(const SteinbergGuinan& m, const FlowState& s, double trial) {
  return solve_return(trial, m.shear_modulus * s.stiffening, [&](double d) { return flow_stress(m, s, d); });
}

} // namespace ballast
