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

} // namespace ballast
