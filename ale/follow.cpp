// A mesh that goes with some of its materials: the initial mesh, shifted by as much as their centre of mass has moved and
// stretched by as much as they have spread.
//
// Matter on the way flows through it; of what the mesh goes with, next to nothing is remapped. Shift and stretch depend on the
// state alone, so that a restart comes to the same bits.
#include "ale/follow.hpp"

#include <cmath>

namespace ballast {

namespace {

template <int Dim> bool mirrored_below(const Block<Dim>& b, std::size_t axis) {
  return b.boundary.at(static_cast<int>(axis), 0).kind == BoundaryKind::symmetry;
}

/// Where the mesh stays along an axis while it stretches: its lower side's plane of symmetry, m.
template <int Dim> double mirror_of(const Block<Dim>& b, std::size_t axis) {
  return mirrored_below(b, axis) ? b.position[axis].row(b.grid.node_row(0, 0))[0] : 0.0;
}

} // namespace

template <int Dim> Bulk bulk_of(const Block<Dim>& b, const std::vector<int>& materials) {
  const Grid& g = b.grid;
  Bulk sum;
  std::array<double, 3> mirror = {0, 0, 0};
  for (std::size_t d = 0; d < Dim; ++d) {
    mirror[d] = mirror_of(b, d);
  }
  for (int k = 0; k < g.cells[2]; ++k) {
    for (int j = 0; j < g.cells[1]; ++j) {
      const int r = g.cell_row(j, k);
      for (const int q : materials) {
        const MaterialSlot& slot = b.materials[static_cast<std::size_t>(q)];
        if (!slot.store.has_row(r)) {
          continue;
        }
        const double* m = slot.store.row(field::mass, r);
        for (int i = 0; i < g.cells[0]; ++i) {
          if (!(m[i] > 0)) {
            continue;
          }
          sum.mass += m[i];
          for (int corner = 0; corner < (1 << Dim); ++corner) {
            const int nodes = g.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1)), n = i + (corner & 1);
            const double share = m[i] / (1 << Dim);
            for (std::size_t d = 0; d < Dim; ++d) {
              const double x = b.position[d].row(nodes)[n], v = velocity_of(b, slot.slides, d, nodes, n);
              sum.centre[d] += share * x;
              sum.velocity[d] += share * v;
              sum.spread[d] += share * (x - mirror[d]) * (x - mirror[d]);
              sum.spread_rate[d] += 2 * share * (x - mirror[d]) * v;
            }
          }
        }
      }
    }
  }
  for (std::size_t d = 0; d < Dim && sum.mass > 0; ++d) {
    for (auto* s : {&sum.centre, &sum.velocity, &sum.spread, &sum.spread_rate}) {
      (*s)[d] /= sum.mass;
    }
    if (!mirrored_below(b, d)) {
      sum.spread[d] -= sum.centre[d] * sum.centre[d];
      sum.spread_rate[d] -= 2 * sum.centre[d] * sum.velocity[d];
    }
  }
  return sum;
}

/// target = c + s (home - c_0), c the leaders' centre along the axes that go (else where the mesh is), s their spread against
/// the first along those that stretch.
template <int Dim> void follow_target(Block<Dim>& b, ThreadPool& pool) {
  constexpr double some = 0.01; // of what there was to follow; less is dust
  Motion& motion = b.motion;
  const Bulk now = bulk_of(b, motion.leaders);
  motion.side_speed = {};
  if (!(now.mass > some * motion.start.mass)) {
    return;
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    if (!motion.axes[d] && !motion.stretches[d]) {
      continue;
    }
    const bool stretches = motion.stretches[d] && motion.start.spread[d] > 0;
    const double scale = stretches ? std::sqrt(now.spread[d] / motion.start.spread[d]) : 1.0;
    const double rate = stretches && now.spread[d] > 0 ? 0.5 * now.spread_rate[d] / now.spread[d] : 0.0;
    const double from = motion.axes[d] ? motion.start.centre[d] : mirror_of(b, d), centre = motion.axes[d] ? now.centre[d] : from;
    const auto& home = b.home[d].data();
    auto& to = b.target[d].data();
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] = scale == 1 ? home[i] + (centre - from) : centre + scale * (home[i] - from);
    }
    for (std::size_t side = 0; side < 2; ++side) {
      const int n = side == 0 ? 0 : b.grid.cells[d];
      const double x = b.target[d].row(b.grid.node_row(d == 1 ? n : 0, d == 2 ? n : 0))[d == 0 ? n : 0];
      motion.side_speed[d][side] = (motion.axes[d] ? now.velocity[d] : 0.0) + rate * (x - centre);
    }
  }
  if (motion.stretches != std::array<bool, 3>{}) {
    target_volumes(b, pool);
  }
}

template Bulk bulk_of<2>(const Block<2>&, const std::vector<int>&);
template Bulk bulk_of<3>(const Block<3>&, const std::vector<int>&);
template void follow_target<2>(Block<2>&, ThreadPool&);
template void follow_target<3>(Block<3>&, ThreadPool&);

} // namespace ballast
