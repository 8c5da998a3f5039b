#include "ale/layers/layer_account.hpp"

#include "ale/layers/layer_edges.hpp"
#include "ale/layers/layer_rows.hpp"

namespace ballast {
namespace {

using namespace layer_element;

/// Work of the elements' stresses at the velocity over `half`.
template <int Dim> void book_row(LayerStack<Dim>& s, int j, int level, double half) {
  const RowSizes sizes = row_sizes(s, j, level);
  const std::size_t first = s.element(0, j, level);
  const auto x = node_rows(s, s.position, j, level), v = node_rows(s, s.velocity, j, level);
  const auto Q = element_rows<Count<Dim>::strains>(s, s.stress_volume, j, level);
  const auto H = element_rows<Count<Dim>::hourglass>(s, s.hourglass_volume, j, level);
  double *energy = s.energy.data() + first, *hourglass = s.hourglass_energy.data() + first, *heat = s.shock_heat.data() + first;
  const double* shock = s.shock_volume.data() + first;
  constexpr std::size_t at33 = Dim == 3 ? static_cast<std::size_t>(s33) : static_cast<std::size_t>(e33);
#pragma GCC ivdep
  for (int i = 0; i < sizes.count; ++i) {
    const Gradients a = sizes.gradients(i, Dim == 3);
    const Modes<Dim> c = modes_at(x, i), c_rate = modes_at(v, i);
    const Strains<Dim> rate = strain_form(c, c_rate, a);
    const Hourglass<Dim> held = hourglass_form(c, c_rate, a);
    double power = 0, held_power = 0;
    for (std::size_t k = 0; k < rate.size(); ++k) {
      power += Q[k][i] * rate[k];
    }
    for (std::size_t k = 0; k < held.size(); ++k) {
      held_power += H[k][i] * held[k];
    }
    energy[i] += half * power;
    heat[i] += half * shock[i] * rate[at33];
    hourglass[i] += half * held_power;
  }
}

struct Entries {
  double contact_loss = 0, step_change = 0;
};

template <int Dim> Entries entries_of_plane(const LayerStack<Dim>& s, const std::vector<unsigned char>& held, int plane, double dt) {
  const std::size_t first = s.node(0, 0, plane);
  const double since = 0.5 * (s.step + dt), grown = 0.25 * (dt - s.step);
  Entries sum;
  for (std::size_t k = 0; k < held.size(); ++k) {
    const std::size_t n = first + k;
    for (std::size_t d = 0; d < Dim; ++d) {
      if ((held[k] >> d & 1) == 0) {
        const double before = s.kept_velocity[d][n], v = s.velocity[d][n], f = s.force[d][n], u = before - since * f / s.mass[n];
        sum.contact_loss -= 0.5 * s.mass[n] * (v - before) * (u + v);
        sum.step_change += grown * f * (v - u);
      }
    }
  }
  return sum;
}

} // namespace

template <int Dim> double leapfrog_kinetic(const LayerStack<Dim>& s) {
  const std::vector<unsigned char> held = held_nodes(s);
  double sum = 0;
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    for (std::size_t d = 0; d < Dim; ++d) {
      const double v = s.velocity[d][n], half = 0.5 * s.step * s.force[d][n] / s.mass[n];
      const double before = (held[n % held.size()] >> d & 1) == 0 ? half : 0.0;
      sum += 0.5 * s.mass[n] * (v - before) * (v + before);
    }
  }
  return sum;
}

template <int Dim> void book_work(LayerStack<Dim>& s, double half, LayerLedger& ledger, ThreadPool& pool) {
  const int rows = s.grid.levels() * s.grid.elements[1];
  parallel_ranges(pool, rows, [&](int begin, int end, int) {
    for (int row = begin; row < end; ++row) {
      book_row(s, row % s.grid.elements[1], row / s.grid.elements[1], half);
    }
  });
  book_springs(s, half, ledger);
}

template <int Dim> void keep_velocity(LayerStack<Dim>& s) {
  for (std::size_t d = 0; d < Dim; ++d) {
    s.kept_velocity[d] = s.velocity[d];
  }
}

template <int Dim> void book_contact(const LayerStack<Dim>& s, double dt, LayerLedger& ledger, ThreadPool& pool) {
  const std::vector<unsigned char> held = held_nodes(s);
  std::vector<Entries> planes(static_cast<std::size_t>(s.grid.planes())); // summed in order: the same bits for any threads
  parallel_ranges(pool, s.grid.planes(), [&](int begin, int end, int) {
    for (int plane = begin; plane < end; ++plane) {
      planes[static_cast<std::size_t>(plane)] = entries_of_plane(s, held, plane, dt);
    }
  });
  for (const Entries& e : planes) {
    ledger.contact_loss += e.contact_loss;
    ledger.step_change += e.step_change;
  }
}

#define BALLAST_INSTANTIATE(D)                                                          \
  template double leapfrog_kinetic<D>(const LayerStack<D>&);                            \
  template void book_work<D>(LayerStack<D>&, double, LayerLedger&, ThreadPool&);        \
  template void keep_velocity<D>(LayerStack<D>&);                                       \
  template void book_contact<D>(const LayerStack<D>&, double, LayerLedger&, ThreadPool&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
