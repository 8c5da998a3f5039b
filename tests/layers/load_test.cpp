// What clings to a stack's nodes moves with them: impulses of folds and slidelines keep the momentum of both.
#include "ale/layers/layer_erosion.hpp"
#include "ale/layers/layer_folds.hpp"
#include "ale/layers/layer_forces.hpp"
#include "ale/layers/layer_load.hpp"
#include "ale/layers/layer_step.hpp"
#include "ale/layers/slideline.hpp"
#include "tests/layers/stacks.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

LayerStack<2> two_layers() {
  LayerInput in;
  in.name = "two";
  in.model = HookeSolid{1e9, 0.3, 1000};
  in.lines[0] = even_lines(0, 6e-3, 6);
  in.levels = even_lines(0, 2e-3, 2);
  in.layers = 2;
  return make_stack<2>(in);
}

/// Every second node of the lower layer carries ten times its mass along a slanted normal.
LayerLoad<2> slanted_load(const LayerStack<2>& s) {
  LayerLoad<2> load;
  for (std::size_t n = 0; n < s.node(0, 0, 2); n += 2) {
    const Eigen::Vector2d normal(std::sin(0.4), std::cos(0.4));
    load.node.push_back(n);
    load.force.emplace_back(0, 0);
    load.added.push_back(10 * s.mass[n] * normal * normal.transpose());
  }
  load.spread(s.node_count());
  return load;
}

std::array<double, 2> momentum(const LayerStack<2>& s, const LayerLoad<2>& load) {
  Eigen::Vector2d sum(0, 0);
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    const Eigen::Vector2d v(s.velocity[0][n], s.velocity[1][n]);
    sum += s.mass[n] * v + load.by_node[n] * v;
  }
  return {sum[0], sum[1]};
}

void expect_same(const std::array<double, 2>& a, const std::array<double, 2>& b, double scale) {
  for (std::size_t d = 0; d < 2; ++d) {
    EXPECT_NEAR(a[d], b[d], 1e-13 * scale);
  }
}

TEST(LayerLoad, FoldsKeepMomentum) {
  LayerStack<2> s = two_layers();
  const LayerLoad<2> load = slanted_load(s);
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    s.velocity[0][n] = 100 * std::sin(3.0 * static_cast<double>(n));
    s.velocity[1][n] = 50 * std::cos(5.0 * static_cast<double>(n));
  }
  const auto before = momentum(s, load);
  const std::vector<double> was = s.velocity[0];
  LayerLedger ledger;
  ThreadPool pool(1);
  stop_folds<2>(s, 1e-5, held_nodes(s), ledger, pool, &load); // edges would close by their length
  EXPECT_NE(was, s.velocity[0]);
  expect_same(momentum(s, load), before, 100 * 12e-3);
}

TEST(LayerLoad, SlidelinesKeepMomentum) {
  LayerStack<2> s = two_layers();
  const LayerLoad<2> load = slanted_load(s);
  for (std::size_t n = 0; n < s.node_count(); ++n) {
    s.velocity[1][n] = n < s.node(0, 0, 2) ? 80 : -30; // the lower layer runs into the upper one
  }
  const auto before = momentum(s, load);
  SlidelineState<2> state;
  ThreadPool pool(1);
  const SlidelineReport report = resolve_slidelines(s, 1e-7, s.velocity, pool, {}, state, &load);
  EXPECT_GT(report.contact.impulse, 0);
  expect_same(momentum(s, load), before, 80 * 12e-3);
  for (int i = 0; i <= 6; ++i) {
    EXPECT_LE(s.velocity[1][s.node(i, 0, 1)], s.velocity[1][s.node(i, 0, 2)] + 0.1);
  }
}

/// A mesh's step that the layers take in parts is no new force of a longer one.
TEST(LayerLoad, AStepTakenInPartsChangesNoEntry) {
  LayerStack<2> s = two_layers();
  LayerLoad<2> load = slanted_load(s);
  load.force.assign(load.node.size(), LayerLoad<2>::Vector(0, 1e6));
  s.step = 1e-8;
  put_on(s, load);
  LayerLedger ledger;
  book_new_force(s, load, 4e-8, ledger);
  EXPECT_EQ(ledger.load_work, 0);
  EXPECT_EQ(ledger.step_change, 0);
}

/// A force of one short step after a long one: its work is what the nodes gain, and the change of the step's length costs nothing of it.
TEST(LayerLoad, ANewForceInAShortStepWorksWhatItGives) {
  LayerStack<2> s = two_layers();
  constexpr double force = 1e6, dt = 1e-9;
  LayerLoad<2> load;
  for (std::size_t n = 0; n < s.node(0, 0, 1); ++n) {
    load.node.push_back(n);
    load.force.emplace_back(0, force);
    load.added.emplace_back(LayerLoad<2>::Matrix::Zero());
  }
  load.spread(s.node_count());
  LayerLedger ledger;
  ThreadPool pool(1);
  update_forces(s, 0, ledger, pool);
  s.step = 1e-7;
  const double before = kinetic_of(s, load);
  put_on(s, load);
  book_new_force(s, load, dt, ledger);
  ledger.load_work += kinetic_of(s, load) - before;
  substep<2>(s, dt, ledger, pool, {}, &load);
  const double loaded = kinetic_of(s, load);
  take_off(s, load);
  ledger.load_work += kinetic_of(s, load) - loaded;
  double gained = 0;
  for (std::size_t n = 0; n < s.node(0, 0, 1); ++n) {
    gained += 0.5 * s.mass[n] * s.velocity[1][n] * s.velocity[1][n];
  }
  EXPECT_GT(gained, 1e-4);
  EXPECT_NEAR(ledger.load_work, gained, 0.01 * gained);
  EXPECT_NEAR(ledger.step_change, 0, 0.01 * gained);
}

TEST(LayerErosion, GoesByBothFamiliesOrEither) {
  for (const bool either : {false, true}) {
    LayerStack<2> s = two_layers();
    s.guard.either = either;
    for (std::size_t point = 0; point < 2; ++point) {
      s.largest[point][0][s.element(2, 0, 0)] = 0.6; // the warp alone is lost
    }
    LayerLedger ledger;
    erode<2>(s, {0.5, 0.5}, ledger);
    EXPECT_EQ(s.alive[s.element(2, 0, 0)] == 0, either);
    EXPECT_EQ(ledger.eroded_elements, either ? 1 : 0);
  }
}

} // namespace
} // namespace ballast
