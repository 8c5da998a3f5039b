// Slidelines of a stack: each layer's upper plane of nodes against the next layer's lower one (ale/layers/contact).
//
// A layer has nodes of its own on both faces, so pairs share none: they are solved side by side, each in its own fixed order,
// and the sum is taken in the order of the pairs. Which side a layer lies on is known from the start: no layer passes another
// however fast, except through holes (eroded elements). Layers that meet through holes of those between them touch, too, one pair after
// the other once the neighbours are done: they share nodes with these.
#pragma once

#include "ale/layers/contact.hpp"
#include "ale/layers/layer_edges.hpp"
#include "ale/layers/layer_stack.hpp"

#include <type_traits>

namespace ballast {

/// By axis, of all nodes of the stack; Dim follows from the stack.
template <int Dim> using LayerVelocity = std::type_identity_t<std::array<std::vector<double>, Dim>>;

template <int Dim> struct LayerLoad;

/// Two layers that are no neighbours, and what their contact keeps.
template <int Dim> struct HoleContact {
  int lower = 0, upper = 0;
  ContactState<Dim> state;
};

template <int Dim> struct SlidelineState {
  std::vector<ContactState<Dim>> pairs; ///< neighbours, from the lowest
  std::vector<HoleContact<Dim>> holes;  ///< since every layer between the two has lost an element
  std::vector<unsigned char> held;      ///< by node of a plane
  long steps = 0;                       ///< counts to the next refresh
};

struct SlidelineReport {
  ContactReport contact;
  int deepest_pair = -1;      ///< lower layer of the pair with the deepest penetration
  double closing_share = 0;   ///< largest approach in the step by the thinner layer's thickness at rest: much below 1 in a sound step
};

/// The surface of a layer that faces up or down; `velocity`: the one that moves nodes in the step; `load`: what moves with them, or null.
template <int Dim>
ContactSurface<Dim> layer_surface(const LayerStack<Dim>& stack, LayerVelocity<Dim>& velocity, int layer, bool upper, const std::vector<unsigned char>& held,
                                  const LayerLoad<Dim>* load = nullptr);

/// Changes `velocity` (v + dt/2 a with a = force/mass, of all nodes) so that x + dt velocity has no layer inside its neighbour. A new `state`
/// takes every node to stand over the same node of its neighbour. Losses are those of the layers' account
/// (ale/layers/layer_account).
/// Same bits for any number of threads.
template <int Dim>
SlidelineReport resolve_slidelines(const LayerStack<Dim>& stack, double dt, LayerVelocity<Dim>& velocity, ThreadPool& pool, const ContactSettings& settings,
                                   SlidelineState<Dim>& state, const LayerLoad<Dim>* load = nullptr);

} // namespace ballast
