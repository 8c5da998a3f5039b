// What a picture reads of a 3D dump: its lowest layer as (x, z), mirrored where the run was.
#include "post/section_raster.hpp"

#include "core/io/vtk.hpp"
#include "tests/io/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace ballast::post {
namespace {

/// Two by one by one cells of 1 m from x = 0: material 0, then void with a polygon of material 1 up
/// to x = 1.5 m.
io::GridDump two_cells() {
  io::GridDump dump;
  dump.block = "mesh";
  dump.geometry = "3d";
  dump.symmetry = {"x", "y"};
  dump.cells = {2, 1, 1};
  dump.material_names = {"lead", "muscle"};
  for (const double z : {0.0, 1.0})
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 1.0, 2.0})
        dump.points.insert(dump.points.end(), {x, y, z});
  dump.cell_arrays = {{"material", 1, {0, -1}}, {"pressure", 1, {10, 20}}, {"speed", 1, {1, 2}}};
  dump.material_polygons.points = {1, 0, 0, 1.5, 0, 0, 1.5, 0, 1, 1, 0, 1};
  dump.material_polygons.sizes = {4};
  dump.material_polygons.material = {1};
  return dump;
}

Section read_back(const io::GridDump& dump) {
  const io::TemporaryFolder folder;
  io::VtkSeries series(folder.path(), "fields");
  series.write(0, 0, {dump});
  return read_section(folder / "fields_0000.vtm", 0);
}

TEST(Section, SolidIsMirroredWithItsInterfaces) {
  const Section section = read_back(two_cells());
  EXPECT_TRUE(section.mirrored);
  const PlotArea area{{0, 0, 40, 10}, {-2, 2}, {0, 1}}; // 10 pixels a metre
  const SectionRaster raster = sample(section, area, section.mirrored);
  const auto at = [&](double x) {
    return raster.index(static_cast<int>((x + 2) * 10 * Canvas::fine), raster.rows / 2);
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(raster.material[at(side * 0.5)], 0);
    EXPECT_EQ(raster.material[at(side * 1.25)], 1);
    EXPECT_EQ(raster.material[at(side * 1.75)], SectionCell::none);
    EXPECT_EQ(raster.pressure[at(side * 0.5)], 10);
    EXPECT_EQ(raster.speed[at(side * 1.25)], 2);
  }
}

TEST(Section, SolidWithoutSymmetryInXIsNot) {
  io::GridDump dump = two_cells();
  dump.symmetry = {"y"};
  EXPECT_FALSE(read_back(dump).mirrored);
  dump.symmetry.clear();
  EXPECT_FALSE(read_back(dump).mirrored);
}

TEST(Section, AxisymmetricIsMirrored) {
  io::GridDump dump = two_cells();
  dump.geometry = "axisymmetric";
  dump.symmetry.clear();
  EXPECT_TRUE(read_back(dump).mirrored);
}

} // namespace
} // namespace ballast::post
