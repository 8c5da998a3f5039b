#include "ale/layer_coupling.hpp"

#include "ale/block_surface.hpp"
#include "ale/embedding.hpp"
#include "ale/layers/layer_erosion.hpp"
#include "core/error.hpp"
#include "core/stopwatch.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {

namespace {

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

constexpr double free_rim = 0.1; ///< ContactSurface::rim where edges do not lie over each other

/// Of a layer at rest, m.
template <int Dim> double thickness_of(const LayerStack<Dim>& s) { return (s.levels.back() - s.levels.front()) / s.grid.layers; }

/// Null: these two have not been near each other yet.
template <int Dim> ContactState<Dim>* state_of(Layers<Dim>& l, int other, int layer, int other_layer) {
  for (StackContact<Dim>& c : l.with_stacks) {
    if (c.other == other && c.layer == layer && c.other_layer == other_layer) {
      return &c.state;
    }
  }
  return nullptr;
}

/// Is all of a layer farther from all of another, above it, than a substep's way?
template <int Dim> bool are_apart(const LayerStack<Dim>& lower, int layer, const LayerStack<Dim>& upper, int other_layer) {
  const auto end = [](const LayerStack<Dim>& s, int q, bool high) {
    const int plane = q * (s.grid.through + 1) + (high ? s.grid.through : 0);
    const auto first = s.position[Dim - 1].begin() + static_cast<std::ptrdiff_t>(s.node(0, 0, plane)), last = first + static_cast<std::ptrdiff_t>(s.node(0, 0, 1));
    return high ? *std::max_element(first, last) : *std::min_element(first, last);
  };
  return end(upper, other_layer, false) - end(lower, layer, true) > 0.5 * (thickness_of(lower) + thickness_of(upper));
}

/// The contact of two stacks, the second above the first: of the layers on either that a block between them would meet. The rougher one's friction.
template <int Dim> void touch_stacks(Layers<Dim>& l, Layers<Dim>& other, int number, double h, ThreadPool& pool) {
  const Stopwatch watch(l.contact_seconds);
  const std::vector<char> mine = exposed(l.stack, false), its = exposed(other.stack, true);
  ContactSettings settings = l.contact;
  settings.friction = std::max(l.contact.friction, other.contact.friction);
  const bool flush = l.stack.lines[0].back() == other.stack.lines[0].back() && (Dim == 2 || l.stack.lines[1].back() == other.stack.lines[1].back());
  for (std::size_t a = 0; a < mine.size(); ++a) {
    for (std::size_t b = 0; b < its.size(); ++b) {
      const int layer = static_cast<int>(a), other_layer = static_cast<int>(b);
      if (mine[a] == 0 || its[b] == 0 || (state_of(l, number, layer, other_layer) == nullptr && are_apart(l.stack, layer, other.stack, other_layer))) {
        continue;
      }
      ContactSurface<Dim> first = layer_surface(l.stack, l.stack.velocity, layer, true, l.slidelines.held, &l.load);
      ContactSurface<Dim> second = layer_surface(other.stack, other.stack.velocity, other_layer, false, other.slidelines.held, &other.load);
      if (!flush) { // the edge of one lies somewhere on the other
        first.rim = second.rim = free_rim;
      }
      ContactState<Dim>* state = state_of(l, number, layer, other_layer);
      if (state == nullptr) {
        l.with_stacks.push_back({number, layer, other_layer, {}});
        state = &l.with_stacks.back().state;
      }
      const ContactReport report = resolve_contact(first, second, h, settings, *state, &pool);
      book(l.ledger, report);
      const double thinner = std::min(thickness_of(l.stack), thickness_of(other.stack));
      l.closing = std::max(l.closing, report.closing / thinner);
    }
  }
}

/// All contact of a substep: between layers, between stacks, last with blocks: what is heaviest has the last word.
template <int Dim> void touch(Scene<Dim>& scene, std::vector<std::vector<BlockSurface<Dim>>>& blocks, double dt, double done, double h) {
  ThreadPool& pool = *scene.pool;
  for (Layers<Dim>& l : scene.layers) {
    const Stopwatch watch(l.contact_seconds);
    const SlidelineReport report = resolve_slidelines(l.stack, h, l.stack.velocity, pool, l.contact, l.slidelines, &l.load);
    book(l.ledger, report.contact);
    l.closing = std::max(l.closing, report.closing_share);
  }
  for (std::size_t a = 0; a < scene.layers.size(); ++a) {
    for (std::size_t b = a + 1; b < scene.layers.size(); ++b) {
      touch_stacks(scene.layers[a], scene.layers[b], static_cast<int>(b), h, pool);
    }
  }
  for (Layers<Dim>& l : scene.layers) {
    const Stopwatch watch(l.contact_seconds);
    touch_blocks(l, blocks, dt, done, h, pool);
  }
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
    const auto load = [&](Layers<Dim>& l) { return scene.embedded.empty() ? nullptr : &l.load; };
    for (Layers<Dim>& l : scene.layers) {
      const Stopwatch watch(l.seconds);
      begin_substep<Dim>(l.stack, h, l.ledger, *scene.pool, load(l));
    }
    touch(scene, blocks, dt, done, h);
    for (Layers<Dim>& l : scene.layers) {
      const Stopwatch watch(l.seconds);
      end_substep<Dim>(l.stack, h, l.ledger, *scene.pool, load(l));
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
