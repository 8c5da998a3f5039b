// Remap beside bodies inside a block, around remap/.
#pragma once

#include "ale/embedding.hpp"
#include "remap/mesh.hpp"

namespace ballast {

/// What crosses faces of cells that bodies cut or cover, before or after; closes those faces to the sweeps. The block's positions are
/// those of the step's end, `order` that of the sweeps.
template <int Dim> void remap_embedded(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& block, remap::Mesh<Dim>& mesh, const remap::Settings& settings, long order);

/// After a step without a remap: slivers and their roots come to one state, what bodies have buried goes to its root.
template <int Dim> void pool_embedded(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& block);

/// No jump at nodes that hold only one of what slides, or nothing, since mass has gone elsewhere (ale/remap_block).
template <int Dim> void settle_jumps(Block<Dim>& block, ThreadPool& pool);

/// After the sweeps: levels and cut cells on the target mesh, whose volumes are open parts.
template <int Dim> void restore_open_volumes(Embedding<Dim>& e, Block<Dim>& block, ThreadPool& pool);

} // namespace ballast
