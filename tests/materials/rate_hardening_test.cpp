// Laws of the flow stresses of clay and bone (materials/rate_hardening).
#include "materials/strength.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

PowerLawPlastic clay(CowperSymonds rate = {}) {
  return {.shear_modulus = 4.765e6, .coefficient = 0.24e6, .first_strain = 0.016, .exponent = 0.014, .rate = rate};
}
TabulatedHardening bone(CowperSymonds rate = {}) {
  return {.shear_modulus = 5.654e9, .points = 3, .strain = {0, 0.0152, 0.1}, .stress = {101.4e6, 139.3e6, 351e6}, .rate = rate};
}

TEST(CowperSymonds, DoublesTheFlowStressAtItsConstant) {
  const CowperSymonds rate{2500, 7};
  EXPECT_EQ(rate.factor(0), 1);
  EXPECT_DOUBLE_EQ(rate.factor(2500), 2);
  EXPECT_DOUBLE_EQ(rate.factor(2500 * std::pow(0.5, 7)), 1.5);
  EXPECT_DOUBLE_EQ(rate.factor(2500 * std::pow(2.0, 7)), 3);
  EXPECT_EQ(CowperSymonds{}.factor(1e9), 1);
}

TEST(TabulatedHardening, GoesThroughItsPointsAndStaysAtTheLast) {
  const TabulatedHardening m = bone();
  EXPECT_EQ(hardened(m, 0), 101.4e6);
  EXPECT_EQ(hardened(m, 0.0152), 139.3e6);
  EXPECT_NEAR(hardened(m, 0.0076), 0.5 * (101.4e6 + 139.3e6), 1);
  EXPECT_NEAR(hardened(m, 0.0576), 0.5 * (139.3e6 + 351e6), 1);
  EXPECT_EQ(hardened(m, 0.1), 351e6);
  EXPECT_EQ(hardened(m, 5), 351e6);
}

TEST(PowerLawPlastic, MeetsHookesLineAtItsFirstStrain) {
  const double E = 14.2e6, K = 0.24e6, n = 0.014;
  PowerLawPlastic m = clay();
  m.first_strain = std::pow(E / K, 1 / (n - 1));
  EXPECT_NEAR(hardened(m, 0) / (E * m.first_strain), 1, 1e-12);
}

/// Radial return: q - 3 G d = sigma_y(ep + d, d/dt), from just above yield to far above, at any rate.
template <class Model> void stays_on_its_surface(const Model& m) {
  for (const double strain : {0.0, 1e-9, 0.01, 0.0999, 3.0}) {
    for (const double dt : {1e-10, 1e-8, 1e-5}) {
      for (const double above : {1e-13, 1e-10, 1e-7, 1e-4, 1e-2, 1.0, 100.0}) {
        const FlowState s{strain, 0, dt};
        const double q = flow_stress(m, s, 0) * (1 + above);
        const PlasticIncrement d = plastic_increment(m, s, q);
        EXPECT_TRUE(d.converged) << above << " " << dt;
        EXPECT_GE(d.value, 0);
        EXPECT_NEAR(q - 3 * m.shear_modulus * d.value, flow_stress(m, s, d.value), 1e-9 * q) << above << " " << dt << " " << strain;
      }
      EXPECT_EQ(plastic_increment(m, {strain, 0, dt}, 0.999 * flow_stress(m, {strain, 0, dt}, 0)).value, 0);
    }
  }
}

TEST(RadialReturn, PowerLawStaysOnYieldSurface) {
  stays_on_its_surface(clay());
  stays_on_its_surface(clay({10, 5}));
  stays_on_its_surface(clay({1e-3, 40}));
}

TEST(RadialReturn, TableStaysOnYieldSurface) {
  stays_on_its_surface(bone());
  stays_on_its_surface(bone({2500, 7}));
  stays_on_its_surface(bone({2500, 1}));
}

/// Uniaxial strain at a constant rate: equivalent stress q = 2 G (strain - 3/2 ep) in the axial strain, plastic rate 2/3 of it
/// once the material flows without hardening. Returns q; adds the plastic work to `work` and checks that none is negative.
template <class Model> double press(const Model& m, double strain, double rate, int steps, double& plastic_strain, double& work) {
  const double dt = strain / rate / steps;
  double q = 0;
  plastic_strain = work = 0;
  for (int i = 0; i < steps; ++i) {
    const FlowState s{plastic_strain, 0, dt};
    const double trial = q + 2 * m.shear_modulus * strain / steps; // q = 3/2 s_xx, ds_xx = 2 G 2/3 d strain
    const PlasticIncrement d = plastic_increment(m, s, trial);
    EXPECT_GE(d.value, 0);
    q = trial - 3 * m.shear_modulus * d.value;
    work += q * d.value;
    plastic_strain += d.value;
  }
  return q;
}

// In flow q = h(ep) (1 + (2/3 rate/C)^(1/p)), but for the small part of the strain that hardening still takes elastically.
TEST(RadialReturn, UniaxialStrainFollowsTheHardeningAndItsRate) {
  for (const double rate : {1.0, 100.0, 1e4}) {
    const TabulatedHardening m = bone({2500, 7});
    double ep = 0, work = 0;
    const double q = press(m, 0.3, rate, 3000, ep, work); // past the table's end: no hardening
    EXPECT_NEAR(q / (351e6 * (1 + std::pow(2.0 / 3 * rate / 2500, 1.0 / 7))), 1, 1e-7) << rate; // what hardening left fades by 2 % a step at 1e4 /s
    EXPECT_NEAR(q, 2 * m.shear_modulus * (0.3 - 1.5 * ep), 1e-8 * m.shear_modulus); // Hooke
    EXPECT_GT(work, 0);
  }
  const PowerLawPlastic m = clay();
  double ep = 0, work = 0;
  const double strain = 0.5, q = press(m, strain, 100, 5000, ep, work);
  EXPECT_NEAR(q / (0.24e6 * std::pow(0.016 + ep, 0.014)), 1, 1e-9);
  EXPECT_NEAR(q, 2 * m.shear_modulus * (strain - 1.5 * ep), 1e-8 * m.shear_modulus);
  // Work of the curve: K [(eps0 + ep)^(n + 1) - eps0^(n + 1)]/(n + 1); the step's end counts for the step, 1/5000 of the hardening.
  EXPECT_NEAR(work / (0.24e6 / 1.014 * (std::pow(0.016 + ep, 1.014) - std::pow(0.016, 1.014))), 1, 1e-4);
}

TEST(RadialReturn, UniaxialStrainDoesNotDependOnTheStep) {
  double coarse_ep = 0, fine_ep = 0, work = 0;
  const double coarse = press(bone({2500, 7}), 0.05, 1000, 100, coarse_ep, work), fine = press(bone({2500, 7}), 0.05, 1000, 10000, fine_ep, work);
  EXPECT_NEAR(coarse / fine, 1, 1e-3);
  EXPECT_NEAR(coarse_ep / fine_ep, 1, 1e-3);
}

TEST(FlowStress, RateMattersOnlyWhereItIsGiven) {
  EXPECT_TRUE(has_rate(bone({2500, 7})));
  EXPECT_FALSE(has_rate(bone()));
  EXPECT_EQ(flow_stress(bone(), {0, 0, 1e-8}, 0.1), 351e6);
  EXPECT_NEAR(flow_stress(bone({2500, 7}), {0, 0, 4e-5}, 0.1), 702e6, 1); // 0.1 in 40 us are 2500 /s
}

} // namespace
} // namespace ballast
