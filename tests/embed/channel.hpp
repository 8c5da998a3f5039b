// A channel of water with a plate across it, shared by the tests of embedding.
#pragma once

#include "ale/embedding.hpp"
#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "ale/simulation.hpp"
#include "tests/layers/stacks.hpp"

#include <cmath>
#include <functional>

namespace ballast {

/// Water as the prototypes have it: rho 1000, gamma 4.4, p_inf 6e8, c 1624.8 m/s.
inline Material channel_water() {
  Material m;
  m.name = "water";
  m.eos = StiffenedGas{4.4, 6e8};
  m.density = 1000;
  m.specific_energy = std::get<StiffenedGas>(m.eos).energy(1000, 0);
  m.spall_pressure = 0;
  return m;
}

struct ChannelState {
  bool filled = true;
  double density = 1000, specific_energy = 0, speed = 0;
};

/// Cells of `cell` m from 0 to `length` along the last axis, `across` of them wide between walls; `state` gives what is at a cell's
/// middle; outside it void.
template <int Dim = 2> Block<Dim> channel(double length, double cell, int across, const std::function<ChannelState(double)>& state, const Material& material = channel_water()) {
  Block<Dim> b;
  b.motion = {MotionPolicy::eulerian, 1};
  b.materials.push_back(make_slot(material, 0));
  b.materials.push_back(make_void());
  const int n = static_cast<int>(std::lround(length / cell));
  std::array<std::vector<double>, 3> lines;
  for (std::size_t d = 0; d + 1 < Dim; ++d) {
    lines[d] = even_lines(0, across * cell, across);
  }
  lines[Dim - 1] = even_lines(0, length, n);
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    const ChannelState s = state(((Dim == 3 ? k : j) + 0.5) * cell);
    const CellPart part{s.filled ? 0 : 1, 1, s.filled ? s.density : 0, s.filled ? s.specific_energy : 0};
    fill_cell<Dim>(b, i, j, k, std::span(&part, 1));
  });
  set_velocity(b, [&](const std::array<double, Dim>& x, std::array<double, Dim>& u) {
    u = {};
    u[Dim - 1] = state(x[Dim - 1]).speed;
  });
  b.boundary.normal = {{{0, 0}, {1, 1}, {2, 2}}};
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    b.boundary.side[axis] = {{{BoundaryKind::symmetry, 0}, {BoundaryKind::symmetry, 0}}};
  }
  return b;
}

/// A Hooke plate across the channel.
template <int Dim = 2> Layers<Dim> plate_across(const HookeSolid& solid, double width, int across, double from, double to, int elements) {
  LayerInput in;
  in.name = "plate";
  in.model = solid;
  for (std::size_t d = 0; d + 1 < Dim; ++d) {
    in.lines[d] = even_lines(0, width, across);
    in.edge[d] = {LayerEdge::symmetry, LayerEdge::symmetry};
  }
  in.levels = even_lines(from, to, elements);
  in.layers = 1;
  in.through = elements;
  Layers<Dim> l;
  l.stack = make_stack<Dim>(in);
  return l;
}

template <int Dim> void embed(Scene<Dim>& scene) {
  scene.embedded.push_back(std::make_shared<Embedding<Dim>>());
  prepare(scene);
}

struct ChannelSums {
  double mass = 0, momentum = 0, energy = 0, kinetic = 0;
};
template <int Dim> ChannelSums channel_sums(const Scene<Dim>& scene) {
  const Totals b = totals(scene.blocks[0]);
  ChannelSums out{b.mass[0], b.momentum[Dim - 1] + scene.ledger.momentum_out[Dim - 1], b.kinetic_energy + b.internal() + scene.ledger.embedded_given + scene.ledger.remap_kinetic_loss + scene.ledger.void_work - scene.ledger.boundary_work + scene.ledger.sliver_energy, b.kinetic_energy};
  for (const Layers<Dim>& l : scene.layers) {
    const LayerTotals t = totals(l.stack);
    out.momentum += t.momentum[Dim - 1] - l.ledger.edge_impulse[Dim - 1];
    out.energy += t.leapfrog_kinetic + t.internal + t.hourglass + t.shock_heat + l.ledger.contact_loss + l.ledger.step_change - l.ledger.load_work;
    out.kinetic += t.kinetic;
  }
  return out;
}

} // namespace ballast
