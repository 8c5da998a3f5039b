// What ale/layers/contact.cpp is made of and nothing else includes.
#pragma once

#include "ale/layers/contact.hpp"

namespace ballast {

/// Fills state.candidates: for nodes near a side of their segment, feet on the next segments where the surface rises there.
template <int Dim> void find_neighbours(const std::array<ContactSurface<Dim>*, 2>& surfaces, ContactState<Dim>& state);

/// Impulses by Gauss-Seidel; every node's foot, gap and rate in state.tracks are those of the step.
template <int Dim> ContactReport apply_impulses(const std::array<ContactSurface<Dim>*, 2>& surfaces, double dt, const ContactSettings& settings, ContactState<Dim>& state);

} // namespace ballast
