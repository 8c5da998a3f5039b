#include "remap/dual_flux.hpp"

#include <algorithm>
#include <utility>

namespace ballast::remap {

template <int Dim>
DualFlux<Dim>::DualFlux(const Mesh<Dim>& mesh, const RowField& cell_mass, const std::array<RowField, Dim>& mass_flux, int axis)
    : m_(mesh), cell_mass_(cell_mass), mass_flux_(mass_flux), axis_(axis), links_(mesh.grid.cells[0] + (axis == 0 ? 2 : 1)) {
  for (auto* v : {&flux_, &low_, &high_, &faces_low_, &faces_high_, &mass_rows_[0], &mass_rows_[1], &mass_rows_[2]}) {
    v->assign(static_cast<std::size_t>(links_ + 4), 0.0);
  }
}

template <int Dim> void DualFlux<Dim>::compute(int j, int k, Span links) {
  const Grid& g = m_.grid;
  const int n = g.cells[static_cast<std::size_t>(axis_)];
  double *flux = flux_.data(), *low = low_.data(), *high = high_.data();
  if (axis_ == 0) {
    double *S = masses(1), *T = faces_low_.data();
    const Span faces = {std::max(links.begin - 1, 0), std::min(links.end, n + 1)};
    // Link i joins node i - 1 and node i through cell i - 1.
    sum_columns(j, k, cell_mass_, -1, std::max(links.begin - 1, 1), std::min(links.end + 1, n + 1), S);
    sum_columns(j, k, mass_flux_[0], 0, faces.begin, faces.end, T);
    S[-1] = S[0] = S[1];
    S[n + 2] = S[n + 1] = S[n];
    const double* low0 = m_.low_share[0].data() + g.ghost[0];
#pragma omp simd
    for (int i = std::max(links.begin, 1); i < std::min(links.end, n + 1); ++i) {
      const double w = low0[i - 1], rest = 1 - w;
      low[i] = w;
      high[i] = rest;
      flux[i] = rest * T[i - 1] + w * T[i];
    }
    low[0] = high[0] = low[n + 1] = high[n + 1] = 0; // the boundary faces: no cell, no rise
    flux[0] = T[0];
    flux[n + 1] = T[n];
    set_masses(S - 1, S, S + 1);
    return;
  }
  const int at = axis_ == 1 ? j : k, here = at - 1; // the layer of cells that the links pass through
  const auto layer = [&](int q) { return axis_ == 1 ? std::array<int, 2>{q, k} : std::array<int, 2>{j, q}; };
  const auto masses_of = [&](int q, double* out) {
    const auto [cj, ck] = layer(std::clamp(q, 0, n - 1));
    sum_columns(cj, ck, cell_mass_, 0, links.begin, links.end, out);
  };
  const auto fluxes_of = [&](int q, std::vector<double>& out) {
    const auto [cj, ck] = layer(std::clamp(q, 0, n));
    sum_columns(cj, ck, mass_flux_[static_cast<std::size_t>(axis_)], 0, links.begin, links.end, out.data());
  };
  const bool follows = last_ == (axis_ == 1 ? std::array<int, 2>{j - 1, k} : std::array<int, 2>{j, k - 1});
  if (follows && last_links_.holds(links)) { // the link below: most is known
    std::swap(faces_low_, faces_high_);
    std::swap(mass_rows_[0], mass_rows_[1]);
    std::swap(mass_rows_[1], mass_rows_[2]);
  } else {
    fluxes_of(here, faces_low_);
    masses_of(here - 1, masses(0));
    masses_of(here, masses(1));
  }
  fluxes_of(here + 1, faces_high_);
  masses_of(here + 1, masses(2));
  last_ = {j, k};
  last_links_ = links;
  const bool outside = at == 0 || at == n + 1;
  const double w = outside ? 1.0 : share_of(axis_, here, false), *T_low = faces_low_.data(), *T_high = faces_high_.data();
  std::fill(low + links.begin, low + links.end, outside ? 0.0 : w);
  std::fill(high + links.begin, high + links.end, outside ? 0.0 : 1 - w);
#pragma omp simd
  for (int i = links.begin; i < links.end; ++i) {
    flux[i] = (1 - w) * T_low[i] + w * T_high[i];
  }
  set_masses(masses(0), masses(1), masses(2));
}

template <int Dim>
void DualFlux<Dim>::sum_columns(int j, int k, const RowField& of, int shift, int first, int end, double* out) const {
  const Grid& g = m_.grid;
  std::fill(out + first, out + end, 0.0);
  const int index[3] = {0, j, k};
  for (int side = 0; side < (1 << (Dim - 1)); ++side) {
    int cell[3] = {0, j, k}, bit = 0, column = 0;
    double share = 1;
    bool inside = true;
    for (int axis = 0; axis < Dim; ++axis) {
      if (axis == axis_) {
        continue;
      }
      const bool lower = (side >> bit++ & 1) != 0; // the cell below the node along this axis
      if (axis == 0) {
        column = lower ? -1 : 0;
        continue;
      }
      cell[axis] = index[axis] - (lower ? 1 : 0);
      inside = inside && cell[axis] >= 0 && cell[axis] < g.cells[static_cast<std::size_t>(axis)];
      share *= inside ? share_of(axis, cell[axis], lower) : 0.0;
    }
    if (!inside) {
      continue;
    }
    const double* value = of.row(g.cell_row(cell[1], cell[2])) + shift;
    if (axis_ == 0) {
#pragma omp simd
      for (int i = first; i < end; ++i) {
        out[i] += share * value[i];
      }
      continue;
    }
    const double* low0 = m_.low_share[0].data() + g.ghost[0];
    if (column < 0) {
#pragma omp simd
      for (int i = std::max(first, 1); i < end; ++i) {
        out[i] += share * (1 - low0[i - 1]) * value[i - 1];
      }
    } else {
#pragma omp simd
      for (int i = first; i < std::min(end, g.cells[0]); ++i) {
        out[i] += share * low0[i] * value[i];
      }
    }
  }
}

template <int Dim> double DualFlux<Dim>::share_of(int axis, int cell, bool high) const {
  const double low = m_.low_share[static_cast<std::size_t>(axis)][static_cast<std::size_t>(cell + m_.grid.ghost[static_cast<std::size_t>(axis)])];
  return high ? 1 - low : low;
}

template class DualFlux<2>;
template class DualFlux<3>;

} // namespace ballast::remap
