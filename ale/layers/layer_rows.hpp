// Rows of a stack: what the kernels of fabric layers share.
#pragma once

#include "ale/layers/layer_element.hpp"
#include "ale/layers/layer_stack.hpp"

namespace ballast {

/// Pointers to the nodes of the element row (j, level): components of a field of nodes.
template <int Dim, class Field> auto node_rows(const LayerStack<Dim>& s, Field& field, int j, int level) {
  using Pointer = decltype(field[0].data());
  layer_element::NodeRows<Dim, Pointer> rows;
  const int plane = s.plane_below(level);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int up = static_cast<int>(Dim == 3 ? r / 2 : r), back = static_cast<int>(Dim == 3 ? r % 2 : 0);
    for (std::size_t d = 0; d < Dim; ++d) {
      rows[r][d] = field[d].data() + s.node(0, j + back, plane + up);
    }
  }
  return rows;
}

/// Pointers to all strains, or hourglass modes, of the element row (j, level) in stress_volume or hourglass_volume.
template <std::size_t Kinds, int Dim, class Field> auto element_rows(const LayerStack<Dim>& s, Field& field, int j, int level) {
  std::array<decltype(field.data()), Kinds> rows;
  for (std::size_t k = 0; k < Kinds; ++k) {
    rows[k] = field.data() + s.in_row(k, Kinds, j, level);
  }
  return rows;
}

/// Sizes at rest of the elements of a row.
struct RowSizes {
  int count = 0;
  const double* gradient = nullptr;
  const double* hoop = nullptr;
  const double* span = nullptr;
  double a2 = 0, a3 = 0, depth = 1; ///< depth: thickness, in 3D times the width

  layer_element::Gradients gradients(int i, bool three_d) const { return {gradient[i], three_d ? a2 : hoop[i], a3}; }
  double volume(int i) const { return span[i] * depth; }
};

template <int Dim> RowSizes row_sizes(const LayerStack<Dim>& s, int j, int level) {
  const auto l = static_cast<std::size_t>(level), k = static_cast<std::size_t>(j);
  const double thickness = s.levels[l + 1] - s.levels[l], width = Dim == 3 ? s.lines[1][k + 1] - s.lines[1][k] : 1.0;
  return {s.grid.elements[0], s.at_rest.gradient.data(), s.at_rest.hoop.data(), s.at_rest.span.data(), 2 / width, 2 / thickness, thickness * width};
}

} // namespace ballast
