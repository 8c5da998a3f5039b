// What a verification case measures on a run: conservation, fronts, plateaus, arrival times.
#pragma once

#include "problems/verify.hpp"
#include "tests/verify/tube.hpp"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace ballast::verify {

const char* short_name(MotionPolicy motion); ///< Lag, Eul, follow, relax

/// Gate: mass of each material, momentum (with the walls' impulse) and total energy of a run kept to 1e-12 of
/// their scale, every ledger entry counted; with energy return on, also that the remap returned all it lost.
/// The parts are listed when it fails.
template <int Dim> void conserves(VerifyReport& r, const std::string& name, const TubeRun<Dim>& run);

/// Gate: no energy floor, no sliver, no retried step.
template <int Dim> void untouched(VerifyReport& r, const std::string& name, const TubeRun<Dim>& run);

/// Value of one cell that a front or plateau is read from.
using CellValue = std::function<double(const TubeCell&)>;

/// Largest (rightmost) or smallest position where the value crosses `level`, linear between cell centres.
double rightmost_crossing(const std::vector<TubeCell>& cells, const CellValue& value, double level);
double leftmost_crossing(const std::vector<TubeCell>& cells, const CellValue& value, double level);

/// Mean by width over pure cells whose centre is in [from, to].
double mean_between(const std::vector<TubeCell>& cells, const CellValue& value, double from, double to);

/// When the rightmost crossing of `level` passes `station`, linear in time between steps.
class Arrival : public Observer<2> {
public:
  Arrival(CellValue value, double level, double station)
      : value_(std::move(value)), level_(level), station_(station) {}
  bool record(const Scene<2>& scene, const Clock& clock) override;
  double time() const { return arrival_; }

private:
  CellValue value_;
  double level_, station_;
  double before_ = std::numeric_limits<double>::quiet_NaN(), time_before_ = 0;
  double arrival_ = std::numeric_limits<double>::quiet_NaN();
};

/// run_tube watched by arrivals.
TubeRun<2> run_watched(const Tube& tube, const std::vector<Observer<2>*>& observers);

/// Moves a scene that is ready to `end_time`, with the sums before and after.
template <int Dim>
TubeRun<Dim> run_scene(Scene<Dim>&& scene, double end_time, const std::vector<Observer<Dim>*>& observers = {});

/// The same for a run that may fail: why it did, empty if it did not.
template <int Dim> std::string try_scene(Scene<Dim>&& scene, double end_time, TubeRun<Dim>& run);
/// That as a gate: the end is reached. A run that fails is a row of the report with its reason, not the end of the case; false then.
template <int Dim> bool ends(VerifyReport& r, const std::string& name, Scene<Dim>&& scene, double end_time, TubeRun<Dim>& run);

} // namespace ballast::verify
