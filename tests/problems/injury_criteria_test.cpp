// Injury criteria: values worked by hand, and what their table must say.
#include "problems/injury_criteria.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <numbers>

namespace ballast {
namespace {

TEST(InjuryCriteria, ViscousCriterionOfAHalfSine) {
  constexpr double depth = 0.236, height = 0.04, duration = 4e-3, h = 1e-6;
  const double w = std::numbers::pi / duration;
  std::vector<double> d, v;
  for (int k = 0; k <= 4000; ++k) {
    d.push_back(height * std::sin(w * h * k));
    v.push_back(height * w * std::cos(w * h * k));
  }
  const Peak peak = largest_of(viscous_response(v, d, depth), h); // V D = height^2 w sin(2 w t) / 2
  EXPECT_NEAR(peak.value, height * height * w / (2 * depth), 1e-12);
  EXPECT_NEAR(peak.time, duration / 4, h);
  EXPECT_NEAR(largest_of(crash_viscous_response(v, d), h).value, peak.value * depth * 1.3 / 0.229, 1e-12);
  EXPECT_DOUBLE_EQ(chest_compression(height, depth), 0.04 / 0.236);
}

TEST(InjuryCriteria, BluntCriterionByHand) {
  // 100 J, 3.7 cm across, a man of 64 kg: W^(1/3) = 4, T = 2.844 cm, W^(1/3) T D = 42.0912 and ln(100 / 42.0912).
  const BluntImpact impact = {100, 0.037, 64, body_wall_thickness(64)};
  EXPECT_NEAR(impact.wall_thickness, 0.02844, 1e-12);
  EXPECT_NEAR(blunt_criterion(impact), 0.865331, 1e-6);
  EXPECT_NEAR(energy_density(impact.energy, impact.diameter), 9.300508, 1e-6); // over 10.7521 cm2
}

TEST(InjuryCriteria, FourParametersGiveOneHalfWhereTheExponentVanishes) {
  BluntImpact impact = {0, 0.037, 64, body_wall_thickness(64)};
  const double half = std::exp(34.13 / 3.597) * 42.0912;  // M V^2, g m2/s2
  impact.energy = 0.5e-3 * half;                          // 1 g = 1e-3 kg
  EXPECT_NEAR(four_parameter_lethality(impact), 0.5, 1e-9);
  impact.energy *= 2; // odds grow by 2^3.597
  EXPECT_NEAR(four_parameter_lethality(impact), 1 - 1 / (1 + std::pow(2, 3.597)), 1e-9);
}

TEST(InjuryCriteria, ChestWallUnderASmallStepIsADampedSpring) {
  // x small: M x'' + J x' + k x = A p with k = K + g P0 A^2 / V0; x' = A p / (M w) e^(-d t) sin w t, largest where tan w t = w / d.
  constexpr double p = 1, h = 1e-6;
  const double k = 989 + 1.2 * 101325 * 0.082 * 0.082 / 1.82e-3, d = 696 / (2 * 2.03), w = std::sqrt(k / 2.03 - d * d), t = std::atan(w / d) / w;
  const std::vector<double> step(10000, p);
  const Peak peak = chest_wall_response(step, h).peak;
  const double exact = 0.082 * p / (2.03 * w) * std::exp(-d * t) * std::sin(w * t);
  EXPECT_NEAR(peak.value, exact, 1e-5 * exact); // the gas law's next term: A x / V0 = 3e-6 of it
  EXPECT_NEAR(peak.time, t, 2 * h);
}

TEST(InjuryCriteria, ChestWallTakesTheWorkOfTheBlast) {
  // Without lung, damping and spring x = 0.9 V0 / A of way give sqrt(2 A p x / M). At 285 m/s they take J v / (A p) = 5 % of the force
  // at most and 1.5 MPa of 50.
  constexpr double p = 50e6, h = 1e-6, area = 0.082, mass = 2.03, way = 0.9 * 1.82e-3 / area;
  const ChestWallResponse wall = chest_wall_response(std::vector<double>(2000, p), h);
  const double free = std::sqrt(2 * area * p * way / mass);
  EXPECT_TRUE(wall.cut);
  EXPECT_GT(wall.peak.value, 0.95 * free);
  EXPECT_LT(wall.peak.value, std::sqrt(2 * area * p * (way + free * h) / mass)); // the last step may go beyond
  EXPECT_FALSE(chest_wall_response(std::vector<double>(20000, 1e5), h).cut);
  EXPECT_NEAR(adjusted_severity(8), 1.16561, 1e-5); // 1.06^2.63 = exp(2.63 ln 1.06)
}

TEST(InjuryCriteria, ReboundIsNotViscous) {
  const std::vector<double> v = {-3, 3, -3, 2}, d = {-0.02, -0.02, 0.02, 0.01}; // out and away, out and back, in and back, in and deeper
  const std::vector<double> vc = viscous_response(v, d, 0.2), crash = crash_viscous_response(v, d);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(vc[k], 0) << k;
    EXPECT_EQ(crash[k], 0) << k;
  }
  EXPECT_DOUBLE_EQ(vc[3], 0.1);
  EXPECT_DOUBLE_EQ(crash[3], 1.3 * 0.02 / 0.229);
}

TEST(InjuryCriteria, EachHasSourceMarkAndLimits) {
  int number = 0;
  for (const InjuryCriterion& c : injury_criteria()) {
    EXPECT_EQ(static_cast<int>(c.measure), number++) << c.key;
    EXPECT_GT(std::strlen(c.source), 0U) << c.key;
    EXPECT_GT(std::strlen(c.mark), 0U) << c.key;
    EXPECT_GT(std::strlen(c.limits), 0U) << c.key;
    for (const InjuryThreshold& t : c.thresholds) {
      EXPECT_GT(std::strlen(t.mark), 0U) << c.key;
      EXPECT_GT(t.value, 0) << c.key;
    }
  }
}

TEST(Docs, InjuryPageHasTheTableAndTheNote) {
  std::ifstream in(BALLAST_SOURCE_DIR "/docs/injury.md");
  const std::string page((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(page.find(injury_reference()), std::string::npos) << "its table is what `ballast injury-reference` prints";
  EXPECT_NE(page.find(injury_note), std::string::npos);
}

} // namespace
} // namespace ballast
