// Laws of the batches that CVODE integrates, and of the choice between the paths.
#include "visco_points.hpp"

#include "core/error.hpp"

#include <limits>
#include <numeric>
#include <thread>

namespace ballast {
namespace {

/// Cells from rest to far beyond the flow stress, some turning.
void set_motion(Points& p, int cells, double size, double dt) {
  for (int i = 0; i < cells; ++i) {
    const double a = size * std::sin(1.7 * i), b = size * std::cos(0.6 * i * i);
    p.move(static_cast<std::size_t>(i), {a, 2 * b, 0, -b, -0.5 * a, a, b, 0, -0.5 * a}, dt);
  }
}

std::vector<double> all_values(const Points& p) {
  std::vector<double> all;
  for (const auto& row : p.state) {
    all.insert(all.end(), row.begin(), row.end());
  }
  all.insert(all.end(), p.dissipated.begin(), p.dissipated.end());
  return all;
}

template <class Law> std::vector<double> run(const Law& law, TissueIntegrator& by, int cells, int steps) {
  Points p(law, static_cast<std::size_t>(cells));
  for (int k = 0; k < steps; ++k) {
    set_motion(p, cells, 0.03 * (k % 3 + 1), 2e-5);
    EXPECT_FALSE(by.advance(law, p.row));
  }
  return all_values(p);
}

template <class Law, class Drive> void check_jacobian(const Law& law, const Drive& drive, const Sym& v) {
  BranchJacobian j;
  jacobian(law, drive, 0.4, v, j);
  for (std::size_t b = 0; b < 6; ++b) {
    const double h = 1e-5 * norm(v);
    Sym up = v, down = v, rate_up, rate_down;
    up[b] += h;
    down[b] -= h;
    double heat_up = 0, heat_down = 0, size = std::abs(j.diagonal);
    rate(law, drive, 0.4, up, rate_up, heat_up);
    rate(law, drive, 0.4, down, rate_down, heat_down);
    for (std::size_t k = 0; k < 2; ++k) {
      size += norm(j.left[k]) * norm(j.right[k]);
    }
    for (std::size_t a = 0; a < 6; ++a) {
      const double exact = (a == b ? j.diagonal : 0) + j.left[0][a] * j.right[0][b] + j.left[1][a] * j.right[1][b];
      EXPECT_NEAR((rate_up[a] - rate_down[a]) / (2 * h), exact, 1e-6 * size) << a << b;
    }
    EXPECT_NEAR((heat_up - heat_down) / (2 * h), j.heat[b], 1e-6 * norm(j.heat)) << b;
  }
}

TEST(ViscoJacobian, IsTheDerivativeOfTheRates) {
  check_jacobian(PowerLawBranch{1e6, 1e-4, 1e5, 4}, PowerLawDrive{{1e5, -2e5, 1e5, 3e4, 0, -5e4}, 1e-5}, Sym{2e5, -1e5, -1e5, 5e4, 3e4, -9e4});
  for (const BergstroemBoyce& law : {tissue_boyce(), elastomer_boyce()}) {
    BoyceDrive drive{without_trace({0.1, 0.2, 0, -0.1, 0.05, 0.1, 0, 0.1, 0}), unimodular(Sym{1.5, 1.1, 0.9, 0.3, 0.1, 0}), 1e-2};
    prepare(drive);
    check_jacobian(law, drive, Sym{0.9, 1.2, 1.0, 0.1, -0.05, 0.2});
  }
}

TEST(ViscoBatch, ResultsDependOnTheRowAlone) {
  // Any history of the object, any thread, any order of rows: the same bits.
  for (const BranchPath path : {BranchPath::cvode, BranchPath::mixed}) {
    TissueOptions options = by_path(path, 2, 1e-4);
    options.cvode.batch = 16;
    TissueIntegrator one(options), used(options);
    const auto power = gelatin_power_law();
    const std::vector<double> a = run(power, one, 100, 3), boyce = run(tissue_boyce(), one, 37, 3);
    (void)run(elastomer_boyce(), used, 5, 2);
    EXPECT_EQ(run(tissue_boyce(), used, 37, 3), boyce);
    EXPECT_EQ(run(power, used, 100, 3), a);
    std::array<std::vector<double>, 4> got;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < got.size(); ++t) {
      threads.emplace_back([&, t] {
        TissueIntegrator own(options);
        if (t % 2 == 1) {
          (void)run(tissue_boyce(), own, 20, 1);
        }
        got[t] = run(power, own, 100, 3);
      });
    }
    for (auto& thread : threads) {
      thread.join();
    }
    for (const auto& values : got) {
      EXPECT_EQ(values, a);
    }
  }
}

TEST(ViscoBatch, OneHotCellIsNotDilutedByItsBatch) {
  // One cell of 64 far above the flow stress: the same error as alone (a mean over the batch would allow 8 times).
  const PowerLawBranch law{1e6, 1e-4, 1e5, 4};
  const auto solve = [&](int cells, double tolerance) {
    BatchSolver solver({tolerance, 64});
    std::vector<PowerLawDrive> drives(static_cast<std::size_t>(cells), {Sym{}, 1e-4});
    std::vector<BranchState> states(drives.size(), {scaled(1e3, {1, -1, 0, 0, 0, 0}), 0});
    states[0].y = scaled(6e5, {1, -1, 0, 0.5, 0, 0});
    EXPECT_FALSE(solver.solve(law, std::span<const PowerLawDrive>(drives), std::span(states)));
    return states[0].y[0];
  };
  for (const double tolerance : {1e-3, 1e-5}) {
    const double exact = solve(1, 1e-10), alone = std::abs(solve(1, tolerance) / exact - 1), among = std::abs(solve(64, tolerance) / exact - 1);
    EXPECT_LT(among, 1.5 * alone + 1e-9) << tolerance;
    EXPECT_LT(among, 20 * tolerance);
  }
}

TEST(ViscoBatch, PaddedAndCutBatchesAgreeWithSingleCells) {
  for (const int batch : {1, 3, 16, 64}) {
    TissueOptions options = by_path(BranchPath::cvode);
    options.cvode.batch = batch;
    TissueIntegrator by(options), singly(by_path(BranchPath::cvode));
    Points p(tissue_boyce(), 37), q(tissue_boyce(), 37);
    for (Points* x : {&p, &q}) {
      set_motion(*x, 37, 0.1, 1.0);
    }
    ASSERT_FALSE(by.advance(tissue_boyce(), p.row));
    ASSERT_FALSE(singly.advance(tissue_boyce(), q.row));
    for (std::size_t i = 0; i < 37; ++i) {
      EXPECT_LT(difference(p.stress_of(i), q.stress_of(i)), 1e-4 * 20000) << batch << " " << i;
    }
    EXPECT_EQ(by.counts().cvode.cells, 37);
    EXPECT_EQ(by.counts().cvode.batches, (37 + batch - 1) / batch);
  }
}

TEST(ViscoBatch, FailureNamesCellAndStateAndSparesTheOthers) {
  // Cell 5 comes with chains stretched beyond their locking (the flow itself, ever faster before it, never gets there).
  const BergstroemBoyce law = elastomer_boyce();
  for (const BranchPath path : {BranchPath::cvode, BranchPath::mixed}) {
    TissueIntegrator by(by_path(path)), other(by_path(path));
    Points p(law, 20), healthy(law, 20);
    for (Points* x : {&p, &healthy}) {
      set_motion(*x, 20, 0.01, 1e-3);
    }
    for (auto& row : p.state) {
      row[5] = 0;
    }
    const Sym start{30, 0.2, 1 / 6.0, 0, 0, 0};
    for (std::size_t a = 0; a < 6; ++a) {
      p.state[a][5] = unit_sym[a];
      p.state[6 + a][5] = start[a];
    }
    p.move(5, midpoint_gradient(unit_mat, stretched(1.4)), 1e-3);
    const auto failure = by.advance(law, p.row);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->cell, 5);
    EXPECT_LT(failure->reason, 0);
    EXPECT_LT(failure->reached, 1);
    EXPECT_GT(failure->state[0], 15);
    EXPECT_EQ(by.counts().cvode.failures, 1);
    ASSERT_FALSE(other.advance(law, healthy.row));
    for (const std::size_t i : {0UL, 4UL, 6UL, 19UL}) {
      EXPECT_LT(difference(p.stress_of(i), healthy.stress_of(i)), 1e-3 * norm(healthy.stress_of(i))) << i;
    }
  }
  TissueIntegrator fast(by_path(BranchPath::fixed, 1));
  Points p(law, 2);
  p.state[6][1] = 30;
  p.state[7][1] = 1.0 / 30;
  set_motion(p, 2, 0.01, 1e-3);
  const auto failure = fast.advance(law, p.row);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->cell, 1);
  EXPECT_EQ(failure->reason, 0);
  EXPECT_EQ(fast.counts().no_number, 1);
}

TEST(ViscoBatch, NoNumberInAnyCellIsNoNorm) {
  const std::vector<double> ones(3 * 7, 1.0);
  for (std::size_t at = 0; at < ones.size(); ++at) {
    std::vector<double> v = ones;
    v[at] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(std::isnan(worst_cell_norm(v, ones)), at % 7 != 6) << at; // the dissipation has no say
    EXPECT_EQ(std::isnan(worst_cell_norm(ones, v)), at % 7 != 6) << at;
  }
  std::vector<double> hot = ones;
  std::fill(hot.begin() + 7, hot.begin() + 14, 3.0);
  EXPECT_DOUBLE_EQ(worst_cell_norm(hot, ones), 3);
}

TEST(ViscoBatch, MotionThatIsNoNumberFailsItsCellAlone) {
  const PowerLawZener law = gelatin_power_law();
  TissueIntegrator by(by_path(BranchPath::cvode)), other(by_path(BranchPath::cvode));
  Points p(law, 20), healthy(law, 20);
  for (Points* x : {&p, &healthy}) {
    set_motion(*x, 20, 0.03, 2e-5);
  }
  p.gradient[1][5] = std::numeric_limits<double>::quiet_NaN();
  const auto failure = by.advance(law, p.row);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->cell, 5);
  EXPECT_EQ(by.counts().cvode.failures, 1);
  ASSERT_FALSE(other.advance(law, healthy.row));
  for (const std::size_t i : {0UL, 4UL, 6UL, 19UL}) {
    EXPECT_LT(difference(p.stress_of(i), healthy.stress_of(i)), 1e-3 * norm(healthy.stress_of(i))) << i;
  }
}

TEST(ViscoBatch, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW(BatchSolver({0, 64}), Error);
  EXPECT_THROW(BatchSolver({1e-4, 0}), Error);
  EXPECT_THROW(TissueIntegrator(by_path(BranchPath::fixed, 3)), Error);
}

TEST(ViscoMixed, OnlyCellsBeyondTheToleranceGoToCvode) {
  const PowerLawZener law = gelatin_power_law();
  TissueIntegrator mixed(by_path(BranchPath::mixed, 8, 1e-3)), cvode(by_path(BranchPath::cvode)), adaptive(by_path(BranchPath::adaptive, 8, 1e-3));
  Points m(law, 64), c(law, 64), a(law, 64);
  for (Points* p : {&m, &c, &a}) {
    set_motion(*p, 64, 0.3, 1e-5); // |s| up to 6 s0
  }
  ASSERT_FALSE(mixed.advance(law, m.row));
  ASSERT_FALSE(cvode.advance(law, c.row));
  ASSERT_FALSE(adaptive.advance(law, a.row));
  const TissueCounts counts = mixed.counts();
  EXPECT_GT(counts.stiff, 0);
  EXPECT_LT(counts.stiff, 64);
  EXPECT_EQ(counts.stiff + std::accumulate(counts.fast.begin(), counts.fast.end(), 0L), 64);
  EXPECT_EQ(adaptive.counts().over, counts.stiff);
  EXPECT_LE(counts.worst_estimate, 1e-3);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_LT(difference(m.stress_of(i), c.stress_of(i)), 1e-3 * std::max(norm(c.stress_of(i)), 1e3)) << i;
  }
}

} // namespace
} // namespace ballast
