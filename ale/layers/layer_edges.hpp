// Edges of fabric layers: held components of velocity, springs in the plane, and their books.
#pragma once

#include "ale/layers/layer_stack.hpp"

namespace ballast {

/// Adds the springs' forces at the positions and shortens the steps of the elements they hold.
template <int Dim> void add_edge_forces(LayerStack<Dim>& stack);

/// After a half kick over `half` (s) by `force`: holds the velocity, books impulse and loss.
template <int Dim> void hold_edges(LayerStack<Dim>& stack, double half, LayerLedger& ledger);

/// Books the springs' work over `half` (s) at the velocity.
template <int Dim> void book_springs(const LayerStack<Dim>& stack, double half, LayerLedger& ledger);

/// By node of a plane: axes along which the stack's edges let it have no velocity.
template <int Dim> std::vector<unsigned char> held_nodes(const LayerStack<Dim>& stack);

} // namespace ballast
