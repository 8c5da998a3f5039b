// Linear viscoelastic deviator by a Prony series: G(t) = G_inf + sum G_i exp(-t/tau_i).
//
// Each branch: ds/dt + s w - w s = 2 G_i dev(d) - s/tau_i, integrated exactly for a rate d that is constant in the frame
// that turns with the material; the frame turns by the Hughes-Winget rotation, half of it before the branch relaxes and
// half after. Exact for spun states at rest; a step that turns and strains at once is second order.
// Simo & Hughes, Computational Inelasticity (1998), ch. 10; rotation: Hughes & Winget, IJNME 15 (1980) 1862.
#pragma once

#include "materials/visco_row.hpp"

#include <span>

namespace ballast {

struct PronyBranch {
  double shear = 0; ///< G_i, Pa
  double time = 1;  ///< tau_i, s
};

/// State: Kirchhoff deviators of the long-term spring and of each branch, Pa; at rest 0.
struct Prony {
  double long_shear = 0; ///< G_inf, Pa; may be 0
  std::size_t branches = 0;
  std::array<PronyBranch, most_visco_branches> branch{};
};

std::size_t state_count(const Prony& m);
std::vector<std::string> state_names(const Prony& m);
void set_rest(const Prony& m, std::span<double> state);
/// Pa, for the sound speed: of the fastest deformation.
double instant_shear(const Prony& m);

/// One step of a row. Energy is balanced to round-off.
void advance(const Prony& m, const ViscoRow& row);

} // namespace ballast
