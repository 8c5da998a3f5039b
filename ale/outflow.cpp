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
  const double s = std::min(1.0, edge_wave_speed(b, axis, side, node) * dt / length);
  const double d1 = u0 - inside(u, 1);
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

template double outflow_velocity<2>(const Block<2>&, int, int, const std::array<int, 3>&, double);
template double outflow_velocity<3>(const Block<3>&, int, int, const std::array<int, 3>&, double);

} // namespace ballast
