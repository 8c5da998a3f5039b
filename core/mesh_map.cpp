#include "core/mesh_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace ballast {

namespace {

constexpr double right_angle = 0.5 * std::numbers::pi;

/// Right angles in `angle`, or -1 where it is no multiple of them.
int quarters(double angle) {
  const double n = std::round(angle / right_angle);
  return std::abs(angle / right_angle - n) < 1e-12 ? (static_cast<int>(n) % 4 + 4) % 4 : -1;
}

struct Direction {
  double cos, sin;
};
Direction direction(double angle) {
  constexpr Direction exact[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const int q = quarters(angle);
  return q >= 0 ? exact[q] : Direction{std::cos(angle), std::sin(angle)};
}

/// The square (cube) -1..1 to the disc (ball) of radius 1.
std::array<double, 3> rounded(const std::array<double, 3>& q, int n) {
  double d = 0;
  for (int k = 0; k < n; ++k) {
    d = std::max(d, std::abs(q[static_cast<std::size_t>(k)]));
  }
  std::array<double, 3> x = {0, 0, 0}, e = {0, 0, 0};
  if (d == 0) {
    return x;
  }
  double square = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
    const double p = std::abs(q[k]) == d ? std::copysign(1.0, q[k]) : std::tan(0.25 * std::numbers::pi * q[k] / d);
    e[k] = p;
    square += p * p;
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k) {
    x[k] = (1 - d) * q[k] / std::sqrt(n) + d * d * e[k] / std::sqrt(square);
  }
  return x;
}

/// Share of the lower node with weight linear from f(a) to f(b).
double linear_share(double fa, double fb) { return (2 * fa + fb) / (3 * (fa + fb)); }
/// The same with the square of that weight.
double square_share(double fa, double fb) { return (3 * fa * fa + 2 * fa * fb + fb * fb) / (4 * (fa * fa + fa * fb + fb * fb)); }

/// Radius of the outline at z.
double radius_at(const std::vector<std::array<double, 2>>& outline, double z) {
  const auto above = std::upper_bound(outline.begin(), outline.end(), z, [](double at, const auto& point) { return at < point[0]; });
  if (above == outline.begin() || above == outline.end()) {
    return above == outline.begin() ? outline.front()[1] : outline.back()[1];
  }
  const auto &a = *(above - 1), &b = *above;
  return a[1] + (z - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

} // namespace

std::array<double, 3> place(const MeshMap& map, const std::array<double, 3>& q) {
  const std::array<double, 3>& c = map.centre;
  const double a = map.outer_radius;
  switch (map.kind) {
  case MapKind::rectilinear:
    break;
  case MapKind::polar:
  case MapKind::cylindrical: {
    const Direction e = direction(q[1]);
    return {c[0] + q[0] * e.cos, c[1] + q[0] * e.sin, q[2]};
  }
  case MapKind::spherical: {
    const Direction e = direction(q[0]);
    return {c[0] + q[1] * e.sin, c[1] + q[1] * e.cos, 0};
  }
  case MapKind::disc:
  case MapKind::ball_section: {
    const auto x = rounded(q, 2);
    return {c[0] + a * x[0], c[1] + a * x[1], 0};
  }
  case MapKind::rod: {
    const auto x = rounded(q, 2);
    return {c[0] + a * x[0], c[1] + a * x[1], q[2]};
  }
  case MapKind::ball: {
    const auto x = rounded(q, 3);
    return {c[0] + a * x[0], c[1] + a * x[1], c[2] + a * x[2]};
  }
  case MapKind::turned_section:
    return {c[0] + q[0] * radius_at(map.outline, q[1]), q[1], 0};
  case MapKind::turned: {
    const auto x = rounded(q, 2);
    const double radius = radius_at(map.outline, q[2]);
    return {c[0] + radius * x[0], c[1] + radius * x[1], q[2]};
  }
  }
  return q;
}

int normal_component(const MeshMap& map, int axis, double at) {
  switch (map.kind) {
  case MapKind::rectilinear:
    return axis;
  case MapKind::polar:
  case MapKind::cylindrical: {
    const int q = axis == 1 ? quarters(at) : -1;
    return axis == 2 ? 2 : q < 0 ? -1 : 1 - q % 2;
  }
  case MapKind::spherical: {
    const int q = axis == 0 ? quarters(at) : -1;
    return q < 0 ? -1 : q % 2;
  }
  case MapKind::rod:
  case MapKind::turned:
    return axis == 2 || at == 0 ? axis : -1;
  case MapKind::turned_section:
    return axis == 1 || at == 0 ? axis : -1;
  case MapKind::disc:
  case MapKind::ball_section:
  case MapKind::ball:
    break;
  }
  return at == 0 ? axis : -1;
}

double low_share(const MeshMap& map, bool axisymmetric, int axis, double a, double b) {
  switch (map.kind) {
  case MapKind::rectilinear:
    return axisymmetric && axis == 0 ? linear_share(a, b) : 0.5;
  case MapKind::polar:
  case MapKind::cylindrical:
    return axis == 0 ? linear_share(a, b) : 0.5;
  case MapKind::spherical:
    return axis == 0 ? linear_share(direction(a).sin, direction(b).sin) : square_share(a, b);
  case MapKind::ball_section:
    return axis == 0 ? linear_share(a, b) : 0.5;
  case MapKind::turned_section:
    return axis == 0 ? linear_share(a, b) : square_share(radius_at(map.outline, a), radius_at(map.outline, b));
  case MapKind::turned:
    return axis == 2 ? square_share(radius_at(map.outline, a), radius_at(map.outline, b)) : 0.5;
  case MapKind::disc:
  case MapKind::rod:
  case MapKind::ball:
    break;
  }
  return 0.5;
}

} // namespace ballast
