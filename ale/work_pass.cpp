// What a Lagrangian step does to the cells: work, the closure's shares, strength.
#include "ale/closure.hpp"
#include "ale/embedding.hpp"
#include "ale/lagrange_parts.hpp"
#include "ale/step_undo.hpp"
#include "ale/strength_update.hpp"
#include "ale/tissue_update.hpp"
#include "ale/traction.hpp"
#include "core/rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballast {

double conduction_wall(const MaterialSlot& slot) {
  const double cold = slot.material.specific_heat * slot.material.reference_temperature, start = slot.reference.e;
  return std::abs(start - cold) < 0.05 * cold ? start : cold;
}

namespace {

/// Scratch rows of the work pass.
template <int Dim> struct WorkBuffer {
  static constexpr int gradients = WorkRows<Dim>::gradient_components;
  std::vector<double> data;
  WorkRows<Dim> rows{};
  RowRuns runs;
  int j = 0, k = 0; ///< of the row of cells
  double dt = 0;
  TissueIntegrator* integrator = nullptr; ///< of the thread; null without tissue
  TissueScratch tissue;
  StepUndo* undo = nullptr; ///< null where the step is never taken back

  WorkBuffer(int count, bool strength) : data(static_cast<std::size_t>((3 + gradients) * count)) {
    double* p = data.data();
    rows.swept_volume = p;
    rows.compression = p + count;
    rows.work = p + 2 * count;
    for (int q = 0; q < gradients; ++q) {
      rows.gradient[q] = strength ? p + (3 + q) * count : nullptr;
    }
  }
};

template <int Dim>
StressRows<Dim> stress_rows(MaterialSlot& slot, double reference_pressure, int r, int at, const WorkRows<Dim>* w) {
  StressRows<Dim> s = stress_rows<Dim>(slot, reference_pressure, r, at);
  for (int q = 0; w && q < WorkRows<Dim>::gradient_components; ++q) {
    s.gradient[q] = w->gradient[q] + at;
  }
  return s;
}

/// The step of a viscoelastic material in cells [begin, begin + count) of the buffer's row.
template <int Dim>
void remember(Block<Dim>& b, std::size_t material, int begin, int count, const double* const (&gradient)[WorkRows<Dim>::gradient_components], WorkBuffer<Dim>& buffer, StepSums<Dim>& sums) {
  TissueRun<Dim> run{material, buffer.j, buffer.k, begin, count, {}};
  std::copy(std::begin(gradient), std::end(gradient), run.gradient);
  advance_tissue(b, run, buffer.dt, *buffer.integrator, buffer.tissue, sums);
}

template <int Dim>
MixedCell load_mixed(const Block<Dim>& b, int r, int i, double volume, const Eigen::Vector3d& n) {
  MixedCell cell;
  for (std::size_t m = 0; m < b.materials.size() && cell.count < max_materials_in_cell; ++m) {
    const MaterialSlot& slot = b.materials[m];
    const double f = slot.store.row(field::fraction, r)[i];
    if (f <= 0) {
      continue;
    }
    MixedCell::Part& p = cell.part[cell.count++];
    p.material = static_cast<int>(m);
    p.is_void = slot.is_void;
    p.volume = f * volume;
    if (slot.is_void) {
      p.pressure = -b.reference_pressure;
      continue;
    }
    p.mass = slot.store.row(field::mass, r)[i];
    p.energy = slot.store.row(field::energy, r)[i];
    p.pressure = slot.store.row(slot.pressure_field(), r)[i];
    p.modulus = slot.store.row(slot.modulus_field(), r)[i];
    if (slot.strength) {
      p.pressure -= n.dot(deviator_of<Dim>(slot, r, i) * n);
      p.modulus += n.squaredNorm() * 4 / 3 * shear_of(slot, r, i);
    }
  }
  stiffen_cold(cell, b.reference_pressure);
  return cell;
}

/// Deviators and plastic strains of a mixed cell's parts from their own velocity gradients.
template <int Dim>
void strain_parts(Block<Dim>& b,
                  const MixedCell& cell,
                  int r,
                  int i,
                  const double (*own)[9],
                  WorkBuffer<Dim>& buffer,
                  StepSums<Dim>& sums) {
  for (int k = 0; k < cell.count; ++k) {
    const auto m = static_cast<std::size_t>(cell.part[k].material);
    MaterialSlot& slot = b.materials[m];
    const double f = std::as_const(slot.store).row(field::fraction, r)[i];
    if (!slot.strength || f <= 0) {
      continue;
    }
    if (slot.memories > 0 && f < sliver_fraction) {
      forget(b, m, r, i, sums);
      continue;
    }
    StressRows<Dim> rows = stress_rows<Dim>(slot, b.reference_pressure, r, i, nullptr);
    for (int q = 0; q < WorkRows<Dim>::gradient_components; ++q) {
      rows.gradient[q] = own[k] + q;
    }
    if (slot.memories > 0) {
      remember(b, m, i, 1, rows.gradient, buffer, sums);
      continue;
    }
    sums.failed += update_stress<Dim>(slot.material, buffer.dt, 1, rows);
    relax_slivers(&std::as_const(slot.store).row(field::fraction, r)[i], 1, rows);
  }
}

/// Heat between gas and the condensed materials of its cell: a film of thickness d = f L (L the cell's least width) comes to the
/// temperature of its start, e = cv T0, at the rate k / (rho cv d^2). A trace of gas would else boil: each time it merges with
/// thinner gas and is squeezed again its entropy grows. What the gas gives, the others get by mass; no heat bath is lighter than
/// the gas.
template <int Dim> void conduct(Block<Dim>& b, const MixedCell& cell, int r, int i, double dt) {
  double bath = 0, width = std::numeric_limits<double>::infinity(), heat = 0;
  const auto slot_of = [&](int k) -> MaterialSlot& { return b.materials[static_cast<std::size_t>(cell.part[k].material)]; };
  for (int k = 0; k < cell.count; ++k) {
    bath += slot_of(k).material.conductivity > 0 ? 0 : cell.part[k].mass;
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    width = std::min(width, b.length[d].row(r)[i]);
  }
  for (int k = 0; k < cell.count; ++k) {
    MaterialSlot& slot = slot_of(k);
    const double mass = cell.part[k].mass, f = std::as_const(slot.store).row(field::fraction, r)[i];
    if (!(slot.material.conductivity > 0 && mass > 0 && mass < bath && f > 0)) {
      continue;
    }
    const double wall = conduction_wall(slot);
    const double rate = slot.material.conductivity * dt / (mass / b.next_volume.row(r)[i] * slot.material.specific_heat * f * width * width);
    double& e = slot.store.row(field::energy, r)[i];
    const double gain = (wall - e) * (rate / (1 + rate));
    e += gain;
    heat -= gain * mass;
  }
  for (int k = 0; k < cell.count && heat != 0; ++k) {
    if (cell.part[k].mass > 0 && slot_of(k).material.conductivity == 0) {
      slot_of(k).store.row(field::energy, r)[i] += heat / bath;
    }
  }
}

/// Energy and volumes of one mixed cell. Returns the energy that void took or gave: what the materials received less what
/// the forces and the reference pressure gave.
template <int Dim>
double advance_mixed(Block<Dim>& b,
                     int r,
                     int i,
                     const Eigen::Vector3d& n,
                     WorkBuffer<Dim>& buffer,
                     StepSums<Dim>& sums) {
  const WorkRows<Dim>& w = buffer.rows;
  const double volume = b.volume.row(r)[i], next_volume = b.next_volume.row(r)[i];
  MixedCell cell = load_mixed(b, r, i, volume, n);
  const CellPressure whole = mixed_pressure(b.closure, cell, -b.reference_pressure);
  const CellMotion motion{volume,
                          next_volume - volume,
                          w.swept_volume[i],
                          w.compression[i],
                          whole.pressure,
                          whole.modulus,
                          buffer.dt};
  share_volume_change(b.closure, motion, cell);
  // The closure shares the normal traction's work, the rest of the stress works on each material's
  // own strain (ale/traction), what is left (viscosity, hourglass) goes by mass: the sum is exact.
  const double p_half = motion.pressure - motion.modulus * motion.compression;
  double rest = w.work[i] + p_half * motion.swept_volume;
  double deviator[max_materials_in_cell] = {}, own[max_materials_in_cell][9], mass = 0;
  if (b.any_strength()) {
    share_strain(b, cell, n, r, i, gradient_of(w, i), motion.compression, own, deviator);
  }
  for (int k = 0; k < cell.count; ++k) {
    rest -= deviator[k];
    mass += cell.part[k].mass;
  }
  double taken = 0, sum = 0;
  int largest = 0;
  bool rests = next_volume == volume; // then the fractions stay as they are, to the bit
  for (int k = 0; k < cell.count; ++k) {
    rests = rests && cell.part[k].volume_change == 0;
  }
  for (int k = 0; k < cell.count; ++k) {
    MixedCell::Part& p = cell.part[k];
    MaterialSlot& slot = b.materials[static_cast<std::size_t>(p.material)];
    const double part_volume = p.volume + p.volume_change;
    if (!rests) {
      slot.store.row(field::fraction, r)[i] = std::max(0.0, part_volume / next_volume);
    }
    sum += slot.store.row(field::fraction, r)[i];
    largest =
        part_volume > cell.part[largest].volume + cell.part[largest].volume_change ? k : largest;
    if (p.is_void) {
      continue;
    }
    // The reference pressure works on the volume the forces worked on: else a thin gas would pay for the difference.
    const double work = p.work + deviator[k] + rest * (p.mass / mass) - b.reference_pressure * (p.volume_change + p.slack);
    slot.store.row(field::energy, r)[i] += work / p.mass;
    taken += work;
  }
  double& most = b.materials[static_cast<std::size_t>(cell.part[largest].material)].store.row(
      field::fraction, r)[i];
  most += rests ? 0.0 : 1 - sum;
  conduct(b, cell, r, i, buffer.dt);
  strain_parts<Dim>(b, cell, r, i, own, buffer, sums);
  return taken - (w.work[i] - b.reference_pressure * motion.swept_volume);
}

/// A mixed sliver beside a body (ale/embedding): its room may change many times over in a step, which no closure is made for. Void
/// takes the change first, then all materials alike; the work goes by mass. It comes to one state with its root after the step.
template <int Dim> double advance_sliver(Block<Dim>& b, int r, int i, const WorkRows<Dim>& w, double& scaled) {
  const double volume = b.volume.row(r)[i], next = b.next_volume.row(r)[i];
  double mass = 0, filled = 0;
  for (const MaterialSlot& slot : b.materials) {
    mass += slot.is_void ? 0.0 : slot.store.row(field::mass, r)[i];
    filled += slot.is_void ? 0.0 : slot.store.row(field::fraction, r)[i] * volume;
  }
  const double gap = std::max(0.0, volume - filled), left = gap > 0 ? std::max(0.0, gap + next - volume) : 0.0;
  const double scale = filled > 0 ? (next - left) / (filled * next) : 0.0, work = w.work[i] - b.reference_pressure * w.swept_volume[i];
  scaled = filled > 0 ? scale * next : 1.0;
  double sum = 0;
  MaterialSlot* largest = nullptr;
  for (MaterialSlot& slot : b.materials) {
    const double f = std::as_const(slot.store).row(field::fraction, r)[i];
    if (f <= 0) {
      continue;
    }
    double& fraction = slot.store.row(field::fraction, r)[i];
    fraction = slot.is_void ? left / next : f * volume * scale;
    sum += fraction;
    largest = largest == nullptr || fraction > largest->store.row(field::fraction, r)[i] ? &slot : largest;
    if (!slot.is_void && mass > 0) {
      slot.store.row(field::energy, r)[i] += work / mass;
    }
  }
  if (largest != nullptr) {
    largest->store.row(field::fraction, r)[i] += 1 - sum;
  }
  return mass > 0 ? 0.0 : -work;
}

template <int Dim>
void advance_pure(Block<Dim>& b, int r, const RowRuns::Run& run, WorkBuffer<Dim>& buffer, StepSums<Dim>& sums) {
  const WorkRows<Dim>& w = buffer.rows;
  MaterialSlot& slot = b.materials[static_cast<std::size_t>(run.material)];
  if (slot.is_void) {
    return;
  }
  const double *m = slot.store.row(field::mass, r), *work = w.work, *swept = w.swept_volume;
  double* e = slot.store.row(field::energy, r);
  const double p_ref = b.reference_pressure;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    e[i] += (work[i] - p_ref * swept[i]) / m[i]; // as forces of absolute pressures would
  }
  if (!slot.strength) {
    return;
  }
  const StressRows<Dim> rows = stress_rows<Dim>(slot, b.reference_pressure, r, run.begin, &w);
  if (slot.memories > 0) {
    remember(b, static_cast<std::size_t>(run.material), run.begin, run.end - run.begin, rows.gradient, buffer, sums);
  } else {
    sums.failed += update_stress<Dim>(slot.material, buffer.dt, run.end - run.begin, rows);
  }
}

template <int Dim>
void advance_row(Scene<Dim>& scene,
                 Block<Dim>& b,
                 int j,
                 int k,
                 WorkBuffer<Dim>& buffer,
                 StepSums<Dim>& sums) {
  const Grid& g = b.grid;
  const int r = g.cell_row(j, k);
  const Span cells = b.awake.cells(r);
  if (cells.empty()) {
    return;
  }
  buffer.j = j;
  buffer.k = k;
  if (buffer.undo != nullptr) {
    keep_row(b, r, cells, *buffer.undo);
  }
  const double* next[Dim][ForceRows<Dim>::lines];
  for (std::size_t d = 0; d < Dim; ++d) {
    for (int l = 0; l < ForceRows<Dim>::lines; ++l) {
      next[d][l] = b.next_velocity[d].row(g.node_row(j + (l & 1), k + (l >> 1))) + cells.begin;
    }
  }
  corner_work<Dim>(b,
                   ForceRows<Dim>(b, j, k).from(cells.begin),
                   next,
                   force_coefficients(b, scene.numerics, buffer.dt),
                   cells.count(),
                   buffer.rows.from(cells.begin));
  Embedding<Dim>* embedded = embedding_of(scene, b);
  if (embedded != nullptr) {
    override_work(scene, *embedded, j, k, buffer.dt, buffer.rows);
  }
  buffer.runs.scan(b.owner_row(r), cells);
  for (const RowRuns::Run& run : buffer.runs.pure) {
    if (b.materials[static_cast<std::size_t>(run.material)].is_void) {
      for (int i = run.begin; i < run.end; ++i) {
        sums.void_work += b.reference_pressure * buffer.rows.swept_volume[i] - buffer.rows.work[i];
      }
    }
    const int before = sums.failed;
    advance_pure(b, r, run, buffer, sums);
    sums.failed_cell =
        sums.failed > before ? std::array<int, 3>{run.begin, j, k} : sums.failed_cell;
  }
  const std::int8_t* owner = b.owner_row(r);
  auto q = static_cast<std::size_t>(std::count(owner, owner + cells.begin, mixed_cell)); // of the row's normals
  for (const int i : buffer.runs.mixed) {
    if (embedded != nullptr && is_sliver(*embedded, b, r, i)) {
      ++q;
      sums.void_work += advance_sliver(b, r, i, buffer.rows, embedded->cut[static_cast<std::size_t>(embedded->kind_of(b.grid, r, i))].scaled);
      continue;
    }
    const int before = sums.failed;
    const Eigen::Vector3d n =
        b.any_strength()
            ? Eigen::Vector3d(b.interface_normals[static_cast<std::size_t>(r)][q++].data())
            : Eigen::Vector3d::Zero();
    sums.void_work += advance_mixed(b, r, i, n, buffer, sums);
    sums.failed_cell = sums.failed > before ? std::array<int, 3>{i, j, k} : sums.failed_cell;
  }
  sums.swept_volume += lane_sum(buffer.rows.swept_volume + cells.begin, cells.count());
}

template <int Dim> void add_tissue(StepSums<Dim>& total, const StepSums<Dim>& s) {
  for (std::size_t m = 0; m < total.tissue.size(); ++m) {
    add(total.tissue[m], s.tissue[m]);
  }
  total.tissue_repairs += s.tissue_repairs;
  total.tissue_seconds += s.tissue_seconds;
  total.trouble = total.trouble ? total.trouble : s.trouble;
}

} // namespace

template <int Dim> StepSums<Dim> work_pass(Scene<Dim>& scene, Block<Dim>& b, double dt) {
  const Grid& g = b.grid;
  prepare_tissue(scene);
  const bool remembers = std::any_of(b.materials.begin(), b.materials.end(), [](const MaterialSlot& s) { return s.memories > 0; });
  StepSums<Dim> total;
  total.tissue.resize(remembers ? b.materials.size() : 0);
  std::vector<StepSums<Dim>> sums(static_cast<std::size_t>(g.slabs()), total);
  StepUndo* const undo = scene.undo.empty() ? nullptr : &scene.undo[static_cast<std::size_t>(&b - scene.blocks.data())];
  if (undo != nullptr) {
    begin_undo(b, *undo);
  }
  parallel_awake(*scene.pool, &b.awake, g.slabs(), [&](int begin, int end, int thread) {
    WorkBuffer<Dim> buffer(g.cells[0], b.any_strength());
    buffer.dt = dt;
    buffer.undo = undo;
    buffer.integrator = remembers ? &scene.tissue[static_cast<std::size_t>(thread)] : nullptr;
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        advance_row(scene, b, j, k, buffer, sums[static_cast<std::size_t>(s)]);
      }
    }
  });
  for (const auto& s : sums) {
    total.void_work += s.void_work;
    total.swept_volume += s.swept_volume;
    total.failed_cell = s.failed > 0 ? s.failed_cell : total.failed_cell;
    total.failed += s.failed;
    add_tissue(total, s);
  }
  return total;
}

template StepSums<2> work_pass<2>(Scene<2>&, Block<2>&, double);
template StepSums<3> work_pass<3>(Scene<3>&, Block<3>&, double);

} // namespace ballast
