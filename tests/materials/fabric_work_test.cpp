// Tangents, wave speeds, energy and closed cycles of the fabric laws.
#include "materials/fabric_library.hpp"
#include "tests/materials/fabric_laws.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

using fabric_laws::Named, fabric_laws::elastic_laws, fabric_laws::paper;
using Eigen::Matrix3d;

FabricTensor green(const Matrix3d& F) {
  const Matrix3d E = 0.5 * (F.transpose() * F - Matrix3d::Identity());
  return {E(0, 0), E(1, 1), E(2, 2), E(0, 1), E(1, 2), E(0, 2)};
}

/// First Piola-Kirchhoff stress of a fresh element.
Matrix3d first_piola(const FabricModel& model, const Matrix3d& F) {
  FabricState state;
  const FabricTensor s = std::visit([&](const auto& law) { return evaluate(law, green(F), state).stress; }, model);
  Matrix3d S;
  S << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return F * S;
}

const FabricTensor states[] = {{0.004, 0.006, -0.01, 0.001, 0, -0.002}, {0.05, 0.02, -0.2, 0.03, -0.01, 0.02}, {0.12, 0.14, -0.36, 0.15, 0.13, 0.05},
                               {-0.1, 0.2, -0.42, -0.16, 0.02, -0.1},   {0.3, 0.1, 0.05, 0.19, 0, 0.01},       {-0.2, -0.1, -0.3, 0.01, 0.02, 0.03}};

TEST(FabricTangent, IsTheSlopeOfStress) {
  for (const Named& named : elastic_laws()) {
    for (const FabricTensor& E : states) {
      FabricState state;
      const FabricStress here = std::visit([&](const auto& law) { return evaluate(law, E, state); }, named.model);
      for (std::size_t k = 0; k < 6; ++k) {
        const double d = 1e-6;
        FabricTensor up = E, down = E;
        up[k] += d;
        down[k] -= d;
        FabricState fresh, also_fresh;
        const auto at = [&](const FabricTensor& strain, FabricState& s) {
          return std::visit([&](const auto& law) { return evaluate(law, strain, s).stress[k]; }, named.model);
        };
        const double slope = (at(up, fresh) - at(down, also_fresh)) / (2 * d) / (k < 3 ? 1 : 2);
        // Differences of order d^2 S''' and rounding eps S/d.
        EXPECT_NEAR(here.tangent[k], slope, 2e-7 * std::abs(slope) + 1e-9 * std::abs(here.stress[k]) / d + 1) << named.name << ' ' << k;
      }
    }
  }
}

TEST(FabricTangent, HasThePapersExtremes) { // materials: 1.353 at 0, 0.261 at 0.0128, 6.27 at 0.0570, 3.20 at rupture, GPa
  const auto slope = [](std::size_t k, double E) {
    FabricState state;
    FabricTensor strain = {};
    strain[k] = E;
    return evaluate(paper(), strain, state).tangent[k] / 1e9;
  };
  EXPECT_NEAR(slope(0, 0), 1.35322, 1e-12);
  EXPECT_NEAR(slope(0, 0.0128), 0.261, 5e-4);
  EXPECT_NEAR(slope(0, 0.0570), 6.27, 5e-3);
  EXPECT_NEAR(slope(0, 0.13292), 3.20, 5e-3);
  EXPECT_NEAR(slope(1, 0.0291), 7.13, 5e-3);
  EXPECT_NEAR(slope(1, 0.14996), 1.97, 5e-3);
  EXPECT_NEAR(slope(2, 0), 1.2577e-3, 1e-15);
}

TEST(FabricWaves, ModulusBoundsTheAcousticTensor) {
  for (const Named& named : elastic_laws()) {
    for (int sheared = 0; sheared < 2; ++sheared) {
      for (const FabricTensor& at : states) {
        Matrix3d F = Matrix3d::Identity();
        for (int k = 0; k < 3; ++k) {
          F(k, k) = std::sqrt(1 + 2 * at[static_cast<std::size_t>(k)]);
        }
        F(0, 1) = sheared * at[3], F(1, 2) = sheared * at[4], F(2, 0) = sheared * at[5];
        FabricState state;
        const FabricStress s = std::visit([&](const auto& law) { return evaluate(law, green(F), state); }, named.model);
        for (int n = 0; n < 3; ++n) {
          Matrix3d Q; // dP_iN/dF_jN
          for (int j = 0; j < 3; ++j) {
            const double d = 1e-7;
            Matrix3d up = F, down = F;
            up(j, n) += d;
            down(j, n) -= d;
            Q.col(j) = (first_piola(named.model, up) - first_piola(named.model, down)).col(n) / (2 * d);
          }
          const double most = Eigen::SelfAdjointEigenSolver<Matrix3d>(0.5 * (Q + Q.transpose())).eigenvalues()[2];
          const double bound = s.wave_modulus[static_cast<std::size_t>(n)], rounding = 1e-5 * std::abs(most) + 1e4;
          EXPECT_GT(bound, most - rounding) << named.name << ' ' << n;
          if (sheared == 0 && most > 0 && !named.solid) {
            EXPECT_NEAR(bound, most, rounding) << named.name << ' ' << n;
          }
        }
      }
    }
  }
}

TEST(FabricWaves, SpeedsAreThePapers) { // at rest, m/s: warp 1314, fill faster, transverse shear 7986, transverse 40
  FabricState state;
  RaftenbergFabric law = paper();
  law.density = 784;
  const FabricStress s = evaluate(law, {}, state);
  EXPECT_NEAR(std::sqrt(s.wave_modulus[2] / 784), 7986, 1);
  law.in_plane.modulus = law.through.modulus = 0;
  const FabricStress soft = evaluate(law, {}, state);
  EXPECT_NEAR(std::sqrt(soft.wave_modulus[0] / 784), 1314, 1);
  EXPECT_NEAR(std::sqrt(soft.wave_modulus[2] / 784), 40, 0.1);
}

TEST(FabricEnergy, OfAFamilyIsItsClosedForm) { // polynomial + log + arctan of N/q, long double
  const auto closed = [](const RationalFit& k, long double E) {
    const long double q2 = k.d / k.f, q1 = (k.c - q2 * k.e) / k.f, q0 = (k.b - q2 - q1 * k.e) / k.f;
    const long double r1 = k.a - q1 - q0 * k.e, r0 = -q0, root = std::sqrt(4.0L * k.f - static_cast<long double>(k.e) * k.e);
    const long double angle = std::atan((2 * k.f * E + k.e) / root) - std::atan(k.e / root);
    return q2 * E * E * E / 3 + q1 * E * E / 2 + q0 * E + r1 / (2 * k.f) * std::log(1 + k.e * E + k.f * E * E) + (r0 - r1 * k.e / (2 * k.f)) * 2 / root * angle;
  };
  for (const YarnFamily& y : {paper().warp, paper().fill}) {
    for (const double E : {0.01, 0.05, 0.1, y.rupture}) {
      EXPECT_NEAR(strain_energy(y, E) / static_cast<double>(closed(y.fit, E)), 1, 1e-12) << E;
    }
    EXPECT_EQ(strain_energy(y, -0.3), 0);
    EXPECT_EQ(strain_energy(y, 0.6), strain_energy(y, 0.8));
  }
  EXPECT_NEAR(strain_energy(paper().warp, 0.132930) / 1e6, 30.7, 0.05); // MJ/m3
  EXPECT_NEAR(strain_energy(paper().fill, 0.149961) / 1e6, 52.8, 0.05);
  EXPECT_NEAR((strain_energy(paper().warp, 0.6) - strain_energy(paper().warp, 0.132930)) / 1e6, 105.3, 0.05);
}

TEST(FabricEnergy, HasTheStressAsItsSlope) {
  for (const Named& named : elastic_laws()) {
    for (const FabricTensor& E : states) {
      FabricState state;
      const FabricTensor stress = std::visit([&](const auto& law) { return evaluate(law, E, state).stress; }, named.model);
      const auto energy = [&](const FabricTensor& strain) { return std::visit([&](const auto& law) { return strain_energy(law, strain); }, named.model); };
      for (std::size_t k = 0; k < 6; ++k) {
        const double d = 1e-5;
        FabricTensor up = E, down = E;
        up[k] += d;
        down[k] -= d;
        const double slope = (energy(up) - energy(down)) / (2 * d) / (k < 3 ? 1 : 2);
        // d^2/6 S'' of up to 1e13 Pa, and rounding of the energy over d.
        EXPECT_NEAR(stress[k], slope, 1e-6 * std::abs(slope) + 1e-14 * energy(E) / d + 1e3) << named.name << ' ' << k;
      }
    }
  }
}

/// Work of P on a closed smooth path of F in `steps` chords, stress at the middle of each.
double cycle_work(const FabricModel& model, int steps) {
  Matrix3d rest, one, two;
  rest << 1.05, 0.02, 0.01, -0.02, 1.06, 0.03, 0.02, 0.01, 0.60;
  one << 0.03, 0.05, -0.02, 0.04, -0.02, 0.03, 0.01, 0.05, 0.06;
  two << -0.02, 0.03, 0.04, -0.05, 0.035, 0.02, 0.03, -0.02, 0.10;
  const auto at = [&](int i) -> Matrix3d {
    const double angle = 2 * std::numbers::pi * i / steps;
    return rest + std::cos(angle) * one + std::sin(angle) * two + 0.3 * std::sin(2 * angle) * one;
  };
  double work = 0;
  for (int i = 0; i < steps; ++i) {
    work += first_piola(model, 0.5 * (at(i) + at(i + 1))).cwiseProduct(at(i + 1) - at(i)).sum();
  }
  return work;
}

TEST(FabricEnergy, WorkOfAClosedCycleFallsAtOrderTwo) {
  for (const Named& named : elastic_laws()) {
    const double coarse = cycle_work(named.model, 2048), fine = cycle_work(named.model, 4096), finest = cycle_work(named.model, 8192);
    if (named.kinked) { // each corner adds an error of order two whose constant jumps with where the steps fall
      EXPECT_LT(std::abs(finest), 0.25 * std::max(std::abs(coarse), std::abs(fine))) << named.name;
      EXPECT_LT(std::abs(finest), 1e3) << named.name << ": of 1e8 J/m3 that go in and out";
      continue;
    }
    EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 2, 0.02) << named.name << ' ' << coarse << ' ' << fine;
    EXPECT_NEAR(std::log2(std::abs(fine / finest)), 2, 0.02) << named.name << ' ' << fine << ' ' << finest;
  }
}

/// Loading over n steps a part, unloading over other steps: 0 to rupture to the middle of the ramp and back, trapezoids.
double ramp_cycle_work(const YarnFamily& y, std::size_t k, const RaftenbergFabric& law, int n) {
  FabricState state;
  double work = 0, strain_before = 0, stress_before = 0;
  const auto go = [&](double to, int steps) {
    const double from = strain_before;
    for (int i = 1; i <= steps; ++i) {
      FabricTensor E = {};
      E[k] = from + (to - from) * i / steps;
      const double s = evaluate(law, E, state).stress[k];
      work += 0.5 * (s + stress_before) * (E[k] - strain_before);
      strain_before = E[k], stress_before = s;
    }
  };
  go(y.rupture, n);
  go(y.rupture + 0.5 * y.unload, n);
  go(y.rupture, 3 * n);
  go(0, 2 * n);
  return work;
}

TEST(FabricEnergy, WorkOfACycleOverTheRampFallsAtOrderTwo) {
  const RaftenbergFabric law = paper();
  for (std::size_t k = 0; k < 2; ++k) {
    const YarnFamily& y = k == 0 ? law.warp : law.fill;
    const double coarse = ramp_cycle_work(y, k, law, 100), fine = ramp_cycle_work(y, k, law, 200), finest = ramp_cycle_work(y, k, law, 400);
    EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 2, 0.05) << coarse << ' ' << fine;
    EXPECT_NEAR(std::log2(std::abs(fine / finest)), 2, 0.05) << fine << ' ' << finest;
  }
}

} // namespace
} // namespace ballast
