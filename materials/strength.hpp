// Strength models: flow stress of an isotropic metal or tissue, and the plastic increment that
// brings a trial deviator back to it (radial return, von Mises); or a viscoelastic deviator.
//
// Flow stress sigma_y(ep, rate, T) in Pa; G shear modulus Pa. With the trial equivalent stress q, the
// increment d solves q - 3 G d = sigma_y(ep + d, d/dt, T) on [0, q/3G].
#pragma once

#include "materials/rate_hardening.hpp"
#include "materials/steinberg_guinan.hpp"
#include "materials/visco_law.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <variant>

namespace ballast {

/// A fluid: no deviatoric stress, no arrays.
struct NoStrength {};

/// sigma_y = Y + H ep; H = 0 is perfect plasticity, an infinite Y is elastic.
struct LinearHardening {
  double shear_modulus = 0;
  double yield = std::numeric_limits<double>::infinity();
  double hardening = 0;
};

/// sigma_y = (A + B ep^n)(1 + C ln(max(rate/eps0, 1)))(1 - T*^m), T* = (T - T0)/(Tm - T0) in [0, 1].
/// Johnson & Cook 1983. T0 is the fit's, the temperature T = start + (e - e0)/cp.
struct JohnsonCook {
  double shear_modulus = 0;
  double A = 0, B = 0, n = 1, C = 0, m = 1;
  double reference_rate = 1;      ///< 1/s
  double reference_temperature = 293, melt_temperature = 1e30; ///< K
  double specific_heat = 400;     ///< J/kg/K
  double start_temperature = 293; ///< of the scene, K
};

/// A deviator with memory (materials/visco_law) instead of a flow stress.
struct Viscoelastic {
  TissueLaw law;
};

using Strength = std::variant<NoStrength, LinearHardening, JohnsonCook, SteinbergGuinan, PowerLawPlastic, TabulatedHardening, Viscoelastic>;

struct PlasticIncrement {
  double value = 0;
  bool converged = true;
  int iterations = 0;
};

/// State the flow stress may depend on.
struct FlowState {
  double plastic_strain = 0;
  double thermal_energy = 0; ///< e - e0, J/kg
  double dt = 0;             ///< s
  double stiffening = 1;     ///< G/G0 (Steinberg-Guinan)
};

/// Pa; of Steinberg-Guinan G0; of viscoelastic the instantaneous one at rest.
double shear_modulus(const Strength& strength);
/// Does the shear modulus depend on the state?
bool has_variable_shear(const Strength& strength);
bool has_strength(const Strength& strength);
/// The law, if it is viscoelastic, or null.
const TissueLaw* tissue_law(const Strength& strength);
std::string describe(const Strength& strength);

/// Does the flow stress depend on the rate of the step?
inline bool has_rate(const LinearHardening&) { return false; }
inline bool has_rate(const JohnsonCook&) { return true; }
inline bool has_rate(const SteinbergGuinan&) { return false; }
inline bool has_rate(const PowerLawPlastic& m) { return m.rate.matters(); }
inline bool has_rate(const TabulatedHardening& m) { return m.rate.matters(); }

double flow_stress(const LinearHardening& m, const FlowState& s, double increment);
double flow_stress(const JohnsonCook& m, const FlowState& s, double increment);
double flow_stress(const SteinbergGuinan& m, const FlowState& s, double increment);
double flow_stress(const PowerLawPlastic& m, const FlowState& s, double increment);
double flow_stress(const TabulatedHardening& m, const FlowState& s, double increment);
[[nodiscard]] PlasticIncrement
plastic_increment(const LinearHardening& m, const FlowState& s, double trial);
[[nodiscard]] PlasticIncrement
plastic_increment(const JohnsonCook& m, const FlowState& s, double trial);
[[nodiscard]] PlasticIncrement
plastic_increment(const SteinbergGuinan& m, const FlowState& s, double trial);
[[nodiscard]] PlasticIncrement
plastic_increment(const PowerLawPlastic& m, const FlowState& s, double trial);
[[nodiscard]] PlasticIncrement
plastic_increment(const TabulatedHardening& m, const FlowState& s, double trial);

} // namespace ballast
