// Limited slope of a quantity along a line, in a volume or mass coordinate with unequal spacing.
#pragma once

#include <algorithm>
#include <cmath>

namespace ballast::remap {

/// Slope of the donor value q with neighbours q_low, q_high; d_low, d_high centre distances, width
/// the donor's own. Limited so that the donor's edge values stay between the neighbours' (van
/// Leer's monotonised central); exact for linear data. Unlimited: the central slope.
inline double slope(
    double q_low, double q, double q_high, double d_low, double d_high, double width, bool limit) {
  const double central = (q_high - q_low) / (d_low + d_high);
  const double below = 2 * (q - q_low) / width, above = 2 * (q_high - q) / width;
  const double bound = std::min(std::abs(below), std::abs(above));
  const double limited =
      below * above > 0 ? std::copysign(std::min(std::abs(central), bound), central) : 0.0;
  return limit ? limited : central;
}

} // namespace ballast::remap
