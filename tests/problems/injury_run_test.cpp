// Injury measures of whole runs: what a rigid flight gives, the same numbers for any number of threads and across a restart.
#include "problems/injury_record.hpp"
#include "ale/phases.hpp"
#include "problems/build_scene.hpp"
#include "problems/run_session.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/observers.hpp"
#include "tests/problems/layers_scenes.hpp"

#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ballast {
namespace {

using nlohmann::json;
using Path = std::filesystem::path;

/// A block of water that flies along z, watched at its middle.
constexpr const char* flight = R"(
title = "flight"
geometry = "axisymmetric"
end_time = "100 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "block"
material = "water"
velocity = ["0 m/s", "30 m/s"]
shape = { box = { from = ["0 mm", "0 mm"], to = ["10 mm", "20 mm"] } }
[mesh]
r = { from = "0 mm", to = "10 mm", cells = 2 }
z = { from = "0 mm", to = "20 mm", cells = 4 }
[motion]
policy = "lagrangian"
[[gauge]]
name = "middle"
at = ["2 mm", "11 mm"]
rides = true
[injury]
sternum = "middle"
chest_depth = "236 mm"
back_face = "middle"
filters = ["CFC1000", "CFC600"]
organs = ["water"]
force_on = ["water"]
impactor = ["block"]
body_mass = "64 kg"
)";

/// A ball of lead that meets muscle; sternum in front, spine behind.
constexpr const char* ball = R"(
title = "ball"
geometry = "axisymmetric"
end_time = "12 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "ball"
material = "lead"
shape = { sphere = { centre = ["0 mm", "-3.5 mm"], radius = "3 mm" } }
velocity = ["0 m/s", "200 m/s"]
[[body]]
name = "tissue"
material = "muscle"
shape = { box = { from = ["0 mm", "0 mm"], to = ["12 mm", "14 mm"] } }
[mesh]
r = { from = "0 mm", to = "14 mm", size = "1 mm" }
z = { from = "-8 mm", to = "16 mm", size = "1 mm" }
[results]
bullet = ["ball"]
[[gauge]]
name = "sternum"
at = ["0.5 mm", "1.5 mm"]
rides = true
[[gauge]]
name = "spine"
at = ["0.5 mm", "12.5 mm"]
rides = true
[injury]
sternum = "sternum"
spine = "spine"
chest_depth = "14 mm"
back_face = "sternum"
blast_gauges = ["sternum", "spine"]
accelerometers = ["sternum", "spine"]
record_every = "0.25 us"
sample_every = "2 us"
organs = ["muscle"]
force_on = ["muscle"]
impactor_energy = "20 J"
impactor_diameter = "20 mm"
)";

/// The run's session, stopped after some steps.
class StopsAfter : public RunSession<2> {
public:
  StopsAfter(const ReadScene& read, const Path& dir, int threads, long steps) : RunSession<2>(read, dir, threads, "", {}), steps_(steps) {}
  bool record(const Scene<2>& scene, const Clock& clock) override { return RunSession<2>::record(scene, clock) && clock.step < steps_; }

private:
  long steps_;
};

json summary_in(const Path& dir) {
  std::ifstream in(dir / "summary.json");
  return json::parse(in);
}

ReadScene read_text(const io::TemporaryFolder& folder, const std::string& text, const std::vector<std::string>& settings = {}) {
  std::ofstream(folder.path() / "deck.toml") << text;
  return read_scene((folder.path() / "deck.toml").string(), settings);
}

template <int Dim = 2> json summary_of(const std::string& text, int threads = 1, const std::vector<std::string>& settings = {}) {
  const io::TemporaryFolder folder;
  const ReadScene read = read_text(folder, text, settings);
  EXPECT_EQ(RunSession<Dim>(read, folder.path() / "run", threads, "", {}).run(), 0);
  return summary_in(folder.path() / "run");
}

double value_of(const json& injury, const char* key) { return injury["criteria"][key]["value"]; }

TEST(Injury, RigidFlightHasItsSpeedAndNoAcceleration) {
  const json injury = summary_of(flight)["injury"];
  constexpr double speed = 30, time = 1e-4, way = speed * time;
  EXPECT_NEAR(value_of(injury, "sternum_velocity"), speed, 1e-9);
  EXPECT_NEAR(value_of(injury, "sternum_deflection"), way, speed * 1e-6); // the last interval may be cut
  EXPECT_NEAR(value_of(injury, "back_face_signature"), way, 1e-12);
  EXPECT_NEAR(injury["criteria"]["back_face_signature"]["thresholds"][0]["value_over_threshold"], way / 0.044, 1e-9);
  EXPECT_NEAR(value_of(injury, "viscous_criterion"), speed * value_of(injury, "sternum_deflection") / 0.236, 1e-9);
  EXPECT_NEAR(value_of(injury, "chest_compression"), value_of(injury, "sternum_deflection") / 0.236, 1e-12);
  for (const char* name : {"steps", "recorded", "sampled", "CFC1000", "CFC600"}) {
    EXPECT_NEAR(injury["peak_acceleration_m_per_s2"]["middle"][name]["along"], 0, 1e-3) << name; // round-off of 30 m/s over 1 us
    EXPECT_NEAR(injury["peak_acceleration_m_per_s2"]["middle"][name]["against"], 0, 1e-3) << name;
  }
  EXPECT_NEAR(value_of(injury, "impact_force"), 0, 1e-3);
  EXPECT_NEAR(injury["peak_pressure"]["water"]["over_ambient_Pa"], 0, 1);
  EXPECT_NE(injury["note"].get<std::string>().find("not medical advice"), std::string::npos);
}

TEST(Injury, ImpactorIsTheWholeBody) {
  const json all = summary_of(flight), injury = all["injury"];
  const double mass = all["mass_kg"]["water"]["start"], energy = 0.5 * mass * 900;
  EXPECT_NEAR(value_of(injury, "energy_density"), energy / 3.14159265358979, 1e-9); // a circle of 2 cm
  EXPECT_NEAR(value_of(injury, "blunt_criterion"), std::log(energy / (4 * 2.844 * 2)), 1e-9);
}

TEST(Injury, SceneWithoutTheTableReportsNone) {
  std::string text = flight;
  text.resize(text.find("[injury]"));
  EXPECT_FALSE(summary_of(text).contains("injury"));
}

TEST(Injury, SameNumbersForAnyNumberOfThreads) {
  const json one = summary_of(ball, 1)["injury"], three = summary_of(ball, 3)["injury"];
  EXPECT_EQ(one.dump(), three.dump());
  EXPECT_GT(value_of(one, "impact_force"), 0);
  EXPECT_GT(one["peak_pressure"]["muscle"]["value_Pa"], 1e6);
  EXPECT_FALSE(one["criteria"].contains("blunt_criterion")); // no body_mass
}

TEST(Injury, InterruptedRunGoesOnToTheSameNumbers) {
  const json whole = summary_of(ball)["injury"];
  for (const long steps : {1L, 17L, 60L}) {
    const io::TemporaryFolder folder;
    const ReadScene read = read_text(folder, ball);
    const Path dir = folder.path() / "run";
    ASSERT_EQ(StopsAfter(read, dir, 1, steps).run(), 130) << steps;
    EXPECT_NE(summary_in(dir)["injury"].dump(), whole.dump());
    ASSERT_EQ(RunSession<2>(read, dir, 2, (dir / "checkpoint.h5").string(), {}).run(), 0);
    EXPECT_EQ(summary_in(dir)["injury"].dump(), whole.dump()) << "from step " << steps;
  }
}

TEST(Injury, SternumIsMeasuredAgainstTheSpine) {
  std::string text = ball;
  const json against = summary_of(text)["injury"];
  text.erase(text.find("spine = \"spine\"\n"), std::string("spine = \"spine\"\n").size());
  const json alone = summary_of(text)["injury"];
  const double sternum = value_of(alone, "sternum_deflection"), spine = value_of(summary_of(text, 1, {"injury.sternum=spine"})["injury"], "sternum_deflection");
  EXPECT_GT(spine, 1e-3 * sternum);
  EXPECT_GE(value_of(against, "sternum_deflection"), sternum - spine); // their largest need not come at once
  EXPECT_LT(value_of(against, "sternum_deflection"), sternum);
  EXPECT_EQ(against["peak_acceleration_m_per_s2"]["sternum"], alone["peak_acceleration_m_per_s2"]["sternum"]); // in space
}

TEST(Injury, SleepHidesNoPeak) {
  EXPECT_EQ(summary_of(ball)["injury"].dump(), summary_of(ball, 1, {"numerics.sleeping=false"})["injury"].dump());
}

TEST(Injury, QuarterCountsAsTheWhole) {
  std::string text = flight;
  const auto change = [&](const std::string& from, const std::string& to) { text.replace(text.find(from), from.size(), to); };
  change("axisymmetric", "3d");
  change(R"(velocity = ["0 m/s", "30 m/s"])", R"(velocity = [0, 0, "30 m/s"])");
  change(R"(from = ["0 mm", "0 mm"], to = ["10 mm", "20 mm"])", R"(from = [0, 0, 0], to = ["10 mm", "10 mm", "20 mm"])");
  change("r = {", "y = { from = \"0 mm\", to = \"10 mm\", cells = 2, lower = \"symmetry\" }\nx = { lower = \"symmetry\", ");
  change(R"(at = ["2 mm", "11 mm"])", R"(at = ["2 mm", "2 mm", "11 mm"])");
  const json all = summary_of<3>(text), injury = all["injury"];
  const double energy = 4 * 0.5 * all["mass_kg"]["water"]["start"].get<double>() * 900;
  EXPECT_NEAR(value_of(injury, "energy_density"), energy / 3.14159265358979, 1e-9 * energy); // as wide as 2 cm
  EXPECT_NEAR(value_of(injury, "sternum_velocity"), 30, 1e-9);
  EXPECT_NEAR(value_of(injury, "impact_force"), 0, 1e-2);
}

TEST(Injury, BackFaceOfAStackIsItsLargestDeflection) {
  std::string text = layers_scenes::axisymmetric + "[injury]\nback_face = \"vest\"\n";
  text.replace(text.find("680 us"), 6, "25 us");
  const json all = summary_of(text);
  EXPECT_GT(value_of(all["injury"], "back_face_signature"), 1e-4);
  EXPECT_EQ(value_of(all["injury"], "back_face_signature"), all["results"]["layers"]["vest"]["deflection_m"]["largest"].get<double>()); // sampled every step
}

TEST(Injury, MomentumOfAllMaterialsIsTheBlocks) {
  const io::TemporaryFolder folder;
  const SceneSpec spec = read_text(folder, ball).scene;
  Scene<2> scene = build_scene<2>(spec, 3);
  Clock clock;
  clock.end_time = spec.end_time;
  StepLimit<2> stop(80);
  run(scene, clock, {&stop});
  Block<2>& b = scene.blocks[0];
  const std::vector<int> slots = {0, 1};
  const double whole = totals(b).momentum[1];
  EXPECT_NEAR(material_momentum(b, slots, 1, *scene.pool), whole, 1e-12 * std::abs(whole));
  EXPECT_EQ(material_momentum(b, {0}, 1, *scene.pool), material_momentum(b, {0}, 1, *build_scene<2>(spec, 1).pool));
}

TEST(Injury, PeakPressureIsOfCellsThatTheOrganFills) {
  const io::TemporaryFolder folder;
  const SceneSpec spec = read_text(folder, ball).scene;
  Scene<2> scene = build_scene<2>(spec, 2);
  Block<2>& b = scene.blocks[0];
  const int muscle = slot_map(spec).slot[1];
  b.pressure.row(b.grid.cell_row(12, 0))[3] = 5e6; // z from 4 mm on, r from 3 mm on
  b.pressure.row(b.grid.cell_row(12, 0))[13] = 9e6; // beside the muscle
  b.pressure.row(b.grid.cell_row(20, 0))[1] = 5e6;  // as high, but later
  const PressurePeak peak = highest_pressure(b, muscle, true, *scene.pool);
  EXPECT_DOUBLE_EQ(peak.pressure, 5e6 + b.reference_pressure);
  EXPECT_NEAR(peak.at[0], 3.5e-3, 1e-9);
  EXPECT_NEAR(peak.at[1], 4.5e-3, 1e-9);
}

} // namespace
} // namespace ballast
