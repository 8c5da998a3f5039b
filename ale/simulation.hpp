// The cycle: choose dt, Lagrangian step, remap where due, advance, observe.
#pragma once

#include "ale/phases.hpp"

namespace ballast {

/// Sees a scene between steps: history, dumps, checkpoints, progress.
template <int Dim> class Observer {
public:
  virtual ~Observer() = default;
  /// Called after every step; returns false to stop the run (an interrupt).
  virtual bool record(const Scene<Dim>& scene, const Clock& clock) = 0;
};

/// Runs until clock.end_time or until an observer stops it. Returns true when the end was reached.
template <int Dim>
bool run(Scene<Dim>& scene, Clock& clock, const std::vector<Observer<Dim>*>& observers = {});

/// After blocks and their materials' fractions, masses, energies and velocities are set: node masses, state.
template <int Dim> void prepare(Scene<Dim>& scene);

} // namespace ballast
