// Bergstroem-Boyce: two networks in parallel, A elastic, B elastic in series with a dashpot of chains that reptate.
//
//   stress = modulus_A(tr b) dev b + s,  s = modulus_B(tr b_e) dev b_e,   b, b_e unimodular,
//   D_v = gdot s/|s|,  gdot = gdot0 (lam_v - 1 + xi)^C (|s|/tau_base)^m,  |s| = sqrt(s:s),
//   db_e/dt = l b_e + b_e l^T - 2 D_v b_e,  lam_v = sqrt(b_e^-1 : b / 3).
// Kirchhoff deviators; J enters the flow nowhere else. lam_v from b and b_e: tr(F_v F_v^T) = tr(F_e^-1 b F_e^-T).
// Bergstroem & Boyce, J. Mech. Phys. Solids 46 (1998) 931; xi: Bergstroem, Mechanics of Solid Polymers (2015), ch. 8.
//
// Fast path: C_v = F^T b_e^-1 F obeys dC_v/dt = 2 lam' (C - tr(b_e)/3 C_v), lam' = gdot/|dev b_e|: linear for frozen
// factors, so an exponential step is a mean of positive definite tensors, made unimodular; b_e stays positive definite
// at any step. Cf. Shutov, Landgraf & Ihlemann, CMAME 265 (2013) 213, who take the implicit Euler step of it.
#pragma once

#include "materials/visco_chain.hpp"
#include "materials/visco_flow.hpp"
#include "materials/visco_row.hpp"

#include <span>

namespace ballast {

struct BergstroemBoyce {
  ChainSpring a, b;       ///< networks A and B
  double rate = 1;        ///< gdot0, 1/s
  double start = 0.05;    ///< xi > 0
  double stretch_power = -0.5; ///< C in [-1, 0]
  double base = 1;        ///< tau_base, Pa
  double exponent = 4;    ///< m >= 1
};

/// State: b of network A, then b_e of network B; at rest the unit tensor. Any mean of positive definite tensors is
/// positive definite: remap both by mass.
std::size_t state_count(const BergstroemBoyce& m);
std::vector<std::string> state_names(const BergstroemBoyce& m);
void set_rest(const BergstroemBoyce& m, std::span<double> state);
double instant_shear(const BergstroemBoyce& m);
/// lam_v of a state; 1 at rest.
double viscous_stretch(const Sym& total, const Sym& elastic);
/// J/m3 of network B, by b_e.
double stored_energy(const BergstroemBoyce& m, const Sym& elastic);

/// A step of one cell: the isochoric path's exponent (visco_motion) and b at its start.
struct BoyceDrive {
  Mat path{};
  Sym total = unit_sym;
  double dt = 0;
  std::array<Sym, 7> square{}; ///< C(s) from the step's start, by powers of s; set by prepare
};

/// The larger relaxation number of the step's ends if nothing relaxed: bounds the share that does.
double elastic_number(const BergstroemBoyce& m, const BoyceDrive& drive, const Sym& y);
/// |dev b_e|, at least a hundredth of tau_base's elastic strain.
double error_scale(const BergstroemBoyce& m, const Sym& y);
// For CVODE: v = C_v from the step's start, v' = 2 n (C(s) - t v), t = tr(v^-1 C)/3, n = dt gdot/|dev b_e|. Elastic
// motion is exact in v, and lam_v^2 = v : b_n / 3. C(s) to the sixth power: 1e-8 for |L dt| = 0.1.
void prepare(BoyceDrive& drive);
Sym to_variables(const BoyceDrive& drive, const Sym& elastic);
/// b_e at s, unimodular.
Sym from_variables(const BoyceDrive& drive, double s, const Sym& v);
void rate(const BergstroemBoyce& m, const BoyceDrive& drive, double s, const Sym& v, Sym& rate, double& heat);
void jacobian(const BergstroemBoyce& m, const BoyceDrive& drive, double s, const Sym& v, BranchJacobian& out);
/// `substeps` exponential steps; the dissipation is a positive quadrature, second order.
FastStep fast_step(const BergstroemBoyce& m, const BoyceDrive& drive, const Sym& y, int substeps);

} // namespace ballast
