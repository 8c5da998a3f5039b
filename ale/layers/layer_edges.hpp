// Edges of fabric layers: held components of velocity, springs in the plane, and their books.
#pragma once

#include "ale/layers/layer_stack.hpp"

namespace ballast {

/// Adds the springs' forces at the positions and shortens the steps of the elements they hold.
template <int Dim> void add_edge_forces(LayerStack<Dim>& stack);

/// After a half kick over `half` (s) by `force`: holds velocity and mean_velocity, books impulse, work and loss.
template <int Dim> void hold_edges(LayerStack<Dim>& stack, double half, LayerLedger& ledger);

} // namespace ballast
