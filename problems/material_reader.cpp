// [materials.NAME]: overrides of named materials and new ones.
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include "materials/library.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

/// Keys that belong to a model; any other model refuses them.
struct ModelKeys {
  std::string model;
  std::vector<std::string> keys;
};
const std::vector<ModelKeys>& eos_keys() {
  static const std::vector<ModelKeys> table = {
      {"ideal_gas", {"gamma", "conductivity"}},
      {"stiffened_gas", {"gamma", "p_infinity"}},
      {"mie_gruneisen", {"c0", "s", "gamma0", "gamma_constant"}}};
  return table;
}
const std::vector<ModelKeys>& strength_keys() {
  static const std::vector<ModelKeys> table = {
      {"none", {}},
      {"linear_hardening", {"shear_modulus", "yield", "hardening"}},
      {"johnson_cook", {"shear_modulus", "A", "B", "n", "C", "m", "reference_rate"}}};
  return table;
}

void refuse_foreign(Deck& deck,
                    const Section& in,
                    const std::vector<ModelKeys>& table,
                    std::size_t model) {
  const std::vector<std::string>& own = table[model].keys;
  for (const ModelKeys& other : table) {
    for (const std::string& key : other.keys) {
      if (in.has(key) && std::find(own.begin(), own.end(), key) == own.end()) {
        deck.fail_key(*in.node(key),
                      fmt::format("does not belong to the model {}", table[model].model),
                      own.empty() ? "none of its keys" : one_of(own));
      }
    }
  }
}

/// A key a new model cannot do without.
bool have(Deck& deck,
          const Section& in,
          std::initializer_list<const char*> keys,
          const std::string& model) {
  bool all = true;
  for (const char* key : keys) {
    if (in.self().find(key) == nullptr) {
      deck.fail({in.self().place,
                 in.self().key + "." + key,
                 fmt::format("missing; {} needs it", model),
                 {}});
      all = false;
    }
  }
  return all;
}

void set(double& value, const Section& in, const char* key) {
  value = in.number(key, value);
}

void read_eos(Deck& deck, const Section& in, Material& m, bool fresh) {
  constexpr double gas_conductivity = 0.026; // W/m/K, air's: other gases 0.01 to 0.18
  std::size_t model = m.eos.index();
  if (in.has("eos")) {
    model = static_cast<std::size_t>(in.choice("eos"));
    fresh = fresh || model != m.eos.index();
  }
  refuse_foreign(deck, in, eos_keys(), model);
  m.conductivity = model == 0 ? m.conductivity : 0;
  if (model == 0) {
    IdealGas eos = fresh ? IdealGas{} : std::get<IdealGas>(m.eos);
    if (fresh) {
      have(deck, in, {"gamma"}, "ideal_gas");
    }
    m.conductivity = fresh && m.specific_heat > 0 ? gas_conductivity : m.conductivity;
    set(eos.gamma, in, "gamma");
    set(m.conductivity, in, "conductivity");
    if (m.conductivity > 0 && m.specific_heat <= 0) {
      have(deck, in, {"specific_heat"}, "conductivity");
    }
    m.eos = eos;
  } else if (model == 1) {
    StiffenedGas eos = fresh ? StiffenedGas{} : std::get<StiffenedGas>(m.eos);
    if (fresh) {
      have(deck, in, {"gamma", "p_infinity"}, "stiffened_gas");
    }
    set(eos.gamma, in, "gamma");
    set(eos.p_infinity, in, "p_infinity");
    m.eos = eos;
  } else {
    MieGruneisen eos = fresh ? MieGruneisen{} : std::get<MieGruneisen>(m.eos);
    if (fresh) {
      have(deck, in, {"c0", "s", "gamma0"}, "mie_gruneisen");
    }
    eos.rho0 = m.density;
    set(eos.c0, in, "c0");
    set(eos.s, in, "s");
    set(eos.gamma0, in, "gamma0");
    eos.gamma_constant = in.has("gamma_constant") ? in.flag("gamma_constant") : eos.gamma_constant;
    m.eos = eos;
  }
}

void read_johnson_cook(Deck& deck, const Section& in, Material& m, bool fresh, double temperature) {
  JohnsonCook s = fresh ? JohnsonCook{} : std::get<JohnsonCook>(m.strength);
  if (fresh) {
    have(deck, in, {"shear_modulus", "A", "B", "n", "C", "m"}, "johnson_cook");
    if (m.melt_temperature <= 0 || m.specific_heat <= 0) {
      have(deck, in, {"melt_temperature", "specific_heat"}, "johnson_cook");
    }
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
  s.reference_temperature = temperature;
  m.strength = s;
}

void read_strength(Deck& deck, const Section& in, Material& m, double temperature) {
  std::size_t model = m.strength.index();
  bool fresh = false;
  if (in.has("strength")) {
    model = static_cast<std::size_t>(in.choice("strength"));
    fresh = model != m.strength.index();
  }
  refuse_foreign(deck, in, strength_keys(), model);
  if (model == 0) {
    m.strength = NoStrength{};
  } else if (model == 1) {
    LinearHardening s = fresh ? LinearHardening{} : std::get<LinearHardening>(m.strength);
    if (fresh) {
      have(deck, in, {"shear_modulus", "yield"}, "linear_hardening");
    }
    set(s.shear_modulus, in, "shear_modulus");
    set(s.yield, in, "yield");
    set(s.hardening, in, "hardening");
    m.strength = s;
  } else {
    read_johnson_cook(deck, in, m, fresh, temperature);
  }
}

} // namespace

MaterialBook::MaterialBook(Deck& deck,
                           DeckNode* table,
                           double ambient_pressure,
                           double ambient_temperature)
    : pressure_(ambient_pressure), temperature_(ambient_temperature) {
  if (table == nullptr) {
    return;
  }
  for (auto& [name, node] : table->fields) {
    if (!node.is_table()) {
      deck.fail(
          node, fmt::format("{} is not wanted here", describe(node)), "a table: [materials.NAME]");
      broken_.push_back(name);
    } else {
      define(deck, name, node);
    }
  }
}

void MaterialBook::define(Deck& deck, const std::string& name, DeckNode& node) {
  const std::size_t errors_before = deck.errors().size();
  const Section in = read_section(deck, node, scene_keys::material());
  const Material* known = find_material(in.text("base", name));
  const std::vector<std::string> names = material_names();
  Material m;
  if (known != nullptr) {
    m = *known;
  } else if (in.has("base")) {
    deck.fail(*in.node("base"),
              fmt::format("no material is called \"{}\"", in.text("base")),
              one_of(names));
  } else if (!in.has("eos") && node.find("eos") == nullptr) {
    const std::string meant = nearest(name, names);
    deck.fail_key(node,
                  fmt::format("no material is called \"{}\"{}",
                              name,
                              meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)),
                  one_of(names) + "; a new one needs `base`, or `eos` and `density`");
  } else {
    have(deck, in, {"density"}, "a new material");
  }
  m.name = name;
  set(m.density, in, "density");
  set(m.specific_heat, in, "specific_heat");
  set(m.melt_temperature, in, "melt_temperature");
  set(m.spall_pressure, in, "spall_pressure");
  if (in.has("melt_temperature") && m.melt_temperature <= temperature_) {
    deck.fail(*in.node("melt_temperature"),
              fmt::format("{:g} K is not above the ambient temperature {:g} K",
                          m.melt_temperature,
                          temperature_));
  }
  if (deck.errors().size() == errors_before) {
    read_eos(deck, in, m, known == nullptr);
    read_strength(deck, in, m, temperature_);
  }
  m.confidence = m.confidence.empty() ? "deck" : m.confidence;
  m.source = in.text("source", m.source.empty() ? "deck" : m.source + "; changed by the deck");
  if (deck.errors().size() > errors_before) {
    broken_.push_back(name);
  }
  defined_[name] = std::move(m);
}

std::optional<int> MaterialBook::index(Deck& deck, const std::string& name, DeckNode& blame) {
  if (name == "void") {
    return -1;
  }
  for (std::size_t i = 0; i < used_.size(); ++i) {
    if (used_[i].name == name) {
      return static_cast<int>(i);
    }
  }
  const auto own = defined_.find(name);
  const Material* found = own != defined_.end() ? &own->second : find_material(name);
  if (found == nullptr) {
    std::vector<std::string> names = material_names();
    for (const auto& [defined, material] : defined_) {
      if (std::find(names.begin(), names.end(), defined) == names.end()) {
        names.push_back(defined);
      }
    }
    names.emplace_back("void");
    const std::string meant = nearest(name, names);
    deck.fail(blame,
              fmt::format("no material is called \"{}\"{}",
                          name,
                          meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)),
              one_of(names));
    return std::nullopt;
  }
  if (std::find(broken_.begin(), broken_.end(), name) != broken_.end()) {
    return std::nullopt;
  }
  Material m = *found;
  m.reference_temperature = temperature_;
  if (auto* jc = std::get_if<JohnsonCook>(&m.strength)) {
    jc->reference_temperature = temperature_;
  }
  m.specific_energy = energy(m.eos, m.density, pressure_);
  used_.push_back(std::move(m));
  return static_cast<int>(used_.size()) - 1;
}

} // namespace ballast
