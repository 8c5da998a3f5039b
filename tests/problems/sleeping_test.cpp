// Laws of sleeping: what rests is passed over, and no bit of the results knows it.
#include "ale/phases.hpp"
#include "problems/build_scene.hpp"
#include "problems/run_checkpoint.hpp"
#include "problems/scene_reader.hpp"
#include "tests/observers.hpp"
#include "tests/problems/run_deck.hpp"

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

/// A ball of 3 mm radius flies along z into muscle that begins at z = 0; `more` is top-level lines of the deck, `tables`
/// tables of it.
std::string ball(const std::string& more, const std::string& tables, const std::string& side = "free", const std::string& end_time = "6 us") {
  return fmt::format(R"(
title = "ball"
geometry = "axisymmetric"
end_time = "{}"
{}
[[body]]
name = "ball"
material = "lead"
shape = {{ sphere = {{ centre = ["0 mm", "-3.5 mm"], radius = "3 mm" }} }}
velocity = ["0 m/s", "600 m/s"]
[[body]]
name = "tissue"
material = "muscle"
shape = {{ box = {{ from = ["0 mm", "0 mm"], to = ["27.2 mm", "29.1 mm"] }} }}
[mesh]
r = {{ from = "0 mm", to = "30 mm", size = "0.7 mm", upper = "{}" }}
z = {{ from = "-12 mm", to = "32 mm", size = "0.7 mm", upper = "{}" }}
{})", end_time, more, side, side, tables);
}

constexpr const char* no_air = R"(ambient = { pressure = "0 Pa" })";
constexpr const char* sliding = R"([numerics]
sliding = ["muscle"])";

// A quarter of the ball in 3D, void around.
constexpr const char* quarter = R"(
title = "ball, 3D"
geometry = "3d"
symmetry = ["x", "y"]
end_time = "4 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "ball"
material = "lead"
shape = { sphere = { centre = ["0 mm", "0 mm", "-3.5 mm"], radius = "3 mm" } }
velocity = ["0 m/s", "0 m/s", "600 m/s"]
[[body]]
name = "tissue"
material = "muscle"
shape = { box = { from = ["0 mm", "0 mm", "0 mm"], to = ["19 mm", "19 mm", "21 mm"] } }
[numerics]
sliding = ["muscle"]
[mesh]
x = { from = "0 mm", to = "21 mm", size = "1 mm" }
y = { from = "0 mm", to = "21 mm", size = "1 mm" }
z = { from = "-8 mm", to = "24 mm", size = "1 mm" }
)";

// A slug of copper runs into aluminium, all on one mesh that is never remapped.
constexpr const char* plate = R"(
title = "plate"
geometry = "planar"
end_time = "1.2 us"
[[body]]
name = "slug"
material = "copper_ofhc"
shape = { box = { from = ["0 mm", "0 mm"], to = ["2 mm", "4 mm"] } }
velocity = ["300 m/s", "0 m/s"]
[[body]]
name = "plate"
material = "lead"
shape = { box = { from = ["2 mm", "0 mm"], to = ["24 mm", "22 mm"] } }
[[body]]
name = "upper"
material = "copper_ofhc"
shape = { box = { from = ["0 mm", "4 mm"], to = ["2 mm", "22 mm"] } }
[motion]
policy = "lagrangian"
[mesh]
x = { from = "0 mm", to = "24 mm", size = "0.25 mm" }
y = { from = "0 mm", to = "22 mm", size = "0.25 mm" }
)";

// A pocket of hot air in air at one atmosphere.
constexpr const char* blast = R"(
title = "blast"
geometry = "axisymmetric"
end_time = "60 us"
background = "air"
[[body]]
name = "pocket"
material = "air"
pressure = "20 atm"
shape = { sphere = { centre = ["0 mm", "60 mm"], radius = "10 mm" } }
[[body]]
name = "floor"
material = "water"
shape = { box = { from = ["0 mm", "0 mm"], to = ["120 mm", "10.4 mm"] } }
[mesh]
r = { from = "0 mm", to = "120 mm", size = "1.5 mm" }
z = { from = "0 mm", to = "150 mm", size = "1.5 mm" }
)";

/// Every bit that the next step reads, in a fixed order: nodes, then cells by material.
template <int Dim> std::vector<std::uint64_t> bits_of(const Scene<Dim>& scene, const Clock& clock) {
  std::vector<std::uint64_t> out;
  const auto put = [&](double v) { out.push_back(std::bit_cast<std::uint64_t>(v)); };
  const Ledger& l = scene.ledger;
  for (const double v : {clock.time, clock.dt, l.boundary_work, l.ambient_work, l.void_work, l.remap_kinetic_loss, l.remap_kinetic_return,
                         l.sliding_impact, l.energy_out, l.momentum_out[0], l.momentum_out[1], l.momentum_out[2], l.sliver_energy, l.sliver_mass}) {
    put(v);
  }
  for (const long v : {l.slivers, l.spalled_cells, l.closed_voids, l.energy_floors, l.retries, static_cast<long>(clock.limit.cell[0]),
                       static_cast<long>(clock.limit.cell[1]), static_cast<long>(clock.limit.cause)}) {
    put(static_cast<double>(v));
  }
  for (const Block<Dim>& b : scene.blocks) {
    const Grid& g = b.grid;
    for (int k = 0; k < (Dim == 3 ? g.cells[2] + 1 : 1); ++k) {
      for (int j = 0; j <= g.cells[1]; ++j) {
        const int r = g.node_row(j, k);
        for (int i = 0; i <= g.cells[0]; ++i) {
          for (std::size_t d = 0; d < Dim; ++d) {
            put(b.position[d].row(r)[i]);
            put(b.velocity[d].row(r)[i]);
            put(b.any_sliding() ? b.sliding.jump[d].row(r)[i] : 0.0);
          }
          put(b.node_mass.row(r)[i]);
        }
      }
    }
    for (int k = 0; k < g.cells[2]; ++k) {
      for (int j = 0; j < g.cells[1]; ++j) {
        const int r = g.cell_row(j, k);
        for (int i = 0; i < g.cells[0]; ++i) {
          for (const RowField* f : {&b.volume, &b.pressure, &b.density, &b.modulus, &b.wave_speed, &b.viscosity[0], &b.viscosity[1]}) {
            put(f->row(r)[i]);
          }
          for (const MaterialSlot& slot : b.materials) {
            for (int q = 0; q < slot.store.conserved() + slot.store.derived(); ++q) {
              const bool pure = slot.store.row(field::fraction, r)[i] > 0;
              put(q == field::fraction || pure ? slot.store.row(q, r)[i] : 0.0);
            }
          }
        }
      }
    }
  }
  return out;
}

struct Outcome {
  std::vector<std::uint64_t> bits;
  double awake = 1; ///< mean share
  long steps = 0;
};

template <int Dim> Outcome outcome(const Scene<Dim>& scene, const Clock& clock) {
  return {bits_of(scene, clock), scene.blocks[0].awake_steps / static_cast<double>(std::max(clock.step, 1L)), clock.step};
}

template <int Dim> Outcome run_deck(const std::string& deck, bool sleeping, int threads) {
  SceneSpec spec = spec_of(deck);
  spec.numerics.sleeping = sleeping;
  Scene<Dim> scene = build_scene<Dim>(spec, threads);
  Clock clock;
  clock.end_time = spec.end_time;
  run(scene, clock);
  return outcome(scene, clock);
}

/// The same, stopped at step `at` and gone on with from a checkpoint.
Outcome run_in_two(const std::string& deck, long at) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "sleeping_test.h5";
  const SceneSpec spec = spec_of(deck);
  Clock clock;
  clock.end_time = spec.end_time;
  RunMemory memory;
  memory.deck_hash = "x";
  {
    Scene<2> scene = build_scene<2>(spec, 1);
    StepLimit<2> stop(at);
    run<2>(scene, clock, {&stop});
    EXPECT_LT(scene.blocks[0].awake.share(), 0.9);
    write_checkpoint(file, scene, clock, memory);
  }
  Scene<2> scene = build_scene<2>(spec, 1);
  read_checkpoint(file, scene, clock, memory);
  run(scene, clock);
  std::filesystem::remove(file);
  return outcome(scene, clock);
}

/// Places in which two runs differ.
long differences(const Outcome& a, const Outcome& b) {
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.bits.size(), b.bits.size());
  long count = 0;
  for (std::size_t q = 0; q < std::min(a.bits.size(), b.bits.size()); ++q) {
    count += a.bits[q] != b.bits[q] ? 1 : 0;
  }
  return count;
}

struct Case {
  const char* name;
  std::string deck;
  double most_awake; ///< the share of cells that sleeping must leave out is at least one minus this
};

std::vector<Case> cases() {
  return {
      {"ball in void", ball(no_air, ""), 0.6},
      {"sliding", ball(no_air, sliding), 0.6},
      {"remapped every third step", ball(no_air, "[motion]\nremap_every = 3"), 0.6},
      {"remapped by quality", ball(no_air, "[motion]\nremap_quality = 0.7"), 0.8},
      {"Steinberg-Guinan", ball(std::string(no_air) + "\n[materials.lead]\nbase = \"lead_steinberg\"", ""), 0.6},
      {"in air", ball("background = \"air\"", sliding), 0.6},
      {"absorbing sides", ball(no_air, "", "absorbing"), 0.6},
      {"outflow sides", ball(no_air, "", "outflow"), 0.6},
      {"walls", ball(no_air, "", "wall"), 0.6},
      {"lagrangian", plate, 0.8},
      {"blast over water", blast, 0.8},
  };
}

TEST(Sleeping, GivesTheSameBits) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    const Outcome off = run_deck<2>(c.deck, false, 1), on = run_deck<2>(c.deck, true, 1);
    EXPECT_GT(off.steps, 30);
    EXPECT_EQ(off.awake, 1);
    EXPECT_LT(on.awake, c.most_awake);
    EXPECT_EQ(differences(off, on), 0);
    fmt::print("{}: {} steps, awake {:.2f}\n", c.name, on.steps, on.awake);
  }
}

TEST(Sleeping, GivesTheSameBitsIn3D) {
  const Outcome off = run_deck<3>(quarter, false, 1), on = run_deck<3>(quarter, true, 1);
  EXPECT_LT(on.awake, 0.7);
  EXPECT_EQ(differences(off, on), 0);
  fmt::print("3D: {} steps, awake {:.2f}\n", on.steps, on.awake);
}

TEST(Sleeping, GivesTheSameBitsForAnyThreads) {
  const std::string deck = ball(no_air, sliding, "free", "2 us");
  const Outcome off = run_deck<2>(deck, false, 1);
  EXPECT_EQ(differences(off, run_deck<2>(deck, true, 2)), 0);
  EXPECT_EQ(differences(off, run_deck<2>(deck, true, 3)), 0);
}

TEST(Sleeping, GivesTheSameBitsAcrossARestart) {
  const std::string deck = ball(no_air, sliding);
  EXPECT_EQ(differences(run_deck<2>(deck, false, 1), run_in_two(deck, 25)), 0);
}

} // namespace
} // namespace ballast
