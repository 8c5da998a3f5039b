// Every run of a verification case goes through here, so that `verify --hard` can change how it is made and see how it ends.
#pragma once

#include "ale/simulation.hpp"

namespace ballast::verify {

/// Runs a prepared scene; under a trial with the trial's CFL number, remap interval and closure.
template <int Dim> bool go(Scene<Dim>& scene, Clock& clock, const std::vector<Observer<Dim>*>& observers = {});

} // namespace ballast::verify
