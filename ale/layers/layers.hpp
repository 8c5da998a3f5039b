// Layers: a stack of fabric layers in a scene, with its contacts and its account.
#pragma once

#include "ale/layers/layer_load.hpp"
#include "ale/layers/layer_step.hpp"
#include "ale/layers/slideline.hpp"

#include <vector>

namespace ballast {

/// Contact of a stack's layer with one of another stack.
template <int Dim> struct StackContact {
  int other = 0;                  ///< the other stack's number in the scene
  int layer = 0, other_layer = 0;
  ContactState<Dim> state;
};

template <int Dim> struct Layers {
  LayerStack<Dim> stack;
  LayerLedger ledger;
  ContactSettings contact; ///< between layers and with blocks
  double cfl = 0.7;        ///< of the wave step of its elements (stable_step)
  int substeps = 1;        ///< in a step of the scene, at least; as many as stability takes

  LayerLoad<Dim> load; ///< of a mesh that the stack lies in, during a step
  SlidelineState<Dim> slidelines;
  std::vector<char> above; ///< by block: does the stack lie above it, along the last axis, at the start?
  std::vector<ContactState<Dim>> with_blocks; ///< by block, side and layer, as ale/layer_coupling counts them
  std::vector<StackContact<Dim>> with_stacks; ///< with those of a higher number
  int debris = -1;                ///< material of the mesh around that torn cloth becomes (ale/embedding_debris), or none
  std::vector<double> whole_mass; ///< kg: of its nodes at the start, if it does
  double closing = 0;   ///< largest approach in a substep by a layer's thickness
  long steps = 0;       ///< substeps so far
  double seconds = 0, contact_seconds = 0; ///< s of the clock on the wall, this run: steps of the layers without contact; contact
};

} // namespace ballast
