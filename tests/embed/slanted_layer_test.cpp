// Laws of layers that lie anyhow in a mesh: nothing leaks, no shear passes, what rests stays at rest.
#include "tests/embed/two_waters.hpp"

namespace ballast {
namespace {

/// Three cells thick, and a third of one.
TEST(EmbeddedLayer, LeaksNothingWhileItIsDrivenThroughWater) {
  for (const double thickness : {3e-3, 0.3e-3}) {
    WaterBox box;
    box.thickness = thickness;
    box.height = 130e-3;
    box.z = 12e-3;
    Scene<2> scene = two_waters<2>(box, 0, 20, 0);
    const Totals start = totals(scene.blocks[0]);
    go(scene, 300e-6);
    expect_tight(scene, start);
    EXPECT_NEAR(scene.layers[0].stack.position[1][scene.layers[0].stack.node(20, 0, 0)], box.z + 6e-3, 2e-3); // went on
  }
}

/// A thin one and the waters on both sides of it, through a hundred cells, faster than they by a little.
TEST(EmbeddedLayer, LeaksNothingOverAHundredCells) {
  WaterBox box;
  box.thickness = 0.3e-3;
  box.width = 8e-3;
  box.x = 4e-3;
  box.height = 150e-3;
  box.z = 20e-3;
  box.reaches = 15e-3;
  box.carried = true;
  Scene<2> scene = two_waters<2>(box, 0, 100, 0);
  for (double& u : scene.layers[0].stack.velocity[1]) {
    u += 5;
  }
  const Totals start = totals(scene.blocks[0]);
  go(scene, 1e-3);
  expect_tight(scene, start);
  EXPECT_GT(scene.layers[0].stack.position[1][scene.layers[0].stack.node(20, 0, 0)], box.z + 100e-3);
}

TEST(EmbeddedLayer, LeaksNothingWhileItTurns) {
  for (const double thickness : {3e-3, 0.3e-3}) {
    WaterBox box;
    box.angle = 0;
    box.thickness = thickness;
    box.pressure = 1e8;
    Scene<2> scene = two_waters<2>(box, 0, 0, 2000);
    const Totals start = totals(scene.blocks[0]);
    go(scene, 200e-6); // by 23 degrees
    expect_tight(scene, start);
  }
}

TEST(EmbeddedLayer, LeaksNothingUnderPressureFromOneSide) {
  WaterBox box;
  box.thickness = 0.3e-3;
  Scene<2> scene = two_waters<2>(box, 0, 0, 0);
  Block<2>& b = scene.blocks[0];
  for_each_cell(b, [&](int i, int j, int k) { // the lower water hot: 100 MPa
    TileStore& store = b.materials[0].store;
    const int r = b.grid.cell_row(j, k);
    if (std::as_const(store).row(field::mass, r)[i] > 0) {
      store.row(field::energy, r)[i] += 1e8 / (3.4 * 1000);
    }
  });
  update_state(b, *scene.pool);
  const Totals start = totals(b);
  go(scene, 200e-6);
  expect_tight(scene, start);
}

/// A plane layer slides in its plane through water at rest: rho c V is 81 MPa, the water stays at rest to 1e-10 of the speed.
TEST(EmbeddedLayer, PassesNoShear) {
  Scene<2> scene = two_waters<2>({}, 50, 0, 0);
  go(scene, 20e-6);
  EXPECT_LT(fastest(scene.blocks[0]), 1e-10 * 50);
  EXPECT_EQ(mixed(scene.blocks[0]), 0.0);
}

/// Layers in water under an atmosphere, at rest: bitwise. A thin, light one's strains at its place are rounding, not zero; what they start swings on
/// below the speed at which viscosity fades (1e-7 c): tens of Pa.
TEST(EmbeddedLayer, RestsUnderAnAtmosphere) {
  for (const double thickness : {3e-3, 0.3e-3}) {
    WaterBox box;
    box.angle = 0;
    box.thickness = thickness;
    box.density = 1440;
    box.young = 10e9;
    box.pressure = box.reference = 101325;
    box.height = 24e-3;
    box.z = 12.3e-3;
    Scene<2> scene = two_waters<2>(box, 0, 0, 0);
    Clock clock;
    clock.end_time = 1;
    while (clock.step < 10000) {
      advance(scene, clock);
    }
    EXPECT_LE(fastest(scene.blocks[0]), thickness > 1e-3 ? 0.0 : 1e-7 * 1625);
  }
}

/// The same in 3D, turned about two axes.
TEST(EmbeddedLayer3D, LeaksNothingWhileItIsDrivenThroughWater) {
  for (const double thickness : {3e-3, 0.3e-3}) {
    WaterBox box;
    box.thickness = thickness;
    box.width = 8e-3;
    box.x = 4e-3;
    box.height = 30e-3;
    box.z = 12e-3;
    box.elements = 20;
    Scene<3> scene = two_waters<3>(box, 0, 20, 0);
    const auto height = [&] { return scene.layers[0].stack.position[2][scene.layers[0].stack.node(10, 10, 0)]; };
    const double from = height();
    const Totals start = totals(scene.blocks[0]);
    go(scene, 75e-6);
    expect_tight(scene, start);
    EXPECT_NEAR(height(), from + 1.5e-3, 0.2e-3); // went on
  }
}

TEST(EmbeddedLayer3D, LeaksNothingWhileItTurns) {
  WaterBox box;
  box.angle = 0;
  box.about = 0;
  box.width = 8e-3;
  box.x = 4e-3;
  box.height = 40e-3;
  box.z = 20e-3;
  box.pressure = 1e8;
  Scene<3> scene = two_waters<3>(box, 0, 0, 2000);
  const Totals start = totals(scene.blocks[0]);
  go(scene, 50e-6); // by 6 degrees
  expect_tight(scene, start);
}

TEST(EmbeddedLayer3D, PassesNoShear) {
  WaterBox box;
  box.width = 8e-3;
  box.x = 4e-3;
  Scene<3> scene = two_waters<3>(box, 50, 0, 0);
  go(scene, 10e-6);
  EXPECT_LT(fastest(scene.blocks[0]), 1e-10 * 50);
  EXPECT_EQ(mixed(scene.blocks[0]), 0.0);
}

TEST(EmbeddedLayer3D, RestsUnderAnAtmosphere) {
  WaterBox box;
  box.angle = 0;
  box.about = 0;
  box.density = 1440;
  box.young = 10e9;
  box.pressure = box.reference = 101325;
  box.width = 6e-3;
  box.x = 3e-3;
  box.height = 16e-3;
  box.z = 8.3e-3;
  Scene<3> scene = two_waters<3>(box, 0, 0, 0);
  Clock clock;
  clock.end_time = 1;
  while (clock.step < 300) {
    advance(scene, clock);
  }
  EXPECT_LT(fastest(scene.blocks[0]), 1e-9); // what a layer's element makes of rounding where it is not strained, 3e-12 N
}

} // namespace
} // namespace ballast
