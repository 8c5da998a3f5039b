// A shock through the thickness of cloth, the printed law: Rankine and Hugoniot's jump, P = rho0 D u with D = u/(1 - lambda), and the heat it makes.
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

using namespace stacks;

/// First Piola-Kirchhoff pressure at a stretch through the thickness.
double pressure(const RaftenbergFabric& law, double stretch) {
  FabricState fresh;
  return -stretch * evaluate(law, FabricTensor{0, 0, 0.5 * (stretch * stretch - 1), 0, 0, 0}, fresh).stress[2];
}

/// Stretch behind a shock into cloth at rest, of material speed u: P(lambda) (1 - lambda) = rho0 u^2, by halving.
double behind(const RaftenbergFabric& law, double u) {
  double low = 0.2, high = 1;
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (pressure(law, middle) * (1 - middle) > law.density * u * u ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

struct Shock {
  double front = 0, stretch = 0, speed = 0, ringing = 0; ///< m at rest; behind it: mean, mean in m/s, largest part of u that a plane's speed is off it
  double heat = 0, internal = 0;                         ///< J
};

/// A piston at u into the lower face of a thick layer, until the front should have run 60 % of it.
Shock drive(const RaftenbergFabric& law, double u, const LayerViscosity& viscosity) {
  constexpr int count = 100;
  constexpr double length = 20e-3, width = 1e-3;
  LayerInput in = brick(law, {1, 1, 1}, {width, 1, length / count}, 2, count);
  in.edge[0] = {LayerEdge::symmetry, LayerEdge::symmetry};
  in.viscosity = viscosity;
  LayerStack<2> s = make_stack<2>(in);
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const double end = 0.6 * length * (1 - behind(law, u)) / u;
  for (double t = 0; t < end;) {
    const double dt = stable_step(s).dt;
    substep(s, dt, ledger, pool, [&] { s.velocity[1][s.node(0, 0, 0)] = s.velocity[1][s.node(1, 0, 0)] = u; });
    t += dt;
  }
  const auto lift = [&](int plane) { return s.position[1][s.node(0, 0, plane)] - s.rest[1][s.node(0, 0, plane)]; };
  const auto stretch = [&](int level) { return 1 + (lift(level + 1) - lift(level)) / (length / count); };
  Shock out;
  constexpr int from = 10, to = 50;
  for (int level = from; level < to; ++level) {
    out.stretch += stretch(level) / (to - from);
    out.speed += s.velocity[1][s.node(0, 0, level)] / (to - from);
  }
  for (int level = from; level < to; ++level) {
    out.ringing = std::max(out.ringing, std::abs(s.velocity[1][s.node(0, 0, level)] / u - 1));
  }
  for (int plane = 0; plane < count && out.front == 0; ++plane) {
    out.front = s.velocity[1][s.node(0, 0, plane)] < 0.5 * u ? length / count * plane : 0.0;
  }
  out.heat = totals(s).shock_heat;
  out.internal = totals(s).internal;
  return out;
}

TEST(LayerShock, JumpsAsRankineAndHugoniotSay) {
  const RaftenbergFabric law = fabric_laws::paper();
  for (const double u : {50.0, 150.0, 370.0}) {
    const Shock s = drive(law, u, {});
    EXPECT_NEAR(s.stretch, behind(law, u), 0.02 * behind(law, u)) << u;
    EXPECT_NEAR(s.speed, u, 0.01 * u);
    EXPECT_NEAR(s.front, 12e-3, 0.03 * 12e-3) << u;
    // Half of what the piston gives is motion, half is strain and heat.
    const double mass = law.density * 1e-3 * s.front;
    EXPECT_NEAR(s.heat + s.internal, 0.5 * mass * u * u, 0.04 * mass * u * u) << u;
    EXPECT_GT(s.heat, s.internal); // far below its Rayleigh line lies the curve
    EXPECT_LT(s.ringing, 0.15) << u;
  }
}

TEST(LayerShock, RingsWithoutViscosity) {
  const Shock s = drive(fabric_laws::paper(), 150, {0, 0});
  EXPECT_GT(s.ringing, 0.5);
}

} // namespace
} // namespace ballast
