// Flow stresses of clay and bone: hardening by a power law or by a table, times the factor of Cowper and Symonds.
//
//   sigma_y = h(ep) [1 + (rate/C)^(1/p)],   rate that of plastic strain (1/s).
// Cowper & Symonds, Brown University, Div. Appl. Math. report 28 (1957). The rate is the step's own, d/dt, so the radial
// return solves for it. An infinite C: no rate dependence. No thermal softening.
#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace ballast {

struct CowperSymonds {
  double constant = std::numeric_limits<double>::infinity(); ///< C, 1/s
  double exponent = 1;                                        ///< p

  bool matters() const { return std::isfinite(constant); }
  double factor(double rate) const { return matters() && rate > 0 ? 1 + std::pow(rate / constant, 1 / exponent) : 1.0; }
};

/// h = K (eps0 + ep)^n. The yield stress is K eps0^n; LS-DYNA's power law (MAT_018) without one sets
/// eps0 = (E/K)^(1/(n - 1)), where the power law meets Hooke's line.
struct PowerLawPlastic {
  double shear_modulus = 0;
  double coefficient = 0;  ///< K, Pa
  double first_strain = 0; ///< eps0
  double exponent = 1;     ///< n
  CowperSymonds rate = {};
};

inline constexpr int most_hardening_points = 8;

/// h linear between the points, and beyond the last as there.
struct TabulatedHardening {
  double shear_modulus = 0;
  int points = 0;
  std::array<double, most_hardening_points> strain = {}; ///< plastic; the first is 0, they rise
  std::array<double, most_hardening_points> stress = {}; ///< Pa; not falling
  CowperSymonds rate = {};
};

double hardened(const PowerLawPlastic& m, double plastic_strain);
double hardened(const TabulatedHardening& m, double plastic_strain);

} // namespace ballast
