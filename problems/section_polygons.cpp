#include "problems/section_polygons.hpp"

#include "ale/fill.hpp"
#include "remap/polygon.hpp"
#include "remap/reconstruct.hpp"

#include <algorithm>

namespace ballast {

namespace {

/// The volume fractions that interfaces in the section depend on, ghosts mirrored (a block's own ghosts
/// are only filled for a sweep): all in 2D, the layers j = 0 and 1 in 3D.
template <int Dim> struct Fractions {
  Grid grid;
  std::vector<TileStore> stores;
  std::vector<const TileStore*> views;

  explicit Fractions(const Block<Dim>& b) : grid(Dim, b.grid.cells) {
    if (Dim == 3) {
      grid.cells[1] = std::min(2, grid.cells[1]);
    }
    for (const MaterialSlot& slot : b.materials) {
      TileStore& store = stores.emplace_back(grid, grid.cell_rows(), 1, 0);
      store.allocate(0);
      const auto row = [&](int j, int k) { return store.row(0, grid.cell_row(j, k)); };
      for (int k = 0; k < grid.cells[2]; ++k) {
        for (int j = 0; j < grid.cells[1]; ++j) {
          const double* f = slot.store.row(field::fraction, b.grid.cell_row(j, k));
          std::copy(f, f + grid.cells[0], row(j, k));
        }
      }
      mirror_cells(grid, {1, 1, 1}, row);
    }
    for (const TileStore& store : stores) {
      views.push_back(&store);
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

template <int Dim> io::GridDump::Polygons section_polygons(const Block<Dim>& b, remap::NormalMethod normal) {
  constexpr int up = Dim - 1; // the section's other axis: y or z
  io::GridDump::Polygons out;
  const Fractions<Dim> fractions(b);
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    if (b.owner_row(r)[i] >= 0 || !in_section<Dim>(b.grid, r)) {
      return;
    }
    const auto cell = remap::reconstruct_cell<Dim>(fractions.grid, fractions.views, normal, fractions.grid.cell_row(j, k), i);
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

template io::GridDump::Polygons section_polygons<2>(const Block<2>&, remap::NormalMethod);
template io::GridDump::Polygons section_polygons<3>(const Block<3>&, remap::NormalMethod);

} // namespace ballast
