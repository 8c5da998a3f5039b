// Injury measures of a run as numbers: criteria, peak accelerations, forces, and what makes them weaker than they look.
#pragma once

#include "problems/injury_record.hpp"

#include <map>
#include <string>
#include <vector>

namespace ballast {

struct InjuryValue {
  InjuryMeasure measure;
  double value = 0, time = 0; ///< in the criterion's unit; s, 0 where there is no time to it
  bool at_least = false;      ///< a lower bound: the law ended before the load did
};

/// What a run knows of a body that hits.
struct StartOfRun {
  std::vector<double> slot_mass; ///< kg in the scene at the start
  std::vector<int> slots;        ///< by material of the scene
};

/// J: given, or of the bodies' masses and velocities at the start, the whole of them.
double impactor_energy(const SceneSpec& scene, const StartOfRun& start);

/// Every measure of the deck's [injury] that has a formula in injury_criteria().
template <int Dim> std::vector<InjuryValue> injury_values(const SceneSpec& scene, const InjuryRecord<Dim>& record, const StartOfRun& start);

/// Peak accelerations of a gauge along and against the shot, m/s2: from step to step, of the record, sampled, and of each filter.
template <int Dim> std::map<std::string, BothWays> peak_accelerations(const SceneSpec& scene, const InjuryRecord<Dim>& record, const InjurySite& site);

/// Peak forces on the materials of `force_on`, N, by filter.
template <int Dim> std::map<std::string, BothWays> peak_forces(const SceneSpec& scene, const InjuryRecord<Dim>& record);

/// What makes the values weaker than they look: problems/injury_warnings.cpp.
template <int Dim> std::vector<std::string> injury_warnings(const SceneSpec& scene, const InjuryRecord<Dim>& record, const std::vector<InjuryValue>& values);

} // namespace ballast
