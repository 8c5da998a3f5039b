#include "problems/mesh_lines.hpp"
#include "problems/scene_report.hpp"
#include "problems/shapes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double inf = std::numeric_limits<double>::infinity();

/// Volume of a shape summed over an n^dim mesh of lo..hi.
double filled(const Shape& shape, Geometry geometry, Point lo, Point hi, int n) {
  double volume = 0;
  Point a{}, b{};
  const auto place = [&](std::size_t k, int i) {
    a[k] = lo[k] + (hi[k] - lo[k]) * i / n;
    b[k] = lo[k] + (hi[k] - lo[k]) * (i + 1) / n;
  };
  const int nk = geometry == Geometry::three_d ? n : 1;
  for (int k = 0; k < nk; ++k) {
    if (geometry == Geometry::three_d) {
      place(2, k);
    }
    for (int j = 0; j < n; ++j) {
      place(1, j);
      for (int i = 0; i < n; ++i) {
        place(0, i);
        volume += fraction(shape, geometry, a, b) * cell_volume(geometry, a, b);
      }
    }
  }
  return volume;
}

const Shape ball{Sphere{{0.1, -0.2, 0.3}, 1.0}};

TEST(Shapes, SphereVolumeInThreeGeometries) {
  // Midpoint lines err by about 1e-4 of a cut cell, with random sign.
  EXPECT_NEAR(
      filled(ball, Geometry::three_d, {-1.3, -1.4, -1.1}, {1.4, 1.2, 1.5}, 17), 4 * pi / 3, 2e-4);
  const Shape disc{Sphere{{0.1, -0.2, 0}, 1.0}};
  EXPECT_NEAR(filled(disc, Geometry::planar, {-1.3, -1.4, 0}, {1.4, 1.2, 0}, 23), pi, 1e-5);
  const Shape axial{Sphere{{0, 0.1, 0}, 1.0}};
  EXPECT_NEAR(
      filled(axial, Geometry::axisymmetric, {0, -1.4, 0}, {1.2, 1.3, 0}, 23), 4 * pi / 3, 1e-5);
  const Shape ring{Sphere{{2, 0, 0}, 0.5}}; // torus
  EXPECT_NEAR(filled(ring, Geometry::axisymmetric, {0, -1, 0}, {3, 1, 0}, 23),
              2 * pi * pi * 2 * 0.25,
              1e-4);
}

TEST(Shapes, CylinderAndConeVolumes) {
  const Shape rod{Cylinder{{0, 0, -0.7}, {0, 0, 0.8}, 0.6}};
  EXPECT_NEAR(filled(rod, Geometry::three_d, {-1, -1, -1}, {1, 1, 1}, 15), pi * 0.36 * 1.5, 2e-4);
  const Shape slanted{Cylinder{{-0.4, -0.3, -0.5}, {0.4, 0.3, 0.5}, 0.4}};
  EXPECT_NEAR(filled(slanted, Geometry::three_d, {-1, -1, -1}, {1, 1, 1}, 15),
              pi * 0.16 * std::sqrt(2.0),
              3e-4);
  const Shape cone{Revolved{{0, 0, -0.5}, {0, 0, 1}, {{0, 0.8}, {1.2, 0.0}}}};
  EXPECT_NEAR(
      filled(cone, Geometry::three_d, {-1, -1, -1}, {1, 1, 1}, 15), pi * 0.64 * 1.2 / 3, 2e-4);
  const Shape cone_rz{Revolved{{0, -0.5, 0}, {0, 1, 0}, {{0, 0.8}, {1.2, 0.0}}}};
  EXPECT_NEAR(filled(cone_rz, Geometry::axisymmetric, {0, -1, 0}, {1, 1, 0}, 19),
              pi * 0.64 * 1.2 / 3,
              1e-5);
}

TEST(Shapes, EachCellOfADiscIsWithinAThousandth) {
  const Shape disc{Sphere{{0, 0, 0}, 1.0}};
  const auto circle_area = [](double x0, double x1, double y0, double y1) { // fine midpoint sum
    double area = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double x = x0 + (i + 0.5) * (x1 - x0) / n;
      const double top = x < 1 ? std::sqrt(1 - x * x) : 0.0;
      area += std::clamp(top - y0, 0.0, y1 - y0) * (x1 - x0) / n;
    }
    return area;
  };
  double worst = 0;
  const double h = 0.13;
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 9; ++i) {
      const double exact = circle_area(i * h, (i + 1) * h, j * h, (j + 1) * h) / (h * h);
      const double got =
          fraction(disc, Geometry::planar, {i * h, j * h, 0}, {(i + 1) * h, (j + 1) * h, 0});
      worst = std::max(worst, std::abs(got - exact));
    }
  }
  EXPECT_LT(worst, 1e-3); // the gate
}

TEST(Shapes, EachCellAgreesWithItsParts) {
  // A cell's fraction against the mean of 4^3 parts of it, lines four times as dense: within 1e-3,
  // the gate.
  const Shape forms[] = {
      ball,
      Shape{Cylinder{{-0.4, -0.3, -0.5}, {0.4, 0.3, 0.5}, 0.4}},
      Shape{Cylinder{{0, 0, -0.7}, {0, 0, 0.8}, 0.6}},
      Shape{Revolved{{0, 0, -0.5}, {0, 0, 1}, {{0, 0.8}, {0.7, 0.8}, {1.2, 0.3}}}},
      Shape{Combination{Combination::Kind::subtract, {ball, Shape{Sphere{{0.5, 0, 0}, 0.6}}}}}};
  const int n = 8, m = 4;
  const double h = 1.6 / n; // 0.2: a third of the smallest radius
  for (const Shape& form : forms) {
    double worst = 0;
    for (int cell = 0; cell < n * n * n; ++cell) {
      const Point lo{-0.7 + h * (cell % n), -0.7 + h * (cell / n % n), -0.7 + h * (cell / n / n)};
      const double whole = fraction(form, Geometry::three_d, lo, {lo[0] + h, lo[1] + h, lo[2] + h});
      if (whole == 0 || whole == 1) {
        continue;
      }
      double parts = 0;
      for (int part = 0; part < m * m * m; ++part) {
        const Point a{lo[0] + h / m * (part % m),
                      lo[1] + h / m * (part / m % m),
                      lo[2] + h / m * (part / m / m)};
        parts += fraction(form, Geometry::three_d, a, {a[0] + h / m, a[1] + h / m, a[2] + h / m}) /
                 (m * m * m);
      }
      worst = std::max(worst, std::abs(whole - parts));
    }
    EXPECT_LT(worst, 1e-3) << describe(form);
  }
}

TEST(Shapes, AlignedBoxesAreExact) {
  const Shape box{Box{{0.25, 0.5, -inf}, {2, 3, inf}}};
  EXPECT_NEAR(fraction(box, Geometry::planar, {0, 0, 0}, {1, 1, 0}), 0.75 * 0.5, 1e-15);
  EXPECT_EQ(fraction(box, Geometry::planar, {0.25, 0.5, 0}, {1, 1, 0}), 1.0);
  EXPECT_EQ(fraction(box, Geometry::planar, {0, 0, 0}, {0.25, 1, 0}), 0.0);
  // axisymmetric: weighed with r, (1 - 0.25^2) of the ring area
  EXPECT_NEAR(fraction(box, Geometry::axisymmetric, {0, 1, 0}, {1, 2, 0}), 1 - 0.0625, 1e-14);
  const Shape cube{Box{{0.25, 0.5, 0.1}, {2, 3, 4}}};
  EXPECT_NEAR(fraction(cube, Geometry::three_d, {0, 0, 0}, {1, 1, 1}), 0.75 * 0.5 * 0.9, 1e-14);
}

TEST(Shapes, CombinationsAreSets) {
  const Shape left{HalfSpace{{0.1, 0, 0.3}, {1, 0, 0}}}, other{Sphere{{0.1, -0.2, 0.3}, 0.5}};
  const Point lo{-1.3, -1.4, -1.1}, hi{1.4, 1.2, 1.5};
  using Kind = Combination::Kind;
  const Shape half{Combination{Kind::intersect, {ball, left}}};
  EXPECT_NEAR(filled(half, Geometry::three_d, lo, hi, 15), 2 * pi / 3, 2e-4);
  const Shape shell{Combination{Kind::subtract, {ball, other}}};
  EXPECT_NEAR(filled(shell, Geometry::three_d, lo, hi, 15), 4 * pi / 3 * 0.875, 2e-4);
  const Shape both{Combination{Kind::unite, {ball, other}}};
  EXPECT_NEAR(filled(both, Geometry::three_d, lo, hi, 15), 4 * pi / 3, 2e-4);
}

TEST(Shapes, LaterShapesReplaceEarlierOnes) {
  const Shape below{Box{{0, 0, -inf}, {1, 1, inf}}}, above{Box{{0.5, 0, -inf}, {2, 1, inf}}};
  const Shape* shapes[] = {&below, &above};
  double shares[2];
  visible_fractions(shapes, Geometry::planar, {0, 0, 0}, {1, 2, 0}, shares);
  EXPECT_NEAR(shares[0], 0.25, 1e-15);
  EXPECT_NEAR(shares[1], 0.25, 1e-15);
}

TEST(Shapes, SharesOfTouchingBodiesSumToOne) {
  const Shape outside{Box{{-5, -5, -5}, {5, 5, 5}}};
  const Shape* shapes[] = {&outside, &ball};
  double shares[2];
  for (int i = 0; i < 20; ++i) {
    const double x = -1 + 0.1 * i;
    visible_fractions(shapes, Geometry::three_d, {x, 0.5, 0.6}, {x + 0.1, 0.6, 0.7}, shares);
    EXPECT_NEAR(shares[0] + shares[1], 1.0, 1e-13);
  }
}

TEST(MeshLines, MeetEndsAndGradeGeometrically) {
  const std::vector<double> x = mesh_lines({0, {8e-3, 60e-3}, {0.25e-3, 2e-3}});
  EXPECT_EQ(x.front(), 0);
  EXPECT_EQ(x.back(), 60e-3);
  EXPECT_EQ(x[32], 8e-3);
  const auto size = [&](std::size_t i) { return x[i + 1] - x[i]; };
  const double ratio = size(33) / size(32);
  for (std::size_t i = 32; i + 2 < x.size(); ++i) {
    EXPECT_NEAR(size(i + 1) / size(i), ratio, 1e-9);
  }
  EXPECT_NEAR(size(0), 0.25e-3, 1e-12);
  EXPECT_LE(size(x.size() - 2), 2e-3);
  EXPECT_EQ(x.size() - 1,
            static_cast<std::size_t>(planned_cells({0, {8e-3, 60e-3}, {0.25e-3, 2e-3}})));
}

TEST(MeshLines, SizesShrinkToFit) {
  const std::vector<double> x = mesh_lines({0, {1}, {0.3}});
  EXPECT_EQ(x.size(), 5u);
  EXPECT_DOUBLE_EQ(x[1], 0.25);
}

} // namespace
} // namespace ballast
