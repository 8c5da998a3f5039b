#include "remap/reconstruct.hpp"

#include <algorithm>

namespace ballast::remap {

template <int Dim>
Reconstruction<Dim> reconstruct_cell(const Grid& grid, std::span<const TileStore* const> stores, NormalMethod method, int r, int i) {
  constexpr int size = stencil_size<Dim>;
  Reconstruction<Dim> out;
  for (int k = 0; k < static_cast<int>(stores.size()) && out.count < most_materials; ++k) {
    const TileStore& s = *stores[static_cast<std::size_t>(k)];
    if (s.has_row(r) && s.row(0, r)[i] > 0) {
      out.present[out.count++] = k;
    }
  }
  // Interface q holds everything before present[q + 1]: materials absent here but in a neighbour count
  // with the earlier one, so that a layer's two sides see one plane.
  double cumulated[most_materials * size];
  for (int q = 0; q + 1 < out.count; ++q) {
    double* sum = cumulated + q * size;
    std::fill(sum, sum + size, 0.0);
    for (int k = 0; k < out.present[q + 1]; ++k) {
      int at = 0;
      for (int dk = Dim == 3 ? -1 : 0; dk <= (Dim == 3 ? 1 : 0); ++dk) {
        for (int dj = -1; dj <= 1; ++dj) {
          const double* f = stores[static_cast<std::size_t>(k)]->row(0, r + dj + dk * grid.cell_rows_per_plane()) + i;
          for (int di = -1; di <= 1; ++di) {
            sum[at++] += f[di];
          }
        }
      }
    }
  }
  onion_interfaces<Dim>(method, cumulated, out.count - 1, out.planes);
  return out;
}

template Reconstruction<2> reconstruct_cell<2>(const Grid&, std::span<const TileStore* const>, NormalMethod, int, int);
template Reconstruction<3> reconstruct_cell<3>(const Grid&, std::span<const TileStore* const>, NormalMethod, int, int);

} // namespace ballast::remap
