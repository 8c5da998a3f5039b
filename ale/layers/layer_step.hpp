// The time step of fabric layers, velocity Verlet in phases between which contact may act:
//   kick   v_half = v + dt/2 f/m          at the positions of the forces
//          contact changes v_half here
//   drift  x += dt v_half
//   update_forces (ale/layers/layer_forces)
//   kick   v = v_half + dt/2 f/m
// Work is booked at v_half after contact with the forces at both ends of the drift (ale/layers/layer_account):
// leapfrog_kinetic + internal + hourglass + shock_heat of the totals and edge_work + edge_loss + contact_loss + step_change - load_work of the
// ledger keep to round-off for any steps. Positions and velocities are those of velocity Verlet; only the account is that of leapfrog.
#pragma once

#include "ale/layers/layer_forces.hpp"
#include "ale/layers/layer_load.hpp"

#include <functional>

namespace ballast {

/// The step an explicit step of the stack may take, and the element that limits it.
struct LayerTimestep {
  double dt = 0;
  std::size_t element = 0;
  int i = 0, j = 0, level = 0;
};

/// cfl times the smallest wave_step; infinite when all elements have eroded. update_forces comes before. Above 0.7
/// three or four modes of thickness can be in resonance with the step (angles that sum to a turn) and grow without end, and the
/// lagging hourglass viscosity feeds the fastest of them: seen after ten thousand steps of strong noise at 0.8, not at 0.7.
template <int Dim> LayerTimestep stable_step(const LayerStack<Dim>& stack, double cfl = 0.7);

/// Half a kick: velocities by half (s) of force/mass, edges held and their impulse booked.
template <int Dim> void kick(LayerStack<Dim>& stack, double half, LayerLedger& ledger, ThreadPool& pool);

/// x += dt v.
template <int Dim> void drift(LayerStack<Dim>& stack, double dt, ThreadPool& pool);

/// Around an axis: rings do not pass it. Takes the inward velocity that would bring a node below a hundredth of its radius in the step:
/// where cloth has no strength when pressed in its plane nothing else does, and elements would turn inside out. An impact: contact_loss.
template <int Dim> void stop_at_axis(LayerStack<Dim>& stack, double dt);

/// The step up to contact: the first kick, and edges that would fold. `load` is on the stack (ale/layers/layer_load).
template <int Dim> void begin_substep(LayerStack<Dim>& stack, double dt, LayerLedger& ledger, ThreadPool& pool, LayerLoad<Dim>* load = nullptr);

/// The step from contact on.
template <int Dim> void end_substep(LayerStack<Dim>& stack, double dt, LayerLedger& ledger, ThreadPool& pool, LayerLoad<Dim>* load = nullptr);

/// One step of all phases of a stack alone; contact() is called between the first kick and the drift.
template <int Dim> void substep(LayerStack<Dim>& stack, double dt, LayerLedger& ledger, ThreadPool& pool, const std::function<void()>& contact = {}, LayerLoad<Dim>* load = nullptr);

/// Sums over nodes and elements, in their order. Around an axis momentum is along it only, and has no moment.
struct LayerTotals {
  double mass = 0;
  double kinetic = 0;                 ///< J: m v^2/2 of the velocities at the time of the positions
  double internal = 0, hourglass = 0; ///< J: work of the elements' stresses; of their stabilisation, its viscous heat too
  double shock_heat = 0;              ///< J: of the artificial viscosity
  std::array<double, 3> momentum = {}, angular_momentum = {}; ///< in a plane the moment stands in [2]
  double leapfrog_kinetic = 0;        ///< J: that of the account (ale/layers/layer_account); (step x frequency)^2/4 of a wave's energy away from `kinetic`
  /// Of internal energy: to be below 5 %.
  double hourglass_share() const { return internal > 0 ? hourglass / internal : 0.0; }
};
template <int Dim> LayerTotals totals(const LayerStack<Dim>& stack);

} // namespace ballast
