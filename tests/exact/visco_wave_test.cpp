// Plane viscoelastic waves against independent tables.
#include "tests/exact/reference_table.hpp"
#include "tests/exact/visco_wave.hpp"

#include <gtest/gtest.h>

namespace ballast::exact {
namespace {

void expect_table(const std::string& name, const PronySeries& m) {
  const ReferenceTable waves(BALLAST_TEST_DATA "/visco_" + name + "_waves.csv");
  for (std::size_t row = 0; row < waves.row_count(); ++row) {
    const double f = waves.number(row, "frequency_Hz");
    for (const bool longitudinal : {false, true}) {
      const PlaneWave w = plane_wave(m, f, longitudinal);
      const std::string kind = longitudinal ? "long" : "shear";
      EXPECT_NEAR(w.speed / waves.number(row, "c_" + kind), 1, 1e-10);
      // A small loss is a difference of large numbers: round-off of K over the loss modulus.
      EXPECT_NEAR(w.attenuation / waves.number(row, "alpha_" + kind), 1, longitudinal ? 1e-6 : 1e-9) << f;
    }
  }
  const ReferenceTable fronts(BALLAST_TEST_DATA "/visco_wavefront_decay.csv");
  for (const bool longitudinal : {false, true}) {
    for (std::size_t row = 0; row < fronts.row_count(); ++row) {
      if (fronts.text(row, "set") == name && fronts.text(row, "wave") == (longitudinal ? "long" : "shear")) {
        EXPECT_NEAR(front(m, longitudinal).speed / fronts.number(row, "c0"), 1, 1e-10);
        EXPECT_NEAR(front(m, longitudinal).attenuation / fronts.number(row, "alpha_front"), 1, 1e-10);
      }
    }
  }
}

TEST(ViscoWave, SpeedAttenuationAndFrontOfTheTables) {
  expect_table("sls", sls());
  expect_table("tissueA", tissue_a());
  expect_table("gelatinB", gelatin_b());
}

} // namespace
} // namespace ballast::exact
