#include "problems/injury_values.hpp"

#include "core/cfc_filter.hpp"
#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

using enum InjuryMeasure;

std::string filter_name(int cfc) { return fmt::format("CFC{}", cfc); }

/// From 0 on: without a sample that way it is 0.
BothWays both_ways(std::span<const double> samples, double interval, double start) {
  BothWays peaks;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Peak now = {samples[k], start + interval * static_cast<double>(k)};
    peaks.along = now.value > peaks.along.value ? now : peaks.along;
    peaks.against = now.value < peaks.against.value ? now : peaks.against;
  }
  return peaks;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out;
  for (std::size_t k = 0; k < a.size(); ++k) {
    out.push_back(a[k] - b[k]);
  }
  return out;
}

template <int Dim> void chest_values(const InjurySpec& in, const InjuryRecord<Dim>& record, std::vector<InjuryValue>& values) {
  std::vector<double> deflection = record.deflection(in.sternum), velocity = record.velocity(in.sternum);
  if (in.spine >= 0) {
    deflection = difference(deflection, record.deflection(in.spine));
    velocity = difference(velocity, record.velocity(in.spine));
  }
  const double h = record.record().interval();
  const auto add = [&](InjuryMeasure measure, const Peak& peak) { values.push_back({measure, peak.value, peak.time}); };
  const Peak largest = largest_of(deflection, h);
  add(sternum_deflection, largest);
  add(sternum_velocity, largest_of(velocity, h));
  if (in.chest_depth > 0) {
    add(chest_compression, {ballast::chest_compression(largest.value, in.chest_depth), largest.time});
    add(viscous_criterion, largest_of(viscous_response(velocity, deflection, in.chest_depth), h));
    add(viscous_criterion_crash, largest_of(crash_viscous_response(velocity, deflection), h));
  }
}

/// Force of the materials of `force_on` by a filter, N, between samples.
template <int Dim> std::vector<double> filtered_force(const InjuryRecord<Dim>& record, int cfc) {
  const double h = record.record().interval();
  return cfc_filtered(rates(record.momentum(), h), h, cfc);
}

template <int Dim> void blast_values(const InjurySpec& in, const InjuryRecord<Dim>& record, std::vector<InjuryValue>& values) {
  double mean = 0, last = 0;
  bool cut = false;
  for (std::size_t n = 0; n < in.blast.size(); ++n) {
    const ChestWallResponse wall = chest_wall_response(record.overpressure(n), record.record().interval());
    mean += wall.peak.value / static_cast<double>(in.blast.size());
    last = std::max(last, wall.peak.time);
    cut = cut || wall.cut;
  }
  values.push_back({chest_wall_velocity, mean, last, cut});
  values.push_back({blast_injury_index, adjusted_severity(mean), 0, cut});
}

void impact_values(const SceneSpec& scene, const StartOfRun& start, std::vector<InjuryValue>& values) {
  const InjurySpec& in = *scene.injury;
  const BluntImpact impact = {impactor_energy(scene, start), in.impactor_diameter, in.body_mass, in.wall_thickness};
  if (in.body_mass > 0 && impact.energy > 0) {
    values.push_back({InjuryMeasure::blunt_criterion, ballast::blunt_criterion(impact), 0});
    values.push_back({four_parameter, four_parameter_lethality(impact), 0});
  }
  values.push_back({InjuryMeasure::energy_density, ballast::energy_density(impact.energy, impact.diameter), 0});
}

} // namespace

double impactor_energy(const SceneSpec& scene, const StartOfRun& start) {
  const InjurySpec& in = *scene.injury;
  if (in.impactor_energy > 0) {
    return in.impactor_energy;
  }
  double energy = 0;
  std::vector<int> counted;
  for (const int b : in.impactor) {
    const Body& body = scene.bodies[static_cast<std::size_t>(b)];
    const int slot = start.slots[static_cast<std::size_t>(body.material)];
    if (std::find(counted.begin(), counted.end(), slot) == counted.end()) { // two bodies of a material share its mass
      energy += 0.5 * in.copies * start.slot_mass[static_cast<std::size_t>(slot)] * dot(body.velocity, body.velocity);
      counted.push_back(slot);
    }
  }
  return energy;
}

template <int Dim> std::vector<InjuryValue> injury_values(const SceneSpec& scene, const InjuryRecord<Dim>& record, const StartOfRun& start) {
  const InjurySpec& in = *scene.injury;
  std::vector<InjuryValue> values;
  if (in.sternum >= 0) {
    chest_values(in, record, values);
  }
  if (!in.back_face.empty()) {
    values.push_back({back_face_signature, record.back_face().value, record.back_face().time});
  }
  if (!in.blast.empty()) {
    blast_values(in, record, values);
  }
  if (in.has_impact()) {
    impact_values(scene, start, values);
  }
  if (!in.force_on.empty() && !in.filters.empty()) {
    const int cfc = *std::max_element(in.filters.begin(), in.filters.end());
    const double h = record.record().interval();
    const Peak peak = largest_of(filtered_force(record, cfc), h, 0.5 * h);
    values.push_back({impact_force, peak.value, peak.time});
  }
  return values;
}

template <int Dim> std::map<std::string, BothWays> peak_accelerations(const SceneSpec& scene, const InjuryRecord<Dim>& record, const InjurySite& site) {
  const InjurySpec& in = *scene.injury;
  const double h = record.record().interval();
  const std::vector<double> a = rates(record.velocity(site.gauge), h);
  const auto stride = static_cast<std::size_t>(std::llround(in.sample_every / h));
  std::map<std::string, BothWays> all;
  all["steps"] = site.steps;
  all["recorded"] = both_ways(a, h, 0.5 * h);
  all["sampled"] = both_ways(every(a, stride), in.sample_every, 0.5 * h);
  for (const int cfc : in.filters) {
    all[filter_name(cfc)] = both_ways(cfc_filtered(a, h, cfc), h, 0.5 * h);
  }
  return all;
}

template <int Dim> std::map<std::string, BothWays> peak_forces(const SceneSpec& scene, const InjuryRecord<Dim>& record) {
  std::map<std::string, BothWays> all;
  const double h = record.record().interval();
  for (const int cfc : scene.injury->filters) {
    if (!scene.injury->force_on.empty()) {
      all[filter_name(cfc)] = both_ways(filtered_force(record, cfc), h, 0.5 * h);
    }
  }
  return all;
}

template std::vector<InjuryValue> injury_values<2>(const SceneSpec&, const InjuryRecord<2>&, const StartOfRun&);
template std::map<std::string, BothWays> peak_accelerations<2>(const SceneSpec&, const InjuryRecord<2>&, const InjurySite&);
template std::map<std::string, BothWays> peak_forces<2>(const SceneSpec&, const InjuryRecord<2>&);
template std::vector<InjuryValue> injury_values<3>(const SceneSpec&, const InjuryRecord<3>&, const StartOfRun&);
template std::map<std::string, BothWays> peak_accelerations<3>(const SceneSpec&, const InjuryRecord<3>&, const InjurySite&);
template std::map<std::string, BothWays> peak_forces<3>(const SceneSpec&, const InjuryRecord<3>&);

} // namespace ballast
