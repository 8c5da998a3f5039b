// Folds finer than an element: cloth pressed in its plane has no strength (materials/fabric), so an element would close and turn
// inside out, and its surfaces with it. Its edges, where there is cloth beside them, stop at LayerGuard::shortest of their length at rest, where cloth that lies in
// folds would be solid: impulses along the edge take what closes it further. Inelastic; momentum and moment are kept.
#pragma once

#include "ale/layers/layer_stack.hpp"
#include "core/threads.hpp"

#include <vector>

namespace ballast {

template <int Dim> struct LayerLoad;

/// Changes velocities so that no edge in the plane of a layer closes below its shortest length in a step of dt (s); one that is
/// shorter closes no further. `held` as of held_nodes; what held nodes take goes to the ledger's edge_impulse. `load`: what moves with nodes, or null. The same bits for any pool.
template <int Dim>
void stop_folds(LayerStack<Dim>& stack, double dt, const std::vector<unsigned char>& held, LayerLedger& ledger, ThreadPool& pool, const LayerLoad<Dim>* load = nullptr);

} // namespace ballast
