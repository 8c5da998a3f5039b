// A row of material points of one viscoelastic material, and one branch that relaxes over a step.
//
// Stresses are Kirchhoff deviators (J times Cauchy's, J = rho0/rho), energies J per m3 of initial volume: divided by
// rho0 they are J/kg, and a mass-weighted mean is the right one in a remap. State: plain rows, declared by each law.
#pragma once

#include "materials/visco_motion.hpp"
#include "materials/visco_relaxation.hpp"

#include <string>
#include <vector>

namespace ballast {

inline constexpr std::size_t most_visco_branches = 6;
inline constexpr std::size_t most_visco_state = 6 * (most_visco_branches + 2);

/// Rows of `cells` values; every pointer set, state up to the law's count.
struct ViscoRow {
  int cells = 0;
  double dt = 0;                                  ///< s
  std::array<const double*, 9> gradient{};        ///< dv_i/dx_j at mid-step, 1/s, row by row
  const double* volume_ratio = nullptr;           ///< J = rho0/rho at the end of the step
  std::array<double*, most_visco_state> state{};  ///< in and out
  std::array<double*, 6> stress{};                ///< out: Cauchy deviator, Pa
  double* stored = nullptr;                       ///< out: free energy at the end of the step, J/m3 of initial volume
  double* dissipated = nullptr;                   ///< out: in this step, J/m3, never negative
  double* work = nullptr;                         ///< out: of the deviator in this step, J/m3
  double* floored = nullptr;                      ///< out, may be null: what heat was raised by to be 0 (Fung), part of the work, J/m3
};

/// Names of six components, for example "prony_1_xx".
void append_tensor_names(std::vector<std::string>& names, const std::string& stem);

inline Mat gradient_dt(const ViscoRow& row, std::size_t i) {
  Mat g;
  for (std::size_t a = 0; a < 9; ++a) {
    g[a] = row.gradient[a][i] * row.dt;
  }
  return g;
}
inline Sym load_sym(const ViscoRow& row, std::size_t first, std::size_t i) {
  Sym s;
  for (std::size_t a = 0; a < 6; ++a) {
    s[a] = row.state[first + a][i];
  }
  return s;
}
inline void store_sym(const ViscoRow& row, std::size_t first, std::size_t i, const Sym& s) {
  for (std::size_t a = 0; a < 6; ++a) {
    row.state[first + a][i] = s[a];
  }
}
/// Sets the outputs of cell i; kirchhoff: deviator, Pa.
inline void store_result(const ViscoRow& row, std::size_t i, const Sym& kirchhoff, double stored, double dissipated, double work) {
  for (std::size_t a = 0; a < 6; ++a) {
    row.stress[a][i] = kirchhoff[a] / row.volume_ratio[i];
  }
  row.stored[i] = stored;
  row.dissipated[i] = dissipated;
  row.work[i] = work;
}

/// The first cell whose stress or energies are no number; -1: all are.
inline int first_without_number(const ViscoRow& row) {
  for (int i = 0; i < row.cells; ++i) {
    double sum = row.stored[i] + row.dissipated[i] + row.work[i];
    for (const double* s : row.stress) {
      sum += s[i];
    }
    if (!std::isfinite(sum)) {
      return i;
    }
  }
  return -1;
}

/// A branch at the end of a step.
struct Relaxed {
  Sym stress;        ///< Pa
  double dissipated; ///< J/m3
  double work;       ///< J/m3
};

/// s' = 2 G d - s/tau with constant d, exactly. pull = 2 G d dt, x = dt/tau. Free energy s:s/(4G); work s:d and
/// dissipation s:s/(2 G tau) integrated in closed form: their difference is the change of free energy to round-off.
inline Relaxed relax_branch(const Sym& s, const Sym& pull, double shear, double x, const Relaxation& r) {
  const Sym slope = combine(1, pull, -x, s); // dt s' at the start
  const double square = contract(s, s) + 2 * r.first * contract(s, slope) + r.second * contract(slope, slope);
  return {combine(r.decay, s, r.share, pull),
          x * square / (2 * shear),
          (contract(s, pull) + r.first * contract(slope, pull)) / (2 * shear)};
}

} // namespace ballast
