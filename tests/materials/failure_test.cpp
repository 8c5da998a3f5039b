// Laws of Johnson-Cook failure.
#include "materials/library.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

const JohnsonCookFailure& model_of(const char* name) { return *find_material(name)->failure; }

TEST(JohnsonCookFailure, IsThePublishedStrainOf4340) {
  const JohnsonCookFailure& m = model_of("steel_4340");
  // Smooth bar in tension (t = 1/3), torsion (0), at 1 /s and room temperature: 0.05 + 3.44 exp(-2.12 t).
  EXPECT_NEAR(failure_strain(m, {1.0 / 3, 1, 0}), 1.747, 1e-3);
  EXPECT_NEAR(failure_strain(m, {0, 1, 0}), 3.49, 1e-12);
}

TEST(JohnsonCookFailure, NotchedBarFailsSooner) {
  // Bridgman: t = 1/3 + ln(1 + a/2R) in the neck of a notch of radius R; a = R here.
  for (const char* name : {"steel_1006", "steel_4340", "al_6061_t6", "al_2024_t351"}) {
    const JohnsonCookFailure& m = model_of(name);
    const double smooth = failure_strain(m, {1.0 / 3, 1, 0}), notched = failure_strain(m, {1.0 / 3 + std::log(1.5), 1, 0});
    EXPECT_LT(notched, smooth) << name;
    EXPECT_GT(notched, 0) << name;
    EXPECT_GT(failure_strain(m, {-1, 1, 0}), smooth) << name; // pressure holds it together
  }
}

TEST(JohnsonCookFailure, HeatDelaysItByD5AndSlowRatesDoNotChangeIt) {
  const JohnsonCookFailure& m = model_of("steel_4340");
  const double cold = failure_strain(m, {0, 1, 0}), halfway = 0.5 * 477 * (1793 - 293.0);
  EXPECT_NEAR(failure_strain(m, {0, 1, halfway}) / cold, 1 + 0.61 * 0.5, 1e-12);
  EXPECT_NEAR(failure_strain(m, {0, 1e4, 0}) / cold, 1 + 0.002 * std::log(1e4), 1e-12);
  EXPECT_EQ(failure_strain(m, {0, 1e-6, 0}), cold);
}

TEST(JohnsonCookFailure, WarmAtTheStartIsAsDuctileAsHeatedThere) {
  JohnsonCookFailure warm = model_of("steel_4340");
  warm.start_temperature = 793;
  EXPECT_NEAR(failure_strain(warm, {0, 1, 0}), failure_strain(model_of("steel_4340"), {0, 1, 477 * 500.0}), 1e-12);
}

TEST(JohnsonCookFailure, PressureWithoutATermForItDoesNotBreak) {
  JohnsonCookFailure m = model_of("steel_4340");
  m.D1 = 0.5;
  m.D2 = 0;
  for (const double d3 : {-20.0, -2.0, 0.0, 2.0}) {
    m.D3 = d3;
    EXPECT_NEAR(failure_strain(m, {-400, 1, 0}), 0.5, 1e-12) << d3; // nearly molten: all pressure, no deviator
  }
}

TEST(JohnsonCookFailure, StrainIsNeverBelowItsLeast) {
  // 6061's published set gives -0.05 at t = 1.5, and more mean tension than that counts as 1.5.
  const JohnsonCookFailure& m = model_of("al_6061_t6");
  EXPECT_EQ(failure_strain(m, {1.5, 1, 0}), 1e-6);
  EXPECT_EQ(failure_strain(model_of("steel_4340"), {9, 1, 0}), failure_strain(model_of("steel_4340"), {1.5, 1, 0}));
}

} // namespace
} // namespace ballast
