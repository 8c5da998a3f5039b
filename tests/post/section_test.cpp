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

/// Two layers of one hexahedron each, 1 m wide and long, 0.5 m thick, the second behind y = 0 by one more.
std::vector<io::ElementDump> two_layers() {
  io::ElementDump dump;
  dump.block = "vest";
  dump.geometry = "3d";
  dump.symmetry = {"x", "y"};
  dump.corners = 8;
  for (const double z : {0.0, 0.5, 1.0})
    for (const double y : {0.0, 1.0, 2.0})
      for (const double x : {0.0, 1.0})
        dump.points.insert(dump.points.end(), {x, y, z});
  const auto hexahedron = [&](int y, int z) {
    for (const int up : {6 * z, 6 * z + 6})
      for (const int n : {2 * y, 2 * y + 1, 2 * y + 3, 2 * y + 2})
        dump.elements.push_back(up + n);
  };
  hexahedron(0, 0), hexahedron(0, 1), hexahedron(1, 1);
  dump.cell_arrays = {{"material", 1, {2, 2, 2}},       {"speed", 1, {1, 2, 9}},         {"layer", 1, {0, 1, 1}},
                      {"damage_warp", 1, {0.5F, 0, 9}}, {"damage_fill", 1, {0, 0.25F, 9}}, {"section", 1, {1, 1, 0}}};
  dump.material_names = {"lead", "muscle", "vest"};
  return {dump};
}

TEST(Section, LayersAreDrawnWhereTheyLayOnThePlane) {
  const io::TemporaryFolder folder;
  io::VtkSeries series(folder.path(), "fields");
  series.write(0, 0, {}, two_layers());
  const Section section = read_section(folder / "fields_0000.vtm", 0);
  ASSERT_EQ(section.blocks.size(), 1U);
  EXPECT_EQ(section.blocks[0].name, "vest");
  ASSERT_EQ(section.blocks[0].cells.size(), 2U);
  EXPECT_TRUE(section.mirrored);
  const PlotArea area{{0, 0, 80, 40}, {-1, 1}, {0, 1}};
  const SectionRaster raster = sample(section, area, section.mirrored);
  const std::vector<bool> lines = interface_samples(raster);
  const auto at = [&](double x, double z) { return raster.index(static_cast<int>((x + 1) * 40 * Canvas::fine), static_cast<int>((1 - z) * 40 * Canvas::fine)); };
  for (const double x : {-0.5, 0.5}) {
    EXPECT_EQ(raster.material[at(x, 0.25)], 2);
    EXPECT_EQ(raster.damage[at(x, 0.25)], 0.5F);
    EXPECT_EQ(raster.damage[at(x, 0.75)], 0.25F);
    EXPECT_EQ(raster.speed[at(x, 0.75)], 2);
    EXPECT_TRUE(lines[at(x, 0.5)]); // between the layers
    EXPECT_FALSE(lines[at(x, 0.25)]);
  }
}

TEST(Section, LayersTooThinToBeToldApartHaveNoLines) {
  const io::TemporaryFolder folder;
  io::VtkSeries series(folder.path(), "fields");
  series.write(0, 0, {}, two_layers());
  const Section section = read_section(folder / "fields_0000.vtm", 0);
  const SectionRaster raster = sample(section, {{0, 0, 40, 4}, {-1, 1}, {0, 1}}, true);
  for (const bool line : interface_samples(raster))
    EXPECT_FALSE(line);
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
