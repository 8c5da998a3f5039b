// The parts of mixed cells as polygons, in the section that pictures show: a 2D block itself; of a 3D
// block the lower face along j of the cells with j = 0, which with symmetry in y is the plane y = 0. On a
// curvilinear mesh that goes round (a whole rod) of the cells whose lower face is nearest to that plane.
//
// A mixed cell's interfaces are those of the remap (onion-skin planes); of a 3D cell's planes the lines
// are drawn where they meet that face.
#pragma once

#include "ale/scene.hpp"
#include "core/io/vtk.hpp"

namespace ballast {

/// The layer of cells along j whose lower face is the section; 0 in 2D.
template <int Dim> int section_layer(const Block<Dim>& block);

/// Whether the cells of row r touch the section of that layer.
template <int Dim> bool in_section(const Grid& grid, int r, int layer) {
  return Dim == 2 || r % grid.cell_rows_per_plane() == grid.ghost[1] + layer;
}

template <int Dim> io::GridDump::Polygons section_polygons(const Block<Dim>& block, remap::NormalMethod normal);

} // namespace ballast
