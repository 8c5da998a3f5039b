// A step in which CVODE gives up on a cell is taken back to the last bit, and again with half of it.
#include "core/error.hpp"
#include "problems/build_scene.hpp"
#include "tests/observers.hpp"
#include "tests/problems/run_deck.hpp"
#include "tests/problems/tissue_decks.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

/// From now on CVODE may take so many steps of its own and no more: enough for a small step of the cell, not for a large one.
template <int Dim> void limit_cvode(Scene<Dim>& scene, int most_steps) {
  scene.numerics.tissue.cvode.most_steps = most_steps;
  const std::size_t threads = scene.tissue.size();
  scene.tissue.clear();
  for (std::size_t t = 0; t < threads; ++t) {
    scene.tissue.emplace_back(scene.numerics.tissue);
  }
}

/// What a step books besides the tissue's own account.
std::vector<double> entries(const Ledger& l) {
  std::vector<double> all = {l.boundary_work, l.ambient_work, l.void_work, l.remap_kinetic_loss, l.remap_kinetic_return, l.sliding_impact,
                             l.energy_out, l.momentum_out[0], l.momentum_out[1], l.momentum_out[2], l.sliver_energy, l.sliver_mass, l.embedded_given};
  all.insert(all.end(), l.mass_out.begin(), l.mass_out.end());
  return all;
}

template <int Dim> std::vector<double> of_layers(const Scene<Dim>& scene) {
  std::vector<double> all;
  for (const Layers<Dim>& l : scene.layers) {
    for (std::size_t d = 0; d < Dim; ++d) {
      all.insert(all.end(), l.stack.position[d].begin(), l.stack.position[d].end());
      all.insert(all.end(), l.stack.velocity[d].begin(), l.stack.velocity[d].end());
    }
    all.push_back(l.ledger.load_work);
    all.push_back(l.ledger.contact_loss);
  }
  return all;
}

/// After `steps` a step that has to be taken again leaves the bits of one that was small from the start.
template <int Dim> void expect_taken_again(const std::string& deck, long steps, int most_steps, int threads = 1) {
  const SceneSpec spec = spec_of(deck);
  Scene<Dim> again = build_scene<Dim>(spec, threads), small = build_scene<Dim>(spec, 1);
  Clock clock, small_clock;
  clock.end_time = small_clock.end_time = spec.end_time;
  StepLimit<Dim> stop(steps);
  ASSERT_FALSE(run(again, clock, {&stop}));
  ASSERT_FALSE(run(small, small_clock, {&stop}));
  ASSERT_EQ(again.ledger.retries, 0);
  limit_cvode(again, most_steps);
  limit_cvode(small, most_steps);
  advance(again, clock);
  ASSERT_GT(again.ledger.retries, 0);
  EXPECT_LT(again.ledger.retries, 15);
  EXPECT_GT(again.ledger.tissue_counts.cvode.failures, 0);
  EXPECT_EQ(clock.limit.cause, DtCause::retry);
  EXPECT_GE(clock.limit.cell[0], 0);
  small.numerics.dt_max = clock.dt;
  advance(small, small_clock);
  ASSERT_EQ(small_clock.dt, clock.dt);
  EXPECT_EQ(small.ledger.retries, 0);
  EXPECT_EQ(small.ledger.tissue_counts.cvode.failures, 0);
  EXPECT_TRUE(bits_of(again) == bits_of(small));
  EXPECT_TRUE(entries(again.ledger) == entries(small.ledger));
  EXPECT_TRUE(of_layers(again) == of_layers(small));
}

TEST(TissueRetry, AStepTakenAgainIsTheSmallStep) {
  expect_taken_again<2>(impact(power_law, "cvode"), 40, 10);
  expect_taken_again<2>(impact(boyce, "cvode"), 40, 10, 2);
  expect_taken_again<3>(impact(boyce, "cvode", "3d"), 15, 10);
}

/// A disc of tissue flies onto layers that lie in its mesh.
std::string disc_on_vest() {
  return fmt::format(R"(
title = "disc on vest"
geometry = "axisymmetric"
end_time = "15 us"
[[body]]
name = "disc"
material = "flesh"
velocity = ["0 m/s", "370 m/s"]
shape = {{ cylinder = {{ from = ["0 mm", "-3 mm"], to = ["0 mm", "0 mm"], radius = "6 mm" }} }}
[materials.flesh]
base = "muscle"
{}
[mesh]
r = {{ from = "0 mm", to = "10 mm", cells = 10 }}
z = {{ from = "-5 mm", to = "10 mm", cells = 15 }}
[motion]
policy = "eulerian"
remap_every = 4
[numerics]
spall = false
tissue_path = "cvode"
[[layers]]
name = "vest"
fabric = "kevlar_km2_raftenberg"
front = "0 mm"
layers = 3
half_width = "20 mm"
cells = 10
friction = 0.2
)",
                     boyce);
}

TEST(TissueRetry, LayersInTheMeshGoBackToo) { expect_taken_again<2>(disc_on_vest(), 30, 10); }

TEST(TissueRetry, WhatFailsAtAnyStepEndsTheRunWithItsCell) {
  Scene<2> scene = build_scene<2>(spec_of(impact(boyce, "cvode")), 1);
  Clock clock;
  clock.end_time = 1;
  advance(scene, clock);
  limit_cvode(scene, 1);
  try {
    advance(scene, clock);
    FAIL() << "went on";
  } catch (const NumericalFailure& e) {
    EXPECT_NE(std::string(e.what()).find("material flesh: branch 1"), std::string::npos) << e.what();
  }
  EXPECT_EQ(scene.ledger.retries, 30);
}

} // namespace
} // namespace ballast
