#include "ale/rest.hpp"

#include "ale/embedding.hpp"
#include "ale/phases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

/// Momentum (kg m/s) and kinetic energy (J) that nodes held at rest lose.
struct Held {
  std::array<double, 3> momentum = {0, 0, 0};
  double energy = 0;
};

template <int Dim> using Nodes = std::array<RowField, Dim>;

/// How many nodes of a row move, but slower than `least` in each of the `Rows` components.
template <int Rows> int count_slow(const double* const (&u)[Rows], Span nodes, double least) {
  int slow = 0;
#pragma omp simd reduction(+ : slow)
  for (int i = nodes.begin; i < nodes.end; ++i) {
    double fastest = 0;
#pragma GCC unroll 6
    for (int q = 0; q < Rows; ++q) {
      const double speed = std::abs(u[q][i]);
      fastest = speed > fastest ? speed : fastest;
    }
    slow += (fastest > 0) & (fastest < least) ? 1 : 0;
  }
  return slow;
}

/// Calls hold(i) for those nodes.
template <int Rows, class Hold> void for_slow(const double* const (&u)[Rows], Span nodes, double least, Hold&& hold) {
  if (count_slow(u, nodes, least) == 0) {
    return;
  }
  for (int i = nodes.begin; i < nodes.end; ++i) {
    if (count_slow(u, {i, i + 1}, least) > 0) {
      hold(i);
    }
  }
}

/// Calls hold(i) for the nodes of a row that move, but slower than still_speed, jumps between two velocities included.
template <int Dim, class Hold> void for_slow_nodes(const Block<Dim>& b, const Nodes<Dim>& velocity, const Nodes<Dim>& jump, int r, Hold&& hold) {
  const double *u[Dim], *both[2 * Dim];
  for (std::size_t d = 0; d < Dim; ++d) {
    u[d] = both[d] = velocity[d].row(r);
    both[Dim + d] = b.any_sliding() ? jump[d].row(r) : u[d];
  }
  b.any_sliding() ? for_slow(both, b.awake.nodes(r), b.still_speed, hold) : for_slow(u, b.awake.nodes(r), b.still_speed, hold);
}

template <int Dim> void stop(Nodes<Dim>& velocity, Nodes<Dim>& jump, int r, int i) {
  for (std::size_t d = 0; d < Dim; ++d) {
    velocity[d].row(r)[i] = 0;
    if (!jump[d].empty()) {
      jump[d].row(r)[i] = 0;
    }
  }
}

/// Would the step after next find a mixed cell, whose nodes rest, as it is?
template <int Dim> bool mixed_rests(const Block<Dim>& b, int i, int j, int k, bool spall) {
  const int r = b.grid.cell_row(j, k);
  double left = 1, most = 0, bath = 0;
  bool conducts = false, cold = true;
  for (const MaterialSlot& slot : b.materials) {
    const double f = slot.store.row(field::fraction, r)[i];
    left -= f;
    most = std::max(most, f);
    if (f <= 0) {
      continue;
    }
    if (slot.is_void) {
      if (b.reference_pressure != 0 || (b.motion.remaps() && to_be_closed(b, i, j, k, spall))) {
        return false;
      }
      continue;
    }
    if (slot.store.row(slot.pressure_field(), r)[i] != 0) {
      return false;
    }
    for (int a = 0; slot.strength && a < stress_components<Dim>; ++a) {
      if (slot.store.row(field::stress + a, r)[i] != 0) {
        return false;
      }
    }
    if (slot.memories > 0 && slot.store.row(field::free_energy<Dim>, r)[i] != 0) {
      return false;
    }
    conducts = conducts || slot.material.conductivity > 0;
    bath += slot.material.conductivity > 0 ? 0 : slot.store.row(field::mass, r)[i];
    cold = cold && (slot.material.conductivity == 0 || slot.store.row(field::energy, r)[i] == conduction_wall(slot));
  }
  return most + left == most && (cold || bath == 0);
}

template <int Dim> bool massless(const Block<Dim>& b, int i, int j, int k) {
  double mass = 0;
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    mass += b.node_mass.row(b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1)))[i + (corner & 1)];
  }
  return mass == 0;
}

/// Do the cells of [begin, end) press and pull on nothing that has mass?
template <int Dim> bool nothing_pulls(const Block<Dim>& b, int begin, int end, int j, int k) {
  const int r = b.grid.cell_row(j, k);
  const std::int8_t* owner = b.owner_row(r);
  const double* p = b.pressure.row(r);
  int pulls = 0, presses = 0;
  for (std::size_t a = 0; b.any_strength() && a < stress_components<Dim>; ++a) {
    const double* s = b.stress[a].row(r);
    for (int i = begin; i < end; ++i) {
      pulls += s[i] != 0 ? 1 : 0;
    }
  }
  for (int i = begin; i < end; ++i) {
    presses += p[i] != 0 ? 1 : 0;
  }
  for (int i = begin; i < end && pulls == 0 && presses > 0; ++i) {
    presses -= p[i] != 0 && owner[i] == b.void_index() && massless(b, i, j, k) ? 1 : 0;
  }
  return pulls == 0 && presses == 0;
}

/// Are those of [begin, end) that are pure whole, and remember nothing?
template <int Dim> bool pure_whole(const Block<Dim>& b, int begin, int end, int r) {
  const std::int8_t* owner = b.owner_row(r);
  for (int i = begin; i < end;) {
    const std::int8_t mat = owner[i];
    if (mat == mixed_cell) {
      ++i;
      continue;
    }
    const MaterialSlot& slot = b.materials[static_cast<std::size_t>(mat)];
    const double* f = slot.store.row(field::fraction, r);
    const double* held = slot.memories > 0 ? slot.store.row(field::free_energy<Dim>, r) : nullptr;
    for (; i < end && owner[i] == mat; ++i) {
      if (f[i] != 1 || (held != nullptr && held[i] != 0)) {
        return false;
      }
    }
  }
  return true;
}

/// Do nodes [begin, end) of a row stand, where the next remap wants them?
template <int Dim> bool nodes_rest(const Block<Dim>& b, int r, int begin, int end) {
  int moving = 0;
  for (std::size_t d = 0; d < Dim && moving == 0; ++d) {
    const double *u = b.velocity[d].row(r), *x = b.position[d].row(r);
    const double* target = b.motion.remaps() ? b.target[d].row(r) : x;
    const double* jump = b.any_sliding() ? b.sliding.jump[d].row(r) : u;
    for (int i = begin; i < end; ++i) {
      moving += (u[i] != 0) | (jump[i] != 0) | (x[i] != target[i]) ? 1 : 0;
    }
  }
  return moving == 0;
}

template <int Dim> bool cells_rest(const Block<Dim>& b, int begin, int end, int j, int k, bool spall) {
  for (int side = 0; side < (1 << (Dim - 1)); ++side) {
    if (!nodes_rest(b, b.grid.node_row(j + (side & 1), k + (side >> 1)), begin, end + 1)) {
      return false;
    }
  }
  const int r = b.grid.cell_row(j, k);
  if (!nothing_pulls(b, begin, end, j, k) || !pure_whole(b, begin, end, r)) {
    return false;
  }
  const std::int8_t* owner = b.owner_row(r);
  for (int i = begin; i < end; ++i) {
    if (owner[i] == mixed_cell && !mixed_rests(b, i, j, k, spall)) {
      return false;
    }
  }
  return true;
}

/// The hull of a row's restless tiles; only its ends are looked for.
template <int Dim> Span restless(const Block<Dim>& b, int j, int k, bool spall) {
  Span s = b.awake.cells(b.grid.cell_row(j, k));
  constexpr int tile = Awake::tile;
  while (!s.empty() && cells_rest(b, s.begin, std::min(s.begin + tile, s.end), j, k, spall)) {
    s.begin = std::min(s.begin + tile, s.end);
  }
  while (!s.empty()) {
    const int last = (s.end - 1) / tile * tile;
    if (!cells_rest(b, last, s.end, j, k, spall)) {
      break;
    }
    s.end = last;
  }
  return s;
}

template <int Dim> bool may_sleep(const Block<Dim>& b) {
  const bool stands = b.motion.policy == MotionPolicy::lagrangian || b.motion.policy == MotionPolicy::eulerian;
  return stands && b.skew[0].empty() && !b.boundary.any(BoundaryKind::inflow);
}

/// Mixed awake cells of each slab.
template <int Dim> std::vector<int> count_mixed(const Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  std::vector<int> mixed(static_cast<std::size_t>(g.slabs()));
  parallel_awake(pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      int count = 0;
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        const Span cells = b.awake.cells(r);
        const std::int8_t* owner = b.owner_row(r);
        count += static_cast<int>(std::count(owner + cells.begin, owner + cells.end, mixed_cell));
      }
      mixed[static_cast<std::size_t>(s)] = count;
    }
  });
  return mixed;
}

/// Beside layers inside the mesh everything is awake: slabs around these rows of nodes.
template <int Dim> Span beside_layers(const Scene<Dim>& scene, const Block<Dim>& b) {
  const Embedding<Dim>* e = embedding_of(scene, b);
  return e == nullptr || e->rows.empty() ? Span{0, 0} : Span{e->rows.begin - Awake::reach, e->rows.end + Awake::reach};
}

template <int Dim> void find_awake(const Scene<Dim>& scene, Block<Dim>& b, bool remapped) {
  const Grid& g = b.grid;
  const Span layers = beside_layers(scene, b);
  std::vector<Span> found(static_cast<std::size_t>(g.cell_rows()));
  parallel_awake(*scene.pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const bool beside = s >= layers.begin && s < layers.end;
        found[static_cast<std::size_t>(g.cell_row(j, k))] = beside ? Span{0, g.cells[0]} : restless(b, j, k, scene.numerics.spall);
      }
    }
  });
  b.awake.follow(g, std::move(found), remapped || !b.motion.remaps());
}

} // namespace

template <int Dim> double still_speed_of(const Block<Dim>& b) {
  constexpr double few_ulp = 4 * std::numeric_limits<double>::epsilon();
  double slowest = std::numeric_limits<double>::infinity();
  for (const MaterialSlot& slot : b.materials) {
    if (!slot.is_void) {
      slowest = std::min(slowest, sound_speed_squared(slot.material.eos, slot.reference.rho, slot.reference.e));
    }
  }
  return std::isfinite(slowest) && slowest > 0 ? few_ulp * std::sqrt(slowest) : 0.0;
}

template <int Dim> void hold_still(Block<Dim>& b, int r, BoundaryEffect& effect) {
  for_slow_nodes<Dim>(b, b.next_velocity, b.sliding.next_jump, r, [&](int i) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double reaction = -b.node_mass.row(r)[i] * b.next_velocity[d].row(r)[i];
      effect.impulse[d] += reaction;
      effect.work += reaction * 0.5 * b.velocity[d].row(r)[i];
    }
    stop<Dim>(b.next_velocity, b.sliding.next_jump, r, i);
  });
}

template <int Dim> void hold_still(Block<Dim>& b, ThreadPool& pool, Ledger& ledger) {
  const Grid& g = b.grid;
  const int planes = g.slabs() + 1;
  std::vector<Held> held(static_cast<std::size_t>(planes));
  parallel_awake(pool, &b.awake, planes, [&](int begin, int end, int) {
    for (int plane = begin; plane < end; ++plane) {
      for (int q = 0; q < (Dim == 3 ? g.cells[1] + 1 : 1); ++q) {
        const int r = Dim == 3 ? g.node_row(q, plane) : g.node_row(plane, 0);
        Held& h = held[static_cast<std::size_t>(plane)];
        for_slow_nodes<Dim>(b, b.velocity, b.sliding.jump, r, [&](int i) {
          for (std::size_t d = 0; d < Dim; ++d) {
            const double m = b.node_mass.row(r)[i], u = b.velocity[d].row(r)[i];
            h.momentum[d] += m * u;
            h.energy += 0.5 * m * u * u;
          }
          stop<Dim>(b.velocity, b.sliding.jump, r, i);
        });
      }
    }
  });
  for (const Held& h : held) {
    ledger.remap_kinetic_loss += h.energy;
    for (std::size_t d = 0; d < Dim; ++d) {
      ledger.momentum_out[d] += h.momentum[d];
    }
  }
}

template <int Dim> void follow_rest(Scene<Dim>& scene, Block<Dim>& b, bool remapped) {
  b.awake_steps += b.awake.share();
  if (scene.numerics.sleeping && (scene.layers.empty() || embedding_of(scene, b) != nullptr) && may_sleep(b)) {
    find_awake(scene, b, remapped);
  }
  if (scene.pool->size() > 1 && b.materials.size() > 1) {
    b.awake.weigh(b.grid, count_mixed(b, *scene.pool));
  }
}

template double still_speed_of<2>(const Block<2>&);
template double still_speed_of<3>(const Block<3>&);
template void hold_still<2>(Block<2>&, int, BoundaryEffect&);
template void hold_still<3>(Block<3>&, int, BoundaryEffect&);
template void hold_still<2>(Block<2>&, ThreadPool&, Ledger&);
template void hold_still<3>(Block<3>&, ThreadPool&, Ledger&);
template void follow_rest<2>(Scene<2>&, Block<2>&, bool);
template void follow_rest<3>(Scene<3>&, Block<3>&, bool);

} // namespace ballast
