// Laws of the open boundaries: what comes in is what was prescribed, what goes out follows its wave.
#include "ale/fill.hpp"
#include "ale/outflow.hpp"
#include "ale/simulation.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <utility>

namespace ballast {
namespace {

constexpr double c = 2, rho = 3; // p = rho c^2 / gamma

Material gas(const std::string& name, double density) {
  Material m;
  m.name = name;
  m.eos = IdealGas{1.4};
  m.density = density;
  m.specific_energy = energy(m.eos, density, rho * c * c / 1.4);
  return m;
}

/// Gas at pressure rho c^2 / 1.4, cells of length 0.1 along `axis`, one across; velocities by node along the axis.
template <int Dim> Block<Dim> row_of_gas(int axis, const std::vector<double>& u, MotionPolicy policy) {
  Block<Dim> b;
  b.motion.policy = policy;
  b.materials.push_back(make_slot(gas("inside", rho), 0));
  b.materials.push_back(make_slot(gas("other", 2 * rho), 0));
  const auto a = static_cast<std::size_t>(axis);
  std::array<std::vector<double>, 3> lines;
  for (std::size_t d = 0; d < Dim; ++d) {
    lines[d] = {0, 0.1};
  }
  for (std::size_t i = 2; i < u.size(); ++i) {
    lines[a].push_back(0.1 * static_cast<double>(i));
  }
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    fill_cell<Dim>(b, i, j, k, std::vector<CellPart>{{0, 1, rho, b.materials[0].material.specific_energy}});
  });
  set_velocity(b, [&](const std::array<double, Dim>& x, std::array<double, Dim>& v) {
    v[a] = u[static_cast<std::size_t>(std::lround(x[a] / 0.1))];
  });
  ThreadPool pool(1);
  compute_node_mass(b, pool);
  update_state(b, pool);
  return b;
}

TEST(Inflow, GhostNodesHoldThePrescribedVelocityWhateverIsInside) {
  Block<2> b = row_of_gas<2>(0, {1, 5, -3, 8, 2}, MotionPolicy::eulerian);
  b.boundary.side[0][0] = inflow_side(0, {0, rho, 1, {1, 7, 0}});
  for (int d = 0; d < 2; ++d) {
    RowField& u = b.velocity[static_cast<std::size_t>(d)];
    exchange_nodes(b.grid, b.boundary, d, u);
    for (int j = 0; j <= 1; ++j) {
      EXPECT_EQ(u.row(b.grid.node_row(j, 0))[-1], d == 0 ? 1 : 7);
      EXPECT_EQ(u.row(b.grid.node_row(j, 0))[-2], d == 0 ? 1 : 7);
    }
  }
}

/// A gas of twice the density follows the first at the same speed and pressure: nothing may change but who is there.
template <int Dim> void brings_in(int axis, int side) {
  const double u = side == 0 ? 1 : -1, t = 0.333;
  const auto a = static_cast<std::size_t>(axis), s = static_cast<std::size_t>(side);
  Scene<Dim> scene;
  Block<Dim> b = row_of_gas<Dim>(axis, std::vector<double>(9, u), MotionPolicy::eulerian);
  InflowState state{1, 2 * rho, b.materials[1].material.specific_energy, {}};
  state.velocity[a] = u;
  b.boundary.side[a][s] = inflow_side(axis, state);
  b.boundary.side[a][1 - s] = {BoundaryKind::outflow, 0, {}};
  scene.blocks.push_back(std::move(b));
  prepare(scene);
  Clock clock;
  clock.end_time = t;
  run(scene, clock);
  const Block<Dim>& end = scene.blocks[0];
  const double area = std::pow(0.1, Dim - 1), entered = 2 * rho * area * t;
  const Totals sums = totals(end);
  EXPECT_NEAR(sums.mass[1] / entered, 1, 1e-12);
  EXPECT_NEAR(-scene.ledger.mass_out[1] / entered, 1, 1e-12);
  EXPECT_NEAR(sums.internal_energy[1] / (entered * state.specific_energy), 1, 1e-12);
  EXPECT_NEAR(sums.mass[0], rho * area * (0.8 - t), 1e-12 * rho * area);
  for_each_cell(end, [&](int i, int j, int k) {
    const int r = end.grid.cell_row(j, k);
    EXPECT_NEAR(end.pressure.row(r)[i] / (rho * c * c / 1.4), 1, 1e-12);
    EXPECT_NEAR(end.velocity[a].row(end.grid.node_row(j, k))[i], u, 1e-12);
  });
}

TEST(Inflow, BringsInAMaterialThatWasNotThereThroughEverySide) {
  for (int side = 0; side < 2; ++side) {
    for (int axis = 0; axis < 2; ++axis) {
      brings_in<2>(axis, side);
    }
    for (int axis = 0; axis < 3; ++axis) {
      brings_in<3>(axis, side);
    }
  }
}

TEST(Outflow, NodeTakesTheVelocityThatStoodOneWaveTravelFurtherIn) {
  const double slope = 0.7, dt = 0.02;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> u;
    for (int i = 0; i <= 6; ++i) {
      u.push_back(slope * 0.1 * i);
    }
    const Block<3> b = row_of_gas<3>(axis, u, MotionPolicy::lagrangian);
    std::array<int, 3> high{};
    high[static_cast<std::size_t>(axis)] = 6;
    EXPECT_NEAR(outflow_velocity(b, axis, 1, high, dt), slope * (0.6 - c * dt), 1e-14);
    EXPECT_NEAR(outflow_velocity(b, axis, 0, {}, dt), slope * c * dt, 1e-14);
  }
}

TEST(Outflow, FlowThroughTheMeshAddsItsOwnSpeed) {
  const double slope = 0.7, dt = 0.02;
  std::vector<double> u;
  for (int i = 0; i <= 6; ++i) {
    u.push_back(slope * 0.1 * i);
  }
  const Block<2> b = row_of_gas<2>(0, u, MotionPolicy::eulerian);
  EXPECT_NEAR(outflow_velocity(b, 0, 1, {6, 0, 0}, dt), slope * (0.6 - (c + slope * 0.55) * dt), 1e-14);
}

TEST(Outflow, StaysBetweenItsOwnAndItsNeighboursVelocity) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1), step(0, 0.2);
  for (int trial = 0; trial < 1000; ++trial) {
    const double un = value(random), u1 = value(random), u2 = value(random);
    const Block<2> b = row_of_gas<2>(0, {0, u2, u1, un}, MotionPolicy::eulerian);
    const double next = outflow_velocity(b, 0, 1, {3, 0, 0}, step(random));
    EXPECT_GE(next, std::min(un, u1) - 1e-15);
    EXPECT_LE(next, std::max(un, u1) + 1e-15);
  }
}

} // namespace
} // namespace ballast
