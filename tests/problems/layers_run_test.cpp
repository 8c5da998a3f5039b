// A run of a scene with fabric layers: what it conserves, what it writes, and that neither threads nor a restart change a bit.
#include "ale/embedding.hpp"
#include "tests/observers.hpp"
#include "tests/problems/restarts.hpp"
#include "tests/problems/run_deck.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

/// A bullet of some bodies on three layers whose edges lie free: nothing outside acts along the shot.
std::string on_vest(const std::string& body, const std::string& bullet) {
  return "title = \"disc on vest\"\n" + body + R"(
[motion]
policy = "relax"
remap_every = 4
[numerics]
spall = false
[[layers]]
name = "vest"
fabric = "kevlar_km2_raftenberg"
front = "0 mm"
layers = 3
half_width = "20 mm"
cells = 10
friction = 0.2
[output]
fields_every = "5 us"
[results]
bullet = [")" + bullet + "\"]\n";
}

/// A lead disc.
std::string deck(bool solid) {
  const std::string body = solid ? R"(
geometry = "3d"
end_time = "3 us"
[[body]]
name = "disc"
material = "lead"
velocity = [0, 0, "370 m/s"]
shape = { cylinder = { from = [0, 0, "-3 mm"], to = [0, 0, 0], radius = "6 mm" } }
[mesh]
map = "rod"
outer_radius = "6 mm"
u = { from = 0, to = 1, cells = 3 }
v = { from = 0, to = 1, cells = 3 }
z = { from = "-3 mm", to = "0 mm", cells = 2 }
)"
                                 : R"(
geometry = "axisymmetric"
end_time = "15 us"
[[body]]
name = "disc"
material = "lead"
velocity = ["0 m/s", "370 m/s"]
shape = { cylinder = { from = ["0 mm", "-3 mm"], to = ["0 mm", "0 mm"], radius = "6 mm" } }
[mesh]
r = { from = "0 mm", to = "6 mm", cells = 6 }
z = { from = "-3 mm", to = "0 mm", cells = 3 }
)";
  return on_vest(body, "disc");
}

/// The disc on a mesh at rest in which the layers lie.
std::string embedded_deck() {
  std::string text = deck(false);
  const auto put = [&](const std::string& from, const std::string& to) { text.replace(text.find(from), from.size(), to); };
  put("r = { from = \"0 mm\", to = \"6 mm\", cells = 6 }", "r = { from = \"0 mm\", to = \"10 mm\", cells = 10 }");
  put("z = { from = \"-3 mm\", to = \"0 mm\", cells = 3 }", "z = { from = \"-5 mm\", to = \"10 mm\", cells = 15 }");
  put("policy = \"relax\"", "policy = \"eulerian\"");
  return text;
}

/// A quarter of it in 3D.
std::string embedded_deck_3d() {
  std::string text = deck(true);
  const auto put = [&](const std::string& from, const std::string& to) { text.replace(text.find(from), from.size(), to); };
  put("geometry = \"3d\"", "geometry = \"3d\"\nsymmetry = [\"x\", \"y\"]");
  put("end_time = \"3 us\"", "end_time = \"6 us\"");
  put("map = \"rod\"\nouter_radius = \"6 mm\"\nu = { from = 0, to = 1, cells = 3 }\nv = { from = 0, to = 1, cells = 3 }\nz = { from = \"-3 mm\", to = \"0 mm\", cells = 2 }",
      "x = { from = \"0 mm\", to = \"8 mm\", cells = 8 }\ny = { from = \"0 mm\", to = \"8 mm\", cells = 8 }\nz = { from = \"-5 mm\", to = \"8 mm\", cells = 13 }");
  put("policy = \"relax\"", "policy = \"eulerian\"");
  return text;
}

/// A slug through the vest into tissue, a quarter of it in 3D on cells of 1 mm.
std::string slug_deck() {
  return R"(
title = "slug"
geometry = "3d"
symmetry = ["x", "y"]
end_time = "14 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "slug"
material = "lead"
velocity = [0, 0, "823 m/s"]
shape = { cylinder = { from = [0, 0, "-13 mm"], to = [0, 0, "-7 mm"], radius = "3 mm" } }
[[body]]
name = "tissue"
material = "muscle"
shape = { box = { from = [0, 0, 0], to = ["8 mm", "8 mm", "8 mm"] } }
[mesh]
x = { from = "0 mm", to = "9 mm", cells = 9 }
y = { from = "0 mm", to = "9 mm", cells = 9 }
z = { from = "-14 mm", to = "10 mm", cells = 24 }
[motion]
policy = "eulerian"
remap_every = 4
[numerics]
sliding = ["muscle"]
[fabrics.vest]
base = "kevlar_km2_raftenberg"
solid = true
[[layers]]
name = "vest"
fabric = "vest"
front = "-6.67 mm"
layers = 5
half_width = "20 mm"
to = "5 mm"
size = ["1 mm", "5 mm"]
erode_when = "either"
erode_volume = 0.05
[output]
fields_every = "5 us"
[results]
bullet = ["slug"]
target = "muscle"
)";
}

/// A jacketed bullet on the same: the mesh is turned about the line of flight, core and jacket share cells.
std::string bullet_deck(bool solid) {
  const std::string tip = solid ? "[0, 0, 0]" : "[0, 0]", across = "{ from = 0, to = 1, cells = 3 }\n";
  return on_vest(fmt::format("geometry = \"{}\"\nend_time = \"{} us\"\n[[body]]\nuse = \"bullet/m882\"\ntip = {}\nvelocity = \"370 m/s\"\n[mesh]\nmap = \"turned\"\n"
                             "outline = {{ use = \"bullet/m882\", tip = {} }}\nz = {{ cells = 6 }}\nu = {}{}{}",
                             solid ? "3d" : "axisymmetric", solid ? 6 : 15, tip, tip, across, solid ? "v = " : "", solid ? across : ""),
                 "core\", \"jacket");
}

template <int Dim> Written run(int threads, const std::string& text) { return run_text<Dim>(text, threads); }

template <int Dim> Written run(int threads) { return run<Dim>(threads, deck(Dim == 3)); }

template <int Dim> void expect_conserved(const nlohmann::json& j, double mass = 1e-13) {
  EXPECT_LT(std::abs(j["conservation_errors"]["mass_relative"].get<double>()), mass);
  EXPECT_LT(std::abs(j["conservation_errors"]["energy_relative"].get<double>()), 1e-10);
  const nlohmann::json& vest = j["results"]["layers"]["vest"];
  EXPECT_EQ(vest["mass_kg"]["start"], vest["mass_kg"]["end"]);
  const double start = j["momentum_kg_m_per_s"]["start"][Dim - 1], end = j["momentum_kg_m_per_s"]["end"][Dim - 1];
  EXPECT_NEAR(end, start, 1e-12 * start);
  if (Dim == 3) { // across: what the planes of symmetry gave to cloth and bullet, oblique contact with held nodes in it
    const nlohmann::json& p = j["momentum_kg_m_per_s"];
    for (std::size_t d = 0; d < 2; ++d) {
      const double given = p["given_by_edges_of_layers"][d].get<double>() - p["left_block"][d].get<double>();
      EXPECT_NEAR(p["end"][d].get<double>(), p["start"][d].get<double>() + given, 1e-12 * start) << d;
    }
  }
  const double taken = vest["momentum_kg_m_per_s"]["end"][Dim - 1];
  EXPECT_GT(taken, 0.01 * start); // the disc pushed
  if (Dim == 2) { // runs until the push is through
    EXPECT_GT(vest["deflection_m"]["last"].get<double>(), 1e-4);
  }
  EXPECT_GT(vest["energy_J"]["contact_loss"].get<double>(), 0.0);
  EXPECT_GE(vest["substeps"].get<long>(), j["steps"].get<long>());
}

TEST(LayersRun, DiscOnAVestConservesMassMomentumAndEnergyAroundAnAxis) { expect_conserved<2>(run<2>(1).summary); }

TEST(LayersRun, DiscOnAVestConservesMassMomentumAndEnergyInSpace) { expect_conserved<3>(run<3>(2).summary); }

TEST(LayersRun, ADiscOnAMeshThatStaysDoesToo) {
  expect_conserved<2>(run<2>(2, embedded_deck()).summary, 1e-12);
  expect_conserved<3>(run<3>(2, embedded_deck_3d()).summary, 1e-12);
}

/// Summary of a deck of problems/.
nlohmann::json run_shipped(const std::string& deck, const std::vector<std::string>& sets) {
  return run_written<2>(read_scene(std::string(BALLAST_SOURCE_DIR) + "/problems/" + deck, sets), 2).summary;
}

/// M80 through the vest, where the bullet slides along tissue beside torn layers: what slides and the rest have momenta of their own, and energy
/// is accounted for to rounding; nothing comes through while a layer is whole.
TEST(LayersRun, ABulletThroughAVestIntoTissueKeepsItsEnergyAccount) {
  const nlohmann::json j = run_shipped("m80_vest_tissue.toml", {"mesh.refine=0.5", "end_time=\"17 us\""});
  EXPECT_LT(std::abs(j["energy_J"]["unaccounted"].get<double>()), 1e-8 * j["energy_J"]["start"].get<double>());
  EXPECT_LT(j["energy_J"]["lost_where_the_mesh_meets_layers"].get<double>(), 0.05 * j["energy_J"]["start"].get<double>());
  EXPECT_LT(std::abs(j["conservation_errors"]["mass_relative"].get<double>()), 1e-9); // traces are dropped, with an entry
  EXPECT_GT(j["results"]["layers"]["vest"]["mass_kg"]["eroded"].get<double>(), 0);
  EXPECT_LT(j["results"]["layers"]["vest"]["passed_kg"]["largest_while_whole"].get<double>(), 1e-12);
}

/// The same in 3D: along planes of symmetry, until the slug has torn the vest and meets tissue.
TEST(LayersRun, ASlugThroughAVestInSpaceKeepsItsEnergyAccount) {
  const nlohmann::json j = run<3>(2, slug_deck()).summary;
  EXPECT_LT(std::abs(j["energy_J"]["unaccounted"].get<double>()), 1e-8 * j["energy_J"]["start"].get<double>());
  EXPECT_LT(j["energy_J"]["lost_where_the_mesh_meets_layers"].get<double>(), 0.05 * j["energy_J"]["start"].get<double>());
  EXPECT_LT(std::abs(j["conservation_errors"]["mass_relative"].get<double>()), 1e-9);
  EXPECT_GT(j["results"]["layers"]["vest"]["mass_kg"]["eroded"].get<double>(), 0);
  EXPECT_LT(j["results"]["layers"]["vest"]["passed_kg"]["largest_while_whole"].get<double>(), 1e-8); // of 2.6 g
}

/// Energy account of a run in which a vest crosses a side, and waves go out there.
void expect_side_is_accounted_for(const std::string& side) {
  std::string text = "title = \"a vest that goes on\"\ngeometry = \"axisymmetric\"\nend_time = \"12 us\"\n"
                           "[[body]]\nname = \"disc\"\nmaterial = \"lead\"\nvelocity = [0, \"370 m/s\"]\nshape = { cylinder = { from = [0, \"-5 mm\"], to = [0, \"-2 mm\"], radius = \"6 mm\" } }\n"
                           "[[body]]\nname = \"tissue\"\nmaterial = \"muscle\"\nshape = { cylinder = { from = [0, 0], to = [0, \"10 mm\"], radius = \"20 mm\" } }\n"
                           "[mesh]\nr = { from = 0, to = \"10 mm\", cells = 10, upper = \"SIDE\" }\nz = { from = \"-6 mm\", to = \"10 mm\", cells = 16, upper = \"SIDE\" }\n"
                           "[motion]\npolicy = \"eulerian\"\nremap_every = 4\n"
                           "[[layers]]\nname = \"vest\"\nfabric = \"kevlar_km2_raftenberg\"\nfront = \"-2 mm\"\nlayers = 2\nplies = 10\nthickness = \"2 mm\"\nareal_density = \"1.8 kg/m2\"\n"
                           "half_width = \"30 mm\"\nsize = \"2 mm\"\n[results]\nbullet = [\"disc\"]\n";
  for (std::size_t at = text.find("SIDE"); at != std::string::npos; at = text.find("SIDE")) {
    text.replace(at, 4, side);
  }
  const nlohmann::json j = run<2>(2, text).summary;
  EXPECT_LT(std::abs(j["energy_J"]["unaccounted"].get<double>()), 1e-11 * j["energy_J"]["start"].get<double>());
  EXPECT_LT(j["energy_J"]["boundary_work"].get<double>() - j["energy_J"]["left_block"].get<double>(), -1e-3);
}

/// What an absorbing side takes works on the way of nodes that the vest holds.
TEST(LayersRun, AnAbsorbingSideThatAVestCrossesKeepsTheEnergyAccount) { expect_side_is_accounted_for("absorbing"); }

/// What flows out keeps the speed that characteristics give it, whatever the vest there does.
TEST(LayersRun, AnOutflowSideThatAVestCrossesKeepsTheEnergyAccount) { expect_side_is_accounted_for("outflow"); }

/// Cells at rest away from the layers are passed over.
TEST(LayersRun, SleepBesideLayersChangesNoBit) {
  const auto awake = [](const nlohmann::json& j) { return j["awake_share"].get<double>(); };
  std::string text = slug_deck();
  const auto put = [&](const std::string& from, const std::string& to) { text.replace(text.find(from), from.size(), to); };
  put("end_time = \"14 us\"", "end_time = \"7 us\"");
  put("to = [\"8 mm\", \"8 mm\", \"8 mm\"]", "to = [\"8 mm\", \"8 mm\", \"24 mm\"]");
  put("to = \"10 mm\", cells = 24", "to = \"26 mm\", cells = 40");
  const Written on = run<3>(2, text);
  text.insert(text.find("sliding = ["), "sleeping = false\n");
  const Written off = run<3>(2, text);
  EXPECT_EQ(on.history, off.history);
  EXPECT_EQ(on.summary["results"], off.summary["results"]);
  const std::vector<std::string> coarse = {"mesh.refine=0.5", "end_time=\"8 us\""};
  std::vector<std::string> wakeful = coarse;
  wakeful.push_back("numerics.sleeping=false");
  const nlohmann::json a = run_shipped("m80_vest_tissue.toml", coarse), b = run_shipped("m80_vest_tissue.toml", wakeful);
  EXPECT_EQ(a["results"], b["results"]);
  EXPECT_EQ(a["energy_J"], b["energy_J"]);
  EXPECT_LT(awake(on.summary), 0.95);
  EXPECT_LT(awake(a), 0.6);
  EXPECT_EQ(awake(b), 1);
}

/// A ply half a cell thick, and a layer of four cells, that cannot tear: all of the bullet stays on its side, and bulges them.
TEST(LayersRun, NothingPassesALayerThatCannotTear) {
  const std::vector<std::string> coarse = {"mesh.refine=0.5", "end_time=\"25 us\""};
  std::vector<std::string> bullet = coarse;
  bullet.insert(bullet.end(), {"body.0.use=\"bullet/m882\"", "body.0.velocity=\"445 m/s\"", "layers.0.thickness=\"2 mm\""});
  for (const auto& sets : {coarse, bullet}) {
    const nlohmann::json j = run_shipped("m80_unbreakable_ply.toml", sets);
    const nlohmann::json& ply = j["results"]["layers"]["ply"];
    EXPECT_LT(ply["passed_kg"]["largest_while_whole"].get<double>(), 1e-15);
    EXPECT_EQ(ply["passed_kg"]["up"].get<double>(), 0);
    EXPECT_GT(ply["deflection_m"]["last"].get<double>(), 1e-3);
    EXPECT_LT(std::abs(j["energy_J"]["unaccounted"].get<double>()), 1e-8 * j["energy_J"]["start"].get<double>());
  }
}

TEST(LayersRun, AJacketedBulletDoesToo) {
  expect_conserved<2>(run<2>(2, bullet_deck(false)).summary);
  expect_conserved<3>(run<3>(2, bullet_deck(true)).summary);
}

template <int Dim> void expect_same_bits(const std::string& text = deck(Dim == 3)) {
  const Written one = run<Dim>(1, text);
  for (const int threads : {2, 3}) {
    const Written more = run<Dim>(threads, text);
    EXPECT_EQ(one.history, more.history) << threads;
    EXPECT_EQ(one.back_face, more.back_face) << threads;
    EXPECT_EQ(one.summary["results"], more.summary["results"]) << threads;
  }
}

TEST(LayersRun, SameBitsOnAnyNumberOfThreads) {
  expect_same_bits<2>();
  expect_same_bits<3>();
  expect_same_bits<2>(embedded_deck());
  expect_same_bits<3>(embedded_deck_3d());
}

/// What the layers would not touch would fly through them.
TEST(LayersRun, MeshesThatDoNotFitTheLayersAreRefused) {
  Deck eulerian = Deck::parse(deck(true), "test.toml", {"motion.policy=eulerian"}), wide = Deck::parse(deck(false), "test.toml", {"mesh.r.to=7 mm"});
  read_scene(eulerian);
  EXPECT_FALSE(eulerian.clean());
  const SceneSpec spec = read_scene(wide);
  ASSERT_TRUE(wide.clean()) << wide.error_report();
  EXPECT_THROW(build_scene<2>(spec, 1), Error);
}

TEST(LayersRun, HistoryHasTheColumnsOfTheStack) {
  const std::string history = run<2>(1).history, header = history.substr(0, history.find('\n'));
  for (const char* column : {"vest_deflection [m]", "vest_dome_radius_r [m]", "vest_energy_kinetic [J]", "vest_contact_loss [J]", "bullet_velocity [m/s]"}) {
    EXPECT_NE(header.find(column), std::string::npos) << column;
  }
}

/// All that moves, as numbers.
template <int Dim> std::vector<double> state_of(const Scene<Dim>& scene) {
  const Layers<Dim>& l = scene.layers.at(0);
  const LayerLedger& g = l.ledger;
  std::vector<double> out = {g.contact_loss, g.friction_loss, g.step_change, g.deepest, l.closing, l.stack.step, static_cast<double>(l.steps), static_cast<double>(g.crushed),
                             g.edge_impulse[0], g.edge_impulse[1], static_cast<double>(g.behind), static_cast<double>(g.turned_over)};
  const auto add = [&](const std::vector<double>& values) { out.insert(out.end(), values.begin(), values.end()); };
  for (std::size_t d = 0; d < Dim; ++d) {
    add(l.stack.position[d]);
    add(l.stack.velocity[d]);
    add(l.stack.force[d]);
    add(scene.blocks[0].position[d].data());
    add(scene.blocks[0].velocity[d].data());
  }
  add(l.stack.energy);
  add(l.stack.hourglass_energy);
  add(l.stack.shock_heat);
  add(l.stack.shock_volume);
  for (const auto& point : l.stack.largest) {
    add(point[0]);
    add(point[1]);
  }
  for (const auto& c : l.slidelines.pairs) {
    out.push_back(c.taken);
    add(c.tracks[0].gap);
  }
  return out;
}

template <int Dim> void expect_restart_goes_on(const std::string& source) {
  Deck text = Deck::parse(source, "test.toml", {});
  expect_restarts<Dim>(read_scene(text), {1, 6, 13}, [](const Scene<Dim>& scene) { return state_of(scene); });
}

/// Beside layers that tear, stopped where elements have gone in the last step: their room is given back in the next.
TEST(LayersRun, RestartOfATornVestGoesOnBitForBit) {
  const ReadScene read = read_scene(std::string(BALLAST_SOURCE_DIR) + "/problems/m80_vest_tissue.toml", {"mesh.refine=0.5", "end_time=\"13 us\""});
  Scene<2> scene = build_scene<2>(read.scene, 1);
  Clock clock;
  clock.end_time = read.scene.end_time;
  std::vector<long> torn;
  while (!clock.done()) {
    advance(scene, clock);
    if (scene.embedded[0]->alive[0] != scene.layers[0].stack.alive) {
      torn.push_back(clock.step);
    }
  }
  ASSERT_GT(torn.size(), 2u);
  expect_restarts<2>(read.scene, {torn[0], torn[torn.size() / 2], torn.back()}, [](const Scene<2>& s) {
    std::vector<double> state = state_of(s);
    const EmbeddingMemory memory = memory_of(*s.embedded[0]);
    state.insert(state.end(), memory.alive[0].begin(), memory.alive[0].end());
    state.insert(state.end(), memory.cells.begin(), memory.cells.end());
    for (const Pocket& p : memory.pockets) {
      state.push_back(p.volume);
    }
    return state;
  });
}

TEST(LayersRun, RestartGoesOnBitForBit) {
  expect_restart_goes_on<2>(deck(false));
  expect_restart_goes_on<3>(deck(true));
  expect_restart_goes_on<2>(bullet_deck(false));
  expect_restart_goes_on<3>(bullet_deck(true));
  expect_restart_goes_on<2>(embedded_deck());
  expect_restart_goes_on<3>(embedded_deck_3d());
}

} // namespace
} // namespace ballast
