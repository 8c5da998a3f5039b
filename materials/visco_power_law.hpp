// Power-law viscoelastic deviator (nonlinear Zener): a long-term spring, and branches whose dashpots thin with stress.
//
//   ds/dt + s w - w s = 2 G1 dev(d) - (s/tau0) (|s|/s0)^(m-1),  |s| = sqrt(s:s),  Kirchhoff deviators.
// Relaxation time tau0 (s0/|s|)^(m-1): stiff wherever |s| >> s0. m = 1 is a Prony branch. The frame turns as in
// visco_prony. Norton dashpot in a Maxwell branch; Lemaitre & Chaboche, Mechanics of Solid Materials (1990), ch. 6.
#pragma once

#include "materials/visco_flow.hpp"
#include "materials/visco_row.hpp"

#include <span>

namespace ballast {

struct PowerLawBranch {
  double shear = 0;     ///< G1, Pa
  double time = 1;      ///< tau0 at |s| = s0, s
  double reference = 1; ///< s0, Pa
  double exponent = 1;  ///< m >= 1
};

/// State: Kirchhoff deviators of the long-term spring and of each branch, Pa; at rest 0.
struct PowerLawZener {
  double long_shear = 0; ///< Pa; may be 0
  std::size_t branches = 0;
  std::array<PowerLawBranch, most_visco_branches> branch{};
};

std::size_t state_count(const PowerLawZener& m);
std::vector<std::string> state_names(const PowerLawZener& m);
void set_rest(const PowerLawZener& m, std::span<double> state);
double instant_shear(const PowerLawZener& m);

/// A step of one cell in the frame turned by half of it: pull = 2 G1 dev(d) dt, Pa.
struct PowerLawDrive {
  Sym pull{};
  double dt = 0;
};

/// dt / relaxation time at a stress whose square s:s is given.
inline double relaxation_number(const PowerLawBranch& m, double dt, double square) {
  return dt / m.time * std::pow(square / (m.reference * m.reference), 0.5 * (m.exponent - 1));
}
/// What an error of y is measured by: |s|, at least s0/100.
double error_scale(const PowerLawBranch& m, const Sym& y);
// For CVODE: variables, their rates and the dissipation's over the unit step. Here v = y.
inline void prepare(PowerLawDrive&) {}
inline Sym to_variables(const PowerLawDrive&, const Sym& y) { return y; }
inline Sym from_variables(const PowerLawDrive&, double, const Sym& v) { return v; }
void rate(const PowerLawBranch& m, const PowerLawDrive& drive, double s, const Sym& v, Sym& rate, double& heat);
void jacobian(const PowerLawBranch& m, const PowerLawDrive& drive, double s, const Sym& v, BranchJacobian& out);
/// Largest relaxation number along the step if nothing relaxed: bounds the share that does.
double elastic_number(const PowerLawBranch& m, const PowerLawDrive& drive, const Sym& y);
/// J/m3.
double stored_energy(const PowerLawBranch& m, const Sym& y);
/// `substeps` exponential steps. Work less dissipation is the change of free energy to round-off.
FastStep fast_step(const PowerLawBranch& m, const PowerLawDrive& drive, const Sym& y, int substeps);

} // namespace ballast
