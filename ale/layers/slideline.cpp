#include "ale/layers/slideline.hpp"

#include "ale/layers/layer_erosion.hpp"
#include "ale/layers/layer_load.hpp"

#include <algorithm>

namespace ballast {

namespace {

constexpr double layer_rim = 0.5; ///< layers' edges lie over each other: past one, the next still must not dip below it

/// Every node's foot at the node with its own number.
template <int Dim> void start_track(const ContactSurface<Dim>& s, ContactTrack<Dim>& track) {
  const int n = s.nodes_along(0);
  for (int node = 0; node < s.node_count(); ++node) {
    const int i = node % n, j = node / n;
    const int si = std::min(i, s.segments[0] - 1), sj = Dim == 3 ? std::min(j, s.segments[1] - 1) : 0;
    const auto at = static_cast<std::size_t>(node);
    track.status[at] = FootStatus::front;
    track.segment[at] = sj * s.segments[0] + si;
    track.local[at] = {static_cast<double>(i - si), static_cast<double>(j - sj)};
  }
}

/// Adds the pairs of layers that can meet by now, between which every layer has a hole.
template <int Dim> void find_holes(const LayerStack<Dim>& stack, std::vector<HoleContact<Dim>>& holes) {
  for (int lower = 0; lower + 2 < stack.grid.layers; ++lower) {
    for (int upper = lower + 2; upper < stack.grid.layers && has_hole(stack, upper - 1); ++upper) {
      const bool known = std::any_of(holes.begin(), holes.end(), [&](const HoleContact<Dim>& h) { return h.lower == lower && h.upper == upper; });
      if (!known) {
        holes.push_back({lower, upper, {}});
      }
    }
  }
}

template <int Dim> double layer_thickness(const LayerStack<Dim>& stack, int layer) {
  const auto first = static_cast<std::size_t>(layer * stack.grid.through);
  return stack.levels[first + static_cast<std::size_t>(stack.grid.through)] - stack.levels[first];
}

} // namespace

template <int Dim>
ContactSurface<Dim> layer_surface(const LayerStack<Dim>& stack, LayerVelocity<Dim>& velocity, int layer, bool upper, const std::vector<unsigned char>& held,
                                  const LayerLoad<Dim>* load) {
  const LayerGrid& g = stack.grid;
  const int plane = layer * (g.through + 1) + (upper ? g.through : 0), level = layer * g.through + (upper ? g.through - 1 : 0);
  const std::size_t first = stack.node(0, 0, plane);
  ContactSurface<Dim> s;
  s.segments = {g.elements[0], Dim == 3 ? g.elements[1] : 1};
  for (std::size_t d = 0; d < Dim; ++d) {
    s.position[d] = stack.position[d].data() + first;
    s.velocity[d] = velocity[d].data() + first;
    s.force[d] = stack.force[d].data() + first;
  }
  s.step_before = stack.step;
  s.mass = stack.mass.data() + first;
  s.outside = upper ? 1 : -1;
  s.rim = layer_rim;
  s.alive = stack.alive.data() + stack.element(0, 0, level);
  s.held = held.data();
  s.added = load != nullptr && !load->by_node.empty() ? load->by_node[first].data() : nullptr;
  return s;
}

template <int Dim>
SlidelineReport resolve_slidelines(const LayerStack<Dim>& stack, double dt, LayerVelocity<Dim>& velocity, ThreadPool& pool, const ContactSettings& settings,
                                   SlidelineState<Dim>& state, const LayerLoad<Dim>* load) {
  const auto count = static_cast<std::size_t>(stack.grid.layers - 1);
  const bool fresh = state.pairs.size() != count;
  if (fresh) {
    state.pairs.assign(count, {});
    state.held = held_nodes(stack);
  }
  std::vector<std::array<ContactSurface<Dim>, 2>> surfaces(count);
  for (std::size_t p = 0; p < count; ++p) {
    const int layer = static_cast<int>(p);
    surfaces[p] = {layer_surface(stack, velocity, layer, true, state.held, load), layer_surface(stack, velocity, layer + 1, false, state.held, load)};
    state.pairs[p].resize({&surfaces[p][0], &surfaces[p][1]});
    for (std::size_t s = 0; s < 2 && fresh; ++s) {
      start_track(surfaces[p][1 - s], state.pairs[p].tracks[s]);
    }
  }
  // Rows of nodes of all pairs' two surfaces, in one run.
  const int rows = Dim == 3 ? stack.grid.nodes_along(1) : 1, row_nodes = stack.grid.nodes_along(0);
  const auto over_rows = [&](auto&& body) {
    parallel_ranges(pool, static_cast<int>(count) * 2 * rows, [&](int begin, int end, int) {
      for (int r = begin; r < end; ++r) {
        body(static_cast<std::size_t>(r / (2 * rows)), static_cast<std::size_t>(r / rows % 2), r % rows);
      }
    });
  };
  const bool refresh = state.steps++ % settings.refresh == 0;
  over_rows([&](std::size_t p, std::size_t s, int j) {
    ContactState<Dim>& c = state.pairs[p];
    track_nodes(c.seen_from(s, {&surfaces[p][0], &surfaces[p][1]}, dt), {j * row_nodes, (j + 1) * row_nodes}, refresh, c.tracks[s]);
  });
  std::vector<ContactReport> reports(count);
  parallel_ranges(pool, static_cast<int>(count), [&](int begin, int end, int) {
    for (int p = begin; p < end; ++p) {
      const auto at = static_cast<std::size_t>(p);
      reports[at] = solve_contact<Dim>({&surfaces[at][0], &surfaces[at][1]}, dt, settings, state.pairs[at]);
    }
  });

  SlidelineReport report;
  const auto add = [&](int lower, int upper, const ContactReport& pair) {
    report.deepest_pair = pair.deepest > report.contact.deepest ? lower : report.deepest_pair;
    report.closing_share = std::max(report.closing_share, pair.closing / std::min(layer_thickness(stack, lower), layer_thickness(stack, upper)));
    add_report(report.contact, pair);
  };
  for (std::size_t p = 0; p < count; ++p) {
    add(static_cast<int>(p), static_cast<int>(p) + 1, reports[p]);
  }
  find_holes(stack, state.holes);
  for (HoleContact<Dim>& h : state.holes) {
    ContactSurface<Dim> lower = layer_surface(stack, velocity, h.lower, true, state.held, load), upper = layer_surface(stack, velocity, h.upper, false, state.held, load);
    add(h.lower, h.upper, resolve_contact(lower, upper, dt, settings, h.state, &pool));
  }
  return report;
}

#define BALLAST_INSTANTIATE(D)                                                                                                   \
  template ContactSurface<D> layer_surface<D>(const LayerStack<D>&, LayerVelocity<D>&, int, bool, const std::vector<unsigned char>&, const LayerLoad<D>*); \
  template SlidelineReport resolve_slidelines<D>(const LayerStack<D>&, double, LayerVelocity<D>&, ThreadPool&, const ContactSettings&, SlidelineState<D>&, const LayerLoad<D>*);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
