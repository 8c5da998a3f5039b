// Limited rise of a quantity from the middle of a donor to the middle of what leaves it, in a volume or mass
// coordinate with unequal spacing.
//
// Van Leer's monotonised central slope times a distance: min(|central|, 2 |below|, 2 |above|), which keeps the
// donor's edge values between its neighbours' and is exact for linear data. The divisions depend on the
// coordinate alone, so they are made once a face (RiseFactors) for all the quantities it carries.
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

/// distance / (spacing to the cell behind + to the cell ahead) and 2 distance / the donor's width; both zero
/// where the donor has no slope.
struct RiseFactors {
  double central, edge;
};
[[gnu::always_inline]] inline RiseFactors rise_factors(double behind, double ahead, double width, double distance) {
  return {distance / (behind + ahead), 2 * distance / width};
}

/// Rise of q along the flow, from the donor's value q with the neighbours it comes from (behind) and goes to
/// (ahead). unlimited > 0: the central slope (a number, since g++ 12 does not vectorise a choice by an
/// invariant flag).
[[gnu::always_inline]] inline double limited_rise(double behind, double q, double ahead, double central, double edge, double unlimited) {
  const double whole = ahead - behind, below = q - behind, above = ahead - q;
  // Values, not std::min's references: the row loops that call this must vectorise.
  const double a = std::abs(below), b = std::abs(above), c = std::abs(whole) * central;
  const double bound = (a < b ? a : b) * edge;
  const double least = c < bound ? c : bound;
  // By sign, not by product: that would overflow beside empty cells.
  const double same_sign = std::copysign(1.0, below) * std::copysign(1.0, above) > 0 ? least : 0.0;
  return std::copysign(unlimited > 0 ? c : same_sign, whole);
}

} // namespace ballast::remap
