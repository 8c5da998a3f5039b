// Laws of the half-space in the unit cube.
#include "remap/plane.hpp"

#include <gtest/gtest.h>
#include <random>

namespace ballast::remap {
namespace {

// Random directions of every kind: components over many decades, of either sign, some zero.
template <int Dim> class Planes {
public:
  Normal<Dim> normal() {
    Normal<Dim> n;
    for (int d = 0; d < Dim; ++d) {
      const double decade = unit_(random_) < 0.5 ? 0.0 : -18.0 * unit_(random_);
      n[d] = (unit_(random_) < 0.1 ? 0.0 : (2.0 * unit_(random_) - 1.0) * std::pow(10.0, decade));
    }
    n[static_cast<unsigned>(random_()) % Dim] = unit_(random_) + 0.1;
    return n;
  }
  double fraction() { return unit_(random_); }

private:
  std::mt19937 random_{12345};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

template <int Dim> double worst_round_trip() {
  Planes<Dim> planes;
  double worst = 0.0;
  for (int k = 0; k < 200000; ++k) {
    const Normal<Dim> n = planes.normal();
    const double fraction = planes.fraction();
    const double back = volume_below<Dim>(n, plane_constant<Dim>(n, fraction));
    worst = std::max(worst, std::abs(back - fraction));
  }
  return worst;
}

TEST(Plane, InverseRestoresFraction) {
  // alpha is rounded to 1 ulp of |n|_1; dV/dalpha |n|_1 <= 3, so a few eps remain.
  EXPECT_LT(worst_round_trip<2>(), 4e-15);
  EXPECT_LT(worst_round_trip<3>(), 4e-15);
}

TEST(Plane, InverseRestoresTinyFractions) {
  for (double fraction = 1e-15; fraction < 0.1; fraction *= 3.0) {
    // With all of n positive alpha starts at 0, so the fraction keeps its relative accuracy.
    const Normal<3> n = {0.3, 1.0, 0.7};
    EXPECT_NEAR(volume_below<3>(n, plane_constant<3>(n, fraction)) / fraction, 1.0, 1e-13);
    const Normal<2> line = {0.3, 1.0};
    EXPECT_NEAR(volume_below<2>(line, plane_constant<2>(line, fraction)) / fraction, 1.0, 1e-13);
  }
}

TEST(Plane, EmptyAndFullAreExact) {
  Planes<3> planes;
  for (int k = 0; k < 1000; ++k) {
    const Normal<3> n = planes.normal();
    EXPECT_EQ(volume_below<3>(n, plane_constant<3>(n, 0.0)), 0.0);
    EXPECT_EQ(volume_below<3>(n, plane_constant<3>(n, 1.0)), 1.0);
  }
  EXPECT_EQ(volume_below<3>({0.0, 0.0, 0.0}, 1.0), 1.0);
  EXPECT_EQ(volume_below<3>({0.0, 0.0, 0.0}, -1.0), 0.0);
}

TEST(Plane, VolumeMatchesKnownBodies) {
  EXPECT_NEAR((volume_below<2>({1.0, 1.0}, 1.0)), 0.5, 1e-16);
  EXPECT_NEAR((volume_below<2>({2.0, 1.0}, 1.0)), 0.25, 1e-16);
  EXPECT_NEAR((volume_below<2>({-1.0, 0.0}, -0.25)), 0.75, 1e-16);
  EXPECT_NEAR((volume_below<3>({1.0, 1.0, 1.0}, 1.0)), 1.0 / 6.0, 1e-16);
  EXPECT_NEAR((volume_below<3>({1.0, 1.0, 1.0}, 1.5)), 0.5, 1e-15);
  EXPECT_NEAR((volume_below<3>({1.0, 1.0, 1.0}, 2.0)), 5.0 / 6.0, 1e-15);
  EXPECT_NEAR((volume_below<3>({0.0, 0.0, -2.0}, -0.5)), 0.75, 1e-16);
}

TEST(Plane, VolumeMatchesExtendedPrecisionFormula) {
  // The textbook sum in long double loses ~1e-19 / (m1 m2 m3), so only moderate normals are used.
  Planes<3> planes;
  for (int k = 0; k < 20000; ++k) {
    const std::array<long double, 3> m = {
        planes.fraction() + 0.02L, planes.fraction() + 0.02L, planes.fraction() + 0.02L};
    const long double alpha = planes.fraction() * (m[0] + m[1] + m[2]);
    const auto cube = [](long double t) { return t > 0.0L ? t * t * t : 0.0L; };
    long double sum = cube(alpha);
    for (int d = 0; d < 3; ++d)
      sum += cube(alpha - m[d] - m[(d + 1) % 3]) - cube(alpha - m[d]);
    sum -= cube(alpha - m[0] - m[1] - m[2]);
    const Normal<3> n = {double(m[0]), double(m[1]), double(m[2])};
    const double exact = double(sum / (6.0L * m[0] * m[1] * m[2]));
    EXPECT_NEAR(volume_below<3>(n, double(alpha)), exact, 1e-14);
  }
}

TEST(Plane, VolumeRisesWithOffset) {
  Planes<3> planes;
  for (int k = 0; k < 300; ++k) {
    const Normal<3> n = planes.normal();
    const PlaneRange range = plane_range<3>(n);
    double last = 0.0;
    for (int step = 0; step <= 200; ++step) {
      const double v = volume_below<3>(n, range.low + step * (range.high - range.low) / 200.0);
      EXPECT_GE(v, last - 1e-15);
      last = v;
    }
    EXPECT_NEAR(last, 1.0, 1e-15);
  }
}

template <int Dim> double worst_slab_sum() {
  Planes<Dim> planes;
  double worst = 0.0;
  for (int k = 0; k < 50000; ++k) {
    const Normal<Dim> n = planes.normal();
    const double alpha = plane_constant<Dim>(n, planes.fraction());
    const int axis = k % Dim;
    const auto [low, high] = std::minmax({planes.fraction(), planes.fraction()});
    const double sum = slab_volume<Dim>(n, alpha, axis, 0.0, low) +
                       slab_volume<Dim>(n, alpha, axis, low, high) +
                       slab_volume<Dim>(n, alpha, axis, high, 1.0);
    worst = std::max(worst, std::abs(sum - volume_below<Dim>(n, alpha)));
  }
  return worst;
}

TEST(Plane, SlabsSumToVolume) {
  EXPECT_LT(worst_slab_sum<2>(), 4e-15); // three slabs, a few eps each
  EXPECT_LT(worst_slab_sum<3>(), 4e-15);
}

TEST(Plane, EmptySlabHoldsNothing) {
  const Normal<3> n = {1.0, 2.0, 3.0};
  EXPECT_EQ(slab_volume<3>(n, 2.0, 1, 0.4, 0.4), 0.0);
  EXPECT_EQ(slab_volume<3>(n, 2.0, 1, 0.6, 0.4), 0.0);
  EXPECT_EQ(slab_volume<3>(n, 2.0, 2, -1.0, 2.0), volume_below<3>(n, 2.0));
}

TEST(Plane, AxesMayBeSwapped) {
  Planes<3> planes;
  for (int k = 0; k < 10000; ++k) {
    const Normal<3> n = planes.normal();
    const double fraction = planes.fraction();
    for (const Normal<3>& swapped : {Normal<3>{n[1], n[0], n[2]}, Normal<3>{n[0], n[2], n[1]}})
      EXPECT_EQ(plane_constant<3>(n, fraction), plane_constant<3>(swapped, fraction));
  }
}

} // namespace
} // namespace ballast::remap
