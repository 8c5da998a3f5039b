// The VTK time series of a run: stem.pvd -> stem_0000.vtm (named blocks) -> stem_0000/BLOCK.vts
// with, where cells are mixed, stem_0000/BLOCK_materials.vtp; of fabric layers stem_0000/STACK.vtu. Inline binary with lz4; never
// appended XML (Debian's ParaView 5.11 reads no cells from it). Every file opens in ParaView.
//
// Names that post/report looks for: cell arrays "pressure" [Pa], "speed" [m/s] (cell or point) and
// "material" (cell; the index into material_names of the material the cell is drawn as, -1 for
// void). Polygons are drawn over the cells, so only mixed cells need them. Of an element dump in 3D pictures show
// the lower face along j of the elements whose cell array "section" is 1, and "damage_warp", "damage_fill" [1].
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace ballast::io {

/// One block at one time, ready to be written. Plain data, filled by the observer.
struct GridDump {
  struct Array {
    std::string name;
    int components = 1;
    std::vector<float> values; // entity by entity, components fastest
  };
  /// The parts of mixed cells as polygons: in 2D (x, y, 0), RZ (r, z, 0); in 3D only those of the
  /// section that pictures show, the lower face along j of the cells with j = 0.
  struct Polygons {
    std::vector<double> points; // 3 per vertex, polygon by polygon
    std::vector<int> sizes;     // vertices of each polygon
    std::vector<int> material;  // of each polygon
    std::vector<Array> arrays;  // more values of each polygon
  };

  std::string block;
  std::string geometry = "planar"; // planar | axisymmetric | 3d
  std::vector<std::string>
      symmetry;               // axes (x, y, z) at whose 0 the rest is the mirror image; 3D only
  int section_layer = 0;      // 3D: layer along j whose lower face pictures show
  std::array<int, 3> cells{}; // cells[2] = 0 in 2D
  std::vector<double> points; // 3 per node, i fastest
  std::vector<Array> cell_arrays, point_arrays;
  Polygons material_polygons;              // may be empty
  std::vector<std::string> material_names; // legend: names[material]
};

/// Elements of which some may be gone, at one time: quads (2D) or hexahedra, corners in VTK's order.
struct ElementDump {
  std::string block;
  std::string geometry = "planar";         // planar | axisymmetric | 3d
  std::vector<std::string> symmetry;       // as of GridDump
  std::vector<double> points;              // 3 per node
  int corners = 4;                         // of an element: 4 or 8
  std::vector<int> elements;               // nodes of each, corners by corners
  std::vector<GridDump::Array> cell_arrays, point_arrays;
  std::vector<std::string> material_names; // legend: names[material]
};

/// One time of a series; `file` is relative to the folder of the .pvd.
struct PvdEntry {
  double time;
  std::string file;
};

/// The times listed in a .pvd, in order. Throws Error if it cannot be read.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

class VtkSeries {
public:
  /// A new, empty series dir/stem.pvd. Nothing is written before the first write().
  VtkSeries(const std::filesystem::path& dir, const std::string& stem);

  /// After a restart: goes on with the series on disc, keeping its times <= `time`.
  void keep_until(double time);

  /// Index after the last time of the series (0 when empty).
  int next_index() const;

  /// Writes every block, then the elements, the .vtm and, last, the .pvd. Throws Error on wrong array lengths (naming
  /// block and array) and on files that cannot be written.
  void write(double time, int index, const std::vector<GridDump>& dumps, const std::vector<ElementDump>& elements = {});

private:
  void write_pvd() const;

  std::filesystem::path dir_;
  std::string stem_;
  std::vector<PvdEntry> entries_;
};

} // namespace ballast::io
