// Laws of rest: what keeps a cell awake, how far that reaches, and when it falls asleep.
#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "ale/rest.hpp"
#include "ale/simulation.hpp"
#include "materials/library.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr int cells = 64, at = 32; // a square mesh; what is poked is cell or node (at, at)

/// Lead, all alike and at rest, no ambient pressure; cell (at, at) holds `void_share` of void.
Scene<2> lead_at_rest(double void_share = 0, MotionPolicy policy = MotionPolicy::eulerian) {
  Block<2> b;
  b.motion.policy = policy;
  Material lead = *find_material("lead");
  lead.specific_energy = energy(lead.eos, lead.density, 0);
  b.materials.push_back(make_slot(lead, 0));
  b.materials.push_back(make_void());
  std::vector<double> line;
  for (int i = 0; i <= cells; ++i) {
    line.push_back(1e-3 * i);
  }
  allocate_block(b, {line, line, {}});
  for_each_cell(b, [&](int i, int j, int k) {
    const double gap = i == at && j == at ? void_share : 0.0;
    const CellPart parts[2] = {{0, 1 - gap, lead.density, lead.specific_energy}, {1, gap}};
    fill_cell<2>(b, i, j, k, std::span<const CellPart>(parts, gap > 0 ? 2 : 1));
  });
  Scene<2> scene;
  scene.blocks.push_back(std::move(b));
  prepare(scene);
  return scene;
}

/// The awake cells of row `row` after two steps that leave everything as it is.
Span awake_after_two(Scene<2>& scene, int row) {
  Block<2>& b = scene.blocks[0];
  follow_rest(scene, b, true);
  follow_rest(scene, b, true);
  return b.awake.cells(b.grid.cell_row(row, 0));
}

/// Cells [low, high] of either axis are restless: they and all within reach are awake, rows further off sleep, and along
/// a row no more than a tile is awake in vain.
void expect_awake_around(Scene<2>& scene, int low, int high) {
  constexpr int reach = Awake::reach, tile = Awake::tile;
  EXPECT_TRUE(awake_after_two(scene, low).holds({low - reach, high + reach + 1}));
  const Awake& awake = scene.blocks[0].awake;
  const Grid& g = scene.blocks[0].grid;
  EXPECT_TRUE(awake.cells(g.cell_row(high + reach, 0)).holds({low - reach, high + reach + 1}));
  EXPECT_TRUE(awake.cells(g.cell_row(low - reach, 0)).holds({low - reach, high + reach + 1}));
  EXPECT_TRUE(awake.cells(g.cell_row(high + reach + 1, 0)).empty());
  EXPECT_TRUE(awake.cells(g.cell_row(low - reach - 1, 0)).empty());
  EXPECT_LE(awake.cells(g.cell_row(low, 0)).count(), high - low + 1 + 2 * (reach + tile) + 2 * tile);
}

TEST(Rest, NothingMovesNothingIsAwake) {
  Scene<2> scene = lead_at_rest();
  Clock clock;
  clock.end_time = 1;
  for (const double share : {1.0, 1.0, 0.0, 0.0}) {
    EXPECT_EQ(scene.blocks[0].awake.share(), share);
    advance(scene, clock);
  }
  Scene<2> again = lead_at_rest();
  EXPECT_EQ(stable_dt(scene).dt, stable_dt(again).dt); // asleep or awake
}

TEST(Rest, AMovingNodeKeepsAwake) {
  Scene<2> scene = lead_at_rest();
  scene.blocks[0].velocity[1].row(scene.blocks[0].grid.node_row(at, 0))[at] = 1e-3;
  expect_awake_around(scene, at - 1, at);
}

TEST(Rest, ANodeOffItsTargetKeepsAwakeWhereItIsRemapped) {
  Scene<2> scene = lead_at_rest(), never = lead_at_rest(0, MotionPolicy::lagrangian);
  for (Scene<2>* s : {&scene, &never}) {
    s->blocks[0].position[0].row(s->blocks[0].grid.node_row(at, 0))[at] += 1e-5;
  }
  expect_awake_around(scene, at - 1, at);
  EXPECT_TRUE(awake_after_two(never, at).empty());
}

TEST(Rest, PressureKeepsAwake) {
  Scene<2> scene = lead_at_rest();
  scene.blocks[0].pressure.row(scene.blocks[0].grid.cell_row(at, 0))[at] = -1e-9;
  expect_awake_around(scene, at, at);
}

TEST(Rest, EveryStressKeepsAwake) {
  for (std::size_t a = 0; a < stress_components<2>; ++a) {
    Scene<2> scene = lead_at_rest();
    scene.blocks[0].stress[a].row(scene.blocks[0].grid.cell_row(at, 0))[at] = 1e-9;
    expect_awake_around(scene, at, at);
  }
}

TEST(Rest, AVoidThatIsToCloseKeepsAwake) {
  Scene<2> residue = lead_at_rest(1e-6), hole = lead_at_rest(0.5);
  expect_awake_around(residue, at, at);
  EXPECT_TRUE(awake_after_two(hole, at).empty());
}

TEST(Rest, AMixedCellWhosePartsPressKeepsAwake) {
  Scene<2> scene = lead_at_rest(0.5);
  MaterialSlot& lead = scene.blocks[0].materials[0];
  lead.store.row(lead.pressure_field(), scene.blocks[0].grid.cell_row(at, 0))[at] = 1;
  expect_awake_around(scene, at, at);
}

// A store's two copies must agree before a cell sleeps: two remaps at rest, however many steps apart.
TEST(Rest, FallsAsleepAfterTwoRemapsAtRest) {
  for (const int every : {1, 3}) {
    Scene<2> scene = lead_at_rest();
    Block<2>& b = scene.blocks[0];
    double& u = b.velocity[0].row(b.grid.node_row(at, 0))[at];
    u = 1;
    awake_after_two(scene, at);
    u = 0;
    for (int step = 1; step <= 2 * every; ++step) {
      EXPECT_FALSE(b.awake.cells(b.grid.cell_row(at, 0)).empty()) << every << " " << step;
      follow_rest(scene, b, step % every == 0);
    }
    EXPECT_TRUE(b.awake.cells(b.grid.cell_row(at, 0)).empty());
  }
}

TEST(Rest, WhatIsSlowerThanRoundOffIsHeldAndAccountedFor) {
  Scene<2> scene = lead_at_rest();
  Block<2>& b = scene.blocks[0];
  ASSERT_GT(b.still_speed, 0);
  EXPECT_LT(b.still_speed, 1e-11); // of 2000 m/s
  double *slow = b.velocity[0].row(b.grid.node_row(at, 0)) + at, *fast = slow + 1;
  *slow = 0.5 * b.still_speed;
  *fast = 2 * b.still_speed;
  const double mass = b.node_mass.row(b.grid.node_row(at, 0))[at], momentum = mass * *slow;
  hold_still(b, *scene.pool, scene.ledger);
  EXPECT_EQ(*slow, 0);
  EXPECT_EQ(*fast, 2 * b.still_speed);
  EXPECT_EQ(scene.ledger.momentum_out[0], momentum);
}

TEST(Rest, NeitherAFollowingMeshNorOneThatIsFedSleeps) {
  Scene<2> follows = lead_at_rest(), fed = lead_at_rest();
  follows.blocks[0].motion.policy = MotionPolicy::follow;
  fed.blocks[0].boundary.side[0][0] = inflow_side(0, {0, 11340, 0, {}});
  for (Scene<2>* s : {&follows, &fed}) {
    awake_after_two(*s, 0);
    EXPECT_EQ(s->blocks[0].awake.share(), 1);
  }
}

} // namespace
} // namespace ballast
