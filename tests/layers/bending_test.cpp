// Static deflection of cantilevers under a tip load against beam theory in plane strain, w = 4 P L^3 (1 - nu^2)/(E t^3).
#include "ale/layers/slideline.hpp"
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

using namespace stacks;

constexpr double length = 20e-3;

/// Deflection of the tip under `load` (N a metre of width) on the lowest layer, pressed against the next ones, damped to rest.
double tip_deflection(double thickness, int layers, int through, double load, int elements, const HookeSolid& solid) {
  LayerInput in = brick(solid, {elements, 1, layers}, {length / elements, 1, thickness / through}, 2, through);
  in.edge[0][0] = LayerEdge::fixed;
  LayerStack<2> s = make_stack<2>(in);
  ThreadPool pool(1);
  LayerLedger ledger;
  SlidelineState<2> slidelines;
  const auto forces = [&](double dt) {
    update_forces(s, dt, ledger, pool);
    for (int plane = 0; plane <= through; ++plane) { // parabolic or not does not matter at this length
      const bool outer = plane % (through + 1) == 0 || plane % (through + 1) == through;
      s.force[1][s.node(elements, 0, plane)] += load * (outer ? 0.5 : 1.0) / through;
    }
  };
  forces(0);
  const double E = solid.young / (1 - solid.poisson * solid.poisson);
  const double omega = 3.516 * thickness / (length * length) * std::sqrt(E / (12 * solid.density));
  for (double time = 0; time * omega < 12;) { // critically damped: exp(-12) (1 + 12) is left
    const double dt = stable_step(s).dt;
    kick(s, dt / 2, ledger, pool);
    resolve_slidelines(s, dt, s.velocity, pool, {}, slidelines);
    drift(s, dt, pool);
    forces(dt);
    kick(s, dt / 2, ledger, pool);
    for (auto& component : s.velocity) {
      for (double& v : component) {
        v *= 1 - 2 * omega * dt;
      }
    }
    time += dt;
  }
  double mean = 0;
  for (int plane = 0; plane < s.grid.planes(); ++plane) {
    const std::size_t n = s.node(elements, 0, plane);
    mean += (s.position[1][n] - s.rest[1][n]) / s.grid.planes();
  }
  return mean;
}

double beam(double thickness, double load, const HookeSolid& solid) {
  return 4 * load * std::pow(length, 3) * (1 - solid.poisson * solid.poisson) / (solid.young * std::pow(thickness, 3));
}

TEST(LayerBending, OneElementThroughIsABeam) {
  for (const double nu : {0.0, 0.2, 0.4}) {
    const HookeSolid solid = hooke(74e9, nu);
    for (const double thickness : {1e-3, 0.25e-3}) {
      const double load = 0.005 * length / beam(thickness, 1, solid);
      const double ratio = tip_deflection(thickness, 1, 1, load, 20, solid) / beam(thickness, load, solid);
      EXPECT_NEAR(ratio, 1, 0.02) << nu << ' ' << thickness; // (h/L)^2 of one element's straight chord, and shear (t/L)^2
    }
  }
}

TEST(LayerBending, LayersAddAndThicknessCubes) {
  const HookeSolid solid = hooke();
  constexpr int layers = 4;
  const double thin = 0.25e-3, load = layers * 0.005 * length / beam(thin, 1, solid);
  const double loose = tip_deflection(thin, layers, 1, load, 20, solid) / beam(thin, load / layers, solid); // the lowest hands on 3/4 of it
  const double solid_load = 0.005 * length / beam(layers * thin, 1, solid);
  const double thick = tip_deflection(layers * thin, 1, layers, solid_load, 20, solid) / beam(layers * thin, solid_load, solid);
  EXPECT_NEAR(loose, 1, 0.02);
  EXPECT_NEAR(thick, 1, 0.02);
}

} // namespace
} // namespace ballast
