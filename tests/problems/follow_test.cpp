// Laws of a mesh that follows: it goes where its bodies go, of them nothing is remapped, what it passes is carried through
// and accounted for.
#include "ale/follow.hpp"
#include "ale/phases.hpp"
#include "problems/build_scene.hpp"
#include "problems/scene_reader.hpp"
#include "tests/observers.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

SceneSpec scene_of(const std::string& text, const std::string& motion) {
  Deck d = Deck::parse(text + motion, "test.toml", {});
  SceneSpec s = read_scene(d);
  d.throw_if_errors();
  return s;
}

Scene<2> at_end(const SceneSpec& spec) {
  Scene<2> scene = build_scene<2>(spec, 1);
  Clock clock;
  clock.end_time = spec.end_time;
  EXPECT_TRUE(run(scene, clock));
  EXPECT_GT(clock.step, 30);
  return scene;
}

constexpr const char* follows = R"(
[motion]
policy = "follow"
bodies = ["ball"]
)";
const std::string gas_follows = "[motion]\npolicy = \"follow\"\nbodies = [\"gas\"]\n";

// A ball in a void, away from everything.
constexpr const char* alone = R"(
title = "ball in a void"
geometry = "axisymmetric"
end_time = "40 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "ball"
material = "copper_ofhc"
shape = { sphere = { centre = ["0 mm", "0 mm"], radius = "3.1 mm" } }
velocity = ["0 m/s", "500 m/s"]
[mesh]
r = { from = "0 mm", to = "5 mm", size = "0.5 mm" }
z = { from = "-5 mm", to = "5 mm", size = "0.5 mm" }
)";

TEST(Follow, ABallFliesWithItsMeshUnchanged) {
  const SceneSpec spec = scene_of(alone, follows);
  Scene<2> scene = build_scene<2>(spec, 1);
  const Block<2>& b = scene.blocks[0];
  std::vector<double> before;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    const double* f = b.materials[0].store.row(field::fraction, b.grid.cell_row(j, 0));
    before.insert(before.end(), f, f + b.grid.cells[0]);
  }
  Clock clock;
  clock.end_time = spec.end_time;
  EXPECT_TRUE(run(scene, clock));
  EXPECT_GT(clock.step, 100);
  EXPECT_NEAR(b.position[1].row(b.grid.node_row(0, 0))[0], -5e-3 + 500 * 40e-6, 1e-12);
  EXPECT_NEAR(bulk_of(b, {0}).centre[1], 500 * 40e-6, 1e-12);
  std::size_t q = 0;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    const double* f = b.materials[0].store.row(field::fraction, b.grid.cell_row(j, 0));
    for (int i = 0; i < b.grid.cells[0]; ++i) {
      EXPECT_NEAR(f[i], before[q++], 1e-9); // four cells on a fixed mesh: 1e-2
    }
  }
}

// The same ball through air that stands: the air enters before it and leaves behind it through the mesh's sides.
TEST(Follow, WhatFlowsThroughIsAccountedFor) {
  std::string text = alone;
  text.insert(text.find("[[body]]"), "background = \"air\"\n");
  text.replace(text.find("ambient"), text.find('\n', text.find("ambient")) - text.find("ambient"), "ambient = { pressure = \"1 atm\" }");
  for (const int every : {1, 3}) {
    SceneSpec spec = scene_of(text, follows);
    spec.motion.remap_every = every;
    const Totals start = totals(build_scene<2>(spec, 1).blocks[0]);
    const Scene<2> scene = at_end(spec);
    const Totals end = totals(scene.blocks[0]);
    const Ledger& l = scene.ledger;
    EXPECT_NE(l.mass_out[1], 0);
    for (std::size_t m = 0; m < 2; ++m) {
      EXPECT_NEAR((end.mass[m] + l.mass_out[m]) / start.mass[m], 1, 1e-12);
    }
    const double known = l.boundary_work + l.ambient_work + l.void_work - l.remap_kinetic_loss - l.energy_out - l.sliver_energy;
    EXPECT_NEAR(end.internal() + end.kinetic_energy, start.internal() + start.kinetic_energy + known, 1e-12 * start.kinetic_energy);
    EXPECT_NEAR(bulk_of(scene.blocks[0], {0}).centre[1], 500 * 40e-6, 0.02 * 500 * 40e-6);
  }
}

// Matter at rest in the window's way brings no momentum: a ball that pushes through muscle wider than the window.
TEST(Follow, WhatComesInIsAtRest) {
  const SceneSpec spec = scene_of(R"(
title = "ball through muscle"
geometry = "axisymmetric"
end_time = "10 us"
ambient = { pressure = "1 atm" }
[[body]]
name = "muscle"
material = "muscle"
shape = { box = { from = ["0 mm", "-40 mm"], to = ["15 mm", "40 mm"] } }
[[body]]
name = "ball"
material = "lead"
shape = { sphere = { centre = ["0 mm", "0 mm"], radius = "3 mm" } }
velocity = ["0 m/s", "600 m/s"]
[mesh]
r = { from = "0 mm", to = "12 mm", size = "0.75 mm" }
z = { from = "-25 mm", to = "8 mm", size = "0.75 mm" }
)", follows);
  const Totals start = totals(build_scene<2>(spec, 1).blocks[0]);
  const Scene<2> scene = at_end(spec);
  EXPECT_NE(scene.ledger.mass_out[0], 0);
  EXPECT_LT(totals(scene.blocks[0]).momentum[1], 1.01 * start.momentum[1]);
  EXPECT_LT(totals(scene.blocks[0]).kinetic_energy, start.kinetic_energy);
}

// Galileo: a ball into water on a mesh that goes with it, and water on to a ball at rest.
TEST(Follow, IsTheSameAsTheBodysFrame) {
  const auto deck = [](const char* ball, const char* water) {
    return std::string(R"(
title = "ball into water"
geometry = "axisymmetric"
end_time = "8 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "water"
material = "water"
shape = { box = { from = ["0 mm", "4 mm"], to = ["9 mm", "12 mm"] } }
velocity = ["0 m/s", ")") + water + R"("]
[[body]]
name = "ball"
material = "lead"
shape = { sphere = { centre = ["0 mm", "0 mm"], radius = "3.1 mm" } }
velocity = ["0 m/s", ")" + ball + R"("]
[mesh]
r = { from = "0 mm", to = "9 mm", size = "0.5 mm" }
z = { from = "-9 mm", to = "13 mm", size = "0.5 mm" }
)";
  };
  const auto end_of = [](const SceneSpec& spec) {
    const Scene<2> scene = at_end(spec);
    return std::array<double, 2>{bulk_of(scene.blocks[0], {1}).centre[1], totals(scene.blocks[0]).internal()};
  };
  const auto moving = end_of(scene_of(deck("600 m/s", "0 m/s"), follows)), resting = end_of(scene_of(deck("0 m/s", "-600 m/s"), ""));
  const double lag = 600 * 8e-6 - moving[0];
  EXPECT_GT(lag, 1e-5);
  EXPECT_NEAR(lag, -resting[0], 0.02 * lag); // the mesh slows down with the ball, the frame does not
  EXPECT_NEAR(moving[1], resting[1], 0.01 * resting[1]);
}

TEST(Follow, StretchesFromAPlaneWithoutGoing) {
  std::string text = alone;
  text.replace(text.find("z = { from = \"-5 mm\""), std::string("z = { from = \"-5 mm\"").size(), "z = { lower = \"symmetry\", from = \"0 mm\"");
  const SceneSpec spec = scene_of(text, std::string(follows) + "stretch = [\"r\", \"z\"]\n");
  EXPECT_EQ(spec.motion.axes, (std::array<bool, 3>{}));
  EXPECT_EQ(spec.motion.stretches, (std::array<bool, 3>{true, true, false}));
}

// A cylinder of gas in a void bursts: a window that stretches grows with it, so that most of it stays in.
TEST(Follow, GrowsWithWhatItFollows) {
  const auto deck = [](const std::string& stretch) {
    return scene_of(R"(
title = "cylinder of gas that bursts"
geometry = "axisymmetric"
end_time = "1 ms"
ambient = { pressure = "0 Pa" }
[[body]]
name = "gas"
material = "air"
pressure = "1 atm"
shape = { box = { from = ["0 mm", "-100 mm"], to = ["100 mm", "100 mm"] } }
[mesh]
r = { from = "0 mm", to = "150 mm", size = "10 mm" }
z = { from = "-150 mm", to = "150 mm", size = "10 mm" }
)", gas_follows + stretch);
  };
  const SceneSpec spec = deck("stretch = [\"r\", \"z\"]\n");
  const double start = totals(build_scene<2>(spec, 1).blocks[0]).mass[0];
  const Scene<2> scene = at_end(spec), window = at_end(deck("axes = [\"z\"]\n"));
  const Block<2>& b = scene.blocks[0];
  const Grid& g = b.grid;
  const Bulk bulk = bulk_of(b, {0});
  for (std::size_t d = 0; d < 2; ++d) {
    const double stretch = b.position[d].row(g.node_row(d == 1 ? g.cells[1] : 0, 0))[d == 0 ? g.cells[0] : 0] / 0.15;
    EXPECT_GT(stretch, 4); // the front goes at 5 c = 1.7 km/s, the window at its mean
    EXPECT_NEAR(stretch, std::sqrt(bulk.spread[d] / b.motion.start.spread[d]), 0.02 * stretch);
  }
  EXPECT_EQ(b.position[0].row(g.node_row(3, 0))[0], 0);
  EXPECT_NEAR(totals(b).mass[0] + scene.ledger.mass_out[0], start, 1e-12 * start);
  EXPECT_GT(window.ledger.mass_out[0], 0.9 * start);
  EXPECT_LT(scene.ledger.mass_out[0], 0.15 * start); // the thin gas of the front runs ahead of the mean
}

// Where the plane of symmetry stands is a matter of the deck's numbers only.
TEST(Follow, GrowsFromItsPlaneOfSymmetryWhereverThatIs) {
  const auto ends = [](double plane) {
    const auto mm = [&](double x) { return plane + x; };
    const SceneSpec spec = scene_of(fmt::format(R"(
title = "slab of gas that bursts"
geometry = "planar"
end_time = "0.3 ms"
ambient = {{ pressure = "0 Pa" }}
[[body]]
name = "gas"
material = "air"
pressure = "1 atm"
shape = {{ box = {{ from = ["{} mm", "0 mm"], to = ["{} mm", "50 mm"] }} }}
[mesh]
x = {{ from = "{} mm", to = "{} mm", size = "5 mm", lower = "symmetry" }}
y = {{ from = "0 mm", to = "50 mm", size = "25 mm", lower = "symmetry", upper = "symmetry" }}
)", mm(0), mm(100), mm(0), mm(150)), gas_follows + "axes = []\nstretch = [\"x\"]\n");
    const Scene<2> scene = at_end(spec);
    const Block<2>& b = scene.blocks[0];
    const double lower = b.position[0].row(b.grid.node_row(0, 0))[0], upper = b.position[0].row(b.grid.node_row(0, 0))[b.grid.cells[0]];
    EXPECT_EQ(lower, plane * 1e-3);
    return std::array<double, 2>{upper - lower, totals(b).mass[0]};
  };
  const auto at_zero = ends(0), shifted = ends(40), before = ends(-30);
  EXPECT_GT(at_zero[0], 0.2);
  for (const std::size_t q : {0UL, 1UL}) {
    EXPECT_NEAR(shifted[q], at_zero[q], 1e-9 * at_zero[q]);
    EXPECT_NEAR(before[q], at_zero[q], 1e-9 * at_zero[q]);
  }
}

// A side that only grows, without going anywhere, takes in what lies ahead of it: a shell of muscle that goes on beyond the mesh.
TEST(Follow, AGrowingSideMeetsWhatLiesAhead) {
  const SceneSpec spec = scene_of(R"(
title = "gas that bursts towards a shell"
geometry = "axisymmetric"
end_time = "0.3 ms"
ambient = { pressure = "0 Pa" }
[[body]]
name = "gas"
material = "air"
pressure = "1 atm"
shape = { box = { from = ["0 mm", "0 mm"], to = ["100 mm", "100 mm"] } }
[[body]]
name = "shell"
material = "muscle"
shape = { box = { from = ["140 mm", "0 mm"], to = ["900 mm", "900 mm"] } }
[mesh]
r = { from = "0 mm", to = "150 mm", size = "10 mm" }
z = { from = "0 mm", to = "150 mm", size = "10 mm", lower = "symmetry" }
)", gas_follows + "stretch = [\"r\", \"z\"]\n");
  const double start = totals(build_scene<2>(spec, 1).blocks[0]).mass[1];
  const Scene<2> scene = at_end(spec);
  const double edge = scene.blocks[0].position[0].row(scene.blocks[0].grid.node_row(0, 0))[15];
  ASSERT_GT(edge, 0.155);
  EXPECT_GT(totals(scene.blocks[0]).mass[1], 1.3 * start);
}

} // namespace
} // namespace ballast
