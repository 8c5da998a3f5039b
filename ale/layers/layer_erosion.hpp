// Erosion of fabric layers: holes where both families of yarns are lost, or either (LayerGuard::either).
#pragma once

#include "ale/layers/layer_stack.hpp"

#include <array>

namespace ballast {

/// Erodes a layer where all its elements through the thickness have lost what it takes: it has a hole then, seen from both sides. lost_at: the Green
/// strains at which warp and fill are. Books what goes; its mass stays at its nodes.
template <int Dim> void erode(LayerStack<Dim>& stack, const std::array<double, 2>& lost_at, LayerLedger& ledger);

} // namespace ballast
