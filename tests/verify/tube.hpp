// One-dimensional problems as one-cell-wide blocks along any axis of a 2D or 3D mesh.
#pragma once

#include "ale/fill.hpp"
#include "ale/simulation.hpp"
#include "tests/exact/riemann.hpp"

#include <algorithm>
#include <functional>
#include <optional>

namespace ballast::verify {

/// OFHC copper free of stress at rest: its energy is that of zero pressure, not of 1 atm.
Material copper_at_zero();

struct TubeState {
  int material = 0;
  double density = 1, velocity = 0, specific_energy = 0;
};

struct Tube {
  int cells = 100;
  double length = 1;
  double interface = 0.5;   ///< where left becomes right
  bool interface_in_cell = false; ///< shift the mesh so that the interface halves a cell
  int axis = 0;
  /// What closes the tube; by default walls that move with the left and the right state. An inflow brings in
  /// the state of its end.
  std::optional<std::array<BoundarySide, 2>> ends;
  std::array<Material, 2> materials; ///< left, right; the same material twice when equal names
  TubeState left, right;
  MotionPolicy motion = MotionPolicy::lagrangian;
  int remap_every = 1;
  double end_time = 1;
  double reference_pressure = 0;
  Numerics numerics{};
  int threads = 1;
  std::vector<double> lines = {}; ///< mesh lines along the tube; empty: `cells` equal cells
};

template <int Dim> struct TubeRun {
  Scene<Dim> scene;
  Clock clock;
  Totals start, end;
};

/// Builds the block, both states filled; velocities by node (the interface node gets the mean by mass, the
/// nodes of a wall or an inflow its own).
template <int Dim> TubeRun<Dim> make_tube(const Tube& tube);
/// make_tube and run to the end.
template <int Dim> TubeRun<Dim> run_tube(const Tube& tube);

/// One cell's profile values along the tube.
struct TubeCell {
  double centre, width, density, velocity, pressure;
  bool mixed;
  double stress = 0; ///< deviator along the tube, Pa, tension-positive; zero without strength
};
template <int Dim> std::vector<TubeCell> profile(const Block<Dim>& block, int axis);
template <int Dim> std::vector<TubeCell> profile(const TubeRun<Dim>& run, int axis) {
  return profile(run.scene.blocks[0], axis);
}

struct TubeError {
  double density = 0, velocity = 0, pressure = 0;
};
/// L1 over pure cells (integral over the tube, times 1/length).
TubeError error_against(const std::vector<TubeCell>& cells, const exact::Riemann& exact, double x0, double t);

/// Material and state for one side of a stiffened-gas Riemann problem.
Material gas(const std::string& name, const exact::GasState& s);
Tube riemann_tube(const exact::GasState& left, const exact::GasState& right, double x0, double t, int cells);

/// Relative change of the closed-run sums: energy, mass and momentum with every ledger entry (momentum with the
/// impulse of walls and symmetry planes). Where the remap returns kinetic energy, what it did not return counts as
/// error: no entry stands for it.
struct Conservation {
  double energy = 0, mass = 0, momentum = 0;
  double unreturned = 0; ///< of energy, the remap's kinetic loss that was to be returned and was not

  double worst() const { return std::max({energy, mass, momentum, unreturned}); }
};
template <int Dim> Conservation conservation(const TubeRun<Dim>& run);

} // namespace ballast::verify
