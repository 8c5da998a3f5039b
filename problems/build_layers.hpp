// From a LayersSpec to a LayerStack at rest.
#pragma once

#include "problems/scene_spec.hpp"

namespace ballast {

/// A stack at rest, its forces zero; layers counted from the lowest. Throws Error: name, what is wrong, the cure.
template <int Dim> LayerStack<Dim> build_stack(const LayersSpec& spec, Geometry geometry);

/// All of a scene, in its order.
template <int Dim> std::vector<LayerStack<Dim>> build_stacks(const SceneSpec& scene);

} // namespace ballast
