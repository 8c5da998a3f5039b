#include "ale/simulation.hpp"

#include "ale/embedding_remap.hpp"
#include "ale/layer_coupling.hpp"
#include "ale/rest.hpp"
#include "ale/strength_update.hpp"
#include "ale/traction.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {

namespace {

/// A step that has collapsed would go on for ever.
template <int Dim> void check_step(const Scene<Dim>& scene, const DtLimit& stable, const Clock& clock) {
  if (stable.dt < scene.numerics.dt_min) {
    const Block<Dim>& b = scene.blocks[static_cast<std::size_t>(stable.block)];
    throw NumericalFailure(fmt::format("block {}, cell ({}, {}, {}), material {}: the stable step has fallen to {:.3g} s by {} at time {:.9g} s, below {:.3g} s (numerics.dt_min)",
                                       b.name, stable.cell[0], stable.cell[1], stable.cell[2], contents(b, stable.cell), stable.dt, name_of(stable.cause), clock.time, scene.numerics.dt_min));
  }
}

} // namespace

template <int Dim> void advance(Scene<Dim>& scene, Clock& clock) {
  for (const auto& e : scene.embedded) {
    set_squeeze(scene, *e, clock.dt);
    update_cells(scene, *e);
    tie_nodes(scene, *e);
  }
  const DtLimit stable = stable_dt(scene);
  check_step(scene, stable, clock);
  clock.choose(stable, scene.numerics);
  lagrange_step(scene, clock);
  for (Block<Dim>& block : scene.blocks) {
    const bool due = remap_due(block, clock.step, *scene.pool);
    if (due) {
      remap_block(scene, block, clock.step);
    } else if (Embedding<Dim>* e = embedding_of(scene, block)) {
      pool_embedded(scene, *e, block);
      if (block.any_sliding()) {
        settle_jumps(block, *scene.pool);
      }
    }
    new_state(scene, block, due);
    follow_rest(scene, block, due);
  }
  clock.advance();
}

template <int Dim> void new_state(Scene<Dim>& scene, Block<Dim>& block, bool remapped) {
  update_state(block, *scene.pool);
  if (remapped) {
    scene.ledger.closed_voids += close_voids(block, *scene.pool, scene.numerics.spall);
  }
  if (scene.numerics.spall) {
    scene.ledger.spalled_cells += open_voids(block, *scene.pool);
  }
  update_traction(block, *scene.pool);
}

template <int Dim>
bool run(Scene<Dim>& scene, Clock& clock, const std::vector<Observer<Dim>*>& observers) {
  bool go_on = true;
  while (!clock.done() && go_on) {
    advance(scene, clock);
    for (Observer<Dim>* observer : observers) {
      go_on = observer->record(scene, clock) && go_on;
    }
  }
  return clock.done();
}

void Clock::choose(const DtLimit& stable, const Numerics& n) {
  limit = stable;
  const auto cap = [&](double value, DtCause cause) {
    if (value < limit.dt) {
      limit = {value, limit.block, {-1, -1, -1}, -1, cause};
    }
  };
  cap(n.dt_max, DtCause::maximum);
  if (step == 0) {
    cap(n.dt_initial > 0 ? n.dt_initial : 0.1 * limit.dt, DtCause::growth);
  } else {
    cap(n.dt_growth * dt, DtCause::growth);
  }
  const double unclipped = limit.dt;
  const double left = end_time - time;
  if (left <= unclipped * (1 + 1e-9)) {
    cap(left * (1 + 1e-14), DtCause::end);
    limit.dt = std::min(limit.dt, left);
  } else if (left < 2 * unclipped) {
    cap(0.5 * left, DtCause::end); // two equal steps rather than a tiny last one
  }
  dt = limit.dt;
}

void Clock::advance() {
  time = limit.cause == DtCause::end && end_time - (time + dt) <= 1e-9 * dt ? end_time : time + dt;
  ++step;
  ++census[static_cast<std::size_t>(limit.cause)];
}

template <int Dim> void prepare(Scene<Dim>& scene) {
  for (const auto& e : scene.embedded) {
    prepare_embedding(scene, *e);
  }
  for (Block<Dim>& b : scene.blocks) {
    scene.ledger.mass_out.resize(std::max(scene.ledger.mass_out.size(), b.materials.size()), 0.0);
    compute_node_mass(b, *scene.pool);
    for (std::size_t d = 0; d < Dim; ++d) {
      exchange_nodes(b.grid, b.boundary, static_cast<int>(d), b.velocity[d]);
    }
    b.closure = scene.numerics.closure;
    b.still_speed = still_speed_of(b);
    start_motion(b);
    if (scene.numerics.subzonal_pressure > 0) {
      mark_subzones(b);
    }
    pull_back_to_yield(b, *scene.pool);
    update_state(b, *scene.pool);
    update_traction(b, *scene.pool);
  }
  prepare_layers(scene);
}

template void advance<2>(Scene<2>&, Clock&);
template void advance<3>(Scene<3>&, Clock&);
template void new_state<2>(Scene<2>&, Block<2>&, bool);
template void new_state<3>(Scene<3>&, Block<3>&, bool);
template bool run<2>(Scene<2>&, Clock&, const std::vector<Observer<2>*>&);
template bool run<3>(Scene<3>&, Clock&, const std::vector<Observer<3>*>&);
template void prepare<2>(Scene<2>&);
template void prepare<3>(Scene<3>&);

} // namespace ballast
