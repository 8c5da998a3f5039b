// What injury measures take from a block after each step. The same bits for any number of threads.
#pragma once

#include "ale/block.hpp"

#include <array>
#include <limits>
#include <vector>

namespace ballast {

/// Highest pressure of the cells that a material fills to half or more.
struct PressurePeak {
  double pressure = -std::numeric_limits<double>::infinity(); ///< absolute, Pa; without such a cell as it is here
  std::array<double, 3> at = {0, 0, 0};                       ///< middle of the cell, m
};

/// Of awake cells only, unless `all`: what sleeps has had its pressure when it fell asleep.
template <int Dim> PressurePeak highest_pressure(const Block<Dim>& block, int slot, bool all, ThreadPool& pool);

/// Momentum along a mesh axis of some materials, kg m/s: of their shares of the nodes. Over all materials it is the block's.
template <int Dim> double material_momentum(const Block<Dim>& block, const std::vector<int>& slots, int axis, ThreadPool& pool);

/// The material that takes most of a cell, -1: none does.
template <int Dim> int fullest_slot(const Block<Dim>& block, const std::array<int, 3>& cell);
/// Does a material take a hundredth of a cell or more? Slot -1: no.
template <int Dim> bool holds(const Block<Dim>& block, const std::array<int, 3>& cell, int slot);
/// Does a point lie outside the mesh by more than half the nearest cell, `cell`?
template <int Dim> bool beyond_mesh(const Block<Dim>& block, const std::array<int, 3>& cell, const std::array<double, 3>& at);

} // namespace ballast
