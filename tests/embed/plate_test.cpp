// Laws of a flat Lagrangian plate in water that flows on a mesh at rest.
#include "tests/embed/channel.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

TEST(EmbeddedPlate, WaterOnAPlateMatchesImpedance) {
  const double cell = std::getenv("CELL") ? std::atof(std::getenv("CELL")) : 0.5e-3;
  const HookeSolid solid{30e9, 0.3, 2000};
  const double M = solid.young * (1 - solid.poisson) / ((1 + solid.poisson) * (1 - 2 * solid.poisson));
  const double speed = std::getenv("SPEED") ? std::atof(std::getenv("SPEED")) : 100;
  const double from = 30e-3 + 0.37 * cell, to = from + 30e-3, ends = std::getenv("GAP") ? from : from + cell / 2;
  Scene<2> scene;
  const Material water = channel_water();
  scene.blocks.push_back(channel(70e-3, cell, 2, [&](double z) {
    return ChannelState{z < ends, 1000, water.specific_energy, z > 0 && z < ends ? speed : 0};
  }));
  scene.layers.push_back(plate_across(solid, 2 * cell, 2, from, to, 120));
  scene.numerics.energy_return = false;
  embed(scene);
  const ChannelSums start = channel_sums(scene);
  Clock clock;
  clock.end_time = std::getenv("END") ? std::atof(std::getenv("END")) : 10e-6;
  const bool trace = std::getenv("TRACE") != nullptr;
  double peak = 0;
  double least_dt = 1;
  while (!clock.done()) {
    advance(scene, clock);
    least_dt = clock.step > 20 && !clock.done() ? std::min(least_dt, clock.dt) : least_dt;
    const Block<2>& b = scene.blocks[0];
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      peak = std::max(peak, b.pressure.row(b.grid.cell_row(j, 0))[0]);
    }
    if (std::getenv("ROWS") && clock.step <= 2) {
      for (int j = 55; j < 64; ++j) {
        for (int i = 0; i < 2; ++i) {
          fmt::print("{} {} m {:.10g} f {:.6g} V {:.6g}\n", j, i, b.materials[0].store.row(1, b.grid.cell_row(j, 0))[i], b.materials[0].store.row(0, b.grid.cell_row(j, 0))[i], b.volume.row(b.grid.cell_row(j, 0))[i]);
        }
      }
    }
    if (trace) {
      const ChannelSums now = channel_sums(scene);
      fmt::print("{:4d} t {:.4g} dt {:.3g} {} mass {:.3e} mom {:.3e} energy {:.3e} given {:.5g} taken {:.5g} v {:.5g}\n", clock.step, clock.time, clock.dt, name_of(clock.limit.cause), now.mass / start.mass - 1,
                 now.momentum / start.momentum - 1, (now.energy - start.energy) / start.kinetic, scene.ledger.embedded_given, scene.layers[0].ledger.load_work, scene.layers[0].stack.velocity[1][0]);
    }
  }
  const ChannelSums end = channel_sums(scene);
  const Block<2>& b = scene.blocks[0];
  const double c = std::sqrt(4.4 * 6e8 / 1000);
  const double z_plate = std::sqrt(solid.density * M);
  // Water's Hugoniot: p = rho u (a u + sqrt((a u)^2 + c^2)), a = (gamma + 1)/4.
  double v = 0;
  for (int pass = 0; pass < 100; ++pass) {
    const double u = speed - v, a = 1.35 * u;
    v = 0.5 * v + 0.5 * 1000 * u * (a + std::sqrt(a * a + c * c)) / z_plate;
  }
  const double pressure = z_plate * v;
  if (trace) {
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      const int r = b.grid.cell_row(j, 0);
      if (b.pressure.row(r)[0] != 0 || b.density.row(r)[0] > 0) {
        fmt::print("{:3d} z {:.4g} kind {} T {:.4g} rho {:.5g} p/p* {:.5f} u {:.5g} void {:.3g}\n", j, (j + 0.5) * cell, scene.embedded[0]->kind_of(b.grid, r, 0), b.volume.row(r)[0] / cell / cell, b.density.row(r)[0], b.pressure.row(r)[0] / pressure,
                   b.velocity[1].row(b.grid.node_row(j, 0))[0], b.materials[1].store.row(0, r)[0]);
      }
    }
  }
  const int at = static_cast<int>(27e-3 / cell);
  fmt::print("p/p* {:.5f} u/v* {:.5f} plate v {:.5f} peak {:.4f} dt c/dx {:.3f} mom {:.2e} energy {:.2e} loss {:.3e}\n", b.pressure.row(b.grid.cell_row(at, 0))[0] / pressure,
             b.velocity[1].row(b.grid.node_row(at, 0))[0] / v, scene.layers[0].stack.velocity[1][scene.layers[0].stack.node(0, 0, 5)] / v, peak / pressure, least_dt * c / cell, end.momentum / start.momentum - 1,
             (end.energy - start.energy) / start.kinetic, (scene.ledger.embedded_given - scene.layers[0].ledger.load_work) / start.kinetic);
  EXPECT_NEAR(b.pressure.row(b.grid.cell_row(at, 0))[0], pressure, 0.02 * pressure);
}

} // namespace
} // namespace ballast
