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

} // namespace
} // namespace ballast
