#include "problems/surface_volume.hpp"

#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {
namespace {

/// A facet cut by the six planes of a box: at most nine corners.
struct Polygon {
  std::array<Point, 16> at{};
  std::size_t count = 0;
  void add(const Point& p) {
    at[count++] = p;
  }
};

/// The place between two points where coordinate k is x; the same bits from either end.
Point between(const Point& p, const Point& q, std::size_t k, double x) {
  const Point& a = p < q ? p : q;
  const Point& b = p < q ? q : p;
  const double t = (x - a[k]) / (b[k] - a[k]);
  Point out{};
  for (std::size_t d = 0; d < 3; ++d) {
    out[d] = a[d] + t * (b[d] - a[d]);
  }
  out[k] = x;
  return out;
}

/// The part where side * coordinate k is at least side * x.
void keep(Polygon& polygon, std::size_t k, double x, double side) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Point& a = polygon.at[i];
    const Point& b = polygon.at[(i + 1) % polygon.count];
    const bool a_in = side * (a[k] - x) >= 0, b_in = side * (b[k] - x) >= 0;
    if (a_in) {
      out.add(a);
    }
    if (a_in != b_in) {
      out.add(between(a, b, k, x));
    }
  }
  polygon = out;
}

/// Integral of (z1 - z) dA_z over what the box holds of a facet.
double height_over(const Facet& f, const Point& lo, const Point& hi) {
  Polygon polygon;
  for (const Point& p : f) {
    polygon.add(p);
  }
  for (std::size_t k = 0; k < 3 && polygon.count > 0; ++k) {
    keep(polygon, k, lo[k], 1);
    keep(polygon, k, hi[k], -1);
  }
  double sum = 0;
  for (std::size_t i = 1; i + 1 < polygon.count; ++i) {
    const Point &a = polygon.at[0], &b = polygon.at[i], &c = polygon.at[i + 1];
    const double area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    sum += area * (hi[2] - (a[2] + b[2] + c[2]) / 3);
  }
  return sum;
}

/// The two ends of what a facet leaves in the plane z; corners on it count as above it.
std::optional<std::array<Point, 2>> trace(const Facet& f, double z) {
  std::array<Point, 2> ends{};
  std::size_t found = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &a = f[i], &b = f[(i + 1) % 3];
    if ((a[2] < z) != (b[2] < z)) {
      ends[found++] = between(a, b, 2, z);
    }
  }
  return found == 2 ? std::optional(ends) : std::nullopt;
}

double sign(double x) {
  return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0;
}

/// Integral of (y1 - y) along a trace, seen along y, where it lies in the face.
double width_over(std::array<Point, 2> ends, const Point& lo, const Point& hi) {
  for (std::size_t k = 0; k < 2; ++k) {
    for (const double x : {lo[k], hi[k]}) {
      const double side = x == lo[k] ? 1.0 : -1.0;
      const bool first = side * (ends[0][k] - x) >= 0, second = side * (ends[1][k] - x) >= 0;
      if (!first && !second) {
        return 0;
      }
      if (first != second) {
        (first ? ends[1] : ends[0]) = between(ends[0], ends[1], k, x);
      }
    }
  }
  return std::abs(ends[1][0] - ends[0][0]) * (hi[1] - 0.5 * (ends[0][1] + ends[1][1]));
}

/// Length of the edge beyond the point that a trace leaves on it.
double length_beyond(const std::array<Point, 2>& ends, const Point& lo, const Point& hi) {
  if ((ends[0][1] < lo[1]) == (ends[1][1] < lo[1])) {
    return 0;
  }
  const double x = between(ends[0], ends[1], 1, lo[1])[0];
  return x < lo[0] ? 0.0 : std::max(0.0, hi[0] - x);
}

} // namespace

std::optional<double> covered_share(const SurfacePiece& piece, const Point& lo, const Point& hi) {
  constexpr double rounding = 1e-10;
  double volume = 0, area = 0, length = 0;
  for (const Facet& f : piece.facets) {
    volume -= height_over(f, lo, hi);
    if (const auto ends = trace(f, lo[2])) {
      const Point n = cross(f[1] - f[0], f[2] - f[0]);
      area -= sign(n[1]) * width_over(*ends, lo, hi);
      length -= sign(n[0]) * length_beyond(*ends, lo, hi);
    }
  }
  const Point size = hi - lo;
  const double share = (volume + size[2] * (area + size[1] * length)) / (size[0] * size[1] * size[2]);
  if (!(std::abs(share) <= 1 + rounding)) {
    return std::nullopt;
  }
  const double whole = std::abs(share - std::round(share));
  if (whole < rounding && std::abs(share) < 0.5) { // nothing or everything
    return piece.inside[0] ? 1.0 : 0.0;
  }
  return std::clamp(share < 0 ? share + 1 : share, 0.0, 1.0);
}

} // namespace ballast
