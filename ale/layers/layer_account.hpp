// Energy account of a step of fabric layers, that of leapfrog: all work is done by the velocity that moves the nodes.
//
// Of a free component of a node, u the velocity that moved it in the step before (h_0) and v that of the step (h), J contact's impulse:
//   u = v_n - h_0/2 f_n/m,  v = v_n + h/2 f_n/m + J/m,  v_np1 = v + h/2 f_np1/m
//   K*       = m v_n^2/2 - h_0^2 f_n^2/(8 m)        leapfrog kinetic energy: m/2 times the velocities of the steps before and after
//   work     += -h/2 (f_n + f_np1).v                of elements, held modes and elastic edges
//   contact  += -J.(u + v)/2                        what is pressed and rests, or moves on evenly, loses nothing
//   change   += (h - h_0)/4 f_n.(v - u)             of the step's size; without contact K*(h_0) - K*(h)
// K* + work + contact + change keeps to round-off for any steps, forces and impulses. A held component has no velocity but perhaps one
// at the start, which goes to edge_loss. Booked by mean velocities of half kicks instead, surfaces that stay pressed would seem to
// lose energy each step that their elements seem to win: both parts without bound, right only in the sum.
#pragma once

#include "ale/layers/layer_stack.hpp"
#include "core/threads.hpp"

namespace ballast {

/// K* with the stack's last step, J. Before the first the plain kinetic energy.
template <int Dim> double leapfrog_kinetic(const LayerStack<Dim>& stack);

/// Work over `half` (s) at the stack's velocity, by the stresses of its last update_forces.
template <int Dim> void book_work(LayerStack<Dim>& stack, double half, LayerLedger& ledger, ThreadPool& pool);

/// Contact's and the step change's entries, once contact has changed the velocities that keep_velocity kept.
template <int Dim> void book_contact(const LayerStack<Dim>& stack, double dt, LayerLedger& ledger, ThreadPool& pool);

/// Keeps the velocities before contact for book_contact.
template <int Dim> void keep_velocity(LayerStack<Dim>& stack);

} // namespace ballast
