// The Lagrangian step: predict, corner forces, accelerate, move, then work, closure, strength, state.
#include "ale/absorbing.hpp"
#include "ale/corner_slab.hpp"
#include "ale/embedding_cells.hpp"
#include "ale/lagrange_parts.hpp"
#include "ale/layer_coupling.hpp"
#include "ale/outflow.hpp"
#include "ale/phases.hpp"
#include "ale/rest.hpp"
#include "ale/step_undo.hpp"
#include "ale/tissue_half.hpp"
#include "ale/tissue_update.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace ballast {

namespace {

template <int Dim>
void fill_slab(const Scene<Dim>& scene, const Embedding<Dim>* embedded, const Block<Dim>& b, const ForceCoefficients& c, int slab, CornerSlab<Dim>& out) {
  const Grid& g = b.grid;
  if (slab < 0 || slab >= g.slabs()) {
    out.clear();
    return;
  }
  for (int q = 0; q < g.rows_per_slab(); ++q) {
    const auto [j, k] = g.in_slab(slab, q);
    const Span cells = b.awake.cells(g.cell_row(j, k));
    const CornerRows<Dim> rows = out.row_for(q, cells);
    if (!cells.empty()) {
      corner_forces(b, ForceRows<Dim>(b, j, k).from(cells.begin), c, cells.count(), rows.from(cells.begin));
      if (embedded != nullptr) {
        override_forces(scene, *embedded, j, k, rows);
      }
    }
  }
}

/// Node velocities of one row from forces; boundary conditions come after, by rows.
template <int Dim>
void accelerate_row(Block<Dim>& b, int r, double dt, Span nodes, double* const (&force)[Dim]) {
  const double* m = b.node_mass.row(r);
  for (std::size_t d = 0; d < Dim; ++d) {
    const double *f = force[d], *u = b.velocity[d].row(r);
    double* next = b.next_velocity[d].row(r);
#pragma omp simd
    for (int i = nodes.begin; i < nodes.end; ++i) {
      next[i] = u[i] + (m[i] > 0 ? dt * f[i] / m[i] : 0.0);
    }
  }
}

/// The same where two velocities meet: the force along their jump goes to both as they move the node (remap/mesh.hpp,
/// Sliding), so the jump changes.
template <int Dim> void accelerate_apart(Block<Dim>& b, int r, double dt, Span nodes, double* const (&force)[Dim]) {
  remap::Sliding<Dim>& s = b.sliding;
  const double *m = b.node_mass.row(r), *ms = s.node_mass.row(r);
  for (std::size_t d = 0; d < Dim; ++d) {
    std::copy(s.jump[d].row(r) + nodes.begin, s.jump[d].row(r) + nodes.end, s.next_jump[d].row(r) + nodes.begin);
  }
  for (int i = nodes.begin; i < nodes.end; ++i) {
    double square = 0, along = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double jump = s.jump[d].row(r)[i];
      square += jump * jump;
      along += jump * force[d][i];
    }
    const double rest = m[i] - ms[i];
    if (!(square > 0)) { // where it is, both have mass (ale/remap_block)
      continue;
    }
    const double a = remap::node_follows(ms[i], m[i]), impulse = dt * along / square; // by m/s of jump
    const double du = a * impulse / ms[i], dv = (1 - a) * impulse / rest;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double jump = s.jump[d].row(r)[i];
      b.next_velocity[d].row(r)[i] += jump * (a * du + (1 - a) * dv - impulse / m[i]);
      s.next_jump[d].row(r)[i] += jump * (du - dv);
    }
  }
}

/// Applies the boundaries to the new velocities of node row (j, k); f is the row's force.
template <int Dim>
void bound_row(Block<Dim>& b, int j, int k, double dt, double* const (&force)[Dim], BoundaryEffect& effect) {
  const Grid& g = b.grid;
  const int r = b.grid.node_row(j, k);
  const Span nodes = b.awake.nodes(r);
  const double* m = b.node_mass.row(r);
  const int index[3] = {0, j, k};
  const auto set = [&](int i, int axis, int side) {
    const int component = std::max(0, b.boundary.normal_of(axis, side)); // of a curved side: not used
    const auto a = static_cast<std::size_t>(component);
    const BoundarySide& s = b.boundary.at(axis, side);
    double& next = b.next_velocity[a].row(r)[i];
    const double u = b.velocity[a].row(r)[i];
    if (b.boundary.fixes_normal_velocity(axis, side)) {
      next = s.velocity;
    } else if (s.kind == BoundaryKind::outflow) {
      next = outflow_velocity(b, axis, side, {i, j, k}, dt);
    } else {
      return;
    }
    const double reaction = m[i] * (next - u) - dt * force[component][i];
    effect.impulse[a] += reaction;
    effect.work += reaction * 0.5 * (u + next);
  };
  for (int axis = 1; axis < Dim; ++axis) {
    const int n = g.cells[static_cast<std::size_t>(axis)];
    for (int side = 0; side < 2; ++side) {
      if (index[axis] == (side == 0 ? 0 : n)) {
        for (int i = nodes.begin; i < nodes.end; ++i) {
          set(i, axis, side);
        }
      }
    }
  }
  if (nodes.begin == 0) {
    set(0, 0, 0);
  }
  if (nodes.end == g.cells[0] + 1) {
    set(g.cells[0], 0, 1);
  }
}

template <int Dim>
BoundaryEffect force_pass(Scene<Dim>& scene, Block<Dim>& b, double dt) {
  const Grid& g = b.grid;
  const int planes = g.slabs() + 1;
  const ForceCoefficients c = force_coefficients(b, scene.numerics, dt);
  const Embedding<Dim>* embedded = embedding_of(scene, b);
  const bool absorbs = b.boundary.any(BoundaryKind::absorbing);
  std::vector<BoundaryEffect> effects(static_cast<std::size_t>(planes));
  parallel_awake(*scene.pool, &b.awake, planes, [&](int begin, int end, int) {
    CornerSlab<Dim> below(g), here(g);
    std::vector<double> buffer(static_cast<std::size_t>(Dim * (g.cells[0] + 1)));
    double* force[Dim];
    for (int d = 0; d < Dim; ++d) {
      force[d] = buffer.data() + d * (g.cells[0] + 1);
    }
    fill_slab(scene, embedded, b, c, begin - 1, below);
    for (int plane = begin; plane < end; ++plane) {
      fill_slab(scene, embedded, b, c, plane, here);
      for (int q = 0; q < (Dim == 3 ? g.cells[1] + 1 : 1); ++q) {
        const int j = Dim == 3 ? q : plane, k = Dim == 3 ? plane : 0;
        const int r = g.node_row(j, k);
        const Span nodes = b.awake.nodes(r);
        if (nodes.empty()) {
          continue;
        }
        for (double* f : force) {
          std::fill(f + nodes.begin, f + nodes.end, 0.0);
        }
        gather(below, here, q, nodes, force);
        accelerate_row(b, r, dt, nodes, force);
        if (b.any_sliding()) {
          accelerate_apart(b, r, dt, nodes, force);
        }
        if (absorbs) {
          absorb_row(b, j, k, dt, force, effects[static_cast<std::size_t>(plane)]);
        }
        bound_row(b, j, k, dt, force, effects[static_cast<std::size_t>(plane)]);
        hold_still(b, r, effects[static_cast<std::size_t>(plane)]);
        for (std::size_t d = 0; d < Dim; ++d) {
          const double *x = b.position[d].row(r), *u = b.velocity[d].row(r), *v = b.next_velocity[d].row(r);
          double* next = b.next_position[d].row(r);
#pragma omp simd
          for (int i = nodes.begin; i < nodes.end; ++i) {
            next[i] = x[i] + 0.5 * dt * (u[i] + v[i]);
          }
        }
      }
      below.swap(here);
    }
  });
  BoundaryEffect total;
  for (const BoundaryEffect& e : effects) {
    total.work += e.work;
    for (std::size_t d = 0; d < 3; ++d) {
      total.impulse[d] += e.impulse[d];
    }
  }
  return total;
}

struct WorstCell {
  double ratio = 1; ///< V_new / V
  std::array<int, 3> cell = {-1, -1, -1};
};

template <int Dim> WorstCell move_cells(Scene<Dim>& scene, Block<Dim>& b) {
  const Grid& g = b.grid;
  std::vector<WorstCell> worst(static_cast<std::size_t>(g.slabs()));
  const bool embedded = embedding_of(scene, b) != nullptr;
  parallel_awake(*scene.pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        const Span cells = b.awake.cells(r);
        cell_volumes(b, b.next_position, j, k, cells, b.next_volume.row(r));
        const double *v = b.volume.row(r), *next = b.next_volume.row(r);
        WorstCell& w = worst[static_cast<std::size_t>(s)];
        for (int i = cells.begin; i < cells.end; ++i) {
          if (!(next[i] >= w.ratio * v[i]) && !std::isnan(w.ratio)) {
            const double now = embedded ? std::min(v[i], whole_volume<Dim>(b, b.position, i, j, k)) : v[i]; // what a body has buried may fill more
            w = next[i] >= w.ratio * now ? w : WorstCell{next[i] / now, {i, j, k}};
          }
        }
      }
    }
  });
  WorstCell least;
  for (const WorstCell& w : worst) {
    least = !(w.ratio >= least.ratio) && !std::isnan(least.ratio) ? w : least; // the first NaN wins
  }
  return least;
}

/// Layers move and touch the blocks, whose cells then move anew. False: a mesh with layers inside is to take the step again, smaller, with layers and ledger as they were.
template <int Dim> bool move_layers(Scene<Dim>& scene, const Clock& clock, bool again) {
  if (scene.layers.empty()) {
    return true;
  }
  for (const auto& e : scene.embedded) {
    load_layers(scene, *e, clock.dt);
  }
  step_layers(scene, clock.dt);
  for (const auto& e : scene.embedded) {
    follow_layers(scene, *e, clock.dt);
  }
  for (Block<Dim>& b : scene.blocks) {
    const WorstCell w = move_cells(scene, b);
    if (!(w.ratio > 0) && again && embedding_of(scene, b) != nullptr) {
      return false;
    }
    if (!(w.ratio > 0)) {
      throw NumericalFailure(fmt::format("block {}, cell ({}, {}, {}), material {}: contact with the layers would turn it inside out at time {:g} s, dt {:g} s",
                                         b.name, w.cell[0], w.cell[1], w.cell[2], contents(b, w.cell), clock.time, clock.dt));
    }
  }
  for (const auto& e : scene.embedded) {
    set_squeeze(scene, *e, clock.dt);
    embedded_volumes(scene, *e);
  }
  return true;
}

/// Work of all blocks. The number of the first where tissue could not be integrated, or -1.
template <int Dim> int work_passes(Scene<Dim>& scene, double dt, std::vector<StepSums<Dim>>& sums) {
  for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
    sums[ib] = work_pass(scene, scene.blocks[ib], dt);
  }
  const auto failed = std::find_if(sums.begin(), sums.end(), [](const StepSums<Dim>& s) { return s.trouble.has_value(); });
  return failed == sums.end() ? -1 : static_cast<int>(failed - sums.begin());
}

/// Keeps all blocks' cells if any block may have to take the step again. Returns whether.
template <int Dim> bool prepare_undo(Scene<Dim>& scene) {
  const bool any = std::any_of(scene.blocks.begin(), scene.blocks.end(), [](const Block<Dim>& b) { return integrates_tissue(b); });
  scene.undo.resize(any ? scene.blocks.size() : 0);
  return any;
}

/// Layers and ledger as before the step, but for what counts attempts.
template <int Dim> void put_back(Scene<Dim>& scene, const std::vector<Layers<Dim>>& layers, const Ledger& ledger) {
  scene.layers = layers;
  const Ledger spent = std::exchange(scene.ledger, ledger);
  scene.ledger.retries = spent.retries;
  scene.ledger.tissue_counts = spent.tissue_counts;
}

/// Cells, too, and what embeddings know of the layers, which are put back.
template <int Dim> void undo_work(Scene<Dim>& scene, const std::vector<StepSums<Dim>>& sums) {
  for (std::size_t ib = 0; ib < scene.undo.size(); ++ib) {
    undo_rows(scene.blocks[ib], scene.undo[ib]);
  }
  for (const auto& e : scene.embedded) {
    find_least_thickness(scene, *e);
  }
  book_counts(scene, sums, false);
}

constexpr double smallest_volume_ratio = 0.2; // of one step; below it the step is retried smaller
constexpr int most_retries = 30;

} // namespace

template <int Dim> void lagrange_step(Scene<Dim>& scene, Clock& clock) {
  std::vector<BoundaryEffect> effects(scene.blocks.size());
  std::vector<StepSums<Dim>> sums(scene.blocks.size());
  const bool undoes = prepare_undo(scene);
  const auto layers = scene.embedded.empty() && !undoes ? std::vector<Layers<Dim>>{} : scene.layers;
  const Ledger ledger = scene.ledger; // both as they were
  for (int attempt = 0;; ++attempt) {
    const bool again = attempt < most_retries;
    WorstCell worst;
    std::size_t where = 0;
    relax_to_half(scene, clock.dt);
    for (const auto& e : scene.embedded) {
      cut_forces(scene, *e, clock.dt);
    }
    for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
      effects[ib] = force_pass(scene, scene.blocks[ib], clock.dt);
      const WorstCell w = move_cells(scene, scene.blocks[ib]);
      if (w.ratio < worst.ratio || std::isnan(w.ratio)) {
        worst = w;
        where = ib;
      }
    }
    if (worst.ratio >= smallest_volume_ratio) {
      const bool moved = move_layers(scene, clock, again);
      const int failed = moved ? work_passes(scene, clock.dt, sums) : -1;
      if (moved && failed < 0) {
        break;
      }
      if (failed >= 0) {
        where = static_cast<std::size_t>(failed);
        worst.cell = sums[where].trouble->cell;
        if (!again || !undoes) {
          book_counts(scene, sums, true);
          throw_trouble(scene.blocks[where], *sums[where].trouble, clock);
        }
      }
      put_back(scene, layers, ledger);
      if (failed >= 0) {
        undo_work(scene, sums);
      }
    } else if (!again || std::isnan(worst.ratio)) {
      throw NumericalFailure(fmt::format(
          "block {}, cell ({}, {}, {}), material {}: volume would fall to {:g} of its value at time {:g} s, dt {:g} s",
          scene.blocks[where].name, worst.cell[0], worst.cell[1], worst.cell[2],
          contents(scene.blocks[where], worst.cell), worst.ratio, clock.time, clock.dt));
    }
    clock.dt *= 0.5;
    clock.limit = {clock.dt, static_cast<int>(where), worst.cell, -1, DtCause::retry};
    ++scene.ledger.retries;
  }
  book_counts(scene, sums, true);
  for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
    Block<Dim>& b = scene.blocks[ib];
    scene.ledger.boundary_work += effects[ib].work;
    for (std::size_t d = 0; d < Dim; ++d) {
      scene.ledger.momentum_out[d] -= effects[ib].impulse[d];
    }
    scene.ledger.void_work += sums[ib].void_work;
    scene.ledger.ambient_work -= b.reference_pressure * sums[ib].swept_volume;
    book_tissue(scene, sums[ib]);
    if (sums[ib].failed > 0) {
      const auto& c = sums[ib].failed_cell;
      throw NumericalFailure(fmt::format("block {}, from cell ({}, {}, {}) on, material {}: the return to the yield surface (equivalent stress, Pa) did not "
          "converge in {} cells at time {:g} s",
          b.name, c[0], c[1], c[2], contents(b, c), sums[ib].failed, clock.time));
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      b.position[d].swap(b.next_position[d]);
      b.velocity[d].swap(b.next_velocity[d]);
    }
    if (b.any_sliding()) {
      for (std::size_t d = 0; d < Dim; ++d) {
        b.sliding.jump[d].swap(b.sliding.next_jump[d]);
      }
    }
    b.volume.swap(b.next_volume);
    b.left_target = b.at_target;
    b.at_target = false;
  }
}

template void lagrange_step<2>(Scene<2>&, Clock&);
template void lagrange_step<3>(Scene<3>&, Clock&);

} // namespace ballast
