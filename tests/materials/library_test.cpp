#include "materials/library.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

TEST(Library, EveryMaterialIsAtRestUnderOneAtmosphere) {
  for (const std::string& name : material_names()) {
    const Material& m = *find_material(name);
    EXPECT_EQ(m.name, name);
    EXPECT_NEAR(pressure(m.eos, m.density, m.specific_energy), 101325, 1e-3)
        << name; // one rounding of K0 eta
    EXPECT_GT(sound_speed_squared(m.eos, m.density, m.specific_energy), 0) << name;
    EXPECT_LT(m.spall_pressure, 0) << name;
    EXPECT_FALSE(m.source.empty()) << name;
    EXPECT_FALSE(m.confidence.empty()) << name;
  }
}

TEST(Library, SaysNothingOfUnknownNames) {
  EXPECT_EQ(find_material("unobtainium"), nullptr);
}

TEST(Library, LeadIsThePapers) {
  const Material& m = *find_material("lead");
  const auto& s = std::get<LinearHardening>(m.strength);
  EXPECT_EQ(s.yield, 34.5e6);
  EXPECT_EQ(s.shear_modulus, 5.52e9);
  EXPECT_EQ(s.hardening, 0);
  EXPECT_EQ(m.density, 11350);
}

TEST(Library, SoundSpeedsAreMeasuredOnes) {
  const auto c = [](const char* name) {
    const Material& m = *find_material(name);
    return std::sqrt(sound_speed_squared(m.eos, m.density, m.specific_energy));
  };
  EXPECT_NEAR(c("muscle"), 1562, 1);
  EXPECT_NEAR(c("water"), 1480, 1);
  EXPECT_NEAR(c("gelatin_10"), 1520, 1);
  EXPECT_NEAR(c("air"), 343.8, 1); // sqrt(1.4 * 101325 / 1.2)
}

// Longitudinal waves at rest, c^2 = K/rho + 4/3 G/rho with the G of sudden strain: of bones the P modulus.
TEST(Library, LongitudinalWavesRunAtTheListedSpeeds) {
  const struct {
    const char* name;
    double speed; // m/s, docs/materials.md
  } listed[] = {{"skin", 1655},
                {"fat", 1462},
                {"muscle", 1562},
                {"intercostal_muscle", 1562},
                {"liver", 1540},
                {"heart", 1586},
                {"blood", 1570},
                {"abdomen", 1550},
                {"brain", 1550},
                {"lung", 30},
                {"costal_cartilage", 1665},
                {"cortical_bone", 3194},
                {"trabecular_bone", 2325},
                {"gelatin_10", 1520},
                {"gelatin_10_visco", 1520},
                {"gelatin_20", 1550},
                {"plastilina", 1500},
                {"water", 1480}};
  for (const auto& [name, speed] : listed) {
    const Material* m = find_material(name);
    ASSERT_NE(m, nullptr) << name;
    const double bulk = sound_speed_squared(m->eos, m->density, m->specific_energy), shear = shear_modulus(m->strength) / m->density;
    EXPECT_NEAR(std::sqrt(bulk + 4.0 / 3 * shear) / speed, 1, 0.02) << name;
  }
}

// The card of Zochowski 2019 and what follows from it.
TEST(Library, ClayYieldsAsItsCardSays) {
  const auto& clay = std::get<PowerLawPlastic>(find_material("plastilina")->strength);
  EXPECT_NEAR(2 * clay.shear_modulus * 1.49, 14.2e6, 1);
  EXPECT_NEAR(flow_stress(clay, {1, 0, 0}, 0), 0.24e6, 0.001e6); // K at a strain near 1
  EXPECT_NEAR(flow_stress(clay, {0, 0, 0}, 0), 14.2e6 * clay.first_strain, 1); // begins on Hooke's line
}

} // namespace
} // namespace ballast
