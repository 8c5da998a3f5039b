#include "core/boundary.hpp"

namespace ballast {

void exchange_cells(const Grid& g, RowField& f, const Awake* awake) {
  mirror_cells(g, {1, 1, 1}, [&](int j, int k) -> double* {
    const int r = g.cell_row(j, k);
    return awake != nullptr && awake->cells(r).empty() ? nullptr : f.row(r);
  });
}

namespace {

/// Value of a ghost node outside, shift + sign x source: odd or even mirror, zero gradient, or prescribed.
struct NodeGhost {
  bool mirror;
  double sign, shift;
  int source(int i, int n) const { return mirror ? mirrored_node(i, n) : (i < 0 ? 0 : n); }
};

NodeGhost ghost_rule(const BoundarySet& b, int axis, int side, int component) {
  const BoundarySide& s = b.at(axis, side);
  if (s.kind == BoundaryKind::inflow) {
    return {true, 0.0, s.inflow.velocity[static_cast<std::size_t>(component)]};
  }
  const bool fixed = b.fixes_normal_velocity(axis, side), odd = fixed && b.normal_of(axis, side) == component;
  return {fixed, odd ? -1.0 : 1.0, odd ? 2 * s.velocity : 0.0};
}

} // namespace

void exchange_nodes(const Grid& g, const BoundarySet& boundary, int component, RowField& f, const Awake* awake) {
  const auto asleep = [&](int r) { return awake != nullptr && awake->nodes(r).empty(); };
  const int top = g.dim == 3 ? g.cells[2] : 0;
  for (int k = 0; k <= top; ++k) {
    for (int j = 0; j <= g.cells[1]; ++j) {
      if (asleep(g.node_row(j, k))) {
        continue;
      }
      double* a = f.row(g.node_row(j, k));
      for (int side = 0; side < 2; ++side) {
        const NodeGhost rule = ghost_rule(boundary, 0, side, component);
        for (int q = 1; q <= g.ghost[0]; ++q) {
          const int i = side == 0 ? -q : g.cells[0] + q;
          a[i] = rule.shift + rule.sign * a[rule.source(i, g.cells[0])];
        }
      }
    }
  }
  const auto copy = [&](int j, int k, int js, int ks, double sign, double shift) {
    if (asleep(g.node_row(j, k))) {
      return;
    }
    double* to = f.row(g.node_row(j, k));
    const double* from = f.row(g.node_row(js, ks));
    for (int i = -g.ghost[0]; i <= g.cells[0] + g.ghost[0]; ++i) {
      to[i] = shift + sign * from[i];
    }
  };
  for (int axis = 1; axis < g.dim; ++axis) {
    const int n = g.cells[static_cast<std::size_t>(axis)];
    for (int side = 0; side < 2; ++side) {
      const NodeGhost rule = ghost_rule(boundary, axis, side, component);
      for (int q = 1; q <= g.ghost[static_cast<std::size_t>(axis)]; ++q) {
        const int to = side == 0 ? -q : n + q;
        const int from = rule.source(to, n);
        if (axis == 1) {
          for (int k = 0; k <= top; ++k) {
            copy(to, k, from, k, rule.sign, rule.shift);
          }
        } else {
          for (int j = -g.ghost[1]; j <= g.cells[1] + g.ghost[1]; ++j) {
            copy(j, to, j, from, rule.sign, rule.shift);
          }
        }
      }
    }
  }
}

} // namespace ballast
