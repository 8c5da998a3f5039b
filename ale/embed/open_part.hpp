// The open part of a cell: what a body inside the mesh leaves of it.
//
// Nodes carry a level, the signed distance to the body (positive outside); along an edge it is taken as linear, so the body's
// surface crosses an edge between levels a > 0 > b at a / (a - b) of its length, and joins the crossings straight. For a plane
// surface that is exact, for a curved one second order, and two cells that share a face see the same opening of it.
//   dT = sum_p G_p.dx_p + L_p dlevel_p,   G = dT/dx at fixed levels, L = dT/dlevel
// so with level = distance, dlevel_p = n_p.(dx_p - dy_p), y the surface's foot of the node: pressure p pushes node p by
// p (G_p + L_p n_p) and the body by -p L_p n_p. The sum of both is zero, and no shear reaches the body.
#pragma once

#include <array>

namespace ballast {

template <int Dim> struct OpenPart {
  static constexpr int corners = 1 << Dim;
  double volume = 0;                                   ///< m3, around an axis of the whole ring
  std::array<std::array<double, Dim>, corners> at_node = {}; ///< G, m2
  std::array<double, corners> at_level = {};           ///< L, m2
};

/// Corner positions (m) and levels (m) of a cell, in the order of the corner forces.
template <int Dim> struct LevelCell {
  static constexpr int corners = 1 << Dim;
  std::array<std::array<double, Dim>, corners> x = {};
  std::array<double, corners> level = {};

  bool covered() const {
    bool all = true;
    for (const double l : level) {
      all = all && !(l > 0);
    }
    return all;
  }
};

template <int Dim> OpenPart<Dim> open_part(const LevelCell<Dim>& cell, bool axisymmetric);

/// Its volume alone.
template <int Dim> double open_volume(const LevelCell<Dim>& cell, bool axisymmetric);

/// Open part (m3) of what a face sweeps, signed: positive along its axis. The face's corners before and after the motion, turning as
/// the face of remap/swept does; 2D: two corners.
template <int Dim> struct SweptFace {
  static constexpr int corners = 1 << (Dim - 1);
  std::array<std::array<double, Dim>, corners> before = {}, after = {};
  std::array<double, corners> level_before = {}, level_after = {};
};
template <int Dim> double open_swept(const SweptFace<Dim>& face, bool axisymmetric);

/// Open share of a face by its corners' levels, as of one whose edges are alike.
template <int Dim> double open_share(const std::array<double, 1 << (Dim - 1)>& level);

} // namespace ballast
