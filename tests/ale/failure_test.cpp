// What has failed or molten, in cells.
#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "ale/strength_update.hpp"
#include "materials/library.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <utility>

namespace ballast {
namespace {

/// Three cells of a material in a row, stretched by `stretch` of their density, and void to open.
struct Row {
  Block<2> b;
  ThreadPool pool{1};
  int r = 0;

  Row(const char* name, double stretch) {
    const Material m = *find_material(name);
    b.materials.push_back(make_slot(m, 0));
    b.materials.push_back(make_void());
    allocate_block(b, {std::vector<double>{0, 1e-3, 2e-3, 3e-3}, std::vector<double>{0, 1e-3}, {}});
    for (int i = 0; i < 3; ++i) {
      const CellPart part{0, 1, m.density * (1 - stretch), m.specific_energy};
      fill_cell<2>(b, i, 0, 0, std::span<const CellPart>(&part, 1));
    }
    r = b.grid.cell_row(0, 0);
    pull_back_to_yield(b, pool);
    update_state(b, pool);
  }
  MaterialSlot& slot() { return b.materials[0]; }
  double& at(int field, int i) { return slot().store.row(field, r)[i]; }
  double pressure(int i) const { return b.pressure.row(r)[i]; }

  /// One return to yield under the shear strain `shear` in a step of `dt`.
  void shear_by(double shear, double dt) {
    double gradient[5][3] = {};
    StressRows<2> rows = stress_rows<2>(slot(), 0, r, 0);
    for (int i = 0; i < 3; ++i) {
      gradient[1][i] = shear;
    }
    for (int q = 0; q < 5; ++q) {
      rows.gradient[q] = gradient[q];
    }
    EXPECT_EQ(update_stress<2>(slot().material, dt, 3, rows), 0);
  }
};

TEST(Failure, DamageIsPlasticStrainOverStrainToFailure) {
  Row a("steel_4340", 0);
  a.shear_by(0.02, 1e-6);
  const double ep = a.at(field::plastic_strain<2>, 1), q = a.at(a.slot().flow_stress_field(), 1);
  const double p = a.pressure(1), rate = ep / 1e-6;
  EXPECT_GT(ep, 0.005);
  EXPECT_NEAR(a.at(field::damage<2>, 1), ep / failure_strain(*a.slot().material.failure, {-p / q, rate, 0}), 1e-12);
}

TEST(Failure, BrokenMaterialCarriesNoDeviator) {
  Row a("steel_4340", 0);
  a.at(field::damage<2>, 1) = 0.9999; // the next plastic strain breaks it
  const double yield = a.at(a.slot().flow_stress_field(), 0);
  a.shear_by(0.02, 1e-6);
  EXPECT_GE(a.at(field::damage<2>, 1), 1);
  EXPECT_EQ(a.at(field::stress + 2, 1), 0);
  EXPECT_GE(a.at(field::stress + 2, 0), yield / std::sqrt(3.0)); // its neighbour holds
  const double strain = a.at(field::plastic_strain<2>, 1);
  a.shear_by(0.02, 1e-6);
  EXPECT_EQ(a.at(field::stress + 2, 1), 0);
  EXPECT_EQ(a.at(a.slot().flow_stress_field(), 1), 0);
  EXPECT_NEAR(a.at(field::plastic_strain<2>, 1) - strain, 0.02 / std::sqrt(3.0), 1e-12); // all of it is plastic now
  for (int step = 0; step < 400; ++step) {
    a.shear_by(0.02, 1e-6);
  }
  EXPECT_EQ(a.at(field::damage<2>, 1), 2);
  a.at(field::stress + 2, 1) = 1e8; // as a remap would bring it in
  pull_back_to_yield(a.b, a.pool);
  EXPECT_EQ(a.at(field::stress + 2, 1), 0);
}

TEST(Failure, BrokenMaterialCarriesNoTension) {
  Row a("steel_4340", 2e-3); // 0.33 GPa of tension, less than spall
  ASSERT_LT(a.pressure(1), -3e8);
  EXPECT_EQ(open_voids(a.b, a.pool), 0);
  a.at(field::damage<2>, 1) = 1;
  EXPECT_EQ(open_voids(a.b, a.pool), 1);
  EXPECT_EQ(a.pressure(1), 0);
  EXPECT_LT(a.pressure(0), -3e8);
  EXPECT_NEAR(std::as_const(a.b.materials[1].store).row(field::fraction, a.r)[1], 2e-3, 1e-4);
  EXPECT_EQ(close_voids(a.b, a.pool), 0); // and the crack stays open
}

TEST(Failure, IsAFieldOnlyOfMaterialsThatHaveIt) {
  Row copper("copper_ofhc", 0), steel("steel_4340", 0);
  EXPECT_EQ(steel.slot().store.conserved(), copper.slot().store.conserved() + 1);
  EXPECT_FALSE(copper.slot().damages);
}

TEST(SteinbergGuinan, CellsStiffenUnderPressureAndMelt) {
  Row rest("lead_steinberg", 0), squeezed("lead_steinberg", -0.1);
  const double g0 = 8.6e9;
  EXPECT_NEAR(shear_of(rest.slot(), rest.r, 1), g0 * (1 + 1.16e-3 * 7), 1e-3 * g0); // at 1 atm and 293 K
  EXPECT_GT(shear_of(squeezed.slot(), squeezed.r, 1), 1.2 * g0);
  EXPECT_GT(squeezed.b.wave_speed.row(squeezed.r)[1], rest.b.wave_speed.row(rest.r)[1]);
  rest.shear_by(0.01, 1e-6);
  EXPECT_GT(rest.at(field::stress + 2, 1), 4e6);
  const double strain = rest.at(field::plastic_strain<2>, 1);
  rest.at(field::energy, 1) += 124 * 500.0; // 793 K
  update_state(rest.b, rest.pool);
  rest.shear_by(0.01, 1e-6);
  EXPECT_EQ(rest.at(field::stress + 2, 1), 0);
  EXPECT_GT(shear_of(rest.slot(), rest.r, 1), 0); // compliances stay finite
  EXPECT_EQ(rest.at(field::plastic_strain<2>, 1), strain);
  EXPECT_GT(rest.at(field::stress + 2, 0), 4e6);
}

} // namespace
} // namespace ballast
