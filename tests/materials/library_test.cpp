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

} // namespace
} // namespace ballast
