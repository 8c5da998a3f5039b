// Equation of state of a material from its deck section.
#include "problems/material_models.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {

const std::vector<ModelKeys>& eos_keys() {
  static const std::vector<ModelKeys> table = {
      {"ideal_gas", {"gamma", "conductivity"}},
      {"stiffened_gas", {"gamma", "p_infinity"}},
      {"mie_gruneisen", {"c0", "s", "gamma0", "gamma_constant"}},
      {"cubic_gruneisen", {"c0", "s1", "s2", "s3", "gamma0", "b"}},
      {"jwl", {"jwl_A", "jwl_B", "R1", "R2", "omega", "detonation_energy"}},
      {"linear_bulk", {"bulk_modulus", "gamma0"}},
      {"bubbly", {"gas_fraction", "gas_pressure", "gamma", "c0", "skeleton_modulus"}},
      {"p_alpha", {"solid_density", "bulk_modulus", "foam_modulus", "crush_pressure", "solid_pressure"}}};
  return table;
}

/// The model a section changes: what the material has, or, for another model, a new one that needs its keys.
template <class Model>
Model start(Deck& deck, const Section& in, const Material& m, bool fresh, std::initializer_list<const char*> keys, const char* name) {
  if (fresh) {
    have(deck, in, keys, name);
    return {};
  }
  return std::get<Model>(m.eos);
}

IdealGas read_ideal(Deck& deck, const Section& in, Material& m, bool fresh) {
  constexpr double gas_conductivity = 0.026; // W/m/K, air's: other gases 0.01 to 0.18
  auto eos = start<IdealGas>(deck, in, m, fresh, {"gamma"}, "ideal_gas");
  m.conductivity = fresh && m.specific_heat > 0 ? gas_conductivity : m.conductivity;
  set(eos.gamma, in, "gamma");
  set(m.conductivity, in, "conductivity");
  if (m.conductivity > 0 && m.specific_heat <= 0) {
    have(deck, in, {"specific_heat"}, "conductivity");
  }
  return eos;
}

StiffenedGas read_stiffened(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto eos = start<StiffenedGas>(deck, in, m, fresh, {"gamma", "p_infinity"}, "stiffened_gas");
  set(eos.gamma, in, "gamma");
  set(eos.p_infinity, in, "p_infinity");
  return eos;
}

MieGruneisen read_gruneisen(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto eos = start<MieGruneisen>(deck, in, m, fresh, {"c0", "s", "gamma0"}, "mie_gruneisen");
  eos.rho0 = m.density;
  set(eos.c0, in, "c0");
  set(eos.s, in, "s");
  set(eos.gamma0, in, "gamma0");
  eos.gamma_constant = in.has("gamma_constant") ? in.flag("gamma_constant") : eos.gamma_constant;
  return eos;
}

CubicGruneisen read_cubic(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto eos = start<CubicGruneisen>(deck, in, m, fresh, {"c0", "s1", "gamma0"}, "cubic_gruneisen");
  eos.rho0 = m.density;
  set(eos.c0, in, "c0");
  set(eos.s1, in, "s1");
  set(eos.s2, in, "s2");
  set(eos.s3, in, "s3");
  set(eos.gamma0, in, "gamma0");
  set(eos.b, in, "b");
  return eos;
}

Jwl read_jwl(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto eos = start<Jwl>(deck, in, m, fresh, {"jwl_A", "jwl_B", "R1", "R2", "omega"}, "jwl");
  eos.rho0 = m.density;
  set(eos.A, in, "jwl_A");
  set(eos.B, in, "jwl_B");
  set(eos.R1, in, "R1");
  set(eos.R2, in, "R2");
  set(eos.omega, in, "omega");
  set(eos.detonation_energy, in, "detonation_energy");
  return eos;
}

LinearBulk read_bulk(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto eos = start<LinearBulk>(deck, in, m, fresh, {"bulk_modulus"}, "linear_bulk");
  eos.rho0 = m.density;
  set(eos.K, in, "bulk_modulus");
  set(eos.gamma0, in, "gamma0");
  return eos;
}

/// A gas fraction that leaves what can be tissue, stiffer than the gas.
void check_tissue(Deck& deck, const Section& in, const Bubbly& eos) {
  constexpr double lightest = 300, densest = 3000; // kg/m3: fat is 900, bone 2000
  DeckNode* given = in.has("gas_fraction") ? in.node("gas_fraction") : in.has("density") ? in.node("density") : nullptr;
  DeckNode& blame = given != nullptr ? *given : in.self();
  if (!(eos.gas_fraction < 1)) {
    deck.fail(blame, "a gas fraction of 1 leaves no tissue", "below 1; eos = \"ideal_gas\" for gas alone");
    return;
  }
  const double tissue = eos.rho0 / (1 - eos.gas_fraction);
  if (tissue < lightest || tissue > densest) {
    deck.fail(blame,
              fmt::format("{:g} kg/m3 with {:g} of it gas make tissue of {:g} kg/m3, which there is not", eos.rho0, eos.gas_fraction, tissue),
              fmt::format("density/(1 - gas_fraction) from {:g} to {:g} kg/m3", lightest, densest));
  } else if (eos.tissue_modulus() < 100 * eos.gas_pressure) {
    deck.fail(in.has("c0") ? *in.node("c0") : blame,
              fmt::format("tissue of bulk modulus {:g} Pa is not stiff beside gas at {:g} Pa", eos.tissue_modulus(), eos.gas_pressure),
              "c0 of the tissue alone, 1400 to 1700 m/s");
  }
}

Bubbly read_bubbly(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto eos = start<Bubbly>(deck, in, m, fresh, {"gas_fraction", "c0"}, "bubbly");
  eos.rho0 = m.density;
  set(eos.gas_fraction, in, "gas_fraction");
  set(eos.gas_pressure, in, "gas_pressure");
  set(eos.gamma, in, "gamma");
  set(eos.c0, in, "c0");
  set(eos.skeleton_modulus, in, "skeleton_modulus");
  check_tissue(deck, in, eos);
  return eos;
}

/// Why there is no such foam, or null.
const char* foam_fault(const PAlpha& eos) {
  if (eos.solid_density <= eos.rho0) {
    return "the foam is not lighter than its solid";
  }
  if (eos.solid_pressure <= eos.crush_pressure) {
    return "it is solid before it begins to crush";
  }
  if (eos.foam_modulus / eos.share() >= eos.K) {
    return "the foam is stiffer by its share of solid than the solid: foam_modulus solid_density/density must be below bulk_modulus";
  }
  const bool crushes = eos.first_crush() - eos.crush_pressure / eos.K < 1;
  return crushes ? nullptr : "the foam is as dense as its solid before it begins to crush: crush_pressure is too far above foam_modulus";
}

PAlpha read_foam(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto eos = start<PAlpha>(deck, in, m, fresh, {"solid_density", "bulk_modulus", "foam_modulus", "crush_pressure", "solid_pressure"}, "p_alpha");
  eos.rho0 = m.density;
  set(eos.solid_density, in, "solid_density");
  set(eos.K, in, "bulk_modulus");
  set(eos.foam_modulus, in, "foam_modulus");
  set(eos.crush_pressure, in, "crush_pressure");
  set(eos.solid_pressure, in, "solid_pressure");
  if (const char* fault = foam_fault(eos)) {
    deck.fail(in.has("solid_density") ? *in.node("solid_density") : in.self(), fault, "0 < crush_pressure < solid_pressure, density < solid_density");
  }
  return eos;
}

} // namespace

void read_eos(Deck& deck, const Section& in, Material& m, bool fresh) {
  std::size_t model = m.eos.index();
  if (in.has("eos")) {
    model = static_cast<std::size_t>(in.choice("eos")); // the choices are in the order of the variant
    fresh = fresh || model != m.eos.index();
  }
  refuse_foreign(deck, in, eos_keys(), model);
  m.conductivity = model == 0 ? m.conductivity : 0;
  switch (model) {
  case 0: m.eos = read_ideal(deck, in, m, fresh); break;
  case 1: m.eos = read_stiffened(deck, in, m, fresh); break;
  case 2: m.eos = read_gruneisen(deck, in, m, fresh); break;
  case 3: m.eos = read_cubic(deck, in, m, fresh); break;
  case 4: m.eos = read_jwl(deck, in, m, fresh); break;
  case 5: m.eos = read_bulk(deck, in, m, fresh); break;
  case 6: m.eos = read_bubbly(deck, in, m, fresh); break;
  default: m.eos = read_foam(deck, in, m, fresh); break;
  }
}

} // namespace ballast
