// Laws of the mesh maps: planes are planes, cells are cells, mass shares are the integrals they stand for.
#include "core/hex_geometry.hpp"
#include "core/mesh_map.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace ballast {
namespace {

constexpr double pi = std::numbers::pi;
using Place = std::array<double, 3>;

Place operator-(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double determinant(const Place& a, const Place& b, const Place& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Share of corner (i, j) of the straight-edged cell on lo..hi: integral of N (times r in RZ) by 6 x 6 Gauss points.
double corner_integral(const MeshMap& map, bool rz, const Place& lo, const Place& hi, int i, int j) {
  constexpr double x[3] = {0.2386191860831969, 0.6612093864662645, 0.9324695142031521}, w[3] = {0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
  const Place p[2][2] = {{place(map, lo), place(map, {lo[0], hi[1], lo[2]})}, {place(map, {hi[0], lo[1], lo[2]}), place(map, {hi[0], hi[1], lo[2]})}};
  double part = 0, whole = 0;
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b < 6; ++b) {
      const double s = 0.5 + 0.5 * (a < 3 ? -x[a] : x[a - 3]), t = 0.5 + 0.5 * (b < 3 ? -x[b] : x[b - 3]);
      double ds[2], dt[2], r = 0;
      for (std::size_t d = 0; d < 2; ++d) {
        ds[d] = (1 - t) * (p[1][0][d] - p[0][0][d]) + t * (p[1][1][d] - p[0][1][d]);
        dt[d] = (1 - s) * (p[0][1][d] - p[0][0][d]) + s * (p[1][1][d] - p[1][0][d]);
      }
      for (int c = 0; c < 4; ++c) {
        r += (c & 1 ? s : 1 - s) * (c & 2 ? t : 1 - t) * p[c & 1][c >> 1][0];
      }
      const double dv = w[a % 3] * w[b % 3] * (ds[0] * dt[1] - ds[1] * dt[0]) * (rz ? r : 1);
      whole += dv;
      part += dv * (i ? s : 1 - s) * (j ? t : 1 - t);
    }
  }
  return part / whole;
}

TEST(MeshMap, SharesOfSectorsAreTheirIntegrals) {
  struct Case {
    MapKind kind;
    bool rz;
    Place lo, hi;
  };
  for (const Case& c : {Case{MapKind::polar, false, {0.3, 0.4, 0}, {0.7, 0.9, 0}},
                        Case{MapKind::cylindrical, false, {2, -0.4, 0}, {2.1, 0.1, 1}},
                        Case{MapKind::spherical, true, {0, 0.2, 0}, {0.5, 0.9, 0}},
                        Case{MapKind::spherical, true, {0.3, 1, 0}, {0.5, 1.3, 0}},
                        Case{MapKind::spherical, true, {2.9, 0.2, 0}, {pi, 0.3, 0}},
                        Case{MapKind::turned_section, true, {0, 0.1, 0}, {0.2, 0.35, 0}},
                        Case{MapKind::turned_section, true, {0.8, 0.4, 0}, {1, 0.9, 0}}}) {
    const MeshMap map{c.kind, {0, 0.1, 0}, 0, {{0, 3}, {0.4, 2}, {1, 0.5}}};
    for (int corner = 0; corner < 4; ++corner) {
      double share = 1;
      for (int axis = 0; axis < 2; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double low = low_share(map, c.rz, axis, c.lo[a], c.hi[a]);
        share *= (corner >> axis & 1) != 0 ? 1 - low : low;
      }
      EXPECT_NEAR(share, corner_integral(map, c.rz, c.lo, c.hi, corner & 1, corner >> 1), 1e-14);
    }
  }
}

TEST(MeshMap, PlanesOfSymmetryAreExact) {
  const MeshMap polar{MapKind::polar, {0.1, 0.3, 0}, 0}, sphere{MapKind::spherical, {0, 0.7, 0}, 0};
  for (int q = -4; q <= 4; ++q) {
    const double angle = q * (pi / 2);
    const auto c = static_cast<std::size_t>(normal_component(polar, 1, angle));
    EXPECT_EQ(c, q % 2 == 0 ? 1u : 0u);
    EXPECT_EQ(place(polar, {0.37, angle, 0})[c], polar.centre[c]);
  }
  for (int q = 0; q <= 2; ++q) {
    const double angle = q * (pi / 2);
    const auto c = static_cast<std::size_t>(normal_component(sphere, 0, angle));
    EXPECT_EQ(c, q == 1 ? 1u : 0u);
    EXPECT_EQ(place(sphere, {angle, 0.37, 0})[c], sphere.centre[c]);
  }
  EXPECT_EQ(normal_component(polar, 1, 1.0), -1);
  EXPECT_EQ(normal_component(polar, 0, 1.0), -1);
  for (const MapKind kind : {MapKind::disc, MapKind::ball_section, MapKind::rod, MapKind::ball}) {
    const MeshMap map{kind, {0, 0, 0}, 2};
    for (int axis = 0; axis < (kind == MapKind::ball ? 3 : 2); ++axis) {
      EXPECT_EQ(normal_component(map, axis, 0), axis);
      EXPECT_EQ(normal_component(map, axis, 1), -1);
      Place q = {0.3, -0.8, kind == MapKind::ball ? 0.6 : 0.0};
      q[static_cast<std::size_t>(axis)] = 0;
      EXPECT_EQ(place(map, q)[static_cast<std::size_t>(axis)], 0);
    }
  }
}

/// Places of u and z, and of the larger of u and v, are on the outline; beyond its ends it goes on as it is there.
TEST(MeshMap, TurnedMeshesLieOnTheirOutline) {
  const std::vector<std::array<double, 2>> outline = {{-2, 3}, {-1.6, 2}, {-1, 0.5}};
  const auto radius = [](double z) { return z < -2 ? 3 : z < -1.6 ? 2 + (-1.6 - z) / 0.4 : z < -1 ? 0.5 + 1.5 * (-1 - z) / 0.6 : 0.5; };
  const MeshMap section{MapKind::turned_section, {0, 0, 0}, 0, outline}, solid{MapKind::turned, {0.25, 0.5, 0}, 0, outline};
  for (const double z : {-2.1, -2.0, -1.83, -1.6, -1.2, -1.0, -0.7}) {
    EXPECT_NEAR(place(section, {1, z, 0})[0], radius(z), 1e-14);
    EXPECT_NEAR(place(section, {0.3, z, 0})[0], 0.3 * radius(z), 1e-14);
    EXPECT_EQ(place(section, {0, z, 0})[0], 0);
    EXPECT_EQ(place(section, {0.3, z, 0})[1], z);
    for (const double v : {-1.0, -0.4, 0.0, 0.7}) {
      const Place p = place(solid, {1, v, z});
      EXPECT_NEAR(std::hypot(p[0] - 0.25, p[1] - 0.5), radius(z), 1e-14);
      EXPECT_EQ(place(solid, {0, v, z})[0], 0.25); // the plane between halves
      EXPECT_EQ(p[2], z);
    }
  }
  EXPECT_EQ(place(section, {1, -1.6, 0})[0], 2); // its points are met
  EXPECT_EQ(normal_component(section, 0, 0), 0);
  EXPECT_EQ(normal_component(section, 0, 1), -1);
  EXPECT_EQ(normal_component(section, 1, -2), 1);
  EXPECT_EQ(normal_component(solid, 1, 0), 1);
  EXPECT_EQ(normal_component(solid, 1, 1), -1);
  EXPECT_EQ(normal_component(solid, 2, -1), 2);
}

/// The edge of the square is a circle, that of the cube a sphere; the shells never turn back.
TEST(MeshMap, ShellsOfTheBallGrowFromSquaresToSpheres) {
  for (const MapKind kind : {MapKind::disc, MapKind::ball}) {
    const MeshMap map{kind, {0, 0, 0}, 2};
    const bool solid = kind == MapKind::ball;
    for (int a = -10; a <= 10; ++a) {
      for (int b = solid ? -10 : 0; b <= (solid ? 10 : 0); ++b) {
        double before = 0;
        for (int q = 1; q <= 20; ++q) {
          const double d = q / 20.0;
          const Place x = place(map, {d, d * a / 10, d * b / 10});
          const double radius = std::hypot(x[0], x[1], x[2]);
          EXPECT_GT(radius, before + 0.5 * 2 / 20 / (solid ? std::sqrt(3) : std::sqrt(2)));
          before = radius;
        }
        EXPECT_NEAR(before, 2, 1e-14);
      }
    }
  }
}

/// Every corner of every cell turns the right way, and no cell is small: of the square's mesh, h^2 pi / 4 on the mean.
TEST(MeshMap, NoCellOfTheDiscIsDegenerate) {
  for (const int n : {2, 4, 8, 16, 64}) {
    const MeshMap map{MapKind::disc, {0, 0, 0}, 1};
    const double h = 2.0 / n;
    double area = 0, least = 1e9, most = 0;
    const auto at = [&](int i, int j) { return place(map, {-1 + h * i, -1 + h * j, 0}); };
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Place p[4] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        for (int c = 0; c < 4; ++c) {
          EXPECT_GT(determinant(p[(c + 1) & 3] - p[c], p[(c + 3) & 3] - p[c], {0, 0, 1}), 1e-3 * h * h * h);
        }
        const QuadGeometry<false> q{{p[0][0], p[1][0], p[2][0], p[3][0]}, {p[0][1], p[1][1], p[2][1], p[3][1]}};
        area += q.volume();
        least = std::min(least, q.volume());
        most = std::max(most, q.volume());
      }
    }
    EXPECT_GT(least, 0.45 * h * h);
    EXPECT_LT(most, 1.25 * h * h);
    EXPECT_NEAR(area, pi, 1.1 * h * h * pi * pi * pi / 96); // chords of pi h / 4
  }
}

TEST(MeshMap, NoCellOfTheBallIsDegenerate) {
  for (const int n : {2, 4, 8, 16}) {
    const MeshMap map{MapKind::ball, {0, 0, 0}, 1};
    const double h = 2.0 / n;
    double volume = 0, least = 1e9;
    for (int cell = 0; cell < n * n * n; ++cell) {
      const int i = cell % n, j = cell / n % n, k = cell / (n * n);
      Place p[8];
      HexGeometry hex{};
      for (int c = 0; c < 8; ++c) {
        const int di = (c & 3) == 1 || (c & 3) == 2, dj = (c & 2) != 0, dk = c >> 2;
        p[c] = place(map, {-1 + h * (i + di), -1 + h * (j + dj), -1 + h * (k + dk)});
        hex.x[c] = p[c][0];
        hex.y[c] = p[c][1];
        hex.z[c] = p[c][2];
      }
      static constexpr int next[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
      for (int c = 0; c < 8; ++c) {
        EXPECT_GT(determinant(p[next[c][0]] - p[c], p[next[c][1]] - p[c], p[next[c][2]] - p[c]), 1e-4 * h * h * h * h) << n << " " << i << " " << j << " " << k;
      }
      volume += hex.volume();
      least = std::min(least, hex.volume());
    }
    EXPECT_GT(least, 0.15 * h * h * h);
    EXPECT_NEAR(volume, 4 * pi / 3, 2.0 * h * h);
  }
}

} // namespace
} // namespace ballast
