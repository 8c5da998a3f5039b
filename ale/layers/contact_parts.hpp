// What ale/layers/contact.cpp is made of and nothing else includes.
#pragma once

#include "ale/layers/contact.hpp"

namespace ballast {

/// Impulses by Gauss-Seidel; every node's foot, gap and rate in state.tracks are those of the step.
template <int Dim> ContactReport apply_impulses(const std::array<ContactSurface<Dim>*, 2>& surfaces, double dt, const ContactSettings& settings, ContactState<Dim>& state);

} // namespace ballast
