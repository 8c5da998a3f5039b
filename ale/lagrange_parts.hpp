// Pieces of the Lagrangian step, private to ale/.
#pragma once

#include "ale/corner_force.hpp"
#include "ale/scene.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace ballast {

/// The viscous hourglass term damps a 3D mode by 64 x coefficient x CFL a step: explicit, so below 2.
template <int Dim> ForceCoefficients force_coefficients(const Block<Dim>& b, const Numerics& n, double dt) {
  return {dt, std::min(n.hourglass, 0.03 / n.cfl), n.shear_q, b.skew[0].empty() ? 0.0 : n.subzonal_pressure};
}

/// What boundaries did to the block in a step: work (J) and impulse (kg m/s).
struct BoundaryEffect {
  double work = 0;
  std::array<double, 3> impulse = {0, 0, 0};
};

/// A viscoelastic cell that could not be integrated.
struct TissueTrouble {
  std::array<int, 3> cell = {-1, -1, -1};
  std::size_t material = 0;
  TissueFailure failure{};
};

/// Sums over the cells of a step.
template <int Dim> struct StepSums {
  double void_work = 0;    ///< J
  double swept_volume = 0; ///< m3, sum of S.ubar dt: what the reference pressure worked on
  int failed = 0;
  std::array<int, 3> failed_cell = {-1, -1, -1}; ///< the last of them
  std::vector<TissueEnergy> tissue;     ///< by material; empty without a viscoelastic one
  long tissue_repairs = 0;
  std::optional<TissueTrouble> trouble; ///< the first
  double tissue_seconds = 0; ///< of all threads
};

/// Work of the step's forces on every cell, shared among its materials; volumes, deviators and plastic strain after
/// it. Nodes' new velocities and cells' next_volume must be there.
template <int Dim> StepSums<Dim> work_pass(Scene<Dim>& scene, Block<Dim>& block, double dt);

/// Velocity component (m/s) of the mass at a node: where what slides meets the rest the node need not move so (remap/mesh.hpp, Sliding).
template <int Dim>
double mean_velocity(const Block<Dim>& b, const std::array<RowField, Dim>& velocity, const std::array<RowField, Dim>& jump, std::size_t d, int r, int i) {
  const double u = velocity[d].row(r)[i], mass = b.node_mass.row(r)[i];
  if (!b.any_sliding() || !(mass > 0)) {
    return u;
  }
  const double sliding = b.sliding.node_mass.row(r)[i];
  return u + (sliding / mass - remap::node_follows(sliding, mass)) * jump[d].row(r)[i];
}

} // namespace ballast
