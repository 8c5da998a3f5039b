#include "tests/exact/riemann.hpp"

#include "tests/exact/noh.hpp"
#include "tests/exact/reference_table.hpp"
#include "tests/exact/riemann_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ballast::exact {
namespace {

const std::string data = BALLAST_TEST_DATA;

/// Pressures are known to round-off of p + p_inf, velocities to round-off of the sound speed.
double pressure_scale(const RiemannCase& c) {
  return std::max({c.left.pressure + c.left.p_infinity, c.right.pressure + c.right.p_infinity});
}

double sound_speed(const GasState& gas) {
  return std::sqrt(gas.gamma * (gas.pressure + gas.p_infinity) / gas.density);
}

double velocity_scale(const RiemannCase& c) {
  return std::max({sound_speed(c.left),
                   sound_speed(c.right),
                   std::abs(c.left.velocity),
                   std::abs(c.right.velocity)});
}

double specific_energy(const GasState& gas, double density, double pressure) {
  return (pressure + gas.gamma * gas.p_infinity) / ((gas.gamma - 1.0) * density);
}

/// Residuals of the three jump conditions over a shock of speed S, relative to the larger side.
void expect_rankine_hugoniot(
    const GasState& ahead, double density, double velocity, double pressure, double shock_speed) {
  const double flux = ahead.density * (ahead.velocity - shock_speed);
  const double flux_behind = density * (velocity - shock_speed);
  const double scale =
      std::abs(flux * (ahead.velocity - velocity)) + std::abs(ahead.pressure) + ahead.p_infinity;
  EXPECT_NEAR(flux_behind / flux, 1.0, 1e-11);
  EXPECT_NEAR((pressure - ahead.pressure + flux * (velocity - ahead.velocity)) / scale, 0.0, 1e-12);
  const double energy = specific_energy(ahead, density, pressure);
  const double energy_ahead = specific_energy(ahead, ahead.density, ahead.pressure);
  const double work = 0.5 * (pressure + ahead.pressure) * (1.0 / ahead.density - 1.0 / density);
  EXPECT_NEAR((energy - energy_ahead - work) / energy, 0.0, 1e-11);
}

TEST(ExactRiemann, MatchesTabulatedStarStates) {
  const ReferenceTable table(data + "/riemann_star_states.csv");
  // Table and solver each solve the same equation to round-off; 1e-12 leaves room for a contact
  // between impedances 1e3 apart.
  constexpr double tolerance = 1e-12;
  for (const RiemannCase& c : riemann_cases) {
    SCOPED_TRACE(c.name);
    const std::size_t row = table.find("problem", c.name);
    const Riemann riemann(c.left, c.right);
    const double p = table.number(row, "p_star");
    EXPECT_NEAR(riemann.star_pressure(), p, 10 * tolerance * std::abs(p));
    const double u_tolerance = tolerance * velocity_scale(c);
    EXPECT_NEAR(riemann.star_velocity(), table.number(row, "u_star"), u_tolerance);
    const double left = table.number(row, "rho_star_L");
    const double right = table.number(row, "rho_star_R");
    EXPECT_NEAR(riemann.star_density_left(), left, 10 * tolerance * left);
    EXPECT_NEAR(riemann.star_density_right(), right, 10 * tolerance * right);
    if (table.text(row, "waves") == "SCS" && p == c.left.pressure) {
      continue; // sg_contact_advect: no waves; the table's speeds there are 0/0
    }
    const WaveSpeeds& waves = riemann.waves();
    EXPECT_NEAR(waves.left_head, table.number(row, "speed_L_head"), 10 * u_tolerance);
    EXPECT_NEAR(waves.left_tail, table.number(row, "speed_L_tail"), 10 * u_tolerance);
    EXPECT_NEAR(waves.right_tail, table.number(row, "speed_R_tail"), 10 * u_tolerance);
    EXPECT_NEAR(waves.right_head, table.number(row, "speed_R_head"), 10 * u_tolerance);
  }
}

TEST(ExactRiemann, MatchesTabulatedProfiles) {
  int compared = 0;
  for (const char* name : {"riemann_sod_t0.2",
                           "riemann_123_einfeldt",
                           "riemann_leblanc_standard",
                           "riemann_toro3_strong",
                           "riemann_toro4_strong",
                           "riemann_modified_sod_two_gamma",
                           "riemann_lax",
                           "sg_water_air_rho50",
                           "sg_water_air_rho1",
                           "sg_water_cavitation_free",
                           "sg_water_water_impact",
                           "sg_copper_like_into_water"}) {
    SCOPED_TRACE(name);
    const ReferenceTable table(data + "/" + name + ".csv");
    const auto c = std::find_if(riemann_cases.begin(), riemann_cases.end(), [&](const auto& each) {
      return std::string(each.name) == name;
    });
    ASSERT_NE(c, riemann_cases.end());
    const Riemann riemann(c->left, c->right);
    // ExactPack agrees with an independent solver to 6e-11 on these fields (riemann_checks.csv).
    constexpr double tolerance = 1e-10;
    for (std::size_t row = 0; row < table.row_count(); ++row) {
      const double x = table.number(row, "x");
      const auto s = riemann.at((x - c->interface_position) / c->time);
      const double density = std::max(c->left.density, c->right.density);
      EXPECT_NEAR(s.density, table.number(row, "density"), tolerance * density) << x;
      EXPECT_NEAR(s.velocity, table.number(row, "velocity"), tolerance * velocity_scale(*c)) << x;
      EXPECT_NEAR(s.pressure, table.number(row, "pressure"), tolerance * pressure_scale(*c)) << x;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 12 * 101);
}

TEST(ExactRiemann, ConservesMassMomentumEnergyAcrossShocks) {
  for (const RiemannCase& c : riemann_cases) {
    SCOPED_TRACE(c.name);
    const Riemann r(c.left, c.right);
    const double u = r.star_velocity();
    const double p = r.star_pressure();
    if (p > c.left.pressure * (1.0 + 1e-6)) {
      expect_rankine_hugoniot(c.left, r.star_density_left(), u, p, r.waves().left_head);
    }
    if (p > c.right.pressure * (1.0 + 1e-6)) {
      expect_rankine_hugoniot(c.right, r.star_density_right(), u, p, r.waves().right_head);
    }
  }
}

TEST(ExactRiemann, IsMirrorSymmetricAndGalileanInvariant) {
  constexpr double boost = 0.75; // of the velocity scale
  for (const RiemannCase& c : riemann_cases) {
    SCOPED_TRACE(c.name);
    const double scale = velocity_scale(c);
    GasState left = c.right;
    GasState right = c.left;
    left.velocity = boost * scale - left.velocity;
    right.velocity = boost * scale - right.velocity;
    const Riemann original(c.left, c.right);
    const Riemann mirrored(left, right);
    for (double ray = -2.03; ray < 2.0; ray += 0.11) {
      const auto a = original.at(ray * scale);
      const auto b = mirrored.at((boost - ray) * scale);
      EXPECT_NEAR(a.density, b.density, 1e-10 * a.density);
      EXPECT_NEAR(a.velocity, boost * scale - b.velocity, 1e-11 * scale);
      EXPECT_NEAR(a.pressure, b.pressure, 1e-11 * pressure_scale(c));
      EXPECT_NE(a.left, b.left);
    }
  }
}

TEST(ExactRiemann, OpensVacuumBetweenFastRecedingGases) {
  // Escape speed 2 c / (gamma - 1) = 5 c for gamma = 1.4; c = 1 here.
  const GasState left{1.4, -6.0, 1.0, 1.4};
  const GasState right{1.4, 6.0, 1.0, 1.4};
  const Riemann riemann(left, right);
  EXPECT_TRUE(riemann.vacuum());
  EXPECT_NEAR(riemann.waves().left_head, -7.0, 1e-14);
  EXPECT_NEAR(riemann.waves().left_tail, -1.0, 1e-14);
  EXPECT_NEAR(riemann.waves().right_tail, 1.0, 1e-14);
  EXPECT_EQ(riemann.at(0.5).density, 0.0);
  EXPECT_EQ(riemann.at(0.5).pressure, 0.0);
  EXPECT_NEAR(riemann.at(-1.0 - 1e-9).velocity, -1.0, 1e-8);
  EXPECT_LT(riemann.at(-1.01).density, 1e-12);

  const Riemann holding({1.4, -4.99, 1.0, 1.4}, {1.4, 4.99, 1.0, 1.4});
  EXPECT_FALSE(holding.vacuum());
  EXPECT_GT(holding.star_pressure(), 0.0);
}

TEST(ExactRiemann, ReproducesPlanarNohFromColdGas) {
  const Noh noh{Geometry::planar, 5.0 / 3.0, 1.0, 1.0};
  const Riemann riemann({1, 1, 0, 5.0 / 3.0}, {1, -1, 0, 5.0 / 3.0});
  for (double x : {0.05, 0.19, 0.21, 0.8}) {
    const FlowState expected = state_at(noh, x, 0.6);
    const auto sample = riemann.at(x / 0.6);
    EXPECT_NEAR(sample.density, expected.density, 1e-14 * expected.density);
    EXPECT_NEAR(sample.velocity, expected.velocity, 1e-14);
    EXPECT_NEAR(sample.pressure, expected.pressure, 1e-14);
  }
}

TEST(ExactRiemann, RejectsUnphysicalStates) {
  const GasState air{1.0, 0.0, 1e5, 1.4};
  EXPECT_THROW(Riemann({0.0, 0.0, 1e5, 1.4}, air), std::invalid_argument);
  EXPECT_THROW(Riemann(air, {1.0, 0.0, -1.0, 1.4}), std::invalid_argument);
  EXPECT_THROW(Riemann(air, {1.0, 0.0, 1e5, 1.0}), std::invalid_argument);
}

} // namespace
} // namespace ballast::exact
