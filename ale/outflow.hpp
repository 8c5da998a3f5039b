// Outflow: the velocity of a boundary node beyond which the block is taken to go on unchanged.
//
// Waves leave along the outgoing characteristic, du/dt + c du/dx = 0 in the material (x outwards, c the wave
// speed of the edge cell): the node's new normal velocity is the one that stood c dt further in. With s = c dt / L
// and d1, d2 the differences outwards over the edge cell and over the one before,
//   u_N' = u_N - s (d1 + (1 - s)/2 (d1 - d2))          (Warming-Beam, second order),
// limited so that the new value stays between its neighbour's and its own. This is the transmitting condition
// p_outside = p_edge + rho c (u_N - u_edge) carried to second order; it knows no reference state, so any uniform
// flow passes. Waves at an angle a come back by (1 - cos a)/(1 + cos a), shear waves as from a frictionless wall.
// R. L. Higdon, Math. Comp. 47 (1986) 437 (first-order condition); only velocities at the start of the step enter.
#pragma once

#include "ale/scene.hpp"

#include <vector>

namespace ballast {

/// New velocity (m/s) along `axis` of boundary node (i, j, k) on side `side` (0 low, 1 high) after dt (s).
template <int Dim> double outflow_velocity(const Block<Dim>& b, int axis, int side, const std::array<int, 3>& node, double dt);

/// Normal velocities of all outflow nodes, and their return after a remap: the rule above counts what flows through
/// the mesh already, the remap's own upwind mix would count it again. What that takes goes out with the flow.
template <int Dim> std::vector<double> outflow_velocities(const Block<Dim>& b);
template <int Dim> void hold_outflow(Block<Dim>& b, const std::vector<double>& wanted, Ledger& ledger);

} // namespace ballast
