// Laws of layers that lie anyhow in a mesh: nothing leaks, no shear passes, what rests stays at rest.
#include "tests/embed/channel.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

/// Two waters, one on each side of a plate turned by `angle` about (x, z) in a box; the plate is wider than it, so that its ends lie outside.
struct Box {
  double cell = 1e-3, width = 12e-3, height = 60e-3;
  double angle = std::numbers::pi / 6, x = 6e-3, z = 30e-3, thickness = 3e-3, pressure = 0, density = 1e8, young = 1e13;
  double reference = 0; ///< Pa: forces are against it
  double reaches = 1;   ///< m: farther from the layer is void
  bool carried = false; ///< the waters move with the layer
};

Scene<2> two_waters(const Box& box, double along, double up, double spin) {
  Scene<2> scene;
  Block<2> b;
  b.motion = {MotionPolicy::eulerian, 1};
  b.reference_pressure = box.reference;
  const double rho = 1000 * std::pow(1 + box.pressure / 6e8, 1 / 4.4), e = (box.pressure + 4.4 * 6e8) / (3.4 * rho);
  Material water = channel_water();
  water.density = rho;
  water.specific_energy = e;
  for (const char* name : {"below", "above"}) {
    water.name = name;
    b.materials.push_back(make_slot(water, box.reference));
  }
  b.materials.push_back(make_void());
  const int nx = static_cast<int>(std::lround(box.width / box.cell)), nz = static_cast<int>(std::lround(box.height / box.cell));
  allocate_block(b, std::array<std::vector<double>, 3>{even_lines(0, box.width, nx), even_lines(0, box.height, nz), {}});
  const double padded = std::max(0.0, 1.05 * std::numbers::sqrt2 * box.cell - box.thickness); // below (ale/embed/layer_body)
  for_each_cell(b, [&](int i, int j, int k) {
    const double x = (i + 0.5) * box.cell - box.x, z = (j + 0.5) * box.cell - box.z;
    const bool is_void = std::abs(z) > box.reaches;
    const CellPart part{is_void ? 2 : -std::sin(box.angle) * x + std::cos(box.angle) * z > -padded / 2 ? 1 : 0, 1, is_void ? 0 : rho, is_void ? 0 : e};
    fill_cell<2>(b, i, j, k, std::span(&part, 1));
  });
  set_velocity(b, [&](const std::array<double, 2>& x, std::array<double, 2>& u) { u = {0, box.carried && std::abs(x[1] - box.z) < box.reaches ? up : 0.0}; });
  b.boundary.normal = {{{0, 0}, {1, 1}, {2, 2}}};
  for (auto& axis : b.boundary.side) {
    for (auto& side : axis) {
      side = {BoundaryKind::symmetry, 0};
    }
  }
  scene.blocks.push_back(std::move(b));
  const double half = 1.5 * std::hypot(box.width, box.height);
  LayerInput in;
  in.model = HookeSolid{box.young, 0.3, box.density};
  const bool flat = box.angle == 0; // made in its place: moved there it would be strained by rounding
  const double x0 = flat ? box.x : 0, z0 = flat ? box.z : 0;
  in.lines[0] = even_lines(x0 - half, x0 + half, 40);
  in.levels = even_lines(z0 - box.thickness / 2, z0 + box.thickness / 2, 1);
  Layers<2> l;
  l.stack = make_stack<2>(in);
  for (std::size_t n = 0; n < l.stack.node_count(); ++n) {
    const double x = l.stack.rest[0][n] - x0, z = l.stack.rest[1][n] - z0;
    const std::array<double, 2> off = {std::cos(box.angle) * x - std::sin(box.angle) * z, std::sin(box.angle) * x + std::cos(box.angle) * z};
    l.stack.position[0][n] = flat ? l.stack.rest[0][n] : box.x + off[0];
    l.stack.position[1][n] = flat ? l.stack.rest[1][n] : box.z + off[1];
    l.stack.velocity[0][n] = along * std::cos(box.angle) - spin * off[1];
    l.stack.velocity[1][n] = along * std::sin(box.angle) + up + spin * off[0];
  }
  scene.layers.push_back(std::move(l));
  scene.numerics.energy_return = false;
  embed(scene);
  return scene;
}

/// Volume (m2) of cells where both waters are, the lesser share of them.
double mixed(const Block<2>& b) {
  double sum = 0;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    for (int i = 0; i < b.grid.cells[0]; ++i) {
      const int r = b.grid.cell_row(j, 0);
      sum += b.volume.row(r)[i] * std::min(b.materials[0].store.row(field::fraction, r)[i], b.materials[1].store.row(field::fraction, r)[i]);
    }
  }
  return sum;
}

double fastest(const Block<2>& b) {
  double most = 0;
  for (int j = 0; j <= b.grid.cells[1]; ++j) {
    for (int i = 0; i <= b.grid.cells[0]; ++i) {
      const int r = b.grid.node_row(j, 0);
      most = std::max({most, std::abs(b.velocity[0].row(r)[i]), std::abs(b.velocity[1].row(r)[i])});
    }
  }
  return most;
}

void go(Scene<2>& scene, double end) {
  Clock clock;
  clock.end_time = end;
  EXPECT_TRUE(run(scene, clock));
}

void expect_tight(const Scene<2>& scene, const Totals& start) {
  const Totals end = totals(scene.blocks[0]);
  for (const std::size_t m : {0UL, 1UL}) {
    EXPECT_NEAR(end.mass[m], start.mass[m], 1e-12 * start.mass[m] + scene.ledger.sliver_mass); // of both
  }
  EXPECT_LT(mixed(scene.blocks[0]), 1e-12); // m2: a millionth of a cell, what fractions are rounded to
}

/// Three cells thick, and a third of one.
TEST(EmbeddedLayer, LeaksNothingWhileItIsDrivenThroughWater) {
  for (const double thickness : {3e-3, 0.3e-3}) {
    Box box;
    box.thickness = thickness;
    box.height = 130e-3;
    box.z = 12e-3;
    Scene<2> scene = two_waters(box, 0, 20, 0);
    const Totals start = totals(scene.blocks[0]);
    go(scene, 300e-6);
    expect_tight(scene, start);
    EXPECT_NEAR(scene.layers[0].stack.position[1][scene.layers[0].stack.node(20, 0, 0)], box.z + 6e-3, 2e-3); // went on
  }
}

/// A thin one and the waters on both sides of it, through a hundred cells, faster than they by a little.
TEST(EmbeddedLayer, LeaksNothingOverAHundredCells) {
  Box box;
  box.thickness = 0.3e-3;
  box.width = 8e-3;
  box.x = 4e-3;
  box.height = 150e-3;
  box.z = 20e-3;
  box.reaches = 15e-3;
  box.carried = true;
  Scene<2> scene = two_waters(box, 0, 100, 0);
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
    Box box;
    box.angle = 0;
    box.thickness = thickness;
    box.pressure = 1e8;
    Scene<2> scene = two_waters(box, 0, 0, 2000);
    const Totals start = totals(scene.blocks[0]);
    go(scene, 200e-6); // by 23 degrees
    expect_tight(scene, start);
  }
}

TEST(EmbeddedLayer, LeaksNothingUnderPressureFromOneSide) {
  Box box;
  box.thickness = 0.3e-3;
  Scene<2> scene = two_waters(box, 0, 0, 0);
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
  Scene<2> scene = two_waters({}, 50, 0, 0);
  go(scene, 20e-6);
  EXPECT_LT(fastest(scene.blocks[0]), 1e-10 * 50);
  EXPECT_EQ(mixed(scene.blocks[0]), 0.0);
}

/// Layers in water under an atmosphere, at rest: bitwise. A thin, light one's strains at its place are rounding, not zero; what they start swings on
/// below the speed at which viscosity fades (1e-7 c): tens of Pa.
TEST(EmbeddedLayer, RestsUnderAnAtmosphere) {
  for (const double thickness : {3e-3, 0.3e-3}) {
    Box box;
    box.angle = 0;
    box.thickness = thickness;
    box.density = 1440;
    box.young = 10e9;
    box.pressure = box.reference = 101325;
    box.height = 24e-3;
    box.z = 12.3e-3;
    Scene<2> scene = two_waters(box, 0, 0, 0);
    Clock clock;
    clock.end_time = 1;
    while (clock.step < 10000) {
      advance(scene, clock);
    }
    EXPECT_LE(fastest(scene.blocks[0]), thickness > 1e-3 ? 0.0 : 1e-7 * 1625);
  }
}

} // namespace
} // namespace ballast
