// Feet beyond the sides of a node's segment: a node that slides into a valley meets the next segment within the step.
#include "ale/layers/contact_parts.hpp"
#include "ale/layers/contact_vector.hpp"

namespace ballast {

namespace {

template <int Dim> using Surfaces = std::array<ContactSurface<Dim>*, 2>;

/// The segment turns towards the side that touches: there is a valley between it and the one that has this normal.
template <int Dim> bool rises(const ContactSurface<Dim>& b, int segment, std::array<int, 2> step, const std::array<double, 2>& local, const std::array<double, Dim>& normal) {
  const auto corner = b.corners_of(segment);
  const auto near = corner_shares<Dim>(local), far = corner_shares<Dim>({local[0] + step[0], local[1] + step[1]});
  double up = 0, square = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    double along = 0;
    for (std::size_t c = 0; c < corner.size(); ++c) {
      along += (far[c] - near[c]) * b.position[d][corner[c]];
    }
    up += along * normal[d];
    square += along * along;
  }
  return up > 0 && up * up > 1e-12 * square;
}

template <int Dim> void add_neighbour(const Surfaces<Dim>& surfaces, std::size_t s, int node, std::array<int, 2> step, ContactState<Dim>& state) {
  const ContactTrack<Dim>& t = state.tracks[s];
  const ContactSurface<Dim>&a = *surfaces[s], &b = *surfaces[1 - s];
  const auto n = static_cast<std::size_t>(node);
  const std::array<int, 2> at = {t.segment[n] % b.segments[0] + step[0], t.segment[n] / b.segments[0] + step[1]};
  const int segment = at[0] + at[1] * b.segments[0];
  if (at[0] < 0 || at[0] >= b.segments[0] || at[1] < 0 || at[1] >= (Dim == 3 ? b.segments[1] : 1) || !b.there(segment)) {
    return;
  }
  Foot<Dim> foot;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    foot.local[axis] = step[axis] == 0 ? t.local[n][axis] : step[axis] < 0 ? 1 : 0;
  }
  if (!rises<Dim>(b, segment, step, foot.local, t.normal_at(n))) {
    return;
  }
  foot = orthogonal_foot<Dim>(b, segment, a.place(node), foot);
  if (foot.found && dot(foot.normal, t.normal_at(n)) > -0.9) {
    const std::array<double, Dim> u = relative_velocity<Dim>(a, node, b, segment, foot.local);
    state.candidates.push_back({s, node, segment, foot.local, foot.normal, foot.gap, dot(u, foot.normal), false});
  }
}

template <int Dim> void add_neighbours(const Surfaces<Dim>& surfaces, std::size_t s, int node, ContactState<Dim>& state) {
  const unsigned bits = state.tracks[s].leaves[static_cast<std::size_t>(node)];
  const auto steps = [&](unsigned axis) { return std::array<int, 2>{(bits >> 2 * axis & 1) != 0 ? -1 : 0, (bits >> 2 * axis & 2) != 0 ? 1 : 0}; };
  const std::array<int, 2> first = steps(0), second = steps(1);
  for (int dj = second[0]; dj <= second[1]; ++dj) {
    for (int di = first[0]; di <= first[1]; ++di) {
      if (di != 0 || dj != 0) {
        add_neighbour<Dim>(surfaces, s, node, {di, dj}, state);
      }
    }
  }
}

} // namespace

template <int Dim> void find_neighbours(const std::array<ContactSurface<Dim>*, 2>& surfaces, ContactState<Dim>& state) {
  state.candidates.clear();
  for (std::size_t s = 0; s < 2; ++s) {
    const ContactTrack<Dim>& t = state.tracks[s];
    for (int node = 0; node < surfaces[s]->node_count(); ++node) {
      const auto n = static_cast<std::size_t>(node);
      if (t.status[n] == FootStatus::front && t.leaves[n] != 0) {
        add_neighbours<Dim>(surfaces, s, node, state);
      }
    }
  }
}

template void find_neighbours<2>(const std::array<ContactSurface<2>*, 2>&, ContactState<2>&);
template void find_neighbours<3>(const std::array<ContactSurface<3>*, 2>&, ContactState<3>&);

} // namespace ballast
