// Laws of heat between a film of gas and condensed matter in one cell.
#include "ale/fill.hpp"
#include "ale/simulation.hpp"
#include "materials/library.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

constexpr double atmosphere = 101325, width = 1e-3, hot = 10; // hot: times the initial energy

/// Cells 2 x 1 mm between walls, all alike: copper beside `film` of hot air, both at one atmosphere.
Scene<2> copper_beside_air(double film) {
  Material copper = *find_material("copper_ofhc"), air = *find_material("air");
  copper.specific_energy = energy(copper.eos, copper.density, atmosphere);
  air.specific_energy = energy(air.eos, air.density, atmosphere);
  Block<2> b;
  b.motion.policy = MotionPolicy::lagrangian;
  b.reference_pressure = atmosphere;
  b.materials.push_back(make_slot(copper, atmosphere));
  b.materials.push_back(make_slot(air, atmosphere));
  allocate_block(b, {std::vector<double>{0, 2 * width, 4 * width}, std::vector<double>{0, width}, {}});
  for (int i = 0; i < 2; ++i) {
    const CellPart parts[2] = {{0, 1 - film, copper.density, copper.specific_energy},
                               {1, film, air.density / hot, air.specific_energy * hot}};
    fill_cell<2>(b, i, 0, 0, parts);
  }
  Scene<2> scene;
  scene.blocks.push_back(std::move(b));
  prepare(scene);
  return scene;
}

/// Air's energy over its initial one after one step of `dt`; the energy of the scene must not change.
double air_after(double film, double dt) {
  Scene<2> scene = copper_beside_air(film);
  const Block<2>& b = scene.blocks[0];
  const auto before = totals(b).internal_energy;
  scene.numerics.dt_initial = dt;
  Clock clock;
  clock.end_time = 1;
  advance(scene, clock);
  EXPECT_EQ(clock.time, dt);
  const auto after = totals(b).internal_energy;
  EXPECT_NEAR(after[0] - before[0], before[1] - after[1], 1e-15 * before[0]);
  const MaterialSlot& air = b.materials[1];
  return air.store.row(field::energy, b.grid.cell_row(0, 0))[0] / air.reference.e;
}

TEST(GasFilm, ComesToItsInitialTemperatureByItsThickness) {
  const Material air = *find_material("air");
  for (const double film : {1e-5, 1e-4, 1e-3}) {
    const double dt = 1e-9, cv = air.specific_heat;
    const double thickness = film * width, rate = air.conductivity / (air.density / hot * cv * thickness * thickness);
    EXPECT_NEAR(air_after(film, dt), 1 + (hot - 1) / (1 + rate * dt), 1e-6) << film;
  }
}

TEST(GasFilm, ASliverOfMetalIsNoHeatBath) { EXPECT_NEAR(air_after(1 - 1e-9, 1e-9), hot, 1e-9); }

} // namespace
} // namespace ballast
