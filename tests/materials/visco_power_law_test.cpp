// Laws of the power-law (nonlinear Zener) deviator.
#include "visco_points.hpp"

namespace ballast {
namespace {

void strain(TissueIntegrator& by, const PowerLawZener& law, Points& p, double e, double dt) {
  p.move(0, {e, 0, 0, 0, -0.5 * e, 0, 0, 0, -0.5 * e}, dt);
  ASSERT_FALSE(by.advance(law, p.row));
}

/// Axial deviator of one branch under a constant axial strain rate, by Runge-Kutta 4 with `steps` steps.
double axial(const PowerLawBranch& m, double s, double rate, double time, int steps) {
  const double h = time / steps;
  const auto f = [&](double x) {
    return 2 * m.shear * rate - x / m.time * std::pow(std::sqrt(1.5) * std::abs(x) / m.reference, m.exponent - 1);
  };
  for (int k = 0; k < steps; ++k) {
    const double a = f(s), b = f(s + 0.5 * h * a), c = f(s + 0.5 * h * b), d = f(s + h * c);
    s += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return s;
}

TEST(PowerLaw, RelaxationIsTheClosedForm) {
  // |s| = |s0| (1 + (m-1) k)^(-1/(m-1)), k = dt/tau0 (|s0|/s_ref)^(m-1); k from 0.1 to 1000 in one step.
  PowerLawZener law = gelatin_power_law();
  law.long_shear = 0;
  TissueIntegrator cvode(by_path(BranchPath::cvode)), fast(by_path(BranchPath::adaptive, 8, 1e-3)), mixed(by_path(BranchPath::mixed, 8, 1e-3));
  for (const double k : {0.1, 1.0, 10.0, 1000.0}) {
    Points c(law, 1), f(law, 1), x(law, 1);
    for (Points* p : {&c, &f, &x}) {
      strain(cvode, law, *p, 0.2, 1e-30);
    }
    const double start = c.stress[0][0], size = norm(c.stress_of(0)), dt = k * 1e-4 * std::pow(1e5 / size, 3);
    const double exact = start * std::pow(1 + 3 * k, -1.0 / 3);
    strain(cvode, law, c, 0, dt);
    strain(fast, law, f, 0, dt);
    strain(mixed, law, x, 0, dt);
    EXPECT_NEAR(c.stress[0][0], exact, 1e-4 * exact) << k;
    EXPECT_NEAR(x.stress[0][0], exact, 1e-3 * start) << k;
    EXPECT_NEAR(f.stress[0][0], exact, 0.02 * start) << k; // 8 steps, unresolved at k = 1000
    EXPECT_GE(f.stress[0][0], 0);                          // and no overshoot
  }
  EXPECT_GT(fast.counts().over, 0); // the estimate says so
  EXPECT_EQ(mixed.counts().stiff, fast.counts().over);
}

TEST(PowerLaw, SteadyFlowIsExactHoweverLargeTheStep) {
  PowerLawZener law = gelatin_power_law();
  law.long_shear = 0;
  const PowerLawBranch& m = law.branch[0];
  const double rate = 1e3, steady = std::pow(2 * m.shear * rate * m.time * std::pow(std::sqrt(1.5) / m.reference, 1 - m.exponent), 1 / m.exponent);
  for (const BranchPath path : {BranchPath::fixed, BranchPath::cvode}) {
    Points p(law, 1);
    TissueIntegrator by(by_path(path, 1));
    strain(by, law, p, 0.4, 0.4 / rate);
    for (int k = 0; k < 60; ++k) {
      strain(by, law, p, 0.2, 0.2 / rate);
      EXPECT_LT(p.stress[0][0], 1.2 * steady);
    }
    EXPECT_NEAR(p.stress[0][0] / steady, 1, path == BranchPath::fixed ? 1e-8 : 1e-5);
  }
}

TEST(PowerLaw, LoadingConvergesToAnIndependentIntegration) {
  PowerLawZener law = gelatin_power_law();
  law.long_shear = 0;
  const double rate = 1e3, time = 2e-4, exact = axial(law.branch[0], 0, rate, time, 20000);
  double error[2] = {0, 0};
  for (int level = 0; level < 2; ++level) {
    const int steps = 40 << level;
    Points fast(law, 1), cvode(law, 1);
    TissueIntegrator by_fast(by_path(BranchPath::fixed, 1)), by_cvode(by_path(BranchPath::cvode));
    for (int k = 0; k < steps; ++k) {
      strain(by_fast, law, fast, rate * time / steps, time / steps);
      strain(by_cvode, law, cvode, rate * time / steps, time / steps);
    }
    error[level] = std::abs(fast.stress[0][0] - exact);
    EXPECT_NEAR(cvode.stress[0][0] / exact, 1, 1e-4);
  }
  EXPECT_LT(error[1], 1e-3 * exact);
  EXPECT_NEAR(error[0] / error[1], 4, 0.5);
}

TEST(PowerLaw, ExponentOneIsProny) {
  const PowerLawZener law{1e4, 2, {{{1e6, 2e-6, 1e5, 1}, {1e5, 1e-3, 1e5, 1}}}};
  const Prony prony{1e4, 2, {{{1e6, 2e-6}, {1e5, 1e-3}}}};
  Points a(law, 1), b(prony, 1);
  TissueIntegrator by(by_path(BranchPath::fixed, 1));
  for (int k = 0; k < 100; ++k) {
    for (Points* p : {&a, &b}) {
      p->move(0, {1e-3 * std::sin(k), 2e-3, 0, 1e-3 * std::cos(3 * k), -1e-3, 5e-4, 3e-4, 0, 1e-4}, 3e-6);
    }
    ASSERT_FALSE(by.advance(law, a.row));
    advance(prony, b.row);
    EXPECT_LT(difference(a.stress_of(0), b.stress_of(0)), 1e-9 * norm(b.stress_of(0)));
    EXPECT_NEAR(a.dissipated[0], b.dissipated[0], 1e-8 * b.stored[0]);
  }
}

TEST(PowerLaw, WorkIsStoredOrDissipated) {
  const PowerLawZener law{5e3, 2, {{{1e6, 1e-4, 1e5, 4}, {2e5, 1e-6, 2e4, 2.5}}}};
  for (const BranchPath path : {BranchPath::fixed, BranchPath::mixed, BranchPath::cvode}) {
    TissueIntegrator by(by_path(path, path == BranchPath::fixed ? 1 : 8));
    for (const double dt : {1e-9, 1e-6, 1e-3}) {
      Points p(law, 1);
      double before = 0, work = 0;
      for (int k = 0; k < 100; ++k) {
        p.move(0, {2e-2 * std::sin(k), 2e-2, 0, 1e-2 * std::cos(3 * k), -1e-3, 5e-4, 3e-3, 0, 1e-2}, dt);
        ASSERT_FALSE(by.advance(law, p.row));
        EXPECT_GE(p.dissipated[0], 0);
        work += std::abs(p.work[0]);
        EXPECT_NEAR(p.work[0], p.stored[0] - before + p.dissipated[0], 1e-10 * work) << dt;
        before = p.stored[0];
      }
    }
  }
}

TEST(PowerLaw, SpinTurnsAStrainedStateExactly) {
  const PowerLawZener law = gelatin_power_law();
  for (const BranchPath path : {BranchPath::fixed, BranchPath::cvode}) {
    TissueIntegrator by(by_path(path, 1));
    Points spun(law, 1), still(law, 1);
    for (Points* p : {&spun, &still}) {
      p->move(0, {5e-2, 2e-2, 0, 2e-2, -3e-2, 1e-2, 0, 1e-2, -2e-2}, 1e-7);
      ASSERT_FALSE(by.advance(law, p->row));
    }
    const int steps = 3000;
    const double dt = path == BranchPath::fixed ? 1e-7 : 1e-30; // CVODE sees other numbers, turned: it agrees to its tolerance
    for (int k = 1; k <= steps; ++k) {
      spun.move(0, midpoint_gradient(unit_mat, turned(0.03)), dt);
      still.move(0, Mat{}, dt);
      ASSERT_FALSE(by.advance(law, spun.row));
      ASSERT_FALSE(by.advance(law, still.row));
    }
    const Sym expected = push(turned(0.03 * steps), still.stress_of(0));
    EXPECT_LT(difference(spun.stress_of(0), expected), 1e-10 * norm(expected));
  }
}

} // namespace
} // namespace ballast
