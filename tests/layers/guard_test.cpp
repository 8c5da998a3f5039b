// Elements do not turn inside out, whatever their law lets them do; what keeps them from it keeps energy, momentum and moment.
#include "ale/layers/layer_folds.hpp"
#include "tests/layers/stacks.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

namespace ballast {
namespace {

using namespace stacks;

RaftenbergFabric slippery() {
  RaftenbergFabric law = fabric_laws::paper();
  law.in_plane = law.through = awg_shear();
  return law;
}

/// Two layers of two elements through, unconnected, thrown together in their plane and sheared through the thickness.
template <int Dim> LayerStack<Dim> crumpling(const LayerGuard& guard) {
  LayerInput in = brick(slippery(), {8, 4, 2}, {1e-3, 1e-3, 0.6e-3}, Dim, 2);
  in.guard = guard;
  LayerStack<Dim> s = make_stack<Dim>(in);
  place(s, s.velocity, [](std::array<double, Dim> X) {
    std::array<double, Dim> v = {};
    v[0] = -4e4 * (X[0] - 4e-3) + 2e4 * (X[Dim - 1] - 1e-3);
    v[Dim - 1] = 40 * std::sin(1.2e3 * X[0]);
    if (Dim == 3) {
      v[1] = -4e4 * (X[1] - 2e-3) + 10 * std::cos(1e3 * X[0]);
    }
    return v;
  });
  return s;
}

template <int Dim> LayerLedger crumple(LayerStack<Dim>& s, int steps) {
  ThreadPool pool(2);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const LayerTotals first = totals(s);
  const double energy = total_energy(s, ledger), moment = std::sqrt(2 * first.kinetic * first.mass);
  for (int step = 0; step < steps; ++step) {
    substep(s, std::min(stable_step(s).dt, 1e-7), ledger, pool);
  }
  const LayerTotals last = totals(s);
  EXPECT_NEAR(total_energy(s, ledger), energy, 1e-10 * first.kinetic);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(last.momentum[d], first.momentum[d], 1e-12 * moment);
    EXPECT_NEAR(last.angular_momentum[d], first.angular_momentum[d], 1e-11 * moment * 8e-3);
  }
  return ledger;
}

template <int Dim> void expect_right_side_out() {
  LayerStack<Dim> kept = crumpling<Dim>({}), loose = crumpling<Dim>({0, 0});
  EXPECT_EQ(crumple(kept, 600).turned_over, 0);
  ThreadPool pool(2);
  LayerLedger ledger;
  update_forces(loose, 0.0, ledger, pool);
  for (int step = 0; step < 600 && ledger.turned_over == 0; ++step) {
    substep(loose, std::min(stable_step(loose).dt, 1e-7), ledger, pool);
  }
  EXPECT_GT(ledger.turned_over, 0); // or nothing was tried
}

TEST(LayerGuard, PressedAndShearedElementsStayRightSideOut) {
  expect_right_side_out<2>();
  expect_right_side_out<3>();
}

TEST(LayerGuard, EdgesCloseToTheirShortest) {
  LayerStack<2> s = make_stack<2>(brick(fabric_laws::paper(), {6, 1, 1}, {1e-3, 1, 0.6e-3}, 2));
  place(s, s.velocity, [](std::array<double, 2> X) -> std::array<double, 2> { return {-1e5 * (X[0] - 3e-3), 0}; });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const double kinetic = totals(s).kinetic;
  for (int step = 0; step < 400; ++step) {
    substep(s, 5e-8, ledger, pool);
  }
  for (int plane = 0; plane < 2; ++plane) {
    for (int i = 0; i < 6; ++i) {
      const double length = s.position[0][s.node(i + 1, 0, plane)] - s.position[0][s.node(i, 0, plane)];
      EXPECT_NEAR(length, s.guard.shortest * 1e-3, 0.01e-3) << i;
    }
  }
  EXPECT_NEAR(ledger.contact_loss, kinetic, 1e-3 * kinetic); // an impact: all of it
}

/// Loose nodes of eroded cloth are debris: they fly on.
TEST(LayerGuard, DebrisDoesNotFold) {
  LayerStack<2> s = make_stack<2>(brick(fabric_laws::paper(), {6, 1, 1}, {1e-3, 1, 0.6e-3}, 2));
  std::fill(s.alive.begin(), s.alive.end(), char(0));
  place(s, s.velocity, [](std::array<double, 2> X) -> std::array<double, 2> { return {-1e5 * (X[0] - 3e-3), 0}; });
  const auto velocity = s.velocity;
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  for (int step = 0; step < 400; ++step) {
    substep(s, 5e-8, ledger, pool);
  }
  EXPECT_EQ(s.velocity, velocity);
  EXPECT_EQ(ledger.contact_loss, 0);
}

/// The energy booked with the held modes is the guard's, K V (J - Jl - Jl ln(J/Jl)): shear that turns a face under the other, slowly.
TEST(LayerGuard, BooksItsOwnEnergy) {
  LayerInput in = brick(slippery(), {1, 1, 1}, {1e-3, 1, 0.6e-3}, 2);
  in.hourglass = {0, 0};
  in.viscosity = {0, 0};
  in.guard = {0, 0.5};
  LayerStack<2> s = make_stack<2>(in);
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  constexpr double share = 0.7; // J falls to 0.3: its edges close in the plane
  for (int step = 0; step < 4000; ++step) {
    substep(s, 1e-8, ledger, pool, [&] {
      place(s, s.velocity, [&](std::array<double, 2> X) -> std::array<double, 2> { return {-share * X[0] / 40e-6, 0}; });
    });
  }
  const FabricTensor C = evaluate(slippery(), FabricTensor{}, *std::make_unique<FabricState>()).tangent;
  const double K = std::max(C[2], std::min(C[0], C[1])), V = 1e-3 * 0.6e-3, J = 0.3, least = 0.5;
  EXPECT_NEAR(totals(s).hourglass, K * V * (J - least - least * std::log(J / least)), 1e-3 * K * V * 0.05);
}

/// Slack and stretched cloth that no guard touches moves as without one, bit for bit.
TEST(LayerGuard, IsNotFeltBefore) {
  const auto fly = [](const LayerGuard& guard) {
    LayerInput in = brick(fabric_laws::paper(), {8, 4, 2}, {1e-3, 1e-3, 0.6e-3}, 3);
    in.guard = guard;
    LayerStack<3> s = make_stack<3>(in);
    place(s, s.velocity, [](std::array<double, 3> X) -> std::array<double, 3> { return {50 * std::sin(1e3 * X[1]), 0, 100 * std::cos(500 * X[0])}; });
    ThreadPool pool(1);
    LayerLedger ledger;
    update_forces(s, 0.0, ledger, pool);
    for (int step = 0; step < 100; ++step) {
      substep(s, stable_step(s).dt, ledger, pool);
    }
    return s.position;
  };
  EXPECT_EQ(fly({}), fly({0, 0}));
}

/// A fold on a held node: what the edge takes is booked.
TEST(LayerGuard, HeldEdgesTakeTheirShareOfAFold) {
  LayerInput in = brick(fabric_laws::paper(), {3, 1, 1}, {1e-3, 1, 0.6e-3}, 2);
  in.edge[0][0] = LayerEdge::symmetry;
  LayerStack<2> s = make_stack<2>(in);
  place(s, s.velocity, [](std::array<double, 2> X) -> std::array<double, 2> { return {-1e5 * X[0], 0}; });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const LayerTotals first = totals(s);
  for (int step = 0; step < 300; ++step) {
    substep(s, 5e-8, ledger, pool);
  }
  const LayerTotals last = totals(s);
  EXPECT_NEAR(last.momentum[0], first.momentum[0] + ledger.edge_impulse[0], 1e-12 * std::abs(first.momentum[0]));
  EXPECT_GT(ledger.edge_impulse[0], 0.5 * std::abs(first.momentum[0]));
}

} // namespace
} // namespace ballast
