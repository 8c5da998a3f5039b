// Laws of the flow stress and the radial return.
#include "materials/library.hpp"
#include "materials/strength.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

TEST(RadialReturn, LinearHardeningStaysOnYieldSurface) {
  const LinearHardening m{43e9, 0.4e9, 0.1e9};
  for (const double trial : {0.44e9, 1e9, 30e9}) {
    const FlowState s{0.3, 0, 1e-8};
    const PlasticIncrement d = plastic_increment(m, s, trial);
    EXPECT_NEAR(trial - 3 * m.shear_modulus * d.value, flow_stress(m, s, d.value), 1e-6 * trial);
  }
  EXPECT_EQ(plastic_increment(m, {0, 0, 1e-8}, 0.39e9).value, 0);
}

TEST(RadialReturn, JohnsonCookStaysOnYieldSurface) {
  const JohnsonCook m{46e9, 90e6, 292e6, 0.31, 0.025, 1.09, 1, 293, 1356, 383};
  for (const double trial : {1 + 1e-13, 1 + 1e-9, 1.0001, 1.5, 10.0, 1000.0}) {
    for (const double strain : {0.0, 1e-9, 0.1, 3.0}) {
      for (const double heat : {0.0, 1e5, 4e5, 383 * (1356 - 293.0) * (1 - 1e-12), 1e6}) { // the last is molten
        const FlowState s{strain, heat, 1e-8};
        const double q = trial * (flow_stress(m, s, 0) + (trial > 1.00001 ? 1e3 : 1e-6));
        const PlasticIncrement d = plastic_increment(m, s, q);
        EXPECT_TRUE(d.converged);
        EXPECT_NEAR(q - 3 * m.shear_modulus * d.value, flow_stress(m, s, d.value), 1e-9 * q);
      }
    }
  }
}

TEST(RadialReturn, ConvergesWhereTheRateFactorSetsIn) {
  const JohnsonCook m = std::get<JohnsonCook>(find_material("lead_antimony")->strength); // reference rate 5e-4 /s
  const struct {
    double above;
    FlowState state;
  } cases[] = {{1e-3, {1.9463392731394847e-19, 17059.746855537454, 3.7466617672463766e-08}},
               {1e-5, {6.5065575569145745e-05, 25118.572100456124, 6.9288717122589608e-08}},
               {1e-7, {0, 37470.558728723918, 1.5992115828551395e-09}},
               {1e-9, {2.7347257550285058e-19, 46796.556354459164, 5.4282299852589915e-08}}};
  for (const auto& c : cases) {
    for (const double above : {c.above, 1e-2, 1e-4, 1e-6, 1e-8}) {
      const double q = flow_stress(m, c.state, 0) * (1 + above);
      const PlasticIncrement d = plastic_increment(m, c.state, q);
      EXPECT_TRUE(d.converged) << above;
      EXPECT_NEAR(q - 3 * m.shear_modulus * d.value, flow_stress(m, c.state, d.value), 1e-9 * q);
    }
  }
}

TEST(JohnsonCook, SoftensToNothingAtTheMeltingPoint) {
  const JohnsonCook m{46e9, 90e6, 292e6, 0.31, 0.025, 1.09, 1, 293, 1356, 383};
  EXPECT_GT(flow_stress(m, {0.1, 0, 0}, 0), flow_stress(m, {0.1, 2e5, 0}, 0));
  EXPECT_EQ(flow_stress(m, {0.1, 383 * (1356 - 293.0), 0}, 0), 0);
}

TEST(JohnsonCook, WarmAtTheStartIsAsSoftAsHeatedThere) {
  const JohnsonCook cold{46e9, 90e6, 292e6, 0.31, 0.025, 1.09, 1, 293, 1356, 383};
  JohnsonCook warm = cold, molten = cold;
  warm.start_temperature = 800;
  molten.start_temperature = 1400;
  EXPECT_NEAR(flow_stress(warm, {0.1, 1e4, 0}, 0), flow_stress(cold, {0.1, 383 * (800 - 293.0) + 1e4, 0}, 0), 1e-6);
  EXPECT_EQ(flow_stress(molten, {0.1, 0, 0}, 0), 0);
}

} // namespace
} // namespace ballast
