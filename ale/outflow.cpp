#include "ale/outflow.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

/// Fastest wave of the edge cells that touch a boundary node.
template <int Dim> double edge_wave_speed(const Block<Dim>& b, int axis, int side, const std::array<int, 3>& node) {
  const Grid& g = b.grid;
  double fastest = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    std::array<int, 3> cell = node;
    bool edge = true;
    for (int d = 0; d < Dim; ++d) {
      const auto a = static_cast<std::size_t>(d);
      cell[a] -= corner >> d & 1;
      edge = edge && cell[a] >= 0 && cell[a] < g.cells[a];
    }
    if (edge && (corner >> axis & 1) == side) {
      fastest = std::max(fastest, b.wave_speed.row(g.cell_row(cell[1], cell[2]))[cell[0]]);
    }
  }
  return fastest;
}

/// Calls visit(axis, node row, i) for every node of every outflow side, in order.
template <int Dim, class Visit> void for_each_outflow_node(const Block<Dim>& b, Visit&& visit) {
  const Grid& g = b.grid;
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      if (b.boundary.at(axis, side).kind != BoundaryKind::outflow) {
        continue;
      }
      std::array<int, 3> first = {0, 0, 0}, last = {g.cells[0], g.cells[1], Dim == 3 ? g.cells[2] : 0};
      const auto a = static_cast<std::size_t>(axis);
      (side == 0 ? last : first)[a] = (side == 0 ? first : last)[a];
      for (int k = first[2]; k <= last[2]; ++k) {
        for (int j = first[1]; j <= last[1]; ++j) {
          for (int i = first[0]; i <= last[0]; ++i) {
            visit(axis, g.node_row(j, k), i);
          }
        }
      }
    }
  }
}

} // namespace

template <int Dim>
double outflow_velocity(const Block<Dim>& b, int axis, int side, const std::array<int, 3>& node, double dt) {
  const auto a = static_cast<std::size_t>(axis);
  const auto inside = [&](const RowField& f, int steps) { // at `steps` nodes further in
    std::array<int, 3> at = node;
    at[a] += side == 0 ? steps : -steps;
    return f.row(b.grid.node_row(at[1], at[2]))[at[0]];
  };
  const RowField &u = b.velocity[a], &x = b.position[a];
  const double u0 = inside(u, 0), x1 = inside(x, 1), length = std::abs(inside(x, 0) - x1);
  const double d1 = u0 - inside(u, 1), outwards = side == 0 ? -1 : 1;
  const double carried = b.motion.policy == MotionPolicy::lagrangian ? 0.0 : outwards * (u0 - 0.5 * d1);
  const double s = std::min(1.0, (edge_wave_speed(b, axis, side, node) + carried) * dt / length);
  if (!(s > 0) || d1 == 0) {
    return u0;
  }
  double rise = d1; // over the edge cell, at the foot of the characteristic
  if (b.grid.cells[a] > 1) {
    const double d2 = (inside(u, 1) - inside(u, 2)) * (length / std::abs(x1 - inside(x, 2)));
    rise += 0.5 * (1 - s) * (d1 - d2);
  }
  return u0 - d1 * std::clamp(s * (rise / d1), 0.0, 1.0);
}

template <int Dim> std::vector<OutflowNode> outflow_nodes(const Block<Dim>& b) {
  std::vector<OutflowNode> nodes;
  for_each_outflow_node(b, [&](int axis, int r, int i) {
    nodes.push_back({b.node_mass.row(r)[i], b.velocity[static_cast<std::size_t>(axis)].row(r)[i]});
  });
  return nodes;
}

template <int Dim> void hold_outflow(Block<Dim>& b, const std::vector<OutflowNode>& before, Ledger& ledger) {
  std::size_t n = 0;
  for_each_outflow_node(b, [&](int axis, int r, int i) {
    const auto a = static_cast<std::size_t>(axis);
    const OutflowNode& old = before[n++];
    const double m = b.node_mass.row(r)[i];
    double& u = b.velocity[a].row(r)[i];
    if (m > 0) {
      const double held = u + std::min(1.0, old.mass / m) * (old.velocity - u);
      ledger.momentum_out[a] += m * (u - held);
      ledger.energy_out += 0.5 * m * (u - held) * (u + held);
      u = held;
    }
  });
}

template std::vector<OutflowNode> outflow_nodes<2>(const Block<2>&);
template std::vector<OutflowNode> outflow_nodes<3>(const Block<3>&);
template void hold_outflow<2>(Block<2>&, const std::vector<OutflowNode>&, Ledger&);
template void hold_outflow<3>(Block<3>&, const std::vector<OutflowNode>&, Ledger&);
template double outflow_velocity<2>(const Block<2>&, int, int, const std::array<int, 3>&, double);
template double outflow_velocity<3>(const Block<3>&, int, int, const std::array<int, 3>&, double);

} // namespace ballast
