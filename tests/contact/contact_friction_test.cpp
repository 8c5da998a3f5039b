// Coulomb friction: a block on an incline sticks below the coefficient and slides with its exact acceleration above.
#include "sheets.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double dt = 1e-5, g = 9.81; // s, m/s2

struct Slide {
  double distance = 0, speed = 0, friction_loss = 0, loss = 0, sideways = 0, mass = 0;
};

/// A sheet of n segments as a rigid block on a floor of 20, turned by the incline's angle; slope = its tangent.
template <int Dim> Slide slide(int n, double slope, double friction, int steps) {
  const double angle = std::atan(slope);
  Sheet<Dim> floor = flat_sheet<Dim>(20, 0, 0.02, 0, 1, 1), block = flat_sheet<Dim>(n, 0.0062, 0.005, 0, -1, 1e-2);
  const auto incline = [&](auto& f) {
    for (std::size_t k = 0; k < f[0].size(); ++k) {
      const double x = f[0][k], z = f[Dim - 1][k];
      f[0][k] = std::cos(angle) * x + std::sin(angle) * z;
      f[Dim - 1][k] = -std::sin(angle) * x + std::cos(angle) * z;
    }
  };
  incline(floor.x);
  incline(block.x);
  const auto start = block.x;
  std::vector<unsigned char> fixed(floor.mass.size(), (1 << Dim) - 1);
  ContactState<Dim> state;
  ContactSettings settings;
  settings.friction = friction;
  Slide out;
  for (const double m : block.mass) {
    out.mass += m;
  }
  for (int k = 0; k < steps; ++k) {
    for (double& v : block.v[Dim - 1]) {
      v -= dt * g;
    }
    ContactSurface<Dim> a = floor.view(), b = block.view();
    a.held = fixed.data();
    const ContactReport r = resolve_contact(a, b, dt, settings, state);
    out.friction_loss += r.friction_loss;
    out.loss += r.loss;
    auto v = block.momentum();
    for (double& c : v) {
      c /= out.mass;
    }
    block.set_velocity(v);
    block.move(dt);
    out.speed = std::cos(angle) * v[0] - std::sin(angle) * v[Dim - 1];
    out.sideways = std::sin(angle) * v[0] + std::cos(angle) * v[Dim - 1];
  }
  out.distance = std::hypot(block.x[0][1] - start[0][1], block.x[Dim - 1][1] - start[Dim - 1][1]);
  return out;
}

template <int Dim> void expect_coulomb(int n) {
  constexpr double friction = 0.5;
  constexpr int steps = 2000;
  const Slide stays = slide<Dim>(n, 0.49, friction, steps);
  EXPECT_LT(stays.distance, 1e-6 * 0.5 * g * steps * steps * dt * dt);
  const double slope = 0.8, angle = std::atan(slope), a = g * (std::sin(angle) - friction * std::cos(angle));
  const Slide slips = slide<Dim>(n, slope, friction, steps);
  EXPECT_NEAR(slips.speed, a * steps * dt, 1e-6 * g * steps * dt);
  const double work = friction * slips.mass * g * std::cos(angle) * slips.distance; // first order in dt: velocities change in the step
  EXPECT_NEAR(slips.friction_loss, work, 2e-3 * work);
  EXPECT_GE(slips.loss, slips.friction_loss * (1 - 1e-12));
  EXPECT_NEAR(slips.sideways, 0, 1e-6 * g * steps * dt);
  const Slide free = slide<Dim>(n, slope, 0, steps);
  EXPECT_NEAR(free.speed, g * std::sin(angle) * steps * dt, 1e-9 * g * steps * dt);
  EXPECT_EQ(free.friction_loss, 0);
}

TEST(ContactFriction, BlockOnInclineSticksOrSlides) {
  expect_coulomb<2>(5);
  expect_coulomb<2>(13);
  expect_coulomb<3>(5);
}

} // namespace
} // namespace ballast
