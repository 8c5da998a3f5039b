// Stacks of fabric layers as plain arrays for core/io.
#pragma once

#include "ale/layers/layer_stack.hpp"
#include "core/io/vtk.hpp"

#include <span>
#include <string>
#include <vector>

namespace ballast {

/// A dump a stack, without its eroded elements. Points: velocity (m/s), displacement (m). Elements: material (its index after
/// `material_names`, those of the blocks), speed (m/s), layer (from 0, the lowest), Green strains 11, 22, 33 and second Piola-Kirchhoff
/// stresses (Pa) in the middle, damage of warp and fill: largest strain so far over that at rupture, at the worse point; 1 is the start of the
/// ramp; 3D also section: 1 where the lower face along y lies on y = 0 at rest. Stresses are those of the last update_forces.
template <int Dim> std::vector<io::ElementDump> dump_layers(std::span<const LayerStack<Dim>* const> stacks, const std::vector<std::string>& material_names);

} // namespace ballast
