// Injury measures of whole runs: what a rigid flight gives, the same numbers for any number of threads and across a restart.
#include "problems/injury_record.hpp"
#include "ale/phases.hpp"
#include "problems/build_scene.hpp"
#include "tests/observers.hpp"
#include "tests/problems/injury_scenes.hpp"
#include "tests/problems/layers_scenes.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

using namespace injury_scenes;

/// The run's session, stopped after some steps.
class StopsAfter : public RunSession<2> {
public:
  StopsAfter(const ReadScene& read, const Path& dir, int threads, long steps) : RunSession<2>(read, dir, threads, "", {}), steps_(steps) {}
  bool record(const Scene<2>& scene, const Clock& clock) override { return RunSession<2>::record(scene, clock) && clock.step < steps_; }

private:
  long steps_;
};

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
  const json injury = summary_of(flight)["injury"];
  const double mass = 998 * std::numbers::pi * 1e-4 * 0.02, energy = 0.5 * mass * 900; // a cylinder of 2 cm by 2 cm
  EXPECT_NEAR(value_of(injury, "energy_density"), energy / std::numbers::pi, 1e-9);
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
  const json all = summary_of<3>(quarter()), injury = all["injury"];
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
