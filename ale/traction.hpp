// Mixed cells with strength: materials meet at an interface with normal n and share its traction,
// not each other's strain.
//
// What closes the cell is the normal traction P_k = p_k - n.s_k.n of each material, not its
// pressure: a shell under load keeps its tangential stresses beside soft matter, and a surface
// beside void is free. Across the interface velocity gradients may jump, along it they may not
// (Hadamard): L_k = L + a_k n^T, with
//   a_k.n  from the material's own volume change: tr L_k = dV_k / V_k,
//   a_k.t  from the shear traction that all share: the one their elasticity would settle on, at most
//          what the softest can carry (nothing beside void or a fluid); what is left of the cell's
//          shear is slip, taken by what yields (or by the void).
// So what is strong neither shears nor flattens with the soft matter in its cell. The cell's stress
// is -P I + T, P = sum beta_k P_k, T = sum f_k (s_k - (n.s_k.n) I); the sum of the work it does is
// what the materials receive. n is that of one plane a cell, up to its sign: of the interface with
// the most on both sides. With three materials the other interface is taken to lie parallel to it.
#pragma once

#include "ale/closure.hpp"
#include "ale/corner_force.hpp"

#include <Eigen/Core>

namespace ballast {

/// Normal of the interface in each mixed cell of a block with strength; shear tractions cut to what it
/// carries; pressure, modulus, stress and shear modulus of the cell from it. Last of a block's state: after update_state and
/// the voids. `cut` false: they are cut already, by the run that wrote a checkpoint; cut again they would lose round-off.
template <int Dim> void update_traction(Block<Dim>& block, ThreadPool& pool, bool cut = true);

/// Deviator of a material in a cell, Pa.
template <int Dim> Eigen::Matrix3d deviator_of(const MaterialSlot& slot, int row, int i);

/// Velocity gradient times dt of a cell; 2D in RZ with the hoop strain in (2, 2).
template <int Dim> Eigen::Matrix3d gradient_of(const WorkRows<Dim>& w, int i);

/// L_k of every part that has strength, in the layout of WorkRows (`out[part]`), from L of the cell
/// and the parts' volume changes. Returns the work of s_k - (n.s_k.n) I on it, J, summed per part
/// in `work`.
template <int Dim>
void share_strain(const Block<Dim>& block,
                  const MixedCell& cell,
                  const Eigen::Vector3d& n,
                  int row,
                  int i,
                  const Eigen::Matrix3d& gradient,
                  double compression,
                  double (*out)[9],
                  double* work);

} // namespace ballast
