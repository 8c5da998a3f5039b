#include "core/boundary.hpp"
#include "core/rows.hpp"
#include "remap/internal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballast::remap {

namespace {

/// How hard a pseudo-step is on the cells.
struct Strain {
  double share = 0; ///< largest share of its donor's volume that a face sweeps
  double ratio = 1; ///< largest max(V* / v, v / V*) of volumes V* between sweeps, v = min(V_old, V_new)
};
constexpr double largest_ratio = 5;
constexpr double hopeless_ratio = 1e3; ///< of the smallest part: a volume between sweeps is gone

template <int Dim> void strain_of_row(const Mesh<Dim>& m, int r, long order, std::vector<double>& between, Strain& worst) {
  const Grid& g = m.grid;
  const double* v = m.volume.row(r);
  double* vs = between.data(); // Dim rows: volume after each sweep
  const int n = g.cells[0];
  const Span cells = m.cells(r);
  double share = worst.share, ratio = worst.ratio;
  for (int q = 0; q < Dim; ++q) {
    const int axis = sweep_axis(Dim, q, order);
    const RowField& swept = m.swept[static_cast<std::size_t>(axis)];
    const double *low = swept.row(r), *high = swept.row(r + g.cell_row_stride(axis)) + (axis == 0 ? 1 : 0);
    const double* before = q == 0 ? v : vs + (q - 1) * n;
    double* after = vs + q * n;
#pragma omp simd reduction(max : share)
    for (int i = cells.begin; i < cells.end; ++i) {
      share = std::max(share, std::max(low[i], -high[i]) / v[i]);
      after[i] = before[i] + high[i] - low[i];
    }
  }
  const double* v_new = vs + (Dim - 1) * n;
  for (int q = 0; q + 1 < Dim; ++q) {
    const double* v_star = vs + q * n;
#pragma omp simd reduction(max : ratio)
    for (int i = cells.begin; i < cells.end; ++i) {
      const double least = std::min(v[i], v_new[i]);
      const double here = std::max(v_star[i] / least, least / std::max(v_star[i], 1e-9 * least));
      ratio = std::max(ratio, least > 0 ? here : std::numeric_limits<double>::infinity());
    }
  }
  worst = {share, ratio};
}

template <int Dim> Strain strain_of(const Mesh<Dim>& m, ThreadPool& pool, long order) {
  const Grid& g = m.grid;
  std::vector<Strain> worst(static_cast<std::size_t>(g.slabs()));
  parallel_awake(pool, m.awake, g.slabs(), [&](int begin, int end, int) {
    std::vector<double> between(static_cast<std::size_t>(Dim * g.cells[0]));
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        strain_of_row(m, g.cell_row(j, k), order, between, worst[static_cast<std::size_t>(s)]);
      }
    }
  });
  Strain all;
  for (const Strain& s : worst) {
    all = {std::max(all.share, s.share), std::max(all.ratio, s.ratio)};
  }
  return all;
}

/// The cell whose volumes between sweeps are worst.
template <int Dim> std::array<int, 3> worst_cell(const Mesh<Dim>& m, long order) {
  const Grid& g = m.grid;
  const auto n = static_cast<std::size_t>(g.cells[0]);
  std::vector<double> between(static_cast<std::size_t>(Dim) * n);
  std::array<int, 3> worst = {0, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (int s = 0; s < g.slabs(); ++s) {
    for (int q = 0; q < g.rows_per_slab(); ++q) {
      const auto [j, k] = g.in_slab(s, q);
      Strain ignored;
      strain_of_row(m, g.cell_row(j, k), order, between, ignored);
      for (std::size_t c = 0; c < between.size(); ++c) {
        if (!m.cells(g.cell_row(j, k)).holds({static_cast<int>(c % n), static_cast<int>(c % n) + 1})) {
          continue;
        }
        const double share = between[c] / m.volume.row(g.cell_row(j, k))[c % n];
        if (!(share >= least)) {
          least = share;
          worst = {static_cast<int>(c % n), j, k};
        }
      }
    }
  }
  return worst;
}

/// Tiles within reach of a tile where a material is present are allocated, others released.
template <int Dim> void follow_presence(Mesh<Dim>& m, ThreadPool& pool) {
  const Grid& g = m.grid;
  for (TileStore* store : m.materials) {
    const int tiles = store->tile_count(), per_tile = store->rows_per_tile(), rows = g.cell_rows();
    std::vector<char> filled(static_cast<std::size_t>(tiles)), wanted(filled.size());
    parallel_ranges(pool, tiles, [&](int begin, int end, int) {
      for (int t = begin; t < end; ++t) {
        filled[static_cast<std::size_t>(t)] = store->any(0, t) ? 1 : 0;
      }
    });
    const auto mark = [&](int first, int last) {
      for (int t = std::max(first, 0) / per_tile; t <= std::min(last, rows - 1) / per_tile; ++t) {
        wanted[static_cast<std::size_t>(t)] = 1;
      }
    };
    for (int t = 0; t < tiles; ++t) {
      if (!filled[static_cast<std::size_t>(t)]) {
        continue;
      }
      const int first = t * per_tile, last = first + per_tile - 1;
      for (const int plane : {-2, -1, 0, 1, 2}) {
        if (Dim == 2 && plane != 0) {
          continue;
        }
        const int shift = plane * g.cell_rows_per_plane();
        mark(first - 2 + shift, last + 2 + shift);
      }
    }
    for (int t = 0; t < tiles; ++t) {
      if (wanted[static_cast<std::size_t>(t)]) {
        store->allocate(t);
      } else if (store->allocated(t)) {
        store->release(t);
      }
    }
  }
}

/// Ghost cells beyond a side hold what the mesh says. A material that comes in gets its tiles at the edge rows as well: there the
/// sweep puts it.
template <int Dim> void fill_outside(Mesh<Dim>& m, int axis, int side) {
  const Grid& g = m.grid;
  const auto a = static_cast<std::size_t>(axis);
  std::vector<Outside> parts;
  const auto row_of = [&](TileStore& store, int field, int r) {
    if (!store.has_row(r)) {
      store.allocate(store.tile_of(r));
    }
    return store.row(field, r);
  };
  for (int k = -g.ghost[2]; k < g.cells[2] + g.ghost[2]; ++k) {
    for (int j = -g.ghost[1]; j < g.cells[1] + g.ghost[1]; ++j) {
      const int r = g.cell_row(j, k);
      const int index[3] = {0, j, k};
      int first = -g.ghost[0], last = g.cells[0] + g.ghost[0];
      if (axis == 0) {
        first = side == 0 ? -g.ghost[0] : g.cells[0];
        last = side == 0 ? 0 : g.cells[0] + g.ghost[0];
      }
      const bool ghosts = axis == 0 || (side == 0 ? index[axis] < 0 : index[axis] >= g.cells[a]);
      const bool edge = axis > 0 && index[axis] == (side == 0 ? 0 : g.cells[a] - 1);
      if ((!ghosts && !edge) || m.cells(r).empty()) {
        continue;
      }
      const double* volume = m.volume.row(r);
      for (int i = first; i < last; ++i) {
        parts.clear();
        std::array<int, 3> cell = {i, j, k};
        cell[a] = edge ? (side == 0 ? -1 : g.cells[a]) : cell[a];
        m.outside(axis, side, cell, parts);
        if (edge) {
          for (const Outside& p : parts) {
            if (!m.is_void(p.material)) {
              row_of(*m.materials[static_cast<std::size_t>(p.material)], 0, r);
            }
          }
          continue;
        }
        for (TileStore* store : m.materials) {
          for (int field = 0; field < store->conserved() && store->has_row(r); ++field) {
            store->row(field, r)[i] = 0;
          }
        }
        for (const Outside& p : parts) {
          TileStore& store = *m.materials[static_cast<std::size_t>(p.material)];
          row_of(store, 0, r)[i] = p.fraction;
          if (!m.is_void(p.material)) {
            store.row(1, r)[i] = p.density * (p.fraction * volume[i]);
            store.row(2, r)[i] = p.specific_energy;
          }
        }
        m.owner_row(r)[i] = static_cast<std::int8_t>(parts.size() == 1 ? parts[0].material : -1);
      }
    }
  }
}

template <int Dim> void exchange_owner(Mesh<Dim>& m, ThreadPool& pool) {
  const Grid& g = m.grid;
  if (m.material_count() == 1) {
    std::fill(m.owner.begin(), m.owner.end(), static_cast<std::int8_t>(0));
    return;
  }
  parallel_ranges(pool, g.cell_rows(), [&](int begin, int end, int) {
    for (int r = begin; r < end; ++r) {
      const Span cells = m.cells(r);
      if (cells.empty()) {
        continue;
      }
      std::int8_t* owner = m.owner_row(r);
      const int first = cells.begin == 0 ? -g.ghost[0] : cells.begin, last = cells.end == g.cells[0] ? cells.end + g.ghost[0] : cells.end;
      std::fill(owner + first, owner + last, static_cast<std::int8_t>(-1));
      for (int q = 0; q < m.material_count(); ++q) {
        const TileStore& store = *m.materials[static_cast<std::size_t>(q)];
        if (!store.has_row(r)) {
          continue;
        }
        mark_owner(store.row(0, r), q, first, last, owner);
      }
    }
  });
}

} // namespace

template <int Dim> void exchange_for_sweep(Mesh<Dim>& m, ThreadPool& pool, int axis) {
  const Grid& g = m.grid;
  follow_presence(m, pool);
  // Components of a tensor that change sign in a mirror only matter for slopes at the wall, where
  // the even mirror gives a zero slope: first order there, by choice.
  const auto row_of = [&](TileStore& store, int field) {
    return [&m, &g, &store, field](int j, int k) -> double* {
      const int r = g.cell_row(j, k);
      return !m.cells(r).empty() && store.has_row(r) ? store.row(field, r) : nullptr;
    };
  };
  const auto fields_at = [&](const TileStore& store, int along) { // interfaces look to all sides, slopes along the sweep only
    return along == axis ? store.conserved() : 1;
  };
  parallel_awake(pool, m.awake, g.slabs(), [&](int begin, int end, int) {
    for (int slab = begin; slab < end; ++slab) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(slab, q);
        for (TileStore* store : m.materials) {
          for (int field = 0; field < fields_at(*store, 0); ++field) {
            mirror_row(g, row_of(*store, field)(j, k), 1);
          }
        }
      }
    }
  });
  for (int along = 1; along < Dim; ++along) {
    for (TileStore* store : m.materials) {
      for (int field = 0; field < fields_at(*store, along); ++field) {
        mirror_cells_along(g, along, 1, row_of(*store, field));
      }
    }
  }
  exchange_cells(g, m.volume, m.awake);
}

template <int Dim>
void sweep_all(Mesh<Dim>& m, const Settings& settings, ThreadPool& pool, long order, Report& report) {
  report.mass_out.resize(m.materials.size(), 0.0);
  Scratch own;
  Scratch* const kept = m.scratch;
  m.scratch = kept ? kept : &own;
  if (m.scratch->cell_mass.empty()) {
    *m.scratch = {RowField::of_cells(m.grid), RowField::of_nodes(m.grid), RowField::of_nodes(m.grid)};
  }
  if (m.sliding != nullptr) {
    part_sliding(m, pool);
  }
  for (int q = 0; q < Dim; ++q) {
    const int axis = sweep_axis(Dim, q, order);
    exchange_for_sweep(m, pool, axis);
    exchange_owner(m, pool);
    for (int a = 0; a < Dim; ++a) {
      for (int side = 0; side < 2; ++side) {
        const auto ax = static_cast<std::size_t>(a), s = static_cast<std::size_t>(side);
        if (m.fed[ax][s]) {
          fill_outside(m, a, side);
        }
      }
    }
    sweep_cells(m, settings, pool, axis, report);
    sweep_nodes(m, settings, pool, axis, q == 0, report);
  }
  if (m.sliding != nullptr) {
    join_sliding(m, pool, report);
  }
  if (settings.return_kinetic) {
    return_kinetic(m, pool, report);
  }
  m.scratch = kept;
  ++report.substeps;
}

/// The nodes at `part` of the way.
template <int Dim>
std::array<RowField, Dim> on_the_way(const std::array<RowField, Dim>& start, const std::array<RowField, Dim>& end, double part) {
  std::array<RowField, Dim> to = end;
  for (std::size_t d = 0; d < Dim && part < 1; ++d) {
    auto& x = to[d].data();
    const auto &a = start[d].data(), &b = end[d].data();
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = a[i] + part * (b[i] - a[i]);
    }
  }
  return to;
}

template <int Dim> void reach_target(Mesh<Dim>& m, ThreadPool& pool) {
  if (m.kept_target != nullptr) {
    for (std::size_t d = 0; d < Dim; ++d) {
      m.position[d].swap((*m.kept_target)[d]);
    }
    return;
  }
  const Grid& g = m.grid;
  parallel_ranges(pool, g.node_rows(), [&](int begin, int end, int) {
    for (int r = begin; r < end; ++r) {
      for (std::size_t d = 0; d < Dim && !m.nodes(r).empty(); ++d) { // ghosts as well
        const double* to = m.target[d].row(r);
        std::copy(to - g.ghost[0], to + g.cells[0] + 1 + g.ghost[0], m.position[d].row(r) - g.ghost[0]);
      }
    }
  });
}

template <int Dim> Report remap(Mesh<Dim>& m, const Settings& settings, ThreadPool& pool, long order) {
  constexpr double smallest_part = 1.0 / 512;
  Report report;
  report.mass_out.resize(m.materials.size(), 0.0);
  const auto fits = [&](const Strain& s) { return s.share <= settings.largest_swept && s.ratio < largest_ratio; };
  compute_swept<Dim>(m, pool, m.position, m.target, order);
  const Strain whole = strain_of(m, pool, order);
  if (fits(whole)) {
    sweep_all(m, settings, pool, order, report);
    reach_target(m, pool);
    return report;
  }
  // Larger motions go in parts: every swept volume then fits its donor and no cell is squeezed between
  // sweeps beyond what either end of the part asks for.
  const std::array<RowField, Dim> start = m.position;
  const double parts = std::clamp(std::ceil(whole.share / settings.largest_swept), 1.0, 1 / smallest_part);
  double done = 0;
  for (double part = 1 / parts; done < 1;) {
    const double next = done + 1.5 * part > 1 ? 1 : done + part; // no tiny last part
    const std::array<RowField, Dim> to = on_the_way<Dim>(start, m.target, next);
    const long turn = order + report.substeps;
    compute_swept<Dim>(m, pool, m.position, to, turn);
    // A face 10 % over its share does no harm; a squeezed cell does.
    Strain s = strain_of(m, pool, turn);
    s.share *= 0.9;
    if (!fits(s) && part > smallest_part) {
      part = 0.5 * (next - done);
      continue;
    }
    if (!(s.ratio < hopeless_ratio && s.share < 1)) {
      report.tangled = worst_cell(m, turn);
      return report;
    }
    sweep_all(m, settings, pool, turn, report);
    m.position = to;
    done = next;
  }
  return report;
}

template Report remap<2>(Mesh<2>&, const Settings&, ThreadPool&, long);
template Report remap<3>(Mesh<3>&, const Settings&, ThreadPool&, long);
template void sweep_all<2>(Mesh<2>&, const Settings&, ThreadPool&, long, Report&);
template void sweep_all<3>(Mesh<3>&, const Settings&, ThreadPool&, long, Report&);
template void exchange_for_sweep<2>(Mesh<2>&, ThreadPool&, int);
template void exchange_for_sweep<3>(Mesh<3>&, ThreadPool&, int);

} // namespace ballast::remap
