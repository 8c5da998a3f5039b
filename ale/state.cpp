#include "ale/closure.hpp"
#include "ale/phases.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <fmt/format.h>
#include <utility>

namespace ballast {

namespace {

/// Worst value met by a thread; reported once the loop is over.
struct BadCell {
  std::array<int, 3> cell = {-1, -1, -1};
  int material = -1;
  double density = 0, energy = 0, modulus = 0;

  bool found() const { return material >= 0; }
};

/// Shear moduli of cells whose material has a state-dependent one.
void evaluate_shear(MaterialSlot& slot, double reference_pressure, int r, int at, int count, const double* rho) {
  const auto& model = std::get<SteinbergGuinan>(slot.material.strength);
  const double* e = std::as_const(slot.store).row(field::energy, r) + at;
  const double* p = std::as_const(slot.store).row(slot.pressure_field(), r) + at;
  double* shear = slot.store.row(slot.shear_field(), r) + at;
  for (int i = 0; i < count; ++i) {
    const double ratio = shear_ratio(model, rho[i], p[i] + reference_pressure, e[i] - slot.material.specific_energy);
    shear[i] = model.shear_modulus * std::max(ratio, molten_shear);
  }
}

/// EOS of `count` cells of one material starting at cell `at` of row r.
void evaluate(MaterialSlot& slot, double reference_pressure, int r, int at, int count, const double* volume, std::vector<double>& rho) {
  const double* f = std::as_const(slot.store).row(field::fraction, r) + at;
  const double* m = std::as_const(slot.store).row(field::mass, r) + at;
  const double* e = std::as_const(slot.store).row(field::energy, r) + at;
  const double* v = volume + at;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    rho[static_cast<std::size_t>(i)] = m[i] / (f[i] * v[i]);
  }
  double *pressure = slot.store.row(slot.pressure_field(), r) + at, *modulus = slot.store.row(slot.modulus_field(), r) + at;
  if (slot.compacts) { // only here: a step's state is evaluated once it is final, and twice is as good as once
    evaluate_foam(std::get<PAlpha>(slot.material.eos), slot.reference, count, rho.data(), slot.store.row(slot.compaction_field(), r) + at, pressure, modulus);
  } else {
    evaluate_row(slot.material.eos, slot.reference, count, rho.data(), e, pressure, modulus);
  }
  if (slot.variable_shear) {
    evaluate_shear(slot, reference_pressure, r, at, count, rho.data());
  }
}

/// Of a solid's density at rest: a trace that a mixed cell has stretched thinner has no shear modulus that would set a step.
constexpr double thinnest_solid = 0.1;

double stiffness(const MaterialSlot& slot, double modulus, int r, int i) {
  return slot.strength ? modulus + 4.0 / 3.0 * shear_of(slot, r, i) : modulus;
}

/// Wave speed and shear modulus of a run of pure cells.
template <int Dim> void stiffen_run(Block<Dim>& b, const MaterialSlot& slot, int r, const RowRuns::Run& run) {
  const double *k = b.modulus.row(r), *d = b.density.row(r);
  double* c = b.wave_speed.row(r);
  if (slot.variable_shear) {
    const double* g = slot.store.row(slot.shear_field(), r);
#pragma omp simd
    for (int i = run.begin; i < run.end; ++i) {
      c[i] = std::sqrt((k[i] + 4.0 / 3.0 * g[i]) / d[i]);
    }
    std::copy(g + run.begin, g + run.end, b.shear.row(r) + run.begin);
  } else if (b.any_strength()) {
    std::fill(b.shear.row(r) + run.begin, b.shear.row(r) + run.end, slot.shear);
  }
}

template <int Dim>
void pure_run(Block<Dim>& b, int r, const RowRuns::Run& run, std::vector<double>& rho) {
  MaterialSlot& slot = b.materials[static_cast<std::size_t>(run.material)];
  double *p = b.pressure.row(r), *k = b.modulus.row(r), *d = b.density.row(r), *c = b.wave_speed.row(r);
  const double* v = b.volume.row(r);
  if (slot.is_void) {
    std::fill(p + run.begin, p + run.end, -b.reference_pressure);
    for (double* f : {k, d, c}) {
      std::fill(f + run.begin, f + run.end, 0.0);
    }
  } else {
    evaluate(slot, b.reference_pressure, r, run.begin, run.end - run.begin, v, rho);
    const double* mp = std::as_const(slot.store).row(slot.pressure_field(), r);
    const double* mk = std::as_const(slot.store).row(slot.modulus_field(), r);
    const double* m = std::as_const(slot.store).row(field::mass, r);
    const double shear = 4.0 / 3.0 * slot.shear;
#pragma omp simd
    for (int i = run.begin; i < run.end; ++i) {
      p[i] = mp[i];
      k[i] = mk[i];
      d[i] = m[i] / v[i];
      c[i] = std::sqrt((mk[i] + shear) / d[i]);
    }
  }
  for (std::size_t a = 0; b.any_strength() && a < stress_components<Dim>; ++a) {
    double* s = b.stress[a].row(r);
    if (slot.strength) {
      const double* ms = std::as_const(slot.store).row(field::stress + static_cast<int>(a), r);
      std::copy(ms + run.begin, ms + run.end, s + run.begin);
    } else {
      std::fill(s + run.begin, s + run.end, 0.0);
    }
  }
  stiffen_run(b, slot, r, run);
  if (b.any_strength()) {
    if (slot.strength) {
      const double* y = std::as_const(slot.store).row(slot.flow_stress_field(), r);
      std::copy(y + run.begin, y + run.end, b.flow_stress.row(r) + run.begin);
    } else {
      std::fill(b.flow_stress.row(r) + run.begin, b.flow_stress.row(r) + run.end, 0.0);
    }
  }
}

template <int Dim> void mixed_state(Block<Dim>& b, int r, int i, std::vector<double>& rho) {
  MixedCell cell;
  double mass = 0, fastest = 0, shear = 0, flow = 0;
  std::array<double, stress_components<Dim>> stress{};
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    MaterialSlot& slot = b.materials[m];
    const double f = std::as_const(slot.store).row(field::fraction, r)[i];
    if (f <= 0 || cell.count == max_materials_in_cell) {
      continue;
    }
    MixedCell::Part& p = cell.part[cell.count++];
    p.is_void = slot.is_void;
    p.volume = f;
    if (slot.is_void) {
      continue;
    }
    evaluate(slot, b.reference_pressure, r, i, 1, b.volume.row(r), rho);
    p.pressure = std::as_const(slot.store).row(slot.pressure_field(), r)[i];
    p.modulus = std::as_const(slot.store).row(slot.modulus_field(), r)[i];
    mass += std::as_const(slot.store).row(field::mass, r)[i];
    fastest = std::max(fastest, p.modulus / rho[0] + (stiffness(slot, p.modulus, r, i) - p.modulus) / std::max(rho[0], thinnest_solid * slot.reference.rho));
    if (slot.strength) {
      shear += f * shear_of(slot, r, i);
      flow += f * std::as_const(slot.store).row(slot.flow_stress_field(), r)[i];
    }
    for (std::size_t a = 0; slot.strength && a < stress_components<Dim>; ++a) {
      stress[a] += f * std::as_const(slot.store).row(field::stress + static_cast<int>(a), r)[i];
    }
  }
  stiffen_cold(cell, b.reference_pressure);
  const CellPressure cp = mixed_pressure(b.closure, cell, -b.reference_pressure);
  b.pressure.row(r)[i] = cp.pressure;
  b.modulus.row(r)[i] = cp.modulus;
  b.density.row(r)[i] = mass / b.volume.row(r)[i];
  b.wave_speed.row(r)[i] = std::sqrt(fastest);
  for (std::size_t a = 0; b.any_strength() && a < stress_components<Dim>; ++a) {
    b.stress[a].row(r)[i] = stress[a];
  }
  if (b.any_strength()) {
    b.shear.row(r)[i] = shear;
    b.flow_stress.row(r)[i] = flow;
  }
}

template <int Dim> BadCell check_row(const Block<Dim>& b, int j, int k) {
  const int r = b.grid.cell_row(j, k);
  const Span cells = b.awake.cells(r);
  const double *p = b.pressure.row(r), *c = b.wave_speed.row(r);
  bool good = true;
  for (int i = cells.begin; i < cells.end; ++i) {
    good = good && std::isfinite(p[i]) && std::isfinite(c[i]); // sqrt of a negative modulus is NaN
  }
  for (int i = cells.begin; !good && i < cells.end; ++i) {
    if (std::isfinite(p[i]) && std::isfinite(c[i])) {
      continue;
    }
    for (std::size_t m = 0; m < b.materials.size(); ++m) {
      const MaterialSlot& slot = b.materials[m];
      const double f = slot.store.row(field::fraction, r)[i];
      if (f <= 0 || slot.is_void) {
        continue;
      }
      const double modulus = slot.store.row(slot.modulus_field(), r)[i];
      if (!(modulus >= 0) || !std::isfinite(slot.store.row(slot.pressure_field(), r)[i])) {
        return {{i, j, k}, static_cast<int>(m), slot.store.row(field::mass, r)[i] / (f * b.volume.row(r)[i]),
                slot.store.row(field::energy, r)[i], modulus};
      }
    }
    return {{i, j, k}, 0, b.density.row(r)[i], 0, b.modulus.row(r)[i]};
  }
  return {};
}

template <int Dim> void report(const Block<Dim>& b, const BadCell& c) {
  if (c.found()) {
    throw NumericalFailure(fmt::format(
        "block {}, cell ({}, {}, {}), material {}: bulk modulus {:g} Pa at density {:g} kg/m3, specific energy {:g} J/kg",
        b.name, c.cell[0], c.cell[1], c.cell[2], b.materials[static_cast<std::size_t>(c.material)].material.name, c.modulus,
        c.density, c.energy));
  }
}

} // namespace

template <int Dim> void refresh_shear(Block<Dim>& b, MaterialSlot& slot, int r) {
  std::vector<double> rho(1);
  const double* f = std::as_const(slot.store).row(field::fraction, r);
  const Span cells = b.awake.cells(r);
  for (int i = cells.begin; i < cells.end; ++i) {
    if (f[i] > 0) {
      evaluate(slot, b.reference_pressure, r, i, 1, b.volume.row(r), rho);
    }
  }
}

template <int Dim> void row_state(Block<Dim>& b, int r, RowRuns& runs, std::vector<double>& rho) {
  compute_owner(b, r, b.awake.cells(r));
  runs.scan(b.owner_row(r), b.awake.cells(r));
  for (const RowRuns::Run& run : runs.pure) {
    pure_run(b, r, run, rho);
  }
  for (const int i : runs.mixed) {
    mixed_state(b, r, i, rho);
  }
}

/// Where nodes have two velocities, the one that moves them tells nothing of how what slides deforms: its hourglass
/// motion is the jump between the two, and damping it would be friction.
template <int Dim> static void row_damping(Block<Dim>& b, int j, int k) {
  const Grid& g = b.grid;
  const int r = g.cell_row(j, k);
  const double* rho = b.density.row(r);
  double* damped = b.damped_density.row(r);
  const Span cells = b.awake.cells(r);
  std::copy(rho + cells.begin, rho + cells.end, damped + cells.begin);
  for (int side = 0; side < (1 << (Dim - 1)); ++side) {
    const int nr = g.node_row(j + (side & 1), k + (side >> 1 & 1));
    for (std::size_t d = 0; d < Dim; ++d) {
      const double* jump = b.sliding.jump[d].row(nr);
      for (int i = cells.begin; i < cells.end; ++i) {
        damped[i] = (jump[i] != 0) | (jump[i + 1] != 0) ? 0.0 : damped[i];
      }
    }
  }
}

template <int Dim> void update_state(Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  std::vector<BadCell> bad(static_cast<std::size_t>(g.slabs()));
  parallel_awake(pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
    std::vector<double> rho(static_cast<std::size_t>(g.cells[0]));
    RowRuns runs;
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        if (b.awake.cells(r).empty()) {
          continue;
        }
        row_state(b, r, runs, rho);
        if (b.any_sliding()) {
          row_damping(b, j, k);
        }
        if (const BadCell found = check_row(b, j, k); found.found()) {
          bad[static_cast<std::size_t>(s)] = found;
        }
      }
    }
  });
  for (const BadCell& c : bad) {
    report(b, c);
  }
}

template <int Dim> void throw_if_bad(const Block<Dim>& b, int j, int k) { report(b, check_row(b, j, k)); }

template <int Dim> std::string contents(const Block<Dim>& b, const std::array<int, 3>& cell) {
  std::string out;
  if (cell[0] < 0 || cell[1] < 0 || cell[2] < 0) {
    return "unknown";
  }
  for (const MaterialSlot& slot : b.materials) {
    const double f = slot.store.row(field::fraction, b.grid.cell_row(cell[1], cell[2]))[cell[0]];
    if (f >= 1) {
      return slot.material.name;
    }
    if (f > 0) {
      out += fmt::format("{}{} {:.3g}", out.empty() ? "" : ", ", slot.material.name, f);
    }
  }
  return out;
}

template void refresh_shear<2>(Block<2>&, MaterialSlot&, int);
template void refresh_shear<3>(Block<3>&, MaterialSlot&, int);
template void row_state<2>(Block<2>&, int, RowRuns&, std::vector<double>&);
template void row_state<3>(Block<3>&, int, RowRuns&, std::vector<double>&);
template void throw_if_bad<2>(const Block<2>&, int, int);
template void throw_if_bad<3>(const Block<3>&, int, int);
template void update_state<2>(Block<2>&, ThreadPool&);
template void update_state<3>(Block<3>&, ThreadPool&);
template std::string contents<2>(const Block<2>&, const std::array<int, 3>&);
template std::string contents<3>(const Block<3>&, const std::array<int, 3>&);

} // namespace ballast
