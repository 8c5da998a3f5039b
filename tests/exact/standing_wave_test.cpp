#include "tests/exact/standing_wave.hpp"

#include <gtest/gtest.h>

namespace ballast::exact {
namespace {

TEST(ExactStandingWave, ObeysTheWaveEquationAndItsEdge) {
  constexpr double h = 1e-3;
  for (const bool ball : {false, true}) {
    const StandingWave wave{ball};
    EXPECT_NEAR(wave.pressure(1, 0.3), 0, 1e-14);
    EXPECT_NEAR(wave.pressure(0, 0), 1, 1e-14);
    EXPECT_NEAR(wave.pressure(0.4, 0.2 + wave.period()), wave.pressure(0.4, 0.2), 1e-13);
    for (const double r : {0.2, 0.5, 0.9}) {
      const auto p = [&](int dr, int dt) { return wave.pressure(r + dr * h, 0.3 + dt * h); };
      const double rr = (p(1, 0) - 2 * p(0, 0) + p(-1, 0)) / (h * h), slope = (p(1, 0) - p(-1, 0)) / (2 * h);
      EXPECT_NEAR((p(0, 1) - 2 * p(0, 0) + p(0, -1)) / (h * h), rr + (ball ? 2 : 1) * slope / r, 1e-4); // h^2 k^4 / 12
    }
  }
}

} // namespace
} // namespace ballast::exact
