// Injury measures against what is known beforehand: a push of known force, shots along +z and -z, who counts as what hits.
#include "problems/injury_values.hpp"
#include "problems/build_scene.hpp"
#include "tests/problems/injury_push.hpp"
#include "tests/problems/layers_scenes.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

using namespace injury_scenes;

template <int Dim> void force_is_mass_times_acceleration(const std::string& text, double mass) {
  for (const double direction : {1.0, -1.0}) {
    const Push<Dim> push(text, direction, 40e-3);
    const BothWays force = peak_forces(push.spec(), push.record()).at("CFC1000");
    const double exact = mass * Push<Dim>::height;
    EXPECT_NEAR(force.along.value, exact, 1e-5 * exact) << direction; // the filter takes 4e-7 of 50 Hz, an interval of 10 us 1e-6
    EXPECT_NEAR(force.along.time, Push<Dim>::middle, 1e-4) << direction;
    EXPECT_GT(force.against.value, -1e-4 * exact) << direction; // the filter swings by 5e-5 where the push begins
    EXPECT_EQ(push.value(InjuryMeasure::impact_force).value, force.along.value);
  }
}

TEST(Injury, ForceIsMassTimesAcceleration) { force_is_mass_times_acceleration<2>(flight, 998 * std::numbers::pi * 1e-4 * 0.02); }

TEST(Injury, ForceIsOfAllCopies) { force_is_mass_times_acceleration<3>(quarter(), 998 * 4e-4 * 0.02); }

/// The text with each first piece replaced by its second.
std::string changed(std::string text, const std::vector<std::pair<std::string, std::string>>& changes) {
  for (const auto& [from, to] : changes) {
    text.replace(text.find(from), from.size(), to);
  }
  return text;
}

TEST(Injury, ShotAlongMinusZIsItsMirrorImage) {
  const std::string mirrored = changed(ball, {{"\"-3.5 mm\"", "\"3.5 mm\""},
                                              {"\"200 m/s\"", "\"-200 m/s\""},
                                              {"from = [\"0 mm\", \"0 mm\"], to = [\"12 mm\", \"14 mm\"]", "from = [\"0 mm\", \"-14 mm\"], to = [\"12 mm\", \"0 mm\"]"},
                                              {"from = \"-8 mm\", to = \"16 mm\"", "from = \"-16 mm\", to = \"8 mm\""},
                                              {"\"1.5 mm\"", "\"-1.5 mm\""},
                                              {"\"12.5 mm\"", "\"-12.5 mm\""}});
  const json there = summary_of(ball)["injury"], back = summary_of(mirrored)["injury"];
  for (const char* key : {"sternum_deflection", "sternum_velocity", "viscous_criterion", "back_face_signature", "impact_force"}) {
    EXPECT_GT(value_of(there, key), 0) << key;
    EXPECT_NEAR(value_of(back, key), value_of(there, key), 1e-3 * value_of(there, key)) << key; // steps differ in their last digits, then in their number
  }
}

TEST(Injury, BackFaceOfAShotAlongMinusZIsItsMirrorImage) {
  const std::string there = changed(layers_scenes::axisymmetric, {{"680 us", "25 us"}}) + "[injury]\nback_face = \"vest\"\n";
  const std::string back = changed(there, {{"370 m/s", "-370 m/s"},
                                           {"from = [\"0 mm\", \"-6.23 mm\"], to = [\"0 mm\", \"0 mm\"]", "from = [\"0 mm\", \"0 mm\"], to = [\"0 mm\", \"6.23 mm\"]"},
                                           {"from = \"-6.23 mm\", to = \"0 mm\"", "from = \"0 mm\", to = \"6.23 mm\""}});
  const double depth = value_of(summary_of(there)["injury"], "back_face_signature");
  EXPECT_GT(depth, 1e-4);
  EXPECT_NEAR(value_of(summary_of(back)["injury"], "back_face_signature"), depth, 1e-3 * depth); // likewise
}

TEST(Injury, QuarterIsAsWideAboutAPlaneOfSymmetryElsewhere) {
  const std::string moved = changed(quarter(), {{"from = [0, 0, 0], to = [\"10 mm\", \"10 mm\"", "from = [\"5 mm\", 0, 0], to = [\"15 mm\", \"10 mm\""},
                                                {"x = { lower = \"symmetry\",  from = \"0 mm\", to = \"10 mm\"", "x = { lower = \"symmetry\",  from = \"5 mm\", to = \"15 mm\""},
                                                {"at = [\"2 mm\"", "at = [\"7 mm\""}});
  const io::TemporaryFolder folder;
  EXPECT_NEAR(read_text(folder, moved).scene.injury->impactor_diameter, 0.02, 1e-12);
}

TEST(Injury, BodiesOfOneMaterialThatFlyTogetherHitTogether) {
  const std::string two = changed(flight, {{"[mesh]", R"([[body]]
name = "cap"
material = "water"
velocity = ["0 m/s", "30 m/s"]
shape = { box = { from = ["0 mm", "15 mm"], to = ["10 mm", "20 mm"] } }
[mesh])"}, {"impactor = [\"block\"]", "impactor = [\"block\", \"cap\"]"}});
  EXPECT_NEAR(value_of(summary_of(two)["injury"], "energy_density"), 0.5 * 998 * 1e-4 * 0.02 * 900, 1e-9); // over pi cm2
  const std::string given = changed(two, {{", \"cap\"]", "]\nimpactor_energy = \"3 J\""}}); // the cap is not listed, but not counted either
  EXPECT_NEAR(value_of(summary_of(given)["injury"], "energy_density"), 3 / std::numbers::pi, 1e-9);
}

} // namespace
} // namespace ballast
