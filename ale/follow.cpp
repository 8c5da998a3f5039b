// A mesh that goes with some of its materials: the initial mesh, shifted by as much as their centre of mass has moved.
//
// Matter on the way flows through it; of what the mesh goes with, next to nothing is remapped. The shift depends on the
// state alone, so that a restart comes to the same bits.
#include "ale/phases.hpp"

#include <utility>

namespace ballast {

template <int Dim> std::array<double, 3> centre_of_mass(const Block<Dim>& b, const std::vector<int>& materials) {
  const Grid& g = b.grid;
  double mass = 0;
  std::array<double, 3> moment = {0, 0, 0};
  for (int k = 0; k < g.cells[2]; ++k) {
    for (int j = 0; j < g.cells[1]; ++j) {
      const int r = g.cell_row(j, k);
      for (const int q : materials) {
        const TileStore& store = b.materials[static_cast<std::size_t>(q)].store;
        if (!store.has_row(r)) {
          continue;
        }
        const double* m = store.row(field::mass, r);
        for (int i = 0; i < g.cells[0]; ++i) {
          if (!(m[i] > 0)) {
            continue;
          }
          mass += m[i];
          for (int corner = 0; corner < (1 << Dim); ++corner) {
            const int nodes = g.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1));
            for (std::size_t d = 0; d < Dim; ++d) {
              moment[d] += m[i] / (1 << Dim) * b.position[d].row(nodes)[i + (corner & 1)];
            }
          }
        }
      }
    }
  }
  for (double& x : moment) {
    x = mass > 0 ? x / mass : 0.0;
  }
  return moment;
}

template <int Dim> void place_target(Block<Dim>& b) {
  if (b.motion.policy != MotionPolicy::follow) {
    return;
  }
  const std::array<double, 3> now = centre_of_mass(b, b.motion.leaders);
  for (std::size_t d = 0; d < Dim; ++d) {
    if (!b.motion.axes[d]) {
      continue;
    }
    const double shift = now[d] - b.motion.start[d];
    const auto& from = b.home[d].data();
    auto& to = b.target[d].data();
    for (std::size_t i = 0; i < to.size(); ++i) {
      to[i] = from[i] + shift;
    }
  }
}

template std::array<double, 3> centre_of_mass<2>(const Block<2>&, const std::vector<int>&);
template std::array<double, 3> centre_of_mass<3>(const Block<3>&, const std::vector<int>&);
template void place_target<2>(Block<2>&);
template void place_target<3>(Block<3>&);

} // namespace ballast
