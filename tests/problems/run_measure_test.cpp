// Extents of a body: continuous as its surface passes from cell to cell.
#include "problems/run_measure.hpp"

#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "materials/library.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double cell = 1e-3; // m

/// Eight by three cells from (-4, 0) of lead in void: to the right of the middle full, then `first`, then `next`.
BodyMeasure measure(double first, double next, bool leftwards = false, int axis = 0) {
  Scene<2> scene;
  Block<2>& b = scene.blocks.emplace_back();
  const Material lead = *find_material("lead");
  b.materials.push_back(make_slot(lead, 0));
  b.materials.push_back(make_void());
  std::vector<double> x, y;
  for (int i = -4; i <= 4; ++i) {
    x.push_back(cell * i);
  }
  y.assign(x.begin() + 4, x.begin() + 8);
  allocate_block(b, {x, y, {}});
  for_each_cell(b, [&](int i, int j, int k) {
    const int q = leftwards ? 3 - i : i - 4;
    const double f = q < 0 || q > 2 || j != 1 ? 0 : q == 0 ? 1 : q == 1 ? first : next;
    const CellPart parts[2] = {{0, f, lead.density, lead.specific_energy}, {1, 1 - f, 0, 0}};
    fill_cell<2>(b, i, j, k, std::span<const CellPart>(parts + (f > 0 ? 0 : 1), f > 0 && f < 1 ? 2 : 1));
  });
  compute_node_mass(b, *scene.pool);
  return measure_body(b, {0}, axis, 1.0);
}

TEST(Measure, FrontIsContinuousFromCellToCell) {
  for (const double first : {1.0, 0.8, 0.6}) { // a front along the cells' sides, and slanted ones
    EXPECT_NEAR(measure(first, 0.499).front, measure(first, 0.501).front, 0.01 * cell) << first;
    EXPECT_NEAR(measure(first, 0.3).front, (1 + first + 0.3) * cell, 1e-12) << first;
  }
}

TEST(Measure, RadiusIsThatOfTheFartherSide) {
  EXPECT_NEAR(measure(1, 0.3, false, 1).radius, 2.3 * cell, 1e-12);
  EXPECT_NEAR(measure(1, 0.3, true, 1).radius, 2.3 * cell, 1e-12);
}

} // namespace
} // namespace ballast
