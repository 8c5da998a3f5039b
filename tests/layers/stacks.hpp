// Stacks and measures that the tests of the layers share.
#pragma once

#include "ale/layers/layer_account.hpp"
#include "ale/layers/layer_rows.hpp"
#include "ale/layers/layer_step.hpp"
#include "tests/materials/fabric_laws.hpp"

#include <cmath>
#include <random>

namespace ballast::stacks {

inline HookeSolid hooke(double young = 74e9, double poisson = 0.2, double density = 1440) { return {young, poisson, density}; }

/// A brick of elements n1 x n2 x (layers through) with sizes h.
inline LayerInput brick(FabricModel model, std::array<int, 3> n, std::array<double, 3> h, int dim, int through = 1) {
  LayerInput in;
  in.name = "brick";
  in.model = std::move(model);
  in.lines[0] = even_lines(0, h[0] * n[0], n[0]);
  if (dim == 3) {
    in.lines[1] = even_lines(0, h[1] * n[1], n[1]);
  }
  in.layers = n[2], in.through = through;
  in.levels = even_lines(0, h[2] * n[2] * through, n[2] * through);
  return in;
}

/// Moves every node by up to `size`, the same way each time.
template <int Dim> void shake(LayerStack<Dim>& s, double size, unsigned seed = 1) {
  std::mt19937 engine(seed);
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double part = static_cast<double>(engine() % 20001) / 10000 - 1;
      const bool axis = s.axisymmetric && d == 0 && s.rest[0][n] == 0;
      s.position[d][n] += axis ? 0.0 : size * part;
    }
  }
}

/// Sets positions to map(rest) and velocities to flow(rest), arrays of Dim.
template <int Dim, class Field, class Map> void place(const LayerStack<Dim>& s, Field& field, Map map) {
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    std::array<double, Dim> X;
    for (std::size_t d = 0; d < Dim; ++d) {
      X[d] = s.rest[d][n];
    }
    const std::array<double, Dim> to = map(X);
    for (std::size_t d = 0; d < Dim; ++d) {
      field[d][n] = to[d];
    }
  }
}

template <int Dim> double total_energy(const LayerStack<Dim>& s, const LayerLedger& ledger) {
  const LayerTotals t = totals(s);
  return t.leapfrog_kinetic + t.internal + t.hourglass + t.shock_heat + ledger.edge_work + ledger.edge_loss + ledger.contact_loss + ledger.step_change;
}

/// Energy that a stack's shape holds: by the law's own strain energy at the points, and of the held modes' stiffness (2D), J.
struct Stored {
  double strain = 0, held = 0;
};
inline Stored stored_energy(const LayerStack<2>& s) {
  using namespace layer_element;
  FabricState fresh;
  const FabricTensor C = std::visit([&](const auto& law) { return evaluate(law, FabricTensor{}, fresh).tangent; }, s.model);
  const double nu = std::holds_alternative<HookeSolid>(s.model) ? std::get<HookeSolid>(s.model).poisson : 0.0;
  const double stiffness = s.hourglass.stiffness * std::max(C[2], std::min(C[0], C[1])) / 3;
  Stored sum;
  for (int level = 0; level < s.grid.levels(); ++level) {
    const RowSizes sizes = row_sizes(s, 0, level);
    const auto x = node_rows(s, s.position, 0, level);
    for (int i = 0; i < sizes.count; ++i) {
      if (s.alive[s.element(i, 0, level)] == 0) {
        continue;
      }
      const Modes<2> c = modes_at(x, i);
      const Strains<2> E = strains(c, sizes.gradients(i, false));
      const double vary = -0.5 * nu / (1 - nu) * (E[1] - E[0] + E[3] - E[2]), H = 0.5 * hourglass_form(c, c, sizes.gradients(i, false))[0];
      for (std::size_t p = 0; p < 2; ++p) {
        const FabricTensor at = {E[p], E[2 + p], E[e33] + (p == 0 ? -vary : vary), 0, 0, 0.5 * E[e13]};
        sum.strain += 0.5 * sizes.volume(i) * std::visit([&](const auto& law) { return strain_energy(law, at); }, s.model);
      }
      sum.held += 0.5 * sizes.volume(i) * stiffness * H * H;
    }
  }
  return sum;
}

template <int Dim> double largest_force(const LayerStack<Dim>& s) {
  double most = 0;
  for (const auto& component : s.force) {
    for (const double f : component) {
      most = std::max(most, std::abs(f));
    }
  }
  return most;
}

} // namespace ballast::stacks
