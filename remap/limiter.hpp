// Limited slope of a quantity along a line, in a volume or mass coordinate with unequal spacing.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace ballast::remap {

/// All bits where t's sign bit is clear, none elsewhere; for select().
inline std::uint64_t where_positive(double t) {
  return (std::bit_cast<std::uint64_t>(t) >> 63) - 1;
}
/// yes under the mask, no elsewhere. By bits: g++ 12 moves loads behind a branch when it sees `?:`, and the
/// row loop then does not vectorise.
inline double select(std::uint64_t mask, double yes, double no) {
  const auto y = std::bit_cast<std::uint64_t>(yes), n = std::bit_cast<std::uint64_t>(no);
  return std::bit_cast<double>(n ^ ((y ^ n) & mask));
}

/// Slope of the donor value q with neighbours q_low, q_high; d_low, d_high centre distances, width
/// the donor's own. Limited so that the donor's edge values stay between the neighbours' (van
/// Leer's monotonised central); exact for linear data. unlimited > 0: the central slope (a number, since
/// g++ 12 does not vectorise a choice by an invariant flag).
inline double slope(
    double q_low, double q, double q_high, double d_low, double d_high, double width, double unlimited) {
  const double central = (q_high - q_low) / (d_low + d_high);
  const double below = 2 * (q - q_low) / width, above = 2 * (q_high - q) / width;
  // Values, not std::min's references: the row loops that call this must vectorise.
  const double a = std::abs(below), b = std::abs(above), c = std::abs(central);
  const double bound = a < b ? a : b;
  const double least = c < bound ? c : bound;
  // By sign, not by product: that would overflow beside empty cells.
  const double same_sign = std::copysign(1.0, below) * std::copysign(1.0, above) > 0 ? least : 0.0;
  return std::copysign(unlimited > 0 ? c : same_sign, central);
}

} // namespace ballast::remap
