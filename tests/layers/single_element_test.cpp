// One element on a prescribed path against the printed formula: load, unload, rupture, ramp, erosion; work of a closed cycle.
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

using namespace stacks;

constexpr double size = 1e-3; ///< of the cube

/// The formulas of Raftenberg 2004 once more, from the paper, for comparison only.
double quotient(const RationalFit& k, double E) {
  return (k.a * E + k.b * E * E + k.c * E * E * E + k.d * E * E * E * E) / (1 + k.e * E + k.f * E * E);
}
double yarn(const YarnFamily& y, double E, double largest) {
  if (E < 0 || largest >= y.rupture + y.unload) {
    return 0;
  }
  return E <= y.rupture ? quotient(y.fit, E) : quotient(y.fit, y.rupture) * (1 - (E - y.rupture) / y.unload);
}
double pressed(const RationalFit& k, double E) { // form B
  return E < 0 ? quotient(k, E) / ((1 + 2 * E) * (1 + 2 * E)) : 0.0;
}

/// Stretches a cube along one axis to Green strain E; returns the force that holds its upper face along the axis.
struct Cube {
  LayerStack<3> s;
  ThreadPool pool{1};
  LayerLedger ledger;

  explicit Cube(const FabricModel& model) : s(make_stack<3>(brick(model, {1, 1, 1}, {size, size, size}, 3))) {}

  double pull(std::size_t axis, double E) {
    const double length = std::sqrt(1 + 2 * E);
    place(s, s.position, [&](std::array<double, 3> X) {
      X[axis] *= length;
      return X;
    });
    update_forces(s, 0.0, ledger, pool);
    double force = 0;
    for (std::size_t n = 0; n < s.node_count(); ++n) {
      force -= s.rest[axis][n] > 0 ? s.force[axis][n] : 0.0;
    }
    return force;
  }
};

TEST(SingleElement, FollowsThePrintedLawAlongEachAxis) {
  const RaftenbergFabric law = fabric_laws::paper();
  const auto follow = [&](std::size_t axis, const std::vector<double>& turns, auto formula) {
    Cube cube(law);
    double largest = 0;
    for (std::size_t k = 0; k + 1 < turns.size(); ++k) {
      for (int i = 0; i <= 100; ++i) {
        const double E = turns[k] + (turns[k + 1] - turns[k]) * i / 100;
        largest = std::max(largest, E);
        const double S = formula(E, largest), expected = std::sqrt(1 + 2 * E) * S * size * size; // P = F S
        EXPECT_NEAR(cube.pull(axis, E), expected, 1e-10 * std::max(std::abs(expected), 1.0)) << axis << ' ' << E;
      }
    }
  };
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const YarnFamily& y = axis == 0 ? law.warp : law.fill;
    const double end = y.rupture + y.unload;
    follow(axis, {0, 0.08, -0.1, 0.1, y.rupture, y.rupture + 0.2, 0.02, end - 0.01, end + 0.05, 0, 0.1}, [&y](double E, double largest) { return yarn(y, E, largest); });
  }
  follow(2, {0, -0.2, -0.02, 0.3, -0.42, 0}, [&law](double E, double) { return pressed(law.transverse, E); });
}

TEST(SingleElement, ShearFollowsTheLaw) { // simple shear: F_ij = gamma; P = F S
  const RaftenbergFabric law = fabric_laws::paper();
  struct Plane {
    std::size_t along, across;
    double modulus;
  };
  for (const Plane& plane : {Plane{0, 1, law.in_plane.modulus}, Plane{1, 2, law.through.modulus}, Plane{0, 2, law.through.modulus}}) {
    Cube cube(law);
    for (const double gamma : {0.05, 0.2, -0.1, 0.0}) {
      place(cube.s, cube.s.position, [&](std::array<double, 3> X) {
        X[plane.along] += gamma * X[plane.across];
        return X;
      });
      update_forces(cube.s, 0.0, cube.ledger, cube.pool);
      double force = 0;
      for (std::size_t n = 0; n < cube.s.node_count(); ++n) {
        force -= cube.s.rest[plane.across][n] > 0 ? cube.s.force[plane.along][n] : 0.0;
      }
      // E of the direction across is gamma^2/2: P_along,across = S_along,across + gamma S_across,across.
      const double E = 0.5 * gamma * gamma, S = plane.across == 1 ? yarn(law.fill, E, E) : pressed(law.transverse, E);
      const double expected = (plane.modulus * gamma + gamma * S) * size * size;
      EXPECT_NEAR(force, expected, 1e-10 * std::max(std::abs(expected), 1.0));
    }
  }
}

TEST(SingleElement, ErodesWhenBothFamiliesAreLost) {
  const RaftenbergFabric law = fabric_laws::paper();
  Cube cube(law);
  const auto both = [&](double warp, double fill) {
    place(cube.s, cube.s.position, [&](std::array<double, 3> X) {
      X[0] *= std::sqrt(1 + 2 * warp), X[1] *= std::sqrt(1 + 2 * fill);
      X[2] *= 0.9;
      return X;
    });
    for (int update = 0; update < 2; ++update) { // it goes with the update after the one that saw it lost
      update_forces(cube.s, 0.0, cube.ledger, cube.pool);
    }
    return cube.s.alive[0] != 0;
  };
  const double lost_warp = law.warp.rupture + law.warp.unload, lost_fill = law.fill.rupture + law.fill.unload;
  EXPECT_TRUE(both(lost_warp + 1e-9, 0));
  EXPECT_GT(largest_force(cube.s), 0);
  EXPECT_TRUE(both(0, lost_fill - 1e-9));
  EXPECT_FALSE(both(0, lost_fill + 1e-9));
  EXPECT_EQ(largest_force(cube.s), 0);
  EXPECT_EQ(cube.ledger.eroded_elements, 1);
  EXPECT_FALSE(both(0.01, 0.01));
  EXPECT_EQ(largest_force(cube.s), 0);
  EXPECT_EQ(cube.ledger.eroded_elements, 1);
  EXPECT_NEAR(totals(cube.s).mass / (law.density * size * size * size), 1, 1e-14);
  EXPECT_TRUE(std::isinf(stable_step(cube.s).dt));
}

// A layer of two elements through it has a hole once both have lost both families, not before: the next layer would see half of one.
TEST(SingleElement, ErodesByColumns) {
  LayerStack<3> s = make_stack<3>(brick(fabric_laws::paper(), {1, 1, 1}, {1e-3, 1e-3, 0.5e-3}, 3, 2));
  ThreadPool pool(1);
  LayerLedger ledger;
  for (std::size_t element = 0; element < 2; ++element) {
    for (auto& point : s.largest) {
      point[0][element] = point[1][element] = 1;
    }
    update_forces(s, 0.0, ledger, pool);
    EXPECT_EQ(s.alive[0], element == 0 ? 1 : 0);
    EXPECT_EQ(s.alive[1], element == 0 ? 1 : 0);
  }
  EXPECT_EQ(ledger.eroded_elements, 2);
}

// In a plane there is no fill: warp alone decides.
TEST(SingleElement, ErodesByWarpInAPlane) {
  LayerStack<2> s = make_stack<2>(brick(fabric_laws::paper(), {1, 1, 1}, {1e-3, 1, 0.5e-3}, 2));
  ThreadPool pool(1);
  LayerLedger ledger;
  s.largest[0][0][0] = s.largest[1][0][0] = 1;
  update_forces(s, 0.0, ledger, pool);
  EXPECT_EQ(s.alive[0], 0);
}

TEST(SingleElement, StaysUntilBothPointsHaveLostBothFamilies) {
  Cube cube(fabric_laws::paper());
  int lost = 0;
  for (auto& point : cube.s.largest) {
    for (auto& family : point) {
      update_forces(cube.s, 0.0, cube.ledger, cube.pool);
      EXPECT_EQ(cube.s.alive[0], 1) << lost;
      family[0] = 1;
      ++lost;
    }
  }
  update_forces(cube.s, 0.0, cube.ledger, cube.pool);
  EXPECT_EQ(cube.s.alive[0], 0);
}

TEST(SingleElement, CountsCrushedVolumes) {
  Cube cube(fabric_laws::paper());
  place(cube.s, cube.s.position, [](std::array<double, 3> X) -> std::array<double, 3> { return {0.1 * X[0], 0.4 * X[1], X[2]}; });
  update_forces(cube.s, 0.0, cube.ledger, cube.pool);
  EXPECT_EQ(cube.ledger.crushed, 1);
  EXPECT_EQ(cube.s.alive[0], 1);
}

/// Work booked on a closed smooth path of all strains in `steps` steps.
double cycle_work(const FabricModel& model, int steps) {
  Cube cube(model);
  cube.s.hourglass.viscosity = 0;
  const double period = 1e-7, dt = period / steps;
  const auto at = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / steps;
    place(cube.s, cube.s.position, [&](std::array<double, 3> X) -> std::array<double, 3> {
      const double c = 1 - std::cos(angle), d = std::sin(angle);
      return {X[0] * (1 + 0.05 * c) + 0.02 * d * X[1], X[1] * (1 + 0.04 * c + 0.02 * d) + 0.03 * c * X[2], X[2] * (1 - 0.1 * c + 0.03 * std::sin(2 * angle)) + 0.02 * d * X[0]};
    });
  };
  // The path is given: fast, so that rounding of what the forces add to velocity does not show. Each step's chord with the forces at both ends, as a step books it.
  for (int k = 0; k < steps; ++k) {
    for (int end = 0; end < 2; ++end) {
      at(k + end);
      update_forces(cube.s, dt, cube.ledger, cube.pool);
      const auto here = cube.s.position;
      at(k);
      const auto before = cube.s.position;
      at(k + 1);
      for (std::size_t n = 0; n < cube.s.node_count(); ++n) {
        for (std::size_t d = 0; d < 3; ++d) {
          cube.s.velocity[d][n] = (cube.s.position[d][n] - before[d][n]) / dt;
        }
      }
      cube.s.position = here;
      book_work(cube.s, dt / 2, cube.ledger, cube.pool);
    }
  }
  const LayerTotals t = totals(cube.s);
  return t.internal + t.hourglass;
}

TEST(SingleElement, WorkOfAClosedCycleFallsAtOrderTwo) {
  for (const FabricModel& model : {FabricModel{hooke()}, FabricModel{fabric_laws::paper()}}) {
    const double coarse = cycle_work(model, 100), fine = cycle_work(model, 200), finest = cycle_work(model, 400);
    EXPECT_NEAR(std::log2(std::abs(coarse / fine)), 2, 0.1) << coarse << ' ' << fine;
    EXPECT_NEAR(std::log2(std::abs(fine / finest)), 2, 0.05) << fine << ' ' << finest;
  }
}

} // namespace
} // namespace ballast
