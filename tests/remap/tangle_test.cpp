// A remap refuses a mesh that would turn a cell inside out, and names the cell.
#include "tests/remap/mesh_motions.hpp"

#include <gtest/gtest.h>

namespace ballast::remap {
namespace {

constexpr int n = 6;
constexpr std::array<int, 3> middle(int dim) { return {3, 3, dim == 3 ? 3 : 0}; }

/// Carries the low corner of the middle cell along the cell's diagonal, by `share` of it; all else stays.
template <int Dim> Map<Dim> corner_pushed(double share) {
  return [share](const Point<Dim>& x) {
    const double h = 1.0 / n;
    Point<Dim> to = x;
    bool corner = true;
    for (const double q : x) {
      corner = corner && std::abs(q - 3 * h) < 1e-9;
    }
    for (double& q : to) {
      q += corner ? share * h : 0;
    }
    return to;
  };
}

template <int Dim> RemapBox<Dim> uniform_box(bool axisymmetric) {
  RemapBox<Dim> box({.cells = {n, n, Dim == 3 ? n : 1}, .axisymmetric = axisymmetric});
  fill_smooth<Dim>(box, [](const auto&) { return 2.0; }, [](const auto&) { return 3.0; },
                   [](const auto&) { Point<Dim> u; u.fill(0.7); return u; });
  return box;
}

template <int Dim> void expect_refused(bool axisymmetric) {
  ThreadPool pool(1);
  // A node pushed through the opposite corner leaves its cell a negative volume.
  RemapBox<Dim> box = uniform_box<Dim>(axisymmetric);
  const BoxTotals before = box.totals();
  const Report report = box.move_to(corner_pushed<Dim>(1.5), {}, pool, 0);
  EXPECT_EQ(report.tangled, middle(Dim));
  const BoxTotals after = box.totals();
  EXPECT_NEAR(after.mass[0], before.mass[0], 1e-13 * before.mass[0]);
  EXPECT_NEAR(after.internal, before.internal, 1e-13 * before.internal);
  box.for_each_cell([&](int i, int j, int k) { EXPECT_GT(box.volume.row(box.grid.cell_row(j, k))[i], 0) << i << " " << j << " " << k; });
}

template <int Dim> void expect_taken() {
  ThreadPool pool(1);
  RemapBox<Dim> box = uniform_box<Dim>(false);
  const Report report = box.move_to(corner_pushed<Dim>(0.3), {}, pool, 0);
  EXPECT_EQ(report.tangled[0], -1);
  EXPECT_EQ(box.position[0].data(), box.target[0].data());
}

TEST(Remap, RefusesToTurnACellInsideOut) {
  expect_refused<2>(false);
  expect_refused<2>(true);
  expect_refused<3>(false);
}

TEST(Remap, TakesASqueezeThatLeavesEveryCellItsVolume) {
  expect_taken<2>();
  expect_taken<3>();
}

} // namespace
} // namespace ballast::remap
