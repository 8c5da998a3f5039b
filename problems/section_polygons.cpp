#include "problems/section_polygons.hpp"

#include "ale/fill.hpp"
#include "remap/polygon.hpp"
#include "remap/reconstruct.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

/// The material that fills what is beyond a side, or -1 where that mirrors the block; as a remap has it.
template <int Dim> int material_beyond(const Block<Dim>& b, int axis, int side) {
  const BoundarySide& s = b.boundary.at(axis, side);
  if (s.kind == BoundaryKind::inflow) {
    return s.inflow.material;
  }
  return s.kind == BoundaryKind::free && b.reference_pressure == 0 ? b.void_index() : -1;
}

/// The volume fractions that interfaces in the section depend on: all in 2D, the section's layer and the next in 3D.
/// Ghosts are filled here: a block's own are only up to date in a sweep.
template <int Dim> struct Fractions {
  Grid grid;
  std::vector<TileStore> stores;
  std::vector<const TileStore*> views;

  Fractions(const Block<Dim>& b, int layer) : grid(Dim, b.grid.cells) {
    if (Dim == 3) {
      grid.cells[1] = std::min(2, grid.cells[1] - layer);
    }
    for (const MaterialSlot& slot : b.materials) {
      TileStore& store = stores.emplace_back(grid, grid.cell_rows(), 1, 0);
      store.allocate(0);
      const auto row = [&](int j, int k) { return store.row(0, grid.cell_row(j, k)); };
      for (int k = 0; k < grid.cells[2]; ++k) {
        for (int j = 0; j < grid.cells[1]; ++j) {
          const double* f = slot.store.row(field::fraction, b.grid.cell_row(j + layer, k));
          std::copy(f, f + grid.cells[0], row(j, k));
        }
      }
      mirror_cells(grid, {1, 1, 1}, row);
    }
    for (int axis = 0; axis < Dim; ++axis) {
      for (int side = 0; side < 2; ++side) {
        if (const int material = material_beyond(b, axis, side); material >= 0 && (Dim == 2 || axis != 1 || (side == 0 && layer == 0))) {
          fill_beyond(axis, side, material);
        }
      }
    }
    for (const TileStore& store : stores) {
      views.push_back(&store);
    }
  }

  void fill_beyond(int axis, int side, int material) {
    const int n = grid.cells[static_cast<std::size_t>(axis)];
    for (int k = -grid.ghost[2]; k < grid.cells[2] + grid.ghost[2]; ++k) {
      for (int j = -grid.ghost[1]; j < grid.cells[1] + grid.ghost[1]; ++j) {
        for (int i = -grid.ghost[0]; i < grid.cells[0] + grid.ghost[0]; ++i) {
          const int at = std::array{i, j, k}[static_cast<std::size_t>(axis)];
          for (std::size_t m = 0; m < stores.size() && (side == 0 ? at < 0 : at >= n); ++m) {
            stores[m].row(0, grid.cell_row(j, k))[i] = static_cast<int>(m) == material ? 1.0 : 0.0;
          }
        }
      }
    }
  }
};

/// An interface where it meets the section, in the unit square of (x, y) or (x, z): of a cube the face y = 0.
remap::Interface<2> section_line(const remap::Interface<2>& line) { return line; }
remap::Interface<2> section_line(const remap::Interface<3>& plane) {
  return {.n = {plane.n[0], plane.n[2]}, .alpha = plane.alpha};
}

/// Part q of a cell.
template <int Dim> remap::Polygon<2> part_of(const remap::Reconstruction<Dim>& cell, int q, const remap::Quad& outline) {
  remap::Interface<2> inner{}, outer{};
  if (q > 0) {
    inner = section_line(cell.planes[q - 1]);
  }
  if (q + 1 < cell.count) {
    outer = section_line(cell.planes[q]);
  }
  return remap::material_polygon(outline, q > 0 ? &inner : nullptr, q + 1 < cell.count ? &outer : nullptr);
}

} // namespace

template <int Dim> int section_layer(const Block<Dim>& b) {
  int best = 0;
  if (Dim == 2 || !b.map.curved()) {
    return best;
  }
  const auto height = [&](int j) { return std::abs(b.target[1].row(b.grid.node_row(j, 0))[b.grid.cells[0] / 2] - b.map.centre[1]); };
  for (int j = 1; j < b.grid.cells[1]; ++j) {
    best = height(j) < height(best) ? j : best;
  }
  return best;
}

template <int Dim> io::GridDump::Polygons section_polygons(const Block<Dim>& b, remap::NormalMethod normal) {
  constexpr int up = Dim - 1; // the section's other axis: y or z
  io::GridDump::Polygons out;
  const int layer = section_layer(b);
  const Fractions<Dim> fractions(b, layer);
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    if (b.owner_row(r)[i] >= 0 || !in_section<Dim>(b.grid, r, layer)) {
      return;
    }
    const auto cell = remap::reconstruct_cell<Dim>(fractions.grid, fractions.views, normal, fractions.grid.cell_row(j - layer, k), i);
    const int n0 = b.grid.node_row(j, k), n1 = n0 + b.grid.node_row_stride(up);
    const auto at = [&](int n, int q) { return remap::Point<2>{b.position[0].row(n)[q], b.position[up].row(n)[q]}; };
    const remap::Quad outline = {at(n0, i), at(n0, i + 1), at(n1, i + 1), at(n1, i)};
    for (int q = 0; q < cell.count; ++q) {
      if (cell.present[q] == b.void_index()) {
        continue;
      }
      const remap::Polygon<2> part = part_of(cell, q, outline);
      if (part.count < 3) {
        continue;
      }
      for (int p = 0; p < part.count; ++p) {
        const auto [x, other] = part.points[static_cast<std::size_t>(p)];
        if constexpr (Dim == 3) {
          out.points.insert(out.points.end(), {x, b.position[1].row(n0)[i], other});
        } else {
          out.points.insert(out.points.end(), {x, other, 0.0});
        }
      }
      out.sizes.push_back(part.count);
      out.material.push_back(cell.present[q]);
    }
  });
  return out;
}

template int section_layer<2>(const Block<2>&);
template int section_layer<3>(const Block<3>&);
template io::GridDump::Polygons section_polygons<2>(const Block<2>&, remap::NormalMethod);
template io::GridDump::Polygons section_polygons<3>(const Block<3>&, remap::NormalMethod);

} // namespace ballast
