// Laws of the polygons drawn in the section of a 3D block: they close the shapes of the pure cells.
#include "problems/section_polygons.hpp"

#include "problems/build_scene.hpp"
#include "problems/run_dump.hpp"
#include "problems/scene_reader.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

// A quarter of a lead ball of radius 5 mm above a block of muscle that ends inside its cells: 0.3 of the
// mesh's last cell along x, 0.6 of one along z. Cells of 1 mm; void around.
constexpr const char* deck = R"(
title = "ball above a block"
geometry = "3d"
symmetry = ["x", "y"]
end_time = "1 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "ball"
material = "lead"
shape = { sphere = { centre = ["0 mm", "0 mm", "8.2 mm"], radius = "5 mm" } }
[[body]]
name = "block"
material = "muscle"
shape = { box = { from = ["0 mm", "0 mm", "-6 mm"], to = ["6.3 mm", "6 mm", "1.6 mm"] } }
[mesh]
x = { from = "0 mm", to = "7 mm", size = "1 mm" }
y = { from = "0 mm", to = "8 mm", size = "1 mm" }
z = { from = "-6 mm", to = "15 mm", size = "1 mm" }
)";

Scene<3> make_scene() {
  Deck d = Deck::parse(deck, "test.toml", {});
  const SceneSpec spec = read_scene(d);
  d.throw_if_errors();
  return build_scene<3>(spec, 1);
}

int index_of(const Block<3>& b, const std::string& name) {
  int m = 0;
  while (b.materials.at(static_cast<std::size_t>(m)).material.name != name)
    ++m;
  return m;
}

/// Visits (x, z), in mm, of every corner of the material's polygons; returns their area in mm2.
template <class Visit> double visit_corners(const io::GridDump::Polygons& polygons, int material, Visit&& visit) {
  double twice = 0;
  std::size_t first = 0;
  for (std::size_t q = 0; q < polygons.sizes.size(); ++q) {
    const auto n = static_cast<std::size_t>(polygons.sizes[q]);
    const auto mm = [&](std::size_t v, std::size_t d) { return 1e3 * polygons.points[3 * (first + v % n) + d]; };
    for (std::size_t v = 0; v < n && polygons.material[q] == material; ++v) {
      EXPECT_EQ(mm(v, 1), 0); // in the plane y = 0
      visit(mm(v, 0), mm(v, 2));
      twice += mm(v, 0) * mm(v + 1, 2) - mm(v + 1, 0) * mm(v, 2);
    }
    first += n;
  }
  return twice / 2;
}

double pure_area(const Block<3>& b, int material) { // mm2, cells of 1 mm
  double area = 0;
  for (int k = 0; k < b.grid.cells[2]; ++k)
    for (int i = 0; i < b.grid.cells[0]; ++i)
      area += b.owner_row(b.grid.cell_row(0, k))[i] == material ? 1 : 0;
  return area;
}

TEST(SectionPolygons, FlatSidesEndWhereTheBodyEnds) {
  const Scene<3> scene = make_scene();
  const Block<3>& b = scene.blocks[0];
  const int muscle = index_of(b, "muscle");
  int side = 0, top = 0;
  const double mixed = visit_corners(section_polygons(b, scene.numerics.normal), muscle, [&](double x, double z) {
    // Away from the block's edges, which no plane can follow; the symmetry plane x = 0 included.
    if (std::abs(z + 2.5) < 2) {
      EXPECT_TRUE(std::abs(x - 6.3) < 1e-9 || std::abs(x - 6) < 1e-9) << x << ' ' << z;
      ++side;
    }
    if (x < 4.5) {
      EXPECT_TRUE(std::abs(z - 1.6) < 1e-9 || std::abs(z - 1) < 1e-9) << x << ' ' << z;
      ++top;
    }
  });
  EXPECT_GT(side, 8);
  EXPECT_GT(top, 16);
  EXPECT_NEAR(mixed + pure_area(b, muscle), 6.3 * 7.6, 0.1);
}

TEST(SectionPolygons, BallIsRound) {
  const Scene<3> scene = make_scene();
  const Block<3>& b = scene.blocks[0];
  const int lead = index_of(b, "lead");
  double most = 0;
  const double mixed = visit_corners(section_polygons(b, scene.numerics.normal), lead, [&](double x, double z) {
    most = std::max(most, std::hypot(x, z - 8.2));
  });
  EXPECT_LT(most, 5.1);
  const double half_disc = std::numbers::pi * 25 / 2;
  EXPECT_NEAR((mixed + pure_area(b, lead)) / half_disc, 1, 0.01);
}

TEST(SectionPolygons, DumpLeavesTheSectionsMixedCellsToThem) {
  const Scene<3> scene = make_scene();
  const Block<3>& b = scene.blocks[0];
  const io::GridDump dump = dump_block(b, scene.numerics.normal, {});
  EXPECT_EQ(dump.symmetry, (std::vector<std::string>{"x", "y"}));
  const auto material = [&](int i, int j, int k) {
    return static_cast<int>(dump.cell_arrays.at(0).values.at(static_cast<std::size_t>((k * 8 + j) * 7 + i)));
  };
  ASSERT_EQ(dump.cell_arrays[0].name, "material");
  EXPECT_EQ(material(2, 0, 7), -1);                    // 0.6 muscle, in the section
  EXPECT_EQ(material(2, 1, 7), index_of(b, "muscle")); // behind it
  EXPECT_EQ(material(2, 0, 6), index_of(b, "muscle")); // pure
}

} // namespace
} // namespace ballast
