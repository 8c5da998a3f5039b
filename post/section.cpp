#include "post/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>
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

namespace ballast::post {
namespace {

std::vector<std::string> strings(vtkDataSet* set, const char* name) {
  std::vector<std::string> texts;
  if (auto* array = vtkStringArray::SafeDownCast(set->GetFieldData()->GetAbstractArray(name)))
    for (vtkIdType k = 0; k < array->GetNumberOfValues(); ++k)
      texts.push_back(array->GetValue(k));
  return texts;
}

/// A cell value from a cell array or, failing that, the mean of a point array over the corners.
class CellValue {
public:
  CellValue(vtkStructuredGrid* grid, const char* name)
      : of_cell_(grid->GetCellData()->GetArray(name)),
        of_point_(grid->GetPointData()->GetArray(name)) {}
  float operator()(vtkIdType cell, const std::array<vtkIdType, 4>& nodes) const {
    if (of_cell_)
      return static_cast<float>(of_cell_->GetTuple1(cell));
    if (!of_point_)
      return std::numeric_limits<float>::quiet_NaN();
    double sum = 0;
    for (vtkIdType node : nodes)
      sum += of_point_->GetTuple1(node);
    return static_cast<float>(sum / 4);
  }

private:
  vtkDataArray *of_cell_, *of_point_;
};

void add_cells(vtkStructuredGrid* grid, SectionBlock& block) {
  int n[3];
  grid->GetDimensions(n);
  const bool solid = n[2] > 1;
  const auto layers = strings(grid, "section_layer");
  const vtkIdType layer = solid && !layers.empty() ? std::stol(layers.front()) : 0;
  const vtkIdType across = n[0], up = solid ? vtkIdType{n[0]} * n[1] : across; // node strides
  const vtkIdType cell_up = solid ? vtkIdType{n[0] - 1} * (n[1] - 1) : n[0] - 1;
  const int rows = (solid ? n[2] : n[1]) - 1;
  const CellValue pressure(grid, "pressure"), speed(grid, "speed"), material(grid, "material");
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < n[0] - 1; ++i) {
      const vtkIdType node = k * up + layer * n[0] + i, cell = k * cell_up + layer * (n[0] - 1) + i;
      const std::array<vtkIdType, 4> nodes{node, node + 1, node + 1 + up, node + up};
      SectionCell& out = block.cells.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) {
        double p[3];
        grid->GetPoint(nodes[c], p);
        out.corners[c] = {static_cast<float>(p[0]), static_cast<float>(solid ? p[2] : p[1])};
      }
      out.pressure = pressure(cell, nodes);
      out.speed = speed(cell, nodes);
      const float m = material(cell, nodes);
      out.material = std::isnan(m) ? SectionCell::unknown
                     : m < 0       ? SectionCell::none
                                   : static_cast<int>(std::lround(m));
    }
}

/// The drawn face of an element: of a quad the whole, of a hexahedron the lower one along j.
std::array<vtkIdType, 4> drawn_face(vtkIdList* corners) {
  const bool solid = corners->GetNumberOfIds() == 8;
  const std::array<vtkIdType, 4> at = solid ? std::array<vtkIdType, 4>{0, 1, 5, 4} : std::array<vtkIdType, 4>{0, 1, 2, 3};
  return {corners->GetId(at[0]), corners->GetId(at[1]), corners->GetId(at[2]), corners->GetId(at[3])};
}

void add_elements(vtkUnstructuredGrid* grid, SectionBlock& block) {
  const auto array = [grid](const char* name) { return grid->GetCellData()->GetArray(name); };
  vtkDataArray *material = array("material"), *speed = array("speed"), *section = array("section"), *layer = array("layer");
  vtkDataArray *warp = array("damage_warp"), *fill = array("damage_fill");
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    grid->GetCellPoints(cell, corners);
    const bool solid = corners->GetNumberOfIds() == 8;
    if (solid && (!section || section->GetTuple1(cell) == 0))
      continue;
    SectionCell& out = block.cells.emplace_back();
    const auto nodes = drawn_face(corners);
    for (std::size_t c = 0; c < 4; ++c) {
      double p[3];
      grid->GetPoint(nodes[c], p);
      out.corners[c] = {static_cast<float>(p[0]), static_cast<float>(solid ? p[2] : p[1])};
    }
    if (speed)
      out.speed = static_cast<float>(speed->GetTuple1(cell));
    if (warp && fill)
      out.damage = static_cast<float>(std::max(warp->GetTuple1(cell), fill->GetTuple1(cell)));
    if (material)
      out.material = static_cast<int>(material->GetTuple1(cell));
    if (layer)
      out.part = 1 + static_cast<int>(layer->GetTuple1(cell));
  }
}

void add_polygons(vtkPolyData* set, bool solid, SectionBlock& block) {
  vtkDataArray* material = set->GetCellData()->GetArray("material");
  if (!material)
    return;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType cell = 0; cell < set->GetNumberOfCells(); ++cell) {
    set->GetCellPoints(cell, nodes);
    SectionPolygon& polygon = block.polygons.emplace_back();
    polygon.material = static_cast<int>(material->GetTuple1(cell));
    for (vtkIdType v = 0; v < nodes->GetNumberOfIds(); ++v) {
      double p[3];
      set->GetPoint(nodes->GetId(v), p);
      polygon.corners.push_back(
          {static_cast<float>(p[0]), static_cast<float>(solid ? p[2] : p[1])});
    }
  }
}

void add_facts(vtkDataSet* set, Section& section) {
  const auto geometry = strings(set, "geometry");
  if (section.geometry.empty() && !geometry.empty())
    section.geometry = geometry.front();
  const auto symmetry = strings(set, "symmetry");
  if (section.geometry == "axisymmetric" ||
      std::find(symmetry.begin(), symmetry.end(), "x") != symmetry.end())
    section.mirrored = true;
  const auto names = strings(set, "material_names");
  if (names.size() > section.material_names.size())
    section.material_names = names;
}

void add_data(vtkDataObject* data, Section& section, SectionBlock& block) {
  if (auto* grid = vtkStructuredGrid::SafeDownCast(data)) {
    add_facts(grid, section);
    add_cells(grid, block);
  } else if (auto* polygons = vtkPolyData::SafeDownCast(data)) {
    add_facts(polygons, section);
    add_polygons(polygons, section.geometry == "3d", block);
  } else if (auto* elements = vtkUnstructuredGrid::SafeDownCast(data)) {
    add_facts(elements, section);
    add_elements(elements, block);
  } else if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(data)) {
    for (unsigned int k = 0; k < inner->GetNumberOfBlocks(); ++k)
      add_data(inner->GetBlock(k), section, block);
  }
}

} // namespace

Section read_section(const std::filesystem::path& vtm, double time) {
  if (!std::filesystem::exists(vtm))
    throw Error(fmt::format("{}: listed in the .pvd but missing. Copy the whole run directory.",
                            vtm.string()));
  vtkNew<vtkXMLMultiBlockDataReader> reader;
  reader->SetFileName(vtm.c_str());
  reader->Update();
  vtkMultiBlockDataSet* root = reader->GetErrorCode() == 0
                                   ? vtkMultiBlockDataSet::SafeDownCast(reader->GetOutput())
                                   : nullptr;
  if (!root || root->GetNumberOfBlocks() == 0)
    throw Error(fmt::format("{}: holds no readable block", vtm.string()));
  Section section{
      .time = time, .geometry = {}, .mirrored = false, .material_names = {}, .blocks = {}};
  for (unsigned int b = 0; b < root->GetNumberOfBlocks(); ++b) {
    SectionBlock& block = section.blocks.emplace_back();
    if (root->HasMetaData(b) && root->GetMetaData(b)->Has(vtkCompositeDataSet::NAME()))
      block.name = root->GetMetaData(b)->Get(vtkCompositeDataSet::NAME());
    add_data(root->GetBlock(b), section, block);
  }
  return section;
}

} // namespace ballast::post
