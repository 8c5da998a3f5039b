// Sums over a block: mass, volume and internal energy of each material, momentum and kinetic energy.
#include "ale/phases.hpp"
#include "core/rows.hpp"

namespace ballast {

namespace {

double product_sum(const double* a, const double* b, int n) {
  return lane_total(n, [a, b](int i) { return a[i] * b[i]; });
}

double kinetic_sum(const double* m, const double* u, int n) {
  return lane_total(n, [m, u](int i) { return 0.5 * m[i] * u[i] * u[i]; });
}

/// What a row of nodes has beyond one velocity for all they hold.
template <int Dim> void add_sliding(const Block<Dim>& b, int r, Totals& t) {
  const double *sliding = b.sliding.node_mass.row(r), *mass = b.node_mass.row(r);
  for (std::size_t d = 0; d < Dim; ++d) {
    const double* jump = b.sliding.jump[d].row(r);
    for (int i = 0; i <= b.grid.cells[0]; ++i) {
      if (jump[i] == 0) {
        continue;
      }
      const double follows = remap::node_follows(sliding[i], mass[i]), rest = mass[i] - sliding[i];
      const double node = b.velocity[d].row(r)[i], u = (1 - follows) * jump[i], v = -follows * jump[i];
      t.kinetic_energy += sliding[i] * u * (node + 0.5 * u) + rest * v * (node + 0.5 * v);
      t.momentum[d] += sliding[i] * u + rest * v;
    }
  }
}

} // namespace

template <int Dim> Totals totals(const Block<Dim>& b) {
  const Grid& g = b.grid;
  const int n = g.cells[0];
  Totals t;
  for (const MaterialSlot& slot : b.materials) {
    double mass = 0, energy = 0, volume = 0, stored = 0;
    for (int k = 0; k < g.cells[2]; ++k) {
      for (int j = 0; j < g.cells[1]; ++j) {
        const int r = g.cell_row(j, k);
        if (!slot.store.has_row(r)) {
          continue;
        }
        volume += product_sum(slot.store.row(field::fraction, r), b.volume.row(r), n);
        if (!slot.is_void) {
          const double* m = slot.store.row(field::mass, r);
          mass += lane_sum(m, n);
          energy += product_sum(m, slot.store.row(field::energy, r), n);
          stored += slot.memories > 0 ? product_sum(m, slot.store.row(field::free_energy<Dim>, r), n) : 0.0;
        }
      }
    }
    t.mass.push_back(mass);
    t.internal_energy.push_back(energy);
    t.volume.push_back(volume);
    t.free_energy.push_back(stored);
  }
  for (int k = 0; k < (Dim == 3 ? g.cells[2] + 1 : 1); ++k) {
    for (int j = 0; j <= g.cells[1]; ++j) {
      const int r = g.node_row(j, k);
      const Span awake = b.awake.nodes(r); // the others rest
      const double* m = b.node_mass.row(r) + awake.begin;
      for (std::size_t d = 0; d < Dim; ++d) {
        const double* u = b.velocity[d].row(r) + awake.begin;
        t.momentum[d] += product_sum(m, u, awake.count());
        t.kinetic_energy += kinetic_sum(m, u, awake.count());
      }
      if (b.any_sliding()) {
        add_sliding(b, r, t);
      }
    }
  }
  return t;
}

template Totals totals<2>(const Block<2>&);
template Totals totals<3>(const Block<3>&);

} // namespace ballast
