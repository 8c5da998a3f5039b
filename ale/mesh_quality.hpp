// Quality of a mesh: how far its cells' shapes are from those of another mesh, mean ratio of the map between them.
//
// At each corner of a cell the edges A (columns) are those R of the reference mesh, mapped by T = A R^-1; its quality is
//   q = d det(T)^(2/d) / |T|_F^2,
// 1 where T is a rotation times a scale, falling to 0 as the corner collapses (a stretch by s against the rest: 2 / (s + 1/s) in
// 2D), below 0 where it has turned inside out. P. Knupp, Algebraic mesh quality metrics, SIAM J. Sci. Comput. 23 (2001).
#pragma once

#include "core/grid.hpp"
#include "core/threads.hpp"

#include <array>

namespace ballast {

/// Quality of each cell of row (j, k), the least of its corners, against the reference mesh.
void row_quality(const Grid& grid, const std::array<RowField, 2>& mesh, const std::array<RowField, 2>& reference, int j, int k, double* quality);
void row_quality(const Grid& grid, const std::array<RowField, 3>& mesh, const std::array<RowField, 3>& reference, int j, int k, double* quality);

/// Thickness (m) of each cell of row (j, k): content of the box of its mid lines by the largest of that box's sides, about what the step may cross in
/// it; below 0 where it has turned inside out. In RZ of the meridian plane.
template <int Dim> void row_thickness(const Grid& grid, const std::array<RowField, Dim>& mesh, int j, int k, double* thickness);

/// Thickness of the thinnest cell, m.
template <int Dim> double least_thickness(const Grid& grid, const std::array<RowField, Dim>& mesh, ThreadPool& pool);

/// Least quality of the mesh's corners against the reference mesh. In RZ of the meridian plane.
template <int Dim>
double mesh_quality(const Grid& grid, const std::array<RowField, Dim>& mesh, const std::array<RowField, Dim>& reference, ThreadPool& pool);

/// How far the farthest node is from where the reference mesh has it, in lengths of that mesh's cells along the way.
template <int Dim>
double largest_stray(const Grid& grid, const std::array<RowField, Dim>& mesh, const std::array<RowField, Dim>& reference, ThreadPool& pool);

} // namespace ballast
