// ContactSurface: a structured sheet of nodes that may touch another, as a view of arrays that others own.
//
// Nodes: (segments[0] + 1) by (segments[1] + 1), the first axis fastest; in 2D a polyline. Segments: four corners (two in 2D),
// bilinear. The side that touches is `outside` times the normal: X_,0 x X_,1 in 3D, the tangent turned left in 2D.
#pragma once

#include <array>
#include <cstddef>

namespace ballast {

template <int Dim> struct ContactSurface {
  static constexpr int corners = 1 << (Dim - 1);

  std::array<int, 2> segments = {1, 1};          ///< along the surface; {n, 1} in 2D
  std::array<const double*, Dim> position{};     ///< m, at the step's start
  std::array<double*, Dim> velocity{};           ///< m/s; contact changes it
  const double* mass = nullptr;                  ///< kg, > 0; around an axis of the whole ring, impulses are then a ring's
  std::array<const double*, Dim> velocity_n{};   ///< m/s, at the step's start, where forces work by the mean of both: for the energy account; or none
  std::array<const double*, Dim> force{};        ///< N, already in `velocity` as (dt + step_before)/2 force/mass (leapfrog); for the energy account; or none
  double step_before = 0;                        ///< s: 0: as this step
  std::array<const double*, Dim> fixed{};        ///< m/s: part of what moves a node that contact has no say in; or none
  double weight = 1;                             ///< a node moves by dt (weight velocity + fixed): 1/2 and velocity_n/2 where the mean moves it
  double rim = 0.1;                              ///< of a segment: so far past an outer edge its continuation still touches
  int outside = 1;                               ///< 1 or -1
  const char* alive = nullptr;                   ///< by segment, 0: a hole; none: all are there
  const unsigned char* held = nullptr;           ///< by node, bit d: no velocity along axis d; none: all free
  const double* added = nullptr;                 ///< kg, by node Dim x Dim, symmetric: mass that moves with it in some directions only (ale/layers/layer_load); or none

  double fixed_at(std::size_t d, int node) const { return fixed[d] != nullptr ? fixed[d][node] : 0.0; }
  int nodes_along(int axis) const { return axis < Dim - 1 ? segments[static_cast<std::size_t>(axis)] + 1 : 1; }
  int rows() const { return nodes_along(1); }
  int node_count() const { return nodes_along(0) * nodes_along(1); }
  int segment_count() const { return segments[0] * (Dim == 3 ? segments[1] : 1); }
  bool there(int segment) const { return alive == nullptr || alive[segment] != 0; }
  /// Corner nodes of a segment: low low, high low, low high, high high.
  std::array<int, corners> corners_of(int segment) const {
    const int j = segment / segments[0], first = segment + j; // a row has one node more than segments
    if constexpr (Dim == 3) {
      return {first, first + 1, first + nodes_along(0), first + nodes_along(0) + 1};
    } else {
      return {first, first + 1};
    }
  }
  std::array<double, Dim> place(int node) const {
    std::array<double, Dim> x;
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] = position[d][node];
    }
    return x;
  }
  /// Velocity with which a node's forces, and contact, do their work in the mean with the new one; `before`: before contact, m/s.
  double old_velocity(std::size_t d, int node, double dt, double before) const {
    const double acted = step_before > 0 ? 0.5 * (dt + step_before) : dt;
    return velocity_n[d] != nullptr ? velocity_n[d][node] : force[d] != nullptr ? before - acted * force[d][node] / mass[node] : before;
  }
  /// 1/kg; 0 along an axis that holds the node.
  double inverse_mass(int node, int axis) const { return held != nullptr && (held[node] >> axis & 1) != 0 ? 0.0 : 1 / mass[node]; }
};

/// Outward unit normal of a node, of the segments that are there around it; zero where there is none.
template <int Dim> std::array<double, Dim> node_normal(const ContactSurface<Dim>& s, int node);

/// A segment is there around the node: what is left of a sheet without it is debris.
template <int Dim> bool on_sheet(const ContactSurface<Dim>& s, int node);

/// Shares of the corners at local coordinates, 0 to 1 on the segment.
template <int Dim> std::array<double, 1 << (Dim - 1)> corner_shares(const std::array<double, 2>& local) {
  if constexpr (Dim == 3) {
    const double a = local[0], b = local[1];
    return {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
  } else {
    return {1 - local[0], local[0]};
  }
}

/// Throws Error where a surface cannot be used: no nodes, missing arrays, mass <= 0. `name`: said in the message.
template <int Dim> void check_surface(const ContactSurface<Dim>& s, const char* name);

} // namespace ballast
