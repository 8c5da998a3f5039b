// Observers that any test of a run may use.
#pragma once

#include "ale/simulation.hpp"

#include <functional>
#include <utility>

namespace ballast {

/// Stops a run after a number of steps.
template <int Dim> class StepLimit : public Observer<Dim> {
public:
  explicit StepLimit(long steps) : steps_(steps) {}
  bool record(const Scene<Dim>&, const Clock& clock) override { return clock.step < steps_; }

private:
  long steps_;
};

/// Looks at a scene after every step; the run stops when it answers false.
template <int Dim> class Watch : public Observer<Dim> {
public:
  using Look = std::function<bool(const Scene<Dim>&, const Clock&)>;
  explicit Watch(Look look) : look_(std::move(look)) {}
  bool record(const Scene<Dim>& scene, const Clock& clock) override { return look_(scene, clock); }

private:
  Look look_;
};

} // namespace ballast
