// Where a cell is and where in it a point is, whatever the shape of its mesh.
#pragma once

#include "ale/block.hpp"

#include <array>

namespace ballast {

/// Lowest and highest node of a cell {i, j, k} along a coordinate, m.
template <int Dim> std::array<double, 2> node_range(const Block<Dim>& block, int component, const std::array<int, 3>& cell);

/// Weights along the axes, 0 to 1, of the place in a cell whose nodes' mean they make is nearest to `at` (Newton's method on the
/// multilinear map; outside the cell they are held to its sides).
template <int Dim>
std::array<double, Dim> place_in_cell(const Block<Dim>& block, const std::array<int, 3>& cell, const std::array<double, 3>& at);

} // namespace ballast
