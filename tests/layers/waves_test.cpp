// Small tensile pulses in strips that are already stretched: their speed is that of the law's tangent.
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

using namespace stacks;

/// Speed (lengths at rest) at which a pulse travels along `axis` in a strip stretched to Green strain E, `n` elements long.
double pulse_speed(const FabricModel& model, std::size_t axis, double E, int n) {
  constexpr double length = 60e-3, width = 2e-3, start = 15e-3, speed = 1e-3;
  std::array<int, 3> count = {1, 1, 1};
  std::array<double, 3> h = {0.5e-3, 0.5e-3, 0.2e-3};
  count[axis] = n;
  h[axis] = length / n;
  LayerInput in = brick(model, count, h, 3);
  in.edge = {{{LayerEdge::symmetry, LayerEdge::symmetry}, {LayerEdge::symmetry, LayerEdge::symmetry}}};
  LayerStack<3> s = make_stack<3>(in);
  const double nu = std::holds_alternative<HookeSolid>(model) ? std::get<HookeSolid>(model).poisson : 0.0;
  place(s, s.position, [&](std::array<double, 3> X) {
    X[axis] *= std::sqrt(1 + 2 * E);
    X[2] *= std::sqrt(1 - 2 * E * nu / (1 - nu)); // no stress through the thickness
    return X;
  });
  place(s, s.velocity, [&](std::array<double, 3> X) {
    std::array<double, 3> v = {};
    v[axis] = speed * std::exp(-std::pow((X[axis] - start) / width, 2));
    return v;
  });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  double time = 0;
  /// Centre of the pulse that runs up.
  const auto centre = [&] {
    double sum = 0, moment = 0;
    for (std::size_t k = 0; k < s.node_count(); ++k) {
      const double v = s.velocity[axis][k];
      if (v > 0.01 * speed && s.rest[axis][k] > start) {
        sum += v * v;
        moment += v * v * s.rest[axis][k];
      }
    }
    return moment / sum;
  };
  const auto run_to = [&](double place_of_pulse) {
    while (centre() < place_of_pulse) {
      const double dt = stable_step(s).dt;
      substep(s, dt, ledger, pool);
      time += dt;
    }
    return std::pair{centre(), time};
  };
  const auto [first_place, first_time] = run_to(25e-3);
  const auto [last_place, last_time] = run_to(45e-3);
  return (last_place - first_place) / (last_time - first_time);
}

double expected_speed(const FabricModel& model, std::size_t axis, double E) {
  if (const auto* solid = std::get_if<HookeSolid>(&model)) { // held across, free through: plane strain of a plate
    const double C = solid->young / (1 - solid->poisson * solid->poisson);
    return std::sqrt(((1 + 2 * E) * C + C * E) / solid->density);
  }
  FabricTensor strain = {};
  strain[axis] = E;
  FabricState fresh;
  const FabricStress here = evaluate(std::get<RaftenbergFabric>(model), strain, fresh);
  return std::sqrt(((1 + 2 * E) * here.tangent[axis] + here.stress[axis]) / density(model));
}

TEST(LayerWaves, TensilePulseRunsAtTheSpeedOfTheTangent) {
  for (const auto& [name, model] : {std::pair<std::string, FabricModel>{"hooke", hooke()}, {"printed", fabric_laws::paper()}}) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (const double E : {0.004, 0.05, 0.12}) {
        const double speed = expected_speed(model, axis, E);
        const double coarse = pulse_speed(model, axis, E, 120) / speed - 1, fine = pulse_speed(model, axis, E, 240) / speed - 1;
        EXPECT_LT(std::abs(fine), 0.01) << name << ' ' << axis << ' ' << E;
        EXPECT_GT(std::log2(std::abs(coarse / fine)), 1.7) << name << ' ' << axis << ' ' << E << ": " << coarse << ' ' << fine;
      }
    }
  }
}

} // namespace
} // namespace ballast
