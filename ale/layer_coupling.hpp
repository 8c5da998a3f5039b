// Fabric layers in the step of a scene: their substeps, and their contact with each other and with the free sides of blocks.
#pragma once

#include "ale/scene.hpp"

namespace ballast {

/// Forces and stable steps of the layers at the start of a run.
template <int Dim> void prepare_layers(Scene<Dim>& scene);

/// Moves all layers through the step dt, after the blocks' forces and before their cells move: contact changes next_velocity and
/// next_position of the blocks' free sides. What that takes from kinetic energy is in the layers' ledger.
template <int Dim> void step_layers(Scene<Dim>& scene, double dt);

/// The largest step that the layers allow a scene without blocks.
template <int Dim> DtLimit stable_dt_of_layers(const Scene<Dim>& scene);

} // namespace ballast
