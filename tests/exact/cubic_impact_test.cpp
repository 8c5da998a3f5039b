#include "tests/exact/cubic_impact.hpp"
#include "tests/exact/mie_gruneisen_impact.hpp"

#include <gtest/gtest.h>

namespace ballast::exact {
namespace {

const CubicHugoniot lead{11340, 2006, 1.429, 0.8506, -1.64}, copper{8930, 3940, 1.489, 0, 0};

TEST(ExactCubicImpact, ShockObeysItsLaw) {
  for (const double u : {1.0, 300.0, 1500.0}) {
    const ShockedState s = shocked(lead, u);
    const double share = u / s.shock_speed;
    EXPECT_NEAR(s.shock_speed, 2006 + 1.429 * u + 0.8506 * share * u - 1.64 * share * share * u, 1e-9);
  }
}

TEST(ExactCubicImpact, IsLinearImpactWithoutHigherTerms) {
  const CubicImpact a = cubic_impact(copper, {11350, 2051, 1.46, 0, 0}, 823);
  const ImpactStates b = PlateImpact({8930, 3940, 1.489, 2.02}, {11350, 2051, 1.46, 2.77}, 823).states();
  EXPECT_NEAR(a.velocity / b.velocity, 1, 1e-12);
  EXPECT_NEAR(a.target.pressure / b.pressure, 1, 1e-12);
  EXPECT_NEAR(a.flyer.density / b.flyer_density, 1, 1e-12);
}

} // namespace
} // namespace ballast::exact
