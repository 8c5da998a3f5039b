// What a mesh sees of thin things, private to ale/embed.
#pragma once

#include <algorithm>

namespace ballast {

inline constexpr double seen_slit = 0.3; ///< of `least_thickness`: a slit between layers is open where it is wider

/// Of a squared distance: what is nearer than that is nearer beyond rounding. A hidden face and the surface share edges.
inline constexpr double nearer = 1 - 1e-9;

/// Room (m) that a body lacks to `least`, shared between its lower and upper faces: where it has lost elements, since
/// that room was covered before, else below.
struct Padding {
  double below = 0, above = 0;
};
inline Padding padding(double least, double left, double lost_below, double lost_above) {
  const double need = std::max(0.0, least - left), lost = lost_below + lost_above;
  const double share = lost > 0 ? lost_below / lost : 1.0;
  return {need * share, need * (1 - share)};
}

} // namespace ballast
