// Laws of the mixed-cell closure: shares add up, energy closes, void takes what is left.
#include "ale/closure.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

MixedCell two_materials() {
  MixedCell c;
  c.count = 2;
  c.part[0] = {0, false, 0.3, 300, 1e5, 2e8, 1e11};
  c.part[1] = {1, false, 0.7, 70, 2e5, 1e6, 2e9};
  return c;
}

CellMotion motion_of(const MixedCell& c, double change, Closure closure = Closure::pressure_relaxation) {
  const CellPressure p = mixed_pressure(closure, c, 0);
  return {1.0, change, change, 0.5 * change, p.pressure, p.modulus, 1e-7};
}

class EveryClosure : public ::testing::TestWithParam<Closure> {};

TEST_P(EveryClosure, SharesSumToTheCellsChangeAndWork) {
  for (const double change : {-0.01, 0.0, 0.02}) {
    MixedCell c = two_materials();
    const CellMotion m = motion_of(c, change, GetParam());
    share_volume_change(GetParam(), m, c);
    const double dv = c.part[0].volume_change + c.part[1].volume_change;
    const double work = c.part[0].work + c.part[1].work;
    const double want = -(m.pressure - m.modulus * m.compression) * m.swept_volume;
    EXPECT_NEAR(dv, change, 1e-15);
    EXPECT_NEAR(work, want, 1e-13 * (std::abs(want) + 1e6));
    for (int k = 0; k < 2; ++k) {
      EXPECT_GT(c.part[k].volume + c.part[k].volume_change, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryClosure,
                         ::testing::Values(Closure::pressure_relaxation, Closure::tipton, Closure::equal_strain));

TEST(Closure, RelaxationBringsPressuresTogether) {
  MixedCell c = two_materials();
  share_volume_change(Closure::pressure_relaxation, motion_of(c, 0), c);
  EXPECT_GT(c.part[0].volume_change, 0); // the one at higher pressure expands
  EXPECT_NEAR(c.part[0].pressure - c.part[0].modulus * c.part[0].volume_change / c.part[0].volume,
              c.part[1].pressure - c.part[1].modulus * c.part[1].volume_change / c.part[1].volume,
              1e-2 * c.part[0].pressure);
}

// K differs by 1e6: by compliance alone the gas would give more volume than it has.
TEST_P(EveryClosure, GasBesideMetalKeepsAVolume) {
  MixedCell c;
  c.count = 2;
  c.part[0] = {0, false, 0.99, 8840, 0, 0, 1.3e11};
  c.part[1] = {1, false, 0.01, 0.012, 2e5, 0, 1.4e5};
  const CellMotion m = motion_of(c, -0.02, GetParam());
  share_volume_change(GetParam(), m, c);
  EXPECT_GT(c.part[1].volume + c.part[1].volume_change, 0);
  EXPECT_NEAR(c.part[0].volume_change + c.part[1].volume_change, -0.02, 1e-15);
  const double want = -(m.pressure - m.modulus * m.compression) * m.swept_volume;
  EXPECT_NEAR(c.part[0].work + c.part[1].work, want, 1e-12 * std::abs(want));
}

// What the reference pressure does on the swept volume beyond the change of volume (slack): a capped trace of gas that kept its
// share would pay for the whole cell's and come to energies below nothing.
TEST(Closure, CappedGasHandsItsSlackOver) {
  MixedCell c;
  c.count = 2;
  c.part[0] = {0, false, 1 - 1e-6, 1000, 0, 0, 2.2e9};
  c.part[1] = {1, false, 1e-6, 1e-12, 2e5, -1e5, 1};
  CellMotion m = motion_of(c, -1e-3);
  m.swept_volume *= 1.01;
  share_volume_change(Closure::pressure_relaxation, m, c);
  EXPECT_EQ(c.part[1].slack, 0);
  EXPECT_NEAR(c.part[0].slack, m.swept_volume - m.volume_change, 1e-15);
}

// A gas at no pressure has no stiffness: it takes what room changes, and pushes nothing.
TEST_P(EveryClosure, ColdGasBesideMetalIsLikeRoom) {
  MixedCell c;
  c.count = 2;
  c.part[0] = {0, false, 0.6, 5300, 1e3, 1e6, 1.3e11};
  c.part[1] = {1, false, 0.4, 0.48, 0, 0, 0};
  stiffen_cold(c, 0);
  const CellMotion m = motion_of(c, -0.01, GetParam());
  EXPECT_TRUE(std::isfinite(m.pressure) && std::isfinite(m.modulus));
  share_volume_change(GetParam(), m, c);
  EXPECT_NEAR(c.part[0].volume_change + c.part[1].volume_change, -0.01, 1e-15);
  EXPECT_TRUE(std::isfinite(c.part[0].work) && std::isfinite(c.part[1].work));
  EXPECT_GT(c.part[1].volume + c.part[1].volume_change, 0);
}

// A trace of tissue (K' = 7) that the remap leaves beside metal at 8 GPa goes there within a few steps and never beyond.
TEST(Closure, TraceThatStiffensDoesNotOvershoot) {
  constexpr double K = 2.6e9, stiffening = 7, start = 2.4e-6;
  const auto pressure = [&](double volume) { return K / stiffening * (std::pow(start / volume, stiffening) - 1); };
  double volume = start;
  const auto cell = [&] {
    MixedCell c;
    c.count = 2;
    c.part[0] = {0, false, volume, 1100 * start, 0, pressure(volume), K + stiffening * pressure(volume)};
    c.part[1] = {1, false, 1 - volume, 9000, 0, 8e9, 1.8e11};
    return c;
  };
  for (int step = 0; step < 5; ++step) {
    MixedCell c = cell();
    share_volume_change(Closure::pressure_relaxation, motion_of(c, 0), c);
    EXPECT_NEAR(c.part[0].volume_change + c.part[1].volume_change, 0, 1e-16);
    volume += c.part[0].volume_change;
    EXPECT_LT(pressure(volume), 1.3 * 8e9);
  }
  EXPECT_NEAR(pressure(volume), 8e9, 0.01 * 8e9);
}

// Beside metal at 8 GPa a gas yields first: the tissue in the cell does not pay for what the gas gives up more slowly.
TEST(Closure, GasThatStiffensDoesNotPressOthers) {
  MixedCell c;
  c.count = 3;
  c.part[0] = {0, false, 0.5, 4500, 0, 8e9, 1.5e11};
  c.part[1] = {1, false, 0.4, 420, 0, 0, 2.6e9};
  c.part[2] = {2, false, 0.1, 0.12, 2e5, 0, 1.4e5};
  const CellMotion m = motion_of(c, 0);
  share_volume_change(Closure::pressure_relaxation, m, c);
  double volume = 0, work = 0;
  for (int k = 0; k < 3; ++k) {
    volume += c.part[k].volume_change;
    work += c.part[k].work;
  }
  EXPECT_NEAR(volume, 0, 1e-16);
  EXPECT_NEAR(work, 0, 1e-6);
  EXPECT_LT(-c.part[1].modulus * c.part[1].volume_change / c.part[1].volume, 1e5);
  EXPECT_LT(c.part[2].volume_change, -0.01);
}

// Stretched beyond what it can bear, it softens: it closes up, and the cell is still what the metal makes it.
TEST(Closure, StretchedTraceDoesNotSwallowTheCell) {
  for (const double modulus : {-7.7e8, 0.0, 1e5, 2.4e9}) {
    MixedCell c;
    c.count = 2;
    c.part[0] = {0, false, 1e-6, 1e-10, 0, -2.58e9, modulus};
    c.part[1] = {1, false, 1 - 1e-6, 9000, 0, 1e9, 1.3e11};
    stiffen_cold(c, 0);
    const CellMotion m = motion_of(c, 0);
    EXPECT_NEAR(m.pressure, 1e9, 1e-3 * 1e9);
    EXPECT_NEAR(m.modulus, 1.3e11, 1e-3 * 1.3e11);
    share_volume_change(Closure::pressure_relaxation, m, c);
    EXPECT_LT(c.part[0].volume_change, 0);
    EXPECT_GT(c.part[0].volume + c.part[0].volume_change, 0);
  }
}

TEST(Closure, VoidAbsorbsCompressionFirst) {
  MixedCell c;
  c.count = 2;
  c.part[0] = {0, false, 0.9, 900, 0, 0, 2e9};
  c.part[1] = {1, true, 0.1};
  share_volume_change(Closure::pressure_relaxation, {1.0, -0.05, -0.05, -0.025, 0, 0, 1e-7}, c);
  EXPECT_EQ(c.part[0].volume_change, 0);
  EXPECT_NEAR(c.part[1].volume_change, -0.05, 1e-16);
}

TEST(Closure, TensionBesideVoidOpensIt) {
  MixedCell c;
  c.count = 2;
  c.part[0] = {0, false, 0.9, 900, 0, -2e7, 2e9};
  c.part[1] = {1, true, 0.1};
  share_volume_change(Closure::pressure_relaxation, {1.0, 0.01, 0.01, 0.005, 0, 0, 1e-7}, c);
  EXPECT_NEAR(c.part[0].volume_change, -0.9 * 0.01, 1e-15); // back to zero pressure
  EXPECT_NEAR(c.part[1].volume_change, 0.019, 1e-15);
  EXPECT_EQ(c.part[0].work, 0);
}

} // namespace
} // namespace ballast
