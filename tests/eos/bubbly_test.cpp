// Laws of gas in tissue (eos/bubbly).
#include "eos/eos.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace ballast {
namespace {

constexpr double atmosphere = 101325;

/// Tissue of 1050 kg/m3, 1540 m/s.
Bubbly lung(double gas_fraction, double gamma = 1.4, double skeleton = 0) {
  return {.rho0 = 1050 * (1 - gas_fraction), .gas_fraction = gas_fraction, .gamma = gamma, .c0 = 1540, .skeleton_modulus = skeleton, .p_rest = 0};
}

/// Density of the whole when gas and tissue bear P: the law as the header writes it, in closed form.
double density_at(const Bubbly& m, double P) {
  const double gas = m.gas_fraction * std::pow(m.gas_pressure / P, 1 / m.gamma);
  const double tissue = (1 - m.gas_fraction) * std::pow(1 + 7 * (P - m.gas_pressure) / m.tissue_modulus(), -1.0 / 7);
  return m.rho0 / (gas + tissue);
}

std::vector<Bubbly> lungs() { return {lung(0.01), lung(0.3, 1.0), lung(0.8), lung(0.8, 1.2, 9e3), lung(0.99, 5.0 / 3, 1e5)}; }

// From hard tension to where tissue has half of its volume (45 GPa): the pressure of a density is the one that makes this density. Backwards the law is a closed form.
TEST(Bubbly, PressureIsTheOneGasAndTissueShare) {
  for (const Bubbly& m : lungs()) {
    for (double decade = -4; decade <= 10.65; decade += 0.01) {
      const double P = std::pow(10, decade), rho = density_at(m, P);
      const double shared = m.pressure(rho, 0) - m.skeleton_modulus * (rho / m.rho0 - 1) + m.gas_pressure;
      // Density in 1e-15 moves the pressure by rho c^2 times that.
      const double rounding = 1e-14 * (rho * m.sound_speed_squared(rho, 0) + atmosphere + m.skeleton_modulus * (1 + rho / m.rho0));
      ASSERT_NEAR(shared, P, rounding) << describe(m) << " " << rho;
    }
  }
}

TEST(Bubbly, SoundSpeedIsTheDerivativeOfPressureInRandomStates) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decade(-3, 0.75); // to 5.6 times the density
  int checked = 0;
  for (const Bubbly& m : lungs()) {
    for (int i = 0; i < 2000; ++i, ++checked) {
      const double rho = m.rho0 * std::pow(10, decade(random)), step = 1e-5 * rho;
      const double c2 = m.sound_speed_squared(rho, 0), rounding = 1e-15 * (std::abs(m.pressure(rho, 0)) + atmosphere) / step;
      // Central differences err by step^2 p'''/6: where tissue takes over within a thousandth of the density, 1e-5 squared over that squared.
      ASSERT_NEAR((m.pressure(rho + step, 0) - m.pressure(rho - step, 0)) / (2 * step), c2, 3e-4 * c2 + 10 * rounding) << describe(m) << " " << rho;
    }
  }
  EXPECT_EQ(checked, 10000);
}

TEST(Bubbly, PressureRisesWithDensityWithoutAPole) {
  for (const Bubbly& m : lungs()) {
    double last = -m.gas_pressure - m.skeleton_modulus;
    for (double decade = -8; decade < 4; decade += 1e-3) {
      const double p = m.pressure(m.rho0 * std::pow(10, decade), 0);
      ASSERT_TRUE(std::isfinite(p));
      ASSERT_GE(p, last) << describe(m) << " " << decade;
      last = p;
    }
  }
}

// A trace that is pressed a thousandfold: the slope that it had at half of the tissue's volume, without a jump.
TEST(Bubbly, BeyondHalfTheTissuesVolumeThePressureIsALine) {
  for (const Bubbly& m : lungs()) {
    const double P = m.most(), rho = density_at(m, P), c2 = m.sound_speed_squared(rho * (1 - 1e-9), 0);
    EXPECT_NEAR(P / m.tissue_modulus(), 127.0 / 7, 1e-3);
    for (const double times : {1.0 + 1e-9, 1.1, 10.0, 1e5}) {
      EXPECT_NEAR(m.sound_speed_squared(times * rho, 0) / c2, 1, 1e-6);
      EXPECT_NEAR(m.pressure(times * rho, 0), m.pressure(rho * (1 - 1e-9), 0) + c2 * rho * (times - 1), 1e-6 * (P + c2 * rho * times)) << times;
    }
  }
}

TEST(Bubbly, WavesAtRestRunWithWoodsSpeed) {
  for (const double gas_fraction : {0.01, 0.3, 0.8, 0.95}) {
    const Bubbly m = lung(gas_fraction);
    const double wood = 1 / (m.rho0 * (gas_fraction / (1.4 * atmosphere) + (1 - gas_fraction) / (1050.0 * 1540 * 1540)));
    EXPECT_NEAR(m.sound_speed_squared(m.rho0, 0) / wood, 1, 1e-12);
    const Bubbly held = lung(gas_fraction, 1.4, 2e4);
    EXPECT_NEAR(held.sound_speed_squared(m.rho0, 0), wood + 2e4 / m.rho0, 1e-9 * wood);
  }
  const Bubbly inflated{.rho0 = 200, .gas_fraction = 1 - 200 / 1050.0, .gamma = 1.4, .c0 = 1540};
  EXPECT_NEAR(std::sqrt(inflated.sound_speed_squared(200, 0)), 29.6, 0.05); // the figure for adiabatic lung of 200 kg/m3
}

// p = P0 [phi0/(phi0 - mu/(1 + mu))]^gamma - P0, the tissue taken as incompressible: good while it strains little, gamma P/K.
TEST(Bubbly, LightCompressionIsTheGasAlone) {
  const Bubbly m = lung(0.8);
  for (const double mu : {-0.5, -0.1, 0.01, 0.1, 0.5, 1.0, 2.0}) {
    const double want = atmosphere * (std::pow(0.8 / (0.8 - mu / (1 + mu)), 1.4) - 1);
    EXPECT_NEAR(m.pressure(m.rho0 * (1 + mu), 0) / want, 1, 3e-3) << mu;
  }
}

// Pressed by 1 GPa the gas is left 0.6 % of the volume, which the tissue's pressure feels by rho c^2/p = 10 times that.
TEST(Bubbly, CompressedGasLeavesTissue) {
  const Bubbly m = lung(0.8);
  const double K = 1050.0 * 1540 * 1540;
  for (const double p : {1e9, 1e10}) {
    const double stiff = K + 7 * p, rho = 1050 * std::pow(stiff / K, 1.0 / 7);
    EXPECT_NEAR(m.pressure(rho, 0) / p, 1, 0.07);
    EXPECT_NEAR(m.sound_speed_squared(rho, 0) / (stiff / rho), 1, 0.07);
  }
}

TEST(Bubbly, PressureDependsOnDensityAlone) {
  const Eos eos = lung(0.8);
  EXPECT_TRUE(barotropic(eos));
  EXPECT_EQ(pressure(eos, 300, 0), pressure(eos, 300, 1e6));
  EXPECT_NEAR(pressure(eos, 210, 0), 0, 1e-9);
  EXPECT_GT(pressure(eos, 1e-3, 0), -atmosphere);
}

// Work on the isentrope, - p dV by Simpson, against the closed form of the gas in incompressible tissue.
TEST(Bubbly, WorkIsTheGass) {
  const Bubbly m = lung(0.8);
  const double from = 1 / m.rho0, to = 0.5 * from;
  constexpr int steps = 2000;
  double work = 0;
  for (int i = 0; i < steps; ++i) {
    const double a = from + (to - from) * i / steps, b = from + (to - from) * (i + 1) / steps;
    const auto p = [&](double v) { return m.pressure(1 / v, 0); };
    work += (p(a) + 4 * p(0.5 * (a + b)) + p(b)) / 6 * (a - b);
  }
  const double gas = 0.8 * from, pressed = gas - (from - to);
  const double want = atmosphere * gas / 0.4 * (std::pow(gas / pressed, 0.4) - 1) - atmosphere * (from - to);
  EXPECT_NEAR(work / want, 1, 2e-3);
}

} // namespace
} // namespace ballast
