#include "core/io/vtk.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fmt/core.h>
#include <fstream>
#include <numeric>
#include <regex>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "core/error.hpp"
#include "core/io/summary.hpp"

namespace ballast::io {
namespace {

namespace fs = std::filesystem;

template <class Dump>
void require_size(const Dump& dump,
                  const std::string& what,
                  std::size_t found,
                  std::size_t expected) {
  if (found != expected)
    throw Error(fmt::format(
        "dump of block '{}': {} has {} values, {} are needed", dump.block, what, found, expected));
}

template <class Dump>
void add_arrays(vtkDataSetAttributes* data,
                const Dump& dump,
                const std::vector<GridDump::Array>& arrays,
                std::size_t entities) {
  for (const GridDump::Array& array : arrays) {
    require_size(dump,
                 "array '" + array.name + "'",
                 array.values.size(),
                 entities * static_cast<std::size_t>(array.components));
    vtkNew<vtkFloatArray> values;
    values->SetName(array.name.c_str());
    values->SetNumberOfComponents(array.components);
    values->SetNumberOfTuples(static_cast<vtkIdType>(entities));
    std::copy(array.values.begin(), array.values.end(), values->GetPointer(0));
    data->AddArray(values);
  }
}

void add_strings(vtkFieldData* data, const char* name, const std::vector<std::string>& texts) {
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
    array->InsertNextValue(text);
  data->AddArray(array);
}

/// What a reader must know beside the arrays: geometry, symmetry, time and the materials' names.
template <class Dump> void add_facts(vtkDataSet* set, const Dump& dump, double time) {
  add_strings(set->GetFieldData(), "geometry", {dump.geometry});
  if (!dump.symmetry.empty())
    add_strings(set->GetFieldData(), "symmetry", dump.symmetry);
  if (!dump.material_names.empty())
    add_strings(set->GetFieldData(), "material_names", dump.material_names);
  vtkNew<vtkDoubleArray> when;
  when->SetName("TimeValue");
  when->InsertNextValue(time);
  set->GetFieldData()->AddArray(when);
}

vtkNew<vtkPoints> make_points(const std::vector<double>& coordinates) {
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfComponents(3);
  values->SetNumberOfTuples(static_cast<vtkIdType>(coordinates.size() / 3));
  std::copy(coordinates.begin(), coordinates.end(), values->GetPointer(0));
  vtkNew<vtkPoints> points;
  points->SetData(values);
  return points;
}

void write_file(vtkXMLWriter* writer, vtkDataSet* set, const fs::path& path) {
  writer->SetFileName(path.c_str());
  writer->SetInputDataObject(set);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToLZ4();
  if (writer->Write() != 1 || writer->GetErrorCode() != 0)
    throw Error(fmt::format("{}: cannot be written. Is the folder writable and the disc not full?",
                            path.string()));
}

void write_grid(const fs::path& path, const GridDump& dump, double time) {
  const auto [nx, ny, nz] = dump.cells;
  const auto count = [](int n) { return static_cast<std::size_t>(n); };
  const std::size_t nodes = count(nx + 1) * count(ny + 1) * count(nz + 1);
  const std::size_t cells = count(nx) * count(ny) * count(std::max(nz, 1));
  require_size(dump, "points", dump.points.size(), 3 * nodes);
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(nx + 1, ny + 1, nz + 1);
  grid->SetPoints(make_points(dump.points));
  add_arrays(grid->GetCellData(), dump, dump.cell_arrays, cells);
  add_arrays(grid->GetPointData(), dump, dump.point_arrays, nodes);
  add_facts(grid, dump, time);
  if (dump.section_layer > 0)
    add_strings(grid->GetFieldData(), "section_layer", {std::to_string(dump.section_layer)});
  vtkNew<vtkXMLStructuredGridWriter> writer;
  write_file(writer, grid, path);
}

void write_polygons(const fs::path& path, const GridDump& dump, double time) {
  const GridDump::Polygons& polygons = dump.material_polygons;
  const int vertices = std::accumulate(polygons.sizes.begin(), polygons.sizes.end(), 0);
  require_size(dump,
               "material polygons' points",
               polygons.points.size(),
               3 * static_cast<std::size_t>(vertices));
  require_size(
      dump, "material polygons' material", polygons.material.size(), polygons.sizes.size());
  vtkNew<vtkCellArray> faces;
  vtkIdType vertex = 0;
  for (int size : polygons.sizes) {
    faces->InsertNextCell(size);
    for (int v = 0; v < size; ++v)
      faces->InsertCellPoint(vertex++);
  }
  vtkNew<vtkIntArray> material;
  material->SetName("material");
  for (int m : polygons.material)
    material->InsertNextValue(m);
  vtkNew<vtkPolyData> set;
  set->SetPoints(make_points(polygons.points));
  set->SetPolys(faces);
  set->GetCellData()->SetScalars(material);
  add_arrays(set->GetCellData(), dump, polygons.arrays, polygons.sizes.size());
  add_facts(set, dump, time);
  vtkNew<vtkXMLPolyDataWriter> writer;
  write_file(writer, set, path);
}

void write_elements(const fs::path& path, const ElementDump& dump, double time) {
  if (dump.corners != 4 && dump.corners != 8)
    throw Error(fmt::format("dump of block '{}': elements have 4 or 8 corners, not {}", dump.block, dump.corners));
  const auto corners = static_cast<std::size_t>(dump.corners);
  const std::size_t nodes = dump.points.size() / 3, count = dump.elements.size() / corners;
  require_size(dump, "points", dump.points.size(), 3 * nodes);
  require_size(dump, "elements", dump.elements.size(), corners * count);
  vtkNew<vtkCellArray> cells;
  for (std::size_t e = 0; e < count; ++e) {
    cells->InsertNextCell(dump.corners);
    for (std::size_t c = 0; c < corners; ++c) {
      const int node = dump.elements[e * corners + c];
      if (node < 0 || static_cast<std::size_t>(node) >= nodes)
        throw Error(fmt::format("dump of block '{}': element {} has node {} of {}", dump.block, e, node, nodes));
      cells->InsertCellPoint(node);
    }
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(make_points(dump.points));
  grid->SetCells(dump.corners == 8 ? VTK_HEXAHEDRON : VTK_QUAD, cells);
  add_arrays(grid->GetCellData(), dump, dump.cell_arrays, count);
  add_arrays(grid->GetPointData(), dump, dump.point_arrays, nodes);
  add_facts(grid, dump, time);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  write_file(writer, grid, path);
}

std::string xml_escaped(const std::string& text) {
  std::string out;
  for (char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string file_name(const std::string& block) {
  std::string name = block.empty() ? "block" : block;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.')
      c = '_';
  return name;
}

} // namespace

std::vector<PvdEntry> read_pvd(const fs::path& path) {
  std::ifstream in(path);
  if (!in)
    throw Error(fmt::format("{}: cannot be read. Is this a run directory of `ballast run`?",
                            path.string()));
  static const std::regex pattern(R"re(<DataSet\s[^>]*timestep="([^"]*)"[^>]*file="([^"]*)")re");
  std::vector<PvdEntry> entries;
  std::smatch match;
  for (std::string line; std::getline(in, line);)
    if (std::regex_search(line, match, pattern)) {
      char* end = nullptr;
      const std::string number = match[1];
      const double time = std::strtod(number.c_str(), &end);
      if (number.empty() || *end != 0)
        throw Error(fmt::format("{}: timestep \"{}\" is not a number", path.string(), number));
      entries.push_back({time, match[2]});
    }
  return entries;
}

VtkSeries::VtkSeries(const fs::path& dir, const std::string& stem) : dir_(dir), stem_(stem) {}

void VtkSeries::keep_until(double time) {
  const fs::path path = dir_ / (stem_ + ".pvd");
  entries_.clear();
  if (!fs::exists(path))
    return;
  for (const PvdEntry& entry : read_pvd(path))
    if (entry.time <= time)
      entries_.push_back(entry);
  write_pvd();
}

int VtkSeries::next_index() const {
  if (entries_.empty())
    return 0;
  const std::string& file = entries_.back().file; // stem_0012.vtm
  return std::stoi(file.substr(stem_.size() + 1)) + 1;
}

void VtkSeries::write(double time, int index, const std::vector<GridDump>& dumps, const std::vector<ElementDump>& elements) {
  const std::string name = fmt::format("{}_{:04d}", stem_, index);
  fs::create_directories(dir_ / name);
  std::string blocks;
  for (std::size_t b = 0; b < dumps.size(); ++b) {
    const GridDump& dump = dumps[b];
    const std::string file = name + '/' + file_name(dump.block);
    write_grid(dir_ / (file + ".vts"), dump, time);
    blocks += fmt::format("    <Block index=\"{}\" name=\"{}\">\n"
                          "      <DataSet index=\"0\" name=\"cells\" file=\"{}.vts\"/>\n",
                          b,
                          xml_escaped(dump.block),
                          file);
    if (!dump.material_polygons.sizes.empty()) {
      write_polygons(dir_ / (file + "_materials.vtp"), dump, time);
      blocks += fmt::format(
          "      <DataSet index=\"1\" name=\"materials\" file=\"{}_materials.vtp\"/>\n", file);
    }
    blocks += "    </Block>\n";
  }
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::string file = name + '/' + file_name(elements[e].block);
    write_elements(dir_ / (file + ".vtu"), elements[e], time);
    blocks += fmt::format("    <Block index=\"{}\" name=\"{}\">\n"
                          "      <DataSet index=\"0\" name=\"elements\" file=\"{}.vtu\"/>\n"
                          "    </Block>\n",
                          dumps.size() + e,
                          xml_escaped(elements[e].block),
                          file);
  }
  write_text_atomically(
      dir_ / (name + ".vtm"),
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <vtkMultiBlockDataSet>\n" +
          blocks + "  </vtkMultiBlockDataSet>\n</VTKFile>\n");
  std::erase_if(entries_, [&](const PvdEntry& entry) { return entry.file == name + ".vtm"; });
  entries_.push_back({time, name + ".vtm"});
  write_pvd();
}

void VtkSeries::write_pvd() const {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
                     "byte_order=\"LittleEndian\">\n"
                     "  <Collection>\n";
  for (const PvdEntry& entry : entries_)
    text += fmt::format(
        "    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", entry.time, entry.file);
  write_text_atomically(dir_ / (stem_ + ".pvd"), text + "  </Collection>\n</VTKFile>\n");
}

} // namespace ballast::io
