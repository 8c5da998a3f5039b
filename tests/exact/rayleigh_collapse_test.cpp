#include "tests/exact/rayleigh_collapse.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast::exact {
namespace {

/// sqrt(pi/6) Gamma(5/6) / Gamma(4/3), Rayleigh's number.
TEST(RayleighCollapse, TakesRayleighsTime) {
  const double number = std::sqrt(std::acos(-1.0) / 6) * std::tgamma(5.0 / 6) / std::tgamma(4.0 / 3);
  EXPECT_NEAR(rayleigh_time(1, 1, 1, 0), number, 1e-9);
  EXPECT_NEAR(rayleigh_time(1e-3, 1e7, 998, 0), number * 1e-3 * std::sqrt(998 / 1e7), 1e-14);
}

/// R'^2 = (2 p / 3 rho) ((R0/R)^3 - 1), by finite differences of the time.
TEST(RayleighCollapse, WallObeysTheEnergyIntegral) {
  for (const double share : {0.9, 0.5, 0.2}) {
    const double d = 1e-4, dt = rayleigh_time(1, 1, 1, share - d) - rayleigh_time(1, 1, 1, share + d);
    const double speed = 2 * d / dt;
    EXPECT_NEAR(speed * speed, 2.0 / 3 * (1 / (share * share * share) - 1), 1e-5 * speed * speed) << share;
  }
}

} // namespace
} // namespace ballast::exact
