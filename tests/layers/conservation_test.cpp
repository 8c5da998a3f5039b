// Mass, momentum, energy and order of the sums in stacks that are thrown, spun and waved, without contact.
#include "core/error.hpp"
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

using namespace stacks;

struct Motion {
  double thrown = 0, spin = 0, wave = 0; ///< m/s; 1/s; m/s
};

/// 2 layers of 2 elements through, thrown, spun and with noise in their velocity.
template <int Dim> LayerStack<Dim> moving(const FabricModel& model, const Motion& m, bool ring = false) {
  LayerInput in = brick(model, {12, 6, 2}, {1e-3, 1e-3, 0.4e-3}, Dim, 2);
  in.axisymmetric = ring;
  if (ring) {
    in.edge[0][0] = LayerEdge::symmetry;
  }
  LayerStack<Dim> s = make_stack<Dim>(in);
  place(s, s.velocity, [&](std::array<double, Dim> X) {
    std::array<double, Dim> v = {};
    const double bump = m.wave * std::sin(2 * std::numbers::pi * X[0] / 6e-3);
    v[Dim - 1] = m.thrown + bump;
    v[0] = ring ? 0.3 * bump : 0.3 * m.thrown - m.spin * X[Dim - 1];
    v[Dim - 1] += ring ? 0.0 : m.spin * X[0];
    if (Dim == 3) {
      v[1] = 0.2 * m.thrown + bump + m.spin * X[Dim - 1] * 0.5;
      v[Dim - 1] -= 0.5 * m.spin * X[1];
    }
    return v;
  });
  return s;
}

/// Largest change of energy and momenta, over the kinetic energy and the momenta that its speeds could make.
template <int Dim> void expect_kept(LayerStack<Dim> s, int steps, const std::string& name) {
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const LayerTotals first = totals(s);
  const double energy = total_energy(s, ledger), size = 12e-3, moment = std::sqrt(2 * first.kinetic * first.mass);
  double unaccounted = 0;
  for (int step = 0; step < steps; ++step) {
    substep(s, stable_step(s).dt, ledger, pool);
    unaccounted = std::max(unaccounted, std::abs(total_energy(s, ledger) - energy));
  }
  const LayerTotals last = totals(s);
  EXPECT_EQ(last.mass, first.mass);
  EXPECT_LT(unaccounted, 1e-12 * first.kinetic) << name;
  EXPECT_GT(last.internal + last.hourglass, 1e-6 * first.kinetic) << name << ": nothing happened";
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(last.momentum[d], first.momentum[d], 1e-12 * moment) << name;
    EXPECT_NEAR(last.angular_momentum[d], first.angular_momentum[d], 1e-12 * moment * size) << name;
  }
}

TEST(LayerStep, KeepsMassMomentumAndEnergy) {
  const Motion thrown{300, 0, 20}, spun{0, 2e4, 10}, waved{0, 0, 100};
  const RaftenbergFabric printed = fabric_laws::paper();
  for (const Motion& m : {thrown, spun, waved}) {
    for (const FabricModel& model : {FabricModel{hooke()}, FabricModel{printed}}) {
      const std::string name = model.index() == 0 ? "printed" : "hooke";
      expect_kept(moving<2>(model, m), 400, name + " plane");
      expect_kept(moving<3>(model, m), 200, name + " 3D");
    }
  }
  expect_kept(moving<2>(hooke(), waved, true), 400, "ring");
}

TEST(LayerStep, KeepsEnergyWithLossyLawsAndErosion) {
  RaftenbergFabric law = fabric_laws::paper();
  law.warp.unload = law.fill.unload = 0.02;
  law.secant_unloading = true;
  law.rate = RateFactor{};
  LayerStack<3> s = make_stack<3>(brick(law, {8, 8, 1}, {1e-3, 1e-3, 0.7e-3}, 3));
  place(s, s.velocity, [](std::array<double, 3> X) -> std::array<double, 3> { return {3e5 * (X[0] - 4e-3), 3e5 * (X[1] - 4e-3), 0}; });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const double energy = total_energy(s, ledger), kinetic = totals(s).kinetic;
  for (int step = 0; step < 400; ++step) {
    substep(s, stable_step(s).dt, ledger, pool);
  }
  EXPECT_NEAR(total_energy(s, ledger), energy, 1e-12 * kinetic);
  EXPECT_GT(ledger.eroded_elements, 0);
  EXPECT_LT(ledger.eroded_elements, 64);
  double eroded = 0;
  for (std::size_t e = 0; e < s.element_count(); ++e) {
    eroded += s.alive[e] != 0 ? 0.0 : s.energy[e];
  }
  EXPECT_NEAR(ledger.eroded_energy, eroded, 1e-12 * kinetic);
}

TEST(LayerStep, DoesNotDependOnThreads) {
  const auto run = [](int threads) {
    LayerStack<3> s = moving<3>(fabric_laws::paper(), {100, 0, 200});
    ThreadPool pool(threads);
    LayerLedger ledger;
    update_forces(s, 0.0, ledger, pool);
    for (int step = 0; step < 100; ++step) {
      substep(s, stable_step(s).dt, ledger, pool);
    }
    return s;
  };
  const LayerStack<3> one = run(1);
  for (const int threads : {2, 3}) {
    const LayerStack<3> more = run(threads);
    EXPECT_TRUE(one.position == more.position);
    EXPECT_TRUE(one.velocity == more.velocity);
    EXPECT_TRUE(one.energy == more.energy);
    EXPECT_TRUE(one.hourglass_energy == more.hourglass_energy);
  }
}

/// A stack all of whose edges are of one kind, thrown and waved: momentum changes by the edges' impulse.
void expect_edge_books(LayerEdge kind, double stiffness) {
  LayerInput in = brick(hooke(), {10, 8, 2}, {1e-3, 1e-3, 0.5e-3}, 3);
  in.edge = {{{kind, kind}, {kind, kind}}};
  in.edge_stiffness = stiffness;
  LayerStack<3> s = make_stack<3>(in);
  place(s, s.velocity, [](std::array<double, 3> X) -> std::array<double, 3> { return {30, 20 * std::sin(1e3 * X[0]), 50}; });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  const LayerTotals first = totals(s);
  const double energy = total_energy(s, ledger), moment = std::sqrt(2 * first.kinetic * first.mass);
  for (int step = 0; step < 300; ++step) {
    substep(s, stable_step(s).dt, ledger, pool);
  }
  const LayerTotals last = totals(s);
  EXPECT_NEAR(total_energy(s, ledger), energy, 1e-12 * first.kinetic);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(last.momentum[d], first.momentum[d] + ledger.edge_impulse[d], 1e-12 * moment);
  }
  EXPECT_GT(std::abs(ledger.edge_impulse[0]), 1e-3 * moment);
  if (kind == LayerEdge::elastic) {
    double stored = 0; // what the springs hold, of the share of each edge node
    for (int plane = 0; plane < s.grid.planes(); ++plane) {
      for (int side = 0; side < 2; ++side) {
        for (int axis = 0; axis < 2; ++axis) {
          for (int k = 0; k < s.grid.nodes_along(1 - axis); ++k) {
            const int at = side * (s.grid.nodes_along(axis) - 1), last_k = s.grid.nodes_along(1 - axis) - 1;
            const std::size_t n = axis == 0 ? s.node(at, k, plane) : s.node(k, at, plane);
            const double share = (k == 0 || k == last_k ? 0.5e-3 : 1e-3) / 4;
            for (std::size_t d = 0; d < 2; ++d) {
              const double u = s.position[d][n] - s.rest[d][n];
              stored += 0.5 * stiffness * share * u * u;
            }
          }
        }
      }
    }
    EXPECT_NEAR(ledger.edge_work / stored, 1, 0.01); // the work is summed by steps
  } else {
    EXPECT_GT(ledger.edge_loss, 0);
  }
}

TEST(LayerEdges, ImpulseAndEnergyAreBooked) {
  expect_edge_books(LayerEdge::fixed, 0);
  expect_edge_books(LayerEdge::symmetry, 0);
  expect_edge_books(LayerEdge::elastic, 1e9);
}

TEST(LayerEdges, FixedNodesStay) {
  LayerInput in = brick(hooke(), {4, 3, 1}, {1e-3, 1e-3, 0.5e-3}, 3);
  in.edge[0][1] = LayerEdge::fixed;
  LayerStack<3> s = make_stack<3>(in);
  place(s, s.velocity, [](std::array<double, 3>) -> std::array<double, 3> { return {3, 2, 50}; });
  ThreadPool pool(1);
  LayerLedger ledger;
  update_forces(s, 0.0, ledger, pool);
  for (int step = 0; step < 50; ++step) {
    substep(s, stable_step(s).dt, ledger, pool);
  }
  for (int plane = 0; plane < 2; ++plane) {
    for (int j = 0; j < 4; ++j) {
      for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_EQ(s.position[d][s.node(4, j, plane)], s.rest[d][s.node(4, j, plane)]);
      }
    }
  }
}

void expect_failure(LayerStack<3>& s, const std::string& part) {
  ThreadPool pool(1);
  LayerLedger ledger;
  try {
    update_forces(s, 0.0, ledger, pool);
    ADD_FAILURE() << "not found: " << part;
  } catch (const NumericalFailure& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(LayerStep, FailureNamesLayerAndElement) {
  LayerStack<3> s = make_stack<3>(brick(hooke(), {4, 3, 3}, {1e-3, 1e-3, 0.5e-3}, 3));
  s.position[0][s.node(4, 0, 5)] = std::numeric_limits<double>::quiet_NaN();
  expect_failure(s, "brick: layer 2, element (3, 0) of level 2");
  LayerStack<3> flat = make_stack<3>(brick(fabric_laws::paper(), {1, 1, 2}, {1e-3, 1e-3, 0.5e-3}, 3, 2));
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) { // E33 = -1/2
      flat.position[2][flat.node(i, j, 4)] = flat.position[2][flat.node(i, j, 3)];
    }
  }
  expect_failure(flat, "brick: layer 1, element (0, 0) of level 2");
}

TEST(LayerStack, RefusesNonsense) {
  const LayerInput good = brick(hooke(), {4, 3, 2}, {1e-3, 1e-3, 0.5e-3}, 3);
  const auto refused = [&](auto change, const std::string& part) {
    LayerInput in = good;
    change(in);
    try {
      make_stack<3>(in);
      ADD_FAILURE() << part;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  refused([](LayerInput& in) { in.levels.pop_back(); }, "need 3 levels, found 2");
  refused([](LayerInput& in) { in.lines[0][1] = 5; }, "lines[0] must rise; place 2");
  refused([](LayerInput& in) { in.lines[1].clear(); }, "lines[1] needs at least two places");
  refused([](LayerInput& in) { in.layers = 0; }, "at least 1");
  refused([](LayerInput& in) { in.axisymmetric = true; }, "no meaning in three dimensions");
  refused([](LayerInput& in) { in.edge[0][1] = LayerEdge::elastic; }, "positive with elastic edges");
  refused([](LayerInput& in) { in.edge_stiffness = 1; }, "0 without");
  refused([](LayerInput& in) { in.hourglass.stiffness = -1; }, "hourglass stiffness");
  refused([](LayerInput& in) { in.model = hooke(-1); }, "brick");
  LayerInput ring = brick(hooke(), {4, 3, 2}, {1e-3, 1e-3, 0.5e-3}, 2);
  ring.axisymmetric = true;
  EXPECT_THROW(make_stack<2>(ring), Error); // the axis is not an edge to leave free
}

} // namespace
} // namespace ballast
