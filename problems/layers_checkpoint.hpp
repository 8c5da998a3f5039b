// Fabric layers in a checkpoint: stack, account and contact, so that a restart goes on bit for bit.
#pragma once

#include "ale/embedding.hpp"
#include "core/io/checkpoint.hpp"

#include <vector>

namespace ballast {

template <int Dim> void put_layers(io::CheckpointWriter& out, const std::vector<Layers<Dim>>& layers);

/// Into stacks built from the same deck. Throws Error: what of the file does not fit them.
template <int Dim> void get_layers(const io::CheckpointReader& in, std::vector<Layers<Dim>>& layers);

/// Layers inside meshes; after blocks and layers.
template <int Dim> void put_embedded(io::CheckpointWriter& out, const Scene<Dim>& scene);
template <int Dim> void get_embedded(const io::CheckpointReader& in, Scene<Dim>& scene);

} // namespace ballast
