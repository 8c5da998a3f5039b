// What a closed surface covers of a box, without error but rounding.
//
// Going up in z the solid begins where a facet faces down and ends where one faces up, so with the
// signed areas dA_z of the facets in the box, seen from above,
//   V = (z1 - z0) A0 - integral (z1 - z) dA_z,      A0: area of the solid in the face z = z0,
// likewise A0 from the lines the facets leave in that face and the length L0 of the solid on the
// edge y = y0, and L0 from the points they leave on the edge and the side the corner is on. That
// side is worth the whole box: whether V is between nothing and everything tells it.
#pragma once

#include "problems/closed_surface.hpp"

#include <optional>

namespace ballast {

/// Share of the box lo..hi, 0 to 1; nothing if the facets contradict each other there (a surface
/// that cuts itself).
std::optional<double> covered_share(const SurfacePiece& piece, const Point& lo, const Point& hi);

} // namespace ballast
