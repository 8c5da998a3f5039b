// Erosion of fabric layers: holes where both families of yarns are lost, or either (LayerGuard::either).
#pragma once

#include "ale/layers/layer_stack.hpp"

#include <algorithm>
#include <array>

namespace ballast {

/// Erodes a layer where all its elements through the thickness have lost what it takes: it has a hole then, seen from both sides. lost_at: the Green
/// strains at which warp and fill are. Books what goes; its mass stays at its nodes.
template <int Dim> void erode(LayerStack<Dim>& stack, const std::array<double, 2>& lost_at, LayerLedger& ledger);

/// Has a layer lost an element?
template <int Dim> bool has_hole(const LayerStack<Dim>& stack, int layer) {
  const LayerGrid& g = stack.grid;
  const auto begin = stack.alive.begin() + static_cast<std::ptrdiff_t>(stack.element(0, 0, layer * g.through));
  return std::find(begin, begin + g.through * g.elements[0] * g.elements[1], 0) != begin + g.through * g.elements[0] * g.elements[1];
}

} // namespace ballast
