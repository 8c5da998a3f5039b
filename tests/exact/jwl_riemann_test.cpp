#include "tests/exact/jwl_riemann.hpp"

#include "tests/exact/reference_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace ballast::exact {
namespace {

const JwlLaw lee{1.905, 632.1, -0.04472, 11.3, 1.13, 0.8938};
const FlowState left{0.9525, 0, 1}, right{3.81, 0, 2};

TEST(ExactJwl, WavesAreTheTables) {
  // The table is good to 1e-4; its header gives these.
  const JwlRiemann r(lee, left, right);
  EXPECT_NEAR(r.left_head(), -1.50904288, 1e-4);
  EXPECT_NEAR(r.left_tail(), -1.50904288, 1e-4);
  EXPECT_NEAR(r.star_velocity(), -0.1329959488, 1e-4);
  EXPECT_NEAR(r.right_tail(), 1.389216798, 2e-4);
  EXPECT_NEAR(r.right_head(), 1.787459468, 1e-4);
}

TEST(ExactJwl, ProfileIsTheTables) {
  const ReferenceTable table(std::string(BALLAST_TEST_DATA) + "/riemann_jwl_lee.csv");
  const JwlRiemann r(lee, left, right);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const double at = (table.number(row, "x") - 50) / 20;
    bool edge = false; // a row within a cell of a jump may lie on its other side
    for (const double wave : {r.left_head(), r.star_velocity()}) {
      edge = edge || std::abs(at - wave) < 0.006;
    }
    if (edge) {
      continue;
    }
    const FlowState s = r.at(at);
    EXPECT_NEAR(s.density, table.number(row, "density"), 4e-4) << at;
    EXPECT_NEAR(s.velocity, table.number(row, "velocity"), 2e-4) << at;
    EXPECT_NEAR(s.pressure, table.number(row, "pressure"), 5e-4) << at;
    EXPECT_NEAR(jwl_energy(lee, s.density, s.pressure), table.number(row, "specific_internal_energy"), 4e-4) << at;
  }
}

TEST(ExactJwl, ShockKeepsMassMomentumEnergy) {
  const JwlRiemann r(lee, left, right);
  const double s = r.left_head(), m0 = left.density * (left.velocity - s), m1 = r.star_density_left() * (r.star_velocity() - s);
  EXPECT_NEAR(m0, m1, 1e-12);
  EXPECT_NEAR(left.pressure + m0 * (left.velocity - s), r.star_pressure() + m1 * (r.star_velocity() - s), 1e-12);
  const double e0 = jwl_energy(lee, left.density, left.pressure), e1 = jwl_energy(lee, r.star_density_left(), r.star_pressure());
  const double w0 = left.velocity - s, w1 = r.star_velocity() - s;
  EXPECT_NEAR(e0 + left.pressure / left.density + 0.5 * w0 * w0, e1 + r.star_pressure() / r.star_density_left() + 0.5 * w1 * w1, 1e-11);
}

} // namespace
} // namespace ballast::exact
