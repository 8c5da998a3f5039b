// BlockSurface: a free side of a block as a surface that layers touch (ale/layers/contact_surface).
//
// A block's nodes move by dt (v_n + v_np1)/2 while the layers take several substeps. Gathered here are the side's nodes with where
// they are in the substep; a unit impulse on one changes v_np1 by 1/m and what is left of its way by dt/(2m), so that at the end of
// the step x_np1 = x_n + dt (v_n + v_np1)/2 to round-off: the block's own energy account stays exact.
#pragma once

#include "ale/block.hpp"
#include "ale/layers/contact_surface.hpp"

#include <array>
#include <vector>

namespace ballast {

template <int Dim> struct BlockSurface {
  int axis = 0, side = 0;
  std::array<int, 2> segments = {1, 1};
  std::vector<int> row, index;                                       ///< the block's node behind each
  std::array<std::vector<double>, Dim> position, velocity, start;  ///< now, v_np1, v_n
  std::array<std::vector<double>, Dim> origin, rest_of_way;          ///< x_n; m/s: the part of the way's speed that v_np1 has no say in
  std::vector<double> mass;
  std::vector<unsigned char> held;

  struct Twin {
    std::size_t node, surface, other; ///< on an edge: the same node on another side
  };
  std::vector<Twin> twins;
};

/// The free sides of a block of one material without void, each gathered after the block's own forces have given next_velocity.
template <int Dim> std::vector<BlockSurface<Dim>> gather_surfaces(const Block<Dim>& block);

/// The surface for a substep from `done` (of 1) of the step dt on.
template <int Dim> ContactSurface<Dim> surface_at(BlockSurface<Dim>& surface, double dt, double done);

/// Tells the other sides what contact did to the nodes on a side's edges.
template <int Dim> void tell_twins(std::vector<BlockSurface<Dim>>& surfaces, std::size_t from);

/// Moves the surface's nodes on by a substep of h.
template <int Dim> void follow_way(BlockSurface<Dim>& surface, double dt, double done, double h);

/// Gives the block the velocities and places that contact made; returns the energy (J) that it thereby gained.
template <int Dim> double scatter_surface(Block<Dim>& block, const BlockSurface<Dim>& surface, double dt);

} // namespace ballast
