// From a LayersSpec to a LayerStack at rest, and to the Layers of a scene.
#pragma once

#include "ale/layers/layers.hpp"
#include "problems/scene_spec.hpp"

namespace ballast {

/// A stack at rest, its forces zero; layers counted from the lowest. Throws Error: name, what is wrong, the cure.
template <int Dim> LayerStack<Dim> build_stack(const LayersSpec& spec, Geometry geometry);

/// Likewise, with its contact and its steps.
template <int Dim> Layers<Dim> build_layers(const LayersSpec& spec, Geometry geometry);

} // namespace ballast
