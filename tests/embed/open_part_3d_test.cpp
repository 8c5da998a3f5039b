// Open parts of hexahedra: their gradients, what is open and what is not make the whole, what faces sweep is what cells gain.
#include "ale/embed/open_part.hpp"
#include "core/hex_geometry.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace ballast {
namespace {

/// A unit cube with its corners moved about; levels of a plane through its middle's neighbourhood.
class SomeCells {
public:
  LevelCell<3> cell() {
    LevelCell<3> c;
    for (std::size_t p = 0; p < 8; ++p) {
      const std::size_t low = p & 3;
      c.x[p] = {(low == 1 || low == 2 ? 1 : 0) + moved_(engine_), (low > 1 ? 1 : 0) + moved_(engine_), static_cast<double>(p >> 2) + moved_(engine_)};
    }
    return c;
  }
  /// Normal and distance.
  std::array<double, 4> plane() {
    std::array<double, 4> n = {any_(engine_), any_(engine_), any_(engine_), 0.3 * any_(engine_)};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (std::size_t d = 0; d < 3; ++d) {
      n[d] /= length;
    }
    return n;
  }
  double any() { return any_(engine_); }
  double moved() { return moved_(engine_); }

private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> moved_{-0.2, 0.2}, any_{-1, 1};
};

void set_levels(LevelCell<3>& c, const std::array<double, 4>& plane) {
  for (std::size_t p = 0; p < 8; ++p) {
    c.level[p] = plane[3];
    for (std::size_t d = 0; d < 3; ++d) {
      c.level[p] += plane[d] * (c.x[p][d] - 0.5);
    }
  }
}

double volume_of(const LevelCell<3>& c) {
  HexGeometry h{};
  for (std::size_t p = 0; p < 8; ++p) {
    h.x[p] = c.x[p][0];
    h.y[p] = c.x[p][1];
    h.z[p] = c.x[p][2];
  }
  return h.volume();
}

TEST(OpenPart3D, IsThatOfAPlaneInABrick) {
  LevelCell<3> c;
  for (std::size_t p = 0; p < 8; ++p) {
    const std::size_t low = p & 3;
    c.x[p] = {low == 1 || low == 2 ? 2.0 : 0.0, low > 1 ? 3.0 : 0.0, p > 3 ? 5.0 : 0.0};
    c.level[p] = c.x[p][2] - 1.7; // a slab
  }
  EXPECT_NEAR(open_volume(c, false), 2 * 3 * 3.3, 1e-14);
  for (std::size_t p = 0; p < 8; ++p) {
    c.level[p] = 1 - c.x[p][0] - c.x[p][1] - c.x[p][2]; // a corner
  }
  EXPECT_NEAR(open_volume(c, false), 1.0 / 6, 1e-14);
}

TEST(OpenPart3D, GradientsAreThoseOfTheVolume) {
  SomeCells some;
  for (int t = 0; t < 300; ++t) {
    LevelCell<3> c = some.cell();
    set_levels(c, some.plane());
    for (std::size_t p = 0; p < 8 && t % 2 == 1; ++p) { // a bent one
      c.level[p] = some.any();
    }
    const OpenPart<3> part = open_part(c, false);
    for (std::size_t p = 0; p < 8; ++p) {
      for (std::size_t d = 0; d < 4; ++d) {
        constexpr double h = 1e-6;
        if (std::abs(c.level[p]) < 1e-3) {
          continue; // there second derivatives jump
        }
        LevelCell<3> more = c, less = c;
        (d < 3 ? more.x[p][d] : more.level[p]) += h;
        (d < 3 ? less.x[p][d] : less.level[p]) -= h;
        const double by_volume = (open_volume(more, false) - open_volume(less, false)) / (2 * h);
        EXPECT_NEAR(d < 3 ? part.at_node[p][d] : part.at_level[p], by_volume, 1e-8) << t << ' ' << p << ' ' << d;
      }
    }
  }
}

TEST(OpenPart3D, AndTheRestAreTheWholeHexahedron) {
  SomeCells some;
  for (int t = 0; t < 300; ++t) {
    LevelCell<3> c = some.cell();
    set_levels(c, some.plane());
    LevelCell<3> rest = c, whole = c;
    for (double& l : rest.level) {
      l = -l;
    }
    whole.level.fill(1);
    EXPECT_NEAR(open_volume(c, false) + open_volume(rest, false), volume_of(c), 1e-14);
    EXPECT_NEAR(open_volume(whole, false), volume_of(c), 1e-14);
  }
}

/// Nodes move along one coordinate; the plane stands.
TEST(OpenPart3D, WhatFacesSweepIsWhatTheCellGains) {
  SomeCells some;
  for (int t = 0; t < 300; ++t) {
    LevelCell<3> from = some.cell();
    const std::array<double, 4> plane = some.plane();
    LevelCell<3> to = from;
    for (auto& x : to.x) {
      x[static_cast<std::size_t>(t % 3)] += some.moved();
    }
    set_levels(from, plane);
    set_levels(to, plane);
    double swept = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::size_t side : {0UL, 1UL}) {
        SweptFace<3> f;
        for (std::size_t q = 0; q < 4; ++q) { // turning as face_nodes does
          std::array<std::size_t, 3> at{};
          at[axis] = side;
          at[(axis + 1) % 3] = q == 1 || q == 2 ? 1 : 0;
          at[(axis + 2) % 3] = q > 1 ? 1 : 0;
          const std::size_t p = 4 * at[2] + (at[1] == 1 ? 3 - at[0] : at[0]);
          f.before[q] = from.x[p];
          f.after[q] = to.x[p];
          f.level_before[q] = from.level[p];
          f.level_after[q] = to.level[p];
        }
        swept += (side == 1 ? 1 : -1) * open_swept<3>(f, false);
      }
    }
    EXPECT_NEAR(open_volume(to, false) - open_volume(from, false), swept, 1e-14) << t;
  }
}

TEST(OpenPart3D, ShareOfAFace) {
  EXPECT_NEAR(open_share<3>({1, 1, -3, -3}), 0.25, 1e-15);
  EXPECT_NEAR(open_share<3>({1, -1, -3, -1}), 0.125, 1e-15); // a corner's triangle
  EXPECT_EQ(open_share<3>({1, 2, 3, 4}), 1.0);
  EXPECT_EQ(open_share<3>({-1, -2, -3, -4}), 0.0);
}

} // namespace
} // namespace ballast
