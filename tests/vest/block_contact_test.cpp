// Laws of contact between a block and fabric layers: momentum and energy in their account, impedance match.
#include "ale/layer_coupling.hpp"
#include "ale/simulation.hpp"
#include "tests/vest/lead_block.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double width = 1e-3;

/// Linear bulk lead, no strength, flying up at `speed` onto a Hooke plate of `layers` layers; a strip of one or more cells across.
Scene<2> strip(double speed, int across, int layers, int substeps, const HookeSolid& plate, double gap = 0, int fabric_across = 0) {
  Scene<2> scene;
  Block<2> b = lead_block(even_lines(0, width, across), even_lines(-6e-3, 0, 60), {0, speed}, false, false);
  for (const std::size_t side : {0UL, 1UL}) {
    b.boundary.side[0][side] = {BoundaryKind::symmetry, 0};
    b.boundary.side[1][side] = {BoundaryKind::free, 0};
  }
  b.boundary.normal = {{{0, 0}, {1, 1}, {2, 2}}};
  scene.blocks.push_back(std::move(b));
  scene.numerics.spall = false;

  LayerInput in;
  in.name = "plate";
  in.model = plate;
  in.lines[0] = even_lines(0, width, fabric_across > 0 ? fabric_across : across);
  in.levels = even_lines(gap, gap + 6e-3, layers * (60 / layers));
  in.layers = layers;
  in.through = 60 / layers;
  in.edge[0] = {LayerEdge::symmetry, LayerEdge::symmetry};
  Layers<2> l;
  l.stack = make_stack<2>(in);
  l.substeps = substeps;
  scene.layers.push_back(std::move(l));
  prepare(scene);
  return scene;
}

struct Sums {
  double momentum = 0, energy = 0, kinetic = 0;
};

Sums sums(const Scene<2>& scene) {
  const Totals b = totals(scene.blocks[0]);
  const LayerTotals l = totals(scene.layers[0].stack);
  const LayerLedger& ledger = scene.layers[0].ledger;
  return {b.momentum[1] + l.momentum[1], b.kinetic_energy + b.internal() + l.leapfrog_kinetic + l.internal + l.hourglass + l.shock_heat + ledger.contact_loss + ledger.step_change, b.kinetic_energy + l.kinetic};
}

void go(Scene<2>& scene, double end) {
  Clock clock;
  clock.end_time = end;
  EXPECT_TRUE(run(scene, clock));
}

TEST(BlockContact, KeepsMomentumAndEnergyWithAnySubsteps) {
  for (const int substeps : {1, 3, 8}) {
    for (const int fabric : {2, 3}) { // nodes against nodes, and not
      Scene<2> scene = strip(100, 2, 1, substeps, {74e9, 0.2, 1440}, 20e-6, fabric);
      const Sums start = sums(scene);
      go(scene, 3e-6);
      const Sums end = sums(scene);
      EXPECT_NEAR(end.momentum, start.momentum, 1e-12 * start.momentum) << substeps;
      EXPECT_NEAR(end.energy, start.energy, 1e-11 * start.kinetic) << substeps;
      EXPECT_GT(totals(scene.layers[0].stack).momentum[1], 0.1 * start.momentum);
      EXPECT_LT(scene.layers[0].ledger.deepest, 2e-6);
    }
  }
}

/// Uniaxial strain: the plate's impedance is sqrt(rho M), lead's rho c; the shared velocity and pressure of linear acoustics.
TEST(BlockContact, LeadOnAPlateMatchesImpedance) {
  const HookeSolid plate{30e9, 0.3, 2000};
  const double M = plate.young * (1 - plate.poisson) / ((1 + plate.poisson) * (1 - 2 * plate.poisson));
  constexpr double speed = 5; // linear: Hugoniot and Hooke alike
  for (const int substeps : {1, 4}) {
    Scene<2> scene = strip(speed, 1, 1, substeps, plate);
    const Block<2>& b = scene.blocks[0];
    const MaterialSlot& lead = b.materials[0];
    const double c = std::sqrt(sound_speed_squared(lead.material.eos, lead.material.density, lead.material.specific_energy));
    const double z_lead = lead.material.density * c, z_plate = std::sqrt(plate.density * M);
    const double velocity = speed * z_lead / (z_lead + z_plate), pressure = z_plate * velocity;
    go(scene, 1.4e-6); // waves have run half of each
    const LayerStack<2>& s = scene.layers[0].stack;
    EXPECT_NEAR(b.velocity[1].row(b.grid.node_row(55, 0))[0], velocity, 0.01 * velocity) << substeps;
    EXPECT_NEAR(s.velocity[1][s.node(0, 0, 5)], velocity, 0.01 * velocity) << substeps;
    EXPECT_NEAR(b.pressure.row(b.grid.cell_row(55, 0))[0], pressure, 0.02 * pressure) << substeps;
    EXPECT_NEAR(b.velocity[1].row(b.grid.node_row(2, 0))[0], speed, 1e-3 * speed);
  }
}

} // namespace
} // namespace ballast
