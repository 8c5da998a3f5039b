// A ring pulled at its outer edge, held at its inner: plane stress, u = A r + B/r.
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

using namespace stacks;

/// Largest error of the displacement over the pull, with n elements along the radius.
double ring_error(int n) {
  constexpr double inner = 5e-3, outer = 20e-3, pull = 2e-7;
  const HookeSolid solid = hooke();
  LayerInput in = brick(solid, {n, 1, 1}, {(outer - inner) / n, 1, 0.2e-3}, 2);
  for (double& r : in.lines[0]) {
    r += inner;
  }
  in.axisymmetric = true;
  LayerStack<2> s = make_stack<2>(in);
  const double B = pull / (1 / outer - outer / (inner * inner)), A = -B / (inner * inner);
  for (int plane = 0; plane < 2; ++plane) {
    s.position[0][s.node(n, 0, plane)] += pull;
  }
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const auto held = [&](double half) {
    kick(s, half, ledger, pool);
    for (int plane = 0; plane < 2; ++plane) {
      s.velocity[0][s.node(0, 0, plane)] = s.velocity[0][s.node(n, 0, plane)] = 0;
    }
  };
  const double damping = 7000 * 3.14 / (outer - inner);
  for (double time = 0; time * damping < 30;) {
    const double dt = stable_step(s).dt;
    held(dt / 2);
    drift(s, dt, pool);
    update_forces(s, dt, ledger, pool);
    held(dt / 2);
    for (auto& component : s.velocity) {
      for (double& v : component) {
        v *= 1 - 2 * damping * dt;
      }
    }
    time += dt;
  }
  double most = 0;
  for (int i = 0; i <= n; ++i) {
    const double r = s.lines[0][static_cast<std::size_t>(i)], u = s.position[0][s.node(i, 0, 0)] - r;
    most = std::max(most, std::abs(u - (A * r + B / r)) / pull);
  }
  return most;
}

TEST(LayerRing, PulledRadiallyIsPlaneStress) {
  // Exact at the nodes on any lines: strains at the middles solve the equations. What is left is pull/radius of Green strain.
  for (const int n : {5, 10, 40}) {
    EXPECT_LT(ring_error(n), 2e-6) << n;
  }
}

TEST(LayerRing, DiscStretchedEvenlyHasOnlyItsEdgeForce) { // S = E/(1 - nu) E_rr; P = stretch S on 2 pi a t
  const HookeSolid solid = hooke();
  LayerInput in = brick(solid, {9, 1, 1}, {1e-3, 1, 0.5e-3}, 2);
  in.axisymmetric = true;
  in.edge[0][0] = LayerEdge::symmetry;
  LayerStack<2> s = make_stack<2>(in);
  const double stretch = 1.05, E = 0.5 * (stretch * stretch - 1), E33 = -2 * solid.poisson / (1 - solid.poisson) * E;
  place(s, s.position, [&](std::array<double, 2> X) -> std::array<double, 2> { return {stretch * X[0], std::sqrt(1 + 2 * E33) * X[1]}; });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const double edge = stretch * solid.young / (1 - solid.poisson) * E * 2 * 3.141592653589793 * 9e-3 * 0.5e-3;
  for (int plane = 0; plane < 2; ++plane) {
    for (int i = 1; i <= 9; ++i) {
      const std::size_t n = s.node(i, 0, plane);
      EXPECT_NEAR(s.force[0][n], i == 9 ? -0.5 * edge : 0.0, 1e-12 * edge) << i;
      EXPECT_NEAR(s.force[1][n], 0, 1e-12 * edge) << i;
    }
  }
}

} // namespace
} // namespace ballast
