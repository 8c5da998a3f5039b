// Outflow: the normal velocity of boundary nodes beyond which the block is taken to go on unchanged.
//
// Waves leave along the outgoing characteristic, du/dt + (c + v) du/dx = 0 (x outwards; c the wave speed of the edge
// cell, v how fast the mesh's nodes are carried through the place they return to: the flow's own speed, nothing in a
// Lagrangian block): the node's new velocity is the one that stood (c + v) dt further in. With s = (c + v) dt / L and
// d1, d2 the differences outwards over the edge cell and over the one before,
//   u_N' = u_N - s (d1 + (1 - s)/2 (d1 - d2))          (Warming-Beam, second order),
// limited so that the new value stays between its neighbour's and its own. To first order this is a medium beyond
// with the edge cell's state, joined by its impedance: p_beyond = p_edge + rho c (u_N - u_edge). It knows no
// reference state, so any uniform flow passes, and no pressure is held in the long run. Waves at an angle a come
// back by (1 - cos a)/(1 + cos a), shear waves as from a frictionless wall; a shock is taken for a simple wave.
// R. L. Higdon, Math. Comp. 47 (1986) 437 (first-order condition). Only the start of the step enters.
#pragma once

#include "ale/scene.hpp"

#include <array>
#include <vector>

namespace ballast {

/// New velocity (m/s) along `axis` of boundary node (i, j, k) on side `side` (0 low, 1 high) after dt (s).
template <int Dim>
double outflow_velocity(const Block<Dim>& b, int axis, int side, const std::array<int, 3>& node, double dt);

struct OutflowNode {
  double mass, velocity; ///< kg; m/s along the side's axis
};

/// All nodes of outflow sides, and their velocities' return after a remap: the rule above counts what flows through
/// the mesh already, the remap's upwind mix would count it again. Mass that a node had not held brings its own
/// velocity. The momentum and energy this takes have left with the flow.
template <int Dim> std::vector<OutflowNode> outflow_nodes(const Block<Dim>& b);
template <int Dim> void hold_outflow(Block<Dim>& b, const std::vector<OutflowNode>& before, Ledger& ledger);

} // namespace ballast
