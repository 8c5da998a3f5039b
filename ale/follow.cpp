// A mesh that goes with some of its materials: the initial mesh, shifted by as much as their centre of mass has moved.
//
// Matter on the way flows through it; of what the mesh goes with, next to nothing is remapped. The shift depends on the
// state alone, so that a restart comes to the same bits.
#include "ale/phases.hpp"

#include <utility>

namespace ballast {

template <int Dim> Bulk bulk_of(const Block<Dim>& b, const std::vector<int>& materials) {
  const Grid& g = b.grid;
  Bulk sum;
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
            for (std::size_t d = 0; d < Dim; ++d) {
              sum.centre[d] += m[i] / (1 << Dim) * b.position[d].row(nodes)[n];
              sum.velocity[d] += m[i] / (1 << Dim) * velocity_of(b, slot.slides, d, nodes, n);
            }
          }
        }
      }
    }
  }
  for (std::size_t d = 0; d < Dim && sum.mass > 0; ++d) {
    sum.centre[d] /= sum.mass;
    sum.velocity[d] /= sum.mass;
  }
  return sum;
}

template <int Dim> void place_target(Block<Dim>& b) {
  if (b.motion.policy != MotionPolicy::follow) {
    return;
  }
  constexpr double some = 0.01; // of what there was to follow; less is dust
  const Bulk now = bulk_of(b, b.motion.leaders);
  b.motion.heading = {0, 0, 0};
  if (!(now.mass > some * b.motion.start_mass)) {
    return;
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    if (!b.motion.axes[d]) {
      continue;
    }
    b.motion.heading[d] = now.velocity[d];
    const double shift = now.centre[d] - b.motion.start[d];
    const auto& from = b.home[d].data();
    auto& to = b.target[d].data();
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] = from[i] + shift;
    }
  }
}

template Bulk bulk_of<2>(const Block<2>&, const std::vector<int>&);
template Bulk bulk_of<3>(const Block<3>&, const std::vector<int>&);
template void place_target<2>(Block<2>&);
template void place_target<3>(Block<3>&);

} // namespace ballast
