// ContactPoint: a node on its foot while a step's impulses are found.
#pragma once

#include <array>
#include <cstddef>

namespace ballast {

/// A node in contact and what it asks for.
template <int Dim> struct ContactPoint {
  static constexpr std::size_t corners = 1 << (Dim - 1);

  std::size_t side;
  int node;
  std::array<int, corners> corner;
  std::array<double, corners> share;
  std::array<double, Dim> normal;
  double asked;  ///< opening, m/s
  double fixed;  ///< its part by velocity_n
  double per_impulse, per_slip; ///< 1/kg: opening, movement along the surface by impulse
  std::array<double, Dim> gives; ///< 1/kg: velocity of the node and, by share, of its corners from an impulse
  std::array<std::array<double, corners>, Dim> corner_gives;
  double impulse = 0;
  std::array<double, Dim> friction{};
};

/// A foot that may become a contact point.
template <int Dim> struct ContactCandidate {
  std::size_t side;
  int node, segment;
  std::array<double, 2> local;
  std::array<double, Dim> normal;
  double gap, opening; ///< opening: before contact
  bool listed;
};

} // namespace ballast
