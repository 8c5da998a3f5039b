// Laws of Bergstroem-Boyce networks, against independent integrations (tests/data/bb_*).
#include "visco_points.hpp"

#include "tests/exact/reference_table.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace ballast {
namespace {

struct History {
  const char* file;
  BergstroemBoyce law;
};

std::vector<History> histories() {
  return {{"bb_tissueNH_shear_rate1000", tissue_boyce()},
          {"bb_tissueNH_uniaxial_rate0.01", tissue_boyce()},
          {"bb_tissueNH_uniaxial_rate100000", tissue_boyce()},
          {"bb_elastomer8_shear_rate1", elastomer_boyce()},
          {"bb_elastomer8_uniaxial_rate1", elastomer_boyce()}};
}

/// Largest error of the stress over the largest stress, taking every `stride`-th row of the table as a step.
double history_error(const History& h, const TissueOptions& options, std::size_t stride, double* energy_error = nullptr) {
  const exact::ReferenceTable table(std::string(BALLAST_TEST_DATA) + "/" + h.file + ".csv");
  const bool shear = std::string(h.file).find("shear") != std::string::npos;
  TissueIntegrator integrator(options);
  Points p(h.law, 1);
  Mat before = unit_mat;
  double t = 0, worst = 0, largest = 0, stored = 0, residual = 0, work = 0;
  for (std::size_t r = stride; r < table.row_count(); r += stride) {
    const Mat now = shear ? sheared(table.number(r, "k")) : stretched(table.number(r, "lambda"));
    const double to = table.number(r, "t");
    p.move(0, midpoint_gradient(before, now), to - t);
    EXPECT_FALSE(integrator.advance(h.law, p.row)) << h.file << " " << t;
    EXPECT_GE(p.dissipated[0], 0) << h.file << " " << t;
    before = now;
    t = to;
    residual += p.work[0] - (p.stored[0] - stored) - p.dissipated[0];
    work += std::abs(p.work[0]);
    stored = p.stored[0];
    const Sym s = p.stress_of(0);
    const double got = shear ? s[3] : 1.5 * s[0], expected = table.number(r, shear ? "s12" : "sigma_uniaxial");
    worst = std::max(worst, std::abs(got - expected));
    largest = std::max(largest, std::abs(expected));
    if (shear) {
      worst = std::max({worst, std::abs(s[0] - table.number(r, "dev11")), std::abs(s[2] - table.number(r, "dev33"))});
    }
  }
  if (energy_error) {
    *energy_error = std::abs(residual) / work;
  }
  return worst / largest;
}

TEST(BergstroemBoyce, HistoriesByCvodeAreTheIndependentOnes) {
  for (const History& h : histories()) {
    for (const std::size_t stride : {1UL, 4UL}) {
      EXPECT_LT(history_error(h, by_path(BranchPath::cvode), stride), 1e-4) << h.file; // local error 1e-6 a step, up to 244 steps
    }
  }
}

struct Heat {
  double heat = 0, work = 0; ///< J/m3 over a history; work without its sign
};
Heat heat_of(const History& h, double tolerance, std::size_t stride) {
  const exact::ReferenceTable table(std::string(BALLAST_TEST_DATA) + "/" + h.file + ".csv");
  const bool shear = std::string(h.file).find("shear") != std::string::npos;
  TissueOptions options = by_path(BranchPath::cvode);
  options.cvode.tolerance = tolerance;
  TissueIntegrator integrator(options);
  Points p(h.law, 1);
  Mat before = unit_mat;
  double t = 0;
  Heat sum;
  for (std::size_t r = stride; r < table.row_count(); r += stride) {
    const Mat now = shear ? sheared(table.number(r, "k")) : stretched(table.number(r, "lambda"));
    p.move(0, midpoint_gradient(before, now), table.number(r, "t") - t);
    EXPECT_FALSE(integrator.advance(h.law, p.row));
    before = now;
    t = table.number(r, "t");
    sum.heat += p.dissipated[0];
    sum.work += std::abs(p.work[0]);
  }
  return sum;
}

TEST(BergstroemBoyce, HeatByCvodeFollowsItsToleranceThoughItHasNoSayInTheError) {
  for (const History& h : histories()) {
    for (const std::size_t stride : {1UL, 4UL, 12UL}) {
      const Heat exact = heat_of(h, 1e-10, stride);
      // Measured, of the work: at most 1.8e-3, 8e-4, 1.7e-4, 3.7e-5.
      for (const auto& [tolerance, most] : {std::pair{1e-3, 4e-3}, {1e-4, 1.6e-3}, {1e-5, 4e-4}, {1e-6, 8e-5}}) {
        EXPECT_NEAR(heat_of(h, tolerance, stride).heat, exact.heat, most * exact.work) << h.file << " " << stride << " " << tolerance;
      }
    }
  }
}

TEST(BergstroemBoyce, HistoriesByTheFastPathConvergeAtSecondOrder) {
  for (const History& h : histories()) {
    const double two = history_error(h, by_path(BranchPath::fixed, 2), 1), four = history_error(h, by_path(BranchPath::fixed, 4), 1);
    EXPECT_LT(four, 2e-4) << h.file;
    EXPECT_NEAR(two / four, 4, 0.3) << h.file;
  }
}

TEST(BergstroemBoyce, MixedPathKeepsItsTolerance) {
  for (const History& h : histories()) {
    for (const std::size_t stride : {1UL, 4UL, 12UL}) {
      EXPECT_LT(history_error(h, by_path(BranchPath::mixed, 8, 1e-3), stride), 1e-3) << h.file << " " << stride;
    }
  }
}

TEST(BergstroemBoyce, BothPathsAgreeOverStepsOfAThousandRelaxationTimes) {
  for (const BergstroemBoyce& law : {tissue_boyce(), elastomer_boyce()}) {
    for (const double strain : {0.0, 1e-3, 0.05}) {
      Points cvode(law, 1), fast(law, 1), mixed(law, 1);
      TissueIntegrator by_cvode(by_path(BranchPath::cvode)), by_fast(by_path(BranchPath::fixed, 8)), by_mix(by_path(BranchPath::mixed, 8, 1e-3));
      for (Points* p : {&cvode, &fast, &mixed}) { // a jump to a state that relaxes at once
        p->move(0, midpoint_gradient(unit_mat, product(sheared(0.4), stretched(1.2))), 1e-30);
        ASSERT_FALSE(by_cvode.advance(law, p->row));
      }
      const Sym start = cvode.state_of(6, 0);
      // dln|s|/dt at the start is 2 gdot mean/|dev b_e|.
      const double q = norm(deviator(start)), s = spring_modulus(law.b, trace(start)).value * q;
      const double rate = 2 * std::pow(law.start, law.stretch_power) * std::pow(s / law.base, law.exponent) / q * trace(start) / 3;
      for (Points* p : {&cvode, &fast, &mixed}) {
        p->move(0, midpoint_gradient(unit_mat, stretched(1 + strain)), 1000 / rate);
      }
      ASSERT_FALSE(by_cvode.advance(law, cvode.row));
      ASSERT_FALSE(by_fast.advance(law, fast.row));
      ASSERT_FALSE(by_mix.advance(law, mixed.row));
      EXPECT_LT(difference(mixed.state_of(6, 0), cvode.state_of(6, 0)), 1e-3 * q) << strain;
      const Sym a = cvode.state_of(6, 0), b = fast.state_of(6, 0);
      // No overshoot, and what is left agrees: the fast path's error at this step is a few hundredths of where it began.
      EXPECT_LT(norm(deviator(b)), q);
      EXPECT_LT(difference(a, b), 0.02 * q) << strain;
      EXPECT_TRUE(positive_definite(b));
    }
  }
}

TEST(BergstroemBoyce, StressIsTheSlopeOfTheSpringsEnergy) {
  for (const ChainSpring& spring : {ChainSpring{2e4}, ChainSpring{6e5, std::sqrt(8.0)}, ChainSpring{6e5, 40}}) {
    for (const double tr : {3.001, 3.5, 8.0, 20.0}) {
      const double h = 1e-4 * tr, slope = (spring_energy(spring, tr + h) - spring_energy(spring, tr - h)) / (2 * h);
      const SpringModulus m = spring_modulus(spring, tr);
      EXPECT_NEAR(2 * slope / m.value, 1, 1e-5) << tr;
      const double bend = (spring_modulus(spring, tr + h).value - spring_modulus(spring, tr - h).value) / (2 * h);
      EXPECT_NEAR(m.slope / m.value, bend / m.value, 1e-5) << tr;
    }
  }
  for (const double x : {1e-3, 0.0499, 0.0501, 0.5, 0.9, 0.999}) {
    const double beta = inverse_langevin(x);
    EXPECT_NEAR((1 / std::tanh(beta) - 1 / beta) / x, 1, 1e-13 + 1e-16 / (x * x)) << x; // 1/beta cancels
  }
  EXPECT_TRUE(std::isnan(spring_modulus({6e5, std::sqrt(8.0)}, 24.1).value)); // locked
}

TEST(BergstroemBoyce, ChainsOfNetworkABeyondTheirLockAreAFailure) {
  const BergstroemBoyce law = elastomer_boyce();
  for (const BranchPath path : {BranchPath::mixed, BranchPath::cvode}) {
    TissueIntegrator by(by_path(path));
    Points p(law, 3);
    double stretch = 1;
    std::optional<TissueFailure> failure;
    for (int k = 0; k < 60 && !failure; ++k) {
      p.move(0, midpoint_gradient(unit_mat, stretched(1.001)), 1);
      p.move(1, midpoint_gradient(unit_mat, stretched(1.03)), 1);
      failure = by.advance(law, p.row);
      stretch *= 1.03;
      const bool locked = stretch * stretch + 2 / stretch > 3 * 8; // lam_L^2 = 8
      ASSERT_EQ(failure.has_value(), locked) << stretch;
      EXPECT_TRUE(std::isfinite(norm(p.stress_of(0)) + p.stored[0]));
    }
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->cell, 1);
    EXPECT_EQ(failure->branch, 1U); // network A
    EXPECT_EQ(failure->reason, 0);
    EXPECT_GT(trace(failure->state), 24);
    EXPECT_EQ(by.counts().no_number, 1);
  }
}

TEST(BergstroemBoyce, WorkIsStoredOrDissipated) {
  for (const History& h : histories()) {
    double coarse = 0, fine = 0, cvode = 0;
    history_error(h, by_path(BranchPath::fixed, 4), 1, &coarse);
    history_error(h, by_path(BranchPath::fixed, 8), 1, &fine);
    history_error(h, by_path(BranchPath::cvode), 1, &cvode);
    EXPECT_LT(coarse, 2e-6) << h.file; // quadrature of work and of dissipation, each second order
    EXPECT_NEAR(coarse / fine, 4, 0.6) << h.file;
    EXPECT_LT(cvode, 1e-10) << h.file;
  }
}

TEST(BergstroemBoyce, CvodeWorkIsThatOfTheStressAlongTheStep) {
  // CVODE integrates the dissipation; the stress's work along 400 small steps is independent of it.
  const BergstroemBoyce law = tissue_boyce();
  TissueIntegrator cvode(by_path(BranchPath::cvode));
  Points one(law, 1), many(law, 1);
  Mat path{0.2, 0.3, 0, 0, -0.1, 0, 0, 0, -0.1}; // the exponent of the whole step's path
  one.move(0, midpoint_gradient(unit_mat, exponential(path)), 0.2);
  ASSERT_FALSE(cvode.advance(law, one.row));
  for (double& x : path) {
    x /= 400;
  }
  double work = 0;
  for (int k = 0; k < 400; ++k) {
    const Sym before = many.stress_of(0);
    many.move(0, midpoint_gradient(unit_mat, exponential(path)), 0.2 / 400);
    ASSERT_FALSE(cvode.advance(law, many.row));
    work += 0.5 * contract(combine(1, before, 1, many.stress_of(0)), symmetric_part(path));
  }
  EXPECT_NEAR(one.work[0] / work, 1, 1e-4); // some 50 internal steps of 1e-6
}

/// Relative difference of the same stretches seen from a frame that turns by 4 in all; the step is 1/steps.
double frame_error(const BergstroemBoyce& law, const TissueOptions& options, int steps) {
  TissueIntegrator integrator(options);
  Points spun(law, 1), still(law, 1);
  const auto shape = [](double t) { return product(sheared(0.4 * std::sin(2 * t)), stretched(1 + 0.2 * std::sin(3 * t))); };
  for (int k = 0; k < steps; ++k) {
    const double a = static_cast<double>(k) / steps, b = static_cast<double>(k + 1) / steps;
    still.move(0, midpoint_gradient(shape(a), shape(b)), b - a);
    spun.move(0, midpoint_gradient(product(turned(4 * a), shape(a)), product(turned(4 * b), shape(b))), b - a);
    EXPECT_FALSE(integrator.advance(law, spun.row));
    EXPECT_FALSE(integrator.advance(law, still.row));
  }
  const Sym expected = push(turned(4), still.stress_of(0));
  return difference(spun.stress_of(0), expected) / norm(expected);
}

TEST(BergstroemBoyce, IsObjective) {
  // f carries any turn exactly; only the path inside a step, exp(s log f), sees a turn that comes with a strain: second order.
  const TissueOptions two = by_path(BranchPath::fixed, 2);
  const double coarse = frame_error(tissue_boyce(), two, 100), fine = frame_error(tissue_boyce(), two, 200);
  EXPECT_LT(coarse, 1e-3); // 0.04 rad a step
  EXPECT_NEAR(coarse / fine, 4, 0.5);
  BergstroemBoyce elastic = tissue_boyce();
  elastic.rate = 0;
  EXPECT_LT(frame_error(elastic, by_path(BranchPath::fixed, 1), 100), 1e-10);
}

TEST(BergstroemBoyce, SpinTurnsAStrainedStateExactly) {
  const BergstroemBoyce law = tissue_boyce();
  for (const BranchPath path : {BranchPath::fixed, BranchPath::cvode}) {
    TissueIntegrator integrator(by_path(path, 1));
    Points p(law, 1);
    p.move(0, {0.2, 0.3, 0, 0.1, -0.1, 0.2, 0, 0.1, -0.1}, 1e-30);
    ASSERT_FALSE(integrator.advance(law, p.row));
    const Sym start = p.stress_of(0);
    for (int k = 1; k <= 3000; ++k) {
      p.move(0, midpoint_gradient(unit_mat, turned(0.03)), 1e-30);
      ASSERT_FALSE(integrator.advance(law, p.row));
    }
    EXPECT_LT(difference(p.stress_of(0), push(turned(0.03 * 3000), start)), 1e-10 * norm(start));
  }
}

TEST(BergstroemBoyce, MeansOfTensorsStayPositiveDefinite) {
  BergstroemBoyce law = elastomer_boyce();
  law.a.lock_stretch = std::numeric_limits<double>::infinity(); // the motions go beyond
  TissueIntegrator integrator(by_path(BranchPath::mixed));
  Points p(law, 2);
  for (int k = 0; k < 400; ++k) {
    p.move(0, {0.3 * std::sin(k), 0.4, -0.2, 0, 0.1 * std::cos(k), 0.3 * std::sin(2 * k), -0.4, 0, 0.1}, 0.05);
    p.move(1, {-0.2, 0, 0.3 * std::cos(3 * k), -0.3, 0.2, 0, 0.1, -0.3, 0}, 0.05);
    ASSERT_FALSE(integrator.advance(law, p.row)) << k;
    const double share = 0.5 + 0.5 * std::sin(7 * k);
    for (auto& row : p.state) { // a remap: masses of the two in a third, back into the first
      row[0] = share * row[0] + (1 - share) * row[1];
    }
    for (const std::size_t at : {0UL, 6UL}) {
      EXPECT_TRUE(positive_definite(p.state_of(at, 0))) << k;
    }
    if (k % 10 == 9) { // else the motions run away
      for (std::size_t a = 0; a < 6; ++a) {
        p.state[a][0] = p.state[a][1] = unit_sym[a];
      }
    }
  }
}

} // namespace
} // namespace ballast
