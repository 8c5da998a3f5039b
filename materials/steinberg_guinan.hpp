// Steinberg-Guinan strength: shear modulus and flow stress of a metal at high rates, with melting.
//
//   G = G0 [1 + (G'p/G0) p / eta^{1/3} - B (T - 300 K)],  eta = rho/rho0,  zero above the melting point,
//   Y = min(Y0 (1 + beta ep)^n, Ymax) G/G0,
//   Tm = Tm0 exp(2 a (1 - 1/eta)) eta^{2 (gamma0 - a - 1/3)}.
// Steinberg, Cochran, Guinan, J. Appl. Phys. 51 (1980) 1498; constants: Steinberg, UCRL-MA-106439 (1996).
// Rate independent: meant for rates above 1e5 /s. Temperature: along the isentrope from the initial state,
// with x = 1 - 1/eta, T = T0 exp(gamma0 x) + (e - e0 - ec)/cp, ec the isentrope's energy to fourth order
// (that paper's cold-compression series); without cold part in tension (x < 0).
#pragma once

#include "eos/eos.hpp"

namespace ballast {

struct SteinbergGuinan {
  double shear_modulus = 0;      ///< G0, Pa
  double yield = 0;              ///< Y0, Pa
  double yield_max = 0;          ///< of work hardening at G = G0, Pa
  double beta = 0, n = 0;        ///< work hardening
  double shear_per_pressure = 0; ///< G'p = dG/dp, dimensionless
  double thermal_softening = 0;  ///< B, 1/K
  double melt_a = 0;             ///< a of the melting curve
  double melt_temperature = 1e30, reference_temperature = 293; ///< Tm0, T0, K
  double specific_heat = 400;    ///< J/kg/K
  Condensed eos{};               ///< of the material: its isentrope
};

/// The least G/G0 that is kept in cells, so that compliances stay finite; at it there is no stress.
inline constexpr double molten_shear = 1e-6;

/// K. `heat`: e - e0, J/kg.
double temperature(const SteinbergGuinan& m, double density, double heat);
/// K, on the melting curve.
double melting_temperature(const SteinbergGuinan& m, double density);
/// G/G0 at a density (kg/m3), an absolute pressure (Pa) and a heat e - e0 (J/kg); 0 above the melting point.
double shear_ratio(const SteinbergGuinan& m, double density, double pressure, double heat);

} // namespace ballast
