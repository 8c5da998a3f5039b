// Stacks face to face inside a mesh: where two are as close as the layers of one may be without the mesh seeing a slit (ale/embed/padding), their faces
// there are hidden and the body is what both cover together.
#pragma once

#include "ale/embed/layer_body.hpp"
#include "ale/embed/padding.hpp"
#include "ale/embed/points.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ballast {

template <int Dim> struct StackFoot {
  int stack = 0;
  BodyFoot<Dim> foot;
};

/// Where a point stands to several stacks together.
template <int Dim> struct JoinedFeet {
  bool closed = false;                ///< a slit between two of them is: else each is for itself
  bool inside = false;
  std::vector<StackFoot<Dim>> feet;   ///< on what is left of their surfaces: the nearest; of a point inside the nearest on its other side, too. None: too deep inside
};

/// Is the slit between a lower and an upper face closed where a point's feet are? `seen` (m): a wider one is not.
template <int Dim> bool slit_is_closed(const std::array<double, Dim>& x, const BodyFoot<Dim>& lower, const BodyFoot<Dim>& upper, double seen) {
  if (lower.side != 1 || upper.side != 0 || !(dot(lower.normal, upper.normal) < 0)) {
    return false;
  }
  std::array<double, Dim> way{}; // from foot to foot
  for (std::size_t d = 0; d < Dim; ++d) {
    way[d] = (x[d] - upper.level * upper.normal[d]) - (x[d] - lower.level * lower.normal[d]);
  }
  const double gap = dot(way, lower.normal), along = dot(way, way) - gap * gap;
  return gap <= seen && along <= 0.25 * seen * seen; // else one lies beyond the other's end
}

/// `near`: stacks within reach with the point's nearest foot on each, from the lowest. seen(normal), m: a slit across it that is wider is
/// open. foot_on(stack, side, foot): the foot on a side, if there is one.
template <int Dim, class Seen, class FootOn> JoinedFeet<Dim> join_feet(const std::array<double, Dim>& x, const std::vector<StackFoot<Dim>>& near, const Seen& seen, FootOn&& foot_on) {
  JoinedFeet<Dim> out;
  std::vector<std::array<bool, 2>> hidden(near.size(), {false, false}); // lower and upper faces
  for (std::size_t a = 0; a < near.size(); ++a) {
    out.inside = out.inside || !(near[a].foot.level > 0);
    for (std::size_t b = a + 1; b < near.size(); ++b) {
      BodyFoot<Dim> lower, upper;
      if (foot_on(near[a].stack, 1, lower) && foot_on(near[b].stack, 0, upper) && slit_is_closed<Dim>(x, lower, upper, seen(lower.normal))) {
        hidden[a][1] = hidden[b][0] = out.closed = true;
        out.inside = out.inside || (lower.level > 0 && upper.level > 0);
      }
    }
  }
  if (!out.closed) {
    return out;
  }
  const auto take = [&](const StackFoot<Dim>& f) { // nearest first, one a side of a point inside
    auto at = out.feet.begin();
    while (at != out.feet.end() && std::abs(at->foot.level) <= std::abs(f.foot.level)) {
      ++at;
    }
    out.feet.insert(at, f);
  };
  for (std::size_t a = 0; a < near.size(); ++a) {
    if (!out.inside && (near[a].foot.side > 1 || !hidden[a][static_cast<std::size_t>(near[a].foot.side)])) {
      take(near[a]);
    }
    for (int side = 0; side < 2 && out.inside; ++side) {
      StackFoot<Dim> f{near[a].stack, {}};
      if (!hidden[a][static_cast<std::size_t>(side)] && foot_on(f.stack, side, f.foot)) {
        f.foot.level = -std::abs(f.foot.level);
        take(f);
      }
    }
  }
  if (!out.inside && !out.feet.empty()) {
    out.feet.resize(1);
  } else if (out.inside) {
    const auto same = [&](const StackFoot<Dim>& f) { return f.foot.side == out.feet.front().foot.side; };
    out.feet.erase(std::remove_if(out.feet.begin() + (out.feet.empty() ? 0 : 1), out.feet.end(), same), out.feet.end());
    out.feet.resize(std::min<std::size_t>(out.feet.size(), out.feet.empty() || out.feet.front().foot.side > 1 ? 1 : 2));
  }
  return out;
}

} // namespace ballast
