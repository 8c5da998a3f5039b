// Outlines of stacks with holes: what they enclose is the layers that are left and the gaps that a mesh does not see.
#include "ale/embed/layer_body.hpp"
#include "ale/embed/outline.hpp"
#include "tests/layers/stacks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double mm = 1e-3;

/// Two layers 8 mm wide and 1 mm thick each; the lower one has lost its first three elements.
LayerStack<2> torn_stack() {
  LayerInput in;
  in.name = "two";
  in.model = HookeSolid{1e9, 0.3, 1000};
  in.lines[0] = even_lines(0, 8 * mm, 8);
  in.levels = even_lines(0, 2 * mm, 2);
  in.layers = 2;
  LayerStack<2> s = make_stack<2>(in);
  for (int i = 0; i < 3; ++i) {
    s.alive[s.element(i, 0, 0)] = 0;
  }
  return s;
}

/// Moves the lower layer's nodes.
template <class Move> void move_lower(LayerStack<2>& s, Move&& move) {
  for (int plane = 0; plane < 2; ++plane) {
    for (int i = 0; i <= 8; ++i) {
      const std::size_t n = s.node(i, 0, plane);
      move(s.position[0][n], s.position[1][n]);
    }
  }
}

/// Area that the body covers, by counting (mm2).
double enclosed(const LayerStack<2>& s, double least) {
  constexpr double step = 0.02;
  const LayerBody<2> body(s, s.alive, std::vector<double>(9, least), 0.5 * mm);
  int count = 0;
  for (double x = -1 + 0.37 * step; x < 11; x += step) {
    for (double z = -3 + 0.41 * step; z < 4; z += step) {
      BodyFoot<2> foot;
      count += body.foot({x * mm, z * mm}, 2 * mm, foot) && foot.level < 0 ? 1 : 0;
    }
  }
  return count * step * step;
}

bool covers(const LayerBody<2>& body, const std::array<double, 2>& point) {
  BodyFoot<2> foot;
  return body.foot(point, 20 * mm, foot) && foot.level < 0;
}

TEST(Outline, HoldsWhatIsLeftWhereLayersHaveSlid) {
  for (const double slide : {0.0, 0.6, -0.4, 1.7}) {
    LayerStack<2> s = torn_stack();
    move_lower(s, [&](double& x, double&) { x += slide * mm; });
    EXPECT_NEAR(enclosed(s, 0.3 * mm), 13, 0.03) << slide;
    // Between the two layers, past the edge: inside, whichever face is nearest.
    const LayerBody<2> body(s, s.alive, std::vector<double>(9, 0.3 * mm), 0.5 * mm);
    for (const double off : {0.05, 0.2, 0.35}) {
      for (const double z : {0.9, 1.1}) {
        BodyFoot<2> foot;
        ASSERT_TRUE(body.foot({(3 + slide + off) * mm, z * mm}, 2 * mm, foot));
        EXPECT_LT(foot.level, 0) << slide << ' ' << off << ' ' << z;
      }
    }
  }
}

/// The layer next to the torn one has a hole of its own where the edge lies, and the two have not parted.
TEST(Outline, ReachesOverAHoleInTheNextLayer) {
  LayerStack<2> s = torn_stack();
  s.alive[s.element(3, 0, 1)] = 0;
  EXPECT_NEAR(enclosed(s, 0.3 * mm), 12, 0.03);
  const LayerBody<2> body(s, s.alive, std::vector<double>(9, 0.3 * mm), 0.5 * mm);
  EXPECT_FALSE(covers(body, {3.5 * mm, 1.5 * mm}));
  EXPECT_TRUE(covers(body, {3.5 * mm, 0.5 * mm}));
  EXPECT_FALSE(covers(body, {7 * mm, 2.5 * mm}));
}

TEST(Outline, OpensACleftWhereLayersHaveParted) {
  LayerStack<2> s = torn_stack();
  move_lower(s, [](double& x, double& z) { z -= std::max(0.0, (8 * mm - x) / 5); }); // 1 mm at the hole's edge, none at the end
  // The gap is covered where it is below 0.09 mm: a triangle 0.45 mm long.
  EXPECT_NEAR(enclosed(s, 0.3 * mm), 13 + 0.5 * 0.09 * 0.45, 0.03);
  const LayerBody<2> body(s, s.alive, std::vector<double>(9, 0.3 * mm), 0.5 * mm);
  EXPECT_FALSE(covers(body, {4 * mm, 0.6 * mm})); // in the cleft
  EXPECT_TRUE(covers(body, {7.8 * mm, 0.98 * mm})); // in what is closed of it
  EXPECT_TRUE(covers(body, {4 * mm, -0.3 * mm}));  // in the flap
  EXPECT_TRUE(covers(body, {4 * mm, 1.5 * mm}));
  EXPECT_FALSE(covers(body, {4 * mm, 2.5 * mm}));
  EXPECT_FALSE(covers(body, {2 * mm, 0.5 * mm})); // in the hole
}

TEST(Outline, KeepsAGapThatIsPinchedOff) {
  LayerStack<2> s = torn_stack();
  move_lower(s, [](double& x, double& z) { z -= x > 5.5 * mm && x < 7.5 * mm ? 1 * mm : 0.0; }); // a sag of 1 mm between nodes at 5 and 8 mm
  const double tips = 2 * 0.5 * 0.09 * 0.09; // what is narrower than 0.09 mm
  EXPECT_NEAR(enclosed(s, 0.3 * mm), 13 + tips, 0.03);
  const LayerBody<2> body(s, s.alive, std::vector<double>(9, 0.3 * mm), 0.5 * mm);
  EXPECT_FALSE(covers(body, {6.5 * mm, 0.5 * mm}));
  EXPECT_TRUE(covers(body, {6.5 * mm, -0.5 * mm}));
}

/// A layer that has come off altogether: above the stack is still outside.
TEST(Outline, StaysOneBodyWhereALayerHasComeOff) {
  LayerStack<2> s = torn_stack();
  move_lower(s, [](double&, double& z) { z -= 2 * mm; });
  const LayerBody<2> body(s, s.alive, std::vector<double>(9, 0.3 * mm), 0.5 * mm);
  EXPECT_FALSE(covers(body, {5 * mm, 3 * mm}));
  EXPECT_TRUE(covers(body, {5 * mm, 1.5 * mm}));
  EXPECT_FALSE(covers(body, {5 * mm, 0 * mm}));
  EXPECT_TRUE(covers(body, {5 * mm, -1.5 * mm}));
}

/// Layers that have gone into each other, deeper than a slit that no mesh sees is wide: nothing is open between their faces.
TEST(Outline, HoldsWhatTwoLayersCoverTogether) {
  for (const double depth : {0.16, 0.6, 0.9}) {
    for (const double slide : {0.0, 0.3, 0.5}) { // ends between nodes
      LayerStack<2> s = torn_stack();
      move_lower(s, [&](double& x, double& z) {
        x += slide * mm;
        z += depth * mm;
      });
      EXPECT_NEAR(enclosed(s, 0.3 * mm), 13 - (5 - slide) * depth, 0.03) << depth << ' ' << slide;
      const LayerBody<2> body(s, s.alive, std::vector<double>(9, 0.3 * mm), 0.5 * mm);
      EXPECT_TRUE(covers(body, {6 * mm, (1 + 0.5 * depth) * mm})) << depth;
      EXPECT_TRUE(covers(body, {6 * mm, (depth + 0.05) * mm})) << depth;
      EXPECT_FALSE(covers(body, {6 * mm, (depth - 0.05) * mm})) << depth;
    }
  }
}

} // namespace
} // namespace ballast
