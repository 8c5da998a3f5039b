// Injury criteria: formulas, thresholds, where they are from and how sure they are. Pure functions; SI unless said otherwise.
//
// One table, injury_criteria(), feeds summary.json, the printed lines and docs/injury.md. Confidence marks are those of
// docs/materials.md: S, R, R-2nd, D, K1, K2, K3. Research output, not medical advice: none of these is a diagnosis, and all were
// fitted to other loads (clay, blunt projectiles, car crashes) than a bullet behind an arbitrary vest.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace ballast {

enum class InjuryMeasure {
  sternum_deflection,
  sternum_velocity,
  chest_compression,
  viscous_criterion,
  viscous_criterion_crash,
  back_face_signature,
  blunt_criterion,
  four_parameter,
  impact_force,
  energy_density,
  chest_wall_velocity,
  blast_injury_index,
  peak_acceleration,
  peak_pressure
};

struct InjuryThreshold {
  double value;        ///< in the criterion's unit
  const char* meaning;
  const char* mark;    ///< confidence
};

struct InjuryCriterion {
  InjuryMeasure measure;
  const char* key;     ///< in summary.json
  const char* name;
  const char* formula;
  const char* unit;    ///< of value and thresholds; "1": none
  std::vector<InjuryThreshold> thresholds; ///< empty: none is accepted, or none is known
  const char* source;
  const char* mark;    ///< confidence of the formula
  const char* limits;  ///< what it does not say
};

/// All, in the order of InjuryMeasure.
const std::vector<InjuryCriterion>& injury_criteria();
const InjuryCriterion& criterion(InjuryMeasure measure);

/// What stands beside every result.
inline constexpr const char* injury_note =
    "Research output of a numerical model, not medical advice. The thresholds were fitted to other loads and bodies than this scene's; "
    "no value here says what would happen to a person.";

/// The criteria as a table of docs/injury.md.
std::string injury_reference();

struct Peak {
  double value = 0, time = 0; ///< s
};
/// Largest of samples `interval` apart, the first at `start`; its value is 0 without samples.
Peak largest_of(std::span<const double> samples, double interval, double start = 0);

/// C = D / D0 of a deflection and the depth of the chest, m.
double chest_compression(double deflection, double chest_depth);
/// V(t) D(t) / D0, m/s, at every sample; zero where either is outwards: a chest that springs back is not squeezed. Viano and Lau, SAE 861882.
std::vector<double> viscous_response(std::span<const double> velocity, std::span<const double> deflection, double chest_depth);
/// Crash practice for the Hybrid III dummy: 1.3 V(t) D(t) / 0.229 m, likewise. SAE J1727.
std::vector<double> crash_viscous_response(std::span<const double> velocity, std::span<const double> deflection);

/// What hits a body.
struct BluntImpact {
  double energy = 0;         ///< J
  double diameter = 0;       ///< of what touches the body, m
  double body_mass = 0;      ///< kg
  double wall_thickness = 0; ///< of the body wall, m
};
/// Thickness of a man's body wall, m: 0.711 W^(1/3) cm (women 0.593). Sturdivan, Viano and Champion 2004.
double body_wall_thickness(double body_mass);
/// BC = ln(E / (W^(1/3) T D)), E in J, W in kg, T and D in cm. Sturdivan, Viano and Champion 2004.
double blunt_criterion(const BluntImpact& impact);
/// P = 1 / (1 + exp(34.13 - 3.597 ln(M V^2 / (W^(1/3) T D)))), M in g, V in m/s, W in kg, T and D in cm. Clare et al. 1975.
double four_parameter_lethality(const BluntImpact& impact);
struct ChestWallResponse {
  Peak peak;        ///< inward velocity, m/s
  bool cut = false; ///< the lung was squeezed to a tenth and the rest of the load left out: the velocity is at least this
};
/// Largest inward velocity of the chest wall, m/s, under a pressure over the ambient one (Pa) at equal intervals (s); time from the
/// first sample. Axelsson and Yelverton 1996, a man of 70 kg, one lung, wall and gas as springs around it:
///   M x'' + J x' + K x = A (p(t) + P0 - P0 (V0 / (V0 - A x))^g).
ChestWallResponse chest_wall_response(std::span<const double> overpressure, double interval);
/// ASII = (0.124 + 0.117 V)^2.63 of the mean of those velocities at the gauges, m/s. The same source.
double adjusted_severity(double chest_wall_velocity);
/// Energy over the area of a circle, J/cm2.
double energy_density(double energy, double diameter);

} // namespace ballast
