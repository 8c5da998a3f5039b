// Laws of the polygons drawn for reconstructed materials.
#include "remap/polygon.hpp"

#include <gtest/gtest.h>
#include <random>

namespace ballast::remap {
namespace {

constexpr Quad unit_quad = {{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};

Hexahedron affine_hexahedron(const std::array<Point<3>, 3>& edges) {
  Hexahedron cell;
  for (int corner = 0; corner < 8; ++corner)
    for (int d = 0; d < 3; ++d)
      cell[corner][d] = (corner & 1) * edges[0][d] + ((corner >> 1) & 1) * edges[1][d] +
                        ((corner >> 2) & 1) * edges[2][d];
  return cell;
}

const Hexahedron unit_cube =
    affine_hexahedron({{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}});

template <int Dim> class RandomPlane {
public:
  Normal<Dim> normal() {
    Normal<Dim> n;
    for (double& component : n)
      component = symmetric_(random_);
    return n;
  }
  double fraction() { return 0.5 + 0.499 * symmetric_(random_); }

private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> symmetric_{-1.0, 1.0};
};

TEST(Polygon, AreaIsTheVolumeFraction) {
  RandomPlane<2> random;
  for (int k = 0; k < 10000; ++k) {
    const Normal<2> n = random.normal();
    const double fraction = random.fraction();
    const Interface<2> plane = {n, plane_constant<2>(n, fraction)};
    const double inside = polygon_area(material_polygon(unit_quad, nullptr, &plane));
    const double outside = polygon_area(material_polygon(unit_quad, &plane, nullptr));
    EXPECT_NEAR(inside, fraction, 1e-14);
    EXPECT_NEAR(inside + outside, 1.0, 1e-14);
  }
}

TEST(Polygon, LayerBetweenParallelPlanesHasTheirDifference) {
  RandomPlane<2> random;
  const Quad sheared = {{{1.0, 2.0}, {3.0, 2.5}, {3.5, 4.5}, {1.5, 4.0}}}; // area 3.75, affine
  for (int k = 0; k < 10000; ++k) {
    const Normal<2> n = random.normal();
    const auto [low, high] = std::minmax({random.fraction(), random.fraction()});
    const Interface<2> inner = {n, plane_constant<2>(n, low)};
    const Interface<2> outer = {n, plane_constant<2>(n, high)};
    const double area = polygon_area(material_polygon(sheared, &inner, &outer));
    EXPECT_NEAR(area, 3.75 * (high - low), 1e-13);
  }
}

TEST(Polygon, WholeCellKeepsItsCorners) {
  const Quad cell = {{{0.0, 0.0}, {2.0, 0.1}, {1.7, 1.5}, {-0.2, 1.0}}};
  const Polygon<2> whole = material_polygon(cell, nullptr, nullptr);
  ASSERT_EQ(whole.count, 4);
  for (int k = 0; k < 4; ++k)
    EXPECT_EQ(whole.points[k], cell[k]);
}

TEST(Polygon, EmptyMaterialHasNoPolygon) {
  const Interface<2> none = {{1.0, 0.0}, -0.1};
  EXPECT_EQ(material_polygon(unit_quad, nullptr, &none).count, 0);
  const Interface<3> miss = {{1.0, 0.0, 0.0}, 1.5};
  EXPECT_EQ(interface_facet(unit_cube, miss).count, 0);
}

TEST(Polygon, FacetAreaIsTheDerivativeOfVolume) {
  RandomPlane<3> random;
  for (int k = 0; k < 2000; ++k) {
    const Normal<3> n = random.normal();
    const double alpha = plane_constant<3>(n, random.fraction());
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const double area = polygon_area(interface_facet(unit_cube, {n, alpha}));
    const double h = 1e-6 * length;
    const double rate = volume_below<3>(n, alpha + h) - volume_below<3>(n, alpha - h);
    // Central difference: round-off 1e-10, truncation h^2 V''' (unbounded only near kinks).
    EXPECT_NEAR(area, rate / (2.0 * h) * length, 1e-5);
  }
}

TEST(Polygon, FacetLiesInThePlaneAndWindsAboutTheNormal) {
  RandomPlane<3> random;
  for (int k = 0; k < 2000; ++k) {
    const Normal<3> n = random.normal();
    const double alpha = plane_constant<3>(n, random.fraction());
    const Polygon<3> facet = interface_facet(unit_cube, {n, alpha});
    ASSERT_GE(facet.count, 3);
    ASSERT_LE(facet.count, 6);
    for (int c = 0; c < facet.count; ++c) {
      const Point<3>& p = facet.points[c];
      const Point<3>& q = facet.points[(c + 1) % facet.count];
      const Point<3>& r = facet.points[(c + 2) % facet.count];
      EXPECT_NEAR(n[0] * p[0] + n[1] * p[1] + n[2] * p[2], alpha, 1e-14);
      double turn = 0.0;
      for (int d = 0; d < 3; ++d) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        turn += n[d] * ((q[e] - p[e]) * (r[f] - q[f]) - (q[f] - p[f]) * (r[e] - q[e]));
      }
      EXPECT_GE(turn, -1e-14);
    }
  }
}

TEST(Polygon, FacetMapsWithTheCell) {
  const Hexahedron box = affine_hexahedron({{{2.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 4.0}}});
  EXPECT_NEAR(polygon_area(interface_facet(box, {{0.0, 0.0, 1.0}, 0.3})), 6.0, 1e-14);
  EXPECT_NEAR(polygon_area(interface_facet(box, {{-1.0, 0.0, 0.0}, -0.3})), 12.0, 1e-14);
}

TEST(Polygon, SegmentKeepsMaterialOnItsLeft) {
  RandomPlane<2> random;
  for (int k = 0; k < 2000; ++k) {
    const Normal<2> n = random.normal();
    const Polygon<2> segment =
        interface_facet(unit_quad, {n, plane_constant<2>(n, random.fraction())});
    ASSERT_EQ(segment.count, 2);
    const Point<2>& a = segment.points[0];
    const Point<2>& b = segment.points[1];
    // Left of (b - a) is (-dy, dx), which must point against n.
    EXPECT_LE(-(b[1] - a[1]) * n[0] + (b[0] - a[0]) * n[1], 0.0);
  }
}

} // namespace
} // namespace ballast::remap
