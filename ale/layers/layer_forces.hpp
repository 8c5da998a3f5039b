// Forces of fabric layers: minus the derivative of the discrete internal work by the places of the nodes, total Lagrangian.
//
//   W = sum over elements V [ (w(E at the lower point) + w(E at the upper point))/2 + hourglass energy ]
// E as in ale/layers/layer_element, transverse strains the same at both points except for relief: where pressing in the plane
// pushes through the thickness (Hooke), E33 also varies linearly so that the moment of S33 vanishes; else one element through
// a bent layer is (1 - nu)^2/(1 - 2 nu) too stiff. Held modes: kappa C H^2/2 and a viscous part (LayerHourglass).
#pragma once

#include "ale/layers/layer_stack.hpp"
#include "core/threads.hpp"

namespace ballast {

/// Forces, stable steps and memory at the positions. First erodes (ale/layers/layer_erosion) what the update before found lost: it gives
/// no force from here on. dt: of the step that led here, smooths the rates some laws want. The same bits for any threads.
/// Throws NumericalFailure naming layer and element where a stress is not finite.
template <int Dim> void update_forces(LayerStack<Dim>& stack, double dt, LayerLedger& ledger, ThreadPool& pool);

} // namespace ballast
