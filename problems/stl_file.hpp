// STL files, text and binary: a list of facets without units.
//
// Binary: 80 bytes of anything, the count as uint32, then 50 bytes a facet (normal and three
// vertices as float32, two bytes of anything), little-endian. The normals are not used: the order
// of the vertices says which way a facet faces.
#pragma once

#include "problems/facet_mesh.hpp"

#include <string>
#include <vector>

namespace ballast {

struct StlFile {
  std::vector<Facet> facets; ///< m
  std::string checksum;      ///< of the file's bytes: FNV-1a 64 bit, 16 hexadecimal digits
  std::string problem;       ///< empty: read well; else with the line (text) or the byte counts
};

/// `scale`: metres in a unit of the file. Float32 coordinates are read as the shortest decimal
/// number that they stand for: 12.7 in the file is 12.7 in the deck, to the last bit.
StlFile read_stl(const std::string& path, double scale);

} // namespace ballast
