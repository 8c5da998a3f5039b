#include "problems/injury_criteria.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast {
namespace {

constexpr double cm = 1e-2, grams_of_kilogram = 1e3;
constexpr double crash_scale = 1.3, crash_depth = 0.229; // Hybrid III 50th percentile, m

/// W^(1/3) T D, kg^(1/3) cm2.
double resistance(const BluntImpact& i) {
  return std::cbrt(i.body_mass) * (i.wall_thickness / cm) * (i.diameter / cm);
}

/// Axelsson and Yelverton's chest wall, SI.
struct ChestWall {
  static constexpr double mass = 2.03, damping = 696, stiffness = 989, area = 0.082, gas = 1.82e-3, exponent = 1.2, ambient = 101325;
  double x = 0, v = 0;

  static double acceleration(double x, double v, double p) {
    const double squeezed = std::pow(gas / std::max(gas - area * x, 0.01 * gas), exponent); // a trial may go too far
    return (area * (p + ambient - ambient * squeezed) - damping * v - stiffness * x) / mass;
  }
  /// Runge and Kutta's four stages under a pressure that goes from p0 to p1.
  void step(double h, double p0, double p1) {
    const double pm = 0.5 * (p0 + p1);
    const double a1 = acceleration(x, v, p0), v2 = v + 0.5 * h * a1, a2 = acceleration(x + 0.5 * h * v, v2, pm);
    const double v3 = v + 0.5 * h * a2, a3 = acceleration(x + 0.5 * h * v2, v3, pm);
    const double v4 = v + h * a3, a4 = acceleration(x + h * v3, v4, p1);
    x += h * (v + 2 * v2 + 2 * v3 + v4) / 6;
    v += h * (a1 + 2 * a2 + 2 * a3 + a4) / 6;
  }
  /// Lung all but gone: the law ends here.
  bool spent() const { return area * x > 0.9 * gas; }
};

std::string thresholds_text(const InjuryCriterion& c) {
  std::string text;
  for (const InjuryThreshold& t : c.thresholds) {
    text += fmt::format("{}{:g}{}{}: {} [{}]", text.empty() ? "" : "; ", t.value, *c.unit == '1' ? "" : " ", *c.unit == '1' ? "" : c.unit, t.meaning, t.mark);
  }
  return text.empty() ? "none" : text;
}

} // namespace

const std::vector<InjuryCriterion>& injury_criteria() {
  using enum InjuryMeasure;
  static const std::vector<InjuryCriterion> all = {
      {sternum_deflection, "sternum_deflection", "sternum deflection", "D(t): the sternum's way along the shot, less the spine's where one is named", "m",
       {{0.063, "limit of FMVSS 208 for a car crash", "R-2nd"}},
       "FMVSS 208", "D", "a crash limit, for a belt or a steering wheel over tens of ms"},
      {sternum_velocity, "sternum_velocity", "sternum velocity", "V(t) = dD/dt", "m/s", {}, "this code", "D", "a number to compare, no criterion"},
      {chest_compression, "chest_compression", "chest compression", "C = D / D0", "1",
       {{0.34, "about AIS 3", "K1"}, {0.40, "about AIS 4", "K1"}},
       "Kroell et al. 1974; Viano and Lau 1988", "K1", "slow blunt loads on a wide area; says little of fast, narrow ones"},
      {viscous_criterion, "viscous_criterion", "viscous criterion VC", "largest V(t) D(t) / D0 while both are inwards", "m/s",
       {{0.8, "about 50 % AIS 2 to 3, blunt ballistic impacts", "K2"}, {1.0, "25 % AIS 4 and more, frontal crash", "R"}},
       "Viano and Lau, SAE 861882; Bir and Viano 2004", "R", "soft tissue under loads of 3 to 30 m/s; a vest's back face is faster and narrower"},
      {viscous_criterion_crash, "viscous_criterion_crash", "viscous criterion, crash practice", "largest 1.3 V(t) D(t) / 0.229 m while both are inwards", "m/s",
       {{1.0, "limit of crash regulations", "K1"}},
       "SAE J1727, Hybrid III dummy", "K2", "scaled for a dummy's ribs, here to compare with crash tests only; unfiltered"},
      {back_face_signature, "back_face_signature", "back-face signature", "largest deflection of the vest's back face", "m",
       {{0.044, "limit of the clay test, a depth in clay", "S"}, {0.0447, "10 % lethality, deflection of a goat's thorax, 74 goats read anew (95 %: 17.6 to 55.4 mm)", "R"}, {0.0499, "15 % lethality, the same thorax (24.7 to 60.4 mm)", "R"}},
       "NIJ 0101; Prather, Swann and Hawkins 1977; Yoganandan et al., A Novel Paradigm to Develop Regional Thoracoabdominal Criteria for BABT (abstract)", "S", "each threshold is of its own backing, clay or a goat: over another, or nothing, the depth is another; stiff places (sternum, ribs) are hurt below 44 mm"},
      {blunt_criterion, "blunt_criterion", "blunt criterion BC", "ln(E / (W^(1/3) T D)), E in J, W in kg, T and D in cm; T = 0.711 W^(1/3) cm unless given", "1",
       {{0.37, "about 50 % AIS 2 to 3, thorax", "K2"}},
       "Sturdivan, Viano and Champion 2004; Bir and Viano 2004", "K2", "blunt projectiles of 30 to 200 g that touch the body; behind a vest give energy and diameter of what does, not of the bullet"},
      {four_parameter, "four_parameter_lethality", "four-parameter lethality (Lewis, Prather)", "1 / (1 + exp(34.13 - 3.597 ln(M V^2 / (W^(1/3) T D)))), M in g, V in m/s, W in kg, T and D in cm", "1", {},
       "Clare et al. 1975; Prather, Swann and Hawkins 1977", "K2", "constants not checked against the reports: check before use; animals, blunt projectiles"},
      {impact_force, "impact_force", "impact force on the body", "largest filtered rate of the momentum of the named materials along the shot", "N",
       {{24900, "50 % AIS 3 and more behind armor (+- 1400 N)", "R"}},
       "Bass et al. 2006, Int. J. Occup. Safety Ergonomics 12(4), 429", "R", "the slope of the risk is not known here: a ratio to the 50 % point and no risk; their force is an instrumented dummy's and cadaver's, not a model's sum"},
      {energy_density, "energy_density", "energy over area", "E / (pi D^2 / 4)", "J/cm2",
       {{23.99, "50 % penetration of the skin, anterior thorax", "R"}},
       "Bir et al. 2005, 2012", "R", "blunt projectiles on bare skin"},
      {chest_wall_velocity, "chest_wall_velocity", "chest wall velocity in blast (Axelsson, Yelverton)", "mean over the gauges of the largest x' of M x'' + J x' + K x = A (p + P0 - P0 (V0 / (V0 - A x))^g), M 2.03 kg, J 696 N s/m, K 989 N/m, A 0.082 m2, V0 1.82e-3 m3, g 1.2, P0 101325 Pa", "m/s",
       {{3.6, "trace to slight from here on", "K1"}, {4.3, "slight to moderate from here on", "K1"}, {7.5, "moderate to extensive from here on", "K1"}, {12.8, "more than 50 % lethality", "K1"}},
       "Axelsson and Yelverton 1996", "K1", "blast on a rigid cylinder's four gauges in the open or a room; not for a bullet behind a vest, and not for gauges on a wall that gives way"},
      {blast_injury_index, "adjusted_severity_of_injury_index", "ASII in blast", "(0.124 + 0.117 V)^2.63, V in m/s", "1", {},
       "Axelsson and Yelverton 1996", "K1", "as the chest wall velocity it is made of"},
      {peak_acceleration, "peak_acceleration", "peak acceleration", "largest mean over an interval, raw, sampled, and filtered by SAE J211-1 CFC", "m/s2", {},
       "SAE J211-1, ISO 6487", "R-2nd", "no threshold is accepted; acceleration of the chest wall is a poor sign of what the lung feels (Bush and Challener, IRCOBI 1989); the raw peak grows as cells shrink"},
      {peak_pressure, "peak_pressure", "peak pressure of an organ", "largest pressure of any cell that the material fills to half or more", "Pa", {},
       "this code", "D", "no threshold is accepted; a single cell's, so the shock's width on the mesh is in it"}};
  return all;
}

const InjuryCriterion& criterion(InjuryMeasure measure) { return injury_criteria()[static_cast<std::size_t>(measure)]; }

std::string injury_reference() {
  std::string out = "| measure | formula | thresholds | source | mark | limits |\n|---|---|---|---|---|---|\n";
  for (const InjuryCriterion& c : injury_criteria()) {
    out += fmt::format("| {} `{}` | {} | {} | {} | {} | {} |\n", c.name, c.key, c.formula, thresholds_text(c), c.source, c.mark, c.limits);
  }
  return out;
}

Peak largest_of(std::span<const double> samples, double interval, double start) {
  Peak peak;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (k == 0 || samples[k] > peak.value) {
      peak = {samples[k], start + interval * static_cast<double>(k)};
    }
  }
  return peak;
}

double chest_compression(double deflection, double chest_depth) { return deflection / chest_depth; }

std::vector<double> viscous_response(std::span<const double> velocity, std::span<const double> deflection, double chest_depth) {
  std::vector<double> out;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    out.push_back(std::max(velocity[k], 0.0) * std::max(deflection[k], 0.0) / chest_depth);
  }
  return out;
}

std::vector<double> crash_viscous_response(std::span<const double> velocity, std::span<const double> deflection) {
  return viscous_response(velocity, deflection, crash_depth / crash_scale);
}

double body_wall_thickness(double body_mass) { return 0.711 * std::cbrt(body_mass) * cm; }

double blunt_criterion(const BluntImpact& impact) { return std::log(impact.energy / resistance(impact)); }

double four_parameter_lethality(const BluntImpact& impact) {
  const double mass_speed_squared = 2 * impact.energy * grams_of_kilogram; // g m2/s2
  return 1 / (1 + std::exp(34.13 - 3.597 * std::log(mass_speed_squared / resistance(impact))));
}

ChestWallResponse chest_wall_response(std::span<const double> overpressure, double interval) {
  Peak peak;
  ChestWall wall;
  for (std::size_t k = 1; k < overpressure.size() && !wall.spent(); ++k) {
    wall.step(interval, overpressure[k - 1], overpressure[k]);
    peak = wall.v > peak.value ? Peak{wall.v, interval * static_cast<double>(k)} : peak;
  }
  return {peak, wall.spent()};
}

double adjusted_severity(double chest_wall_velocity) { return std::pow(0.124 + 0.117 * chest_wall_velocity, 2.63); }

double energy_density(double energy, double diameter) {
  const double radius = 0.5 * diameter / cm;
  return energy / (std::numbers::pi * radius * radius);
}

} // namespace ballast
