#include "core/boundary.hpp"
#include "remap/internal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ballast::remap {

namespace {

/// Largest share of its donor's volume that any face sweeps.
template <int Dim> double largest_share(const Mesh<Dim>& m, ThreadPool& pool) {
  const Grid& g = m.grid;
  std::vector<double> worst(static_cast<std::size_t>(g.slabs()), 0.0);
  parallel_ranges(pool, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      double share = 0;
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        const double* v = m.volume.row(r);
        for (int axis = 0; axis < Dim; ++axis) {
          const RowField& swept = m.swept[static_cast<std::size_t>(axis)];
          const double *low = swept.row(r), *high = swept.row(r + g.cell_row_stride(axis)) + (axis == 0 ? 1 : 0);
#pragma omp simd reduction(max : share)
          for (int i = 0; i < g.cells[0]; ++i) {
            share = std::max(share, std::max(low[i], -high[i]) / v[i]);
          }
        }
      }
      worst[static_cast<std::size_t>(s)] = share;
    }
  });
  return *std::max_element(worst.begin(), worst.end());
}

/// Tiles within reach of a tile where a material is present are allocated, others released.
template <int Dim> void follow_presence(Mesh<Dim>& m) {
  const Grid& g = m.grid;
  for (TileStore* store : m.materials) {
    const int tiles = store->tile_count(), per_tile = store->rows_per_tile(), rows = g.cell_rows();
    std::vector<char> wanted(static_cast<std::size_t>(tiles), 0);
    const auto mark = [&](int first, int last) {
      for (int t = std::max(first, 0) / per_tile; t <= std::min(last, rows - 1) / per_tile; ++t) {
        wanted[static_cast<std::size_t>(t)] = 1;
      }
    };
    for (int t = 0; t < tiles; ++t) {
      if (!store->any(0, t)) {
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

template <int Dim> void fill_void_outside(Mesh<Dim>& m, int axis, int side) {
  const Grid& g = m.grid;
  const auto a = static_cast<std::size_t>(axis);
  for (int k = -g.ghost[2]; k < g.cells[2] + g.ghost[2]; ++k) {
    for (int j = -g.ghost[1]; j < g.cells[1] + g.ghost[1]; ++j) {
      const int r = g.cell_row(j, k);
      const int index[3] = {0, j, k};
      int first = -g.ghost[0], last = g.cells[0] + g.ghost[0];
      if (axis == 0) {
        first = side == 0 ? -g.ghost[0] : g.cells[0];
        last = side == 0 ? 0 : g.cells[0] + g.ghost[0];
      } else if (side == 0 ? index[axis] >= 0 : index[axis] < g.cells[a]) {
        continue;
      }
      for (int q = 0; q < m.material_count(); ++q) {
        TileStore& store = *m.materials[static_cast<std::size_t>(q)];
        if (!store.has_row(r)) {
          if (!m.is_void(q)) {
            continue;
          }
          store.allocate(store.tile_of(r));
        }
        for (int field = 0; field < store.conserved(); ++field) {
          std::fill(store.row(field, r) + first, store.row(field, r) + last, field == 0 && m.is_void(q) ? 1.0 : 0.0);
        }
      }
      std::fill(m.owner_row(r) + first, m.owner_row(r) + last, static_cast<std::int8_t>(m.material_count() - 1));
    }
  }
}

template <int Dim> void exchange_owner(Mesh<Dim>& m, ThreadPool& pool) {
  const Grid& g = m.grid;
  constexpr double pure_enough = 1 - 1e-12;
  parallel_ranges(pool, g.cell_rows(), [&](int begin, int end, int) {
    for (int r = begin; r < end; ++r) {
      std::int8_t* owner = m.owner_row(r);
      std::fill(owner - g.ghost[0], owner + g.cells[0] + g.ghost[0], static_cast<std::int8_t>(-1));
      for (int q = 0; q < m.material_count(); ++q) {
        const TileStore& store = *m.materials[static_cast<std::size_t>(q)];
        if (!store.has_row(r)) {
          continue;
        }
        const double* f = store.row(0, r);
        for (int i = -g.ghost[0]; i < g.cells[0] + g.ghost[0]; ++i) {
          owner[i] = f[i] >= pure_enough ? static_cast<std::int8_t>(q) : owner[i];
        }
      }
    }
  });
}

} // namespace

template <int Dim> void exchange_for_sweep(Mesh<Dim>& m) {
  const Grid& g = m.grid;
  follow_presence(m);
  for (TileStore* store : m.materials) {
    for (int field = 0; field < store->conserved(); ++field) {
      // Components of a tensor that change sign in a mirror only matter for slopes at the wall, where
      // the even mirror gives a zero slope: first order there, by choice.
      mirror_cells(g, {1, 1, 1}, [&](int j, int k) -> double* {
        const int r = g.cell_row(j, k);
        return store->has_row(r) ? store->row(field, r) : nullptr;
      });
    }
  }
  mirror_cells(g, {1, 1, 1}, [&](int j, int k) { return m.volume.row(g.cell_row(j, k)); });
}

template <int Dim>
void sweep_all(Mesh<Dim>& m, const Settings& settings, ThreadPool& pool, long order, Report& report) {
  report.mass_out.resize(m.materials.size(), 0.0);
  for (int q = 0; q < Dim; ++q) {
    const int axis = order % 2 == 0 ? q : Dim - 1 - q;
    exchange_for_sweep(m);
    exchange_owner(m, pool);
    for (int a = 0; a < Dim; ++a) {
      for (int side = 0; side < 2; ++side) {
        if (m.has_void && m.void_outside[static_cast<std::size_t>(a)][static_cast<std::size_t>(side)]) {
          fill_void_outside(m, a, side);
        }
      }
    }
    sweep_cells(m, settings, pool, axis, report);
    sweep_nodes(m, settings, pool, axis, report);
  }
  ++report.substeps;
}

template <int Dim> Report remap(Mesh<Dim>& m, const Settings& settings, ThreadPool& pool, long order) {
  Report report;
  report.mass_out.resize(m.materials.size(), 0.0);
  compute_swept<Dim>(m, pool, m.position, m.target);
  const int substeps = std::max(1, static_cast<int>(std::ceil(largest_share(m, pool) / settings.largest_swept)));
  if (substeps == 1) {
    sweep_all(m, settings, pool, order, report);
    m.position = m.target;
    return report;
  }
  // Larger motions go in equal parts: every swept volume then fits its donor.
  const std::array<RowField, Dim> start = m.position;
  for (int s = 1; s <= substeps; ++s) {
    std::array<RowField, Dim> to = m.target;
    if (s < substeps) {
      const double part = static_cast<double>(s) / substeps;
      for (std::size_t d = 0; d < Dim; ++d) {
        auto& x = to[d].data();
        const auto &a = start[d].data(), &b = m.target[d].data();
        for (std::size_t i = 0; i < x.size(); ++i) {
          x[i] = a[i] + part * (b[i] - a[i]);
        }
      }
    }
    compute_swept<Dim>(m, pool, m.position, to);
    sweep_all(m, settings, pool, order + s - 1, report);
    m.position = to;
  }
  return report;
}

template Report remap<2>(Mesh<2>&, const Settings&, ThreadPool&, long);
template Report remap<3>(Mesh<3>&, const Settings&, ThreadPool&, long);
template void sweep_all<2>(Mesh<2>&, const Settings&, ThreadPool&, long, Report&);
template void sweep_all<3>(Mesh<3>&, const Settings&, ThreadPool&, long, Report&);
template void exchange_for_sweep<2>(Mesh<2>&);
template void exchange_for_sweep<3>(Mesh<3>&);

} // namespace ballast::remap
