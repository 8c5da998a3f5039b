#include "tests/exact/noh.hpp"

#include "tests/exact/reference_table.hpp"

#include <gtest/gtest.h>

namespace ballast::exact {
namespace {

const std::string data = BALLAST_TEST_DATA;

TEST(ExactNoh, MatchesTabulatedProfiles) {
  const struct {
    Geometry geometry;
    const char* file;
  } cases[] = {{Geometry::planar, "/noh_planar_t0.6.csv"},
               {Geometry::cylindrical, "/noh_cylindrical_t0.6.csv"},
               {Geometry::spherical, "/noh_spherical_t0.6.csv"}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.file);
    const ReferenceTable table(data + c.file);
    ASSERT_GE(table.row_count(), 100u);
    for (std::size_t row = 0; row < table.row_count(); ++row) {
      const FlowState state = state_at(Noh{.geometry = c.geometry}, table.number(row, "r"), 0.6);
      // The table gives 13 significant digits.
      const double density = table.number(row, "density");
      EXPECT_NEAR(state.density, density, 1e-12 * density);
      EXPECT_NEAR(state.velocity, table.number(row, "velocity"), 1e-12);
      EXPECT_NEAR(state.pressure, table.number(row, "pressure"), 1e-12 * density);
    }
  }
}

TEST(ExactNoh, ConservesMassInsideAFallingSurface) {
  // Gas now within r came from within r + u0 t: int rho dr = rho0 (r + u0 t)^j / j, any shock.
  const double time = 0.6;
  const double radius = 0.9;
  for (int j = 1; j <= 3; ++j) {
    const Noh noh{static_cast<Geometry>(j), 1.4, 2.0, 3.0};
    constexpr int cells = 20000;
    double mass = 0.0;
    for (int i = 0; i < cells; ++i) {
      const double r = radius * (i + 0.5) / cells;
      double area = 1.0;
      for (int k = 1; k < j; ++k) {
        area *= r;
      }
      mass += state_at(noh, r, time).density * area * radius / cells;
    }
    double expected = noh.density / j;
    for (int k = 0; k < j; ++k) {
      expected *= radius + noh.inflow_speed * time;
    }
    // Midpoint rule: one cell straddles the shock, about (density jump x area) / 20000.
    EXPECT_NEAR(mass / expected, 1.0, 1e-3) << j;
  }
}

TEST(ExactNoh, ScalesWithInflowSpeedAndDensity) {
  const Noh unit{.geometry = Geometry::spherical};
  const Noh scaled{Geometry::spherical, 5.0 / 3.0, 7.0, 20.0};
  EXPECT_DOUBLE_EQ(shock_speed(scaled), 20.0 * shock_speed(unit));
  for (double r : {0.1, 0.3, 2.0}) {
    const FlowState a = state_at(unit, r, 0.6);
    const FlowState b = state_at(scaled, r, 0.03);
    EXPECT_NEAR(b.density, 7.0 * a.density, 1e-12 * b.density);
    EXPECT_NEAR(b.velocity, 20.0 * a.velocity, 1e-12);
    EXPECT_NEAR(b.pressure, 2800.0 * a.pressure, 1e-12 * 2800.0 * a.pressure);
  }
}

} // namespace
} // namespace ballast::exact
