// The dot product that the parts of contact and of embedded bodies share.
#pragma once

#include <array>
#include <cstddef>

namespace ballast {

template <std::size_t N> double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < N; ++d) {
    sum += a[d] * b[d];
  }
  return sum;
}

} // namespace ballast
