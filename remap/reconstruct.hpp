// The interfaces inside one mixed cell: onion-skin planes from the fractions around it.
#pragma once

#include "core/grid.hpp"
#include "core/tile_store.hpp"
#include "remap/onion.hpp"

#include <span>

namespace ballast::remap {

inline constexpr int most_materials = 16; ///< in one cell

template <int Dim> struct Reconstruction {
  int count = 0;               ///< materials in the cell
  int present[most_materials]; ///< which, in priority order
  Interface<Dim> planes[most_materials]; ///< count - 1
};

/// Stores hold volume fractions as field 0, ghosts filled. Cell i of row r.
template <int Dim>
Reconstruction<Dim> reconstruct_cell(const Grid& grid, std::span<const TileStore* const> stores, NormalMethod method, int r, int i);

} // namespace ballast::remap
