// One split sweep of the cell quantities along a logical axis.
//
// A face sweeps the volume s along +axis, so t = -s is carried through it along +axis; its donor is the
// cell below for t > 0, above for t < 0. Per face: volume of each material (the pure donor's, or PLIC
// slabs of the donor's planes), mass = volume x limited density, intensives = mass x limited value.
// Slopes are taken in the volume (density) and mass (intensives) coordinate along the line, which is
// exact for linear data on rectilinear meshes; next to mixed cells the value is constant.
#include "core/rows.hpp"
#include "remap/internal.hpp"

#include "remap/face_row.hpp"
#include "remap/flux_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace ballast::remap {

namespace {

constexpr double sliver_fraction = 1e-14; ///< below it a material is round-off and is dropped, with a count

/// Sums a slab contributes to the report, added in slab order.
struct SlabSums {
  std::vector<double> mass_out;
  double internal_out = 0, sliver_mass = 0, sliver_energy = 0;
  long slivers = 0;
};

template <int Dim> class CellSweep {
public:
  CellSweep(Mesh<Dim>& mesh, const Settings& settings, int axis)
      : m_(mesh), s_(settings), axis_(axis), faces_(mesh.grid.cells[0] + (axis == 0 ? 1 : 0)),
        factors_(faces_), unowned_(static_cast<std::size_t>(faces_)) {}

  /// Everything through the faces below the cells of row (j, k), and their total mass flux if the row
  /// of faces is this thread's own (at a cut between threads both compute it, one writes it).
  void fluxes(int j, int k, bool own, FaceRow& out) {
    const int r = m_.grid.cell_row(j, k);
    const Line line = line_of(m_.grid, axis_, j, k);
    const Span faces = m_.faces(axis_, r);
    volume_fluxes(m_, s_, axis_, line, r, out);
    double* totals[2] = {own ? m_.mass_flux[static_cast<std::size_t>(axis_)].row(r) : unowned_.data(), nullptr};
    if (m_.sliding != nullptr) {
      totals[1] = own ? m_.sliding->mass_flux[static_cast<std::size_t>(axis_)].row(r) : unowned_.data();
    }
    bool first[2] = {true, true};
    for (int q = 0; q < m_.material_count(); ++q) {
      if (!out.present(q) || m_.is_void(q)) {
        continue;
      }
      const TileStore& store = *m_.materials[static_cast<std::size_t>(q)];
      const double unlimited = s_.limit ? 0.0 : 1.0;
      double* mass = out.flux(q, 1);
      const Span crossed = out.crossed(q);
      for (int field = 1; field < store.conserved() && crossed != faces; ++field) {
        std::fill(out.flux(q, field) + faces.begin, out.flux(q, field) + faces.end, 0.0);
      }
      mass_fluxes(store, m_.volume, line, unlimited, crossed, out.flux(q, 0), mass, factors_);
      for (int field = 2; field < store.conserved(); ++field) {
        intensive_fluxes(store, field, line, unlimited, crossed, mass, factors_, out.flux(q, field));
      }
      const std::size_t who = m_.slides(q) ? 1 : 0;
      double* total = totals[who];
      if (first[who]) {
        std::copy(mass + faces.begin, mass + faces.end, total + faces.begin);
        first[who] = false;
        continue;
      }
#pragma omp simd
      for (int i = faces.begin; i < faces.end; ++i) {
        total[i] += mass[i];
      }
    }
    for (std::size_t who = 0; who < 2; ++who) {
      if (first[who] && totals[who] != nullptr) {
        std::fill(totals[who] + faces.begin, totals[who] + faces.end, 0.0);
      }
    }
  }

  /// New values of row (j, k) from the fluxes below and above it.
  void update(int j, int k, FaceRow& low, FaceRow& high, SlabSums& sums) {
    const Grid& g = m_.grid;
    const int r = g.cell_row(j, k);
    const int step = axis_ == 0 ? 1 : 0, stride = g.cell_row_stride(axis_);
    const double* v = m_.volume.row(r);
    double* v_next = m_.next_volume.row(r);
    const RowField& swept = m_.swept[static_cast<std::size_t>(axis_)];
    const double *s_low = swept.row(r), *s_high = swept.row(r + stride) + step;
    const Span cells = m_.cells(r);
#pragma omp simd
    for (int i = cells.begin; i < cells.end; ++i) {
      v_next[i] = v[i] + s_high[i] - s_low[i];
    }
    sum_masses(r);
    if (low.sole >= 0 && low.sole == high.sole && holds_alone(low.sole, r)) {
      update_sole(low.sole, r, low, high, step);
    } else {
      for (int q = 0; q < m_.material_count(); ++q) {
        TileStore& store = *m_.materials[static_cast<std::size_t>(q)];
        if (store.has_row(r)) {
          update_material(store, q, r, low, high, step, sums);
        }
      }
      normalise(r);
    }
    boundary_sums(j, k, low, high, step, sums);
  }

private:
  /// Mass of the row's cells before the sweep, of what slides apart: the coordinate in which velocities vary.
  void sum_masses(int r) {
    sum_masses(r, false, m_.scratch->cell_mass.row(r));
    if (m_.sliding != nullptr) {
      sum_masses(r, true, m_.sliding->cell_mass.row(r));
    }
  }
  void sum_masses(int r, bool sliding, double* sum) {
    const int n = m_.grid.cells[0];
    const Span cells = m_.cells(r);
    bool first = true;
    for (int q = 0; q < m_.material_count(); ++q) {
      const TileStore& store = *m_.materials[static_cast<std::size_t>(q)];
      if (m_.is_void(q) || m_.slides(q) != sliding || !store.has_row(r)) {
        continue;
      }
      const double* mass = store.row(1, r);
      if (first) {
        std::copy(mass + cells.begin, mass + cells.end, sum + cells.begin);
        first = false;
        continue;
      }
#pragma omp simd
      for (int i = cells.begin; i < cells.end; ++i) {
        sum[i] += mass[i];
      }
    }
    if (first) {
      std::fill(sum + cells.begin, sum + cells.end, 0.0);
    }
    sum[-1] = sum[0];
    sum[n] = sum[n - 1];
  }

  /// Is nothing else, not even a trace of it, in the row?
  bool holds_alone(int q, int r) const {
    for (int other = 0; other < m_.material_count(); ++other) {
      const TileStore& store = *m_.materials[static_cast<std::size_t>(other)];
      if (other == q || !store.has_row(r)) {
        continue;
      }
      const double* f = store.row(0, r);
      double any = 0;
#pragma omp simd reduction(+ : any)
      for (int i = 0; i < m_.grid.cells[0]; ++i) {
        any += f[i];
      }
      if (any != 0) {
        return false;
      }
    }
    return true;
  }

  /// A row that one material fills, before and after.
  void update_sole(int q, int r, FaceRow& low, FaceRow& high, int step) {
    const Span cells = m_.cells(r);
    for (int other = 0; other < m_.material_count(); ++other) {
      TileStore& store = *m_.materials[static_cast<std::size_t>(other)];
      for (int field = 0; field < store.conserved() && store.has_row(r); ++field) {
        std::fill(store.next_row(field, r) + cells.begin, store.next_row(field, r) + cells.end, field == 0 && other == q ? 1.0 : 0.0);
      }
    }
    if (!m_.is_void(q)) {
      update_intensives(*m_.materials[static_cast<std::size_t>(q)], q, r, low, high, step);
    }
  }

  void update_material(TileStore& store, int q, int r, FaceRow& low, FaceRow& high, int step, SlabSums& sums) {
    const Span cells = m_.cells(r);
    const double *v = m_.volume.row(r), *v_next = m_.next_volume.row(r);
    const double* f = std::as_const(store).row(0, r);
    double* f_next = store.next_row(0, r);
    if (!low.present(q) && !high.present(q)) {
      for (int field = 0; field < store.conserved(); ++field) {
        std::memcpy(store.next_row(field, r) + cells.begin, std::as_const(store).row(field, r) + cells.begin,
                    sizeof(double) * static_cast<std::size_t>(cells.count()));
      }
#pragma omp simd
      for (int i = cells.begin; i < cells.end; ++i) {
        f_next[i] = f[i] == 0 || v_next[i] == v[i] ? f[i] : f[i] * v[i] / v_next[i];
      }
      if (!m_.is_void(q)) {
        drop_slivers(store, q, r, sums);
      }
      return;
    }
    const double *t_low = flux_or_zero(low, q, 0), *t_high = flux_or_zero(high, q, 0) + step;
#pragma omp simd
    for (int i = cells.begin; i < cells.end; ++i) {
      const bool same = (t_low[i] == 0) & (t_high[i] == 0) & (v_next[i] == v[i]);
      const double next = (f[i] * v[i] + t_low[i] - t_high[i]) / v_next[i];
      f_next[i] = same ? f[i] : next;
    }
    if (m_.is_void(q)) {
#pragma omp simd
      for (int i = cells.begin; i < cells.end; ++i) {
        f_next[i] = f_next[i] < sliver_fraction ? 0.0 : f_next[i];
      }
      return;
    }
    update_intensives(store, q, r, low, high, step);
    drop_slivers(store, q, r, sums);
  }

  /// Mass and what it carries.
  void update_intensives(TileStore& store, int q, int r, FaceRow& low, FaceRow& high, int step) {
    const Span cells = m_.cells(r);
    const double* mass = std::as_const(store).row(1, r);
    double* mass_next = store.next_row(1, r);
    const double *m_low = flux_or_zero(low, q, 1), *m_high = flux_or_zero(high, q, 1) + step;
#pragma omp simd
    for (int i = cells.begin; i < cells.end; ++i) {
      mass_next[i] = mass[i] + m_low[i] - m_high[i];
    }
    for (int field = 2; field < store.conserved(); ++field) {
      const double* x = std::as_const(store).row(field, r);
      double* x_next = store.next_row(field, r);
      const double *x_low = flux_or_zero(low, q, field), *x_high = flux_or_zero(high, q, field) + step;
#pragma omp simd
      for (int i = cells.begin; i < cells.end; ++i) {
        const bool same = (m_low[i] == 0) & (m_high[i] == 0), some = mass_next[i] > 0;
        const double safe = some ? mass_next[i] : 1.0;
        // (m x + in - out) / m_next as a change of x: a uniform value stays so to the bit.
        const double next = x[i] + ((x_low[i] - m_low[i] * x[i]) - (x_high[i] - m_high[i] * x[i])) / safe;
        const double changed = some ? next : 0.0, old = x[i];
        x_next[i] = same ? old : changed;
      }
    }
  }

  const double* flux_or_zero(FaceRow& row, int q, int field) {
    if (row.present(q)) {
      return row.flux(q, field);
    }
    if (zeros_.size() < static_cast<std::size_t>(faces_ + 1)) {
      zeros_.assign(static_cast<std::size_t>(faces_ + 1), 0.0);
    }
    return zeros_.data();
  }

  void drop_slivers(TileStore& store, int q, int r, SlabSums& sums) {
    double* f = store.next_row(0, r);
    double* mass = store.next_row(1, r);
    const double* volume = m_.next_volume.row(r);
    const double least = sliver_fraction * m_.reference_density_of(q);
    const Span cells = m_.cells(r);
    int suspects = 0;
#pragma omp simd reduction(+ : suspects)
    for (int i = cells.begin; i < cells.end; ++i) {
      suspects += (f[i] < sliver_fraction) | !(mass[i] > least * volume[i]) ? 1 : 0;
    }
    for (int i = cells.begin; i < cells.end && suspects > 0; ++i) {
      if ((f[i] >= sliver_fraction && mass[i] > least * volume[i]) || (f[i] == 0 && mass[i] == 0)) {
        continue;
      }
      sums.sliver_mass += mass[i];
      sums.sliver_energy += mass[i] * store.next_row(2, r)[i];
      ++sums.slivers;
      for (int field = 0; field < store.conserved(); ++field) {
        store.next_row(field, r)[i] = 0;
      }
    }
  }

  /// Fractions of every cell sum to one exactly; the largest absorbs round-off.
  void normalise(int r) {
    const auto n = static_cast<std::size_t>(m_.grid.cells[0]);
    const Span cells = m_.cells(r);
    rest_.assign(n, 1.0);
    most_.assign(n, 0.0);
    who_.assign(n, -1.0);
    double *rest = rest_.data(), *most = most_.data(), *who = who_.data();
    for (int q = 0; q < m_.material_count(); ++q) {
      TileStore& store = *m_.materials[static_cast<std::size_t>(q)];
      if (!store.has_row(r)) {
        continue;
      }
      const double* f = store.next_row(0, r);
#pragma omp simd
      for (int i = cells.begin; i < cells.end; ++i) {
        const double old = who[i];
        rest[i] -= f[i];
        who[i] = f[i] > most[i] ? q : old;
        most[i] = std::max(most[i], f[i]);
      }
    }
    for (int i = cells.begin; i < cells.end; ++i) {
      const auto c = static_cast<std::size_t>(i);
      if (rest_[c] != 0 && who_[c] >= 0) {
        m_.materials[static_cast<std::size_t>(who_[c])]->next_row(0, r)[i] += rest_[c];
      }
    }
  }

  void boundary_sums(int j, int k, FaceRow& low, FaceRow& high, int step, SlabSums& sums) {
    const Grid& g = m_.grid;
    const Span cells = m_.cells(g.cell_row(j, k));
    const int index = axis_ == 1 ? j : k, last = g.cells[static_cast<std::size_t>(axis_)] - 1;
    const auto add = [&](FaceRow& row, int face_begin, int face_end, double sign) {
      for (int q = 0; q < m_.material_count(); ++q) {
        if (!row.present(q) || m_.is_void(q)) {
          continue;
        }
        for (int i = face_begin; i < face_end; ++i) {
          sums.mass_out[static_cast<std::size_t>(q)] += sign * row.flux(q, 1)[i];
          sums.internal_out += sign * row.flux(q, 2)[i];
        }
      }
    };
    if (axis_ == 0) {
      add(low, 0, cells.begin == 0 ? 1 : 0, -1.0);
      add(high, g.cells[0], cells.end == g.cells[0] ? g.cells[0] + step : 0, 1.0);
      return;
    }
    if (index == 0) {
      add(low, cells.begin, cells.end, -1.0);
    }
    if (index == last) {
      add(high, cells.begin, cells.end, 1.0);
    }
  }

  Mesh<Dim>& m_;
  const Settings& s_;
  int axis_, faces_;
  FaceFactors factors_;
  std::vector<double> unowned_, zeros_, rest_, most_, who_;
};

} // namespace

template <int Dim>
void sweep_cells(Mesh<Dim>& m, const Settings& settings, ThreadPool& pool, int axis, Report& report) {
  const Grid& g = m.grid;
  std::vector<SlabSums> sums(static_cast<std::size_t>(g.slabs()));
  parallel_awake(pool, m.awake, g.slabs(), [&](int begin, int end, int) {
    CellSweep<Dim> sweep(m, settings, axis);
    const int faces = g.cells[0] + (axis == 0 ? 1 : 0);
    const bool outer = axis == Dim - 1;
    // Fluxes below the next row along the axis are those above this one: carried, not recomputed.
    std::vector<FaceRow> carry(static_cast<std::size_t>(outer ? g.rows_per_slab() : 1), FaceRow(m, faces));
    FaceRow next(m, faces);
    for (int s = begin; s < end; ++s) {
      SlabSums& slab = sums[static_cast<std::size_t>(s)];
      slab.mass_out.assign(m.materials.size(), 0.0);
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        FaceRow& low = carry[static_cast<std::size_t>(outer ? q : 0)];
        const int r = g.cell_row(j, k);
        if (m.cells(r).empty()) {
          continue;
        }
        const bool first = axis == 0 || (outer ? s == begin : q == 0) || m.cells(r - g.cell_row_stride(axis)).empty();
        if (first) { // else carried
          sweep.fluxes(j, k, true, low);
        }
        if (axis == 0) {
          sweep.update(j, k, low, low, slab);
        } else {
          const bool cut = outer && s + 1 == end && end < g.slabs();
          sweep.fluxes(axis == 1 ? j + 1 : j, axis == 2 ? k + 1 : k, !cut, next);
          sweep.update(j, k, low, next, slab);
          std::swap(low, next);
        }
      }
    }
  });
  for (const SlabSums& s : sums) {
    for (std::size_t q = 0; q < m.materials.size(); ++q) {
      report.mass_out[q] += s.mass_out[q];
    }
    report.internal_out += s.internal_out;
    report.sliver_mass += s.sliver_mass;
    report.sliver_energy += s.sliver_energy;
    report.slivers += s.slivers;
  }
  for (TileStore* store : m.materials) {
    store->swap();
  }
  m.volume.swap(m.next_volume);
}

template void sweep_cells<2>(Mesh<2>&, const Settings&, ThreadPool&, int, Report&);
template void sweep_cells<3>(Mesh<3>&, const Settings&, ThreadPool&, int, Report&);

} // namespace ballast::remap
