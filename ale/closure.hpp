// Mixed-cell closure: how the volume change and the work of a cell are shared among its materials.
//
// K_k = rho_k c_k^2, R_k = f_k / K_k, beta_k = R_k / sum R. Default: the volume change is split by beta,
// then one limited relaxation exchanges pbar dV_k with dV_k = R_k V (p_k - pbar), pbar = sum R p / sum R,
// sum dV_k = 0, so total energy closes exactly. Tipton and equal strain are options for comparison.
// Void (K = 0, p = 0) absorbs compression first; while it is there the materials keep or relax to p = 0
// and it takes what they leave.
#pragma once

#include "ale/scene.hpp"

namespace ballast {

inline constexpr int max_materials_in_cell = 16;

/// One mixed cell, materials in the order of the block; pressures are gauge (Pa). For a material with strength the
/// pressure is its normal traction p_k - n.s_k.n and the modulus K_k + 4/3 G_k (ale/traction).
struct MixedCell {
  int count = 0;
  struct Part {
    int material = 0;
    bool is_void = false;
    double volume = 0, mass = 0, energy = 0, pressure = 0, modulus = 0;
    double volume_change = 0; ///< out, m3
    double work = 0;          ///< out, pressure work of gauge pressures, J
    double slack = 0;         ///< out, m3: part's share of swept_volume - volume_change, which the work has and volume_change not
  } part[max_materials_in_cell];
};

struct CellMotion {
  double volume = 0, volume_change = 0; ///< m3, of the whole step by geometry
  double swept_volume = 0;              ///< m3, sum S.ubar dt: what the forces worked on
  double compression = 0;               ///< (V_half - V) / V
  double pressure = 0, modulus = 0;     ///< of the cell at the start, gauge
  double dt = 0;
};

/// Fills volume_change and work of every part; sum of changes = motion.volume_change, and the sum of
/// works = -(pressure - modulus * compression) * swept_volume for cells without void.
void share_volume_change(Closure closure, const CellMotion& motion, MixedCell& cell);

/// Gives a cold gas (p = K = 0) beside others a trace of their stiffness: without any its share of a change would be infinite. What is
/// stretched, or pressed past its equation of state's pole, so far that K is below its pressure (absolute; `reference`, Pa: what
/// pressures are taken against) is as stiff as it pulls or pushes: with a K near or below nothing it would swallow the cell.
void stiffen_cold(MixedCell& cell, double reference);

/// Cell pressure sum beta_k p_k and modulus 1 / sum R_k; with equal strain sum f_k p_k and sum f_k K_k; with void: the void's own.
struct CellPressure {
  double pressure = 0, modulus = 0;
};
CellPressure mixed_pressure(Closure closure, const MixedCell& cell, double void_pressure);

} // namespace ballast
