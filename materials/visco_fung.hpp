// Quasi-linear viscoelastic deviator (Fung): a nonlinear elastic stress, convolved with a reduced relaxation function.
//
//   s(t) = int g(t - t') ds_e/dt' dt',   g(t) = 1 - sum g_i (1 - exp(-t/tau_i)),
//   s_e = 2 G0 exp(a e:e) e,   e: deviatoric strain, accumulated in the frame that turns with the material.
// By branches: s = s_e - sum g_i q_i, dq_i/dt = (s_e - q_i)/tau_i; each is integrated exactly for an s_e that is linear in
// the step. s_e is the slope of W = (G0/a)(exp(a e:e) - 1), convex. A branch's free energy is the Bregman distance
// g_i [W(e) - W(e_i) - q_i:(e - e_i)] of e from the strain e_i at which s_e would be q_i: then stress is its slope, and
// dissipation g_i (e - e_i):(s_e - q_i)/tau_i is never negative.
// Fung, Biomechanics: Mechanical Properties of Living Tissues (1993), ch. 7. The strain is the logarithmic one where axes
// do not turn in the material; under large shear it is a co-rotated sum (as in visco_prony).
#pragma once

#include "materials/visco_row.hpp"

#include <span>

namespace ballast {

struct FungBranch {
  double share = 0; ///< g_i; their sum is at most 1
  double time = 1;  ///< tau_i, s
};

/// State: strain e, then q_i of each branch, Pa; at rest 0.
struct FungQlv {
  double shear = 0;     ///< G0, instantaneous, at rest, Pa
  double stiffening = 0; ///< a >= 0; 0 is linear
  std::size_t branches = 0;
  std::array<FungBranch, most_visco_branches> branch{};
};

std::size_t state_count(const FungQlv& m);
std::vector<std::string> state_names(const FungQlv& m);
void set_rest(const FungQlv& m, std::span<double> state);
/// Pa, at rest.
double instant_shear(const FungQlv& m);

Sym elastic_stress(const FungQlv& m, const Sym& strain);
double elastic_energy(const FungQlv& m, const Sym& strain);
/// The strain whose elastic stress is given, to 1e-14 relative.
Sym strain_of(const FungQlv& m, const Sym& stress);

/// One step of a row. Work, free energy and dissipation balance to round-off, unless dissipation would come out below
/// zero (by the curvature of s_e within the step, a |de|^2 of the branch's energy): then it is 0, the work takes
/// what is missing, and row.floored says how much.
void advance(const FungQlv& m, const ViscoRow& row);

} // namespace ballast
