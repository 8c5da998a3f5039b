// Debris: cloth torn off becomes a material of the mesh it lies in.
#pragma once

#include "ale/embedding.hpp"

namespace ballast {

/// After a remap: nodes of stacks that no element hangs on give what they weigh to the void of the cell they are in (Layers::debris), as far as it
/// takes it at the material's density at rest: mass, momentum and energy stay. Only near the stacks, where all cells are awake; what finds no
/// void flies on as a particle of its stack.
template <int Dim> void shed_debris(Scene<Dim>& scene, const Embedding<Dim>& e, Block<Dim>& b);

} // namespace ballast
