// What a run reports of its scene: bullet, cavity, gauges, sums.
#pragma once

#include "ale/simulation.hpp"
#include "problems/build_scene.hpp"

namespace ballast {

/// Speed, mass and extents of a set of materials; lengths in m.
struct BodyMeasure {
  double mass = 0;     ///< kg; planar: per metre
  double velocity = 0; ///< mean by mass along the shot, m/s
  /// Extreme positions along the shot where the fraction passes one half (on curvilinear meshes: nodes of cells at least half full).
  double front = 0, rear = 0;
  double radius = 0;          ///< largest across it
};
template <int Dim>
BodyMeasure measure_body(const Block<Dim>& block, const std::vector<int>& slots, int axis, double direction);

/// Kinetic energy of a material, J: of its shares of the nodes. Over all materials it is the block's.
template <int Dim> double kinetic_energy(const Block<Dim>& block, int slot);

/// Largest radius (m) around the shot line, inside the target, that the target has been cleared from.
template <int Dim>
double cavity_radius(const Block<Dim>& block, int target_slot, int axis, double from, double direction, double until);

/// A point that records; `cell` holds it.
struct GaugePoint {
  std::array<double, 3> at{};
  std::array<int, 3> cell{-1, -1, -1};
};

/// The cell of the block that holds a point, searched on the target mesh (eulerian) or cell by cell (the nearest middle).
template <int Dim> std::array<int, 3> find_cell(const Block<Dim>& block, const std::array<double, 3>& at);
/// Velocity at a point of a cell: mean of its nodes weighted by the distance along each axis (curvilinear meshes: by the place in the cell).
template <int Dim>
std::array<double, 3> velocity_at(const Block<Dim>& block, const std::array<int, 3>& cell, const std::array<double, 3>& at);

} // namespace ballast
