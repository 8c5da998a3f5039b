// Absorbing sides (Lysmer and Kuhlemeyer, J. Eng. Mech. Div. ASCE 95 (1969) 859): beyond them stands more of the edge cell's
// matter, at rest and at the reference pressure. Its traction on the boundary is -rho c v_n along the normal and -rho c_s v_t
// across, which takes waves that arrive head on whole; at 45 degrees 17 % of a pressure wave come back. With mean velocities:
//   m (v' - u) / dt = F - Z (u + v') / 2,  Z = sum A (rho c n n^T + rho c_s (1 - n n^T)),
// so that the work of the traction is known exactly and no step is too long.
#pragma once

#include "ale/lagrange_parts.hpp"

namespace ballast {

/// Adds the tractions of absorbing sides at the nodes of row (j, k): to next_velocity, and to the row's `force` (N) their mean
/// over the step.
template <int Dim> void absorb_row(Block<Dim>& b, int j, int k, double dt, double* const (&force)[Dim], BoundaryEffect& effect);

/// That mean (N) on one node, by the velocities as absorb_row left them; zero where nothing absorbs.
template <int Dim> std::array<double, Dim> absorbing_force(const Block<Dim>& b, const std::array<int, 3>& node);

} // namespace ballast
