// Bullets that lean: what yaw, obliquity and hit offset mean, what they keep, and what a run measures.
#include "problems/build_scene.hpp"
#include "problems/run_attitude.hpp"
#include "problems/run_measure.hpp"
#include "problems/scene_reader.hpp"
#include "problems/scene_report.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

constexpr double degree = std::numbers::pi / 180;

SceneSpec scene_of(const std::string& bodies, const std::string& symmetry = "\"y\"") {
  Deck deck = Deck::parse(fmt::format(R"(
title = "lean"
geometry = "3d"
symmetry = [{}]
end_time = "1 us"
ambient = {{ pressure = "0 Pa" }}
{}
[mesh]
x = {{ from = "{} mm", to = "8 mm", size = "1 mm" }}
y = {{ from = "0 mm", to = "8 mm", size = "1 mm" }}
z = {{ from = "-32 mm", to = "4 mm", size = "1 mm" }}
[results]
bullet = ["core", "jacket"]
)",
                                      symmetry,
                                      bodies,
                                      symmetry.size() > 3 ? 0 : -8),
                          "lean.toml");
  SceneSpec s = read_scene(deck);
  deck.throw_if_errors();
  return s;
}

SceneSpec m80(const std::string& lean) {
  return scene_of("[[body]]\nuse = \"bullet/m80\"\nvelocity = \"800 m/s\"\n" + lean);
}

double total_mass(const SceneSpec& s) {
  double mass = 0;
  for (const Filled& f : filled_bodies(s)) {
    mass += f.mass;
  }
  return mass;
}

AttitudeMeasure measure(const SceneSpec& s) {
  const Scene<3> scene = build_scene<3>(s, 1);
  const SlotMap slots = slot_map(s);
  const LateralRecord record(s);
  return measure_attitude(scene.blocks[0], slots.slot, s.results.shot_axis, s.results.shot_direction, record.mirrored());
}

const Revolved& core_of(const SceneSpec& s) {
  return std::get<Revolved>(s.bodies[0].shape.form);
}

TEST(Attitude, YawTurnsTheAxisAndNotTheVelocity) {
  const SceneSpec s = m80("yaw = \"10 deg\"\n");
  EXPECT_EQ(s.bodies[0].velocity, (Point{0, 0, 800}));
  EXPECT_NEAR(core_of(s).axis[0], std::sin(10 * degree), 1e-15); // z towards x
  EXPECT_NEAR(core_of(s).axis[2], std::cos(10 * degree), 1e-15);
  EXPECT_NEAR(core_of(s).origin[0], -28.5e-3 * std::sin(10 * degree), 1e-15); // about the tip
  const SceneSpec left = m80("yaw = \"10 deg\"\ntowards = \"-x\"\n");
  EXPECT_NEAR(core_of(left).axis[0], -std::sin(10 * degree), 1e-15);
}

TEST(Attitude, ObliquityTurnsBothAndOffsetMovesTheTip) {
  const SceneSpec s = m80("obliquity = \"60 deg\"\nyaw = \"-3 deg\"\nhit_offset = \"2 mm\"\n");
  EXPECT_NEAR(s.bodies[1].velocity[0], 800 * std::sin(60 * degree), 1e-10);
  EXPECT_NEAR(s.bodies[1].velocity[2], 800 * std::cos(60 * degree), 1e-10);
  EXPECT_NEAR(core_of(s).axis[0], std::sin(57 * degree), 1e-15);
  EXPECT_NEAR(core_of(s).origin[0] + 28.5e-3 * core_of(s).axis[0], 2e-3, 1e-15);
  EXPECT_EQ(s.results.shot_axis, 2); // the target's normal, not the larger component
  const SceneSpec back = m80("direction = \"-z\"\ntip = [0, 0, -0.029]\nyaw = \"2 deg\"\n");
  EXPECT_EQ(back.results.shot_direction, -1);
  EXPECT_GT(core_of(back).axis[0], 0);
}

TEST(Attitude, DescribedBodiesLeanAsTheLibrarysDo) {
  const std::string lean = "yaw = \"7 deg\"\nobliquity = \"4 deg\"\nhit_offset = \"-1 mm\"\ntip = [0, 0, 0]\n";
  const std::string described = fmt::format("[[body]]\nname = \"core\"\nmaterial = \"lead_antimony\"\nvelocity = [0, 0, \"800 m/s\"]\n"
                                            "shape = {{ revolved = {{ file = \"{0}m80_core.csv\", origin = [0, 0, -0.0285] }} }}\n{1}"
                                            "[[body]]\nname = \"jacket\"\nmaterial = \"gilding_metal\"\nvelocity = [0, 0, \"800 m/s\"]\n"
                                            "shape = {{ difference = [{{ revolved = {{ file = \"{0}m80_outer.csv\", origin = [0, 0, -0.0285] }} }}, "
                                            "{{ revolved = {{ file = \"{0}m80_core.csv\", origin = [0, 0, -0.0285] }} }}] }}\n{1}",
                                            BALLAST_SOURCE_DIR "/problems/data/", lean);
  const SceneSpec a = m80(lean), b = scene_of(described);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(core_of(a).origin[k], core_of(b).origin[k], 1e-15);
    EXPECT_NEAR(core_of(a).axis[k], core_of(b).axis[k], 1e-15);
    EXPECT_NEAR(a.bodies[1].velocity[k], b.bodies[1].velocity[k], 1e-10);
  }
  EXPECT_NEAR(total_mass(a), total_mass(b), 1e-9 * total_mass(a));
}

TEST(Attitude, KeepsMassAndMomentum) {
  const SceneSpec straight = m80("");
  const double mass = total_mass(straight);
  const AttitudeMeasure still = measure(straight);
  EXPECT_NEAR(still.mass, mass, 1e-12 * mass);
  for (const char* lean : {"yaw = \"2 deg\"\n", "yaw = \"-5 deg\"\nhit_offset = \"1.3 mm\"\n", "obliquity = \"5 deg\"\n"}) {
    const SceneSpec s = m80(lean);
    const AttitudeMeasure m = measure(s);
    EXPECT_NEAR(m.mass / mass, 1, 3e-4) << lean; // fractions err by 1e-3 of a cut cell, with random sign
    const double speed = std::sqrt(m.momentum[0] * m.momentum[0] + m.momentum[2] * m.momentum[2]) / m.mass;
    EXPECT_NEAR(speed, 800, 1e-9) << lean; // nothing beside it: every node has its velocity
    EXPECT_NEAR(m.momentum[0] / m.mass, s.bodies[0].velocity[0], 1e-9) << lean;
  }
}

TEST(Attitude, MeasuredYawIsTheBullets) {
  for (const double yaw : {0.0, 2.0, -6.0}) {
    const SceneSpec s = m80(fmt::format("yaw = \"{} deg\"\n", yaw));
    LateralRecord record(s);
    ASSERT_EQ(record.axes(), std::vector<int>{0}); // y is a plane of symmetry, z the shot
    record.add(0, measure(s));
    // Cells of 1 mm as points: the long axis of 28 mm errs by a few hundredths of a degree.
    EXPECT_NEAR(record.state().yaw[0] / degree, yaw, yaw == 0 ? 1e-12 : 0.05);
    EXPECT_NEAR(record.state().tilt[0], record.state().yaw[0], 1e-12);
  }
  const SceneSpec oblique = m80("obliquity = \"5 deg\"\n");
  LateralRecord record(oblique);
  record.add(0, measure(oblique));
  EXPECT_NEAR(record.state().tilt[0] / degree, 5, 0.05);
  EXPECT_NEAR(record.state().yaw[0] / degree, 0, 0.05);
}

TEST(Attitude, AxisOfAFlatBulletIsItsShortOne) {
  const std::string disc = "[[body]]\nname = \"{}\"\nmaterial = \"lead\"\nvelocity = [0, 0, \"800 m/s\"]\n"
                           "tip = [0, 0, -0.006]\nyaw = \"4 deg\"\nshape = {{ cylinder = {{ from = [0, 0, {}], to = [0, 0, {}], radius = 0.006 }} }}\n";
  const SceneSpec s = scene_of(fmt::format(fmt::runtime(disc), "core", -0.008, -0.006) + fmt::format(fmt::runtime(disc), "jacket", -0.01, -0.008));
  LateralRecord record(s);
  record.add(0, measure(s));
  EXPECT_NEAR(record.state().yaw[0] / degree, 4, 0.2); // 12 mm across, cells of 1 mm
}

TEST(Attitude, SideForceIsTheMomentumsRate) {
  LateralRecord record(m80("yaw = \"2 deg\"\n"));
  AttitudeMeasure m{.mass = 2, .centre = {1, 0, 0}, .momentum = {6, 0, 8}, .axis = {0, 0, 1}};
  record.add(0.25, m);
  m.momentum[0] = 7;
  m.centre[0] = 2.6;
  const std::vector<double> row = record.add(0.75, m);
  EXPECT_EQ(row, (std::vector<double>{2.6, 7, 2, 0, -std::atan2(7.0, 8.0)}));
  EXPECT_NEAR(record.state().deflection[0], 2.6 - 1 - 0.5 * 3, 1e-15);
  LateralRecord other(m80("yaw = \"2 deg\"\n"));
  EXPECT_EQ(other.recall(record.memory()), record.memory().size());
  m.momentum[0] = 9;
  EXPECT_EQ(record.add(1, m), other.add(1, m)); // as after a restart
  EXPECT_EQ(record.memory(), other.memory());
}

/// The main scene, coarse, for a while: speed and front of the bullet, and how it leans.
BodyMeasure shot(const std::string& deck, const std::string& end, const std::vector<std::string>& more, AttitudeMeasure& lean) {
  std::vector<std::string> settings = {"mesh.refine=0.25", "end_time=" + end};
  settings.insert(settings.end(), more.begin(), more.end());
  const SceneSpec s = read_scene(BALLAST_SOURCE_DIR "/problems/" + deck, settings).scene;
  Scene<3> scene = build_scene<3>(s, 1);
  Clock clock;
  clock.end_time = s.end_time;
  run(scene, clock);
  const SlotMap slots = slot_map(s);
  const std::vector<int> bullet = {slots.slot[0], slots.slot[1]};
  const LateralRecord record(s);
  lean = measure_attitude(scene.blocks[0], bullet, 2, 1, record.mirrored());
  return measure_body(scene.blocks[0], bullet, 2, 1);
}

void half_is_quarter(const std::string& end, const std::vector<std::string>& settings, double tolerance) {
  AttitudeMeasure quarter_lean, lean;
  std::vector<std::string> straight = settings;
  straight.push_back("body.0.yaw=0 deg");
  const BodyMeasure quarter = shot("m80_tissue_3d.toml", end, settings, quarter_lean);
  const BodyMeasure half = shot("m80_yaw_3d.toml", end, straight, lean);
  EXPECT_NEAR(half.mass / quarter.mass, 2, 1e-12);
  EXPECT_NEAR(half.velocity / quarter.velocity, 1, tolerance) << end;
  EXPECT_NEAR(half.front / quarter.front, 1, tolerance) << end;
  EXPECT_NEAR(lean.axis[0], 0, 1e-6) << end; // 5e-8 found: the descent's stop again
  EXPECT_NEAR(lean.momentum[0] / lean.momentum[2], 0, 1e-9) << end;
}

TEST(Attitude, HalfAModelWithoutYawGivesTheQuarters) {
  half_is_quarter("1 us", {"numerics.normal=youngs"}, 1e-11); // rounding: 1e-13 found
  // The default normals are found by a descent that stops short of rounding, from other sides in the two meshes: 3e-7 found at
  // 2 us. Later voids at the tip open and close by thresholds on one side first: 5e-4 of the speed at 4 us with cells of 2 mm.
  half_is_quarter("2 us", {"numerics.normal=elvira", "motion.remap_every=1"}, 1e-6);
}

} // namespace
} // namespace ballast
