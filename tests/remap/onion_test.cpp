// Laws of onion-skin reconstruction.
#include "remap/onion.hpp"

#include <gtest/gtest.h>
#include <random>

namespace ballast::remap {
namespace {

constexpr int interfaces = 3; // four materials

template <int Dim> class RandomCell {
public:
  // Cumulated stencils of random layers: ordered in every cell, rough, some cells pure.
  std::array<double, interfaces * stencil_size<Dim>> cumulated() {
    std::array<double, interfaces * stencil_size<Dim>> all;
    for (int cell = 0; cell < stencil_size<Dim>; ++cell) {
      double sum = 0.0;
      for (int k = 0; k < interfaces; ++k) {
        if (unit_(random_) < 0.7)
          sum += (1.0 - sum) * unit_(random_);
        if (unit_(random_) < 0.05)
          sum = 1.0;
        all[k * stencil_size<Dim> + cell] = sum;
      }
    }
    return all;
  }
  double fraction() { return unit_(random_); }

private:
  std::mt19937 random_{77};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

template <int Dim> void expect_whole_cell_holds_fractions() {
  RandomCell<Dim> random;
  for (int k = 0; k < 3000; ++k) {
    const auto cumulated = random.cumulated();
    std::array<Interface<Dim>, interfaces> planes;
    onion_interfaces<Dim>(NormalMethod::elvira, cumulated.data(), interfaces, planes.data());
    std::array<double, interfaces + 1> volumes;
    slab_volumes<Dim>(planes.data(), interfaces, k % Dim, 0.0, 1.0, volumes.data());
    double before = 0.0;
    for (int mat = 0; mat < interfaces; ++mat) {
      const double sum = cumulated[mat * stencil_size<Dim> + stencil_size<Dim> / 2];
      ASSERT_NEAR(volumes[mat], sum - before, 1e-14); // two plane round trips
      before = sum;
    }
    ASSERT_NEAR(volumes[interfaces], 1.0 - before, 1e-14);
  }
}

TEST(Onion, WholeCellHoldsFractions) {
  expect_whole_cell_holds_fractions<2>();
  expect_whole_cell_holds_fractions<3>();
}

template <int Dim> void expect_slabs_close() {
  RandomCell<Dim> random;
  for (int k = 0; k < 3000; ++k) {
    const auto cumulated = random.cumulated();
    std::array<Interface<Dim>, interfaces> planes;
    onion_interfaces<Dim>(NormalMethod::youngs, cumulated.data(), interfaces, planes.data());
    for (int slab = 0; slab < 20; ++slab) {
      const auto [lo, hi] = std::minmax({random.fraction(), random.fraction()});
      std::array<double, interfaces + 1> volumes;
      slab_volumes<Dim>(planes.data(), interfaces, slab % Dim, lo, hi, volumes.data());
      double sum = 0.0;
      for (const double volume : volumes) {
        ASSERT_GE(volume, 0.0);
        sum += volume;
      }
      ASSERT_EQ(sum, hi - lo);
    }
  }
}

TEST(Onion, SlabVolumesAreNonNegativeAndSumExactly) {
  expect_slabs_close<2>();
  expect_slabs_close<3>();
}

TEST(Onion, ParallelLayersTileTheirFractions) {
  const Normal<3> n = {0.2, -0.5, 0.8};
  std::array<Interface<3>, interfaces> planes;
  for (int k = 0; k < interfaces; ++k)
    planes[k] = {n, plane_constant<3>(n, 0.25 * (k + 1))};
  std::array<double, interfaces + 1> total{}, volumes;
  for (int slab = 0; slab < 5; ++slab) {
    slab_volumes<3>(planes.data(), interfaces, 1, 0.2 * slab, 0.2 * (slab + 1), volumes.data());
    for (int mat = 0; mat <= interfaces; ++mat)
      total[mat] += volumes[mat];
  }
  for (const double volume : total)
    EXPECT_NEAR(volume, 0.25, 1e-14);
}

TEST(Onion, AbsentMaterialsGetExactlyNothing) {
  // Material 0 absent, material 1 alone in the centre cell, mixed neighbours.
  std::array<double, 27> cumulated{};
  for (int cell = 0; cell < 9; ++cell) {
    cumulated[cell] = cell < 3 ? 0.5 : 0.0;
    cumulated[9 + cell] = cell < 6 ? 1.0 : 0.3;
    cumulated[18 + cell] = 1.0 + 1e-12; // clipped
  }
  std::array<Interface<2>, interfaces> planes;
  onion_interfaces<2>(NormalMethod::elvira, cumulated.data(), interfaces, planes.data());
  RandomCell<2> random;
  for (int k = 0; k < 1000; ++k) {
    const auto [lo, hi] = std::minmax({random.fraction(), random.fraction()});
    std::array<double, interfaces + 1> volumes;
    slab_volumes<2>(planes.data(), interfaces, k % 2, lo, hi, volumes.data());
    EXPECT_EQ(volumes, (std::array<double, 4>{0.0, hi - lo, 0.0, 0.0}));
  }
}

TEST(Onion, EmptySlabHoldsNothing) {
  const Interface<2> plane = {{1.0, 1.0}, 0.7};
  std::array<double, 2> volumes = {1.0, 1.0};
  slab_volumes<2>(&plane, 1, 0, 0.5, 0.5, volumes.data());
  EXPECT_EQ(volumes, (std::array<double, 2>{0.0, 0.0}));
  slab_volumes<2>(&plane, 1, 0, 0.6, 0.5, volumes.data());
  EXPECT_EQ(volumes, (std::array<double, 2>{0.0, 0.0}));
}

} // namespace
} // namespace ballast::remap
