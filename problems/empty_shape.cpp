// Shapes that intersections and differences leave nothing of.
#include "problems/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

bool is_empty(const Shape& shape, Geometry geometry, const Bounds& around) {
  Bounds b = bounds(shape);
  const auto dim = static_cast<std::size_t>(dimensions(geometry));
  for (std::size_t k = 0; k < dim; ++k) {
    b.lo[k] = std::isfinite(b.lo[k]) ? b.lo[k] : around.lo[k];
    b.hi[k] = std::isfinite(b.hi[k]) ? b.hi[k] : around.hi[k];
    b.lo[k] = geometry == Geometry::axisymmetric && k == 0 ? std::max(0.0, b.lo[k]) : b.lo[k];
    if (!std::isfinite(b.lo[k]) || !std::isfinite(b.hi[k])) {
      return false;
    }
    if (b.lo[k] >= b.hi[k]) {
      return true;
    }
  }
  constexpr double some = 1e-9; // of a piece: less is rounding
  const int n = dim == 2 ? 64 : 16, last = dim == 2 ? 1 : n;
  for (int k = 0; k < last; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const int at[3] = {i, j, k};
        Point lo{}, hi{};
        for (std::size_t d = 0; d < dim; ++d) {
          lo[d] = b.lo[d] + (b.hi[d] - b.lo[d]) * at[d] / n;
          hi[d] = b.lo[d] + (b.hi[d] - b.lo[d]) * (at[d] + 1) / n;
        }
        if (fraction(shape, geometry, lo, hi) > some) {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace ballast
