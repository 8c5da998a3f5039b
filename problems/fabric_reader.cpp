#include "problems/fabric_reader.hpp"

#include "problems/material_models.hpp"
#include "problems/scene_keys.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {
namespace {

const std::vector<ModelKeys>& model_keys() {
  static const std::vector<ModelKeys> keys = {
      {"raftenberg", {"warp", "fill", "unload", "transverse", "transverse_form", "shear_in_plane", "shear_through", "solid", "secant_unloading", "rate", "coupling"}},
      {"hooke", {"young", "poisson"}}};
  return keys;
}

void read_fit(const Section& in, RationalFit& fit) {
  set(fit.a, in, "a"), set(fit.b, in, "b"), set(fit.c, in, "c"), set(fit.d, in, "d");
  set(fit.e, in, "e"), set(fit.f, in, "f");
}

/// A constant that two keys give is one too many.
void read_family(Deck& deck, const Section& in, const char* name, YarnFamily& y) {
  set(y.unload, in, "unload");
  DeckNode* node = in.node(name);
  if (node == nullptr) {
    return;
  }
  const Section family = read_section(deck, *node, scene_keys::yarns());
  read_fit(family, y.fit);
  set(y.rupture, family, "rupture");
  if (in.has("unload") && family.has("unload")) {
    deck.fail_key(*family.node("unload"), fmt::format("contradicts `unload` of the fabric, {:g}", in.number("unload")), "one of the two");
  }
  set(y.unload, family, "unload");
}

/// A modulus, "awg", or a table.
void read_shear(Deck& deck, const Section& in, const char* key, ShearLaw& law) {
  DeckNode* node = in.node(key);
  if (node == nullptr) {
    return;
  }
  if (node->is_table()) {
    const Section s = read_section(deck, *node, scene_keys::shear());
    law = {s.number("modulus", 0), s.number("stiffer", 0), s.number("stiffest", 0), s.number("first_angle", 1), s.number("second_angle", 1)};
  } else if (node->is_text() && node->text == "awg") {
    law = awg_shear();
  } else if (read_quantity(deck, *node, Dimension::pressure, not_negative())) {
    law = {};
    law.modulus = node->number;
  }
}

/// An option that is off, on as it comes, or a table.
template <class Option> bool read_option(Deck& deck, const Section& in, const char* key, const SectionSpec& spec, std::optional<Option>& option) {
  DeckNode* node = in.node(key);
  if (node == nullptr) {
    return false;
  }
  if (node->kind == DeckNode::Kind::flag) {
    option = node->flag ? std::optional(Option{}) : std::nullopt;
    return false;
  }
  if (!node->is_table()) {
    deck.fail(*node, fmt::format("{} is not wanted here", describe(*node)), "true, false or a table");
    return false;
  }
  read_section(deck, *node, spec);
  option = Option{};
  return true;
}

void read_raftenberg(Deck& deck, const Section& in, RaftenbergFabric& m) {
  read_family(deck, in, "warp", m.warp);
  read_family(deck, in, "fill", m.fill);
  if (DeckNode* node = in.node("transverse")) {
    read_fit(read_section(deck, *node, scene_keys::transverse()), m.transverse);
  }
  m.form = in.has("transverse_form") ? static_cast<TransverseForm>(in.choice("transverse_form")) : m.form;
  read_shear(deck, in, "shear_in_plane", m.in_plane);
  read_shear(deck, in, "shear_through", m.through);
  if (read_option(deck, in, "solid", scene_keys::solid(), m.solid)) {
    const Section solid(*in.node("solid"), scene_keys::solid());
    set(m.solid->density, solid, "density");
    set(m.solid->bulk_modulus, solid, "bulk_modulus");
  }
  m.secant_unloading = in.has("secant_unloading") ? in.flag("secant_unloading") : m.secant_unloading;
  if (read_option(deck, in, "rate", scene_keys::rate(), m.rate)) {
    const Section rate(*in.node("rate"), scene_keys::rate());
    set(m.rate->C, rate, "C");
    set(m.rate->reference_rate, rate, "reference_rate");
  }
  set(m.coupling, in, "coupling");
}

void read_hooke(const Section& in, HookeSolid& m) {
  set(m.young, in, "young");
  set(m.poisson, in, "poisson");
}

/// What a new fabric starts from: nothing is known of its plies.
bool start_new(Deck& deck, const Section& in, const std::string& name, FabricMaterial& m) {
  const std::vector<std::string> names = fabric_names();
  if (in.has("base")) {
    deck.fail(*in.node("base"), fmt::format("no fabric is called \"{}\"", in.text("base")), one_of(names));
    return false;
  }
  if (in.self().find("law") == nullptr) {
    const std::string meant = nearest(name, names);
    deck.fail_key(in.self(), fmt::format("no fabric is called \"{}\"{}", name, meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)),
                  one_of(names) + "; a new one needs `base`, or `law` and its constants");
    return false;
  }
  if (!in.has("law")) {
    return false;
  }
  if (in.choice("law") == 1) {
    m.model = HookeSolid{};
    return have(deck, in, {"young", "poisson"}, "hooke");
  }
  return have(deck, in, {"warp", "fill", "transverse", "shear_in_plane", "shear_through"}, "raftenberg");
}

/// The constants alone: the density is a stack's.
void check_constants(Deck& deck, DeckNode& node, const FabricMaterial& m) {
  try {
    check(m.model, m.name);
  } catch (const Error& error) {
    deck.fail_key(node, error.what(), "constants of a fabric");
  }
}

} // namespace

FabricBook::FabricBook(Deck& deck, DeckNode* table) {
  if (table == nullptr) {
    return;
  }
  for (auto& [name, node] : table->fields) {
    if (!node.is_table()) {
      deck.fail(node, fmt::format("{} is not wanted here", describe(node)), "a table: [fabrics.NAME]");
      broken_.push_back(name);
    } else {
      define(deck, name, node);
    }
  }
}

void FabricBook::define(Deck& deck, const std::string& name, DeckNode& node) {
  const std::size_t errors_before = deck.errors().size();
  const Section in = read_section(deck, node, scene_keys::fabric());
  const FabricMaterial* known = find_fabric(in.text("base", name));
  FabricMaterial m;
  if (known != nullptr) {
    m = *known;
    if (in.has("law")) {
      deck.fail_key(*in.node("law"), fmt::format("{} has its law already", known->name), "leave it out, or a new name without `base`");
    }
  } else {
    start_new(deck, in, name, m);
  }
  m.name = name;
  if (deck.errors().size() == errors_before) {
    refuse_foreign(deck, in, model_keys(), m.model.index());
  }
  if (deck.errors().size() == errors_before) {
    if (auto* fabric = std::get_if<RaftenbergFabric>(&m.model)) {
      read_raftenberg(deck, in, *fabric);
    } else {
      read_hooke(in, std::get<HookeSolid>(m.model));
    }
  }
  if (deck.errors().size() == errors_before) {
    check_constants(deck, node, m);
  }
  m.source = in.text("source", m.source.empty() ? "deck" : m.source + "; changed by the deck");
  if (deck.errors().size() > errors_before) {
    broken_.push_back(name);
  }
  defined_[name] = std::move(m);
}

const FabricMaterial* FabricBook::find(Deck& deck, const std::string& name, DeckNode& blame) const {
  if (std::find(broken_.begin(), broken_.end(), name) != broken_.end()) {
    return nullptr;
  }
  const auto own = defined_.find(name);
  const FabricMaterial* found = own != defined_.end() ? &own->second : find_fabric(name);
  if (found == nullptr) {
    std::vector<std::string> names = fabric_names();
    for (const auto& [defined, fabric] : defined_) {
      if (std::find(names.begin(), names.end(), defined) == names.end()) {
        names.push_back(defined);
      }
    }
    const std::string meant = nearest(name, names);
    deck.fail(blame, fmt::format("no fabric is called \"{}\"{}", name, meant.empty() ? "" : fmt::format("; did you mean \"{}\"?", meant)), one_of(names));
  }
  return found;
}

} // namespace ballast
