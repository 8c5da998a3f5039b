// Kinetic energy that the remap's averaging of velocities lost goes back to the cells as internal energy.
#include "core/rows.hpp"
#include "remap/internal.hpp"

#include <algorithm>
#include <utility>

namespace ballast::remap {

namespace {

struct ReturnSums {
  double returned = 0;
  long floors = 0;
};

constexpr double largest_fall = 0.5; ///< of what a material has above its least energy that a negative return may take

/// A fall in internal energy (J) that a material owes in a cell and cannot bear there.
struct Shortage {
  int material, i, j, k;
  double energy;
};

/// What a cell's material can pay (J): first, of what this return gave it; then, of what it has above its least energy.
/// With `share` > 0 takes that share of it. `gain` is by mass (J/kg).
enum class Purse { gain, energy };
template <int Dim> double pay(Mesh<Dim>& m, RowField& gain, Purse purse, int mat, const int (&cell)[3], double share) {
  TileStore& store = *m.materials[static_cast<std::size_t>(mat)];
  const int r = m.grid.cell_row(cell[1], cell[2]), i = cell[0];
  if (!store.has_row(r)) {
    return 0;
  }
  const double mass = std::as_const(store).row(1, r)[i], above = std::as_const(store).row(2, r)[i] - m.least_energy_of(mat);
  const double most = std::max(0.0, largest_fall * above), given = std::min(most, gain.row(r)[i]);
  const double able = purse == Purse::energy ? most : std::max(0.0, given);
  if (share > 0 && mass > 0) {
    store.row(2, r)[i] -= share * able;
    gain.row(r)[i] -= share * able;
  }
  return mass * able;
}

/// A cold cell beside a shock owes what the shocked cells next to it were given too much: they pay, of the same
/// material, out of that gain if it is enough. Few cells, in order: the same bits for any threads.
template <int Dim> void settle(Mesh<Dim>& m, RowField& gain, const Shortage& s, ReturnSums& sums) {
  int cell[1 + 2 * Dim][3] = {{s.i, s.j, s.k}};
  int count = 1;
  for (int axis = 0; axis < Dim; ++axis) {
    for (const int step : {-1, 1}) {
      int at[3] = {s.i, s.j, s.k};
      at[axis] += step;
      if (at[axis] >= 0 && at[axis] < m.grid.cells[static_cast<std::size_t>(axis)]) {
        std::copy(at, at + 3, cell[count++]);
      }
    }
  }
  double owed = s.energy;
  for (const Purse purse : {Purse::gain, Purse::energy}) {
    double able = 0;
    for (int c = 0; c < count; ++c) {
      able += pay(m, gain, purse, s.material, cell[c], 0);
    }
    const double share = able > 0 ? std::min(1.0, owed / able) : 0.0;
    for (int c = 0; c < count && share > 0; ++c) {
      pay(m, gain, purse, s.material, cell[c], share);
    }
    owed = share < 1 && able > 0 ? 0.0 : owed - able;
    sums.returned -= share * able;
  }
  sums.floors += owed > 0 ? 1 : 0;
}

} // namespace

template <int Dim>
void return_kinetic(Mesh<Dim>& m, ThreadPool& pool, Report& report) {
  const Grid& g = m.grid;
  const RowField &loss = m.scratch->node_loss, &node_mass = m.node_mass;
  std::vector<std::vector<Shortage>> shortages(static_cast<std::size_t>(g.slabs()));
  std::vector<ReturnSums> sums(static_cast<std::size_t>(g.slabs()));
  parallel_awake(pool, m.awake, g.slabs(), [&](int begin, int end, int) {
    std::vector<double> per_mass(static_cast<std::size_t>(g.cells[0])), returned(per_mass.size());
    double* gains = per_mass.data();
    for (int s = begin; s < end; ++s) {
      ReturnSums& slab = sums[static_cast<std::size_t>(s)];
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const Span cells = m.cells(g.cell_row(j, k));
        if (cells.empty()) {
          continue;
        }
        std::fill(per_mass.begin(), per_mass.end(), 0.0);
        for (int corner = 0; corner < (1 << Dim); ++corner) {
          const int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2 & 1;
          const int nr = g.node_row(j + dj, k + dk);
          const double *l = loss.row(nr) + di, *mass = node_mass.row(nr) + di;
          double share = dj ? 1 - m.low_share[1][static_cast<std::size_t>(j + g.ghost[1])] : m.low_share[1][static_cast<std::size_t>(j + g.ghost[1])];
          if constexpr (Dim == 3) {
            const double low = m.low_share[2][static_cast<std::size_t>(k + g.ghost[2])];
            share *= dk ? 1 - low : low;
          }
          const double* low0 = m.low_share[0].data() + g.ghost[0];
#pragma omp simd
          for (int i = cells.begin; i < cells.end; ++i) {
            const double w = share * (di ? 1 - low0[i] : low0[i]);
            const bool some = mass[i] > 0;
            const double gain = w * l[i] / (some ? mass[i] : 1.0);
            gains[i] += some ? gain : 0.0;
          }
        }
        const int r = g.cell_row(j, k);
        std::copy(gains + cells.begin, gains + cells.end, m.scratch->cell_mass.row(r) + cells.begin); // the sweeps are done with it
        for (int mat = 0; mat < m.material_count(); ++mat) {
          TileStore& store = *m.materials[static_cast<std::size_t>(mat)];
          if (m.is_void(mat) || !store.has_row(r)) {
            continue;
          }
          double *e = store.row(2, r), *given = returned.data();
          const double* mass = std::as_const(store).row(1, r);
          const double lowest = m.least_energy_of(mat);
          int cut = 0;
#pragma omp simd reduction(+ : cut)
          for (int i = cells.begin; i < cells.end; ++i) {
            cut += (mass[i] > 0) & (gains[i] < 0) & (gains[i] < -largest_fall * (e[i] - lowest)) ? 1 : 0;
          }
          for (int i = cells.begin; i < cells.end && cut > 0; ++i) {
            if (mass[i] > 0 && gains[i] < 0 && gains[i] < -largest_fall * (e[i] - lowest)) {
              const double most = std::min(0.0, -largest_fall * (e[i] - lowest));
              shortages[static_cast<std::size_t>(s)].push_back({mat, i, j, k, mass[i] * (most - gains[i])});
            }
          }
#pragma omp simd
          for (int i = cells.begin; i < cells.end; ++i) {
            const double wanted = gains[i], least = -largest_fall * (e[i] - lowest), floor = least < 0 ? least : 0.0;
            const bool some = mass[i] > 0, falls = (wanted < 0) & (wanted < least);
            const double limited = falls ? floor : wanted, gain = some ? limited : 0.0;
            e[i] += gain;
            given[i] = mass[i] * gain;
          }
          slab.returned += lane_sum(given + cells.begin, cells.count());
        }
      }
    }
  });
  for (const auto& slab : shortages) {
    for (const Shortage& s : slab) {
      settle(m, m.scratch->cell_mass, s, sums.front());
    }
  }
  for (const ReturnSums& s : sums) {
    report.kinetic_returned += s.returned;
    report.energy_floors += s.floors;
  }
}

template void return_kinetic<2>(Mesh<2>&, ThreadPool&, Report&);
template void return_kinetic<3>(Mesh<3>&, ThreadPool&, Report&);

} // namespace ballast::remap
