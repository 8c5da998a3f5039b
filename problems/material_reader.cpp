// [materials.NAME]: overrides of named materials and new ones.
#include "problems/material_models.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reading.hpp"

#include "materials/library.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {

void refuse_foreign(Deck& deck, const Section& in, const std::vector<ModelKeys>& table, std::size_t model) {
  const std::vector<std::string>& own = table[model].keys;
  std::vector<std::string> known = own; // and those refused already
  for (const ModelKeys& other : table) {
    for (const std::string& key : other.keys) {
      if (in.has(key) && std::find(known.begin(), known.end(), key) == known.end()) {
        deck.fail_key(*in.node(key),
                      fmt::format("does not belong to the model {}", table[model].model),
                      own.empty() ? "none of its keys" : one_of(own));
        known.push_back(key);
      }
    }
  }
}

bool have(Deck& deck, const Section& in, std::initializer_list<const char*> keys, const std::string& model) {
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
    read_failure(deck, in, m, temperature_);
  }
  m.confidence = m.confidence.empty() ? "deck" : m.confidence;
  m.source = in.text("source", m.source.empty() ? "deck" : m.source + "; changed by the deck");
  if (deck.errors().size() > errors_before) {
    broken_.push_back(name);
  }
  defined_[name] = std::move(m);
}

namespace {
/// Energy that a charge of explosive brings along, J/kg; 0: none.
double charge_of(const Eos& eos) {
  const auto* products = std::get_if<Jwl>(&eos);
  return products != nullptr ? products->detonation_energy : 0.0;
}

/// The material's initial state in the scene's surroundings.
void start_at(Material& m, double pressure, double temperature) {
  m.reference_temperature = temperature;
  if (auto* jc = std::get_if<JohnsonCook>(&m.strength)) {
    jc->start_temperature = temperature;
  }
  if (auto* sg = std::get_if<SteinbergGuinan>(&m.strength)) {
    sg->reference_temperature = temperature;
  }
  if (m.failure) {
    m.failure->start_temperature = temperature;
  }
  if (auto* bulk = std::get_if<LinearBulk>(&m.eos)) {
    bulk->p0 = pressure;
  }
  if (auto* lung = std::get_if<Bubbly>(&m.eos)) {
    lung->p_rest = pressure;
  }
  if (auto* foam = std::get_if<PAlpha>(&m.eos)) {
    foam->p_rest = pressure;
  }
  const double charge = charge_of(m.eos);
  m.specific_energy = charge > 0 ? charge : energy(m.eos, m.density, pressure);
}
} // namespace

StartState start_state(Deck& deck, const Section& in, const Material& m, double density, double ambient) {
  const double charge = charge_of(m.eos);
  if (barotropic(m.eos) && in.has("pressure")) {
    deck.fail_key(*in.node("pressure"), fmt::format("the pressure of {} depends on its density alone", m.name), "a `density`");
  }
  if (in.has("pressure") || (charge == 0 && !barotropic(m.eos))) {
    const double p = in.number("pressure", ambient);
    return {energy(m.eos, density, p), p};
  }
  return {charge, pressure(m.eos, density, charge)};
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
  start_at(m, pressure_, temperature_);
  used_.push_back(std::move(m));
  return static_cast<int>(used_.size()) - 1;
}

} // namespace ballast
