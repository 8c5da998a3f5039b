// Hypoelastic stress update of one row: Jaumann rate by the Hughes-Winget rotation, elastic trial,
// radial return (materials/strength). Deviator components as in stress_components<Dim>, tension-positive.
#pragma once

#include "ale/block.hpp"
#include "core/threads.hpp"

namespace ballast {

/// Pointers to the first of `count` cells. gradient: velocity gradient times dt (ale/corner_force).
template <int Dim> struct StressRows {
  double* stress[stress_components<Dim>];
  double* plastic_strain;
  double* flow_stress; ///< out: what the deviator may reach now, Pa
  const double* energy;
  const double* shear;    ///< shear modulus, Pa; null: the model's constant
  double* damage;         ///< null without a failure model
  const double* pressure; ///< gauge, Pa; with damage only
  double reference_pressure;
  const double* gradient[Dim == 2 ? 5 : 9];
};

/// Those of a material with strength from cell `at` of row r on, without gradients.
template <int Dim> StressRows<Dim> stress_rows(MaterialSlot& slot, double reference_pressure, int r, int at);

/// Also accumulates damage; what has failed or molten carries nothing. Returns the number of cells whose return did
/// not converge.
template <int Dim>
[[nodiscard]] int update_stress(const Material& material, double dt, int count, const StressRows<Dim>& rows);

/// Scales deviators back to the flow stress (after a remap).
template <int Dim> void pull_back_to_yield(const Material& material, int count, const StressRows<Dim>& rows);

inline constexpr double sliver_fraction = 1e-4;

/// A sliver (below sliver_fraction of its cell) carries no deviator: a steady pull on next to no mass would fling it away.
template <int Dim> void relax_slivers(const double* fraction, int count, const StressRows<Dim>& rows);

/// Both for every cell of a block; also sets the flow stresses (start of a run, after a remap).
template <int Dim> void pull_back_to_yield(Block<Dim>& block, ThreadPool& pool);

} // namespace ballast
