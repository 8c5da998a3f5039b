// Readers of a material's models from its deck section (problems/material_reader calls them).
#pragma once

#include "core/deck_keys.hpp"
#include "materials/material.hpp"

#include <initializer_list>
#include <string>
#include <vector>

namespace ballast {

/// Keys that belong to a model; any other model refuses them.
struct ModelKeys {
  std::string model;
  std::vector<std::string> keys;
};
void refuse_foreign(Deck& deck, const Section& in, const std::vector<ModelKeys>& table, std::size_t model);

/// Keys a model cannot do without; false, and an error each, if they are not there.
bool have(Deck& deck, const Section& in, std::initializer_list<const char*> keys, const std::string& model);

/// A key's number, if it is there.
inline void set(double& value, const Section& in, const char* key) { value = in.number(key, value); }

/// Equation of state of `m`, changed by the section. `fresh`: the material has none yet.
void read_eos(Deck& deck, const Section& in, Material& m, bool fresh);
/// Strength; after the equation of state. `temperature`: ambient, K.
void read_strength(Deck& deck, const Section& in, Material& m, double temperature);
/// The `law`-th of TissueLaw; `fresh`: the material has another model.
Viscoelastic read_viscoelastic(Deck& deck, const Section& in, const Material& m, std::size_t law, bool fresh);
/// Failure; after strength.
void read_failure(Deck& deck, const Section& in, Material& m, double temperature);

} // namespace ballast
