#pragma once

#include "tests/exact/flow_state.hpp"

/// Sedov's point blast in a cold uniform ideal gas: energy E released at the origin at t = 0.
///   R = (E t^2 / (alpha rho0))^(1/(j+2)),   dR/dt = delta R / t,   delta = 2 / (j+2),
/// u = delta (r/t) V(xi), rho = rho0 G(xi), xi = r/R, V from 1/gamma (origin) to 2/(gamma+1)
/// (shock). With w = gamma V - 1, D = j+2 - (j(gamma-1)+2) V and "2" the shock:
///   xi       = (w/w2)^a (V/V2)^(-delta) (D/D2)^b
///   G/G2     = (w/w2)^(j/(2 gamma+j-2)) (D/D2)^beta exp(-2 (h - h2))
///   p/p2     = (1-V)/(1-V2) (V/V2)^(j delta) (D/D2)^(2b+beta) exp(-2 (h - h2))
///   h        = log(1 - (gamma-2) q) / (gamma-2),  q = j V / ((j+2)(1-V))      (-q at gamma = 2)
/// which, unlike the usual exponents in 1/(2 - gamma), holds through gamma = 2.
/// Reference: Landau & Lifshitz, Fluid Mechanics, sec. 106 (j = 3), Sedov 1959; exponents for
/// general j by partial fractions of the same equations.
///
/// E is the whole energy (spherical), per unit length (cylindrical), or that on ONE side of the
/// plane per unit area (planar: a full line holds 2E). Units: any consistent set.

namespace ballast::exact {

class Sedov {
public:
  /// Throws std::invalid_argument unless density > 0, energy > 0, gamma > 1, and, spherical, gamma
  /// < 7: from there on a vacuum opens at the origin and this solution does not hold.
  Sedov(Geometry geometry, double gamma, double density, double energy);

  /// alpha in E = alpha rho0 R^(j+2) / t^2, by quadrature of the energy (about 1e-13).
  [[nodiscard]] double energy_constant() const { return alpha_; }
  [[nodiscard]] double shock_radius(double time) const;
  [[nodiscard]] double shock_speed(double time) const;
  /// State just behind the shock.
  [[nodiscard]] FlowState shock_state(double time) const;

  /// State at radius >= 0 and time > 0; outside the shock the cold gas at rest.
  [[nodiscard]] FlowState at(double radius, double time) const;

private:
  /// The similarity solution at w = w2 exp(log_w), log_w <= 0.
  struct Similarity {
    double log_radius_factor; ///< log xi without the power of w
    double V;
    double D;
    double w;
    double log_density; ///< log G/G2
    double pressure;    ///< p/p2
  };
  [[nodiscard]] Similarity similarity(double log_w) const;
  [[nodiscard]] double singular_factor(double V) const;
  [[nodiscard]] double energy_integrand(double x) const;

  int dimension_;
  double gamma_;
  double density_;
  double energy_;
  double delta_;
  double shock_V_;   ///< V2
  double slope_D_;   ///< j(gamma-1) + 2
  double radius_w_;  ///< exponent a
  double radius_D_;  ///< exponent b
  double density_w_; ///< j/(2 gamma+j-2)
  double density_D_; ///< exponent beta
  double alpha_ = 0.0;
};

} // namespace ballast::exact
