// Mesh maps: where the nodes of a curvilinear starting mesh stand, as a function of logical coordinates q, one an axis of
// the grid. A rectilinear mesh has q = place. Elsewhere, from the centre c (angles in rad, turning the grid right-handed):
//
//   polar        planar        q = (R, a)      x = R cos a, y = R sin a
//   cylindrical  3D            q = (R, a, z)   the same, z as it is
//   spherical    axisymmetric  q = (t, R)      r = R sin t, z = R cos t       (t from the axis r = 0, z > 0)
//   disc         planar        q = (u, v)      square -1..1 to a disc
//   ball_section axisymmetric  q = (u, v)      its half u >= 0 to the section of a ball, u along r, v along z
//   rod          3D            q = (u, v, z)   disc along z
//   ball         3D            q = (u, v, w)   cube -1..1 to a ball
//   turned_section axisymmetric q = (u, z)     r = u R(z), R the outline's radius, straight between its points
//   turned       3D            q = (u, v, z)   disc of radius R(z) along z
//
// Square to disc and cube to ball (n axes, outer radius A): with d = max |q_k| and p = q / d on the square's edge,
//   x = A d [ (1 - d) p / sqrt(n) + d e ],   e = tan(pi/4 p) / |tan(pi/4 p)|   (tan by component).
// Its shells d = const turn from squares at the centre to circles at the edge (e: equal angles in 2D). All agree at the
// corners, so shells never touch. Mesh lines are smooth but for a kink across the diagonals |q_k| = |q_l| = d. No cell is degenerate: the
// edge's corner cells are kites of pi/4 h^2 A^2 whose outer angle is 180 degrees less one cell's turn (a map smooth there has
// a Jacobian that vanishes). Concentric shells after Calhoun, Helzel & LeVeque, SIAM Review 50 (2008) 723.
//
// Halves and quarters (octants) are q from 0: they end on planes of symmetry.
#pragma once

#include <array>
#include <vector>

namespace ballast {

enum class MapKind { rectilinear, polar, cylindrical, spherical, disc, ball_section, rod, ball, turned_section, turned };

struct MeshMap {
  MapKind kind = MapKind::rectilinear;
  std::array<double, 3> centre = {0, 0, 0}; ///< m; of `spherical` and `ball_section` on the axis
  double outer_radius = 0;                  ///< m; disc, ball_section, rod, ball
  std::vector<std::array<double, 2>> outline = {}; ///< m; turned, turned_section: (z, R), z rising, R above 0; beyond its ends R is theirs

  bool curved() const { return kind != MapKind::rectilinear; }
};

/// Place (m) of logical coordinates; exactly in a coordinate plane at multiples of a right angle and at u, v, w = 0.
std::array<double, 3> place(const MeshMap& map, const std::array<double, 3>& q);

/// The velocity component that the surface q_axis = at is normal to, or -1: a curved or slanted surface.
int normal_component(const MeshMap& map, int axis, double at);

/// Share of a cell's mass, uniform in density, that goes to its lower node along an axis; the cell reaches from a to b in q
/// along it and has straight edges. The share of a corner, integral of N dV over the cell's volume, is the product over the axes: with R
/// and E linear in the unit cell's xi and eta, place = c + R(xi) E(eta), so dV = R dR |E x dE| (polar, cylindrical) and
/// 2 pi R^2 dR S(eta) |E x dE| with S linear between the nodes' sin t (spherical). Exact, too, on rectilinear meshes (axisymmetric: weight r)
/// and turned_section, r dr dz = u R^2 du dz with R linear in a cell; turned: along z.
/// Compromise on disc, ball_section, rod, ball and across turned: one half, and in ball_section along u as if r were u (exact in the limit at the
/// axis). Where the mesh is smooth what one cell misses its neighbour adds: second order off the curved edge.
double low_share(const MeshMap& map, bool axisymmetric, int axis, double a, double b);

} // namespace ballast
