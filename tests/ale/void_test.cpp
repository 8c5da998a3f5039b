// Voids in cells: when they open and when they go.
#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "ale/strength_update.hpp"
#include "materials/library.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

/// Three cells of copper in a row at `compression` of its volume, the middle one with `gap` of void beside it.
Block<2> row_with_gap(double compression, double gap) {
  const Material copper = *find_material("copper_ofhc");
  Block<2> b;
  b.materials.push_back(make_slot(copper, 0));
  b.materials.push_back(make_void());
  allocate_block(b, {std::vector<double>{0, 1e-3, 2e-3, 3e-3}, std::vector<double>{0, 1e-3}, {}});
  for (int i = 0; i < 3; ++i) {
    const double f = i == 1 ? 1 - gap : 1;
    const CellPart parts[2] = {{0, f, copper.density * (1 + compression), copper.specific_energy}, {1, 1 - f, 0, 0}};
    fill_cell<2>(b, i, 0, 0, std::span<const CellPart>(parts, i == 1 && gap > 0 ? 2 : 1));
  }
  ThreadPool pool(1);
  update_state(b, pool);
  return b;
}

double void_share(const Block<2>& b) { return b.materials[1].store.row(field::fraction, b.grid.cell_row(0, 0))[1]; }

TEST(Void, CompressedMaterialFillsTheVoidBesideItAndPushesBack) {
  ThreadPool pool(1);
  Block<2> b = row_with_gap(0.2, 0.05); // wants a fifth more room, has a twentieth
  const double mass = totals(b).mass[0], energy = totals(b).internal_energy[0];
  EXPECT_EQ(b.pressure.row(b.grid.cell_row(0, 0))[1], 0);
  EXPECT_EQ(close_voids(b, pool), 1);
  EXPECT_EQ(void_share(b), 0);
  EXPECT_GT(b.pressure.row(b.grid.cell_row(0, 0))[1], 1e10);
  EXPECT_EQ(totals(b).mass[0], mass);
  EXPECT_EQ(totals(b).internal_energy[0], energy);
}

TEST(Void, SlightlyCompressedMaterialLeavesALargerVoid) {
  ThreadPool pool(1);
  Block<2> b = row_with_gap(0.01, 0.05);
  EXPECT_EQ(close_voids(b, pool), 0);
  EXPECT_NEAR(void_share(b), 0.05, 1e-15);
}

TEST(Void, ResidueInsideABodyClosesUpToTheSpallStrain) {
  ThreadPool pool(1);
  Block<2> within = row_with_gap(0, 2e-3), beyond = row_with_gap(0, 2e-2);
  EXPECT_EQ(close_voids(within, pool), 1);
  EXPECT_LT(within.pressure.row(within.grid.cell_row(0, 0))[1], 0);
  EXPECT_EQ(close_voids(beyond, pool), 0);
}

TEST(Void, SpallSpreadOverTwoCellsStaysOpen) {
  // 6e-3 each would close alone (below |p_spall| / K = 9.4e-3); together they are a spall.
  const Material copper = *find_material("copper_ofhc");
  Block<2> b;
  b.materials.push_back(make_slot(copper, 0));
  b.materials.push_back(make_void());
  allocate_block(b, {std::vector<double>{0, 1e-3, 2e-3, 3e-3, 4e-3}, std::vector<double>{0, 1e-3}, {}});
  for (int i = 0; i < 4; ++i) {
    const double gap = i == 1 || i == 2 ? 6e-3 : 0;
    const CellPart parts[2] = {{0, 1 - gap, copper.density, copper.specific_energy}, {1, gap, 0, 0}};
    fill_cell<2>(b, i, 0, 0, std::span<const CellPart>(parts, gap > 0 ? 2 : 1));
  }
  ThreadPool pool(1);
  update_state(b, pool);
  EXPECT_EQ(close_voids(b, pool), 0);
  EXPECT_NEAR(void_share(b), 6e-3, 1e-15);
}

TEST(Void, GasTakesTheVoidsRoomBesideMetal) {
  // Air at 1 atm, copper and a void in one cell: the air fills it, the copper is not stretched.
  const Material copper = *find_material("copper_ofhc"), air = *find_material("air");
  Block<2> b;
  b.materials.push_back(make_slot(copper, 0));
  b.materials.push_back(make_slot(air, 0));
  b.materials.push_back(make_void());
  allocate_block(b, {std::vector<double>{0, 1e-3, 2e-3}, std::vector<double>{0, 1e-3}, {}});
  for (int i = 0; i < 2; ++i) {
    const CellPart parts[3] = {{0, 0.1, copper.density, copper.specific_energy}, {1, 0.6, air.density, air.specific_energy}, {2, 0.3, 0, 0}};
    fill_cell<2>(b, i, 0, 0, parts);
  }
  ThreadPool pool(1);
  update_state(b, pool);
  EXPECT_EQ(close_voids(b, pool), 2);
  const int r = b.grid.cell_row(0, 0);
  EXPECT_NEAR(b.materials[0].store.row(field::fraction, r)[0], 0.1, 1e-6);
  EXPECT_NEAR(b.materials[1].store.row(field::fraction, r)[0], 0.9, 1e-6);
  EXPECT_GT(b.pressure.row(r)[0], 0);
}

TEST(Void, ResidueInAStretchedBodyStaysWhenClosingWouldTearIt) {
  // 0.7 % of stretch leaves copper at -0.96 GPa; a gap of 0.6 % more would bring it beyond its spall at -1.3 GPa.
  ThreadPool pool(1);
  Block<2> b = row_with_gap(-0.007, 6e-3);
  EXPECT_EQ(close_voids(b, pool), 0);
  EXPECT_EQ(close_voids(b, pool, false), 1); // what cannot spall has nothing to keep open
}

TEST(Void, WhatWeighsNothingIsDroppedWhateverRoomItTakes) {
  // A wisp of muscle, a thousandth of a cell at 1e-13 kg/m3: kept, it set the step (1e-27 s) by its speed of sound.
  const Material muscle = *find_material("muscle");
  Scene<2> scene;
  Block<2> b;
  b.materials.push_back(make_slot(muscle, 0));
  b.materials.push_back(make_void());
  allocate_block(b, {std::vector<double>{0, 1e-3, 2e-3, 3e-3}, std::vector<double>{0, 1e-3}, {}});
  for (int i = 0; i < 3; ++i) {
    const double f = i == 0 ? 1 : i == 1 ? 1e-3 : 0, density = i == 0 ? muscle.density : 1e-13;
    const CellPart parts[2] = {{0, f, density, muscle.specific_energy}, {1, 1 - f, 0, 0}};
    fill_cell<2>(b, i, 0, 0, std::span<const CellPart>(f > 0 ? parts : parts + 1, f > 0 && f < 1 ? 2 : 1));
  }
  scene.blocks.push_back(std::move(b));
  scene.ledger.mass_out.assign(2, 0.0);
  ThreadPool pool(1);
  Block<2>& block = scene.blocks[0];
  compute_node_mass(block, pool);
  update_state(block, pool);
  remap_block(scene, block, 0);
  const int r = block.grid.cell_row(0, 0);
  EXPECT_EQ(block.materials[0].store.row(field::mass, r)[1], 0);
  EXPECT_GT(block.materials[0].store.row(field::mass, r)[0], 0);
  EXPECT_GT(scene.ledger.sliver_mass, 0);
}

TEST(Void, SliverOfMetalCarriesNoDeviator) {
  Block<2> b = row_with_gap(0, 1 - 5e-5);
  const int r = b.grid.cell_row(0, 0);
  TileStore& copper = b.materials[0].store;
  for (int i = 0; i < 2; ++i) {
    copper.row(field::stress, r)[i] = 1e7;
  }
  ThreadPool pool(1);
  pull_back_to_yield(b, pool);
  EXPECT_EQ(copper.row(field::stress, r)[0], 1e7);
  EXPECT_EQ(copper.row(field::stress, r)[1], 0);
}

} // namespace
} // namespace ballast
