// Laws of Steinberg-Guinan strength, on the library's lead and copper.
#include "materials/library.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

const SteinbergGuinan& model_of(const char* name) { return std::get<SteinbergGuinan>(find_material(name)->strength); }

TEST(SteinbergGuinan, ModulusGrowsWithPressureAsPublished) {
  const SteinbergGuinan& m = model_of("copper_steinberg");
  // 28.3 /TPa: 5 % compression at 300 K and 10 GPa; T0 = 293 K adds B 7 K = 0.3 %.
  const double eta = 1.05, T = temperature(m, eta * 8930, 0), p = 10e9;
  EXPECT_NEAR(shear_ratio(m, eta * 8930, p, 0), 1 + 2.83e-11 * p / std::cbrt(eta) - 3.77e-4 * (T - 300), 1e-4);
  for (const char* name : {"lead_steinberg", "copper_steinberg"}) {
    const SteinbergGuinan& s = model_of(name);
    EXPECT_GT(shear_ratio(s, s.eos.rho0, 2e9, 0), shear_ratio(s, s.eos.rho0, 1e9, 0)) << name;
    EXPECT_NEAR(shear_ratio(s, s.eos.rho0, 0, 0), 1 + s.thermal_softening * 7, 1e-12) << name;
  }
}

TEST(SteinbergGuinan, ModulusSoftensWithHeatAndVanishesAtTheMeltingPoint) {
  const SteinbergGuinan& m = model_of("lead_steinberg");
  const double melt = 124 * (760 - 293.0);
  EXPECT_NEAR(shear_ratio(m, 11340, 0, 124 * 107.0), 1 - 1.16e-3 * 100, 1e-12); // at 400 K
  EXPECT_GT(shear_ratio(m, 11340, 0, 0.999 * melt), 0);
  EXPECT_EQ(shear_ratio(m, 11340, 0, 1.001 * melt), 0);
  EXPECT_GT(melting_temperature(m, 1.1 * 11340), 760); // pressure holds melting back
}

TEST(SteinbergGuinan, IsentropicCompressionIsAsWarmAsItsGrueneisenParameterSays) {
  // e along the isentrope by integrating de = p/rho^2 drho; then T = T0 exp(gamma0 x) to the series' fourth order.
  const Material& copper = *find_material("copper_steinberg");
  const SteinbergGuinan& m = model_of("copper_steinberg");
  const int steps = 20000;
  const double rho0 = 8930, rho1 = 1.1 * rho0, h = (rho1 - rho0) / steps;
  double e = 0; // the zero of the reference curve
  for (int i = 0; i < steps; ++i) {
    const double rho = rho0 + h * i, half = e + 0.5 * h * pressure(copper.eos, rho, e) / (rho * rho);
    e += h * pressure(copper.eos, rho + 0.5 * h, half) / ((rho + 0.5 * h) * (rho + 0.5 * h));
  }
  const double x = 1 - rho0 / rho1, warm = 293 * std::exp(2.02 * x);
  // The series' next term is about c0^2 (4 s^3/5) x^5 / cp = 0.7 K.
  EXPECT_NEAR(temperature(m, rho1, e), warm, 1);
  EXPECT_GT(e / 383, 200); // what neglecting the cold energy would add
}

TEST(SteinbergGuinan, YieldHardensUpToItsMaximum) {
  const SteinbergGuinan& m = model_of("lead_steinberg");
  EXPECT_DOUBLE_EQ(flow_stress(m, {0, 0, 1e-8, 1}, 0), 8e6);
  EXPECT_NEAR(flow_stress(m, {0.05, 0, 1e-8, 1}, 0), 8e6 * std::pow(6.5, 0.52), 1);
  EXPECT_EQ(flow_stress(m, {10, 0, 1e-8, 1}, 0), 100e6);
  EXPECT_EQ(flow_stress(m, {10, 0, 1e-8, 1.5}, 0), 150e6); // Ymax goes with G
}

TEST(SteinbergGuinan, ReturnStaysOnYieldSurface) {
  const SteinbergGuinan& m = model_of("lead_steinberg");
  for (const double stiffer : {1.0, 1.7, 0.2}) {
    for (const double strain : {0.0, 0.01, 5.0}) {
      for (const double over : {1.0001, 3.0, 100.0}) {
        const FlowState s{strain, 0, 1e-8, stiffer};
        const double q = over * flow_stress(m, s, 0);
        const PlasticIncrement d = plastic_increment(m, s, q);
        EXPECT_TRUE(d.converged);
        EXPECT_NEAR(q - 3 * m.shear_modulus * stiffer * d.value, flow_stress(m, s, d.value), 1e-9 * q);
      }
    }
  }
}

} // namespace
} // namespace ballast
