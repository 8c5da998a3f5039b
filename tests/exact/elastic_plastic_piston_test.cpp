#include "tests/exact/elastic_plastic_piston.hpp"

#include "tests/exact/reference_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ballast::exact {
namespace {

const std::string data = BALLAST_TEST_DATA;
using Material = ElasticPlasticPiston::Material;

const Material copper{{8930, 3940, 1.489, 2.02}, 47.7e9, 120e6};
const Material lead{{11350, 2051, 1.46, 2.77}, 8.6e9, 8e6};

/// The tables give 12 significant digits, and ExactPack converts units twice; see each use.
void expect_relative(double value, double expected, double tolerance, const char* what) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected)) << what;
}

/// Residuals of mass, momentum and energy across one shock of laboratory speed `speed`.
void expect_jump_conditions(const ElasticPlasticState& ahead,
                            const ElasticPlasticState& behind,
                            double speed) {
  const double flux = ahead.density * (speed - ahead.velocity);
  const double stress_jump = behind.axial_stress() - ahead.axial_stress();
  const double work = 0.5 * (behind.axial_stress() + ahead.axial_stress()) *
                      (1.0 / ahead.density - 1.0 / behind.density);
  // Round-off of the small density jump: 1e-16 / 1e-3.
  EXPECT_NEAR(behind.density * (speed - behind.velocity) / flux, 1.0, 1e-12);
  EXPECT_NEAR(flux * (behind.velocity - ahead.velocity) / stress_jump, 1.0, 1e-9);
  EXPECT_NEAR((behind.specific_energy - ahead.specific_energy) / work, 1.0, 1e-9);
}

TEST(ExactElasticPlasticPiston, MatchesTabulatedStates) {
  const ReferenceTable table(data + "/epp_states.csv");
  int compared = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (table.text(row, "model") != "hypo") {
      continue;
    }
    SCOPED_TRACE(table.text(row, "set"));
    const auto value = [&](const char* column) { return table.number(row, column); };
    const Material material{
        {value("rho0"), value("c0"), value("s"), value("Gamma")}, value("G"), value("Y")};
    const ElasticPlasticPiston piston(material, value("u_piston"));
    constexpr double tolerance = 1e-9;
    EXPECT_EQ(piston.regime(), PistonRegime::two_wave);
    expect_relative(piston.elastic_speed(), value("speed_elastic"), tolerance, "speed_elastic");
    expect_relative(piston.plastic_speed(), value("speed_plastic"), tolerance, "speed_plastic");
    const ElasticPlasticState& y = piston.yield_state();
    expect_relative(y.density, value("rho_yield"), tolerance, "rho_yield");
    expect_relative(y.pressure, value("p_yield"), tolerance, "p_yield");
    expect_relative(y.velocity, value("u_yield"), tolerance, "u_yield");
    expect_relative(y.specific_energy, value("e_yield"), tolerance, "e_yield");
    expect_relative(y.axial_stress(), value("sig_yield"), tolerance, "sig_yield");
    const ElasticPlasticState& two = piston.piston_state();
    expect_relative(two.density, value("rho_2"), tolerance, "rho_2");
    expect_relative(two.pressure, value("p_2"), tolerance, "p_2");
    expect_relative(two.specific_energy, value("e_2"), tolerance, "e_2");
    expect_relative(two.axial_stress(), value("sig_2"), tolerance, "sig_2");
    expect_relative(two.deviatoric_stress, value("stress_dev_xx"), 1e-11, "stress_dev_xx");
    ++compared;
  }
  EXPECT_EQ(compared, 4);
}

TEST(ExactElasticPlasticPiston, MatchesTabulatedOverdrivenStates) {
  const ReferenceTable table(data + "/epp_overdriven.csv");
  int compared = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    if (table.text(row, "regime") != "overdriven") {
      continue; // the table marks its copper row as invalid
    }
    const auto value = [&](const char* column) { return table.number(row, column); };
    ASSERT_EQ(table.text(row, "material"), "lead");
    const Material material{lead.hugoniot, value("G"), value("Y")};
    const ElasticPlasticPiston piston(material, value("u_piston"));
    constexpr double tolerance = 1e-10;
    EXPECT_EQ(piston.regime(), PistonRegime::overdriven);
    expect_relative(piston.plastic_speed(), value("Us"), tolerance, "Us");
    expect_relative(piston.elastic_speed(), value("speed_elastic"), tolerance, "speed_elastic");
    const ElasticPlasticState& s = piston.piston_state();
    expect_relative(s.density, value("rho"), tolerance, "rho");
    expect_relative(s.axial_stress(), value("sigma"), tolerance, "sigma");
    expect_relative(s.pressure, value("p"), tolerance, "p");
    expect_relative(s.specific_energy, value("e"), tolerance, "e");
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

TEST(ExactElasticPlasticPiston, MatchesTabulatedProfile) {
  const ReferenceTable table(data + "/epp_copper_185ms_hypo.csv");
  const ElasticPlasticPiston piston(copper, 185.0);
  ASSERT_GE(table.row_count(), 100u);
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const ElasticPlasticState s = piston.at(table.number(row, "x"), 1e-5);
    expect_relative(s.density, table.number(row, "density"), 1e-9, "density");
    expect_relative(s.velocity, table.number(row, "velocity"), 1e-9, "velocity");
    expect_relative(s.pressure, table.number(row, "pressure"), 1e-9, "pressure");
    expect_relative(s.specific_energy, table.number(row, "specific_internal_energy"), 1e-9, "e");
    expect_relative(s.deviatoric_stress, table.number(row, "stress_dev_xx"), 1e-9, "s_xx");
  }
}

TEST(ExactElasticPlasticPiston, ConservesMassMomentumEnergyInEveryRegime) {
  const ElasticPlasticState rest{lead.hugoniot.density, 0, 0, 0, 0};
  for (double speed : {0.5, 1.0, 2.0, 50.0, 150.0, 170.0, 400.0}) {
    SCOPED_TRACE(speed);
    const ElasticPlasticPiston piston(lead, speed);
    if (piston.regime() == PistonRegime::two_wave) {
      expect_jump_conditions(rest, piston.yield_state(), piston.elastic_speed());
      expect_jump_conditions(piston.yield_state(), piston.piston_state(), piston.plastic_speed());
      EXPECT_LT(piston.plastic_speed(), piston.elastic_speed());
    } else {
      expect_jump_conditions(rest, piston.piston_state(), piston.plastic_speed());
    }
    EXPECT_EQ(piston.piston_state().velocity, speed);
    EXPECT_LE(std::abs(piston.piston_state().deviatoric_stress),
              2.0 / 3.0 * lead.yield_stress * (1.0 + 1e-14));
  }
}

TEST(ExactElasticPlasticPiston, TakesEachRegimeInItsRange) {
  // Lead yields at 1.06 m/s and is overdriven above about 160 m/s.
  EXPECT_EQ(ElasticPlasticPiston(lead, 1.0).regime(), PistonRegime::elastic);
  EXPECT_EQ(ElasticPlasticPiston(lead, 1.1).regime(), PistonRegime::two_wave);
  EXPECT_EQ(ElasticPlasticPiston(lead, 155.0).regime(), PistonRegime::two_wave);
  EXPECT_EQ(ElasticPlasticPiston(lead, 165.0).regime(), PistonRegime::overdriven);
}

TEST(ExactElasticPlasticPiston, TendsToLinearElasticityForSlowPistons) {
  // c_l^2 = c0^2 + 4G / 3 rho0; the next term is of order u / c0 = 3e-7.
  const ElasticPlasticPiston piston(copper, 1e-3);
  const double c0 = copper.hugoniot.sound_speed;
  const double longitudinal =
      std::sqrt(c0 * c0 + 4.0 / 3.0 * copper.shear_modulus / copper.hugoniot.density);
  EXPECT_NEAR(piston.elastic_speed() / longitudinal, 1.0, 2e-6);
}

TEST(ExactElasticPlasticPiston, RejectsInvalidInput) {
  EXPECT_THROW(ElasticPlasticPiston(copper, 0.0), std::invalid_argument);
  EXPECT_THROW(ElasticPlasticPiston({copper.hugoniot, 0.0, 1e6}, 1.0), std::invalid_argument);
}

} // namespace
} // namespace ballast::exact
