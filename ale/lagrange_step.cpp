// The Lagrangian step: predict, corner forces, accelerate, move, then work, closure, strength, state.
#include "ale/closure.hpp"
#include "ale/corner_force.hpp"
#include "ale/outflow.hpp"
#include "ale/phases.hpp"
#include "ale/strength_update.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

#include "core/error.hpp"
#include "core/rows.hpp"

namespace ballast {

namespace {

/// Corner forces of one slab, rolling: rows padded so that neighbours outside the block read zeros.
template <int Dim> class CornerSlab {
public:
  explicit CornerSlab(const Grid& g)
      : pitch_(g.cells[0] + 2), rows_(Dim == 3 ? g.cells[1] + 2 : 1),
        data_(static_cast<std::size_t>(components * pitch_ * rows_), 0.0) {}

  /// Row r (-1 .. n in 3D, 0 in 2D).
  CornerRows<Dim> row(int r) {
    CornerRows<Dim> out{};
    for (int p = 0; p < (1 << Dim); ++p) {
      for (int d = 0; d < Dim; ++d) {
        out.f[p][d] = data_.data() + ((Dim == 3 ? r + 1 : 0) * components + p * Dim + d) * pitch_ + 1;
      }
    }
    return out;
  }
  void clear() { std::fill(data_.begin(), data_.end(), 0.0); }
  void swap(CornerSlab& other) { data_.swap(other.data_); }

private:
  static constexpr int components = Dim << Dim;
  int pitch_, rows_;
  std::vector<double> data_;
};

template <int Dim>
void fill_slab(const Block<Dim>& b, const ForceCoefficients& c, int slab, CornerSlab<Dim>& out) {
  const Grid& g = b.grid;
  if (slab < 0 || slab >= g.slabs()) {
    out.clear();
    return;
  }
  for (int q = 0; q < g.rows_per_slab(); ++q) {
    const auto [j, k] = g.in_slab(slab, q);
    corner_forces(b, ForceRows<Dim>(b, j, k), c, g.cells[0], out.row(q));
  }
}

/// Sums the corners at node row q of the plane between `below` and `here`, per component.
template <int Dim>
void gather(CornerSlab<Dim>& below, CornerSlab<Dim>& here, int q, int nodes, double* const (&force)[Dim]) {
  const auto add = [&](const CornerRows<Dim>& rows, int at_i, int at_im1) {
    for (int d = 0; d < Dim; ++d) {
      const double *a = rows.f[at_i][d], *c = rows.f[at_im1][d] - 1;
      double* f = force[d];
#pragma omp simd
      for (int i = 0; i < nodes; ++i) {
        f[i] += a[i] + c[i];
      }
    }
  };
  if constexpr (Dim == 2) {
    add(here.row(0), 0, 1);
    add(below.row(0), 3, 2);
  } else {
    add(here.row(q), 0, 1);
    add(here.row(q - 1), 3, 2);
    add(below.row(q), 4, 5);
    add(below.row(q - 1), 7, 6);
  }
}

/// What boundaries did in a step: J and kg m/s.
struct BoundaryEffect {
  double work = 0;
  std::array<double, 3> impulse = {0, 0, 0};
};

/// Node velocities of one row from forces; boundary conditions come after, by rows.
template <int Dim>
void accelerate_row(Block<Dim>& b, int r, double dt, int nodes, double* const (&force)[Dim]) {
  const double* m = b.node_mass.row(r);
  for (std::size_t d = 0; d < Dim; ++d) {
    const double *f = force[d], *u = b.velocity[d].row(r);
    double* next = b.next_velocity[d].row(r);
#pragma omp simd
    for (int i = 0; i < nodes; ++i) {
      next[i] = u[i] + (m[i] > 0 ? dt * f[i] / m[i] : 0.0);
    }
  }
}

/// Applies the boundaries to the new velocities of node row (j, k); f is the row's force.
template <int Dim>
void bound_row(Block<Dim>& b, int j, int k, double dt, double* const (&force)[Dim], BoundaryEffect& effect) {
  const Grid& g = b.grid;
  const int r = b.grid.node_row(j, k);
  const double* m = b.node_mass.row(r);
  const int index[3] = {0, j, k};
  const auto set = [&](int i, int axis, int side) {
    const auto a = static_cast<std::size_t>(axis);
    const BoundarySide& s = b.boundary.at(axis, side);
    double& next = b.next_velocity[a].row(r)[i];
    const double u = b.velocity[a].row(r)[i];
    if (b.boundary.fixes_normal_velocity(axis, side)) {
      next = s.velocity;
    } else if (s.kind == BoundaryKind::outflow) {
      next = outflow_velocity(b, axis, side, {i, j, k}, dt);
    } else {
      return;
    }
    const double reaction = m[i] * (next - u) - dt * force[axis][i];
    effect.impulse[a] += reaction;
    effect.work += reaction * 0.5 * (u + next);
  };
  for (int axis = 1; axis < Dim; ++axis) {
    const int n = g.cells[static_cast<std::size_t>(axis)];
    for (int side = 0; side < 2; ++side) {
      if (index[axis] == (side == 0 ? 0 : n)) {
        for (int i = 0; i <= g.cells[0]; ++i) {
          set(i, axis, side);
        }
      }
    }
  }
  set(0, 0, 0);
  set(g.cells[0], 0, 1);
}

/// The viscous hourglass term damps a 3D mode by 64 x coefficient x CFL a step: explicit, so below 2.
ForceCoefficients force_coefficients(const Numerics& n, double dt) {
  return {dt, std::min(n.hourglass, 0.03 / n.cfl)};
}

template <int Dim>
BoundaryEffect force_pass(Scene<Dim>& scene, Block<Dim>& b, double dt) {
  const Grid& g = b.grid;
  const int planes = g.slabs() + 1;
  const ForceCoefficients c = force_coefficients(scene.numerics, dt);
  std::vector<BoundaryEffect> effects(static_cast<std::size_t>(planes));
  parallel_ranges(*scene.pool, planes, [&](int begin, int end, int) {
    CornerSlab<Dim> below(g), here(g);
    const int nodes = g.cells[0] + 1;
    std::vector<double> buffer(static_cast<std::size_t>(Dim * nodes));
    double* force[Dim];
    for (int d = 0; d < Dim; ++d) {
      force[d] = buffer.data() + d * nodes;
    }
    fill_slab(b, c, begin - 1, below);
    for (int plane = begin; plane < end; ++plane) {
      fill_slab(b, c, plane, here);
      for (int q = 0; q < (Dim == 3 ? g.cells[1] + 1 : 1); ++q) {
        const int j = Dim == 3 ? q : plane, k = Dim == 3 ? plane : 0;
        const int r = g.node_row(j, k);
        std::fill(buffer.begin(), buffer.end(), 0.0);
        gather(below, here, q, nodes, force);
        accelerate_row(b, r, dt, nodes, force);
        bound_row(b, j, k, dt, force, effects[static_cast<std::size_t>(plane)]);
        for (std::size_t d = 0; d < Dim; ++d) {
          const double *x = b.position[d].row(r), *u = b.velocity[d].row(r), *v = b.next_velocity[d].row(r);
          double* next = b.next_position[d].row(r);
#pragma omp simd
          for (int i = 0; i < nodes; ++i) {
            next[i] = x[i] + 0.5 * dt * (u[i] + v[i]);
          }
        }
      }
      below.swap(here);
    }
  });
  BoundaryEffect total;
  for (const BoundaryEffect& e : effects) {
    total.work += e.work;
    for (std::size_t d = 0; d < 3; ++d) {
      total.impulse[d] += e.impulse[d];
    }
  }
  return total;
}

/// Worst V_new / V of the block and where.
struct WorstCell {
  double ratio = 1;
  std::array<int, 3> cell = {-1, -1, -1};
};

template <int Dim> WorstCell move_cells(Scene<Dim>& scene, Block<Dim>& b) {
  const Grid& g = b.grid;
  std::vector<WorstCell> worst(static_cast<std::size_t>(g.slabs()));
  parallel_ranges(*scene.pool, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        cell_volumes(b, b.next_position, j, k, b.next_volume.row(r));
        const double *v = b.volume.row(r), *next = b.next_volume.row(r);
        WorstCell& w = worst[static_cast<std::size_t>(s)];
        for (int i = 0; i < g.cells[0]; ++i) {
          if (!(next[i] >= w.ratio * v[i]) && !std::isnan(w.ratio)) {
            w = {next[i] / v[i], {i, j, k}};
          }
        }
      }
    }
  });
  WorstCell least;
  for (const WorstCell& w : worst) {
    least = !(w.ratio >= least.ratio) && !std::isnan(least.ratio) ? w : least; // the first NaN wins
  }
  return least;
}

/// Scratch rows of the work pass.
template <int Dim> struct WorkBuffer {
  static constexpr int gradients = WorkRows<Dim>::gradient_components;
  std::vector<double> data;
  WorkRows<Dim> rows{};
  RowRuns runs;

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
StressRows<Dim> stress_rows(MaterialSlot& slot, int r, int at, const WorkRows<Dim>* w) {
  StressRows<Dim> s{};
  for (int a = 0; a < stress_components<Dim>; ++a) {
    s.stress[a] = slot.store.row(field::stress + a, r) + at;
  }
  s.plastic_strain = slot.store.row(field::plastic_strain<Dim>, r) + at;
  s.flow_stress = slot.store.row(slot.flow_stress_field(), r) + at;
  s.energy = slot.store.row(field::energy, r) + at;
  for (int q = 0; w && q < WorkRows<Dim>::gradient_components; ++q) {
    s.gradient[q] = w->gradient[q] + at;
  }
  return s;
}

/// s : grad(u) dt of one cell, 1/volume.
double stress_power(const MaterialSlot& slot, int r, int i, const WorkRows<2>& w) {
  const auto s = [&](int a) { return slot.store.row(field::stress + a, r)[i]; };
  return s(0) * w.gradient[0][i] + s(1) * w.gradient[3][i] + s(2) * (w.gradient[1][i] + w.gradient[2][i]) -
         (s(0) + s(1)) * w.gradient[4][i];
}
double stress_power(const MaterialSlot& slot, int r, int i, const WorkRows<3>& w) {
  const auto s = [&](int a) { return slot.store.row(field::stress + a, r)[i]; };
  return s(0) * w.gradient[0][i] + s(1) * w.gradient[4][i] - (s(0) + s(1)) * w.gradient[8][i] +
         s(2) * (w.gradient[1][i] + w.gradient[3][i]) + s(3) * (w.gradient[5][i] + w.gradient[7][i]) +
         s(4) * (w.gradient[2][i] + w.gradient[6][i]);
}

template <int Dim> MixedCell load_mixed(const Block<Dim>& b, int r, int i, double volume) {
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
    p.sound_speed = std::sqrt(p.modulus * p.volume / p.mass);
  }
  return cell;
}

/// Energy and volumes of one mixed cell. Returns the energy that void took or gave: what the materials
/// received less what the forces gave, with the reference pressure's part of the void's volume change.
template <int Dim>
double advance_mixed(Scene<Dim>& scene, Block<Dim>& b, int r, int i, double dt, const WorkRows<Dim>& w) {
  const double volume = b.volume.row(r)[i], next_volume = b.next_volume.row(r)[i];
  MixedCell cell = load_mixed(b, r, i, volume);
  const CellMotion motion{volume, next_volume - volume, w.swept_volume[i], w.compression[i],
                          b.pressure.row(r)[i], b.modulus.row(r)[i], dt};
  share_volume_change(scene.numerics.closure, motion, cell);
  // Pressure work is shared by the closure, deviator work by each material's own stress, the rest
  // (viscosity, hourglass) by mass; the last share is what is left, so the sum is exact.
  const double p_half = motion.pressure - motion.modulus * motion.compression;
  double rest = w.work[i] + p_half * motion.swept_volume;
  double deviator[max_materials_in_cell] = {}, mass = 0, pressure_work = 0;
  for (int k = 0; k < cell.count; ++k) {
    const MixedCell::Part& p = cell.part[k];
    const MaterialSlot& slot = b.materials[static_cast<std::size_t>(p.material)];
    if (slot.strength) {
      deviator[k] = p.volume * (1 + motion.compression) * stress_power(slot, r, i, w);
      rest -= deviator[k];
    }
    mass += p.mass;
    pressure_work += p.work;
  }
  double taken = 0, sum = 0, void_change = 0;
  int largest = 0;
  for (int k = 0; k < cell.count; ++k) {
    MixedCell::Part& p = cell.part[k];
    MaterialSlot& slot = b.materials[static_cast<std::size_t>(p.material)];
    const double part_volume = p.volume + p.volume_change;
    slot.store.row(field::fraction, r)[i] = std::max(0.0, part_volume / next_volume);
    sum += slot.store.row(field::fraction, r)[i];
    largest = part_volume > cell.part[largest].volume + cell.part[largest].volume_change ? k : largest;
    if (p.is_void) {
      void_change = p.volume_change;
      continue;
    }
    const double work = p.work + deviator[k] + rest * (p.mass / mass);
    slot.store.row(field::energy, r)[i] += (work - b.reference_pressure * p.volume_change) / p.mass;
    taken += work;
  }
  double& most = b.materials[static_cast<std::size_t>(cell.part[largest].material)].store.row(field::fraction, r)[i];
  most += 1 - sum;
  return taken - w.work[i] + b.reference_pressure * void_change;
}

template <int Dim>
void advance_pure(Block<Dim>& b, int r, const RowRuns::Run& run, double dt, const WorkRows<Dim>& w, int& failed) {
  MaterialSlot& slot = b.materials[static_cast<std::size_t>(run.material)];
  if (slot.is_void) {
    return;
  }
  const double *m = slot.store.row(field::mass, r), *v = b.volume.row(r), *next = b.next_volume.row(r);
  double* e = slot.store.row(field::energy, r);
  const double* work = w.work;
  const double p_ref = b.reference_pressure;
#pragma omp simd
  for (int i = run.begin; i < run.end; ++i) {
    e[i] += (work[i] - p_ref * (next[i] - v[i])) / m[i];
  }
  if (slot.strength) {
    failed += update_stress<Dim>(slot.material, dt, run.end - run.begin, stress_rows<Dim>(slot, r, run.begin, &w));
  }
}

template <int Dim> struct StepSums {
  double void_work = 0, volume_change = 0;
  int failed = 0;
  std::array<int, 3> failed_cell = {-1, -1, -1}; ///< the last of them
};

template <int Dim>
void advance_row(Scene<Dim>& scene, Block<Dim>& b, int j, int k, double dt, WorkBuffer<Dim>& buffer, StepSums<Dim>& sums) {
  const Grid& g = b.grid;
  const int r = g.cell_row(j, k);
  const double* next[Dim][ForceRows<Dim>::lines];
  for (std::size_t d = 0; d < Dim; ++d) {
    for (int l = 0; l < ForceRows<Dim>::lines; ++l) {
      next[d][l] = b.next_velocity[d].row(g.node_row(j + (l & 1), k + (l >> 1)));
    }
  }
  corner_work<Dim>(b, ForceRows<Dim>(b, j, k), next, force_coefficients(scene.numerics, dt), g.cells[0], buffer.rows);
  buffer.runs.scan(b.owner_row(r), g.cells[0]);
  for (const RowRuns::Run& run : buffer.runs.pure) {
    if (b.materials[static_cast<std::size_t>(run.material)].is_void) {
      for (int i = run.begin; i < run.end; ++i) {
        sums.void_work += b.reference_pressure * (b.next_volume.row(r)[i] - b.volume.row(r)[i]) - buffer.rows.work[i];
      }
    }
    const int before = sums.failed;
    advance_pure(b, r, run, dt, buffer.rows, sums.failed);
    sums.failed_cell = sums.failed > before ? std::array<int, 3>{run.begin, j, k} : sums.failed_cell;
  }
  for (const int i : buffer.runs.mixed) {
    sums.void_work += advance_mixed(scene, b, r, i, dt, buffer.rows);
    for (MaterialSlot& slot : b.materials) {
      if (slot.strength && std::as_const(slot.store).row(field::fraction, r)[i] > 0) {
        const int failed = update_stress<Dim>(slot.material, dt, 1, stress_rows<Dim>(slot, r, i, &buffer.rows));
        sums.failed += failed;
        sums.failed_cell = failed > 0 ? std::array<int, 3>{i, j, k} : sums.failed_cell;
      }
    }
  }
  sums.volume_change += lane_sum(b.next_volume.row(r), g.cells[0]) - lane_sum(b.volume.row(r), g.cells[0]);
}

template <int Dim> StepSums<Dim> work_pass(Scene<Dim>& scene, Block<Dim>& b, double dt) {
  const Grid& g = b.grid;
  std::vector<StepSums<Dim>> sums(static_cast<std::size_t>(g.slabs()));
  parallel_ranges(*scene.pool, g.slabs(), [&](int begin, int end, int) {
    WorkBuffer<Dim> buffer(g.cells[0], b.any_strength());
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        advance_row(scene, b, j, k, dt, buffer, sums[static_cast<std::size_t>(s)]);
      }
    }
  });
  StepSums<Dim> total;
  for (const auto& s : sums) {
    total.void_work += s.void_work;
    total.volume_change += s.volume_change;
    total.failed_cell = s.failed > 0 ? s.failed_cell : total.failed_cell;
    total.failed += s.failed;
  }
  return total;
}

constexpr double smallest_volume_ratio = 0.2; // of one step; below it the step is retried smaller
constexpr int most_retries = 30;

} // namespace

template <int Dim> void lagrange_step(Scene<Dim>& scene, Clock& clock) {
  std::vector<BoundaryEffect> effects(scene.blocks.size());
  for (int attempt = 0;; ++attempt) {
    WorstCell worst;
    std::size_t where = 0;
    for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
      effects[ib] = force_pass(scene, scene.blocks[ib], clock.dt);
      const WorstCell w = move_cells(scene, scene.blocks[ib]);
      if (w.ratio < worst.ratio || std::isnan(w.ratio)) {
        worst = w;
        where = ib;
      }
    }
    if (worst.ratio >= smallest_volume_ratio) {
      break;
    }
    if (attempt >= most_retries || std::isnan(worst.ratio)) {
      throw NumericalFailure(fmt::format(
          "block {}, cell ({}, {}, {}), material {}: volume would fall to {:g} of its value at time {:g} s, dt {:g} s",
          scene.blocks[where].name, worst.cell[0], worst.cell[1], worst.cell[2],
          contents(scene.blocks[where], worst.cell), worst.ratio, clock.time, clock.dt));
    }
    clock.dt *= 0.5;
    clock.limit = {clock.dt, static_cast<int>(where), worst.cell, -1, DtCause::retry};
    ++scene.ledger.retries;
  }
  for (std::size_t ib = 0; ib < scene.blocks.size(); ++ib) {
    Block<Dim>& b = scene.blocks[ib];
    const StepSums<Dim> sums = work_pass(scene, b, clock.dt);
    scene.ledger.boundary_work += effects[ib].work;
    for (std::size_t d = 0; d < 3; ++d) {
      scene.ledger.momentum_out[d] -= effects[ib].impulse[d];
    }
    scene.ledger.void_work += sums.void_work;
    scene.ledger.ambient_work -= b.reference_pressure * sums.volume_change;
    if (sums.failed > 0) {
      const auto& c = sums.failed_cell;
      throw NumericalFailure(fmt::format(
          "block {}, from cell ({}, {}, {}) on, material {}: the return to the yield surface (equivalent stress, Pa) did not "
          "converge in {} cells at time {:g} s",
          b.name, c[0], c[1], c[2], contents(b, c), sums.failed, clock.time));
    }
    for (std::size_t d = 0; d < Dim; ++d) {
      b.position[d].swap(b.next_position[d]);
      b.velocity[d].swap(b.next_velocity[d]);
    }
    b.volume.swap(b.next_volume);
  }
}

template void lagrange_step<2>(Scene<2>&, Clock&);
template void lagrange_step<3>(Scene<3>&, Clock&);

} // namespace ballast
