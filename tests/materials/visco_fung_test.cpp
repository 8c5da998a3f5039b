// Laws of the quasi-linear viscoelastic deviator.
#include "visco_points.hpp"

#include "materials/visco_fung.hpp"

namespace ballast {
namespace {

FungQlv tissue() { return {2e5, 12, 2, {{{0.5, 1e-4}, {0.4, 1e-2}}}}; }

void strain(const FungQlv& law, Points& p, double e, double dt) {
  p.move(0, {e, 0, 0, 0, -0.5 * e, 0, 0, 0, -0.5 * e}, dt);
  advance(law, p.row);
}
double elastic(const FungQlv& law, double e) { return 2 * law.shear * std::exp(1.5 * law.stiffening * e * e) * e; }

TEST(Fung, RelaxationAfterAJumpSeparatesStrainFromTime) {
  const FungQlv law = tissue();
  for (const double jump : {0.01, -0.3}) {
    Points p(law, 1);
    strain(law, p, jump, 1e-22);
    double t = 0;
    for (const double to : {1e-6, 1e-4, 3e-4, 1e-2, 1.0}) {
      strain(law, p, 0, to - t);
      t = to;
      const double reduced = 1 - 0.5 * (1 - std::exp(-t / 1e-4)) - 0.4 * (1 - std::exp(-t / 1e-2));
      EXPECT_NEAR(p.stress[0][0] / (elastic(law, jump) * reduced), 1, 1e-12) << t;
    }
  }
}

TEST(Fung, IsTheConvolutionOfTheElasticStress) {
  // e = 0.3 sin(w t), against int g(t - t') s_e'(t') dt' by Simpson; the step's own error is (w dt)^2.
  const FungQlv law = tissue();
  const double w = 2e4, end = 2e-4;
  const auto se = [&](double t) { return elastic(law, 0.3 * std::sin(w * t)); };
  const auto reduced = [](double t) { return 1 - 0.5 * (1 - std::exp(-t / 1e-4)) - 0.4 * (1 - std::exp(-t / 1e-2)); };
  // By parts: s = g(0) s_e(t) + int g'(t - t') s_e(t') dt'.
  const auto kernel = [&](double t) { return -(0.5 / 1e-4 * std::exp(-t / 1e-4) + 0.4 / 1e-2 * std::exp(-t / 1e-2)); };
  double exact = reduced(0) * se(end);
  const int cuts = 20000;
  for (int k = 0; k <= cuts; ++k) {
    const double t = end * k / cuts;
    exact += (k == 0 || k == cuts ? 1 : k % 2 == 1 ? 4 : 2) * end / cuts / 3 * kernel(end - t) * se(t);
  }
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const int steps = 100 << level;
    Points p(law, 1);
    for (int k = 0; k < steps; ++k) {
      strain(law, p, 0.3 * (std::sin(w * end * (k + 1) / steps) - std::sin(w * end * k / steps)), end / steps);
    }
    error[level] = std::abs(p.stress[0][0] - exact);
  }
  EXPECT_LT(error[1], 1e-4 * elastic(law, 0.3));
  EXPECT_NEAR(error[0] / error[1], 4, 0.1);
}

TEST(Fung, LinearLimitIsProny) {
  const FungQlv law{2e5, 0, 2, {{{0.5, 1e-4}, {0.4, 1e-2}}}};
  const Prony prony{2e4, 2, {{{1e5, 1e-4}, {8e4, 1e-2}}}};
  Points a(law, 1), b(prony, 1);
  for (int k = 0; k < 50; ++k) {
    const Mat g{2e-3 * std::sin(k), 3e-3, 1e-3, -1e-3 * k, 1e-3, 4e-3, 0, 2e-3, -5e-4};
    for (Points* p : {&a, &b}) {
      p->move(0, g, 3e-5);
    }
    advance(law, a.row);
    advance(prony, b.row);
    EXPECT_LT(difference(a.stress_of(0), b.stress_of(0)), 1e-11 * norm(b.stress_of(0)));
    EXPECT_NEAR(a.stored[0], b.stored[0], 1e-10 * b.stored[0]);
    EXPECT_NEAR(a.dissipated[0], b.dissipated[0], 1e-10 * b.stored[0]);
  }
}

TEST(Fung, StrainOfAStressInvertsTheElasticLaw) {
  const FungQlv law = tissue();
  for (const double size : {1e-9, 1e-3, 0.1, 0.5, 1.5}) {
    const Sym e{size, -0.3 * size, -0.7 * size, 0.2 * size, 0, 0.5 * size};
    EXPECT_LT(difference(strain_of(law, elastic_stress(law, e)), e), 1e-13 * norm(e)) << size;
    const Sym up = scaled(1 + 1e-5, e), down = scaled(1 - 1e-5, e);
    const double slope = (elastic_energy(law, up) - elastic_energy(law, down)) / 2e-5;
    EXPECT_NEAR(slope / contract(elastic_stress(law, e), e), 1, 1e-6) << size; // s_e is the slope of W
  }
}

TEST(Fung, WorkIsStoredOrDissipated) {
  const FungQlv law = tissue();
  for (const double dt : {1e-8, 1e-5, 1e-3, 1e2}) {
    Points p(law, 1);
    double before = 0, work = 0;
    for (int k = 0; k < 300; ++k) {
      p.move(0, {5e-3 * std::sin(k), 6e-3 * std::cos(0.1 * k), 0, 1e-3, -2e-3, 5e-3 * std::sin(0.3 * k), 3e-3, 0, 1e-3}, dt);
      advance(law, p.row);
      work += std::abs(p.work[0]);
      EXPECT_GE(p.dissipated[0], 0);
      EXPECT_GE(p.stored[0], 0);
      // 1e4 relaxation times a step: the heat would be below zero by the curvature of s_e, a |de|^2 = 2e-3.
      EXPECT_NEAR(p.work[0], p.stored[0] - before + p.dissipated[0], 1e-10 * work) << dt << " " << k;
      before = p.stored[0];
    }
  }
}

TEST(Fung, HeatThatIsRaisedToZeroIsCounted) {
  const FungQlv law{2e5, 12, 1, {{{0.5, 1e-4}}}};
  std::vector<double> floored(1);
  const auto total = [&](double dt, int steps) { // to a strain of 0.3 and back; J/m3
    Points p(law, 1);
    p.row.floored = floored.data();
    double sum = 0, before = 0, raised = 0;
    for (int k = 0; k < 2 * steps; ++k) {
      const double e_n = p.state[0][0], e = k < steps ? 0.3 * (k + 1) / steps : 0.3 * (2 * steps - k - 1) / steps;
      strain(law, p, e - e_n, dt);
      EXPECT_GE(floored[0], 0);
      EXPECT_TRUE(floored[0] == 0 || p.dissipated[0] == 0) << k; // one branch: either
      EXPECT_NEAR(p.work[0], p.stored[0] - before + p.dissipated[0], 1e-10 * p.stored[0] + 1e-12);
      before = p.stored[0];
      sum += floored[0];
      raised += p.dissipated[0] == 0 ? 1 : 0;
    }
    EXPECT_EQ(sum > 0, raised > 0);
    return sum;
  };
  EXPECT_EQ(total(1e-8, 40), 0);
  const double coarse = total(1, 40), fine = total(1, 80), most = elastic_energy(law, {0.3, -0.15, -0.15, 0, 0, 0});
  EXPECT_GT(coarse, 1e-5 * most);
  EXPECT_LT(coarse, 1e-2 * most);
  EXPECT_NEAR(coarse / fine, 4, 0.4); // the curvature of s_e within the steps: second order
}

TEST(Fung, SpinTurnsAStrainedStateExactly) {
  const FungQlv law = tissue();
  Points spun(law, 1), still(law, 1);
  for (Points* p : {&spun, &still}) {
    p->move(0, {1e-2, 2e-2, 0, 2e-2, -3e-2, 1e-2, 0, 1e-2, 2e-2}, 1e-5);
    advance(law, p->row);
  }
  for (int k = 1; k <= 3000; ++k) {
    spun.move(0, midpoint_gradient(unit_mat, turned(0.05)), 1e-6);
    still.move(0, Mat{}, 1e-6);
    advance(law, spun.row);
    advance(law, still.row);
  }
  const Sym expected = push(turned(0.05 * 3000), still.stress_of(0));
  EXPECT_LT(difference(spun.stress_of(0), expected), 1e-10 * norm(expected));
}

} // namespace
} // namespace ballast
