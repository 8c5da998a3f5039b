// Viscoelastic deviators of a material from its deck section.
#include "problems/material_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

/// The law of a named material that the deck changes, or a new one.
template <class Law> Law law_of(const Material& m, bool fresh) {
  const TissueLaw* known = fresh ? nullptr : tissue_law(m.strength);
  return known != nullptr ? std::get<Law>(*known) : Law{};
}

/// Sets one number of each branch from a list; a new law takes its count of branches from `branch_time`, a known one keeps its own.
template <class Branch>
void set_branches(Deck& deck, const Section& in, std::array<Branch, most_visco_branches>& branch, std::size_t count, const char* key, double Branch::*member) {
  if (!in.has(key) || count == 0) { // without times: an error already
    return;
  }
  const std::vector<double> values = in.numbers(key);
  if (values.size() != count) {
    deck.fail(*in.node(key), fmt::format("{} entries, but branches: {}", values.size(), count), "a number for each entry of `branch_time`");
    return;
  }
  for (std::size_t b = 0; b < count; ++b) {
    branch[b].*member = values[b];
  }
}
template <class Law> void count_branches(const Section& in, Law& law) {
  law.branches = in.has("branch_time") ? in.numbers("branch_time").size() : law.branches;
}

/// Branches that a changed `branch_time` adds have nothing but a time.
template <class Law> void refuse_new_branches(Deck& deck, const Section& in, const Law& law, std::size_t before, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (law.branches > before && !in.has(key)) {
      have(deck, in, {key}, fmt::format("a law with {} branches instead of {}", law.branches, before));
    }
  }
}

Prony read_prony(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto s = law_of<Prony>(m, fresh);
  if (fresh) {
    have(deck, in, {"long_shear", "branch_shear", "branch_time"}, "prony");
  }
  const std::size_t before = s.branches;
  set(s.long_shear, in, "long_shear");
  count_branches(in, s);
  refuse_new_branches(deck, in, s, fresh ? s.branches : before, {"branch_shear"});
  set_branches(deck, in, s.branch, s.branches, "branch_time", &PronyBranch::time);
  set_branches(deck, in, s.branch, s.branches, "branch_shear", &PronyBranch::shear);
  return s;
}

PowerLawZener read_power_law(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto s = law_of<PowerLawZener>(m, fresh);
  if (fresh) {
    have(deck, in, {"long_shear", "branch_shear", "branch_time", "branch_reference", "branch_exponent"}, "power_law");
  }
  const std::size_t before = s.branches;
  set(s.long_shear, in, "long_shear");
  count_branches(in, s);
  refuse_new_branches(deck, in, s, fresh ? s.branches : before, {"branch_shear", "branch_reference", "branch_exponent"});
  set_branches(deck, in, s.branch, s.branches, "branch_time", &PowerLawBranch::time);
  set_branches(deck, in, s.branch, s.branches, "branch_shear", &PowerLawBranch::shear);
  set_branches(deck, in, s.branch, s.branches, "branch_reference", &PowerLawBranch::reference);
  set_branches(deck, in, s.branch, s.branches, "branch_exponent", &PowerLawBranch::exponent);
  return s;
}

FungQlv read_fung(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto s = law_of<FungQlv>(m, fresh);
  if (fresh) {
    have(deck, in, {"shear_modulus", "stiffening", "branch_share", "branch_time"}, "fung");
  }
  const std::size_t before = s.branches;
  set(s.shear, in, "shear_modulus");
  set(s.stiffening, in, "stiffening");
  count_branches(in, s);
  refuse_new_branches(deck, in, s, fresh ? s.branches : before, {"branch_share"});
  set_branches(deck, in, s.branch, s.branches, "branch_time", &FungBranch::time);
  set_branches(deck, in, s.branch, s.branches, "branch_share", &FungBranch::share);
  double sum = 0;
  for (std::size_t b = 0; b < s.branches; ++b) {
    sum += s.branch[b].share;
  }
  if (sum > 1 + 1e-12 && in.has("branch_share")) {
    deck.fail(*in.node("branch_share"), fmt::format("the shares add up to {:g}: more than there is would relax", sum), "a sum of at most 1");
  }
  return s;
}

BergstroemBoyce read_bergstroem_boyce(Deck& deck, const Section& in, const Material& m, bool fresh) {
  auto s = law_of<BergstroemBoyce>(m, fresh);
  if (fresh) {
    have(deck, in, {"network_a_shear", "network_b_shear", "flow_rate", "flow_stress", "flow_exponent"}, "bergstroem_boyce");
  }
  set(s.a.shear, in, "network_a_shear");
  set(s.b.shear, in, "network_b_shear");
  set(s.a.lock_stretch, in, "lock_stretch");
  set(s.b.lock_stretch, in, "lock_stretch");
  set(s.rate, in, "flow_rate");
  set(s.base, in, "flow_stress");
  set(s.exponent, in, "flow_exponent");
  set(s.stretch_power, in, "flow_stretch_power");
  set(s.start, in, "flow_start");
  return s;
}

} // namespace

Viscoelastic read_viscoelastic(Deck& deck, const Section& in, const Material& m, std::size_t law, bool fresh) {
  switch (law) {
  case 0: return {read_prony(deck, in, m, fresh)};
  case 1: return {read_power_law(deck, in, m, fresh)};
  case 2: return {read_fung(deck, in, m, fresh)};
  default: return {read_bergstroem_boyce(deck, in, m, fresh)};
  }
}

} // namespace ballast
