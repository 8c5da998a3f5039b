// Laws of the equations of state.
#include "eos/eos.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace ballast {
namespace {

struct Sample {
  Eos eos;
  double rho, e;
};

std::vector<Sample> samples() {
  const MieGruneisen copper{8930, 3940, 1.489, 2.02};
  MieGruneisen constant = copper;
  constant.gamma_constant = true;
  std::vector<Sample> s = {{IdealGas{1.4}, 1.2, 2.5e5}, {StiffenedGas{4.4, 6e8}, 1000, 1.1e6}};
  for (const double rho : {8000.0, 8800.0, 8931.0, 9500.0, 11000.0}) {
    for (const double e : {0.0, 1e4, 5e5}) {
      s.push_back({copper, rho, e});
      s.push_back({constant, rho, e});
    }
  }
  const CubicGruneisen lead{11340, 2006, 1.429, 0.8506, -1.64, 2.74, 0.54};
  for (const double rho : {10000.0, 11300.0, 11341.0, 13000.0, 17000.0, 25000.0}) {
    for (const double e : {0.0, 1e4, 5e5}) {
      s.push_back({lead, rho, e});
    }
  }
  const Jwl tnt{1630, 371.2e9, 3.231e9, 4.15, 0.95, 0.30, 4.29e6};
  for (const double rho : {1.0, 100.0, 700.0, 1630.0, 2200.0}) {
    for (const double e : {2e5, 4.29e6}) {
      s.push_back({tnt, rho, e});
    }
  }
  for (const double rho : {900.0, 1000.0, 1200.0}) {
    s.push_back({LinearBulk{1000, 2.2e9, 0.4, 1e5}, rho, 1e4});
  }
  for (const double rho : {20.0, 190.0, 201.0, 600.0, 1000.0, 1300.0}) {
    s.push_back({Bubbly{.rho0 = 200, .gas_fraction = 0.81, .skeleton_modulus = 9e3}, rho, 0});
  }
  return s;
}

// c^2 = dp/drho|e + p/rho^2 dp/de, by central differences; their error is about 1e-7 of rho c^2.
TEST(Eos, SoundSpeedIsTheDerivativeOfPressure) {
  for (const Sample& s : samples()) {
    const double dr = 1e-5 * s.rho, de = 1e-5 * (std::abs(s.e) + 1e3);
    const double p_rho = (pressure(s.eos, s.rho + dr, s.e) - pressure(s.eos, s.rho - dr, s.e)) / (2 * dr);
    const double p_e = (pressure(s.eos, s.rho, s.e + de) - pressure(s.eos, s.rho, s.e - de)) / (2 * de);
    const double want = p_rho + pressure(s.eos, s.rho, s.e) / (s.rho * s.rho) * p_e;
    EXPECT_NEAR(sound_speed_squared(s.eos, s.rho, s.e) / want, 1, 1e-6) << describe(s.eos) << s.rho << " " << s.e;
  }
}

TEST(Eos, EnergyInvertsPressure) {
  for (const Sample& s : samples()) {
    const double p = pressure(s.eos, s.rho, s.e);
    EXPECT_NEAR(pressure(s.eos, s.rho, energy(s.eos, s.rho, p)), p, 1e-12 * std::abs(p) + 1e-6);
  }
}

TEST(Eos, MieGruneisenIsContinuousWhereTensionBegins) {
  const Eos eos = MieGruneisen{8930, 3940, 1.489, 2.02};
  const double below = 8930 * (1 - 1e-12), above = 8930 * (1 + 1e-12);
  EXPECT_NEAR(pressure(eos, below, 0), pressure(eos, above, 0), 1e-11 * 8930 * 3940 * 3940);
  EXPECT_NEAR(sound_speed_squared(eos, below, 0) / sound_speed_squared(eos, above, 0), 1, 1e-10);
}

// *EOS_GRUNEISEN as the manual writes it, energy by initial volume.
TEST(Eos, CubicGruneisenIsLsDynas) {
  const CubicGruneisen m{11340, 2006, 1.429, 0.8506, -1.64, 2.74, 0.54};
  for (const double mu : {0.01, 0.1, 0.4, 1.0}) {
    const double e = 3e4, energy0 = m.rho0 * e;
    const double top = m.rho0 * m.c0 * m.c0 * mu * (1 + (1 - m.gamma0 / 2) * mu - m.b / 2 * mu * mu);
    const double d = 1 - (m.s1 - 1) * mu - m.s2 * mu * mu / (mu + 1) - m.s3 * mu * mu * mu / ((mu + 1) * (mu + 1));
    const double want = top / (d * d) + (m.gamma0 + m.b * mu) * energy0;
    EXPECT_NEAR(m.pressure(m.rho0 * (1 + mu), e) / want, 1, 1e-12) << mu;
  }
}

TEST(Eos, CubicGruneisenWithoutItsHigherTermsIsTheLinearOne) {
  const MieGruneisen linear{8930, 3940, 1.489, 2.02};
  const CubicGruneisen cubic{8930, 3940, 1.489, 0, 0, 2.02, 0};
  for (const double rho : {8000.0, 9000.0, 12000.0}) {
    EXPECT_NEAR(cubic.pressure(rho, 2e4) / linear.pressure(rho, 2e4), 1, 1e-12);
    EXPECT_NEAR(cubic.sound_speed_squared(rho, 2e4) / linear.sound_speed_squared(rho, 2e4), 1, 1e-12);
  }
}

TEST(Eos, RowExponentialIsTheLibrarysToRounding) {
  for (double x = -650; x < 650; x += 0.37) {
    EXPECT_NEAR(row_exp(x) / std::exp(x), 1, 5e-16) << x;
  }
  EXPECT_EQ(row_exp(0), 1);
  EXPECT_GE(row_exp(-1e9), 0); // far expanded products
  EXPECT_LT(row_exp(-1e9), 1e-300);
}

TEST(Eos, FarExpandedProductsAreAnIdealGas) {
  const Jwl tnt{1630, 371.2e9, 3.231e9, 4.15, 0.95, 0.30, 4.29e6};
  const IdealGas gas{1.3};
  EXPECT_NEAR(tnt.pressure(1, 1e6) / gas.pressure(1, 1e6), 1, 1e-9);
  EXPECT_NEAR(tnt.sound_speed_squared(1, 1e6) / gas.sound_speed_squared(1, 1e6), 1, 1e-9);
}

TEST(Eos, BarotropicMaterialIgnoresItsEnergy) {
  const Eos eos = LinearBulk{1000, 2.2e9, 0, 1e5};
  EXPECT_TRUE(barotropic(eos));
  EXPECT_FALSE(barotropic(LinearBulk{1000, 2.2e9, 0.1, 0}));
  EXPECT_EQ(pressure(eos, 1010, 0), pressure(eos, 1010, 1e6));
  EXPECT_EQ(pressure(eos, 1000, 0), 1e5);
  EXPECT_DOUBLE_EQ(sound_speed_squared(eos, 700, 0), 2.2e6); // in tension too
}

// The same bits for a row as for one cell, for every model: else a body at rest would not stay so.
TEST(Eos, GaugePressureIsExactlyZeroAtTheReferenceOfEveryModel) {
  for (const Sample& s : samples()) {
    const GaugeReference ref{s.rho, s.e, pressure(s.eos, s.rho, s.e), 0};
    const double rho[2] = {s.rho, s.rho * (1 + 4e-16)}, e[2] = {s.e, s.e};
    double p[2], k[2];
    evaluate_row(s.eos, ref, 2, rho, e, p, k);
    EXPECT_EQ(p[0], 0) << describe(s.eos);
    EXPECT_EQ(p[1], 0) << describe(s.eos);
    EXPECT_NEAR(k[0] / (s.rho * sound_speed_squared(s.eos, s.rho, s.e)), 1, 1e-13) << describe(s.eos);
  }
}

TEST(Eos, GaugePressureIsExactlyZeroAtTheReference) {
  const Eos eos = MieGruneisen{1058, 1562, 1.8, 0.3};
  const double e = energy(eos, 1058, 101325);
  const GaugeReference ref{1058, e, pressure(eos, 1058, e), 0};
  const double rho[3] = {1058, 1058 * (1 + 4e-16), 1059}, es[3] = {e, e, e};
  double p[3], k[3];
  evaluate_row(eos, ref, 3, rho, es, p, k);
  EXPECT_EQ(p[0], 0);
  EXPECT_EQ(p[1], 0); // mass over volume rounds
  EXPECT_GT(p[2], 0);
  EXPECT_NEAR(k[0] / (1058 * sound_speed_squared(eos, 1058, e)), 1, 1e-14);
}

// Sprays and jets expand hot: with Gamma rho constant at any density they would press as hard at a hundredth of theirs, and
// the sound speed would run away.
TEST(Eos, HotMatterThatExpandsPressesLess) {
  constexpr double e = 8e6, rho = 0.5 * 8930; // about where heat and cold tension balance
  MieGruneisen constant{8930, 3940, 1.489, 2.02};
  constant.gamma_constant = true;
  for (const Eos& eos : {Eos(MieGruneisen{8930, 3940, 1.489, 2.02}), Eos(constant), Eos(CubicGruneisen{8930, 3940, 1.489, 0, 0, 2.02, 0.5})}) {
    const double cold = pressure(eos, rho, 0), thermal = pressure(eos, rho, e) - cold;
    EXPECT_NEAR(thermal, 2.02 * rho * e, 1e-9 * thermal);
    EXPECT_GT(sound_speed_squared(eos, rho, e), 0);
    EXPECT_LT(sound_speed_squared(eos, rho, e), 4 * sound_speed_squared(eos, 8930, 0));
  }
}

} // namespace
} // namespace ballast
