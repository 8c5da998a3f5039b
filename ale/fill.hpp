// Putting materials into a block's cells: the one way an initial state comes about.
#pragma once

#include "ale/block.hpp"

#include <span>

namespace ballast {

/// A material as a slot of a block whose forces use p - reference_pressure. The gauge pressure is bitwise
/// zero at (density, specific_energy) when the EOS gives the reference pressure there to 1e-9.
MaterialSlot make_slot(const Material& material, double reference_pressure);
MaterialSlot make_void();

/// What a cell holds of one material; a void part has no density.
struct CellPart {
  int material = 0;
  double fraction = 0, density = 0, specific_energy = 0;
};

/// Fills cell (i, j, k); the parts' fractions must add up to one. Allocates the tile.
template <int Dim> void fill_cell(Block<Dim>& block, int i, int j, int k, std::span<const CellPart> parts);

/// Calls body(i, j, k) for every cell in order.
template <int Dim, class Body> void for_each_cell(const Block<Dim>& block, Body&& body) {
  const Grid& g = block.grid;
  for (int k = 0; k < g.cells[2]; ++k) {
    for (int j = 0; j < g.cells[1]; ++j) {
      for (int i = 0; i < g.cells[0]; ++i) {
        body(i, j, k);
      }
    }
  }
}

/// Velocity (m/s) of every node from a function of its position: v(x, out) with arrays of Dim doubles.
template <int Dim, class Velocity> void set_velocity(Block<Dim>& block, Velocity&& v) {
  const Grid& g = block.grid;
  for (int k = 0; k < (Dim == 3 ? g.cells[2] + 1 : 1); ++k) {
    for (int j = 0; j <= g.cells[1]; ++j) {
      const int r = g.node_row(j, k);
      for (int i = 0; i <= g.cells[0]; ++i) {
        std::array<double, Dim> x{}, u{};
        for (std::size_t d = 0; d < Dim; ++d) {
          x[d] = block.position[d].row(r)[i];
        }
        v(x, u);
        for (std::size_t d = 0; d < Dim; ++d) {
          block.velocity[d].row(r)[i] = u[d];
        }
      }
    }
  }
}

} // namespace ballast
