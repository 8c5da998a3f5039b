// Compaction of foam (eos/p_alpha) in cells.
#include "ale/fill.hpp"
#include "ale/phases.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

Material foam() {
  Material m;
  m.name = "foam";
  m.eos = PAlpha{};
  m.density = 100;
  return m;
}

/// Three cells of foam in a row.
struct Row {
  Block<2> b;
  ThreadPool pool{1};
  int r = 0;

  Row() {
    b.materials.push_back(make_slot(foam(), 0));
    allocate_block(b, {std::vector<double>{0, 1e-3, 2e-3, 3e-3}, std::vector<double>{0, 1e-3}, {}});
    for (int i = 0; i < 3; ++i) {
      const CellPart part{0, 1, 100, 0};
      fill_cell<2>(b, i, 0, 0, std::span<const CellPart>(&part, 1));
    }
    r = b.grid.cell_row(0, 0);
    update_state(b, pool);
  }
  double& at(int field, int i) { return b.materials[0].store.row(field, r)[i]; }
  double compaction(int i) { return at(b.materials[0].compaction_field(), i); }
  /// Cell i at `density`: by its mass, in the same volume.
  void set(int i, double density) {
    at(field::mass, i) = density * b.volume.row(r)[i];
    update_state(b, pool);
  }
  double pressure(int i) const { return b.pressure.row(r)[i]; }
};

TEST(Foam, RestsWithoutCompaction) {
  Row a;
  EXPECT_EQ(a.pressure(1), 0);
  EXPECT_EQ(a.compaction(1), 0);
  EXPECT_EQ(a.b.materials[0].store.conserved(), 4); // the field goes through the remap with the mass
}

TEST(Foam, CompactionIsThatOfTheLargestDensity) {
  Row a;
  const PAlpha law;
  a.set(1, 300);
  EXPECT_NEAR(a.pressure(1), law.pressure(300, 0), 1e-6);
  EXPECT_NEAR(a.compaction(1), 1 - 100 / 300.0, 1e-12);
  EXPECT_EQ(a.compaction(0), 0);
  const double squeezed = a.pressure(1), held = a.compaction(1);
  update_state(a.b, a.pool); // as a restart does
  EXPECT_EQ(a.pressure(1), squeezed);
  EXPECT_EQ(a.compaction(1), held);
  a.set(1, 299.9);
  EXPECT_NEAR(a.pressure(1), squeezed - law.K * 1e-4, 1e-3);
  EXPECT_EQ(a.compaction(1), held);
  a.set(1, 250);
  EXPECT_LT(a.pressure(1), 0); // loading again would press: it has not come back
  EXPECT_GT(law.pressure(250, 0), 0);
}

} // namespace
} // namespace ballast
