// Shapes that are turned and moved: sets of points, volumes, bounds.
#include "facet_bodies.hpp"
#include "problems/scene_reader.hpp"
#include "problems/shape_placement.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>
#include <numbers>
#include <random>

namespace ballast {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double inf = std::numeric_limits<double>::infinity();
using Kind = Combination::Kind;

double filled(const Shape& shape, Geometry geometry, double reach, int n) {
  double volume = 0;
  const double side = 2 * reach / n;
  const int nk = geometry == Geometry::three_d ? n : 1;
  for (int k = 0; k < nk; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Point lo{-reach + i * side, -reach + j * side, nk > 1 ? -reach + k * side : 0.0};
        const Point hi{lo[0] + side, lo[1] + side, nk > 1 ? lo[2] + side : 0.0};
        volume += fraction(shape, geometry, lo, hi) * side * side * (nk > 1 ? side : 1.0);
      }
    }
  }
  return volume;
}

std::vector<Shape> one_of_each() {
  const Shape box{Box{{-0.5, -0.3, -0.2}, {0.6, 0.4, 0.7}}}, sphere{Sphere{{0.2, 0.1, -0.3}, 0.5}};
  return {box,
          sphere,
          Shape{Cylinder{{-0.4, 0, 0.1}, {0.5, 0.2, 0}, 0.3}},
          Shape{Revolved{{0, 0, -0.6}, {0, 0, 1}, {{0, 0.4}, {0.5, 0.5}, {1.2, 0.1}}}},
          Shape{HalfSpace{{0.1, 0, 0}, {0.6, 0.8, 0}}},
          Shape{Combination{Kind::subtract, {box, sphere}}},
          placed({rotation_about({1, 2, 3}, 0.4), {}, {}}, box),
          testing::surface_of(testing::ball_mesh({0.1, 0.2, 0}, 0.7, 2))};
}

TEST(Placement, MovesEveryShapeAsASetOfPoints) {
  const Placement at{rotation_about({0.3, -0.5, 0.8}, 0.7), {0.2, 0.1, -0.4}, {0.05, -0.3, 0.2}};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Shape& shape : one_of_each()) {
    const Shape moved = placed(at, shape);
    const Bounds b = bounds(moved);
    for (int i = 0; i < 1000; ++i) {
      const Point p{any(random), any(random), any(random)}, q = placed(at, p);
      EXPECT_EQ(contains(shape, p), contains(moved, q)) << describe(shape);
      EXPECT_NEAR(signed_distance(shape, p), signed_distance(moved, q), 1e-12) << describe(shape);
      for (std::size_t k = 0; k < 3 && contains(moved, q); ++k) {
        EXPECT_TRUE(q[k] >= b.lo[k] - 1e-12 && q[k] <= b.hi[k] + 1e-12) << describe(moved);
      }
    }
  }
}

TEST(Placement, RightAnglesAndShiftsAreExact) {
  const Shape box{Box{{1, 2, 3}, {2, 4, 7}}};
  const Shape quarter = placed({rotation_about({0, 0, 2}, pi / 2), {1, 2, 3}, {0, 0, 1}}, box);
  const auto& b = std::get<Box>(quarter.form);
  EXPECT_EQ(b.from, (Point{-1, 2, 4}));
  EXPECT_EQ(b.to, (Point{1, 3, 8}));
  const Shape flat{Box{{0, 0, -inf}, {2, 1, inf}}};
  const Shape turned_flat = placed({rotation_about({0, 0, 1}, pi / 6), {}, {}}, flat);
  EXPECT_NEAR(filled(turned_flat, Geometry::planar, 3, 30), 2.0, 1e-4);
  const Rotation r = rotation_xyz({pi / 2, pi / 2, 0}); // y to z, then z to x
  EXPECT_EQ(turned(r, Point{0, 1, 0}), (Point{1, 0, 0}));
}

TEST(Placement, TurnedBoxKeepsItsVolumeAtTwentyCells) {
  const Shape box{Box{{-0.5, -0.4, -0.3}, {0.5, 0.4, 0.3}}};
  for (const double angle : {0.1, 0.5, pi / 4}) {
    const Shape turned_box = placed({rotation_about({1, 0.4, -0.7}, angle), {}, {}}, box);
    EXPECT_NEAR(filled(turned_box, Geometry::three_d, 0.8, 20) / 0.48, 1, 1e-3); // the gate
  }
}

TEST(Placement, LensOfTwoSpheresHasItsVolume) {
  // pi (4 R + d) (2 R - d)^2 / 12 for equal spheres d apart.
  const double d = 0.9, exact = pi * (4 + d) * (2 - d) * (2 - d) / 12;
  const Shape left{Sphere{{-d / 2, 0, 0}, 1}}, right{Sphere{{d / 2, 0, 0}, 1}};
  const Shape lens{Combination{Kind::intersect, {left, right}}};
  const Placement tilted{rotation_about({1, 1, 0.3}, 0.8), {0, 0, 0}, {0.05, 0.02, -0.01}};
  EXPECT_NEAR(filled(lens, Geometry::three_d, 1.1, 20) / exact, 1, 1e-3); // the gate
  EXPECT_NEAR(filled(placed(tilted, lens), Geometry::three_d, 1.1, 20) / exact, 1, 1e-3);
  const FacetMesh ball = testing::ball_mesh({-d / 2, 0, 0}, 1, 4); // chord: 0.13 % of its volume less
  const Shape facets{Combination{Kind::intersect, {testing::surface_of(ball), right}}};
  EXPECT_NEAR(filled(facets, Geometry::three_d, 1.1, 16) / exact, 1, 3e-3);
}

// ---- from decks ----

Deck read(const std::string& geometry, const std::string& shape, SceneSpec& scene) {
  const bool flat = geometry != "3d";
  Deck deck = Deck::parse(fmt::format("title = \"t\"\ngeometry = \"{}\"\nend_time = 1\n[[body]]\nname = \"b\"\nmaterial = \"water\"\nshape = {}\n"
                                      "[mesh]\nx = {{ from = -3, to = 3, size = 1 }}\ny = {{ from = -3, to = 3, size = 1 }}\n{}",
                                      geometry, shape, flat ? "" : "z = { from = -3, to = 3, size = 1 }\n"),
                          "t.toml");
  scene = read_scene(deck);
  return deck;
}

TEST(Placement, DecksTurnThenMoveAndNest) {
  SceneSpec s;
  const Deck deck = read("3d",
                         "{ union = [ { box = { from = [0, 0, 0], to = [2, 1, 1] }, rotate = { axis = [0, 0, 1], angle = \"90 deg\" } }, "
                         "{ sphere = { centre = [1, 0, 0], radius = 1 }, rotate = { euler = [0, \"90 deg\", 0], about = [1, 0, 1] } } ], offset = [0, 0, 0.5] }",
                         s);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  const auto& both = std::get<Combination>(s.bodies[0].shape.form);
  EXPECT_EQ(std::get<Box>(both.parts[0].form).from, (Point{-1, 0, 0.5}));
  EXPECT_EQ(std::get<Box>(both.parts[0].form).to, (Point{0, 2, 1.5}));
  EXPECT_EQ(std::get<Sphere>(both.parts[1].form).centre, (Point{0, 0, 1.5}));
  SceneSpec flat;
  const Deck planar = read("planar", "{ box = { from = [0, 0], to = [2, 1] }, rotate = { angle = \"90 deg\" } }", flat);
  ASSERT_TRUE(planar.clean()) << planar.error_report();
  EXPECT_EQ(std::get<Box>(flat.bodies[0].shape.form).to[1], 2);
  Deck again = Deck::parse(write_toml(deck.root()), "resolved.toml");
  EXPECT_EQ(std::get<Combination>(read_scene(again).bodies[0].shape.form).parts.size(), 2u);
}

TEST(Placement, ResolvedDeckKeepsTheSurfacesFileAndItsSum) {
  const auto path = std::filesystem::temp_directory_path() / fmt::format("ballast_placed_{}.stl", getpid());
  const auto write = [&](double height) {
    std::ofstream out(path);
    out << "solid s\n";
    for (const Facet& f : testing::box_facets({0, 0, 0}, {1, 1, height})) {
      out << "facet\nouter loop\n";
      for (const Point& p : f) {
        out << fmt::format("vertex {} {} {}\n", p[0], p[1], p[2]);
      }
      out << "endloop\nendfacet\n";
    }
    out << "endsolid\n";
  };
  write(1);
  SceneSpec s;
  const Deck deck = read("3d", fmt::format("{{ stl = {{ file = \"{}\", units = \"m\" }}, offset = [0, 0, 1] }}", path.string()), s);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  EXPECT_EQ(bounds(s.bodies[0].shape).hi, (Point{1, 1, 2}));
  const std::string resolved = write_toml(deck.root());
  Deck same = Deck::parse(resolved, "elsewhere/resolved.toml");
  read_scene(same);
  EXPECT_TRUE(same.clean()) << same.error_report();
  write(2);
  Deck changed = Deck::parse(resolved, "resolved.toml");
  read_scene(changed);
  EXPECT_NE(changed.error_report().find("it is another one"), std::string::npos) << changed.error_report();
}

} // namespace
} // namespace ballast
