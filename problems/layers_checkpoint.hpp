// Fabric layers in a checkpoint: stack, account and contact, so that a restart goes on bit for bit.
#pragma once

#include "ale/layers/layers.hpp"
#include "core/io/checkpoint.hpp"

#include <vector>

namespace ballast {

template <int Dim> void put_layers(io::CheckpointWriter& out, const std::vector<Layers<Dim>>& layers);

/// Into stacks built from the same deck. Throws Error: what of the file does not fit them.
template <int Dim> void get_layers(const io::CheckpointReader& in, std::vector<Layers<Dim>>& layers);

} // namespace ballast
