// exp(x) for row loops: the library's does not vectorise without -ffast-math.
//
// x = k ln 2 + r, |r| <= ln 2 / 2; exp(r) by its Taylor series to r^13 (remainder 4e-18), times 2^k set in
// the exponent bits. Relative error below 5e-16; the same bits on every instruction set. Below -700 it
// gives exp(-700) = 1e-304, above 700 exp(700).
#pragma once

#include <bit>
#include <cstdint>

namespace ballast {

[[gnu::always_inline]] inline double row_exp(double x) {
  constexpr double log2_e = 1.4426950408889634, ln2_high = 0x1.62e42fefa0000p-1, ln2_low = 0x1.cf79abc9e3b3ap-40;
  constexpr double to_integer = 0x1.8p52; // added and taken off: rounds, and leaves the integer in the low bits
  const double capped = x < 700 ? x : 700.0, y = capped > -700 ? capped : -700.0;
  const double shifted = y * log2_e + to_integer, k = shifted - to_integer;
  const double r = (y - k * ln2_high) - k * ln2_low;
  double sum = 1.0 / 6227020800;
  sum = sum * r + 1.0 / 479001600;
  sum = sum * r + 1.0 / 39916800;
  sum = sum * r + 1.0 / 3628800;
  sum = sum * r + 1.0 / 362880;
  sum = sum * r + 1.0 / 40320;
  sum = sum * r + 1.0 / 5040;
  sum = sum * r + 1.0 / 720;
  sum = sum * r + 1.0 / 120;
  sum = sum * r + 1.0 / 24;
  sum = sum * r + 1.0 / 6;
  sum = sum * r + 0.5;
  sum = sum * r + 1.0;
  sum = sum * r + 1.0;
  const std::uint64_t bits = (std::bit_cast<std::uint64_t>(shifted) + 1023) << 52;
  return sum * std::bit_cast<double>(bits);
}

} // namespace ballast
