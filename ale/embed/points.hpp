// Points and vectors, private to ale/embed.
#pragma once

#include "ale/layers/contact_vector.hpp"

#include <array>
#include <cstddef>

namespace ballast {

template <std::size_t N> std::array<double, N> minus(const std::array<double, N>& a, const std::array<double, N>& b) {
  std::array<double, N> out{};
  for (std::size_t d = 0; d < N; ++d) {
    out[d] = a[d] - b[d];
  }
  return out;
}
inline std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Weights of a triangle's corners at its point nearest to p, by the regions of C. Ericson, Real-Time Collision Detection (2005), 5.1.5.
inline std::array<double, 3> nearest_on_triangle(const std::array<double, 3>& p, const std::array<double, 3>& a, const std::array<double, 3>& b, const std::array<double, 3>& c) {
  const std::array<double, 3> ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) {
    return {1, 0, 0};
  }
  const std::array<double, 3> bp = minus(p, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) {
    return {0, 1, 0};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const std::array<double, 3> cp = minus(p, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) {
    return {0, 0, 1};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double scale = 1 / (va + vb + vc);
  return {1 - (vb + vc) * scale, vb * scale, vc * scale};
}

} // namespace ballast
