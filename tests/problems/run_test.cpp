// Laws of a run: the same bits for any number of threads and across a restart.
#include "ale/fill.hpp"
#include "problems/run_checkpoint.hpp"
#include "problems/scene_reader.hpp"
#include "problems/build_scene.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/observers.hpp"
#include "tests/problems/restarts.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

/// A ball of 3 mm radius on its way along z into a block of muscle, RZ.
struct BallScene {
  std::string title, material, speed;
  double centre;        ///< of the ball, z in mm
  std::string around;   ///< top-level lines of the deck: what is where no body is
  std::string tissue;   ///< high corner of the muscle; its low one is the origin
  std::string end_time;
  std::string r, z;     ///< mesh lines
};

std::string deck_of(const BallScene& b) {
  return fmt::format(R"(
title = "{}"
geometry = "axisymmetric"
end_time = "{}"
{}
[[body]]
name = "ball"
material = "{}"
shape = {{ sphere = {{ centre = ["0 mm", "{} mm"], radius = "3 mm" }} }}
velocity = ["0 m/s", "{}"]
[[body]]
name = "tissue"
material = "muscle"
shape = {{ box = {{ from = ["0 mm", "0 mm"], to = {} }} }}
[mesh]
r = {{ {} }}
z = {{ {} }}
)", b.title, b.end_time, b.around, b.material, b.centre, b.speed, b.tissue, b.r, b.z);
}

// Coarse, with void around: mixed cells, void, strength and spall are all in play.
const BallScene lead_in_void = {.title = "ball",
                                .material = "lead",
                                .speed = "600 m/s",
                                .centre = -3.5,
                                .around = R"(ambient = { pressure = "0 Pa" })",
                                .tissue = R"(["12 mm", "14 mm"])",
                                .end_time = "6 us",
                                .r = R"(from = "0 mm", to = "14 mm", size = "0.7 mm")",
                                .z = R"(from = "-8 mm", to = "16 mm", size = "0.7 mm")"};

BallScene sliding(BallScene b) {
  b.around += "\nnumerics = { sliding = [\"muscle\"] }";
  return b;
}

// Gas a million times softer than the metal beside it.
const BallScene copper_in_air = {.title = "copper through air",
                                 .material = "copper_ofhc",
                                 .speed = "823 m/s",
                                 .centre = -4,
                                 .around = R"(background = "air")",
                                 .tissue = R"(["15 mm", "20 mm"])",
                                 .end_time = "12 us",
                                 .r = R"(from = "0 mm", to = "15 mm", size = "0.6 mm")",
                                 .z = R"(from = "-10 mm", to = "20 mm", size = "0.6 mm")"};

// Water enters below, tissue leaves above and aside: inflow, outflow and what they leave in mixed cells.
constexpr const char* open_deck = R"(
title = "jet"
geometry = "axisymmetric"
end_time = "12 us"
background = "air"
[[body]]
name = "tissue"
material = "muscle"
velocity = ["100 m/s", "300 m/s"]
shape = { box = { from = ["0 mm", "6 mm"], to = ["9 mm", "12 mm"] } }
[mesh.r]
from = "0 mm"
to = "12 mm"
size = "0.7 mm"
upper = "outflow"
[mesh.z]
from = "0 mm"
to = "14 mm"
size = "0.7 mm"
lower = { type = "inflow", material = "water", velocity = ["0 m/s", "400 m/s"] }
upper = "outflow"
)";

// The ball again, a quarter of it in 3D, on its way out through an outflow side.
constexpr const char* deck_3d = R"(
title = "ball, 3D"
geometry = "3d"
symmetry = ["x", "y"]
end_time = "10 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "ball"
material = "lead"
shape = { sphere = { centre = ["0 mm", "0 mm", "-3.5 mm"], radius = "3 mm" } }
velocity = ["0 m/s", "0 m/s", "600 m/s"]
[[body]]
name = "tissue"
material = "muscle"
shape = { box = { from = ["0 mm", "0 mm", "0 mm"], to = ["7 mm", "7 mm", "6 mm"] } }
[mesh]
x = { from = "0 mm", to = "7 mm", size = "1 mm" }
y = { from = "0 mm", to = "7 mm", size = "1 mm", upper = "outflow" }
z = { from = "-7 mm", to = "6 mm", size = "1 mm", upper = "outflow" }
)";

/// Steinberg-Guinan lead breaks aluminium: a shear modulus by cell, damage.
const std::string breaking = R"(
title = "breaking"
geometry = "axisymmetric"
end_time = "3 us"
[[body]]
name = "plate"
material = "al_2024_t351"
shape = { box = { from = ["0 mm", "0 mm"], to = ["8 mm", "2 mm"] } }
[[body]]
name = "ball"
material = "lead_steinberg"
velocity = ["0 m/s", "800 m/s"]
shape = { sphere = { centre = ["0 mm", "-3 mm"], radius = "3 mm" } }
[mesh]
r = { from = "0 mm", to = "10 mm", size = "0.5 mm", upper = "free" }
z = { from = "-7 mm", to = "10 mm", size = "0.5 mm", lower = "free", upper = "free" }
)";

/// The deck with other materials.
std::string swapped(std::string deck, const std::string& from, const std::string& to) {
  for (std::size_t at = deck.find(from); at != std::string::npos; at = deck.find(from, at + to.size())) {
    deck.replace(at, from.size(), to);
  }
  return deck;
}

SceneSpec scene_of(const std::string& text) {
  Deck d = Deck::parse(text, "test.toml", {});
  SceneSpec s = read_scene(d);
  d.throw_if_errors();
  return s;
}

Clock clock_to(double end_time) {
  Clock clock;
  clock.end_time = end_time;
  return clock;
}

template <int Dim> std::vector<double> state_of(const Scene<Dim>& scene) {
  const Block<Dim>& b = scene.blocks[0];
  std::vector<double> all;
  const auto add_field = [&](const RowField& f) { all.insert(all.end(), f.data().begin(), f.data().end()); };
  add_field(b.node_mass);
  add_field(b.sliding.node_mass);
  for (std::size_t d = 0; d < Dim; ++d) {
    add_field(b.position[d]);
    add_field(b.velocity[d]);
    add_field(b.sliding.jump[d]);
  }
  for (int k = 0; k < b.grid.cells[2]; ++k) {
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      const int r = b.grid.cell_row(j, k);
      const auto add = [&](const double* row) { all.insert(all.end(), row, row + b.grid.cells[0]); };
      for (const RowField* f : {&b.pressure, &b.modulus, &b.wave_speed}) {
        add(f->row(r));
      }
      for (const MaterialSlot& slot : b.materials) {
        for (int f = 0; f < slot.store.conserved(); ++f) {
          add(slot.store.row(f, r));
        }
      }
    }
  }
  return all;
}

template <int Dim> void same_bits(const std::string& text) {
  const SceneSpec spec = scene_of(text);
  std::vector<double> first;
  for (const int threads : {1, 2, 3}) {
    Scene<Dim> scene = build_scene<Dim>(spec, threads);
    Clock clock = clock_to(spec.end_time);
    run(scene, clock);
    EXPECT_GT(clock.step, 20);
    const auto state = state_of(scene);
    first = first.empty() ? state : first;
    EXPECT_TRUE(state == first) << spec.title << ", " << threads << " threads";
  }
}

std::string following(std::string deck) {
  return deck + "[motion]\npolicy = \"follow\"\nbodies = [\"ball\"]\n";
}

std::string relaxing(std::string deck, const std::string& due) {
  return deck + "[motion]\npolicy = \"relax\"\nboundary = \"fixed\"\n" + due + "\n";
}

TEST(Run, SameBitsForAnyNumberOfThreads) {
  same_bits<2>(relaxing(deck_of(lead_in_void), "remap_every = 1"));
  same_bits<2>(following(deck_of(sliding(lead_in_void))));
  same_bits<2>(deck_of(lead_in_void));
  same_bits<2>(open_deck);
  same_bits<3>(deck_3d);
  same_bits<2>(breaking);
  same_bits<3>(swapped(swapped(deck_3d, "\"lead\"", "\"lead_steinberg\""), "\"muscle\"", "\"steel_1006\""));
  same_bits<2>(deck_of(sliding(lead_in_void)));
}

template <int Dim> void restarts(const SceneSpec& spec) {
  expect_restarts<Dim>(spec, {1, 7, 18, 25, 33, 40}, [](const Scene<Dim>& scene) { return state_of(scene); });
}

TEST(Run, DamageStaysBetweenNothingAndFailure) {
  Scene<2> scene = build_scene<2>(scene_of(swapped(breaking, "lead_steinberg", "steel_4340")), 1);
  Clock clock = clock_to(6e-6);
  run(scene, clock);
  const Block<2>& b = scene.blocks[0];
  double least = 1, most = 0, broken = 0;
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    for (const MaterialSlot& slot : b.materials) {
      if (slot.damages && slot.store.row(field::mass, r)[i] > 0) {
        const double damage = slot.store.row(field::damage<2>, r)[i];
        least = std::min(least, damage);
        most = std::max(most, damage);
        const double s = slot.store.row(field::stress + 2, r)[i];
        EXPECT_TRUE(!has_failed(damage) || s == 0);
        broken += has_failed(damage) ? 1 : 0;
      }
    }
  });
  EXPECT_GE(least, 0);
  EXPECT_LE(most, most_damage * (1 + 1e-12)); // a remap brings in no new extremes
  EXPECT_GT(broken, 5);
}

TEST(Run, RestartGoesOnBitForBit) {
  restarts<2>(scene_of(relaxing(deck_of(lead_in_void), "remap_every = 2")));
  restarts<2>(scene_of(relaxing(deck_of(lead_in_void), "remap_quality = 0.98")));
  restarts<2>(scene_of(following(deck_of(sliding(lead_in_void)))));
  restarts<2>(scene_of(deck_of(lead_in_void)));
  restarts<2>(scene_of(breaking));
  restarts<2>(scene_of(deck_of(sliding(lead_in_void))));
  SceneSpec every_other = scene_of(deck_3d); // between remaps positions and volumes are not the target mesh's
  every_other.motion.remap_every = 2;
  every_other.sliding = {1};
  restarts<3>(every_other);
}

TEST(Run, AStepBelowTheLeastIsAFailure) {
  const SceneSpec spec = scene_of(deck_of(lead_in_void));
  EXPECT_DOUBLE_EQ(spec.numerics.dt_min, 1e-10 * spec.end_time);
  Scene<2> scene = build_scene<2>(spec, 1);
  Clock clock = clock_to(spec.end_time);
  scene.numerics.dt_min = 1e-3;
  try {
    advance(scene, clock);
    ADD_FAILURE() << "taken";
  } catch (const NumericalFailure& failure) {
    EXPECT_TRUE(std::string_view(failure.what()).find("cell (") < std::string_view(failure.what()).find("dt_min")) << failure.what();
  }
}

// The gas beside the metal in mixed cells, at speed: its share of volume and of
// work once drove it to negative volume and energy.
TEST(Run, CopperThroughAirIntoMuscleEndsWithEveryGram) {
  const SceneSpec spec = scene_of(deck_of(copper_in_air));
  Scene<2> scene = build_scene<2>(spec, 2);
  const Totals start = totals(scene.blocks[0]);
  Clock clock = clock_to(spec.end_time);
  EXPECT_TRUE(run(scene, clock));
  EXPECT_LT(clock.step, 2000); // the step does not collapse: about 300 by sound
  const Totals end = totals(scene.blocks[0]);
  for (std::size_t m = 0; m + 1 < start.mass.size(); ++m) {
    EXPECT_NEAR((end.mass[m] + scene.ledger.mass_out[m]) / start.mass[m], 1, 1e-12);
  }
}

// Lead, jacket and tissue squeezed beside void: a cell that a remap gives a little void each step must still
// push back, or it is crushed to the EOS' limit and the step falls to nothing (it did, to 1e-17 s at 8 us).
TEST(Run, CoarseBulletKeepsItsStep) {
  constexpr const char* coarse = R"(
title = "M80, half a millimetre"
geometry = "axisymmetric"
end_time = "12 us"
ambient = { pressure = "0 Pa" }
[[body]]
use = "bullet/m80"
tip = ["0 mm", "-1 mm"]
velocity = "823 m/s"
[[body]]
name = "tissue"
material = "muscle"
shape = { box = { from = ["0 mm", "0 mm"], to = ["20 mm", "30 mm"] } }
[mesh]
r = { from = "0 mm", to = ["8 mm", "24 mm"], size = ["0.5 mm", "6 mm"] }
z = { from = "-34 mm", to = ["12 mm", "32 mm"], size = ["0.5 mm", "3 mm"] }
)";
  const SceneSpec spec = scene_of(coarse);
  Scene<2> scene = build_scene<2>(spec, 2);
  Clock clock = clock_to(spec.end_time);
  double first = 0, least = 1;
  Watch<2> watch([&](const Scene<2>&, const Clock& c) {
    first = c.step == 30 ? c.dt : first;
    least = c.step > 30 && !c.done() ? std::min(least, c.dt) : least;
    return c.step < 3000;
  });
  EXPECT_TRUE(run(scene, clock, {&watch}));
  EXPECT_GT(least, first / 10);
}

/// What passes through the free sides of a planar mesh at 100 m/s, under 1 atm.
struct Passage {
  double fastest = 0;     ///< of any node along x, m/s
  double void_volume = 0; ///< at the end, of the mesh's 64 mm2 by metre of depth, m3
};

Passage through_free_sides(const std::string& shape, const std::string& background) {
  const SceneSpec spec = scene_of(fmt::format(R"(
title = "out of the mesh"
geometry = "planar"
end_time = "40 us"
background = "{}"
ambient = {{ pressure = "1 atm" }}
[[body]]
name = "body"
material = "muscle"
shape = {}
velocity = ["100 m/s", "0 m/s"]
[mesh]
x = {{ from = "0 mm", to = "8 mm", size = "0.5 mm" }}
y = {{ from = "0 mm", to = "8 mm", size = "0.5 mm" }}
)", background, shape));
  Scene<2> scene = build_scene<2>(spec, 1);
  Clock clock = clock_to(spec.end_time);
  Passage out;
  Watch<2> watch([&](const Scene<2>& s, const Clock& c) {
    for (const double u : s.blocks[0].velocity[0].data()) {
      out.fastest = std::max(out.fastest, std::abs(u));
    }
    return c.step < 3000;
  });
  EXPECT_TRUE(run(scene, clock, {&watch}));
  const Block<2>& b = scene.blocks[0];
  out.void_volume = b.void_index() < 0 ? 0 : totals(b).volume[static_cast<std::size_t>(b.void_index())];
  return out;
}

constexpr const char* round_body = R"({ sphere = { centre = ["4 mm", "4 mm"], radius = "2.3 mm" } })";
constexpr const char* whole_mesh = R"({ box = { from = ["0 mm", "0 mm"], to = ["8 mm", "8 mm"] } })";

// A body that leaves a mesh of void: nothing presses on the void, whatever the ambient pressure says, so the
// next to massless nodes ahead of it are not flung about.
TEST(Run, FreeSideBesideVoidPressesOnNothing) {
  EXPECT_LT(through_free_sides(round_body, "void").fastest, 120);
}

TEST(Run, FreeSideOfAFullMeshBringsMoreOfTheSame) {
  EXPECT_LT(through_free_sides(round_body, "muscle").fastest, 120);
  const Passage uniform = through_free_sides(whole_mesh, "muscle");
  EXPECT_NEAR(uniform.fastest, 100, 1e-6);
  EXPECT_EQ(uniform.void_volume, 0);
}

} // namespace
} // namespace ballast
