// Laws of the linear Prony deviator, against closed forms (tests/data/visco_*).
#include "visco_points.hpp"

#include "tests/exact/reference_table.hpp"

namespace ballast {
namespace {

struct Set {
  const char* name;
  Prony law;
  double ramp, frequency, turn;
};

std::vector<Set> sets() {
  Prony tissue{1e4, 3, {{{4e4, 1e-2}, {2e5, 1e-4}, {1e6, 2e-6}}}}, sls{1e6, 1, {{{3e6, 2e-5}}}},
      gelatin{5e4, 2, {{{1e5, 5e-4}, {5e5, 1e-5}}}};
  constexpr double pi = 3.14159265358979323846;
  return {{"tissueA", tissue, 10, 600 * pi, 0.01}, {"sls", sls, 5000, 3e5 * pi, 2e-5}, {"gelatinB", gelatin, 200, 12000 * pi, 5e-4}};
}

exact::ReferenceTable table_of(const Set& set) {
  return exact::ReferenceTable(std::string(BALLAST_TEST_DATA) + "/visco_" + set.name + "_relax_ramp_osc.csv");
}

/// Shear without rotation by an engineering shear strain.
void shear(const Prony& law, Points& p, double gamma, double dt) {
  p.move(0, {0, 0.5 * gamma, 0, 0.5 * gamma, 0, 0, 0, 0, 0}, dt);
  advance(law, p.row);
}

TEST(Prony, RelaxesAsTheClosedForm) {
  for (const Set& set : sets()) {
    const auto table = table_of(set);
    Points p(set.law, 1);
    shear(set.law, p, 0.01, 1e-25); // a jump
    double t = 0;
    for (std::size_t r = 1; r < table.row_count(); ++r) {
      shear(set.law, p, 0, table.number(r, "t") - t);
      t = table.number(r, "t");
      // The table has 13 digits; 200 steps of round-off.
      EXPECT_NEAR(p.stress[3][0] / (0.01 * table.number(r, "G_relax")), 1, 1e-11) << set.name << " " << t;
    }
  }
}

TEST(Prony, RampAndTriangleAreExactForAnyStep) {
  for (const Set& set : sets()) {
    const auto table = table_of(set);
    for (const char* column : {"tau_ramp", "tau_triangle"}) {
      Points p(set.law, 1);
      const bool turns = std::string(column) == "tau_triangle";
      double t = 0;
      for (std::size_t r = 1; r < table.row_count(); ++r) {
        const double to = table.number(r, "t");
        if (turns && t < set.turn && to > set.turn) {
          shear(set.law, p, set.ramp * (set.turn - t), set.turn - t);
          t = set.turn;
        }
        shear(set.law, p, set.ramp * (turns && to > set.turn ? -1 : 1) * (to - t), to - t);
        t = to;
        EXPECT_NEAR(p.stress[3][0], table.number(r, column), 1e-10 * set.ramp * t * instant_shear(set.law)) << set.name << " " << t;
      }
    }
  }
}

TEST(Prony, OscillationConvergesToTheClosedForm) {
  for (const Set& set : sets()) {
    const auto table = table_of(set);
    Points p(set.law, 1);
    double t = 0;
    for (std::size_t r = 1; r < table.row_count() && set.frequency * t < 13; ++r) { // two periods
      const double to = table.number(r, "t");
      // Strain between ends is taken as linear: (w h)^2/12 = 3e-9.
      const int steps = static_cast<int>(std::ceil(set.frequency * (to - t) / 2e-4));
      for (int k = 0; k < steps; ++k) {
        const double a = t + (to - t) * k / steps, b = t + (to - t) * (k + 1) / steps;
        shear(set.law, p, 0.01 * (std::sin(set.frequency * b) - std::sin(set.frequency * a)), (to - t) / steps);
      }
      t = to;
      EXPECT_NEAR(p.stress[3][0], table.number(r, "tau_osc"), 1e-8 * 0.01 * instant_shear(set.law)) << set.name << " " << t;
    }
  }
}

TEST(Prony, WorkIsStoredOrDissipated) {
  const Set set = sets()[0];
  for (const double dt : {1e-12, 1e-8, 2e-6, 1e-3, 10.0}) {
    Points p(set.law, 1);
    double before = 0, work = 0;
    for (int k = 0; k < 200; ++k) {
      const Mat g{1e-3 * std::sin(k), 2e-3, 0, 1e-3 * std::cos(3 * k), -1e-3, 5e-4, 3e-4, 0, 1e-4};
      p.move(0, g, dt);
      advance(set.law, p.row);
      EXPECT_GE(p.dissipated[0], 0);
      work += std::abs(p.work[0]);
      EXPECT_NEAR(p.work[0], p.stored[0] - before + p.dissipated[0], 1e-13 * work) << dt;
      before = p.stored[0];
    }
  }
}

TEST(Prony, WorkIsThatOfTheStressAlongTheStep) {
  // Simpson over a step cut in 2000 against the step's own integral; x = 5 and 0.01.
  const Prony law{1e4, 2, {{{1e6, 2e-6}, {1e5, 1e-3}}}};
  Points one(law, 1), many(law, 1);
  const Mat g{2e-3, 1e-3, 0, 1e-3, -1e-3, 0, 0, 0, -1e-3};
  double cut = 0;
  for (int step = 0; step < 3; ++step) {
    one.move(0, g, 1e-5);
    advance(law, one.row);
    Mat part = g;
    for (double& x : part) {
      x /= 2000;
    }
    cut = 0;
    for (int k = 0; k < 2000; ++k) {
      const Sym start = many.stress_of(0);
      many.move(0, part, 5e-9);
      advance(law, many.row);
      cut += 0.5 * contract(combine(1, start, 1, many.stress_of(0)), symmetric_part(part));
    }
  }
  EXPECT_NEAR(cut / one.work[0], 1, 1e-6); // trapezoid: (dt/tau)^2/12 = 5e-7
}

TEST(Prony, SpinTurnsAStrainedStateExactly) {
  const Prony law = sets()[0].law;
  Points spun(law, 1), still(law, 1);
  const Mat strain{1e-2, 2e-2, 0, 2e-2, -3e-2, 1e-2, 0, 1e-2, 2e-2};
  for (Points* p : {&spun, &still}) {
    p->move(0, strain, 1e-7);
    advance(law, p->row);
  }
  const double angle = 0.037, dt = 1e-6;
  for (int k = 1; k <= 5000; ++k) {
    spun.move(0, midpoint_gradient(unit_mat, turned(angle)), dt);
    still.move(0, Mat{}, dt);
    advance(law, spun.row);
    advance(law, still.row);
    if (k % 500 == 0) {
      const Sym expected = push(turned(angle * k), still.stress_of(0));
      EXPECT_LT(difference(spun.stress_of(0), expected), 1e-10 * norm(expected)) << k;
    }
  }
}

} // namespace
} // namespace ballast
