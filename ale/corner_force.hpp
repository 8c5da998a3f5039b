// Corner forces of one row of cells: F_p = -sigma.S_p + hourglass, sigma = -(p - p_ref) I + s + viscosity, all at the
// half step x + dt/2 u with S = dV/dx exact (numerics 1). The same function serves the force pass and the
// work pass, so the work is done by bitwise the same forces.
//
// In RZ: F_r = -(s_rr A_r + s_rz A_z + s_tt H) with S_r = A_r + H, F_z = -(s_rz A_r + s_zz A_z).
// The deviator is carried to the half step too, s + G dt dev(D), and cut back to the flow stress: with the
// stress of the start of the step the scheme would be (weakly) unstable for elastic waves. Mixed cells beside
// void or a fluid have no shear modulus: there the tangential stress stays that of the start.
// Viscosity acts along the cell's mid lines t_d: sigma = -sum q_d t_d t_d^T. (Along the normals of the mid
// surfaces a flat, sheared cell would feel its long axis' viscosity across its short one: unstable.)
// By option: q's coefficient on shear and hoop compression (ale/shear_viscosity), pressures of subzones (ale/subzonal_pressure).
// Hourglass: Flanagan-Belytschko, viscous, on the modes that a linear velocity field does not excite.
#pragma once

#include "ale/block.hpp"

namespace ballast {

/// Row pointers (i = 0) of everything a row of corner forces reads.
template <int Dim> struct ForceRows {
  static constexpr int lines = 1 << (Dim - 1); ///< node rows around a row of cells
  const double* x[Dim][lines];
  const double* u[Dim][lines];
  const double *pressure, *modulus, *volume, *damped_density, *wave_speed;
  const double* stress[stress_components<Dim>]; ///< null without strength
  const double *shear, *flow_stress; ///< null without strength
  const double *viscosity[Dim], *rate[Dim];
  const double* skew[2]; ///< of the first mesh (ale/subzonal_pressure), null without

  ForceRows(const Block<Dim>& block, int j, int k);

  /// The same from cell i on.
  ForceRows from(int i) const {
    ForceRows at = *this;
    for (int d = 0; d < Dim; ++d) {
      for (int l = 0; l < lines; ++l) {
        at.x[d][l] += i;
        at.u[d][l] += i;
      }
      at.viscosity[d] += i;
      at.rate[d] += i;
    }
    for (const double** row : {&at.pressure, &at.modulus, &at.volume, &at.damped_density, &at.wave_speed, &at.shear, &at.flow_stress}) {
      *row += *row != nullptr ? i : 0;
    }
    for (const double*& row : at.stress) {
      row += row != nullptr ? i : 0;
    }
    for (const double*& row : at.skew) {
      row += row != nullptr ? i : 0;
    }
    return at;
  }
};

/// Corner forces of a row: f[corner][component] points to `count` doubles.
template <int Dim> struct CornerRows {
  double* f[1 << Dim][Dim];

  /// The same from cell i on.
  CornerRows from(int i) const {
    CornerRows at = *this;
    for (auto& corner : at.f) {
      for (double*& component : corner) {
        component += i;
      }
    }
    return at;
  }
};

/// What the work pass needs besides: the volume change done by mean velocities, the compression up to
/// the half step, the work of all corner forces, and the velocity gradient times dt.
template <int Dim> struct WorkRows {
  static constexpr int gradient_components = Dim == 2 ? 5 : 9; ///< 2D: xx xy yx yy, hoop; 3D: row-major
  double *swept_volume, *compression, *work;
  double* gradient[gradient_components]; ///< null without strength

  /// The same from cell i on.
  WorkRows from(int i) const {
    WorkRows at = *this;
    at.swept_volume += i;
    at.compression += i;
    at.work += i;
    for (double*& component : at.gradient) {
      component += component != nullptr ? i : 0;
    }
    return at;
  }
};

struct ForceCoefficients {
  double dt = 0;
  double hourglass = 0.03; ///< dimensionless (LULESH: 0.01 * 3)
  double shear_q = 0; ///< part of q's coefficient that resists shear (ale/shear_viscosity)
  double subzonal = 0; ///< merit factor (ale/subzonal_pressure); 2D blocks that keep their first mesh
};

/// Forces of cells [0, count) of a row.
template <int Dim>
void corner_forces(const Block<Dim>& block,
                   const ForceRows<Dim>& in,
                   const ForceCoefficients& c,
                   int count,
                   const CornerRows<Dim>& out);

/// Work done by those forces with the mean velocity (u + u_new)/2.
template <int Dim>
void corner_work(const Block<Dim>& block,
                 const ForceRows<Dim>& in,
                 const double* const (&next_velocity)[Dim][ForceRows<Dim>::lines],
                 const ForceCoefficients& c,
                 int count,
                 const WorkRows<Dim>& out);

} // namespace ballast
