// A block of lead that strikes layers, shared by the tests of both.
#pragma once

#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "materials/library.hpp"
#include "tests/layers/stacks.hpp"

namespace ballast {

/// A Lagrangian block of the named lead, without failure, between lines of n1 by n2 cells; its sides are the test's to set.
inline Block<2> lead_block(std::vector<double> across, std::vector<double> along, const std::array<double, 2>& velocity, bool axisymmetric = false, bool strength = true) {
  Block<2> b;
  b.axisymmetric = axisymmetric;
  b.motion = {MotionPolicy::lagrangian, 1};
  Material lead = *find_material("lead");
  if (!strength) {
    lead.strength = NoStrength{};
  }
  lead.failure.reset();
  lead.specific_energy = energy(lead.eos, lead.density, 0);
  b.materials.push_back(make_slot(lead, 0));
  allocate_block(b, std::array<std::vector<double>, 3>{std::move(across), std::move(along), {}});
  for_each_cell(b, [&](int i, int j, int k) {
    const CellPart part{0, 1, lead.density, lead.specific_energy};
    fill_cell<2>(b, i, j, k, std::span(&part, 1));
  });
  set_velocity(b, [&](const std::array<double, 2>&, std::array<double, 2>& u) { u = velocity; });
  return b;
}

} // namespace ballast
