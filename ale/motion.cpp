// When a block is remapped and to which mesh.
#include "ale/follow.hpp"
#include "ale/mesh_quality.hpp"
#include "ale/phases.hpp"
#include "ale/relax.hpp"

namespace ballast {

constexpr double farthest_stray = 2; // cells: a mesh that only drifts keeps its quality, but must not leave its place

template <int Dim> void start_motion(Block<Dim>& b) {
  if (!b.motion.moves_target()) {
    return;
  }
  b.home = b.target;
  if (b.motion.policy == MotionPolicy::follow) {
    b.motion.start = bulk_of(b, b.motion.leaders);
  } else {
    weigh_neighbours(b);
  }
}

template <int Dim> bool remap_due(const Block<Dim>& b, long step, ThreadPool& pool) {
  if (!b.motion.remaps()) {
    return false;
  }
  if (b.motion.remap_quality > 0) { // the target still is where the last remap brought the mesh
    const bool strayed = b.motion.policy == MotionPolicy::eulerian && largest_stray<Dim>(b.grid, b.position, b.target, pool) > farthest_stray;
    return strayed || mesh_quality<Dim>(b.grid, b.position, b.target, pool) < b.motion.remap_quality;
  }
  return (step + 1) % b.motion.remap_every == 0;
}

template <int Dim> void place_target(Block<Dim>& b, ThreadPool& pool) {
  if (b.motion.policy == MotionPolicy::follow) {
    follow_target(b, pool);
  } else if (b.motion.policy == MotionPolicy::relax) {
    relax_target(b, pool);
    target_volumes(b, pool);
  }
}

template void start_motion<2>(Block<2>&);
template void start_motion<3>(Block<3>&);
template bool remap_due<2>(const Block<2>&, long, ThreadPool&);
template bool remap_due<3>(const Block<3>&, long, ThreadPool&);
template void place_target<2>(Block<2>&, ThreadPool&);
template void place_target<3>(Block<3>&, ThreadPool&);

} // namespace ballast
