// Laws of a flat Lagrangian plate in water that flows on a mesh at rest: impedance, momentum, energy, Taylor's plate, slow compression.
#include "tests/embed/channel.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double sound = 1624.8076809271921; // sqrt(4.4 6e8 / 1000), m/s

double longitudinal_modulus(const HookeSolid& s) { return s.young * (1 - s.poisson) / ((1 + s.poisson) * (1 - 2 * s.poisson)); }

/// Velocity that water at `speed` and a plate of impedance z share: z v = rho u (a u + sqrt((a u)^2 + c^2)), u = speed - v, a = (gamma + 1)/4.
double shared_velocity(double speed, double z) {
  double v = 0;
  for (int pass = 0; pass < 200; ++pass) {
    const double u = speed - v, a = 1.35 * u;
    v = 0.5 * v + 0.5 * 1000 * u * (a + std::sqrt(a * a + sound * sound)) / z;
  }
  return v;
}

/// What flows along the channel up to a plate, 30 mm thick in 120 elements, that lies anyhow between the mesh's lines.
template <int Dim = 2> Scene<Dim> flow_on_plate(const Material& m, double speed, const HookeSolid& solid, double cell) {
  const double from = 30e-3 + 0.37 * cell;
  Scene<Dim> scene;
  const auto state = [&](double at) {
    const bool filled = at < from + cell / 2;
    return ChannelState{filled, m.density, m.specific_energy, at > 0 && filled ? speed : 0};
  };
  scene.blocks.push_back(channel<Dim>(70e-3, cell, 2, state, m));
  scene.layers.push_back(plate_across<Dim>(solid, 2 * cell, 2, from, from + 30e-3, 120));
  scene.numerics.energy_return = false;
  embed(scene);
  return scene;
}

/// 3 mm before the plate, and in it. Asked: 1 % at 0.25 mm, 2 % at 0.5 and 1 mm; momentum and energy to rounding.
template <int Dim> void expect_impedance(const Scene<Dim>& scene, const ChannelSums& start, double cell, double pressure, double v) {
  const Block<Dim>& b = scene.blocks[0];
  const LayerStack<Dim>& plate = scene.layers[0].stack;
  const ChannelSums end = channel_sums(scene);
  const int at = static_cast<int>(27e-3 / cell);
  const double within = cell < 0.3e-3 ? 0.01 : 0.02;
  EXPECT_NEAR(b.pressure.row(b.grid.cell_row(Dim == 3 ? 0 : at, Dim == 3 ? at : 0))[0], pressure, within * pressure) << cell;
  EXPECT_NEAR(b.velocity[Dim - 1].row(b.grid.node_row(Dim == 3 ? 0 : at, Dim == 3 ? at : 0))[0], v, within * v) << cell;
  EXPECT_NEAR(plate.velocity[Dim - 1][plate.node(0, 0, 5)], v, within * v) << cell;
  EXPECT_NEAR(end.mass, start.mass, 1e-12 * start.mass);
  EXPECT_NEAR(end.momentum, start.momentum, 1e-12 * start.momentum);
  EXPECT_NEAR(end.energy, start.energy, 1e-8 * start.kinetic);
}

TEST(EmbeddedPlate, WaterOnAPlateMatchesImpedance) {
  const HookeSolid solid{30e9, 0.3, 2000};
  const double z = std::sqrt(solid.density * longitudinal_modulus(solid)), speed = 100, v = shared_velocity(speed, z), pressure = z * v;
  for (const double cell : {1e-3, 0.5e-3, 0.25e-3}) {
    Scene<2> scene = flow_on_plate(channel_water(), speed, solid, cell);
    const ChannelSums start = channel_sums(scene);
    Clock clock;
    clock.end_time = 10e-6;
    double peak = 0, least_dt = 1;
    const Block<2>& b = scene.blocks[0];
    while (!clock.done()) {
      advance(scene, clock);
      least_dt = clock.step > 25 && !clock.done() ? std::min(least_dt, clock.dt) : least_dt; // past the growth of the first steps
      for (int j = 0; j < b.grid.cells[1]; ++j) {
        peak = std::max(peak, b.pressure.row(b.grid.cell_row(j, 0))[0]);
      }
    }
    expect_impedance(scene, start, cell, pressure, v);
    EXPECT_LT(peak, 1.3 * pressure);
    EXPECT_GT(least_dt, 0.2 * 0.5 * cell / sound); // of cfl cell / c
    const double lost = scene.ledger.embedded_given - scene.layers[0].ledger.load_work;
    EXPECT_GT(lost, 0);
    EXPECT_LT(lost, 0.05 * start.kinetic);
  }
}

/// The same in 3D.
TEST(EmbeddedPlate, WaterOnAPlateMatchesImpedanceIn3D) {
  const HookeSolid solid{30e9, 0.3, 2000};
  const double z = std::sqrt(solid.density * longitudinal_modulus(solid)), speed = 100, v = shared_velocity(speed, z);
  for (const double cell : {1e-3, 0.5e-3}) {
    Scene<3> scene = flow_on_plate<3>(channel_water(), speed, solid, cell);
    const ChannelSums start = channel_sums(scene);
    Clock clock;
    clock.end_time = 10e-6;
    ASSERT_TRUE(run(scene, clock));
    expect_impedance(scene, start, cell, z * v, v);
  }
}

/// Far inside a thick plate all is covered, however wide it is.
template <int Dim> void expect_covered() {
  constexpr double cell = 1e-3;
  const Material water = channel_water();
  Scene<Dim> scene;
  scene.blocks.push_back(channel<Dim>(40 * cell, cell, 12, [&](double at) { return ChannelState{at < 10 * cell, water.density, water.specific_energy, 0}; }));
  scene.layers.push_back(plate_across<Dim>({30e9, 0.3, 2000}, 12 * cell, 4, 12.3 * cell, 28.3 * cell, 4));
  embed(scene);
  const Grid& g = scene.blocks[0].grid;
  for_each_cell(scene.blocks[0], [&](int i, int j, int k) {
    const int across = Dim == 3 ? k : j;
    const bool inside = across >= 13 && across < 28, outside = across < 12 || across > 28;
    const int kind = scene.embedded[0]->kind_of(g, g.cell_row(j, k), i);
    EXPECT_EQ(kind == covered_cell, inside) << i << ' ' << j << ' ' << k;
    EXPECT_EQ(kind == open_cell, outside) << i << ' ' << j << ' ' << k;
  });
}
TEST(EmbeddedPlate, CoversAllThatIsFarInsideIt) {
  expect_covered<2>();
  expect_covered<3>();
}

/// Lead without strength, slow enough for Hooke's law: z v = rho u (c + s u), u = speed - v.
TEST(EmbeddedPlate, LeadOnAPlateMatchesImpedance) {
  const HookeSolid solid{30e9, 0.3, 2000};
  Material lead;
  lead.name = "lead";
  lead.eos = MieGruneisen{11350, 2051, 1.46, 2.77};
  lead.density = 11350;
  lead.spall_pressure = 0;
  const double z = std::sqrt(solid.density * longitudinal_modulus(solid)), speed = 10;
  double v = 0;
  for (int pass = 0; pass < 200; ++pass) {
    const double u = speed - v;
    v = 0.5 * v + 0.5 * lead.density * u * (2051 + 1.46 * u) / z;
  }
  for (const double cell : {1e-3, 0.5e-3, 0.25e-3}) {
    Scene<2> scene = flow_on_plate(lead, speed, solid, cell);
    const ChannelSums start = channel_sums(scene);
    Clock clock;
    clock.end_time = 8e-6;
    ASSERT_TRUE(run(scene, clock));
    expect_impedance(scene, start, cell, z * v, v);
  }
}

/// Elements that go open the plate where they were: water under pressure goes through there and nowhere else, and no pressure comes that the
/// exact rarefaction into void has not.
TEST(EmbeddedPlate, OpensWhereElementsHaveGone) {
  constexpr double cell = 1e-3, p = 200e6, from = 20.37e-3, thick = 2e-3;
  const Material water = channel_water();
  const double rho = 1000 * std::pow(1 + p / 6e8, 1 / 4.4);
  Scene<2> scene;
  scene.blocks.push_back(channel(60e-3, cell, 40, [&](double at) { return ChannelState{at < from + cell / 2, rho, (p + 4.4 * 6e8) / (3.4 * rho), 0}; }));
  scene.layers.push_back(plate_across({1e13, 0.3, 1e8}, 40 * cell, 40, from, from + thick, 2));
  embed(scene);
  LayerStack<2>& plate = scene.layers[0].stack;
  const Block<2>& b = scene.blocks[0];
  Clock clock;
  clock.end_time = 40e-6;
  double most = 0, least = p, beside = 0, through = 0;
  while (!clock.done()) {
    advance(scene, clock);
    for (int i = 15; i < 25 && clock.time > 2e-6; ++i) {
      for (int level = 0; level < plate.grid.levels(); ++level) {
        plate.alive[plate.element(i, 0, level)] = 0;
      }
    }
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      for (int i = 0; i < 40; ++i) {
        const int r = b.grid.cell_row(j, 0);
        const double q = b.pressure.row(r)[i], mass = b.materials[0].store.row(field::mass, r)[i], above = j * cell - (from + thick);
        most = std::max(most, q);
        least = std::min(least, q);
        if (above >= 0) {
          (i > 13 - above / cell && i < 26 + above / cell ? through : beside) += mass; // a jet may spread
        }
      }
    }
  }
  EXPECT_LT(most, 1.005 * p); // ahead of the wave, by dispersion
  EXPECT_GT(least, -1e-6 * p);
  EXPECT_GT(through, 0);
  EXPECT_LT(beside, 1e-12 * through);
}

/// A body's shape has jumped, and a cell holds more than it leaves room for: that is pressed out over a time, however many steps it has.
TEST(EmbeddedPlate, WhatAJumpPressesOutTakesATimeNotSteps) {
  constexpr double cell = 1e-3, jump = 0.05 * cell;
  const Material water = channel_water();
  const auto most_after = [&](int steps, double dt) {
    Scene<2> scene;
    scene.blocks.push_back(channel(40 * cell, cell, 4, [&](double at) { return ChannelState{at < 21 * cell, water.density, water.specific_energy, 0}; }));
    scene.layers.push_back(plate_across({30e9, 0.3, 2000}, 4 * cell, 4, 20.4 * cell, 26 * cell, 4));
    embed(scene);
    for (double& x : scene.layers[0].stack.position[1]) {
      x -= jump;
    }
    scene.numerics.dt_initial = scene.numerics.dt_max = dt;
    Clock clock;
    clock.end_time = 1;
    for (int step = 0; step < steps; ++step) {
      advance(scene, clock);
    }
    double most = 0;
    for_each_cell(scene.blocks[0], [&](int i, int j, int k) { most = std::max(most, scene.blocks[0].pressure.row(scene.blocks[0].grid.cell_row(j, k))[i]); });
    return most;
  };
  const double few = most_after(10, 1e-9), many = most_after(100, 1e-10); // both below the usual step, 3e-8 s
  EXPECT_GT(few, 1e5);
  EXPECT_NEAR(many, few, 0.05 * few);
  EXPECT_LT(most_after(1000, 1e-13), 4e4); // a whole cell's: rho c^2 0.002 (1e-10 / 3e-8) = 1.7e4 Pa
}

/// G. I. Taylor 1941: an exponential wave p0 exp(-t/theta) gives a free plate the momentum 2 p0 theta q^(q/(1-q)) until the water
/// behind it cavitates, q = rho c theta / m.
TEST(EmbeddedPlate, TakesTaylorsMomentum) {
  constexpr double cell = 0.25e-3, h = 2e-3, p0 = 1e6;
  const HookeSolid solid{200e9, 0.3, 7800};
  const double m = solid.density * h;
  for (const double q : {0.5, 2.0, 10.0}) {
    const double theta = q * m / (1000 * sound), until = theta * std::log(q) / (q - 1);
    const double length = std::ceil(3 * sound * until / 1e-3) * 1e-3, from = length - 0.37 * cell;
    Scene<2> scene;
    scene.blocks.push_back(channel(length + 4e-3, cell, 1, [&](double at) {
      const double behind = from - at, p = behind > 0 ? p0 * std::exp(-behind / (sound * theta)) : 0, rho = 1000 * std::pow(1 + p / 6e8, 1 / 4.4);
      return ChannelState{at < from + cell / 2, rho, (p + 4.4 * 6e8) / (3.4 * rho), at > 0 && at <= from ? p / (1000 * sound) : 0};
    }));
    scene.layers.push_back(plate_across(solid, cell, 1, from, from + h, 6));
    scene.numerics.energy_return = false;
    embed(scene);
    Clock clock;
    clock.end_time = 2 * until;
    double momentum = 0;
    while (!clock.done()) {
      advance(scene, clock);
      momentum = std::max(momentum, totals(scene.layers[0].stack).momentum[1] / cell);
    }
    const double exact = std::pow(q, q / (1 - q));
    EXPECT_NEAR(momentum / (2 * p0 * theta), exact, 0.03 * exact) << q;
  }
}

/// A heavy plate moves slowly into confined water, across lines of the mesh: p = p_inf ((V0/V)^gamma - 1), 30,000 steps and more.
TEST(EmbeddedPlate, CompressesConfinedWaterSlowly) {
  constexpr double cell = 1e-3, from = 20.1e-3, travel = 0.01 * from, speed = 0.034;
  const Material water = channel_water();
  Scene<2> scene;
  scene.blocks.push_back(channel(26e-3, cell, 1, [&](double at) { return ChannelState{at < from + cell / 2, 1000, water.specific_energy, 0}; }));
  scene.layers.push_back(plate_across({1e16, 0.3, 1e12}, cell, 1, from, from + 3e-3, 2));
  for (double& v : scene.layers[0].stack.velocity[1]) {
    v = -speed;
  }
  scene.numerics.energy_return = false;
  embed(scene);
  Clock clock;
  clock.end_time = travel / speed;
  double worst_mean = 0, ringing = 0;
  const Block<2>& b = scene.blocks[0];
  while (!clock.done()) {
    advance(scene, clock);
    const double exact = 6e8 * (std::pow(from / scene.layers[0].stack.position[1][0], 4.4) - 1);
    double mean = 0, worst = 0;
    for (int j = 0; j < 19; ++j) {
      mean += b.pressure.row(b.grid.cell_row(j, 0))[0] / 19;
    }
    for (int j = 0; j < 19; ++j) {
      worst = std::max(worst, std::abs(b.pressure.row(b.grid.cell_row(j, 0))[0] - mean));
    }
    if (clock.time > 0.2 * clock.end_time) {
      worst_mean = std::max(worst_mean, std::abs(mean / exact - 1));
      ringing = std::max(ringing, worst / exact);
    }
  }
  EXPECT_GT(clock.step, 30000);
  EXPECT_LT(worst_mean, 1e-3);
  EXPECT_LT(ringing, 0.02);
}

/// Water leaves a plate at rest: void opens, nothing pulls.
TEST(EmbeddedPlate, DoesNotPullWhatLeavesIt) {
  constexpr double cell = 0.5e-3, from = 10e-3 + 0.37 * cell;
  const Material water = channel_water();
  Scene<2> scene;
  scene.blocks.push_back(channel(20e-3, cell, 1, [&](double at) {
    const bool filled = at > 4e-3 && at < from + cell / 2;
    return ChannelState{filled, 1000, water.specific_energy, filled ? -20.0 : 0.0};
  }));
  scene.layers.push_back(plate_across({30e9, 0.3, 2000}, cell, 1, from, from + 5e-3, 10));
  scene.numerics.energy_return = false;
  embed(scene);
  Clock clock;
  clock.end_time = 50e-6;
  EXPECT_TRUE(run(scene, clock));
  EXPECT_NEAR(scene.layers[0].stack.velocity[1][0], 0, 1e-3 * 20);
  const Block<2>& b = scene.blocks[0];
  const int beside = static_cast<int>(from / cell) - 1;
  EXPECT_GT(b.materials[1].store.row(field::fraction, b.grid.cell_row(beside, 0))[0], 0.5); // a millimetre of it
}

} // namespace
} // namespace ballast
