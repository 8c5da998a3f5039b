// Velocities, feet and pools of cut cells, private to ale/embedding*.
#pragma once

#include "ale/embedding.hpp"

namespace ballast {

template <int Dim> std::array<int, 3> node_of(const Grid& g, int row, int index) {
  const int per = g.node_rows_per_plane(), k = row / per - (Dim == 3 ? g.ghost[2] : 0), j = row % per - g.ghost[1];
  return {index, j, k};
}

/// Node velocities at the cell's corners.
template <int Dim>
std::array<std::array<double, Dim>, 1 << Dim> corner_velocities(const Grid& g, const std::array<RowField, Dim>& velocity, const std::array<int, 3>& cell) {
  std::array<std::array<double, Dim>, 1 << Dim> u{};
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto step = corner_step<Dim>(p);
    for (std::size_t d = 0; d < Dim; ++d) {
      u[static_cast<std::size_t>(p)][d] = velocity[d].row(g.node_row(cell[1] + step[1], cell[2] + step[2]))[cell[0] + step[0]];
    }
  }
  return u;
}

template <int Dim> const NodeFoot<Dim>* foot_at(const Embedding<Dim>& e, const CutCell<Dim>& c, int p) {
  const int at = c.foot[static_cast<std::size_t>(p)];
  return at < 0 ? nullptr : &e.now.feet[static_cast<std::size_t>(at)];
}

/// The foot by which a corner's node is tied.
template <int Dim> const NodeFoot<Dim>* foot_of_node(const Embedding<Dim>& e, const Grid& g, const CutCell<Dim>& c, int p) {
  const auto step = corner_step<Dim>(p);
  const int at = e.now.foot_of[node_at(g, g.node_row(c.cell[1] + step[1], c.cell[2] + step[2]), c.cell[0] + step[0])];
  return at < 0 ? nullptr : &e.now.feet[static_cast<std::size_t>(at)];
}

template <int Dim> double dot(const std::array<double, Dim>& a, const std::array<double, Dim>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    sum += a[d] * b[d];
  }
  return sum;
}

/// Rate at which a node's level grows, m/s.
template <int Dim> double level_rate(const Scene<Dim>& scene, const NodeFoot<Dim>& f, const std::array<double, Dim>& u) {
  return dot<Dim>(f.foot.normal, u) - surface_speed<Dim>(scene, f, f.foot.normal);
}

/// A cut cell's levels and positions at a half step.
template <int Dim> LevelCell<Dim> half_way(const Scene<Dim>& scene, const Embedding<Dim>& e, const Block<Dim>& b, const CutCell<Dim>& c, double half,
                                           const std::array<std::array<double, Dim>, 1 << Dim>& u) {
  LevelCell<Dim> cell = level_cell<Dim>(b.grid, b.position, e.now, c.cell);
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto at = static_cast<std::size_t>(p);
    for (std::size_t d = 0; d < Dim; ++d) {
      cell.x[at][d] += half * u[at][d];
    }
    if (const NodeFoot<Dim>* f = foot_at(e, c, p)) {
      cell.level[at] += half * level_rate<Dim>(scene, *f, u[at]);
    }
  }
  return cell;
}

/// dT/dt of a cut cell, m3/s.
template <int Dim>
double opening_rate(const Scene<Dim>& scene, const Embedding<Dim>& e, const CutCell<Dim>& c, const OpenPart<Dim>& part,
                    const std::array<std::array<double, Dim>, 1 << Dim>& u) {
  double rate = 0;
  for (int p = 0; p < (1 << Dim); ++p) {
    const auto at = static_cast<std::size_t>(p);
    rate += dot<Dim>(part.at_node[at], u[at]);
    if (const NodeFoot<Dim>* f = foot_at(e, c, p)) {
      rate += part.at_level[at] * level_rate<Dim>(scene, *f, u[at]);
    }
  }
  return rate;
}

template <int Dim> bool is_sliver(const Block<Dim>& b, const CutCell<Dim>& c) { return b.volume.row(c.row)[c.cell[0]] < sliver_share * c.whole; }

/// A small sliver with no one of its kind beside it presses on nothing: it is on its way into its root's void.
template <int Dim> bool is_wisp(const Block<Dim>& b, const CutCell<Dim>& c) {
  constexpr double small = 0.25; // of a whole cell
  return c.root < 0 && b.volume.row(c.row)[c.cell[0]] < small * c.whole;
}

/// A cell's room and how much its open part changes, with its root's if it is a sliver.
struct Pool {
  double volume, change;
};
template <int Dim> Pool pool_of(const Scene<Dim>& scene, const Embedding<Dim>& e, const Block<Dim>& b, const CutCell<Dim>& c, double half, double change, double volume) {
  Pool pool{volume, change};
  if (c.root >= 0) {
    const int r = b.grid.cell_row(c.root_cell[1], c.root_cell[2]), kind = e.kind_of(b.grid, r, c.root_cell[0]);
    CutCell<Dim> root;
    root.cell = c.root_cell;
    root.foot.fill(-1);
    if (kind >= 0) {
      root.foot = e.cut[static_cast<std::size_t>(kind)].foot;
    }
    const auto u = corner_velocities<Dim>(b.grid, b.velocity, c.root_cell);
    pool.volume += b.volume.row(r)[c.root_cell[0]];
    // By its rate: where a corner comes to the surface while the opposite one is out, too, the open part jumps by what lies between them.
    pool.change += half * opening_rate<Dim>(scene, e, root, open_part(level_cell<Dim>(b.grid, b.position, e.now, c.root_cell), b.axisymmetric), u);
  }
  return pool;
}

/// Beside bodies a node that holds next to nothing moves as its heaviest neighbour does, an impact that keeps momentum: a wisp's
/// pressure would else fling it. What has no one to join and is alone, or a trace thrice as fast as sound anywhere, stops.
template <int Dim> void join_wisps(Scene<Dim>& scene, const Embedding<Dim>& e, Block<Dim>& b);

} // namespace ballast
