// Laws of the return to the yield surface, row by row.
#include "ale/strength_update.hpp"
#include "materials/library.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

// A molten metal carries nothing: a flow stress of -1e-7 Pa, round-off of the return, made the cut of tractions divide by zero.
TEST(StrengthUpdate, MoltenMetalReturnsToZeroNotBelow) {
  const Material m = *find_material("gilding_metal");
  for (int k = 1; k < 400; ++k) {
    double stress[3] = {1e6 * k, -3.1e5 * k, 7e5 * k}, strain = 1, flow = 0, energy = m.specific_energy + 5e5;
    double gradient[5] = {1e-5 * k, 2e-4, -3e-4, -5e-6 * k, -5e-6 * k}; // times the step
    StressRows<2> rows{};
    for (int a = 0; a < 3; ++a) {
      rows.stress[a] = &stress[a];
    }
    for (int q = 0; q < 5; ++q) {
      rows.gradient[q] = &gradient[q];
    }
    rows.plastic_strain = &strain;
    rows.flow_stress = &flow;
    rows.energy = &energy;
    EXPECT_EQ(update_stress<2>(m, 1e-8, 1, rows), 0);
    EXPECT_GE(flow, 0) << k;
    EXPECT_LT(flow, 1) << k;
  }
}

} // namespace
} // namespace ballast
