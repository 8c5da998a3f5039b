// Equations of state: pressure and sound speed from density and specific energy.
//
// Pressure is compression-positive, absolute (Pa); specific energy J/kg; density kg/m3. Every model
// gives pressure(rho, e), sound_speed_squared(rho, e) = dp/drho|e + p/rho^2 dp/de, and energy(rho, p).
// Energies are per kilogram and carry no offset between materials.
#pragma once

#include "eos/bubbly.hpp"
#include "eos/cubic_gruneisen.hpp"
#include "eos/jwl.hpp"
#include "eos/linear_bulk.hpp"
#include "eos/p_alpha.hpp"

#include <string>
#include <variant>

namespace ballast {

/// p = (gamma - 1) rho e.
struct IdealGas {
  double gamma = 1.4;

  [[gnu::always_inline]] double pressure(double rho, double e) const { return (gamma - 1) * rho * e; }
  [[gnu::always_inline]] double sound_speed_squared(double rho, double e) const {
    return gamma * pressure(rho, e) / rho;
  }
  double energy(double rho, double p) const { return p / ((gamma - 1) * rho); }
};

/// p = (gamma - 1) rho e - gamma p_infinity.
struct StiffenedGas {
  double gamma = 4.4;
  double p_infinity = 6e8; ///< Pa

  [[gnu::always_inline]] double pressure(double rho, double e) const {
    return (gamma - 1) * rho * e - gamma * p_infinity;
  }
  [[gnu::always_inline]] double sound_speed_squared(double rho, double e) const {
    return gamma * (pressure(rho, e) + p_infinity) / rho;
  }
  double energy(double rho, double p) const {
    return (p + gamma * p_infinity) / ((gamma - 1) * rho);
  }
};

/// Mie-Grueneisen on a linear Us-up Hugoniot (Us = c0 + s up).
///
/// Compression, eta = 1 - rho0/rho: p = pH + Gamma rho (e - eH), pH = rho0 c0^2 eta/(1 - s eta)^2,
/// eH = pH eta/(2 rho0). Tension (rho < rho0): pH = rho0 c0^2 (rho/rho0 - 1), eH = 0; pressure and
/// sound speed are continuous at rho0 for e = 0. Gamma rho is constant (default) or Gamma is; below rho0 Gamma is either
/// way: hot matter that has expanded would else press as hard at any density.
/// Known flaw: pH is singular at eta = 1/s; the step stops there with sound speed squared < 0 or huge.
struct MieGruneisen {
  double rho0 = 1000;   ///< kg/m3
  double c0 = 1500;     ///< m/s
  double s = 1.5;       ///< dimensionless
  double gamma0 = 1;    ///< Grueneisen parameter at rho0
  bool gamma_constant = false;

  [[gnu::always_inline]] double gamma_rho(double rho) const {
    // Weights, not a choice by the flag: g++ 12 does not vectorise that.
    const double moving = gamma_constant ? 1.0 : 0.0;
    const double held = rho < rho0 ? rho : rho0;
    return gamma0 * (moving * rho + (1 - moving) * held);
  }
  [[gnu::always_inline]] double pressure(double rho, double e) const {
    const Curve h = curve(rho);
    return h.p + gamma_rho(rho) * (e - h.e);
  }
  [[gnu::always_inline]] double sound_speed_squared(double rho, double e) const {
    const Curve h = curve(rho);
    const double g = gamma_rho(rho);
    const double p = h.p + g * (e - h.e);
    const double moving = gamma_constant ? 1.0 : 0.0, below = rho < rho0 ? 1.0 : moving;
    const double dgamma_rho = gamma0 * below;
    return h.dp - g * h.de + dgamma_rho * (e - h.e) + p / (rho * rho) * g;
  }
  double energy(double rho, double p) const {
    const Curve h = curve(rho);
    return h.e + (p - h.p) / gamma_rho(rho);
  }

private:
  struct Curve {
    double p, e, dp, de; // reference curve and its derivatives by density
  };
  [[gnu::always_inline]] Curve curve(double rho) const {
    const double eta = 1 - rho0 / rho;
    const double d = 1 / (1 - s * eta);
    const double k0 = rho0 * c0 * c0;
    const double eta_rho = rho0 / (rho * rho);
    const double ph = k0 * eta * d * d;
    const double dph = k0 * (1 + s * eta) * d * d * d;
    const bool tension = eta < 0;
    const double p_pull = k0 * (rho / rho0 - 1), e_push = 0.5 * ph * eta / rho0;
    const double dp_push = dph * eta_rho, de_push = 0.5 * (dph * eta + ph) / rho0 * eta_rho;
    // Plain selections of values, so that rows vectorise.
    const double p = tension ? p_pull : ph, e = tension ? 0.0 : e_push;
    const double dp = tension ? c0 * c0 : dp_push, de = tension ? 0.0 : de_push;
    return {p, e, dp, de};
  }
};

using Eos = std::variant<IdealGas, StiffenedGas, MieGruneisen, CubicGruneisen, Jwl, LinearBulk, Bubbly, PAlpha>;

double pressure(const Eos& eos, double rho, double e);
double sound_speed_squared(const Eos& eos, double rho, double e);
double energy(const Eos& eos, double rho, double p);
std::string describe(const Eos& eos);

/// Is pressure a function of density (and history) alone, so that energy() cannot bring a material to a pressure?
bool barotropic(const Eos& eos);

/// What the condensed models share: reference density (kg/m3), sound speed there (m/s), Grueneisen parameter and the
/// first two Us-up coefficients. rho0 = 0: none (gases, detonation products).
struct Condensed {
  double rho0 = 0, c0 = 0, gamma0 = 0, s1 = 0, s2 = 0;
};
Condensed condensed(const Eos& eos);

/// One row: pressure p - p_reference (Pa) and bulk modulus rho c^2 (Pa) of `count` cells.
/// The difference is taken against pressure(rho_ref, e_ref) by the same operations, so a cell at the
/// reference state (within a few ulp, `snap`) gets exactly `offset`.
struct GaugeReference {
  double rho = 0;          ///< kg/m3
  double e = 0;            ///< J/kg
  double p = 0;            ///< pressure(rho, e), Pa
  double offset = 0;       ///< p - scene reference pressure, exactly zero when they agree
};
void evaluate_row(const Eos& eos,
                  const GaugeReference& ref,
                  int count,
                  const double* rho,
                  const double* e,
                  double* gauge_pressure,
                  double* modulus);

/// A row of foam with its compaction so far, which grows to that of its densities.
void evaluate_foam(const PAlpha& eos,
                   const GaugeReference& ref,
                   int count,
                   const double* rho,
                   double* compaction,
                   double* gauge_pressure,
                   double* modulus);

} // namespace ballast
