// Fields of a block as plain arrays for core/io, with the reconstructed materials of mixed cells.
#pragma once

#include "ale/scene.hpp"
#include "core/io/vtk.hpp"

#include <string>
#include <vector>

namespace ballast {

/// `fields`: names of field_quantities(); material, pressure and speed are always written.
template <int Dim>
io::GridDump dump_block(const Block<Dim>& block, remap::NormalMethod normal, const std::vector<std::string>& fields);

} // namespace ballast
