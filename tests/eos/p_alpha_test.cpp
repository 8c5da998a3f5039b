// Laws of the crushing foam (eos/p_alpha).
#include "eos/eos.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace ballast {
namespace {

std::vector<PAlpha> foams() {
  return {{}, // 100 kg/m3 of a polymer
          {.rho0 = 40, .solid_density = 1200, .K = 3e9, .foam_modulus = 2e5, .crush_pressure = 2e4, .solid_pressure = 2e6},
          {.rho0 = 1500, .solid_density = 2700, .K = 70e9, .foam_modulus = 10e9, .crush_pressure = 50e6, .solid_pressure = 1e9},
          {.rho0 = 990, .solid_density = 1000, .K = 2e9, .foam_modulus = 1.5e9, .crush_pressure = 1e5, .solid_pressure = 1e7}};
}

// Herrmann's curve read backwards is a closed form: the density at a pressure.
double density_at(const PAlpha& m, double p) {
  const double crush = m.rho0 / m.solid_density * (1 + m.crush_pressure / m.foam_modulus), alpha_e = 1 / (crush - m.crush_pressure / m.K);
  const double x = (m.solid_pressure - p) / (m.solid_pressure - m.crush_pressure), alpha = p < m.solid_pressure ? 1 + (alpha_e - 1) * x * x : 1.0;
  return m.solid_density * (1 / alpha + p / m.K);
}

TEST(PAlpha, LoadingFollowsHerrmannsCurve) {
  for (const PAlpha& m : foams()) {
    for (int i = 0; i <= 1000; ++i) {
      const double p = m.crush_pressure + (2 * m.solid_pressure - m.crush_pressure) * i / 1000, rho = density_at(m, p);
      ASSERT_NEAR(m.pressure(rho, 0), p, 1e-9 * p + 1e-14 * m.K) << describe(m) << i;
    }
    EXPECT_NEAR(m.pressure(m.rho0, 0), 0, 1e-14 * m.K);
    const double half = 1 + 0.5 * m.crush_pressure / m.foam_modulus;
    EXPECT_NEAR(m.pressure(m.rho0 * half, 0) / (0.5 * m.crush_pressure), 1, 1e-6);
  }
}

/// Densities from half to beyond solid, and histories.
struct State {
  PAlpha foam;
  double rho, compaction;
};
std::vector<State> random_states(int count) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<State> out;
  for (const PAlpha& m : foams()) {
    for (int i = 0; i < count; ++i) {
      const double full = density_at(m, 1.5 * m.solid_pressure), past = m.rho0 + unit(random) * (full - m.rho0);
      out.push_back({m, 0.5 * m.rho0 + unit(random) * (full - 0.5 * m.rho0), i % 2 == 0 ? 0.0 : m.compacted(past, 0)});
    }
  }
  return out;
}

TEST(PAlpha, SoundSpeedIsTheSlopeOfTheBranch) {
  int checked = 0, kinks = 0;
  for (const State& s : random_states(2500)) {
    const double step = 1e-7 * s.rho;
    const auto p = [&](double rho) { return s.foam.branch(rho, s.compaction).p; };
    const double up = (p(s.rho + step) - p(s.rho)) / step, down = (p(s.rho) - p(s.rho - step)) / step;
    const double slope = s.foam.branch(s.rho, s.compaction).slope / s.foam.solid_density, rounding = 1e-15 * s.foam.K / step;
    ++checked;
    if (std::abs(up - down) > 1e-2 * slope + 10 * rounding) {
      ++kinks; // where a branch begins
      continue;
    }
    ASSERT_NEAR(0.5 * (up + down), slope, 1e-3 * slope + 10 * rounding) << describe(s.foam) << " " << s.rho << " " << s.compaction;
  }
  EXPECT_EQ(checked, 10000);
  EXPECT_LT(kinks, 20);
}

TEST(PAlpha, PressureRisesWithDensityAtAnyHistory) {
  for (const PAlpha& m : foams()) {
    for (const double past : {0.0, 0.3, 0.7, 1.2}) {
      const double compaction = m.compacted(m.rho0 + past * (m.solid_density - m.rho0), 0);
      double last = -1e300;
      for (int i = 0; i < 20000; ++i) {
        const double p = m.branch(m.solid_density * i / 15000, compaction).p;
        ASSERT_GE(p, last - 1e-14 * m.K);
        last = p;
      }
    }
  }
}

// Unloaded, alpha is what it was under pressure: rho_s/rho at no pressure is the alpha of Carroll and Holt's p = K (eta - 1/alpha).
TEST(PAlpha, CrushedFoamStaysCrushed) {
  for (const PAlpha& m : foams()) {
    for (const double share : {0.1, 0.5, 0.9}) {
      const double p = m.crush_pressure + share * (m.solid_pressure - m.crush_pressure), rho = density_at(m, p);
      const double compaction = m.compacted(rho, 0), alpha = 1 / (rho / m.solid_density - p / m.K);
      EXPECT_NEAR(m.branch(rho, compaction).p / p, 1, 1e-6);
      EXPECT_NEAR(m.branch(m.solid_density / alpha, compaction).p, 0, 1e-9 * p + 1e-13 * m.K);
      EXPECT_GT(m.solid_density / alpha, m.rho0);
      EXPECT_EQ(m.compacted(0.5 * rho, compaction), compaction); // it does not heal
      EXPECT_GT(m.compacted(1.01 * rho, compaction), compaction);
    }
    EXPECT_EQ(m.compacted(m.rho0 * (1 + 0.99 * m.crush_pressure / m.foam_modulus), 0), 0); // elastic till then
  }
}

// Random paths of density back to where they began: work - p dv in, never out.
TEST(PAlpha, NoPathGainsWork) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const PAlpha& m : foams()) {
    for (int path = 0; path < 50; ++path) {
      double compaction = 0, work = 0, scale = 0, rho = m.rho0;
      for (int leg = 0; leg < 8; ++leg) {
        const double to = leg == 7 ? m.rho0 : m.rho0 * 0.8 + unit(random) * (1.02 * m.solid_density - 0.8 * m.rho0);
        constexpr int steps = 2000;
        const double from = 1 / rho, change = (1 / to - from) / steps;
        for (int i = 0; i < steps; ++i) {
          const double before = m.branch(1 / (from + i * change), compaction).p, at = 1 / (from + (i + 1) * change);
          compaction = m.compacted(at, compaction);
          const double dw = -0.5 * (before + m.branch(at, compaction).p) * change;
          work += dw;
          scale += std::abs(dw);
        }
        rho = to;
      }
      EXPECT_GE(work, -1e-3 * scale) << describe(m); // the trapezia's own error, where a branch begins
    }
  }
}

TEST(PAlpha, RowIsAtRestAndRemembers) {
  const PAlpha m{.rho0 = 100, .p_rest = 101325};
  EXPECT_TRUE(barotropic(m));
  const GaugeReference ref{100, 0, pressure(m, 100, 0), 0};
  double rho[3] = {100 * (1 + 4e-16), 500, 99}, compaction[3] = {0, 0, 0}, p[3], k[3];
  evaluate_foam(m, ref, 3, rho, compaction, p, k);
  EXPECT_EQ(p[0], 0);
  EXPECT_EQ(compaction[0], 0);
  EXPECT_NEAR(p[1], m.pressure(500, 0) - 101325, 1e-6);
  EXPECT_EQ(compaction[1], 0.8);
  EXPECT_EQ(compaction[2], 0);
  const double squeezed = p[1];
  rho[1] = 499;
  evaluate_foam(m, ref, 3, rho, compaction, p, k);
  EXPECT_NEAR(p[1], squeezed - m.K * 1e-3, 1e-3);
  EXPECT_NEAR(k[1], m.K * 0.499, 1e-3);
  EXPECT_EQ(compaction[1], 0.8);
}

} // namespace
} // namespace ballast
