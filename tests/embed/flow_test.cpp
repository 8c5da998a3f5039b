// Laws of plates in water: Taylor's plate, slow compression.
#include "tests/embed/channel.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

double env(const char* name, double otherwise) { return std::getenv(name) ? std::atof(std::getenv(name)) : otherwise; }

/// G. I. Taylor 1941: an exponential wave p0 exp(-t/theta) gives a free plate the momentum 2 p0 theta q^(q/(1-q)) until the water
/// behind it cavitates, q = rho c theta / m.
TEST(EmbeddedPlate, TakesTaylorsMomentum) {
  const double cell = env("CELL", 0.25e-3), h = 2e-3;
  const HookeSolid solid{200e9, 0.3, 7800};
  const double c = std::sqrt(4.4 * 6e8 / 1000), m = solid.density * h, p0 = 1e6;
  for (const double q : {0.5, 2.0, 10.0}) {
    const double theta = q * m / (1000 * c), until = theta * std::log(q) / (q - 1);
    const double length = std::ceil(3 * c * until / 1e-3) * 1e-3, from = length - 0.37 * cell;
    const Material water = channel_water();
    Scene<2> scene;
    scene.blocks.push_back(channel(length + 4e-3, cell, 1, [&](double z) {
      const double behind = from - z, p = behind > 0 ? p0 * std::exp(-behind / (c * theta)) : 0, rho = 1000 * std::pow(1 + p / 6e8, 1 / 4.4);
      return ChannelState{z < from + cell / 2, rho, (p + 4.4 * 6e8) / (3.4 * rho), z > 0 && z <= from ? p / (1000 * c) : 0};
    }));
    scene.layers.push_back(plate_across(solid, cell, 1, from, from + h, 6));
    scene.numerics.energy_return = false;
    embed(scene);
    Clock clock;
    clock.end_time = 4 * until;
    double momentum = 0, at = 0;
    while (!clock.done()) {
      advance(scene, clock);
      const double now = totals(scene.layers[0].stack).momentum[1] / cell;
      if (std::getenv("TRACE")) {
        fmt::print("{} t/theta {:.3f} I {:.5f} p {:.4g}\n", clock.step, clock.time / theta, now / (2 * p0 * theta), scene.embedded[0]->cut.empty() ? 0.0 : scene.blocks[0].pressure.row(scene.embedded[0]->cut[0].row)[0] / p0);
      }
      if (now > momentum) {
        momentum = now;
        at = clock.time;
      }
    }
    const double exact = std::pow(q, q / (1 - q));
    fmt::print("q {} I/I0 {:.5f} exact {:.5f} ratio {:.4f} at {:.3f} of {:.3f} theta\n", q, momentum / (2 * p0 * theta), exact, momentum / (2 * p0 * theta) / exact, at / theta, until / theta);
    EXPECT_NEAR(momentum / (2 * p0 * theta), exact, 0.03 * exact) << q;
  }
}

/// A heavy plate moves slowly into confined water: p = p_inf ((V0/V)^gamma - 1).
TEST(EmbeddedPlate, CompressesConfinedWaterSlowly) {
  const double cell = 1e-3, length = 20e-3, from = length + 0.1 * cell, travel = 0.01 * from, speed = env("SPEED", 1);
  const HookeSolid heavy{1e16, 0.3, 1e12};
  const Material water = channel_water();
  Scene<2> scene;
  scene.blocks.push_back(channel(26e-3, cell, 2, [&](double z) { return ChannelState{z < from + cell / 2, 1000, water.specific_energy, 0}; }));
  scene.layers.push_back(plate_across(heavy, 2 * cell, 2, from, from + 3e-3, 2));
  for (double& v : scene.layers[0].stack.velocity[1]) {
    v = -speed;
  }
  scene.numerics.energy_return = false;
  embed(scene);
  Clock clock;
  clock.end_time = travel / speed;
  double worst_mean = 0, ringing = 0;
  while (!clock.done()) {
    advance(scene, clock);
    const Block<2>& b = scene.blocks[0];
    const double now = scene.layers[0].stack.position[1][0];
    const double exact = 6e8 * (std::pow(from / now, 4.4) - 1);
    double sum = 0, worst = 0;
    for (int j = 0; j < 19; ++j) {
      sum += b.pressure.row(b.grid.cell_row(j, 0))[0] / 19;
    }
    for (int j = 0; j < 19; ++j) {
      worst = std::max(worst, std::abs(b.pressure.row(b.grid.cell_row(j, 0))[0] - sum));
    }
    if (clock.time > 0.2 * clock.end_time) {
      worst_mean = std::max(worst_mean, std::abs(sum / exact - 1));
      ringing = std::max(ringing, worst / exact);
    }
  }
  fmt::print("steps {} mean {:.2e} ringing {:.2e}\n", clock.step, worst_mean, ringing);
  EXPECT_LT(worst_mean, 1e-3);
  EXPECT_LT(ringing, 0.02);
}

} // namespace
} // namespace ballast
