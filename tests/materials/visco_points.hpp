// Material points for the laws of viscoelasticity: rows with their own storage, driven by deformation gradients.
#pragma once

#include "materials/visco_integrator.hpp"

#include <gtest/gtest.h>

namespace ballast {

inline Mat inverse_of(const Mat& a) {
  const double d = 1 / determinant(a);
  return {d * (a[4] * a[8] - a[5] * a[7]), d * (a[2] * a[7] - a[1] * a[8]), d * (a[1] * a[5] - a[2] * a[4]),
          d * (a[5] * a[6] - a[3] * a[8]), d * (a[0] * a[8] - a[2] * a[6]), d * (a[2] * a[3] - a[0] * a[5]),
          d * (a[3] * a[7] - a[4] * a[6]), d * (a[1] * a[6] - a[0] * a[7]), d * (a[0] * a[4] - a[1] * a[3])};
}

/// L dt at mid-step of the step from F to G: 2 (f - 1)(f + 1)^-1, f = G F^-1.
inline Mat midpoint_gradient(const Mat& from, const Mat& to) {
  Mat f = product(to, inverse_of(from)), less = f;
  for (std::size_t a = 0; a < 9; ++a) {
    less[a] = 2 * (f[a] - unit_mat[a]);
    f[a] += unit_mat[a];
  }
  return product(less, inverse_of(f));
}

inline Mat turned(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}
inline Mat stretched(double lam) { return {lam, 0, 0, 0, 1 / std::sqrt(lam), 0, 0, 0, 1 / std::sqrt(lam)}; }
inline Mat sheared(double k) { return {1, k, 0, 0, 1, 0, 0, 0, 1}; }

/// A row of `cells` points at rest; all rows are members.
struct Points {
  std::vector<std::vector<double>> gradient, state, stress;
  std::vector<double> ratio, stored, dissipated, work;
  ViscoRow row;

  template <class Law> Points(const Law& m, std::size_t cells)
      : gradient(9, std::vector<double>(cells)), state(state_count(m), std::vector<double>(cells)),
        stress(6, std::vector<double>(cells)), ratio(cells, 1.0), stored(cells), dissipated(cells), work(cells) {
    std::vector<double> rest(state_count(m));
    set_rest(m, rest);
    row.cells = static_cast<int>(cells);
    row.volume_ratio = ratio.data();
    row.stored = stored.data();
    row.dissipated = dissipated.data();
    row.work = work.data();
    for (std::size_t a = 0; a < 9; ++a) {
      row.gradient[a] = gradient[a].data();
    }
    for (std::size_t a = 0; a < state.size(); ++a) {
      state[a].assign(cells, rest[a]);
      row.state[a] = state[a].data();
    }
    for (std::size_t a = 0; a < 6; ++a) {
      row.stress[a] = stress[a].data();
    }
  }
  Points(const Points&) = delete;
  Points& operator=(const Points&) = delete;

  /// Motion of one cell in the next step.
  void move(std::size_t cell, const Mat& gradient_times_dt, double dt) {
    row.dt = dt;
    for (std::size_t a = 0; a < 9; ++a) {
      gradient[a][cell] = gradient_times_dt[a] / dt;
    }
  }
  [[nodiscard]] Sym stress_of(std::size_t cell) const {
    return {stress[0][cell], stress[1][cell], stress[2][cell], stress[3][cell], stress[4][cell], stress[5][cell]};
  }
  [[nodiscard]] Sym state_of(std::size_t first, std::size_t cell) const { return load_sym(row, first, cell); }
};

inline TissueOptions by_path(BranchPath path, int substeps = 8, double tolerance = 1e-3) {
  TissueOptions o;
  o.path = path;
  o.substeps = substeps;
  o.tolerance = tolerance;
  o.cvode.tolerance = 1e-6;
  return o;
}

inline double difference(const Sym& a, const Sym& b) { return norm(combine(1, a, -1, b)); }

/// tissueNH and elastomer8 of tests/data/bb_*.
inline BergstroemBoyce tissue_boyce() { return {{20000}, {100000}, 1, 0.05, -0.5, 20000, 4}; }
inline BergstroemBoyce elastomer_boyce() { return {{600000, std::sqrt(8.0)}, {960000, std::sqrt(8.0)}, 1, 0.05, -1, 270000, 4}; }
/// Gelatin-like, stiff above 0.1 MPa (docs/viscoelasticity.md).
inline PowerLawZener gelatin_power_law() { return {5000, 1, {{{1e6, 1e-4, 1e5, 4}}}}; }

} // namespace ballast
