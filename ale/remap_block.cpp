// Remap of a block: remap/ moves the conserved quantities, this brings the materials back to a state.
#include "ale/embedding_debris.hpp"
#include "ale/embedding_remap.hpp"
#include "ale/outflow.hpp"
#include "ale/phases.hpp"
#include "ale/rest.hpp"
#include "ale/strength_update.hpp"
#include "core/error.hpp"
#include "remap/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include <utility>

namespace ballast {

namespace {

/// JWL: a charge's products are hot, like a gas. Without a charge they hold on to their cold curve as condensed matter
/// does: less by the tension than at no pressure, or than zero.
double least_energy(const Jwl& products, const Material& m) {
  const double modulus = m.density * products.sound_speed_squared(m.density, m.specific_energy);
  const double tension = std::isfinite(m.spall_pressure) ? -0.5 * m.spall_pressure : 1e-3 * modulus;
  return products.detonation_energy > 0 ? 0.0 : std::min(0.0, m.specific_energy) - tension / (products.omega * m.density);
}

/// Where a return of kinetic energy must stop (J/kg): at half the spall tension at reference density (a thousandth
/// of the bulk modulus without spall), at zero pressure of a stiffened gas, at zero of a gas.
double least_energy(const Material& m) {
  if (const Condensed c = condensed(m.eos); c.rho0 > 0) {
    const double tension = std::isfinite(m.spall_pressure) ? -0.5 * m.spall_pressure : 1e-3 * c.rho0 * c.c0 * c.c0;
    return c.gamma0 > 0 ? -tension / (c.gamma0 * c.rho0) : -1e-3 * c.c0 * c.c0;
  }
  if (const auto* products = std::get_if<Jwl>(&m.eos)) {
    return least_energy(*products, m);
  }
  const auto* stiff = std::get_if<StiffenedGas>(&m.eos);
  return stiff ? stiff->energy(m.density, 0) : 0.0;
}

/// Does a following mesh move towards this side, so that what lies in its way comes in?
template <int Dim> bool passes(const Block<Dim>& b, int axis, int side) {
  const double heading = b.motion.side_speed[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
  return b.motion.policy == MotionPolicy::follow && b.outside && (side == 0 ? heading < 0 : heading > 0) && b.boundary.open(axis, side);
}

/// What comes in at such a side is at rest.
template <int Dim> void rest_ahead(const Block<Dim>& b, RowField& velocity) {
  const Grid& g = b.grid;
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      if (!passes(b, axis, side)) {
        continue;
      }
      const int n = g.cells[static_cast<std::size_t>(axis)];
      for (int k = Dim == 3 ? -g.ghost[2] : 0; k <= (Dim == 3 ? g.cells[2] + g.ghost[2] : 0); ++k) {
        for (int j = -g.ghost[1]; j <= g.cells[1] + g.ghost[1]; ++j) {
          const int index[3] = {0, j, k};
          if (axis > 0 && (side == 0 ? index[axis] >= 0 : index[axis] <= n)) {
            continue;
          }
          double* u = velocity.row(g.node_row(j, k));
          const int first = axis == 0 && side == 1 ? n + 1 : -g.ghost[0], last = axis == 0 && side == 0 ? -1 : g.cells[0] + g.ghost[0];
          std::fill(u + first, u + last + 1, 0.0);
        }
      }
    }
  }
}

/// What a ghost cell beyond a fed side holds.
template <int Dim> void beyond(const Block<Dim>& b, int axis, int side, const std::array<int, 3>& cell, std::vector<remap::Outside>& parts) {
  const BoundarySide& from = b.boundary.at(axis, side);
  if (from.kind == BoundaryKind::inflow) {
    parts.push_back({from.inflow.material, 1, from.inflow.density, from.inflow.specific_energy});
    return;
  }
  if (!passes(b, axis, side)) {
    parts.push_back({b.void_index()});
    return;
  }
  std::array<double, 3> lo{}, hi{};
  std::array<int, 3> at = cell;
  for (int d = 0; d < Dim; ++d) { // at the block's edges as within it
    const auto a = static_cast<std::size_t>(d);
    at[a] = d == axis || (at[a] >= 0 && at[a] < b.grid.cells[a]) ? at[a] : mirrored_cell(at[a], b.grid.cells[a]);
  }
  // Where the side's nodes are on their way to the target, the ghosts are.
  std::array<int, 3> edge = at;
  edge[static_cast<std::size_t>(axis)] = side == 0 ? 0 : b.grid.cells[static_cast<std::size_t>(axis)];
  const int edge_row = b.grid.node_row(edge[1], edge[2]);
  for (std::size_t d = 0; d < Dim; ++d) {
    const int r = b.grid.node_row(at[1], at[2]), up = b.grid.node_row(at[1] + (d == 1 ? 1 : 0), at[2] + (d == 2 ? 1 : 0));
    lo[d] = b.target[d].row(r)[at[0]];
    hi[d] = b.target[d].row(up)[at[0] + (d == 0 ? 1 : 0)];
    if (static_cast<int>(d) == axis) {
      const double left = b.position[d].row(edge_row)[edge[0]] - b.target[d].row(edge_row)[edge[0]];
      lo[d] += left;
      hi[d] += left;
    }
  }
  b.outside(lo, hi, parts);
}

template <int Dim> remap::Mesh<Dim> view(Block<Dim>& b) {
  remap::Mesh<Dim> m{.grid = b.grid,
                     .axisymmetric = b.axisymmetric,
                     .position = b.position,
                     .target = b.target,
                     .volume = b.volume,
                     .next_volume = b.next_volume,
                     .velocity = b.velocity,
                     .next_velocity = b.next_velocity,
                     .node_mass = b.node_mass,
                     .low_share = b.low_share,
                     .swept = b.swept,
                     .mass_flux = b.mass_flux,
                     .materials = {},
                     .has_void = b.void_index() >= 0,
                     .owner = b.owner,
                     .scratch = &b.remap_scratch,
                     .awake = &b.awake,
                     .exchange_velocity = [&b](RowField& f, int component) {
                       exchange_nodes(b.grid, b.boundary, component, f, &b.awake);
                       rest_ahead(b, f);
                     }};
  m.sliding = b.any_sliding() ? &b.sliding : nullptr;
  m.kept_target = b.left_target && !b.motion.moves_target() ? &b.next_position : nullptr; // of the step's start
  for (MaterialSlot& slot : b.materials) {
    m.materials.push_back(&slot.store);
    m.least_energy.push_back(least_energy(slot.material));
    m.reference_density.push_back(slot.material.density);
  }
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const auto a = static_cast<std::size_t>(axis), s = static_cast<std::size_t>(side);
      m.open[a][s] = b.boundary.open(axis, side);
      m.fixed[a][s] = b.boundary.fixes_normal_velocity(axis, side);
      m.fixed_component[a][s] = b.boundary.normal_of(axis, side);
      m.fixed_velocity[a][s] = b.boundary.at(axis, side).velocity;
      const BoundaryKind kind = b.boundary.at(axis, side).kind;
      // Beyond a free side is a vacuum, or the ambient medium: more of what is at the side.
      const bool vacuum = kind == BoundaryKind::free && b.reference_pressure == 0 && m.has_void;
      m.fed[a][s] = vacuum || kind == BoundaryKind::inflow || passes(b, axis, side);
    }
  }
  m.outside = [&b](int axis, int side, const std::array<int, 3>& cell, std::vector<remap::Outside>& parts) { beyond(b, axis, side, cell, parts); };
  return m;
}

/// Calls row(r, span of awake nodes) for every row of nodes.
template <int Dim, class Row> void for_node_rows(const Block<Dim>& b, ThreadPool& pool, Row&& row) {
  const Grid& g = b.grid;
  parallel_awake(pool, &b.awake, g.slabs() + 1, [&](int begin, int end, int) {
    for (int plane = begin; plane < end; ++plane) {
      for (int q = 0; q < (Dim == 3 ? g.cells[1] + 1 : 1); ++q) {
        const int r = Dim == 3 ? g.node_row(q, plane) : g.node_row(plane, 0);
        row(r, b.awake.nodes(r));
      }
    }
  });
}

/// Nodes without mass rest: nothing there moves.
template <int Dim> void rest_massless_nodes(Block<Dim>& b, ThreadPool& pool) {
  for_node_rows(b, pool, [&](int r, Span nodes) {
    const double* mass = b.node_mass.row(r);
    for (auto& component : b.velocity) {
      double* u = component.row(r);
      for (int i = nodes.begin; i < nodes.end; ++i) {
        u[i] = mass[i] > 0 ? u[i] : 0.0;
      }
    }
  });
}

/// Volumes of the target mesh, exactly, without the sweeps' round-off.
template <int Dim> void take_target_volume(Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  parallel_ranges(pool, g.cell_rows(), [&](int begin, int end, int) {
    for (int r = begin; r < end; ++r) { // ghosts included
      const Span cells = b.awake.cells(r);
      const bool first = cells.begin == 0, last = cells.end == g.cells[0];
      if (!cells.empty()) {
        const double* from = b.target_volume.row(r);
        std::copy(from + cells.begin - (first ? g.ghost[0] : 0), from + cells.end + (last ? g.ghost[0] : 0),
                  b.volume.row(r) + cells.begin - (first ? g.ghost[0] : 0));
      }
    }
  });
}

/// Which axis goes first: in turn, or by lot where remaps come when they are due by quality.
long order_at(const Motion& motion, long step) {
  return motion.remap_quality > 0 ? static_cast<long>((static_cast<unsigned long>(step) * 2654435769UL) >> 16 & 0xffffUL) : step / motion.remap_every;
}

} // namespace

template <int Dim> void settle_jumps(Block<Dim>& b, ThreadPool& pool) {
  for_node_rows(b, pool, [&](int r, Span nodes) {
    const double *mass = b.node_mass.row(r), *sliding = b.sliding.node_mass.row(r);
    for (auto& component : b.sliding.jump) {
      double* jump = component.row(r);
      for (int i = nodes.begin; i < nodes.end; ++i) {
        jump[i] = sliding[i] > 0 && sliding[i] < mass[i] ? jump[i] : 0.0;
      }
    }
  });
}

template <int Dim> void remap_block(Scene<Dim>& scene, Block<Dim>& b, long step) {
  place_target(b, *scene.pool);
  remap::Mesh<Dim> mesh = view(b);
  const remap::Settings settings{.normal = scene.numerics.normal, .return_kinetic = scene.numerics.energy_return};
  Embedding<Dim>* embedded = embedding_of(scene, b);
  if (embedded != nullptr) {
    remap_embedded(scene, *embedded, b, mesh, settings, order_at(b.motion, step));
  }
  const std::vector<OutflowNode> leaving = outflow_nodes(b);
  const remap::Report report = remap::remap(mesh, settings, *scene.pool, order_at(b.motion, step));
  Ledger& l = scene.ledger;
  for (std::size_t m = 0; m < report.mass_out.size(); ++m) {
    l.mass_out[m] += report.mass_out[m];
  }
  l.energy_out += report.internal_out + report.kinetic_out;
  for (std::size_t d = 0; d < 3; ++d) {
    l.momentum_out[d] += report.momentum_out[d];
  }
  l.remap_kinetic_loss += report.kinetic_loss - report.kinetic_returned;
  l.remap_kinetic_return += report.kinetic_returned;
  l.sliding_impact += report.impact_loss;
  l.energy_floors += report.energy_floors;
  l.sliver_mass += report.sliver_mass;
  l.sliver_energy += report.sliver_energy;
  l.slivers += report.slivers;
  if (report.tangled[0] >= 0) {
    const auto& c = report.tangled;
    throw NumericalFailure(fmt::format("block {}, cell ({}, {}, {}), material {}: volume falls to nothing on the remap's way to its "
                                       "target mesh; remap more often (motion.remap_every)",
                                       b.name, c[0], c[1], c[2], contents(b, c)));
  }
  b.at_target = !b.motion.moves_target();
  take_target_volume(b, *scene.pool);
  if (embedded != nullptr) {
    restore_open_volumes(*embedded, b, *scene.pool);
  }
  compute_node_mass(b, *scene.pool);
  if (b.any_sliding()) {
    settle_jumps(b, *scene.pool);
  }
  if (b.void_index() >= 0) {
    rest_massless_nodes(b, *scene.pool);
  }
  if (embedded != nullptr) {
    shed_debris(scene, *embedded, b);
  }
  hold_outflow(b, leaving, scene.ledger);
  hold_still(b, *scene.pool, scene.ledger);
  if (b.any_strength()) {
    pull_back_to_yield(b, *scene.pool);
  }
}

template void remap_block<2>(Scene<2>&, Block<2>&, long);
template void remap_block<3>(Scene<3>&, Block<3>&, long);

template void settle_jumps<2>(Block<2>&, ThreadPool&);
template void settle_jumps<3>(Block<3>&, ThreadPool&);

} // namespace ballast
