// Law of the volumes a mixed cell gives: each face gets its total, and the two together no more of a material than there is.
#include "remap/face_row.hpp"
#include "tests/remap/remap_box.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace ballast::remap {
namespace {

/// Cells of random fractions of `materials`, all of which the faces along `axis` pull at with up to half a cell.
template <int Dim> void expect_no_overdraft(int materials, int axis) {
  const int n = 12;
  RemapBox<Dim> box({.cells = {n, n, Dim == 3 ? n : 1}, .materials = materials});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  box.for_each_cell([&](int i, int j, int k) {
    std::vector<double> part(static_cast<std::size_t>(materials));
    double sum = 0;
    for (double& f : part) {
      f = std::pow(unit(random), 4); // many thin layers
      sum += f;
    }
    for (int m = 0; m < materials; ++m) {
      box.fill(m, i, j, k, part[static_cast<std::size_t>(m)] / sum, 1, 0);
    }
  });
  std::fill(box.owner.begin(), box.owner.end(), std::int8_t{-1});
  RowField& swept = box.swept[static_cast<std::size_t>(axis)];
  const double cell = box.volume.row(box.grid.cell_row(1, Dim == 3 ? 1 : 0))[1];
  box.for_each_cell([&](int i, int j, int k) {
    const int at[3] = {i, j, k};
    const bool giver = (i + j + k) % 2 == 0; // gives through both its faces, its neighbours take
    const double t = (at[axis] == 0 ? 0 : cell * (unit(random) < 0.5 ? 0.4999 : 0.4999 * unit(random)));
    swept.row(box.grid.cell_row(j, k))[i] = giver ? t : -t;
  });
  Mesh<Dim> mesh = box.mesh();
  // Cells whose both faces lie inside: from the second to the last but one along the axis.
  int both = 0;
  for (int k = Dim == 3 ? 2 : 0; k < (Dim == 3 ? n - 2 : 1); ++k) {
    for (int j = 2; j < n - 2; ++j) {
      const int r = box.grid.cell_row(j, k), next = r + box.grid.cell_row_stride(axis), step = axis == 0 ? 1 : 0;
      FaceRow low(mesh, n + step), high(mesh, n + step);
      volume_fluxes(mesh, {}, axis, line_of(box.grid, axis, j, k), r, low);
      volume_fluxes(mesh, {}, axis, line_of(box.grid, axis, axis == 1 ? j + 1 : j, axis == 2 ? k + 1 : k), next, high);
      for (int i = 2; i < n - 2; ++i) {
        double total = 0;
        for (int m = 0; m < materials; ++m) {
          const double in = low.present(m) ? low.flux(m, 0)[i] : 0.0;
          const double out = (axis == 0 ? low : high).present(m) ? (axis == 0 ? low : high).flux(m, 0)[i + step] : 0.0;
          const double held = box.fraction(m, i, j, k) * cell, given = std::max(-in, 0.0) + std::max(out, 0.0);
          EXPECT_LE((given - held) / cell, 1e-14) << materials << " materials, axis " << axis << ", cell " << i << " " << j << " " << k;
          total += in;
          both += in < 0 && out > 0 ? 1 : 0;
        }
        EXPECT_NEAR(total, -swept.row(r)[i], 1e-15 * cell);
      }
    }
  }
  EXPECT_GT(both, 30);
}

TEST(VolumeFlux, TwoFacesTakeNoMoreThanThereIs) {
  for (const int materials : {2, 3, 4}) {
    for (int axis = 0; axis < 3; ++axis) {
      expect_no_overdraft<3>(materials, axis);
    }
    expect_no_overdraft<2>(materials, 0);
    expect_no_overdraft<2>(materials, 1);
  }
}

} // namespace
} // namespace ballast::remap
