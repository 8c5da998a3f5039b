// Laws of viscoelastic material in the step: a cell is a material point, and its energies balance.
#include "tests/ale/tissue_blocks.hpp"

#include "ale/rest.hpp"
#include "ale/strength_update.hpp"
#include "ale/tissue_update.hpp"
#include "ale/traction.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace ballast {
namespace {

/// Sides move so that v = rate * x along each axis, for a while, then stand.
template <int Dim> struct Stretching {
  Scene<Dim> scene;
  std::array<double, Dim> rate;
  std::array<double, Dim> end{}; ///< of the block, low end 0

  Stretching(const TissueLaw& law, const std::array<double, Dim>& rates, bool axisymmetric)
      : scene(tissue_scene<Dim>(tissue_of(law), lines(), axisymmetric)), rate(rates) {
    end.fill(1e-3);
    set_velocity(scene.blocks[0], [&](const std::array<double, Dim>& x, std::array<double, Dim>& u) {
      for (std::size_t d = 0; d < Dim; ++d) {
        u[d] = rate[d] * x[d];
      }
    });
    for (std::size_t d = 0; d < Dim; ++d) {
      scene.blocks[0].boundary.side[d][1].velocity = rate[d] * end[d];
    }
    prepare(scene);
  }
  static std::array<std::vector<double>, 3> lines() {
    return {even_lines(0, 1e-3, 1), even_lines(0, 1e-3, 1), Dim == 3 ? even_lines(0, 1e-3, 1) : std::vector<double>{}};
  }
  void stop() {
    for (std::size_t d = 0; d < Dim; ++d) {
      scene.blocks[0].boundary.side[d][1].velocity = 0;
    }
    set_velocity(scene.blocks[0], [](const std::array<double, Dim>&, std::array<double, Dim>& u) { u.fill(0); });
  }
  /// One step; the gradient (diagonal) at its middle, and the volume ratio.
  std::pair<Mat, double> step(Clock& clock) {
    std::array<double, Dim> speed{};
    for (std::size_t d = 0; d < Dim; ++d) {
      speed[d] = scene.blocks[0].boundary.side[d][1].velocity;
    }
    advance(scene, clock);
    Mat g{};
    double ratio = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      g[4 * d] = speed[d] / (end[d] + 0.5 * clock.dt * speed[d]);
      end[d] += clock.dt * speed[d];
      ratio *= end[d] / 1e-3;
    }
    if (Dim == 2 && scene.blocks[0].axisymmetric) { // r is the first axis
      g[8] = g[0];
      ratio *= end[0] / 1e-3;
    }
    return {g, ratio};
  }
};

template <int Dim> void expect_point(const std::array<double, Dim>& rates, bool axisymmetric) {
  for (const TissueLaw& law : few_laws()) {
    Stretching<Dim> block(law, rates, axisymmetric);
    TissuePoint point(law);
    Clock clock;
    clock.end_time = 1;
    const MaterialSlot& slot = block.scene.blocks[0].materials[0];
    const int r = block.scene.blocks[0].grid.cell_row(0, 0);
    double largest = 0;
    for (int n = 0; n < 80; ++n) {
      if (n == 40) {
        block.stop();
      }
      const auto [g, ratio] = block.step(clock);
      point.step(g, clock.dt, ratio);
      largest = std::max(largest, norm(point.stress));
      const Eigen::Matrix3d s = deviator_of<Dim>(slot, r, 0);
      const Sym cell{s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)};
      // Round-off of positions and volumes, and of the sums over corners: 1e-12 a step.
      EXPECT_LT(norm(combine(1, cell, -1, point.stress)), 1e-10 * largest) << "law " << law.index() << ", step " << n;
    }
    EXPECT_GT(largest, 1e4);
    EXPECT_FALSE(point.failed);
    const TissueEnergy& e = block.scene.ledger.tissue[0];
    const double volume = slot.store.row(field::mass, r)[0] / slot.material.density;
    EXPECT_NEAR(e.work, point.work * volume, 1e-9 * point.work * volume);
    EXPECT_NEAR(e.dissipated, point.dissipated * volume, 1e-9 * point.work * volume);
    const double stored = totals(block.scene.blocks[0]).free_energy[0];
    EXPECT_NEAR(stored, point.stored * volume, 1e-9 * point.work * volume);
    EXPECT_GT(e.dissipated, 0.05 * e.work); // what the test is about
    // No remap: all work is stored or heat. The fast path of Bergstroem-Boyce balances to 1e-5.
    EXPECT_NEAR(e.lost, 0, (law.index() == 3 ? 1e-4 : 1e-8) * e.work) << "law " << law.index();
  }
}

TEST(TissueStep, APlaneCellIsAMaterialPoint) { expect_point<2>({2e3, -1.5e3}, false); }
TEST(TissueStep, ARingOfTheAxisIsAMaterialPoint) { expect_point<2>({1.5e3, -2e3}, true); }
TEST(TissueStep, ACellInSpaceIsAMaterialPoint) { expect_point<3>({2e3, -1.5e3, 0.5e3}, false); }

/// Cells of a row sheared and turned, each by its own gradient, against material points.
template <int Dim> void expect_row(int cells) {
  constexpr int gradients = Dim == 2 ? 5 : 9;
  constexpr std::array<std::size_t, 9> place = Dim == 2 ? std::array<std::size_t, 9>{0, 1, 3, 4, 8, 0, 0, 0, 0} : std::array<std::size_t, 9>{0, 1, 2, 3, 4, 5, 6, 7, 8};
  for (const TissueLaw& law : few_laws()) {
    Scene<Dim> scene = tissue_scene<Dim>(tissue_of(law), {even_lines(0, 1, cells), even_lines(0, 1, 1), Dim == 3 ? even_lines(0, 1, 1) : std::vector<double>{}});
    prepare(scene);
    Block<Dim>& b = scene.blocks[0];
    const int r = b.grid.cell_row(0, 0);
    std::copy(b.volume.row(r), b.volume.row(r) + cells, b.next_volume.row(r));
    std::vector<TissuePoint> points;
    for (int i = 0; i < cells; ++i) {
      points.emplace_back(law);
    }
    TissueIntegrator integrator{TissueOptions{}};
    TissueScratch scratch;
    StepSums<Dim> sums;
    sums.tissue.resize(1);
    const double dt = 1e-6;
    std::vector<std::vector<double>> rows(gradients, std::vector<double>(static_cast<std::size_t>(cells)));
    for (int step = 0; step < 20; ++step) {
      TissueRun<Dim> run{0, 0, 0, 0, cells, {}};
      for (int i = 0; i < cells; ++i) {
        Mat g{};
        for (std::size_t q = 0; q < gradients; ++q) {
          const double v = 0.02 * std::sin(0.7 * i + 1.3 * static_cast<double>(q) + 0.2 * step);
          rows[q][static_cast<std::size_t>(i)] = i % 5 == 2 ? 0.0 : v; // every fifth rests
          g[place[q]] = rows[q][static_cast<std::size_t>(i)] / dt;
        }
        points[static_cast<std::size_t>(i)].step(g, dt, 1);
      }
      for (std::size_t q = 0; q < gradients; ++q) {
        run.gradient[q] = rows[q].data();
      }
      advance_tissue(b, run, dt, integrator, scratch, sums);
    }
    for (int i = 0; i < cells; ++i) {
      const Eigen::Matrix3d s = deviator_of<Dim>(b.materials[0], r, i);
      const Sym& want = points[static_cast<std::size_t>(i)].stress;
      const double scale = norm(want);
      EXPECT_NEAR(s(0, 0), want[0], 1e-11 * scale) << i;
      EXPECT_NEAR(s(1, 1), want[1], 1e-11 * scale) << i;
      EXPECT_NEAR(s(0, 1), want[3], 1e-11 * scale) << i;
      if (Dim == 3) {
        EXPECT_NEAR(s(1, 2), want[4], 1e-11 * scale) << i;
        EXPECT_NEAR(s(0, 2), want[5], 1e-11 * scale) << i;
      }
      EXPECT_EQ(scale == 0, i % 5 == 2);
    }
    EXPECT_FALSE(sums.trouble);
  }
}

TEST(TissueStep, ShearAndSpinReachTheLawInThePlane) { expect_row<2>(70); }
TEST(TissueStep, ShearAndSpinReachTheLawInSpace) { expect_row<3>(70); }

/// One cell of tissue, and what advancing it takes.
template <int Dim> struct OneCell {
  explicit OneCell(const TissueLaw& law) : scene(tissue_scene<Dim>(tissue_of(law), {even_lines(0, 1, 1), even_lines(0, 1, 1), Dim == 3 ? even_lines(0, 1, 1) : std::vector<double>{}})) {
    prepare(scene);
    block().next_volume.row(row())[0] = block().volume.row(row())[0];
    sums.tissue.resize(1);
  }
  Block<Dim>& block() { return scene.blocks[0]; }
  int row() { return block().grid.cell_row(0, 0); }
  void advance(const TissueRun<Dim>& run, double dt) { advance_tissue(block(), run, dt, integrator, scratch, sums); }

  Scene<Dim> scene;
  TissueIntegrator integrator{TissueOptions{}};
  TissueScratch scratch;
  StepSums<Dim> sums;
};

TEST(TissueStep, AnInterfaceFreesMemoryByAnElasticShear) {
  for (const TissueLaw& law : few_laws()) {
    OneCell<3> cell(law);
    MaterialSlot& slot = cell.block().materials[0];
    const int r = cell.row();
    double g[9] = {};
    const auto strain = [&](double scale) {
      TissueRun<3> run{0, 0, 0, 0, 1, {}};
      for (std::size_t q = 0; q < 9; ++q) {
        g[q] = scale * std::cos(1.7 * static_cast<double>(q));
        run.gradient[q] = &g[q];
      }
      cell.advance(run, 1e-12);
      return deviator_of<3>(slot, r, 0);
    };
    strain(1e-3);
    const Eigen::Matrix3d before = strain(0);
    const Eigen::Vector3d n = Eigen::Vector3d(1, 2, -0.5).normalized();
    const Eigen::Vector3d t = before * n - n.dot(before * n) * n, d = -0.75 * t;
    free_memory<3>(slot, {d[0], d[1], d[2]}, {n[0], n[1], n[2]}, r, 0);
    const Eigen::Matrix3d after = strain(0); // nothing but what is remembered
    // Second order in strains of 1e-3.
    EXPECT_LT((after - before - d * n.transpose() - n * d.transpose()).norm(), 1e-2 * before.norm()) << "law " << law.index();
    EXPECT_GT(t.norm(), 0.2 * before.norm());
  }
}

TEST(TissueStep, FreeingLongChainsDoesNotOvershoot) {
  const BergstroemBoyce law{.a = {300}, .b = {1500}, .rate = 1e-4, .base = 20, .exponent = 4};
  OneCell<2> cell(law);
  MaterialSlot& slot = cell.block().materials[0];
  const int r = cell.row();
  const auto shear = [&](double by) {
    const double zero = 0;
    cell.advance(TissueRun<2>{0, 0, 0, 0, 1, {&zero, &by, &zero, &zero, &zero}}, 1e-9);
    return deviator_of<2>(slot, r, 0);
  };
  for (int n = 0; n < 50; ++n) {
    shear(0.1); // to a shear of 5
  }
  const double start = std::abs(shear(0)(0, 1));
  double before = start;
  for (int n = 0; n < 20; ++n) {
    const double t = deviator_of<2>(slot, r, 0)(0, 1);
    free_memory<2>(slot, {-t, 0, 0}, {0, 1, 0}, r, 0);
    const double now = std::abs(shear(0)(0, 1));
    EXPECT_LE(now, std::max(before, 1e-3 * start)) << n; // two networks do not come to it together
    before = now;
  }
  EXPECT_LT(before, 1e-3 * start);
  EXPECT_FALSE(cell.sums.trouble);
}

TEST(TissueStep, ACellThatHoldsFreeEnergyStaysAwakeWithoutStress) {
  for (const bool holds : {false, true}) {
    Scene<2> scene = tissue_scene<2>(tissue_of(few_laws()[0]), {even_lines(0, 1, 200), even_lines(0, 1, 1), {}});
    prepare(scene);
    Block<2>& b = scene.blocks[0];
    b.materials[0].store.row(field::free_energy<2>, b.grid.cell_row(0, 0))[100] = holds ? 1e-9 : 0;
    for (int step = 0; step < 4; ++step) {
      follow_rest(scene, b, false);
    }
    EXPECT_EQ(b.awake.share() > 0, holds);
  }
}

TEST(TissueStep, WhatIsNotPositiveDefiniteIsDrawnToRestAndBooked) {
  const TissueLaw law = few_laws()[3];
  OneCell<2> cell(law);
  TileStore& store = cell.block().materials[0].store;
  store.row(field::memory<2> + 3, cell.row())[0] = 1.5; // a shear of b above its diagonal
  const double zero = 0;
  cell.advance(TissueRun<2>{0, 0, 0, 0, 1, {&zero, &zero, &zero, &zero, &zero}}, 1e-7);
  EXPECT_EQ(cell.sums.tissue_repairs, 1);
  EXPECT_FALSE(cell.sums.trouble);
  EXPECT_TRUE(std::isfinite(store.row(field::stress + 2, cell.row())[0]));
}

TEST(TissueStep, HeatThatFungsLawRaisesToZeroIsBooked) {
  FungQlv law{.shear = 3e5, .stiffening = 12, .branches = 1};
  law.branch[0] = {0.5, 1e-11};
  OneCell<2> cell(law);
  const double zero = 0, strain = 0.03, back = -strain;
  for (int n = 0; n < 10; ++n) { // 1e4 relaxation times a step
    cell.advance(TissueRun<2>{0, 0, 0, 0, 1, {&strain, &zero, &zero, &back, &zero}}, 1e-7);
  }
  const TissueEnergy& e = cell.sums.tissue[0];
  EXPECT_GT(e.floored, 1e-6 * e.work);
  EXPECT_LT(e.floored, 0.05 * e.work);
  EXPECT_EQ(e.dissipated, 0);
  EXPECT_NEAR(e.lost, 0, 1e-10 * e.work); // all in balance
}

TEST(TissueStep, ASliverForgetsAndBooksWhatItStored) {
  const TissueLaw law = few_laws()[0];
  Scene<2> scene = tissue_scene<2>(tissue_of(law), {even_lines(0, 1, 1), even_lines(0, 1, 1), {}});
  Block<2>& b = scene.blocks[0];
  const int r = b.grid.cell_row(0, 0);
  MaterialSlot& slot = b.materials[0];
  slot.store.row(field::free_energy<2>, r)[0] = 3;
  slot.store.row(field::memory<2>, r)[0] = slot.store.row(field::stress, r)[0] = 7;
  StepSums<2> sums;
  sums.tissue.resize(1);
  forget(b, 0, r, 0, sums);
  EXPECT_EQ(slot.store.row(field::memory<2>, r)[0], 0);
  EXPECT_EQ(slot.store.row(field::stress, r)[0], 0);
  EXPECT_EQ(sums.tissue[0].lost, 3 * slot.store.row(field::mass, r)[0]);
}

} // namespace
} // namespace ballast
