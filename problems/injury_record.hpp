// Follows what a deck's [injury] asks for from step to step; what it remembers goes through checkpoints, so that a run that was
// interrupted gives the same numbers. Deflections and velocities are along the shot.
#pragma once

#include "ale/scene.hpp"
#include "core/uniform_record.hpp"
#include "problems/injury_criteria.hpp"
#include "problems/injury_measure.hpp"
#include "problems/scene_spec.hpp"

#include <span>
#include <string>
#include <vector>

namespace ballast {

/// Along the shot and against it: the largest and the least.
struct BothWays {
  Peak along, against; ///< `against` is negative
};

/// A gauge that is followed.
struct InjurySite {
  int gauge = -1;
  BothWays steps;   ///< acceleration from step to step, m/s2
  int slot = -1;    ///< what it rides on, -1: nothing
  double lost = -1; ///< since when it rides on that no more, s; -1: it does
};

struct OrganPeak {
  int material = -1; ///< of SceneSpec::materials
  PressurePeak peak;
  double time = 0; ///< s
};

template <int Dim> class InjuryRecord {
public:
  /// `slots`: by material of the scene.
  InjuryRecord(const SceneSpec& scene, const std::vector<int>& slots);
  bool asked() const { return spec_.injury.has_value(); }
  /// After every step, and at the start. `gauges`: x, y, z of each now, m.
  void step(const Scene<Dim>& scene, double time, std::span<const double> gauges);

  const UniformRecord& record() const { return record_; }
  const std::vector<InjurySite>& sites() const { return sites_; }
  const std::vector<OrganPeak>& organs() const { return organs_; }
  /// Of a gauge that is followed: m, m/s at equal intervals.
  const std::vector<double>& deflection(int gauge) const { return record_.column(2 * site_of(gauge)); }
  const std::vector<double>& velocity(int gauge) const { return record_.column(2 * site_of(gauge) + 1); }
  /// Of the materials of `force_on`, all copies, kg m/s.
  const std::vector<double>& momentum() const { return record_.column(2 * sites_.size()); }
  /// Over the ambient one, of the `n`th of `blast_gauges`, Pa.
  const std::vector<double>& overpressure(std::size_t n) const { return record_.column(2 * sites_.size() + (force_slots_.empty() ? 0 : 1) + n); }
  const Peak& back_face() const { return back_face_; } ///< largest deflection, m
  double time() const { return time_; }                ///< of the last step, s

  std::vector<double> memory() const;
  /// The inverse; returns how many numbers it took.
  std::size_t recall(std::span<const double> numbers);

private:
  std::size_t site_of(int gauge) const;
  void follow(int gauge);
  void watch(InjurySite& site, const Block<Dim>& block, const std::array<int, 3>& cell, const std::array<double, 3>& at, double time);
  void find_peaks(const Scene<Dim>& scene, double time);

  const SceneSpec& spec_;
  std::vector<int> slots_;
  std::vector<InjurySite> sites_;
  std::vector<OrganPeak> organs_;
  std::vector<int> force_slots_;
  std::vector<double> last_; ///< values of the step before
  UniformRecord record_;
  Peak back_face_;
  double time_ = 0;
  bool started_ = false;
};

} // namespace ballast
