#include "core/deck_keys.hpp"
#include "problems/commands.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reader.hpp"
#include "problems/scene_reading.hpp"
#include "problems/scene_report.hpp"

#include <cmath>
#include <fstream>
#include <filesystem>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sstream>

namespace ballast {
namespace {

const std::string source_dir = BALLAST_SOURCE_DIR;

std::string file_text(const std::string& path) {
  std::ifstream in(path);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

SceneSpec scene_of(const std::string& text, const std::string& where = "test.toml") {
  Deck deck = Deck::parse(text, where);
  SceneSpec scene = read_scene(deck);
  EXPECT_TRUE(deck.clean()) << deck.error_report();
  return scene;
}

const std::string small = R"(
title = "small"
geometry = "axisymmetric"
end_time = "20 us"
[[body]]
name = "block"
material = "copper_ofhc"
velocity = ["0 m/s", "-10 m/s"]
shape = { difference = [ { box = { from = ["0 mm", "0 mm"], to = ["5 mm", "8 mm"] } },
                         { revolved = { profile = [[0, "1 mm"], ["2 mm", "1 mm"]], origin = ["0 mm", "1 mm"] } } ] }
[[body]]
name = "water"
material = "water"
pressure = "2 atm"
shape = { half_space = { point = ["0 mm", "9 mm"], outward = [0, -1] } }
[mesh]
r = { from = "0 mm", to = "8 mm", size = "0.5 mm", upper = "wall" }
z = { from = "0 mm", to = "10 mm", size = "0.5 mm", lower = { type = "wall", velocity = "3 m/s" }, upper = "outflow" }
[motion]
policy = "relax"
[materials.copper_ofhc]
A = "100 MPa"
)";

TEST(Scene, IsResolvedInSi) {
  const SceneSpec s = scene_of(small);
  EXPECT_DOUBLE_EQ(s.end_time, 20e-6);
  ASSERT_EQ(s.materials.size(), 2u);
  EXPECT_EQ(s.materials[0].name, "copper_ofhc");
  EXPECT_EQ(std::get<JohnsonCook>(s.materials[0].strength).A, 100e6);
  EXPECT_EQ(s.bodies[0].velocity[1], -10);
  EXPECT_NEAR(pressure(s.materials[1].eos, s.bodies[1].density, s.bodies[1].specific_energy),
              2 * 101325,
              1e-6);
  EXPECT_EQ(s.boundaries[0][0].kind, BoundaryKind::symmetry);
  EXPECT_EQ(s.boundaries[0][1].kind, BoundaryKind::wall);
  EXPECT_EQ(s.boundaries[1][0].wall_velocity, 3);
  EXPECT_EQ(s.boundaries[1][1].kind, BoundaryKind::outflow);
  EXPECT_EQ(s.mesh_lines[0].size(), 17u);
  EXPECT_TRUE(s.mesh_lines[2].empty());
  EXPECT_EQ(s.background, -1);
  EXPECT_EQ(s.interface_order, (std::vector<int>{0, 1}));
  EXPECT_EQ(s.motion.policy, MotionPolicy::relax);
}

TEST(Scene, ResolvedDeckReadsBackToItself) {
  Deck deck = Deck::parse(small, "test.toml");
  read_scene(deck);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  const std::string once = write_toml(deck.root());
  Deck again = Deck::parse(once, "resolved.toml");
  read_scene(again);
  ASSERT_TRUE(again.clean()) << again.error_report();
  EXPECT_EQ(once, write_toml(again.root()));
}

TEST(Scene, ResolvedDecksReadBackHoweverARemapIsDue) {
  for (const char* motion : {"policy=\"relax\"", "policy=\"lagrangian\"", "remap_quality=0.5"}) {
    Deck deck = Deck::parse(small, "test.toml", {fmt::format("motion.{}", motion)});
    read_scene(deck);
    ASSERT_TRUE(deck.clean()) << deck.error_report();
    Deck again = Deck::parse(write_toml(deck.root()), "resolved.toml");
    read_scene(again);
    EXPECT_TRUE(again.clean()) << again.error_report();
  }
}

TEST(Scene, BodiesThatFillNothingAreNamed) {
  const std::string again = "[[body]]\nname = \"lid\"\nmaterial = \"lead\"\nshape = { half_space = { point = [\"0 mm\", \"8.9 mm\"], outward = [0, -1] } }\n";
  const std::string covered = std::string(small).insert(small.find("[mesh]"), again);
  EXPECT_EQ(scene_table(scene_of(small)).find("warning"), std::string::npos);
  EXPECT_NE(scene_table(scene_of(covered)).find("warning: body \"water\" fills nothing"), std::string::npos);
}

TEST(Scene, TensionBelowSpallIsForDecksWithoutSpall) {
  Deck deck = Deck::parse(small, "test.toml", {"body.water.pressure=-1 GPa", "numerics.spall=false"});
  read_scene(deck);
  EXPECT_TRUE(deck.clean()) << deck.error_report();
}

TEST(Scene, OrderOfSectionsDoesNotMatter) {
  const auto mesh = small.find("[mesh]"), body = small.find("[[body]]");
  const SceneSpec s =
      scene_of(small.substr(0, body) + small.substr(mesh) + small.substr(body, mesh - body));
  EXPECT_EQ(s.bodies.size(), 2u);
}

TEST(Scene, SettingsActBeforeValidation) {
  Deck deck = Deck::parse(
      small, "t.toml", {"body.water.material=air", "mesh.r.size=1 mm", "motion.remap_every=4"});
  const SceneSpec s = read_scene(deck);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  EXPECT_EQ(s.materials[1].name, "air");
  EXPECT_EQ(s.mesh_lines[0].size(), 9u);
  EXPECT_EQ(s.motion.remap_every, 4);
  Deck bad = Deck::parse(small, "t.toml", {"mesh.r.size=1 kg"});
  read_scene(bad);
  EXPECT_NE(bad.error_report().find(
                "--set mesh.r.size=1 kg: mesh.r.size: \"kg\" is not a unit of length"),
            std::string::npos)
      << bad.error_report();
}

TEST(Scene, SymmetryPlanesOfA3dScene) {
  const SceneSpec s = read_scene(source_dir + "/problems/m80_tissue_3d.toml").scene;
  EXPECT_EQ(s.boundaries[0][0].kind, BoundaryKind::symmetry);
  EXPECT_EQ(s.boundaries[1][0].kind, BoundaryKind::symmetry);
  EXPECT_EQ(s.boundaries[2][0].kind, BoundaryKind::free);
  EXPECT_EQ(s.results.shot_axis, 2);
}

TEST(Scene, M80WeighsWhatItShould) {
  const SceneSpec s = read_scene(source_dir + "/problems/m80_tissue.toml").scene;
  const std::vector<Filled> filled = filled_bodies(s);
  EXPECT_NEAR(filled[0].mass, 6.893e-3, 6.893e-6);
  EXPECT_NEAR(
      filled[0].mass + filled[1].mass, 9.525e-3, 9.525e-6); // 0.1 %; the issue asks for 0.5 %
  EXPECT_EQ(s.results.bullet, (std::vector<int>{0, 1}));
  EXPECT_EQ(s.results.shot_axis, 1);
  EXPECT_EQ(s.results.target_face, 0);
  EXPECT_EQ(s.gauges.size(), 3u);
  EXPECT_EQ(s.bodies[0].velocity[1], 823);
}

TEST(Scene, ExamplesAreValid) {
  int decks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_dir + "/problems")) {
    if (entry.path().extension() == ".toml") {
      EXPECT_NO_THROW(read_scene(entry.path().string())) << entry.path();
      ++decks;
    }
  }
  EXPECT_GE(decks, 10);
}

TEST(Parts, AreTheProfilesOnFile) {
  const auto points = [](const std::string& file) {
    std::ifstream in(source_dir + "/problems/data/" + file);
    std::vector<std::array<double, 2>> out;
    for (std::string line; std::getline(in, line);) {
      double z = 0, r = 0;
      if (std::sscanf(line.c_str(), "%lf,%lf", &z, &r) == 2) {
        out.push_back({z * 1e-3, r * 1e-3});
      }
    }
    return out;
  };
  for (const std::string name : {"m80", "m882"}) {
    const Part& part = *find_part("bullet/" + name);
    EXPECT_EQ(part.bodies[0].outline, points(name + "_core.csv"));
    EXPECT_EQ(part.bodies[1].outline, points(name + "_outer.csv"));
    EXPECT_EQ(part.bodies[1].hollow, part.bodies[0].outline);
    EXPECT_EQ(part.length, part.bodies[1].outline.back()[0]);
  }
}

TEST(Parts, M882WeighsWhatItShould) {
  Deck deck = Deck::parse(R"(
title = "m882"
geometry = "axisymmetric"
end_time = 1e-6
[[body]]
use = "bullet/m882"
[mesh]
r = { from = "0 mm", to = "5 mm", size = "0.1 mm" }
z = { from = "-16 mm", to = "1 mm", size = "0.1 mm" }
)",
                          "test.toml");
  const std::vector<Filled> filled = filled_bodies(read_scene(deck));
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  EXPECT_NEAR(filled[0].mass, 6.431e-3 * 11350 / 11340, 2e-6); // the outline was made with 11340 kg/m3
  EXPECT_NEAR(filled[1].mass, 1.569e-3, 2e-6);
  EXPECT_NEAR(filled[0].mass + filled[1].mass, 8e-3, 8e-6); // 0.1 %
}

TEST(Parts, ProfileFromAFileEqualsThePart) {
  Deck deck = Deck::parse(R"(
title = "file"
geometry = "axisymmetric"
end_time = 1e-6
[[body]]
name = "core"
material = "lead"
shape = { revolved = { file = "data/m80_core.csv", origin = ["0 mm", "-28.5 mm"] } }
[mesh]
r = { from = "0 mm", to = "5 mm", size = "0.5 mm" }
z = { from = "-30 mm", to = "1 mm", size = "0.5 mm" }
)",
                          source_dir + "/problems/inline.toml");
  const SceneSpec s = read_scene(deck);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  const auto& profile = std::get<Revolved>(s.bodies[0].shape.form).profile;
  EXPECT_EQ(profile.size(), find_part("bullet/m80")->bodies[0].outline.size());
  EXPECT_EQ(write_toml(deck.root()).find("m80_core.csv"), std::string::npos); // stands alone
}

TEST(Docs, DeckReferenceIsGenerated) {
  EXPECT_EQ(file_text(source_dir + "/docs/deck.md"), scene_keys::reference())
      << "run: ballast deck-reference > docs/deck.md";
}

TEST(Docs, VersionIsCMakes) {
  EXPECT_NE(file_text(source_dir + "/CMakeLists.txt").find(std::string("VERSION ") + version + " "),
            std::string::npos);
}

} // namespace
} // namespace ballast
