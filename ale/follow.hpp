// A mesh that follows some of its materials (ale/follow.cpp).
#pragma once

#include "ale/block.hpp"

namespace ballast {

/// Of some materials of a block, corner by corner.
template <int Dim> Bulk bulk_of(const Block<Dim>& block, const std::vector<int>& materials);

/// Moves the target mesh to where the leaders are; leaves it where next to nothing of them is left.
template <int Dim> void follow_target(Block<Dim>& block, ThreadPool& pool);

} // namespace ballast
