// Laws of moving frames: how fast everything flies changes no step, and a mesh that stays brings in what flows at it.
#include "ale/phases.hpp"
#include "problems/build_scene.hpp"
#include "problems/run_measure.hpp"
#include "problems/scene_reader.hpp"
#include "tests/observers.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

/// A box of air that flies along x with `speed` m/s, through a mesh of 20 x 5 cells with the given sides and motion.
Scene<2> stream(double speed, const std::string& sides, const std::string& motion, const std::string& end_time, Clock& clock) {
  Deck d = Deck::parse(fmt::format(R"(
title = "uniform stream"
geometry = "planar"
end_time = "{}"
[[body]]
name = "gas"
material = "air"
pressure = "1 atm"
velocity = ["{} m/s", "0 m/s"]
shape = {{ box = {{ from = ["0 m", "0 m"], to = ["1 m", "0.25 m"] }} }}
[mesh]
x = {{ from = "0 m", to = "1 m", cells = 20, {} }}
y = {{ from = "0 m", to = "0.25 m", cells = 5, lower = "symmetry", upper = "symmetry" }}
[motion]
{}
)", end_time, speed, sides, motion), "test.toml", {});
  const SceneSpec spec = read_scene(d);
  d.throw_if_errors();
  Scene<2> scene = build_scene<2>(spec, 1);
  clock.end_time = spec.end_time;
  EXPECT_TRUE(run(scene, clock));
  return scene;
}

TEST(MovingFrame, RoundOffOfUniformFlightSetsNoStep) {
  const std::string free_sides = "lower = \"free\", upper = \"free\"";
  Clock still, flying;
  stream(0, free_sides, "policy = \"lagrangian\"", "20 ms", still);
  stream(777.7, free_sides, "policy = \"lagrangian\"", "20 ms", flying);
  EXPECT_EQ(flying.step, still.step);
  EXPECT_EQ(flying.census, still.census);
}

TEST(MovingFrame, AMeshRemappedByQualityStaysInAStream) {
  Clock clock;
  const std::string sides = "lower = { type = \"inflow\", material = \"air\", density = \"2.4 kg/m3\", velocity = [\"400 m/s\", \"0 m/s\"] }, upper = \"outflow\"";
  const Scene<2> scene = stream(400, sides, "policy = \"eulerian\"\nremap_quality = 0.5", "10 ms", clock);
  const Block<2>& b = scene.blocks[0];
  const double cell = 0.05;
  for (const int i : {0, 20}) {
    EXPECT_LE(std::abs(b.position[0].row(b.grid.node_row(2, 0))[i] - i * cell), 2.6 * cell); // two and a step
  }
  EXPECT_NEAR(b.density.row(b.grid.cell_row(2, 0))[19], 2.4, 0.01); // four times what the mesh holds has gone through it
}

TEST(MovingFrame, GaugesReadTheirPlaceBetweenRemaps) {
  Clock clock;
  const Scene<2> scene = stream(300, "lower = \"free\", upper = \"free\"", "policy = \"eulerian\"\nremap_every = 1000", "0.31 ms", clock);
  const Block<2>& b = scene.blocks[0]; // has gone 1.86 cells
  const auto cell = find_cell(b, {0.51, 0.11, 0});
  EXPECT_EQ(cell[0], 8);
  EXPECT_LE(b.position[0].row(b.grid.node_row(cell[1], 0))[cell[0]], 0.51);
  EXPECT_GE(b.position[0].row(b.grid.node_row(cell[1], 0))[cell[0] + 1], 0.51);
}

} // namespace
} // namespace ballast
