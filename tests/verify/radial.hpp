// Round flows on square meshes: what a case reads off as a function of the distance from the origin.
#pragma once

#include "tests/verify/measure.hpp"

#include <vector>

namespace ballast::verify {

/// Distance (m) of a cell's centre, the mean of its corners, from the origin.
template <int Dim> double centre_radius(const Block<Dim>& b, int i, int j, int k);

/// Density by radius: mass over volume of shells of thickness `thick` (m), empty shells left out.
template <int Dim> std::vector<TubeCell> radial_density(const Block<Dim>& b, double thick);

/// Density of the cells with centres within [from, to] of the origin.
struct Spread {
  double mean = 0, low = 0, high = 0; ///< mean by volume
};
template <int Dim> Spread density_spread(const Block<Dim>& b, double from, double to);

} // namespace ballast::verify
