// A mesh that goes with the material and is smoothed on the way: each remap brings it from where the Lagrangian steps left it
// nearer to a mesh whose displacement u from the initial one is harmonic in the block's indices.
//
// Sweeps of u <- (u + mean of u over the neighbours) / 2, the mean along an axis weighted by 1 / distance in the initial mesh:
// a mesh that was stretched, sheared or turned as a whole is left alone, however graded it is. A half damps a checkerboard in
// one sweep. On sectors (polar, cylindrical, spherical) u is taken along and across the radius instead: there a contraction or a turn
// about the centre is what is left alone. Boundary nodes stay where the material took them, or at their initial places (`fixed_boundary`); along a
// symmetry plane or a wall they slide and are smoothed within it.
#pragma once

#include "ale/block.hpp"

namespace ballast {

/// Sets low_weight from home.
template <int Dim> void weigh_neighbours(Block<Dim>& block);

/// Brings target from position on to a smoothed mesh. Nodes of cells that this would turn inside out, or bring near it, stay where they are; so do
/// those of cells that it would make as thin as the thinnest there is and thinner than 0.7 of their own initial thickness: they would set the step.
template <int Dim> void relax_target(Block<Dim>& block, ThreadPool& pool);

} // namespace ballast
