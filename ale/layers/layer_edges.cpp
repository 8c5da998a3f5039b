#include "ale/layers/layer_edges.hpp"

#include <cmath>
#include <numbers>

namespace ballast {
namespace {

/// Calls body(node, i, j, plane) for the nodes of one edge, in order.
template <int Dim, class Body> void for_edge(const LayerStack<Dim>& s, int axis, int side, Body body) {
  const int last = side * (s.grid.nodes_along(axis) - 1), along = Dim == 3 ? s.grid.nodes_along(1 - axis) : 1;
  for (int plane = 0; plane < s.grid.planes(); ++plane) {
    for (int k = 0; k < along; ++k) {
      const int i = axis == 0 ? last : k, j = axis == 0 ? k : last;
      body(s.node(i, j, plane), i, j, plane);
    }
  }
}

template <int Dim, class Body> void for_edges(const LayerStack<Dim>& s, Body body) {
  for (int axis = 0; axis < Dim - 1; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const LayerEdge kind = s.edge[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
      if (kind != LayerEdge::free) {
        body(axis, side, kind);
      }
    }
  }
}

double corner_share(const std::vector<double>& lines, std::size_t i) {
  const double below = i > 0 ? lines[i] - lines[i - 1] : 0.0, above = i + 1 < lines.size() ? lines[i + 1] - lines[i] : 0.0;
  return 0.5 * (below + above);
}

/// N/m of one edge node: its share of the edge's length times its share of the stack's thickness.
template <int Dim> double spring(const LayerStack<Dim>& s, int axis, int i, int j, int plane) {
  const auto through = s.grid.through;
  const int in_layer = plane % (through + 1);
  const auto level = static_cast<std::size_t>(plane / (through + 1) * through + in_layer);
  const double below = in_layer > 0 ? s.levels[level] - s.levels[level - 1] : 0.0, above = in_layer < through ? s.levels[level + 1] - s.levels[level] : 0.0;
  double length = 1;
  if (Dim == 3) {
    length = corner_share(s.lines[static_cast<std::size_t>(1 - axis)], static_cast<std::size_t>(axis == 0 ? j : i));
  } else if (s.axisymmetric) {
    length = 2 * std::numbers::pi * s.lines[0][static_cast<std::size_t>(i)];
  }
  return s.edge_stiffness * length * 0.5 * (below + above) / (s.levels.back() - s.levels.front());
}

/// The elements that an edge node belongs to.
template <int Dim, class Body> void for_elements_of(const LayerStack<Dim>& s, int i, int j, int plane, Body body) {
  const int through = s.grid.through, layer = plane / (through + 1), in_layer = plane % (through + 1);
  for (int l = in_layer - 1; l <= in_layer; ++l) {
    for (int jj = Dim == 3 ? j - 1 : 0; jj <= (Dim == 3 ? j : 0); ++jj) {
      for (int ii = i - 1; ii <= i; ++ii) {
        if (l >= 0 && l < through && jj >= 0 && jj < s.grid.elements[1] && ii >= 0 && ii < s.grid.elements[0]) {
          body(s.element(ii, jj, layer * through + l));
        }
      }
    }
  }
}

/// Stops one component of a node: the edge's impulse, and what kinetic energy it had at the start.
template <int Dim> void stop(LayerStack<Dim>& s, std::size_t n, std::size_t d, double half, LayerLedger& ledger) {
  const double unheld = s.velocity[d][n], old = unheld - half * s.force[d][n] / s.mass[n];
  ledger.edge_impulse[d] -= s.mass[n] * unheld;
  ledger.edge_loss += 0.5 * s.mass[n] * old * old;
  s.velocity[d][n] = 0;
}

/// A component is stopped once though edges may share the node: the second time it finds nothing to stop.
template <int Dim> void hold(LayerStack<Dim>& s, std::size_t n, std::size_t d, double half, LayerLedger& ledger) {
  if (s.velocity[d][n] != 0) {
    stop(s, n, d, half, ledger);
  }
}

/// Calls body(node, axis, force) for the springs of elastic edges, in order.
template <int Dim, class Body> void for_springs(const LayerStack<Dim>& s, Body body) {
  for_edges(s, [&](int axis, int side, LayerEdge kind) {
    if (kind != LayerEdge::elastic) {
      return;
    }
    for_edge(s, axis, side, [&](std::size_t n, int i, int j, int plane) {
      const double k = spring(s, axis, i, j, plane);
      for (std::size_t d = 0; d + 1 < Dim; ++d) {
        body(n, d, -k * (s.position[d][n] - s.rest[d][n]));
      }
    });
  });
}

} // namespace

template <int Dim> void add_edge_forces(LayerStack<Dim>& s) {
  for_edges(s, [&s](int axis, int side, LayerEdge kind) {
    if (kind != LayerEdge::elastic) {
      return;
    }
    for_edge(s, axis, side, [&](std::size_t n, int i, int j, int plane) {
      const double k = spring(s, axis, i, j, plane);
      for (std::size_t d = 0; d + 1 < Dim; ++d) {
        s.force[d][n] -= k * (s.position[d][n] - s.rest[d][n]);
      }
      const double rate = k / (4 * s.mass[n]);
      for_elements_of(s, i, j, plane, [&](std::size_t e) { s.wave_step[e] = 1 / std::sqrt(1 / (s.wave_step[e] * s.wave_step[e]) + rate); });
    });
  });
}

template <int Dim> void hold_edges(LayerStack<Dim>& s, double half, LayerLedger& ledger) {
  for_edges(s, [&](int axis, int side, LayerEdge kind) {
    for_edge(s, axis, side, [&](std::size_t n, int, int, int) {
      if (kind == LayerEdge::symmetry) {
        hold(s, n, static_cast<std::size_t>(axis), half, ledger);
      } else if (kind == LayerEdge::fixed) {
        for (std::size_t d = 0; d < Dim; ++d) {
          hold(s, n, d, half, ledger);
        }
      }
    });
  });
  for_springs(s, [&](std::size_t, std::size_t d, double f) { ledger.edge_impulse[d] += half * f; });
}

template <int Dim> void book_springs(const LayerStack<Dim>& s, double half, LayerLedger& ledger) {
  for_springs(s, [&](std::size_t n, std::size_t d, double f) { ledger.edge_work -= half * f * s.velocity[d][n]; });
}

template <int Dim> std::vector<unsigned char> held_nodes(const LayerStack<Dim>& stack) {
  constexpr unsigned all = (1U << Dim) - 1;
  const int n = stack.grid.nodes_along(0), rows = Dim == 3 ? stack.grid.nodes_along(1) : 1;
  std::vector<unsigned char> held(static_cast<std::size_t>(n * rows), 0);
  for (int axis = 0; axis < Dim - 1; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      const LayerEdge edge = stack.edge[static_cast<std::size_t>(axis)][side];
      const unsigned bits = edge == LayerEdge::symmetry ? 1U << axis : edge == LayerEdge::fixed ? all : 0U;
      const int at = side == 0 ? 0 : stack.grid.elements[static_cast<std::size_t>(axis)];
      for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < n; ++i) {
          unsigned char& node = held[static_cast<std::size_t>(j * n + i)];
          node = static_cast<unsigned char>(node | ((axis == 0 ? i : j) == at ? bits : 0U));
        }
      }
    }
  }
  return held;
}

template std::vector<unsigned char> held_nodes<2>(const LayerStack<2>&);
template std::vector<unsigned char> held_nodes<3>(const LayerStack<3>&);
template void book_springs<2>(const LayerStack<2>&, double, LayerLedger&);
template void book_springs<3>(const LayerStack<3>&, double, LayerLedger&);
template void add_edge_forces<2>(LayerStack<2>&);
template void add_edge_forces<3>(LayerStack<3>&);
template void hold_edges<2>(LayerStack<2>&, double, LayerLedger&);
template void hold_edges<3>(LayerStack<3>&, double, LayerLedger&);

} // namespace ballast
