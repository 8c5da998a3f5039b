#include "ale/tissue_update.hpp"

#include "ale/phases.hpp"
#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "materials/visco.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace ballast {

namespace {

/// Components of a 3x3 gradient that a run gives, in their order.
template <int Dim> constexpr std::array<std::size_t, Dim == 2 ? 5 : 9> gradient_of_run() {
  if constexpr (Dim == 2) {
    return {0, 1, 3, 4, 8};
  } else {
    return {0, 1, 2, 3, 4, 5, 6, 7, 8};
  }
}

/// Everything a law reads and writes, for the active cells of a run, in one array.
ViscoRow lay_out(std::vector<double>& data, int cells, std::size_t tensors, double dt) {
  const auto n = static_cast<std::size_t>(cells);
  data.assign((9 + 1 + 6 * tensors + 6 + 4) * n, 0.0);
  double* at = data.data();
  const auto next = [&] { return std::exchange(at, at + n); };
  ViscoRow row;
  row.cells = cells;
  row.dt = dt;
  for (const double*& g : row.gradient) {
    g = next();
  }
  row.volume_ratio = next();
  for (std::size_t a = 0; a < 6 * tensors; ++a) {
    row.state[a] = next();
  }
  for (double*& s : row.stress) {
    s = next();
  }
  row.stored = next();
  row.dissipated = next();
  row.work = next();
  row.floored = next();
  return row;
}

/// Fields that a run reads and writes: pointers to its first cell.
template <int Dim> struct TissueFields {
  const double *fraction, *mass, *volume;
  double* energy; ///< free energy, J/kg
  double* stress[stress_components<Dim>];
  double* memory[most_visco_state];
  int memories;

  TissueFields(MaterialSlot& slot, const Block<Dim>& b, int r, int begin) : memories(slot.memories * memory_components<Dim>) {
    fraction = std::as_const(slot.store).row(field::fraction, r) + begin;
    mass = std::as_const(slot.store).row(field::mass, r) + begin;
    volume = b.next_volume.row(r) + begin;
    energy = slot.store.row(field::free_energy<Dim>, r) + begin;
    for (int a = 0; a < stress_components<Dim>; ++a) {
      stress[a] = slot.store.row(field::stress + a, r) + begin;
    }
    for (int q = 0; q < memories; ++q) {
      memory[q] = slot.store.row(field::memory<Dim> + q, r) + begin;
    }
  }
};

/// Cells that move or remember.
template <int Dim> void find_active(const TissueRun<Dim>& run, const TissueFields<Dim>& f, std::vector<int>& active) {
  active.clear();
  for (int i = 0; i < run.count; ++i) {
    bool rests = f.energy[i] == 0;
    for (const double* g : run.gradient) {
      rests = rests && g[i] == 0;
    }
    for (int a = 0; rests && a < stress_components<Dim>; ++a) {
      rests = f.stress[a][i] == 0;
    }
    for (int q = 0; rests && q < f.memories; ++q) {
      rests = f.memory[q][i] == 0;
    }
    if (!rests) {
      active.push_back(i);
    }
  }
}

/// A mean of positive definite tensors of determinant 1 is one, of a determinant of at least 1.
bool may_be_mixed(const Sym& t) { return positive_definite(t) && determinant(t) > 0.5; }

/// A remap limits each component by itself: where neighbours differ by large strains a tensor may come out as no mixture of
/// theirs. Drawn to rest until it may be one: near zero determinant it would be made unimodular by a huge factor.
long repair(const TissueLaw& law, const ViscoRow& row, std::size_t i) {
  if (!std::holds_alternative<BergstroemBoyce>(law)) {
    return 0;
  }
  long repaired = 0;
  for (std::size_t first = 0; first < 12; first += 6) {
    Sym t = load_sym(row, first, i);
    if (may_be_mixed(t)) {
      continue;
    }
    for (int k = 0; k < 60 && !may_be_mixed(t); ++k) {
      t = combine(0.5, t, 0.5, unit_sym);
    }
    store_sym(row, first, i, t);
    ++repaired;
  }
  return repaired;
}

template <int Dim> struct Gathering {
  const TissueRun<Dim>& run;
  const TissueFields<Dim>& fields;
  const std::vector<int>& active;
  std::array<double, most_visco_state> rest{};
  double density = 1; ///< initial, kg/m3

  void load(std::vector<double>& data, const ViscoRow& row) const {
    constexpr auto gradients = gradient_of_run<Dim>();
    double* first = data.data();
    double* ratio = first + 9 * active.size();
    for (std::size_t n = 0; n < active.size(); ++n) {
      const int i = active[n];
      for (std::size_t q = 0; q < gradients.size(); ++q) {
        first[gradients[q] * active.size() + n] = run.gradient[q][i] / row.dt;
      }
      ratio[n] = density * fields.fraction[i] * fields.volume[i] / fields.mass[i];
    }
    for_memory([&](std::size_t state, const double* kept) {
      for (std::size_t n = 0; n < active.size(); ++n) {
        row.state[state][n] = rest[state] + kept[active[n]];
      }
    });
  }
  void store(const ViscoRow& row) const {
    constexpr auto components = stress_of_tensor<Dim>();
    for (std::size_t n = 0; n < active.size(); ++n) {
      for (std::size_t a = 0; a < components.size(); ++a) {
        fields.stress[a][active[n]] = row.stress[components[a]][n];
      }
    }
    for_memory([&](std::size_t state, double* kept) {
      for (std::size_t n = 0; n < active.size(); ++n) {
        kept[active[n]] = row.state[state][n] - rest[state];
      }
    });
  }
  /// Calls visit(number of the law's state, field) for every one that is kept.
  template <class Visit> void for_memory(Visit&& visit) const {
    for (int q = 0; q < fields.memories; ++q) {
      const int tensor = q / memory_components<Dim>, component = q % memory_components<Dim>;
      visit(static_cast<std::size_t>(6 * tensor + component), fields.memory[q]);
    }
  }
};

/// Far above what the deviator is.
template <int Dim> double most_stress(const MaterialSlot& slot, double* const (&stress)[stress_components<Dim>], int i) {
  double largest = slot.shear;
  for (const double* s : stress) {
    largest = std::max(largest, std::abs(s[i]));
  }
  return 10 * largest;
}

} // namespace

template <int Dim> void prepare_tissue(Scene<Dim>& scene) {
  std::size_t materials = 0;
  for (const Block<Dim>& b : scene.blocks) {
    const bool any = std::any_of(b.materials.begin(), b.materials.end(), [](const MaterialSlot& s) { return s.memories > 0; });
    materials = std::max(materials, any ? b.materials.size() : 0);
  }
  if (materials == 0) {
    return;
  }
  scene.ledger.tissue.resize(std::max(scene.ledger.tissue.size(), materials));
  const auto threads = static_cast<std::size_t>(scene.pool->size());
  if (scene.tissue.size() != threads) {
    scene.tissue.clear();
    for (std::size_t t = 0; t < threads; ++t) {
      scene.tissue.emplace_back(scene.numerics.tissue);
    }
  }
}

template <int Dim>
void advance_tissue(Block<Dim>& b, const TissueRun<Dim>& run, double dt, TissueIntegrator& integrator, TissueScratch& scratch, StepSums<Dim>& sums) {
  const Stopwatch watch(sums.tissue_seconds);
  MaterialSlot& slot = b.materials[run.material];
  const int r = b.grid.cell_row(run.j, run.k);
  const TissueLaw& law = *tissue_law(slot.material.strength);
  const TissueFields<Dim> fields(slot, b, r, run.begin);
  find_active(run, fields, scratch.active);
  if (scratch.active.empty()) {
    return;
  }
  const auto tensors = static_cast<std::size_t>(slot.memories);
  const ViscoRow row = lay_out(scratch.rows, static_cast<int>(scratch.active.size()), tensors, dt);
  Gathering<Dim> gathering{run, fields, scratch.active, {}, slot.material.density};
  set_rest(law, std::span(gathering.rest).first(6 * tensors));
  gathering.load(scratch.rows, row);
  for (std::size_t n = 0; n < scratch.active.size(); ++n) {
    sums.tissue_repairs += repair(law, row, n);
  }
  if (const auto failure = advance(law, integrator, row); failure && !sums.trouble) {
    sums.trouble = TissueTrouble{{run.begin + scratch.active[static_cast<std::size_t>(failure->cell)], run.j, run.k}, run.material, *failure};
  }
  gathering.store(row);
  TissueEnergy& energy = sums.tissue[run.material];
  for (std::size_t n = 0; n < scratch.active.size(); ++n) {
    const int i = scratch.active[n];
    const double volume = fields.mass[i] / slot.material.density, before = fields.energy[i] * fields.mass[i];
    fields.energy[i] = row.stored[n] / slot.material.density;
    energy.work += row.work[n] * volume;
    energy.floored += row.floored[n] * volume;
    energy.dissipated += row.dissipated[n] * volume;
    energy.lost += before - (row.stored[n] - row.work[n] + row.dissipated[n]) * volume;
  }
  set_flow_stress<Dim>(slot, r, run.begin, run.count);
}

template <int Dim> void forget(Block<Dim>& b, std::size_t material, int r, int i, StepSums<Dim>& sums) {
  MaterialSlot& slot = b.materials[material];
  const TissueFields<Dim> fields(slot, b, r, i);
  sums.tissue[material].lost += fields.energy[0] * fields.mass[0];
  fields.energy[0] = 0;
  for (double* s : fields.stress) {
    s[0] = 0;
  }
  for (int q = 0; q < fields.memories; ++q) {
    fields.memory[q][0] = 0;
  }
}

template <int Dim> void free_memory(MaterialSlot& slot, const std::array<double, 3>& d, const std::array<double, 3>& n, int r, int i) {
  const TissueLaw& law = *tissue_law(slot.material.strength);
  const auto size = 6 * static_cast<std::size_t>(slot.memories);
  std::array<double, most_visco_state> rest{}, state{};
  set_rest(law, std::span(rest).first(size));
  state = rest;
  const auto kept = [&](std::size_t tensor, std::size_t component) -> double& {
    return slot.store.row(field::memory<Dim> + static_cast<int>(tensor) * memory_components<Dim> + static_cast<int>(component), r)[i];
  };
  const auto for_kept = [&](auto&& visit) {
    for (std::size_t at = 0; at < size; ++at) {
      if (at % 6 < memory_components<Dim>) {
        visit(at, kept(at / 6, at % 6));
      }
    }
  };
  for_kept([&](std::size_t at, double value) { state[at] += value; });
  const double per = 1 / (2 * slot.shear);
  const Sym strain{2 * d[0] * n[0] * per, 2 * d[1] * n[1] * per, 2 * d[2] * n[2] * per,
                   (d[0] * n[1] + n[0] * d[1]) * per, (d[1] * n[2] + n[1] * d[2]) * per, (d[2] * n[0] + n[2] * d[0]) * per};
  strain_at_once(law, strain, std::span(state).first(size));
  for_kept([&](std::size_t at, double& value) { value = state[at] - rest[at]; });
}

template <int Dim> void set_flow_stress(MaterialSlot& slot, int r, int begin, int count) {
  double* stress[stress_components<Dim>];
  for (int a = 0; a < stress_components<Dim>; ++a) {
    stress[a] = slot.store.row(field::stress + a, r);
  }
  double* flow = slot.store.row(slot.flow_stress_field(), r);
  for (int i = begin; i < begin + count; ++i) {
    flow[i] = most_stress<Dim>(slot, stress, i);
  }
}

template <int Dim> void book_tissue(Scene<Dim>& scene, const StepSums<Dim>& sums) {
  Ledger& l = scene.ledger;
  for (std::size_t m = 0; m < sums.tissue.size(); ++m) {
    add(l.tissue[m], sums.tissue[m]);
  }
  l.tissue_repairs += sums.tissue_repairs;
}

template <int Dim> void book_counts(Scene<Dim>& scene, const std::vector<StepSums<Dim>>& sums, bool stands) {
  for (const StepSums<Dim>& s : sums) {
    scene.ledger.tissue_counts.seconds += s.tissue_seconds;
  }
  for (TissueIntegrator& integrator : scene.tissue) {
    const TissueCounts all = integrator.counts();
    TissueCounts spent;
    spent.no_number = all.no_number;
    spent.cvode = all.cvode;
    add(scene.ledger.tissue_counts, stands ? all : spent);
    integrator.reset_counts();
  }
}

template <int Dim> void throw_trouble(const Block<Dim>& b, const TissueTrouble& t, const Clock& clock) {
  throw NumericalFailure(fmt::format(
      "block {}, cell ({}, {}, {}), material {}: branch {} of {} could not be integrated (reason {}, {:.3g} of the step done, state there {:g}) at time "
      "{:g} s, dt {:g} s",
      b.name, t.cell[0], t.cell[1], t.cell[2], b.materials[t.material].material.name, t.failure.branch + 1,
      describe(b.materials[t.material].material.strength), t.failure.reason, t.failure.reached, fmt::join(t.failure.state, " "), clock.time, clock.dt));
}

template void prepare_tissue<2>(Scene<2>&);
template void prepare_tissue<3>(Scene<3>&);
template void advance_tissue<2>(Block<2>&, const TissueRun<2>&, double, TissueIntegrator&, TissueScratch&, StepSums<2>&);
template void advance_tissue<3>(Block<3>&, const TissueRun<3>&, double, TissueIntegrator&, TissueScratch&, StepSums<3>&);
template void forget<2>(Block<2>&, std::size_t, int, int, StepSums<2>&);
template void forget<3>(Block<3>&, std::size_t, int, int, StepSums<3>&);
template void free_memory<2>(MaterialSlot&, const std::array<double, 3>&, const std::array<double, 3>&, int, int);
template void free_memory<3>(MaterialSlot&, const std::array<double, 3>&, const std::array<double, 3>&, int, int);
template void set_flow_stress<2>(MaterialSlot&, int, int, int);
template void set_flow_stress<3>(MaterialSlot&, int, int, int);
template void book_tissue<2>(Scene<2>&, const StepSums<2>&);
template void book_tissue<3>(Scene<3>&, const StepSums<3>&);
template void book_counts<2>(Scene<2>&, const std::vector<StepSums<2>>&, bool);
template void book_counts<3>(Scene<3>&, const std::vector<StepSums<3>>&, bool);
template void throw_trouble<2>(const Block<2>&, const TissueTrouble&, const Clock&);
template void throw_trouble<3>(const Block<3>&, const TissueTrouble&, const Clock&);

} // namespace ballast
