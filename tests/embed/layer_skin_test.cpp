// The body of a stack in 3D: what its layers and closed slits cover, its distance, and which of its faces are the surface.
#include "ale/embed/layer_body.hpp"
#include "tests/layers/stacks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double mm = 1e-3;
constexpr int side = 6;

/// Two layers, 6 mm square and 1 mm thick each, free edges; the lower one lacks its first 3 x 3 elements.
LayerStack<3> torn_stack() {
  LayerInput in;
  in.name = "two";
  in.model = HookeSolid{1e9, 0.3, 1000};
  in.lines[0] = in.lines[1] = even_lines(0, side * mm, side);
  in.levels = even_lines(0, 2 * mm, 2);
  in.layers = 2;
  LayerStack<3> s = make_stack<3>(in);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      s.alive[s.element(i, j, 0)] = 0;
    }
  }
  return s;
}

template <class Move> void move_layer(LayerStack<3>& s, int layer, Move&& move) {
  for (const int plane : {2 * layer, 2 * layer + 1}) {
    for (int j = 0; j <= side; ++j) {
      for (int i = 0; i <= side; ++i) {
        const std::size_t n = s.node(i, j, plane);
        move(s.position[0][n], s.position[1][n], s.position[2][n]);
      }
    }
  }
}

LayerBody<3> body_of(const LayerStack<3>& s, double least, double bin = 0.7 * mm) {
  ThreadPool one(1);
  return LayerBody<3>(s, s.alive, std::vector<double>((side + 1) * (side + 1), least), bin, one);
}

/// The lower layer slid under the upper one, both bent, the upper one stretched far past where it was.
LayerStack<3> bent_stack() {
  LayerStack<3> s = torn_stack();
  move_layer(s, 0, [](double& x, double& y, double& z) {
    z += 20 * x * x - 10 * x * y;
    x += 0.6 * mm;
    y += 0.3 * mm;
  });
  move_layer(s, 1, [](double& x, double& y, double& z) {
    z += 20 * x * x - 10 * x * y + 0.2 * mm;
    x *= 1.4;
  });
  return s;
}

double level_at(const LayerBody<3>& body, double x, double y, double z) {
  BodyFoot<3> foot;
  EXPECT_TRUE(body.foot({x * mm, y * mm, z * mm}, 3 * mm, foot)) << x << ' ' << y << ' ' << z;
  double sum = 0, square = 0;
  for (std::size_t q = 0; q < 4; ++q) {
    sum += foot.weight[q];
  }
  for (const double n : foot.normal) {
    square += n * n;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_NEAR(square, 1, 1e-9);
  return foot.level / mm;
}

/// Volume that the body covers, by counting (mm3).
double enclosed(const LayerBody<3>& body) {
  constexpr double step = 0.1;
  int count = 0;
  for (double x = -0.5 + 0.37 * step; x < side + 1.5; x += step) {
    for (double y = -0.5 + 0.41 * step; y < side + 1.5; y += step) {
      for (double z = -1 + 0.43 * step; z < 3.5; z += step) {
        BodyFoot<3> foot;
        count += body.foot({x * mm, y * mm, z * mm}, 3 * mm, foot) && foot.level < 0 ? 1 : 0;
      }
    }
  }
  return count * step * step * step;
}

TEST(LayerSkin, DistancesAreThoseOfTheBoxes) {
  const LayerBody<3> body = body_of(torn_stack(), 0.3 * mm);
  EXPECT_NEAR(level_at(body, 1.3, 1.4, 2.5), 0.5, 1e-12);   // above
  EXPECT_NEAR(level_at(body, 4.3, 4.4, -0.6), 0.6, 1e-12);  // below
  EXPECT_NEAR(level_at(body, 1.3, 1.4, 0.8), 0.2, 1e-12);   // in the hole, under the second layer
  EXPECT_NEAR(level_at(body, 2.7, 1.4, 0.4), 0.3, 1e-12);   // in the hole, beside its rim
  EXPECT_NEAR(level_at(body, 4.3, 4.4, 1.1), -0.9, 1e-12);  // between the layers: what hides there is no surface
  EXPECT_NEAR(level_at(body, 6.3, 6.4, 2.0 + 1.2), 1.3, 1e-12); // off a corner
  EXPECT_NEAR(level_at(body, 3.3, 5.0, 0.4), -0.4, 1e-12);
}

TEST(LayerSkin, HoldsWhatIsLeftWhereLayersHaveSlid) {
  for (const double slide : {0.0, 0.6, -0.4}) {
    LayerStack<3> s = torn_stack();
    move_layer(s, 0, [&](double& x, double& y, double&) {
      x += slide * mm;
      y += 0.5 * slide * mm;
    });
    EXPECT_NEAR(enclosed(body_of(s, 0.3 * mm)), 63, 0.02 * 63) << slide;
  }
}

/// Slits are closed up to 0.3 of the least thickness, here 1 mm: then their room is the body's. The lower layer ends at 27 mm2, over which the slit lies.
TEST(LayerSkin, ClosesNarrowSlitsOnly) {
  for (const double slit : {0.1, 0.25, 0.35, 0.6}) {
    LayerStack<3> s = torn_stack();
    move_layer(s, 1, [&](double&, double&, double& z) { z += slit * mm; });
    EXPECT_NEAR(enclosed(body_of(s, 1 * mm)), 63 + (slit < 0.3 ? 27 * slit : 0), 0.03 * 63) << slit;
  }
}

/// Columns and the patch looked at first, whichever side's it is, only save time.
TEST(LayerSkin, FootIsTheSameHoweverItIsFound) {
  const LayerStack<3> s = bent_stack();
  const LayerBody<3> columns = body_of(s, 0.3 * mm), all = body_of(s, 0.3 * mm, 1);
  int start = -1, found = 0;
  for (double x = -1.13; x < 10; x += 0.7) {
    for (double y = -1.07; y < 8; y += 0.7) {
      for (double z = -2.03; z < 4; z += 0.4) {
        for (const int of : {-1, 0, 1}) {
          const std::array<double, 3> point = {x * mm, y * mm, z * mm};
          BodyFoot<3> a, b;
          ASSERT_EQ(columns.foot(point, 2 * mm, a, of, &start), all.foot(point, 2 * mm, b, of)) << x << ' ' << y << ' ' << z << " side " << of;
          EXPECT_EQ(a.level, b.level) << x << ' ' << y << ' ' << z << " side " << of;
          EXPECT_EQ(a.node, b.node);
          EXPECT_EQ(a.normal, b.normal);
          EXPECT_EQ(a.side, b.side);
          ++found;
        }
      }
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(LayerSkin, IsTheSameOnAnyThreads) {
  const LayerStack<3> s = bent_stack();
  ThreadPool one(1), three(3);
  const std::vector<double> least((side + 1) * (side + 1), 0.8 * mm);
  const Skin a = find_skin(s, s.alive, least, one), b = find_skin(s, s.alive, least, three);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  EXPECT_GT(a.patches.size(), 2u * 2 * side * side); // some are cut
  for (std::size_t p = 0; p < a.patches.size(); ++p) {
    EXPECT_EQ(a.patches[p].node, b.patches[p].node);
    EXPECT_EQ(a.patches[p].low, b.patches[p].low);
    EXPECT_EQ(a.patches[p].hidden, b.patches[p].hidden);
  }
  for (std::size_t v = 0; v < a.vertices.size(); ++v) {
    EXPECT_EQ(a.vertices[v].normal, b.vertices[v].normal);
    EXPECT_EQ(a.vertices[v].offset, b.vertices[v].offset);
  }
}

/// What is thinner than the least thickness is padded below.
TEST(LayerSkin, IsAsThickAsTheMeshMustSee) {
  const LayerBody<3> body = body_of(torn_stack(), 3 * mm);
  EXPECT_NEAR(level_at(body, 4.3, 4.4, -1.5), 0.5, 1e-12); // 2 mm are 3
  EXPECT_NEAR(level_at(body, 0.2, 0.2, -1.5), 0.5, 1e-12); // 1 mm is 3
  EXPECT_NEAR(level_at(body, 4.3, 4.4, 2.5), 0.5, 1e-12);
}

/// Beyond an edge that is held faces go on straight.
TEST(LayerSkin, GoesOnWhereItsEdgesAreHeld) {
  LayerInput in;
  in.model = HookeSolid{1e9, 0.3, 1000};
  in.lines[0] = in.lines[1] = even_lines(0, side * mm, side);
  in.levels = even_lines(0, 2 * mm, 1);
  in.edge = {{{LayerEdge::symmetry, LayerEdge::fixed}, {LayerEdge::symmetry, LayerEdge::fixed}}};
  const LayerStack<3> s = make_stack<3>(in);
  const LayerBody<3> body = body_of(s, 0.3 * mm);
  EXPECT_NEAR(level_at(body, 20, 3, 2.5), 0.5, 1e-12);
  EXPECT_NEAR(level_at(body, 20, -3, 0.5), -0.5, 1e-12);
}

/// Layers that have gone into each other: nothing is open between their faces.
TEST(LayerSkin, HoldsWhatTwoLayersCoverTogether) {
  for (const double depth : {0.15, 0.6, 0.9}) {
    LayerStack<3> s = torn_stack();
    move_layer(s, 0, [&](double&, double&, double& z) { z += depth * mm; });
    const LayerBody<3> body = body_of(s, 0.3 * mm);
    for (const double z : {depth + 0.05, 1 + 0.5 * depth, 1.95}) {
      EXPECT_LT(level_at(body, 4.5, 4.4, z), 0) << depth << ' ' << z;
    }
    EXPECT_LT(level_at(body, 2.99, 1.4, 1 + 0.9 * depth), 0) << depth; // beside the lower one's rim, in the upper one
    EXPECT_GT(level_at(body, 4.5, 4.4, depth - 0.05), 0) << depth;
    EXPECT_GT(level_at(body, 1.4, 1.6, 0.95), 0) << depth;
  }
}

} // namespace
} // namespace ballast
