// q against shear and subzonal pressures: the laws of what they add to a quadrilateral's corner forces.
#include "ale/corner_force.hpp"
#include "ale/fill.hpp"
#include "ale/phases.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace ballast {
namespace {

using Place = std::array<std::array<double, 2>, 4>;

/// One cell of gas, 1 x 1 at r = 1, whose corners are brought to x with velocities u; forces of pressure and hourglass control left out.
struct OneCell {
  Block<2> block;
  std::array<std::array<double, 2>, 4> force{};

  OneCell(bool axisymmetric, const Place& x, const Place& u, double shear_q, double merit, double q0 = 0) {
    Material gas;
    gas.name = "gas";
    gas.density = 1;
    gas.specific_energy = 2.5;
    block.axisymmetric = axisymmetric;
    block.motion.policy = MotionPolicy::lagrangian;
    block.materials.push_back(make_slot(gas, 1));
    allocate_block(block, {std::vector<double>{1, 2}, std::vector<double>{0, 1}});
    mark_subzones(block);
    const CellPart part{0, 1, 1, 2.5};
    fill_cell<2>(block, 0, 0, 0, std::span(&part, 1));
    ThreadPool pool(1);
    update_state(block, pool);
    for (int p = 0; p < 4; ++p) {
      const int r = block.grid.node_row(p / 2, 0), i = p == 1 || p == 2 ? 1 : 0;
      for (std::size_t d = 0; d < 2; ++d) {
        block.position[d].row(r)[i] = x[static_cast<std::size_t>(p)][d];
        block.velocity[d].row(r)[i] = u[static_cast<std::size_t>(p)][d];
      }
    }
    const int r = block.grid.cell_row(0, 0);
    cell_volumes(block, block.position, 0, 0, {0, 1}, block.volume.row(r));
    block.viscosity[0].row(r)[0] = q0;
    block.strain_rate[0].row(r)[0] = -1;
    const auto with = forces({1e-9, 0, shear_q, merit}), without = forces({1e-9, 0, 0, 0});
    for (std::size_t p = 0; p < 4; ++p) {
      for (std::size_t d = 0; d < 2; ++d) {
        force[p][d] = with[p][d] - without[p][d];
      }
    }
  }

  std::array<std::array<double, 2>, 4> forces(const ForceCoefficients& c) const {
    std::array<std::array<double, 2>, 4> f{};
    CornerRows<2> out{};
    for (std::size_t p = 0; p < 4; ++p) {
      out.f[p][0] = &f[p][0];
      out.f[p][1] = &f[p][1];
    }
    corner_forces(block, ForceRows<2>(block, 0, 0), c, 1, out);
    return f;
  }
  /// sum f.v
  double power(const Place& v) const {
    double sum = 0;
    for (std::size_t p = 0; p < 4; ++p) {
      sum += force[p][0] * v[p][0] + force[p][1] * v[p][1];
    }
    return sum;
  }
  double largest() const {
    double most = 0;
    for (const auto& f : force) {
      most = std::max({most, std::abs(f[0]), std::abs(f[1])});
    }
    return most;
  }
};

constexpr Place square{{{1, 0}, {2, 0}, {2, 1}, {1, 1}}}, still{};
constexpr Place mode{{{1, 0}, {-1, 0}, {1, 0}, {-1, 0}}};

Place linear(double a, double b, double c, double d) {
  Place out{};
  for (std::size_t p = 0; p < 4; ++p) {
    out[p] = {0.3 + a * square[p][0] + b * square[p][1], -0.2 + c * square[p][0] + d * square[p][1]};
  }
  return out;
}

TEST(SubzonalPressure, LinearMotionFeelsNothing) {
  for (const bool axisymmetric : {false, true}) {
    EXPECT_EQ(OneCell(axisymmetric, square, still, 0, 1).largest(), 0);
    EXPECT_LT(OneCell(axisymmetric, linear(1.3, 0.4, -0.2, 0.7), still, 0, 1).largest(), 1e-14);
  }
}

TEST(SubzonalPressure, RestoresAnHourglassedCellAndKeepsMomentum) {
  for (const bool axisymmetric : {false, true}) {
    Place x = square;
    for (std::size_t p = 0; p < 4; ++p) {
      x[p][0] += 0.2 * mode[p][0];
    }
    const OneCell c(axisymmetric, x, still, 0, 1);
    EXPECT_LT(c.power(mode), -0.1);
    for (std::size_t d = 0; d < 2; ++d) {
      EXPECT_NEAR(c.force[0][d] + c.force[1][d] + c.force[2][d] + c.force[3][d], 0, 1e-14);
    }
  }
}

/// f = -dW/dx of W = K V sum (v_p - v0_p ln v_p), the work of dp_p on V_p, at fixed K V: at first order 1/2 K V sum (v_p - v0_p)^2 / v0_p.
/// An hourglass displacement z along x changes the quarters' shares 1/4 by -+ z / 4: W = 1/2 K V z^2, so f.mode = -K V z.
TEST(SubzonalPressure, HasTheStiffnessOfItsQuarters) {
  constexpr double z = 1e-4, modulus = 1.4; // gamma p, p = 0.4 x 1 x 2.5
  Place x = square;
  for (std::size_t p = 0; p < 4; ++p) {
    x[p][0] += z * mode[p][0];
  }
  EXPECT_NEAR(OneCell(false, x, still, 0, 1).power(mode) / (-modulus * z), 1, 1e-6);
  EXPECT_NEAR(OneCell(false, x, still, 0, 0.5).power(mode) / (-modulus * z), 0.5, 1e-6);
}

TEST(ShearViscosity, TakesTheEnergyOfANewtonianFluid) {
  const Place u = linear(-1, 0.5, 1.5, 0); // D_xy = 1
  const OneCell c(false, square, u, 1, 0, 3); // mu = q / |e| = 3
  EXPECT_NEAR(c.power(u), -3 * 4 * 1, 1e-7);  // -sigma:D V = -4 mu D_xy^2; positions move by u dt / 2: 1e-9
  for (std::size_t d = 0; d < 2; ++d) {
    EXPECT_NEAR(c.force[0][d] + c.force[1][d] + c.force[2][d] + c.force[3][d], 0, 1e-13);
  }
}

TEST(ShearViscosity, IsNothingWithoutQAndInRigidMotion) {
  EXPECT_EQ(OneCell(true, square, linear(-1, 0.5, 1.5, 0), 1, 0, 0).largest(), 0);
  EXPECT_LT(OneCell(false, square, linear(0, -1, 1, 0), 1, 0, 3).largest(), 1e-8);
}

/// Radial compression at u = -r: e_tt = e_rr, so q_tt = q_rr: it takes q e_tt V.
TEST(ShearViscosity, ResistsHoopCompressionAsRadial) {
  const Place u{{{-1, 0}, {-2, 0}, {-2, 0}, {-1, 0}}};
  const OneCell c(true, square, u, 1, 0, 3);
  EXPECT_NEAR(c.power(u), -3 * c.block.volume.row(c.block.grid.cell_row(0, 0))[0], 1e-6);
}

} // namespace
} // namespace ballast
