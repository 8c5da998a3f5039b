// What linear and quasi-linear tissue relaxes until the half step, for the forces there.
//
// The forces take s + G dt dev D, all at the half step (ale/corner_force). Of a branch with time tau, x = dt/2tau, exactly:
//   s_i(dt/2) = exp(-x) s_i + G_i (1 - exp(-x))/x dt dev D;   Fung: q_i(dt/2) = q_i + (1 - exp(-x)) (s_e - q_i).
// So the stress of pure cells is less by what relaxes and their modulus by what relaxes as it is strained: for tau far below dt the sum
// is the viscosity G tau. Mixed cells and laws whose rate depends on the stress relax in forces half a step late.
#pragma once

#include "ale/scene.hpp"

namespace ballast {

/// Sets stress and shear modulus of pure cells of awake Prony and Fung tissue for the forces of a step of dt, from its state at the
/// step's start; the next update_state sets them back.
template <int Dim> void relax_to_half(Scene<Dim>& scene, double dt);

} // namespace ballast
