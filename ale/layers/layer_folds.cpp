#include "ale/layers/layer_folds.hpp"

#include "ale/layers/layer_load.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ballast {
namespace {

constexpr int sweeps = 4; ///< at most; what is left closes in the next step

/// An edge of a node plane.
struct FoldEdge {
  std::size_t a = 0, b = 0; ///< nodes
  std::size_t in_plane = 0; ///< a's number in its plane
  std::size_t to = 0;       ///< from it to b's
  double shortest = 0;      ///< m
};

/// What an impulse along the edge, as large as takes `excess`, does where masses hang on its nodes.
template <int Dim>
bool stop_loaded_edge(LayerStack<Dim>& s, const FoldEdge& e, const std::array<double, Dim>& along, double excess, const std::vector<unsigned char>& held, const LayerLoad<Dim>& load,
                      std::array<double, 3>& outside) {
  using Vector = typename LayerLoad<Dim>::Vector;
  const Vector t(along.data());
  const Vector give_a = pushed<Dim>(s.mass[e.a], load.by_node[e.a], t, held[e.in_plane]), give_b = pushed<Dim>(s.mass[e.b], load.by_node[e.b], t, held[e.in_plane + e.to]);
  const double per_impulse = t.dot(give_a + give_b);
  if (!(per_impulse > 0)) {
    return false;
  }
  const double impulse = excess / per_impulse;
  const Vector a = impulse * give_a, b = impulse * give_b, taken = s.mass[e.b] * b + load.by_node[e.b] * b - s.mass[e.a] * a - load.by_node[e.a] * a;
  for (int d = 0; d < Dim; ++d) {
    const auto at = static_cast<std::size_t>(d);
    s.velocity[at][e.a] -= a[d];
    s.velocity[at][e.b] += b[d];
    outside[at] += taken[d];
  }
  return true;
}

/// Takes the velocity with which the edge closes below its shortest length; true where there was any.
template <int Dim> bool stop_edge(LayerStack<Dim>& s, const FoldEdge& e, double dt, const std::vector<unsigned char>& held, const LayerLoad<Dim>* load, std::array<double, 3>& outside) {
  std::array<double, Dim> along;
  double square = 0, closing = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    along[d] = s.position[d][e.b] - s.position[d][e.a];
    square += along[d] * along[d];
    closing -= along[d] * (s.velocity[d][e.b] - s.velocity[d][e.a]);
  }
  // (l - dt c)^2 < shortest^2 with c the closing speed: most edges are told by this alone, without a root.
  if (!(closing > 0) || square - 2 * dt * closing >= e.shortest * e.shortest) {
    return false;
  }
  const double length = std::sqrt(square), allowed = std::max(0.0, (length - e.shortest) / dt), excess = closing / length - allowed;
  if (!(excess > 0)) {
    return false;
  }
  for (double& a : along) {
    a /= length;
  }
  if (load != nullptr && !load->by_node.empty()) {
    return stop_loaded_edge<Dim>(s, e, along, excess, held, *load, outside);
  }
  double per_impulse = 0;
  std::array<double, Dim> give_a, give_b;
  for (std::size_t d = 0; d < Dim; ++d) {
    give_a[d] = (held[e.in_plane] >> d & 1) != 0 ? 0.0 : 1 / s.mass[e.a];
    give_b[d] = (held[e.in_plane + e.to] >> d & 1) != 0 ? 0.0 : 1 / s.mass[e.b];
    per_impulse += along[d] * along[d] * (give_a[d] + give_b[d]);
  }
  if (!(per_impulse > 0)) {
    return false;
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    const double impulse = along[d] * excess / per_impulse;
    s.velocity[d][e.a] -= impulse * give_a[d];
    s.velocity[d][e.b] += impulse * give_b[d];
    outside[d] += impulse * ((give_b[d] > 0 ? 1 : 0) - (give_a[d] > 0 ? 1 : 0));
  }
  return true;
}

/// Is there cloth beside the edge from node (i, j) on along `axis`? Loose nodes of a hole are debris.
template <int Dim> bool in_cloth(const LayerStack<Dim>& s, int axis, int i, int j, int plane) {
  const int level = plane / (s.grid.through + 1) * s.grid.through;
  if (Dim == 2) {
    return s.alive[s.element(i, 0, level)] != 0;
  }
  const int last = s.grid.elements[static_cast<std::size_t>(1 - axis)] - 1, at = axis == 0 ? j : i;
  const auto there = [&](int across) { return s.alive[axis == 0 ? s.element(i, across, level) : s.element(across, j, level)] != 0; };
  return (at > 0 && there(at - 1)) || (at <= last && there(at));
}

template <int Dim> bool sweep_plane(LayerStack<Dim>& s, int plane, double dt, const std::vector<unsigned char>& held, const LayerLoad<Dim>* load, std::array<double, 3>& outside) {
  const int n1 = s.grid.nodes_along(0), n2 = Dim == 3 ? s.grid.nodes_along(1) : 1;
  bool any = false;
  for (int axis = 0; axis < Dim - 1; ++axis) {
    const std::vector<double>& lines = s.lines[static_cast<std::size_t>(axis)];
    const std::size_t to = axis == 0 ? 1 : static_cast<std::size_t>(n1);
    for (int j = 0; j < n2 - (axis == 1 ? 1 : 0); ++j) {
      for (int i = 0; i < n1 - (axis == 0 ? 1 : 0); ++i) {
        const std::size_t a = s.node(i, j, plane), k = static_cast<std::size_t>(axis == 0 ? i : j);
        if (!in_cloth(s, axis, i, j, plane)) {
          continue;
        }
        any = stop_edge(s, {a, a + to, s.node(i, j, 0), to, s.guard.shortest * (lines[k + 1] - lines[k])}, dt, held, load, outside) || any;
      }
    }
  }
  return any;
}

} // namespace

template <int Dim> void stop_folds(LayerStack<Dim>& s, double dt, const std::vector<unsigned char>& held, LayerLedger& ledger, ThreadPool& pool, const LayerLoad<Dim>* load) {
  if (!(s.guard.shortest > 0)) {
    return;
  }
  std::vector<std::array<double, 3>> outside(static_cast<std::size_t>(s.grid.planes()), {0, 0, 0}); // summed in order: the same bits for any threads
  parallel_ranges(pool, s.grid.planes(), [&](int begin, int end, int) {
    for (int plane = begin; plane < end; ++plane) {
      for (int sweep = 0; sweep < sweeps && sweep_plane(s, plane, dt, held, load, outside[static_cast<std::size_t>(plane)]); ++sweep) {
      }
    }
  });
  for (const auto& impulse : outside) {
    for (std::size_t d = 0; d < Dim; ++d) {
      ledger.edge_impulse[d] += impulse[d];
    }
  }
}

template void stop_folds<2>(LayerStack<2>&, double, const std::vector<unsigned char>&, LayerLedger&, ThreadPool&, const LayerLoad<2>*);
template void stop_folds<3>(LayerStack<3>&, double, const std::vector<unsigned char>&, LayerLedger&, ThreadPool&, const LayerLoad<3>*);

} // namespace ballast
