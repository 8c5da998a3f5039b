// Section: what a picture shows of one dump. 2D blocks as they are (x, y) or (r, z); of 3D blocks
// the face of the lowest j (the plane y = 0), or of the dump's `section_layer`, drawn as (x, z): cell values from the layer above it,
// interfaces where the reconstructed planes of its mixed cells meet it. Of fabric layers the elements that are left; in 3D
// the faces that lay on y = 0 at rest.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace ballast::post {

using Corner = std::array<float, 2>; // m; float is plenty for a picture

struct SectionCell {
  std::array<Corner, 4> corners;
  float pressure = std::numeric_limits<float>::quiet_NaN(); // Pa
  float speed = std::numeric_limits<float>::quiet_NaN();    // m/s
  float damage = std::numeric_limits<float>::quiet_NaN();   // of fabric: the worse of warp and fill; 1 is rupture
  int material = unknown;
  int part = 0; // fabric layer, from 1; 0: none
  static constexpr int unknown = -2, none = -1;
};

struct SectionPolygon {
  std::vector<Corner> corners;
  int material;
};

/// Cells of one block and the parts of its mixed cells, which lie over them.
struct SectionBlock {
  std::string name;
  std::vector<SectionCell> cells;
  std::vector<SectionPolygon> polygons;
};

struct Section {
  double time = 0;
  std::string geometry;  // planar | axisymmetric | 3d
  bool mirrored = false; // the other half is the image at x = 0: axisymmetric, or 3D symmetric in x
  std::vector<std::string> material_names;
  std::vector<SectionBlock> blocks;
};

/// Reads a .vtm of the series. Throws Error naming the file.
Section read_section(const std::filesystem::path& vtm, double time);

} // namespace ballast::post
