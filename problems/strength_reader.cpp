// Strength and failure of a material from its deck section.
#include "problems/material_models.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {

const std::vector<ModelKeys>& strength_keys() {
  static const std::vector<ModelKeys> table = {
      {"none", {}},
      {"linear_hardening", {"shear_modulus", "yield", "hardening"}},
      {"johnson_cook", {"shear_modulus", "A", "B", "n", "C", "m", "reference_rate", "reference_temperature"}},
      {"steinberg_guinan",
       {"shear_modulus", "yield", "yield_max", "beta", "n", "shear_per_pressure", "thermal_softening", "melt_a"}},
      {"power_law_plastic", {"shear_modulus", "flow_coefficient", "flow_strain", "n", "rate_constant", "rate_exponent"}},
      {"tabulated_hardening", {"shear_modulus", "yield_strains", "yield_stresses", "rate_constant", "rate_exponent"}},
      {"prony", {"long_shear", "branch_shear", "branch_time"}},
      {"power_law", {"long_shear", "branch_shear", "branch_time", "branch_reference", "branch_exponent"}},
      {"fung", {"shear_modulus", "stiffening", "branch_share", "branch_time"}},
      {"bergstroem_boyce",
       {"network_a_shear", "network_b_shear", "lock_stretch", "flow_rate", "flow_stress", "flow_exponent", "flow_stretch_power", "flow_start"}}};
  return table;
}

/// Position of a material's model in the table above: the laws of viscoelastic ones in the order of TissueLaw.
std::size_t model_of(const Strength& strength) {
  const TissueLaw* law = tissue_law(strength);
  return strength.index() + (law != nullptr ? law->index() : 0);
}

/// Numbers that thermal models take from the material itself.
void need_heat(Deck& deck, const Section& in, const Material& m, const char* model) {
  if (m.melt_temperature <= 0) {
    have(deck, in, {"melt_temperature"}, model);
  }
  if (m.specific_heat <= 0) {
    have(deck, in, {"specific_heat"}, model);
  }
}

JohnsonCook read_johnson_cook(Deck& deck, const Section& in, const Material& m, bool fresh, double temperature) {
  JohnsonCook s = fresh ? JohnsonCook{} : std::get<JohnsonCook>(m.strength);
  if (fresh) {
    have(deck, in, {"shear_modulus", "A", "B", "n", "C", "m"}, "johnson_cook");
    need_heat(deck, in, m, "johnson_cook");
  }
  set(s.shear_modulus, in, "shear_modulus");
  set(s.A, in, "A");
  set(s.B, in, "B");
  set(s.n, in, "n");
  set(s.C, in, "C");
  set(s.m, in, "m");
  set(s.reference_rate, in, "reference_rate");
  s.melt_temperature = m.melt_temperature;
  s.specific_heat = m.specific_heat;
  set(s.reference_temperature, in, "reference_temperature");
  s.start_temperature = temperature;
  return s;
}

LinearHardening read_linear(Deck& deck, const Section& in, const Material& m, bool fresh) {
  LinearHardening s = fresh ? LinearHardening{} : std::get<LinearHardening>(m.strength);
  if (fresh) {
    have(deck, in, {"shear_modulus", "yield"}, "linear_hardening");
  }
  set(s.shear_modulus, in, "shear_modulus");
  set(s.yield, in, "yield");
  set(s.hardening, in, "hardening");
  return s;
}

SteinbergGuinan read_steinberg(Deck& deck, const Section& in, const Material& m, bool fresh, double temperature) {
  SteinbergGuinan s = fresh ? SteinbergGuinan{} : std::get<SteinbergGuinan>(m.strength);
  if (fresh) {
    have(deck, in, {"shear_modulus", "yield", "yield_max", "beta", "n", "shear_per_pressure", "thermal_softening", "melt_a"}, "steinberg_guinan");
    need_heat(deck, in, m, "steinberg_guinan");
  }
  set(s.shear_modulus, in, "shear_modulus");
  set(s.yield, in, "yield");
  set(s.yield_max, in, "yield_max");
  set(s.beta, in, "beta");
  set(s.n, in, "n");
  set(s.shear_per_pressure, in, "shear_per_pressure");
  set(s.thermal_softening, in, "thermal_softening");
  set(s.melt_a, in, "melt_a");
  s.melt_temperature = m.melt_temperature;
  s.specific_heat = m.specific_heat;
  s.reference_temperature = temperature;
  s.eos = condensed(m.eos);
  DeckNode* chosen = in.node("strength");
  if (std::get_if<MieGruneisen>(&m.eos) == nullptr && std::get_if<CubicGruneisen>(&m.eos) == nullptr) {
    deck.fail_key(chosen != nullptr ? *chosen : in.self(),
                  fmt::format("steinberg_guinan takes the temperature along an isentrope from the equation of state; {} gives none", describe(m.eos)),
                  "eos = \"mie_gruneisen\" or \"cubic_gruneisen\"");
  }
  for (const char* key : {"yield_max", "yield"}) {
    if (in.has(key) && s.yield > s.yield_max && s.yield_max > 0) {
      deck.fail(*in.node(key), fmt::format("the yield stress {:g} Pa is above yield_max, {:g} Pa", s.yield, s.yield_max), "yield <= yield_max");
      break;
    }
  }
  return s;
}

CowperSymonds read_rate(Deck& deck, const Section& in, CowperSymonds rate, const char* model) {
  if (in.has("rate_constant") != in.has("rate_exponent") && !rate.matters()) {
    have(deck, in, {"rate_constant", "rate_exponent"}, fmt::format("the rate factor of {}", model));
  }
  set(rate.constant, in, "rate_constant");
  set(rate.exponent, in, "rate_exponent");
  return rate;
}

PowerLawPlastic read_power_law(Deck& deck, const Section& in, const Material& m, bool fresh) {
  PowerLawPlastic s = fresh ? PowerLawPlastic{} : std::get<PowerLawPlastic>(m.strength);
  if (fresh) {
    have(deck, in, {"shear_modulus", "flow_coefficient", "flow_strain", "n"}, "power_law_plastic");
  }
  set(s.shear_modulus, in, "shear_modulus");
  set(s.coefficient, in, "flow_coefficient");
  set(s.first_strain, in, "flow_strain");
  set(s.exponent, in, "n");
  s.rate = read_rate(deck, in, s.rate, "power_law_plastic");
  return s;
}

/// Points of the hardening table; the reason, if they are none.
const char* table_fault(const std::vector<double>& strain, const std::vector<double>& stress) {
  if (strain.size() != stress.size()) {
    return "as many strains as stresses are wanted";
  }
  if (strain.front() != 0) {
    return "the first plastic strain is not 0, where the material yields first";
  }
  if (std::adjacent_find(strain.begin(), strain.end(), [](double a, double b) { return b <= a; }) != strain.end()) {
    return "the plastic strains do not rise";
  }
  const bool falls = std::adjacent_find(stress.begin(), stress.end(), [](double a, double b) { return b < a; }) != stress.end();
  return falls ? "the stresses fall: softening gathers in one cell, whatever its size; a `failure` breaks what is strained" : nullptr;
}

TabulatedHardening read_tabulated(Deck& deck, const Section& in, const Material& m, bool fresh) {
  TabulatedHardening s = fresh ? TabulatedHardening{} : std::get<TabulatedHardening>(m.strength);
  const bool new_table = in.has("yield_strains") || in.has("yield_stresses");
  bool complete = true;
  if (fresh) {
    complete = have(deck, in, {"shear_modulus", "yield_strains", "yield_stresses"}, "tabulated_hardening");
  } else if (new_table) {
    complete = have(deck, in, {"yield_strains", "yield_stresses"}, "a new table of tabulated_hardening");
  }
  set(s.shear_modulus, in, "shear_modulus");
  s.rate = read_rate(deck, in, s.rate, "tabulated_hardening");
  if (complete && new_table && in.has("yield_strains") && in.has("yield_stresses")) {
    const std::vector<double> strain = in.numbers("yield_strains"), stress = in.numbers("yield_stresses");
    if (const char* fault = table_fault(strain, stress)) {
      deck.fail(*in.node("yield_strains"), fault, "strains from 0 on, stresses that do not fall");
      return s;
    }
    s.points = static_cast<int>(strain.size());
    std::copy(strain.begin(), strain.end(), s.strain.begin());
    std::copy(stress.begin(), stress.end(), s.stress.begin());
  }
  return s;
}

} // namespace

void read_strength(Deck& deck, const Section& in, Material& m, double temperature) {
  std::size_t model = model_of(m.strength);
  bool fresh = false;
  if (in.has("strength")) {
    model = static_cast<std::size_t>(in.choice("strength")); // the choices are in the order of the table
    fresh = model != model_of(m.strength);
  }
  refuse_foreign(deck, in, strength_keys(), model);
  switch (model) {
  case 0: m.strength = NoStrength{}; break;
  case 1: m.strength = read_linear(deck, in, m, fresh); break;
  case 2: m.strength = read_johnson_cook(deck, in, m, fresh, temperature); break;
  case 3: m.strength = read_steinberg(deck, in, m, fresh, temperature); break;
  case 4: m.strength = read_power_law(deck, in, m, fresh); break;
  case 5: m.strength = read_tabulated(deck, in, m, fresh); break;
  default: m.strength = read_viscoelastic(deck, in, m, model - 6, fresh); break;
  }
}

void read_failure(Deck& deck, const Section& in, Material& m, double temperature) {
  const std::vector<ModelKeys> table = {{"none", {}}, {"johnson_cook", {"D1", "D2", "D3", "D4", "D5"}}};
  bool fresh = false, wanted = m.failure.has_value();
  if (in.has("failure")) {
    wanted = in.choice("failure") == 1;
    fresh = wanted && !m.failure;
  }
  refuse_foreign(deck, in, table, wanted ? 1 : 0);
  if (!wanted) {
    m.failure.reset();
    return;
  }
  JohnsonCookFailure f = m.failure.value_or(JohnsonCookFailure{});
  if (fresh) {
    have(deck, in, {"D1", "D2", "D3", "D4", "D5"}, "failure johnson_cook");
  }
  set(f.D1, in, "D1");
  set(f.D2, in, "D2");
  set(f.D3, in, "D3");
  set(f.D4, in, "D4");
  set(f.D5, in, "D5");
  if (f.D5 != 0) {
    need_heat(deck, in, m, "failure johnson_cook (D5)");
  }
  if (!has_strength(m.strength)) {
    if (!fresh) {
      m.failure.reset(); // the deck took the strength of a named material away: nothing is left to break
      return;
    }
    deck.fail_key(*in.node("failure"), "a material without strength has no plastic strain to fail by", "with a `strength`");
  }
  if (tissue_law(m.strength) != nullptr) {
    if (!fresh) {
      m.failure.reset();
      return;
    }
    deck.fail_key(*in.node("failure"), "a viscoelastic material has no plastic strain to fail by", "failure = \"none\"");
  }
  const auto* cook = std::get_if<JohnsonCook>(&m.strength);
  f.reference_rate = cook != nullptr ? cook->reference_rate : 1.0;
  f.melt_temperature = m.melt_temperature;
  f.specific_heat = m.specific_heat;
  f.reference_temperature = cook != nullptr ? cook->reference_temperature : f.reference_temperature;
  f.start_temperature = temperature;
  m.failure = f;
}

} // namespace ballast
