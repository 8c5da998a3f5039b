// The phases of a step, in the order the simulation calls them (ale/simulation.cpp).
#pragma once

#include "ale/scene.hpp"

namespace ballast {

/// Per-material pressure and modulus from density and energy, then the cell's own pressure, modulus,
/// density, wave speed and stress. Throws NumericalFailure naming cell, material and quantity when a
/// sound speed squared is negative or a value is not finite.
template <int Dim> void update_state(Block<Dim>& block, ThreadPool& pool);

/// Owner and state of a row's awake cells: the only way they come about, so that a restart recomputes the same bits. `runs`
/// and `rho` (a value a cell) are scratch.
template <int Dim> void row_state(Block<Dim>& block, int row, RowRuns& runs, std::vector<double>& rho);

/// Pressures, moduli and shear moduli of the awake cells of one row of a material whose shear modulus depends on its state.
template <int Dim> void refresh_shear(Block<Dim>& block, MaterialSlot& slot, int row);

/// Throws NumericalFailure naming the cell, material and quantity when the row's state is not finite.
template <int Dim> void throw_if_bad(const Block<Dim>& block, int j, int k);

/// Spall: void opens where a material's pressure is below its spall pressure, so that the cell goes back
/// to zero pressure. Returns the number of cells.
template <int Dim> long open_voids(Block<Dim>& block, ThreadPool& pool);

/// Closes voids that a remap left beside materials compressed enough to fill them, and residues (below 1e-2 of a
/// cell) inside a body where that does not bring a material to its spall pressure (`spall`: whether anything can
/// spall). No mass or energy moves. Returns the number of cells.
template <int Dim> long close_voids(Block<Dim>& block, ThreadPool& pool, bool spall = true);

/// Whether close_voids would close cell (i, j, k), mixed.
template <int Dim> bool to_be_closed(const Block<Dim>& block, int i, int j, int k, bool spall);

/// Energy (J/kg) that a gas beside condensed matter comes to by conduction, at the temperature of its start. A gas that
/// starts within 5 % of the ambient temperature is taken to start at it: what is at rest stays so to the bit.
double conduction_wall(const MaterialSlot& slot);

/// Strain rates, lengths and viscosity along the logical axes, and the largest stable step.
template <int Dim> DtLimit stable_dt(Scene<Dim>& scene);

/// One Lagrangian step of all blocks; retries with half of clock.dt when a cell would invert or tissue cannot be integrated. Leaves the blocks'
/// state (pressures, owners) as it was: new_state comes next.
template <int Dim> void lagrange_step(Scene<Dim>& scene, Clock& clock);

/// What the motion of a block has to know of its start; once, on the initial mesh.
template <int Dim> void start_motion(Block<Dim>& block);

/// Is a remap due after this step: every so many, or by the quality of the mesh?
template <int Dim> bool remap_due(const Block<Dim>& block, long step, ThreadPool& pool);

/// Moves the target mesh of a block and its volumes: following, to where its leaders are (ale/follow); relaxing, to a
/// smoother one than it has now (ale/relax). That of an eulerian one stays.
template <int Dim> void place_target(Block<Dim>& block, ThreadPool& pool);

/// Remaps a block from where it is to its target mesh; new_state comes next.
template <int Dim> void remap_block(Scene<Dim>& scene, Block<Dim>& block, long step);

/// State at the end of a step: pressures, voids that a remap left closed, voids that spall opens.
template <int Dim> void new_state(Scene<Dim>& scene, Block<Dim>& block, bool remapped);

/// One whole step: choose dt, Lagrangian step, remap where due, state.
template <int Dim> void advance(Scene<Dim>& scene, Clock& clock);

/// What a cell holds, for messages: "copper", or "copper 0.4, void 0.6".
template <int Dim> std::string contents(const Block<Dim>& block, const std::array<int, 3>& cell);

struct Totals {
  std::vector<double> mass, internal_energy, volume; ///< by material
  double kinetic_energy = 0;
  std::array<double, 3> momentum = {0, 0, 0};
  std::vector<double> free_energy; ///< J by material, 0 of what is not viscoelastic

  double internal() const {
    double sum = 0;
    for (double e : internal_energy) {
      sum += e;
    }
    return sum;
  }
};
template <int Dim> Totals totals(const Block<Dim>& block);

} // namespace ballast
