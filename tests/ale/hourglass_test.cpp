// The hexahedron's corner forces: what hourglass control may and may not do.
#include "ale/corner_force.hpp"
#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "core/hex_geometry.hpp"

#include <gtest/gtest.h>
#include <random>

namespace ballast {
namespace {

constexpr double mode[4][8] = {{1, 1, -1, -1, -1, -1, 1, 1}, {1, -1, -1, 1, -1, 1, 1, -1},
                               {1, -1, 1, -1, 1, -1, 1, -1}, {-1, 1, -1, 1, 1, -1, 1, -1}};

TEST(Hourglass, ButterfliesAreTheModes) {
  for (int m = 0; m < 4; ++m) {
    double weight[4] = {0, 0, 0, 0}, at[8];
    weight[m] = 1;
    hourglass_at_corners(weight, at);
    for (int p = 0; p < 8; ++p) {
      EXPECT_EQ(at[p], mode[m][p]);
    }
    const HexModes back = hex_modes(at);
    for (int n = 0; n < 4; ++n) {
      EXPECT_EQ(back.hourglass[n], n == m ? 8 : 0);
    }
    EXPECT_EQ(back.xi, 0);
    EXPECT_EQ(back.eta, 0);
    EXPECT_EQ(back.zeta, 0);
  }
}

/// One distorted cell of gas without pressure, so that corner forces are the hourglass control's alone.
struct Corner {
  Block<3> block;
  double force[8][3] = {};
  double x[8][3] = {}, u[8][3] = {};

  template <class Velocity> explicit Corner(Velocity&& velocity) {
    Material gas;
    gas.name = "gas";
    gas.density = 1;
    gas.specific_energy = 2.5;
    block.materials.push_back(make_slot(gas, (1.4 - 1) * 2.5));
    block.reference_pressure = 1;
    allocate_block(block, {std::vector<double>{0, 1}, std::vector<double>{0, 1}, std::vector<double>{0, 1}});
    const CellPart part{0, 1, 1, 2.5};
    fill_cell<3>(block, 0, 0, 0, std::span(&part, 1));
    ThreadPool pool(1);
    update_state(block, pool);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part_of(-0.2, 0.2);
    constexpr int at[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    for (int p = 0; p < 8; ++p) {
      const int r = block.grid.node_row(at[p][1], at[p][2]);
      for (std::size_t d = 0; d < 3; ++d) {
        x[p][d] = at[p][d] + part_of(random);
        block.position[d].row(r)[at[p][0]] = x[p][d];
      }
      velocity(p, x[p], u[p], random);
      for (std::size_t d = 0; d < 3; ++d) {
        block.velocity[d].row(r)[at[p][0]] = u[p][d];
      }
    }
    block.pressure.row(block.grid.cell_row(0, 0))[0] = 0;
    block.modulus.row(block.grid.cell_row(0, 0))[0] = 0;
    CornerRows<3> out{};
    for (int p = 0; p < 8; ++p) {
      for (int d = 0; d < 3; ++d) {
        out.f[p][d] = &force[p][d];
      }
    }
    corner_forces(block, ForceRows<3>(block, 0, 0), ForceCoefficients{1e-9, 0.06}, 1, out);
  }
};

TEST(Hourglass, LinearMotionFeelsNothing) {
  const Corner c([](int, const double* x, double* u, auto&) {
    u[0] = 1 + 2 * x[0] - 3 * x[1] + 0.5 * x[2];
    u[1] = -2 + x[0] + 0.7 * x[1] - x[2];
    u[2] = 4 - x[0] + 2 * x[1] + 3 * x[2];
  });
  for (const auto& f : c.force) {
    for (const double component : f) {
      EXPECT_NEAR(component, 0, 1e-8); // the positions move by u dt / 2 before: 1e-9
    }
  }
}

TEST(Hourglass, TakesEnergyKeepsMomentumAndSpin) {
  const Corner c([](int, const double*, double* u, auto& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    for (int d = 0; d < 3; ++d) {
      u[d] = any(random);
    }
  });
  double power = 0, sum[3] = {0, 0, 0}, spin[3] = {0, 0, 0}, size = 0;
  for (int p = 0; p < 8; ++p) {
    const double *f = c.force[p], *x = c.x[p];
    for (int d = 0; d < 3; ++d) {
      power += f[d] * c.u[p][d];
      sum[d] += f[d];
      size = std::max(size, std::abs(f[d]));
      const int a = (d + 1) % 3, b = (d + 2) % 3;
      spin[d] += x[a] * f[b] - x[b] * f[a];
    }
  }
  EXPECT_GT(size, 1e-3);
  EXPECT_LT(power, -1e-3);
  for (int d = 0; d < 3; ++d) {
    EXPECT_NEAR(sum[d], 0, 1e-14);
    EXPECT_NEAR(spin[d], 0, 1e-8);
  }
}

} // namespace
} // namespace ballast
