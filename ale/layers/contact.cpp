#include "ale/layers/contact.hpp"

#include "ale/layers/contact_parts.hpp"
#include "ale/layers/contact_search.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

template <int Dim> using Surfaces = std::array<ContactSurface<Dim>*, 2>;

template <int Dim> double largest_speed(const ContactSurface<Dim>& s) {
  double fastest = 0;
  for (int n = 0; n < s.node_count(); ++n) {
    double now = 0, fixed = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      now += s.velocity[d][n] * s.velocity[d][n];
      fixed += s.fixed_at(d, n) * s.fixed_at(d, n);
    }
    fastest = std::max(fastest, s.weight * std::sqrt(now) + std::sqrt(fixed));
  }
  return fastest;
}

/// Looks for feet that were lost in this step, and for all that are away when the surfaces have moved enough.
template <int Dim> void search_missing(const Surfaces<Dim>& surfaces, double dt, ContactState<Dim>& state) {
  std::array<bool, 2> lost = {false, false}, away = {false, false};
  for (std::size_t s = 0; s < 2; ++s) {
    for (const FootStatus status : state.tracks[s].status) {
      lost[s] = lost[s] || status == FootStatus::lost;
      away[s] = away[s] || status == FootStatus::away;
    }
  }
  if (!(lost[0] || lost[1] || away[0] || away[1])) {
    return;
  }
  state.travel += dt * (largest_speed(*surfaces[0]) + largest_speed(*surfaces[1]));
  const bool due = state.travel > std::min(search_again_after(*surfaces[0]), search_again_after(*surfaces[1]));
  state.travel = due ? 0 : state.travel;
  for (std::size_t s = 0; s < 2; ++s) {
    if (lost[s] || (due && away[s])) {
      search_feet(state.seen_from(s, surfaces, dt), due, state.tracks[s]);
    }
  }
}

} // namespace

void add_report(ContactReport& to, const ContactReport& part) {
  to.loss += part.loss;
  to.friction_loss += part.friction_loss;
  if (part.deepest > to.deepest) {
    to.deepest = part.deepest;
    to.deepest_at = part.deepest_at;
  }
  to.closing = std::max(to.closing, part.closing);
  to.violation = std::max(to.violation, part.violation);
  to.active += part.active;
  to.behind += part.behind;
  to.sweeps = std::max(to.sweeps, part.sweeps);
  to.impulse += part.impulse;
  for (std::size_t d = 0; d < 3; ++d) {
    to.impulse_sum[d] += part.impulse_sum[d];
  }
}

template <int Dim> void ContactState<Dim>::resize(const std::array<const ContactSurface<Dim>*, 2>& surfaces) {
  for (std::size_t s = 0; s < 2; ++s) {
    const auto n = static_cast<std::size_t>(surfaces[s]->node_count());
    if (tracks[s].status.size() != n) {
      check_surface(*surfaces[s], s == 0 ? "first" : "second");
    }
    tracks[s].resize(surfaces[s]->node_count());
    touched[s].resize(n);
    listed[s].resize(n);
    for (std::vector<double>& c : before[s]) {
      c.resize(n);
    }
  }
}

template <int Dim> ContactReport solve_contact(const Surfaces<Dim>& surfaces, double dt, const ContactSettings& settings, ContactState<Dim>& state) {
  search_missing(surfaces, dt, state);
  return apply_impulses<Dim>(surfaces, dt, settings, state);
}

template <int Dim>
ContactReport resolve_contact(ContactSurface<Dim>& a, ContactSurface<Dim>& b, double dt, const ContactSettings& settings, ContactState<Dim>& state, ThreadPool* pool) {
  state.resize({&a, &b});
  const Surfaces<Dim> surfaces = {&a, &b};
  const auto over = [&](int count, auto&& body) {
    if (pool == nullptr) {
      body(0, count, 0);
    } else {
      parallel_ranges(*pool, count, body);
    }
  };
  const bool refresh = state.steps++ % settings.refresh == 0;
  for (std::size_t s = 0; s < 2; ++s) {
    over(surfaces[s]->node_count(), [&](int begin, int end, int) {
      track_nodes(state.seen_from(s, surfaces, dt), {begin, end}, refresh, state.tracks[s]);
    });
  }
  return solve_contact(surfaces, dt, settings, state);
}

#define BALLAST_INSTANTIATE(D)                                                                                                   \
  template struct ContactState<D>;                                                                                               \
  template ContactReport solve_contact<D>(const std::array<ContactSurface<D>*, 2>&, double, const ContactSettings&, ContactState<D>&); \
  template ContactReport resolve_contact<D>(ContactSurface<D>&, ContactSurface<D>&, double, const ContactSettings&, ContactState<D>&, ThreadPool*);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
