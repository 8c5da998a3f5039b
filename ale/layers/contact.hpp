// Contact of two surfaces by impulses on predicted positions: node to segment, both ways.
//
// For a node s with its foot on a segment (corners k, shares phi_k, normal n, gap g at the step's start; ale/layers/contact_track):
//   opening  c = n.(u_s - sum phi_k u_k), u = weight velocity + fixed, what moves a node in the step
//   asked    g + dt c >= 0; where g < 0: c >= min(push_out |g|/dt, max(0, -c before contact))
//   1/W      W = sum_d n_d^2 (w_s/m_s + sum phi_k^2 w_k/m_k)
//   impulse  lambda = max(0, lambda + (asked - c)/W): n lambda on the node, -phi_k n lambda on the corners
// by Gauss-Seidel in the order of the nodes, lambda the step's total: what an earlier sweep gave too much is taken back.
// Impulses are equal, opposite and along the line through node and foot: momentum and angular momentum stay to round-off.
// Energy: the loss is -sum J.(v_old + v_new)/2. v_old is the velocity before contact, so the loss is that of kinetic energy on
// the spot: lambda W lambda / 2 - lambda.c >= 0 where only gaps are asked for. Given velocity_n or force it is the velocity with which the
// step before ended, and the loss is what a ledger of stress work (by mean velocities, or by the trapezoidal rule of velocity-Verlet)
// has to find: a surface that is pressed and rests then loses nothing.
// Penetration is pushed out at most as fast as the surfaces came together, and only with energy that the pair's contact took
// before: a step that would give back more than that is done again without pushing.
// Coulomb friction, static = kinetic: a total of at most mu lambda along the surface.
#pragma once

#include "ale/layers/contact_point.hpp"
#include "ale/layers/contact_track.hpp"
#include "core/threads.hpp"

namespace ballast {

struct ContactSettings {
  double friction = 0;     ///< Coulomb's coefficient
  double push_out = 0.3;   ///< share of a penetration taken back in a step
  int sweeps = 100;        ///< of Gauss-Seidel at most, each round
  int rounds = 8;          ///< at most: sweeps, then nodes that were driven into contact join
  int refresh = 8;         ///< every so many steps all feet are found anew
  double tolerance = 1e-4; ///< of the step's largest violation: sweeps end below
};

/// What a step's contact did.
struct ContactReport {
  double loss = 0;          ///< J: energy lost, friction's part too
  double friction_loss = 0; ///< J: of that, by friction
  double deepest = 0;       ///< m: largest penetration at the step's start
  std::array<double, 3> deepest_at = {0, 0, 0}; ///< m
  double closing = 0;       ///< m: largest approach in the step of a node that would have gone inside
  double violation = 0;     ///< m: what the last sweep still had to correct at most
  long behind = 0;          ///< nodes inside that came in past an edge or through a hole: no contact, not in `deepest`
  long active = 0;          ///< nodes with an impulse
  int sweeps = 0;
  std::array<double, 3> impulse_sum = {0, 0, 0}; ///< N s: given by what holds nodes along an axis (ContactSurface::held); zero without
  double impulse = 0;       ///< N s: sum of lambda
};

/// Adds what another pair did: sums, largest values.
void add_report(ContactReport& to, const ContactReport& part);

/// What contact keeps from step to step (tracks[s]: nodes of surface s; counters) and its work arrays.
template <int Dim> struct ContactState {
  std::array<ContactTrack<Dim>, 2> tracks;
  double travel = 0; ///< m: the surfaces' movement since nodes that are away were looked for
  long steps = 0;    ///< counts to the next refresh
  double taken = 0;  ///< J: lost so far without friction

  std::array<std::array<std::vector<double>, Dim>, 2> before; ///< velocities
  std::array<std::vector<char>, 2> touched, listed;
  std::vector<ContactPoint<Dim>> points;
  std::vector<ContactCandidate<Dim>> candidates; ///< beyond the sides of nodes' segments

  TrackPair<Dim> seen_from(std::size_t s, const std::array<ContactSurface<Dim>*, 2>& surfaces, double dt) const {
    return {*surfaces[s], *surfaces[1 - s], dt};
  }
  void resize(const std::array<const ContactSurface<Dim>*, 2>& surfaces);
};

/// Changes velocities so that neither surface goes inside the other in the step, or deeper than it is. Any two surfaces; the
/// same bits for any pool (none: this thread). Kernels do not throw: surfaces are checked when the state is new.
template <int Dim>
ContactReport resolve_contact(ContactSurface<Dim>& a, ContactSurface<Dim>& b, double dt, const ContactSettings& settings, ContactState<Dim>& state, ThreadPool* pool = nullptr);

/// The last part of it, once tracks are those of the step: missing feet, impulses, report.
template <int Dim> ContactReport solve_contact(const std::array<ContactSurface<Dim>*, 2>& surfaces, double dt, const ContactSettings& settings, ContactState<Dim>& state);

} // namespace ballast
