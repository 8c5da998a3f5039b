// Volume fractions and volumes of the cells of a curvilinear starting mesh (core/mesh_map).
//
// A cell is what the map makes of the box lo..hi of logical coordinates, its sides curved: a body whose surface is a mesh
// surface (a shell on a polar mesh) fills its cells exactly. Where a surface cuts a cell, lines are cast along the logical
// axis that meets surfaces most often, cut where their owner changes, and weighted with the Jacobian of the map (axisymmetric: times r).
// The error is below 2e-3 of a cell for surfaces smooth on the cell's scale; layers thinner than 1/16 of a cell may be missed.
// The fraction is then taken of the cell with straight edges that the block has: a body that cuts cells is off in volume by its share of
// their sides' bulges, second order in the cell.
#pragma once

#include "core/mesh_map.hpp"
#include "problems/shapes.hpp"

#include <span>

namespace ballast {

/// Shares (0 to 1) of the mapped cell lo..hi (logical coordinates) that each shape shows, as visible_fractions.
void mapped_fractions(std::span<const Shape* const> shapes, const MeshMap& map, Geometry geometry, const Point& lo, const Point& hi, std::span<double> shares);

/// Volume of the cell with straight edges between its mapped corners; as the block has it (m3; planar: by metre of depth).
double mapped_cell_volume(const MeshMap& map, Geometry geometry, const Point& lo, const Point& hi);

/// Shortest edge of that cell, m.
double mapped_cell_size(const MeshMap& map, Geometry geometry, const Point& lo, const Point& hi);

} // namespace ballast
