// A block that strikes a plate and slides along it: its sides do not plough, Coulomb's law, and the same heat of friction in any substeps.
#include "ale/layer_coupling.hpp"
#include "ale/simulation.hpp"
#include "tests/vest/lead_block.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

/// Lead of 4 mm by 2 mm, free all around, at 50 m/s along and 10 m/s into a plate above it.
Scene<2> sliding_block(double friction, int substeps) {
  Scene<2> scene;
  Block<2> b = lead_block(even_lines(0, 4e-3, 8), even_lines(-2e-3, 0, 6), {50, 10});
  for (auto& axis : b.boundary.side) {
    axis = {{{BoundaryKind::free, 0}, {BoundaryKind::free, 0}}};
  }
  scene.blocks.push_back(std::move(b));
  scene.numerics.spall = false;

  LayerInput in;
  in.name = "plate";
  in.model = HookeSolid{200e9, 0.2, 4000};
  in.lines[0] = even_lines(-5e-3, 15e-3, 50);
  in.levels = even_lines(0, 2e-3, 2);
  in.through = 2;
  Layers<2> l;
  l.stack = make_stack<2>(in);
  l.contact.friction = friction;
  l.substeps = substeps;
  scene.layers.push_back(std::move(l));
  prepare(scene);
  return scene;
}

struct Slide {
  std::array<double, 3> given; ///< momentum of the plate, kg m/s a metre
  double friction = 0, contact = 0, energy_error = 0; ///< J
};

Slide slide(double friction, int substeps) {
  Scene<2> scene = sliding_block(friction, substeps);
  const auto sums = [&] {
    const Totals b = totals(scene.blocks[0]);
    const LayerTotals l = totals(scene.layers[0].stack);
    const LayerLedger& ledger = scene.layers[0].ledger;
    return b.kinetic_energy + b.internal() + l.leapfrog_kinetic + l.internal + l.hourglass + l.shock_heat + ledger.contact_loss + ledger.step_change;
  };
  const double start = sums();
  Clock clock;
  clock.end_time = 6e-6;
  EXPECT_TRUE(run(scene, clock));
  const LayerLedger& ledger = scene.layers[0].ledger;
  return {totals(scene.layers[0].stack).momentum, ledger.friction_loss, ledger.contact_loss, sums() - start};
}

TEST(BlockSlide, SidesDoNotPloughASlipperyPlate) {
  for (const int substeps : {1, 4}) {
    const Slide s = slide(0, substeps);
    EXPECT_GT(s.given[1], 0.1);
    EXPECT_LT(std::abs(s.given[0]), 2e-3 * s.given[1]) << substeps;
    EXPECT_EQ(s.friction, 0);
  }
}

TEST(BlockSlide, CoulombsShareAndItsHeat) {
  const double mu = 0.2;
  std::vector<Slide> all;
  for (const int substeps : {1, 2, 8, 32}) {
    all.push_back(slide(mu, substeps));
    const Slide& s = all.back();
    EXPECT_NEAR(s.given[0] / s.given[1], mu, 0.02 * mu) << substeps;
    EXPECT_NEAR(s.friction, all.front().friction, 0.03 * all.front().friction) << substeps;
    EXPECT_GT(s.friction, 0.9 * s.given[0] * 45); // the slip is slowed from 50 m/s
    EXPECT_LT(s.friction, 1.02 * s.given[0] * 50);
    EXPECT_GE(s.contact, s.friction * 0.98);
    EXPECT_LT(std::abs(s.energy_error), 1e-9);
  }
}

} // namespace
} // namespace ballast
