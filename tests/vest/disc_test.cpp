// A lead disc on a printed-law vest around the axis: the parts of the energy account are what they say, not only right in the sum.
#include "ale/layer_coupling.hpp"
#include "ale/simulation.hpp"
#include "tests/vest/lead_block.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

/// Lead of 6 mm by 3 mm at 370 m/s onto three layers of a vest.
Scene<2> disc_on_vest() {
  Scene<2> scene;
  Block<2> b = lead_block(even_lines(0, 3e-3, 6), even_lines(-3e-3, 0, 6), {0, 370}, true);
  b.boundary.side[0] = {{{BoundaryKind::symmetry, 0}, {BoundaryKind::free, 0}}};
  b.boundary.side[1] = {{{BoundaryKind::free, 0}, {BoundaryKind::free, 0}}};
  scene.blocks.push_back(std::move(b));
  scene.numerics.spall = false;

  LayerInput in;
  in.name = "vest";
  in.model = fabric_laws::paper();
  in.axisymmetric = true;
  in.lines[0] = even_lines(0, 20e-3, 20);
  in.levels = even_lines(0.1e-3, 4e-3, 3);
  in.layers = 3;
  in.edge[0] = {LayerEdge::symmetry, LayerEdge::free};
  Layers<2> l;
  l.stack = make_stack<2>(in);
  scene.layers.push_back(std::move(l));
  prepare(scene);
  return scene;
}

TEST(DiscOnVest, InternalEnergyIsThatOfTheStrain) {
  Scene<2> scene = disc_on_vest();
  const LayerStack<2>& s = scene.layers[0].stack;
  const LayerLedger& ledger = scene.layers[0].ledger;
  const double start = totals(scene.blocks[0]).kinetic_energy + totals(scene.blocks[0]).internal(), kinetic = totals(scene.blocks[0]).kinetic_energy;
  Clock clock;
  clock.end_time = 10e-6;
  double worst = 0, most = 0;
  while (!clock.done()) {
    advance(scene, clock);
    EXPECT_GE(ledger.contact_loss, -1e-9);
    const LayerTotals t = totals(s);
    const stacks::Stored stored = stacks::stored_energy(s);
    most = std::max(most, t.internal);
    worst = std::max(worst, std::abs(t.internal - stored.strain));
    EXPECT_GE(t.hourglass, stored.held - 1e-3 * most); // the rest is heat of its viscosity
    const Totals b = totals(scene.blocks[0]);
    EXPECT_NEAR(b.kinetic_energy + b.internal() + t.leapfrog_kinetic + t.internal + t.hourglass + t.shock_heat + ledger.contact_loss + ledger.step_change, start, 1e-12 * kinetic);
  }
  EXPECT_EQ(ledger.eroded_elements, 0);
  EXPECT_GT(most, 0.02 * kinetic);
  EXPECT_LT(worst, 0.01 * most); // second order in the step
}

} // namespace
} // namespace ballast
