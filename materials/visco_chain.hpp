// Isochoric springs of a network: neo-Hookean or eight-chain, by the trace of its unimodular left Cauchy-Green tensor.
//
//   Kirchhoff deviator = modulus(tr b) dev b,  energy' = modulus / 2.
// Eight chains: modulus = mu (beta(lam/lam_L)/lam) / beta(1/lam_L), lam = sqrt(tr b / 3), beta the inverse Langevin
// function, so that mu is the shear modulus at rest. Arruda & Boyce, J. Mech. Phys. Solids 41 (1993) 389; normalised
// as in Bergstroem, Mechanics of Solid Polymers (2015).
#pragma once

#include <limits>

namespace ballast {

struct ChainSpring {
  double shear = 0;                                               ///< mu, Pa
  double lock_stretch = std::numeric_limits<double>::infinity(); ///< lam_L > 1; infinite: neo-Hookean
};

struct SpringModulus {
  double value; ///< Pa; NaN once the chains have locked
  double slope; ///< by tr b, Pa
};

/// beta with coth(beta) - 1/beta = x, 0 <= x < 1, to 1e-14 relative; NaN beyond.
double inverse_langevin(double x);
SpringModulus spring_modulus(const ChainSpring& spring, double trace);
/// J/m3, 0 at trace 3. Of eight chains to 1e-16 mu lam_L^2 (a difference).
double spring_energy(const ChainSpring& spring, double trace);

} // namespace ballast
