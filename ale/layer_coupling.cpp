#include "ale/layer_coupling.hpp"

#include "ale/block_surface.hpp"
#include "ale/embedding.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace ballast {

namespace {

template <int Dim> bool has_hole(const LayerStack<Dim>& stack, int layer) {
  const LayerGrid& g = stack.grid;
  const auto begin = stack.alive.begin() + static_cast<std::ptrdiff_t>(stack.element(0, 0, layer * g.through));
  return std::find(begin, begin + g.through * g.elements[0] * g.elements[1], 0) != begin + g.through * g.elements[0] * g.elements[1];
}

/// The layers that a block may meet: the nearest, and those behind a layer with holes. From below if the stack lies above it.
template <int Dim> std::vector<char> exposed(const LayerStack<Dim>& stack, bool above) {
  const int count = stack.grid.layers;
  std::vector<char> out(static_cast<std::size_t>(count), 0);
  for (int q = 0; q < count; ++q) {
    const int layer = above ? q : count - 1 - q, nearer = above ? layer - 1 : layer + 1;
    out[static_cast<std::size_t>(layer)] = q == 0 || has_hole(stack, nearer) ? 1 : 0;
  }
  return out;
}

/// Adds the time until its end to a count of seconds.
class Stopwatch {
public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

private:
  double& seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Does a block's side face away from a stack?
template <int Dim> bool turned_away(const BlockSurface<Dim>& side, bool above) { return side.axis == Dim - 1 && side.side == (above ? 0 : 1); }

/// Substeps in what is left of a step of dt.
template <int Dim> int substeps_of(const Layers<Dim>& layers, double dt, double done) {
  const LayerTimestep limit = stable_step(layers.stack, layers.cfl);
  const double stable = limit.dt, left = 1 - done;
  constexpr double most = 1e6;
  if (!(left * dt <= most * stable)) {
    throw NumericalFailure(fmt::format("{}: a stable step of {:.3g} s, a millionth of the mesh's: layer {}, element ({}, {}) of level {}", layers.stack.name, stable, limit.level / layers.stack.grid.through, limit.i, limit.j, limit.level));
  }
  return std::max({1, static_cast<int>(std::lround(layers.substeps * left)), static_cast<int>(std::ceil(left * dt / stable * (1 - 1e-12)))});
}

void book(LayerLedger& ledger, const ContactReport& report) {
  ledger.friction_loss += report.friction_loss;
  ledger.behind += report.behind;
  ledger.deepest = std::max(ledger.deepest, report.deepest);
  for (std::size_t d = 0; d < 3; ++d) {
    ledger.edge_impulse[d] += report.impulse_sum[d]; // what symmetry planes and held edges took of oblique impulses
  }
}

/// The contact of all blocks' sides with the layers they may meet, in a fixed order.
template <int Dim> void touch_blocks(Layers<Dim>& l, std::vector<std::vector<BlockSurface<Dim>>>& blocks, double dt, double done, double h, ThreadPool& pool) {
  const auto count = static_cast<std::size_t>(l.stack.grid.layers);
  std::size_t pair = 0;
  for (std::size_t ib = 0; ib < blocks.size(); ++ib) {
    auto& sides = blocks[ib];
    const bool above = l.above[ib] != 0;
    const std::vector<char> open = exposed(l.stack, above);
    for (std::size_t s = 0; s < sides.size(); ++s) {
      for (std::size_t layer = 0; layer < count; ++layer, ++pair) {
        if (l.with_blocks.size() <= pair) {
          l.with_blocks.resize(pair + 1);
        }
        if (!open[layer] || turned_away(sides[s], above)) {
          continue;
        }
        ContactSurface<Dim> bullet = surface_at(sides[s], dt, done);
        ContactSurface<Dim> fabric = layer_surface(l.stack, l.stack.velocity, static_cast<int>(layer), !above, l.slidelines.held, &l.load);
        const ContactReport report = resolve_contact(bullet, fabric, h, l.contact, l.with_blocks[pair], &pool);
        tell_twins(sides, s);
        book(l.ledger, report);
      }
    }
  }
}

template <int Dim> void touch(Layers<Dim>& l, std::vector<std::vector<BlockSurface<Dim>>>& blocks, double dt, double done, double h, ThreadPool& pool) {
  const Stopwatch watch(l.contact_seconds);
  const SlidelineReport report = resolve_slidelines(l.stack, h, l.stack.velocity, pool, l.contact, l.slidelines, &l.load);
  touch_blocks(l, blocks, dt, done, h, pool); // last: what is heaviest has the last word in a step
  book(l.ledger, report.contact);
  l.closing = std::max(l.closing, report.closing_share);
}

} // namespace

template <int Dim> void prepare_layers(Scene<Dim>& scene) {
  for (Layers<Dim>& l : scene.layers) {
    l.slidelines.held = held_nodes(l.stack);
    const double middle = 0.5 * (l.stack.levels.front() + l.stack.levels.back());
    l.above.clear();
    for (const Block<Dim>& b : scene.blocks) {
      const RowField& z = b.position[Dim - 1];
      const double low = z.row(b.grid.node_row(0, 0))[0], high = z.row(b.grid.node_row(Dim == 2 ? b.grid.cells[1] : 0, Dim == 3 ? b.grid.cells[2] : 0))[0];
      l.above.push_back(middle > 0.5 * (low + high) ? 1 : 0);
    }
    update_forces(l.stack, 0, l.ledger, *scene.pool);
  }
}

template <int Dim> void step_layers(Scene<Dim>& scene, double dt) {
  if (scene.layers.empty()) {
    return;
  }
  std::vector<std::vector<BlockSurface<Dim>>> blocks;
  for (const Block<Dim>& b : scene.blocks) {
    blocks.push_back(embedding_of(scene, b) != nullptr ? std::vector<BlockSurface<Dim>>{} : gather_surfaces(b));
  }
  // The rest of the step in equal parts, looked at anew before each: a layer that stiffens shortens what is left.
  double done = 0;
  for (bool last = false; !last;) {
    int count = 1;
    for (const Layers<Dim>& l : scene.layers) {
      count = std::max(count, substeps_of(l, dt, done));
    }
    last = count == 1;
    const double h = (1 - done) * dt / count;
    for (Layers<Dim>& l : scene.layers) {
      const Stopwatch watch(l.seconds);
      substep<Dim>(l.stack, h, l.ledger, *scene.pool, [&] { touch(l, blocks, dt, done, h, *scene.pool); }, scene.embedded.empty() ? nullptr : &l.load);
      ++l.steps;
    }
    for (auto& sides : blocks) {
      for (auto& s : sides) {
        follow_way(s, dt, done, h);
      }
    }
    done += h / dt;
  }
  for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
    for (const auto& s : blocks[ib]) {
      scene.layers.front().ledger.contact_loss -= scatter_surface(scene.blocks[ib], s, dt);
    }
  }
}

template <int Dim> DtLimit stable_dt_of_layers(const Scene<Dim>& scene) {
  DtLimit limit;
  for (const Layers<Dim>& l : scene.layers) {
    const LayerTimestep step = stable_step(l.stack, l.cfl);
    if (step.dt < limit.dt) {
      limit.dt = step.dt;
      limit.cause = DtCause::sound;
    }
  }
  return limit;
}

template void prepare_layers<2>(Scene<2>&);
template void prepare_layers<3>(Scene<3>&);
template void step_layers<2>(Scene<2>&, double);
template void step_layers<3>(Scene<3>&, double);
template DtLimit stable_dt_of_layers<2>(const Scene<2>&);
template DtLimit stable_dt_of_layers<3>(const Scene<3>&);

} // namespace ballast
