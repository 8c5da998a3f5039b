// Mixed cells with strength: the interface's traction is common, the materials' strains are their
// own.
#include "ale/traction.hpp"

#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "ale/strength_update.hpp"
#include "materials/library.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

namespace ballast {
namespace {

constexpr double cell = 1e-3; // m
constexpr int columns = 5, middle = 2;

/// Five by three cells: copper to the left, half a cell of it in the middle column, `other` (or
/// void) beside it.
template <int Dim> struct Interface {
  Scene<Dim> scene;
  Block<Dim>& block;

  explicit Interface(const char* other) : scene(), block(scene.blocks.emplace_back()) {
    const Material copper = *find_material("copper_ofhc");
    block.materials.push_back(make_slot(copper, 0));
    Material soft;
    if (other) {
      soft = *find_material(other);
      block.materials.push_back(make_slot(soft, 0));
    }
    block.materials.push_back(make_void());
    std::vector<double> x, y;
    for (int i = 0; i <= columns; ++i) {
      x.push_back(cell * i);
    }
    y.assign(x.begin(), x.begin() + 4);
    allocate_block(block, {x, y, Dim == 3 ? y : std::vector<double>{}});
    for_each_cell(block, [&](int i, int j, int k) {
      const double f = i < middle ? 1 : i == middle ? 0.5 : 0;
      const CellPart parts[2] = {{0, f, copper.density, copper.specific_energy},
                                 {1, 1 - f, soft.density, soft.specific_energy}};
      fill_cell<Dim>(block,
                     i,
                     j,
                     k,
                     std::span<const CellPart>(parts + (f > 0 ? 0 : 1), f > 0 && f < 1 ? 2 : 1));
    });
    prepare();
  }
  /// All sides free, nodes' masses and the state.
  void prepare() {
    for (int axis = 0; axis < Dim; ++axis) {
      for (int side = 0; side < 2; ++side) {
        block.boundary.side[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)].kind =
            BoundaryKind::free;
      }
    }
    compute_node_mass(block, *scene.pool);
    pull_back_to_yield(block, *scene.pool);
    update_state(block, *scene.pool);
    update_traction(block, *scene.pool);
  }
  int row() const { return block.grid.cell_row(1, Dim == 3 ? 1 : 0); }
  MaterialSlot& copper() { return block.materials.front(); }
};

// Pulled along its surface the copper is in uniaxial tension: s = sigma (2/3, -1/3, -1/3), p =
// -sigma/3.
template <int Dim> void expect_surface_keeps_tension(const char* other) {
  constexpr double sigma = 60e6;
  Interface<Dim> a(other);
  const int r = a.row();
  a.copper().store.row(field::stress, r)[middle] = -sigma / 3;
  a.copper().store.row(field::stress + 1, r)[middle] = 2 * sigma / 3;
  a.copper().store.row(a.copper().pressure_field(), r)[middle] = -sigma / 3;
  if (other) {
    MaterialSlot& soft = a.block.materials[1];
    soft.store.row(soft.pressure_field(), r)[middle] = 0;
  }
  update_traction(a.block, *a.scene.pool);
  const double p = a.block.pressure.row(r)[middle];
  const double xx = a.block.stress[0].row(r)[middle], yy = a.block.stress[1].row(r)[middle];
  EXPECT_NEAR(-p + xx, 0, 1e-9 * sigma) << "the surface is free";
  EXPECT_NEAR(-p + yy, 0.5 * sigma, 1e-9 * sigma) << "half the cell carries the tension";
  EXPECT_NEAR(-p - xx - yy, 0, 1e-9 * sigma);
}

TEST(Traction, SurfaceKeepsItsTangentialStress) {
  for (const char* other : {static_cast<const char*>(nullptr), "muscle"}) {
    expect_surface_keeps_tension<2>(other);
    expect_surface_keeps_tension<3>(other);
  }
}

// Sheared along the interface by one half: the muscle takes it all, the copper neither yields nor
// carries more than the muscle does.
template <int Dim> void expect_soft_takes_the_shear() {
  Interface<Dim> a("muscle");
  Block<Dim>& b = a.block;
  Clock clock;
  clock.dt = 1e-8;
  const double rate = 0.5 / clock.dt;
  for (int k = 0; k <= (Dim == 3 ? 3 : 0); ++k) {
    for (int j = 0; j <= 3; ++j) {
      for (int i = 0; i <= columns; ++i) {
        const double uy = -rate * cell * std::clamp(i - middle, 0, 1);
        b.velocity[1].row(b.grid.node_row(j, k))[i] = uy;
      }
    }
  }
  const Totals before = totals(b);
  lagrange_step(a.scene, clock);
  const int r = a.row();
  const double limit = 0.2e6 / std::sqrt(3.0);
  EXPECT_EQ(a.copper().store.row(field::plastic_strain<Dim>, r)[middle], 0);
  EXPECT_LE(std::abs(a.copper().store.row(field::stress + 2, r)[middle]), limit * (1 + 1e-12));
  EXPECT_GT(b.materials[1].store.row(field::plastic_strain<Dim>, r)[middle], 0.1);
  compute_node_mass(b, *a.scene.pool);
  const Totals after = totals(b);
  EXPECT_NEAR(after.kinetic_energy + after.internal(),
              before.kinetic_energy + before.internal(),
              1e-13 * before.kinetic_energy);
}

TEST(Traction, SoftMatterTakesTheShearOfItsCell) {
  expect_soft_takes_the_shear<2>();
  expect_soft_takes_the_shear<3>();
}

// A void that closes squeezes nothing: the copper keeps its volume, and its stress is what its
// surface stretch makes.
TEST(Traction, ClosingVoidDoesNotFlattenTheCopper) {
  Interface<2> a(nullptr);
  Block<2>& b = a.block;
  Clock clock;
  clock.dt = 1e-8;
  for (int j = 0; j <= 3; ++j) {
    for (int i = middle + 1; i <= columns; ++i) {
      b.velocity[0].row(b.grid.node_row(j, 0))[i] = -0.1 * cell / clock.dt;
    }
  }
  lagrange_step(a.scene, clock);
  const int r = a.row();
  EXPECT_EQ(a.copper().store.row(field::plastic_strain<2>, r)[middle], 0);
  const double shared = 2 * 46e9 * 0.1; // what the cell's own strain would make of it
  EXPECT_NEAR(a.copper().store.row(field::stress, r)[middle], 0, 1e-4 * shared);
}

/// Copper beside void, `fraction(x, y)` of it in the cell whose centre is (x, y) cells from the origin; columns
/// from `first` to `last`.
template <class Fraction> std::unique_ptr<Scene<2>> copper_in_void(int first, int last, int rows, Fraction&& fraction) {
  auto scene = std::make_unique<Scene<2>>();
  Block<2>& b = scene->blocks.emplace_back();
  const Material copper = *find_material("copper_ofhc");
  b.materials.push_back(make_slot(copper, 0));
  b.materials.push_back(make_void());
  std::vector<double> x, y;
  for (int i = first; i <= last; ++i) {
    x.push_back(cell * i);
  }
  for (int j = 0; j <= rows; ++j) {
    y.push_back(cell * j);
  }
  allocate_block(b, {x, y, {}});
  for_each_cell(b, [&](int i, int j, int k) {
    const double f = fraction(first + i + 0.5, j + 0.5);
    const CellPart parts[2] = {{0, f, copper.density, copper.specific_energy}, {1, 1 - f, 0, 0}};
    fill_cell<2>(b, i, j, k, std::span<const CellPart>(parts + (f > 0 ? 0 : 1), f > 0 && f < 1 ? 2 : 1));
  });
  pull_back_to_yield(b, *scene->pool);
  update_state(b, *scene->pool);
  update_traction(b, *scene->pool);
  return scene;
}

/// Normals of all mixed cells, row by row.
std::vector<std::array<double, 3>> normals_of(const Scene<2>& scene) {
  const Block<2>& b = scene.blocks[0];
  std::vector<std::array<double, 3>> out;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    const auto& row = b.interface_normals[static_cast<std::size_t>(b.grid.cell_row(j, 0))];
    out.insert(out.end(), row.begin(), row.end());
  }
  return out;
}

std::vector<std::array<double, 3>> normals_of_a_ridge(int first_column, int rows) {
  return normals_of(
      *copper_in_void(first_column, 3, rows, [](double x, double y) { return 0.8 - 0.05 * x * x - 0.1 * y; }));
}

TEST(Traction, NormalAtASideIsThatOfTheMirroredWhole) {
  const auto half = normals_of_a_ridge(0, 3), whole = normals_of_a_ridge(-3, 3);
  ASSERT_EQ(half.size(), 9u);
  ASSERT_EQ(whole.size(), 18u);
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t d = 0; d < 2; ++d) {
        const double sign = half[3 * j + i][1] * whole[6 * j + 3 + i][1] < 0 ? -1 : 1; // a line, not an arrow
        EXPECT_NEAR(half[3 * j + i][d], sign * whole[6 * j + 3 + i][d], 1e-12) << i << ' ' << j;
      }
    }
  }
}

TEST(Traction, NormalOfASingleRowIsAlongIt) {
  for (const auto& n : normals_of_a_ridge(0, 1)) {
    EXPECT_NEAR(std::abs(n[0]), 1, 1e-12);
  }
}

// A sheet within one row of cells, thinner from cell to cell: void on both its sides, so the mean gradient
// across it is nothing. It pulls along itself all the same.
TEST(Traction, SheetInOneRowPullsAlongItself) {
  constexpr double sigma = 60e6;
  const auto scene = copper_in_void(0, 5, 3, [](double x, double y) { return y == 1.5 ? 0.5 - 0.01 * x : 0; });
  Block<2>& b = scene->blocks[0];
  const int r = b.grid.cell_row(1, 0), i = 2;
  MaterialSlot& copper = b.materials[0];
  copper.store.row(field::stress, r)[i] = 2 * sigma / 3;
  copper.store.row(field::stress + 1, r)[i] = -sigma / 3;
  copper.store.row(copper.pressure_field(), r)[i] = -sigma / 3;
  update_traction(b, *scene->pool);
  for (const auto& n : normals_of(*scene)) {
    EXPECT_NEAR(std::abs(n[1]), 1, 0.05);
  }
  const double f = 0.475, p = b.pressure.row(r)[i];
  EXPECT_NEAR(-p + b.stress[0].row(r)[i], f * sigma, 0.02 * f * sigma);
  EXPECT_NEAR(-p + b.stress[1].row(r)[i], 0, 0.02 * f * sigma);
}

TEST(Traction, EvenCellHasNoNormal) {
  const auto scene = copper_in_void(0, 5, 3, [](double, double) { return 0.5; });
  for (const auto& n : normals_of(*scene)) {
    EXPECT_EQ(n, (std::array<double, 3>{}));
  }
}

// Muscle takes the shear of its cell whether or not a trace of void is there too.
TEST(Traction, TraceOfVoidChangesNothing) {
  double stress[2] = {};
  for (const double trace : {0.0, 1e-6}) {
    Interface<2> a("muscle");
    Block<2>& b = a.block;
    const int r = a.row();
    if (trace > 0) {
      const Material &copper = a.copper().material, &muscle = b.materials[1].material;
      const CellPart parts[3] = {{0, 0.5, copper.density, copper.specific_energy},
                                 {1, 0.5 - trace, muscle.density, muscle.specific_energy},
                                 {2, trace, 0, 0}};
      fill_cell<2>(b, middle, 1, 0, parts);
      a.prepare();
    }
    a.copper().store.row(field::stress + 2, r)[middle] = 40e6;
    update_traction(b, *a.scene.pool);
    stress[trace > 0] = a.copper().store.row(field::stress + 2, r)[middle];
    EXPECT_NEAR(std::abs(b.interface_normals[static_cast<std::size_t>(r)][0][0]), 1, 1e-4);
  }
  EXPECT_NEAR(stress[1], stress[0], 1e-3 * stress[0]);
  EXPECT_NEAR(stress[0], 0.2e6 / std::sqrt(3.0), 1);
}

// What a remap mixes into a surface cell is gone when the forces are taken; asked twice, nothing more.
TEST(Traction, FreeSurfaceCarriesNoShear) {
  Interface<2> a(nullptr);
  Block<2>& b = a.block;
  const int r = a.row();
  a.copper().store.row(field::stress + 2, r)[middle] = 40e6;
  update_traction(b, *a.scene.pool);
  EXPECT_NEAR(b.stress[2].row(r)[middle], 0, 1);
  const double once = a.copper().store.row(field::stress + 2, r)[middle];
  update_traction(b, *a.scene.pool);
  EXPECT_EQ(a.copper().store.row(field::stress + 2, r)[middle], once);
}

// A cell of copper with a trace of lead moves as one of copper: K + 4/3 G along the normal, K - 2/3 G across.
TEST(Traction, TraceOfAnotherMetalChangesNoModulus) {
  Interface<2> a("lead");
  Block<2>& b = a.block;
  const int r = a.row();
  a.copper().store.row(field::fraction, r)[middle] = 1 - 1e-9;
  b.materials[1].store.row(field::fraction, r)[middle] = 1e-9;
  update_traction(b, *a.scene.pool);
  const double pure = b.modulus.row(r)[middle - 2];
  EXPECT_NEAR(b.modulus.row(r)[middle], pure, 1e-6 * pure);
  EXPECT_NEAR(b.shear.row(r)[middle], b.shear.row(r)[middle - 2], 1e-6 * pure);
}

} // namespace
} // namespace ballast
