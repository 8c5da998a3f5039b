// Rest: what a step would leave as it is, bit for bit, and so may sleep (core/awake.hpp).
//
// A cell is restless if a node of it moves (or is not where the next remap brings it), if it presses or pulls on its
// nodes (gauge pressure or deviator not zero; void, whose nodes have no mass, may press), if it holds viscoelastic free energy, or if it is mixed and the closure,
// heat conduction, the remap's round-off of fractions or a closing void would change it. All else the step returns as it
// was, whatever dt and whichever axis is swept first.
// Tiny velocities would keep everything awake: ahead of a wave they fall off with distance but never end, and spread a
// cell or more a step through viscosity, six times as fast as sound in the main scene. What is slower than a few ulp of
// the sound speed is held at rest, as by a wall: momentum and energy go where a wall's do, in the ledger.
#pragma once

#include "ale/lagrange_parts.hpp"
#include "ale/scene.hpp"

namespace ballast {

/// Speed (m/s) below which a block's nodes rest: a few ulp of its slowest material's sound speed at the start.
template <int Dim> double still_speed_of(const Block<Dim>& block);

/// Holds at rest what is slower in node row (j, k), jumps between two velocities included, after a Lagrangian step.
template <int Dim> void hold_still(Block<Dim>& block, int node_row, BoundaryEffect& effect);

/// The same after a remap, all awake nodes.
template <int Dim> void hold_still(Block<Dim>& block, ThreadPool& pool, Ledger& ledger);

/// Finds what is awake in the next step, at the end of this one. Blocks that follow something or are fed stay awake.
template <int Dim> void follow_rest(Scene<Dim>& scene, Block<Dim>& block, bool remapped);

} // namespace ballast
