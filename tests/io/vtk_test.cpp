#include "core/io/vtk.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLMultiBlockDataReader.h>

#include "core/error.hpp"
#include "synthetic_series.hpp"
#include "temporary_folder.hpp"

namespace ballast::io {
namespace {

const synthetic::DiscScene scene;

TEST(VtkSeries, ReadsBackAsWritten) {
  const TemporaryFolder folder;
  const GridDump ale = synthetic::disc_dump(scene, 2e-5), vest = synthetic::plate_dump(scene, 2e-5);
  VtkSeries series(folder.path(), "fields");
  series.write(2e-5, 0, {ale, vest});
  ASSERT_EQ(read_pvd(folder / "fields.pvd").at(0).file, "fields_0000.vtm");

  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((folder / "fields_0000.vtm").c_str());
  reader->Update();
  auto* root = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
  ASSERT_EQ(root->GetNumberOfBlocks(), 2U);
  EXPECT_STREQ(root->GetMetaData(1U)->Get(vtkCompositeDataSet::NAME()), "vest");
  auto* block = vtkMultiBlockDataSet::SafeDownCast(root->GetBlock(0));
  auto* grid = vtkStructuredGrid::SafeDownCast(block->GetBlock(0));
  auto* polygons = vtkPolyData::SafeDownCast(block->GetBlock(1));
  ASSERT_TRUE(grid && polygons);
  vtkDataArray* pressure = grid->GetCellData()->GetArray("pressure");
  ASSERT_EQ(pressure->GetNumberOfTuples(), scene.nr * scene.nz);
  for (vtkIdType c = 0; c < pressure->GetNumberOfTuples(); ++c)
    ASSERT_EQ(pressure->GetTuple1(c),
              static_cast<double>(ale.cell_arrays[0].values[static_cast<std::size_t>(c)]));
  for (vtkIdType n = 0; n < grid->GetNumberOfPoints(); ++n)
    ASSERT_EQ(grid->GetPoint(n)[1], ale.points[static_cast<std::size_t>(3 * n + 1)]);
  auto* geometry = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("geometry"));
  ASSERT_TRUE(geometry);
  EXPECT_EQ(geometry->GetValue(0), "axisymmetric");
  auto* names =
      vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("material_names"));
  ASSERT_TRUE(names);
  EXPECT_EQ(names->GetValue(2), "lead");
  EXPECT_EQ(polygons->GetNumberOfCells(),
            static_cast<vtkIdType>(ale.material_polygons.sizes.size()));
  EXPECT_EQ(polygons->GetCellData()->GetArray("material")->GetTuple1(0),
            ale.material_polygons.material[0]);
}

TEST(VtkSeries, GoesOnAfterRestart) {
  const TemporaryFolder folder;
  const GridDump vest = synthetic::plate_dump(scene, 0);
  VtkSeries first(folder.path(), "fields");
  for (int k = 0; k < 5; ++k)
    first.write(0.1 * k, k, {vest});
  VtkSeries second(folder.path(), "fields");
  second.keep_until(0.1 * 2);
  EXPECT_EQ(second.next_index(), 3);
  second.write(0.25, second.next_index(), {vest});
  const auto entries = read_pvd(folder / "fields.pvd");
  ASSERT_EQ(entries.size(), 4U);
  EXPECT_EQ(entries[2].time, 0.1 * 2);
  EXPECT_EQ(entries[3].time, 0.25);
  EXPECT_EQ(entries[3].file, "fields_0003.vtm");
}

/// Two quads side by side and the points of a third that is gone.
ElementDump two_quads() {
  ElementDump dump;
  dump.block = "vest";
  dump.geometry = "axisymmetric";
  for (const double z : {0.0, 0.5})
    for (const double r : {0.0, 1.0, 2.0, 3.0})
      dump.points.insert(dump.points.end(), {r, z, 0});
  dump.elements = {0, 1, 5, 4, 1, 2, 6, 5};
  dump.cell_arrays = {{"damage_warp", 1, {0.5F, 0.25F}}};
  dump.point_arrays = {{"velocity", 3, std::vector<float>(24, 3)}};
  dump.material_names = {"lead", "vest"};
  return dump;
}

TEST(VtkSeries, ElementsReadBackBesideBlocks) {
  const TemporaryFolder folder;
  VtkSeries(folder.path(), "fields").write(1e-6, 0, {synthetic::disc_dump(scene, 0)}, {two_quads()});
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName((folder / "fields_0000.vtm").c_str());
  reader->Update();
  auto* root = vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput());
  ASSERT_EQ(root->GetNumberOfBlocks(), 2U);
  EXPECT_STREQ(root->GetMetaData(1U)->Get(vtkCompositeDataSet::NAME()), "vest");
  auto* grid = vtkUnstructuredGrid::SafeDownCast(vtkMultiBlockDataSet::SafeDownCast(root->GetBlock(1))->GetBlock(0));
  ASSERT_TRUE(grid);
  ASSERT_EQ(grid->GetNumberOfCells(), 2);
  EXPECT_EQ(grid->GetNumberOfPoints(), 8);
  EXPECT_EQ(grid->GetCellType(1), VTK_QUAD);
  vtkNew<vtkIdList> corners;
  grid->GetCellPoints(1, corners);
  EXPECT_EQ(corners->GetId(2), 6);
  EXPECT_EQ(grid->GetCellData()->GetArray("damage_warp")->GetTuple1(1), 0.25);
  EXPECT_EQ(grid->GetPointData()->GetArray("velocity")->GetTuple3(7)[2], 3);
}

TEST(VtkSeries, RefusesElementsOfNodesThatAreNot) {
  const TemporaryFolder folder;
  ElementDump dump = two_quads();
  dump.elements.back() = 8;
  try {
    VtkSeries(folder.path(), "fields").write(0, 0, {}, {dump});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("element 1 has node 8 of 8"), std::string::npos) << error.what();
  }
}

TEST(VtkSeries, NamesTheArrayOfWrongLength) {
  const TemporaryFolder folder;
  GridDump vest = synthetic::plate_dump(scene, 0);
  vest.cell_arrays[1].values.pop_back();
  try {
    VtkSeries(folder.path(), "fields").write(0, 0, {vest});
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'speed'"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace ballast::io
