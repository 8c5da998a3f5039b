#pragma once
// Half-spaces {x : n.x <= alpha} in the unit square or cube: volume, its inverse, and slabs.
//
//   Material occupies n.x <= alpha, so n points out of it. n need not be normalised.
//   Mirrored and sorted so that 0 <= m1 <= m2 <= m3 and m1 + m2 + m3 = 1, the volume cut off by
//   m.x <= a for a <= 1/2 is
//     V = [a^3 - (a - m1)+^3 - (a - m2)+^3 - (a - m3)+^3] / (6 m1 m2 m3),   V(1 - a) = 1 - V(a)
//   V is convex in a on [0, 1/2], so Newton from the closed-form root cannot diverge.
//
// Reference: Scardovelli & Zaleski, J. Comput. Phys. 164 (2000) 228. Their cubic divides a
// difference of O(1) terms by m1; the forms here are rearranged so that no term grows as m1 -> 0.

#include <algorithm>
#include <array>
#include <cmath>

namespace ballast::remap {

template <int Dim> using Normal = std::array<double, Dim>;

namespace canonical {

// All in the mirrored, sorted frame: m ascending, non-negative, summing to 1.

inline void sort(Normal<2>& m) {
  const auto [low, high] = std::minmax(m[0], m[1]);
  m = {low, high};
}

inline void sort(Normal<3>& m) {
  const double low = std::min(m[0], m[1]);
  const double high = std::max(m[0], m[1]);
  m = {std::min(low, m[2]), std::max(low, std::min(high, m[2])), std::max(high, m[2])};
}

// Volume for 0 < a <= 1/2.
inline double corner_volume(const Normal<2>& m, double a) {
  return a < m[0] ? a * a / (2.0 * m[0] * m[1]) : (a - 0.5 * m[0]) / m[1];
}

inline double corner_volume(const Normal<3>& m, double a) {
  const auto [m1, m2, m3] = m;
  if (a < m1)
    return (a / m1) * (a / m2) * a / (6.0 * m3); // quotients first: no underflow
  if (a >= m1 + m2)
    return (a - 0.5 * (m1 + m2)) / m3;
  const double wedge = 3.0 * a * (a - m1) + m1 * m1;
  if (a <= m2)
    return wedge / (6.0 * m2 * m3);
  const double t2 = a - m2;                // <= m1: the quotients below stay small
  const double t3 = std::max(a - m3, 0.0); // <= m1 / 2
  return (wedge - (t2 / m1) * t2 * t2 - (t3 / m1) * t3 * t3) / (6.0 * m2 * m3);
}

// Offset a <= 1/2 that cuts off the volume 0 < v <= 1/2.
double corner_offset(const Normal<2>& m, double v);
double corner_offset(const Normal<3>& m, double v);

// Volume of {m.(x - 1/2) <= b}, b measured from the cell centre; volume(-b) == 1 - volume(b).
template <int Dim> inline double centred_volume(const Normal<Dim>& m, double b) {
  const double a = 0.5 - std::abs(b);
  const double v = a > 0.0 ? corner_volume(m, a) : 0.0;
  return b > 0.0 ? 1.0 - v : v;
}

// Inverse of centred_volume for a fraction in [0, 1].
template <int Dim> inline double centred_offset(const Normal<Dim>& m, double fraction) {
  const double v = std::min(fraction, 1.0 - fraction);
  const double a = v > 0.0 ? corner_offset(m, v) : 0.0;
  return fraction <= 0.5 ? a - 0.5 : 0.5 - a;
}

} // namespace canonical

// The values that n.x takes over the unit cube: [low, high].
struct PlaneRange {
  double low = 0.0;
  double high = 0.0;
};

// Sums run over sorted terms: swapping axes changes no bit.
template <int Dim> inline PlaneRange plane_range(const Normal<Dim>& n) {
  Normal<Dim> sorted = n;
  canonical::sort(sorted);
  PlaneRange range;
  for (int d = 0; d < Dim; ++d) {
    range.low += std::min(sorted[d], 0.0);
    range.high += std::max(sorted[d], 0.0);
  }
  return range;
}

// |n| sorted and scaled to sum 1; the sum of |n| must be positive.
template <int Dim> inline Normal<Dim> canonical_normal(const Normal<Dim>& n) {
  Normal<Dim> m;
  for (int d = 0; d < Dim; ++d)
    m[d] = std::abs(n[d]);
  canonical::sort(m);
  double sum = 0.0;
  for (int d = 0; d < Dim; ++d)
    sum += m[d];
  for (int d = 0; d < Dim; ++d)
    m[d] /= sum;
  return m;
}

// Volume of {x in [0,1]^Dim : n.x <= alpha}, in [0, 1]. A zero n gives 0 or 1 by the sign of alpha.
template <int Dim> inline double volume_below(const Normal<Dim>& n, double alpha) {
  const PlaneRange range = plane_range<Dim>(n);
  if (alpha >= range.high)
    return 1.0;
  if (alpha <= range.low)
    return 0.0;
  const double below = alpha - range.low;
  const double above = range.high - alpha;
  const double a = std::min(below, above) / (range.high - range.low);
  const double v = canonical::corner_volume(canonical_normal<Dim>(n), a);
  return below <= above ? v : 1.0 - v;
}

// alpha with volume_below(n, alpha) == fraction to about 1e-15; fractions outside [0, 1] are
// clipped.
template <int Dim> inline double plane_constant(const Normal<Dim>& n, double fraction) {
  const PlaneRange range = plane_range<Dim>(n);
  const double v = std::min(fraction, 1.0 - fraction);
  if (v <= 0.0 || range.high <= range.low)
    return fraction <= 0.5 ? range.low : range.high;
  const double a = canonical::corner_offset(canonical_normal<Dim>(n), v);
  const double reach = a * (range.high - range.low);
  return fraction <= 0.5 ? range.low + reach : range.high - reach;
}

// Volume of {x in [0,1]^Dim : n.x <= alpha, lo <= x[axis] <= hi}; 0 for hi <= lo.
template <int Dim>
inline double slab_volume(const Normal<Dim>& n, double alpha, int axis, double lo, double hi) {
  const double low = std::max(lo, 0.0);
  const double width = std::min(hi, 1.0) - low;
  if (width <= 0.0)
    return 0.0;
  Normal<Dim> stretched = n; // x[axis] = low + width y maps the slab to the unit cube
  stretched[axis] *= width;
  return width * volume_below<Dim>(stretched, alpha - n[axis] * low);
}

} // namespace ballast::remap
