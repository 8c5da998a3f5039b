// A strip hit across at constant speed: strain and speed of the transverse wave are Smith's (1958) of a yarn.
#include "tests/exact/reference_table.hpp"
#include "tests/layers/stacks.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

using namespace stacks;

struct Hit {
  double strain = 0, wave = 0; ///< engineering; m/s of rest length
  double hourglass_share = 0;
};

constexpr double h = 0.25e-3, thickness = 0.05e-3;

double middle(const LayerStack<2>& s, std::size_t d, int i) {
  return 0.5 * (s.position[d][s.node(i, 0, 0)] + s.position[d][s.node(i, 0, 1)]);
}

/// Where the leg behind the kink, fitted clear of kink and hit, meets the undisturbed line (place at rest).
double kink(const LayerStack<2>& s, double driven) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < s.grid.nodes_along(0); ++i) {
    const double X = s.lines[0][static_cast<std::size_t>(i)], y = (middle(s, 1, i) - thickness / 2) / driven;
    if (y > 0.25 && y < 0.75) {
      n += 1, sx += X, sy += y, sxx += X * X, sxy += X * y;
    }
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return (sx - sy / slope) / n;
}

/// Half a strip, driven at its middle for `time`. It bends over t/sqrt(12 strain), a third of a millimetre at most, where it
/// is hit: the kink is that much ahead of a yarn's all the time, so its speed is taken between half the time and all of it.
Hit hit_strip(double young, double density, double speed, double time) {
  const int n = static_cast<int>(1.05 * std::sqrt(young / density) * time / h);
  LayerInput in = brick(hooke(young, 0, density), {n, 1, 1}, {h, 1, thickness}, 2);
  in.edge[0][0] = LayerEdge::symmetry;
  LayerStack<2> s = make_stack<2>(in);
  ThreadPool pool(1);
  LayerLedger ledger;
  for (int plane = 0; plane < 2; ++plane) { // a driver that nothing slows, so that its work is in the books
    s.mass[s.node(0, 0, plane)] = 1e6;
    s.velocity[1][s.node(0, 0, plane)] = speed;
  }
  update_forces(s, 0.0, ledger, pool);
  double t = 0;
  const auto run_to = [&](double end) {
    while (t < end) {
      const double dt = std::min(stable_step(s).dt, end - t);
      substep(s, dt, ledger, pool);
      t += dt;
    }
    return kink(s, speed * end);
  };
  Hit hit;
  const double half_way = run_to(time / 2), way = run_to(time);
  hit.wave = (way - half_way) / (time / 2);
  // Mean strain from clear of the hit to half the way of the longitudinal wave.
  const int from = static_cast<int>(0.2 * way / h), to = n / 2;
  double arc = 0;
  for (int i = from; i < to; ++i) {
    arc += std::hypot(middle(s, 0, i + 1) - middle(s, 0, i), middle(s, 1, i + 1) - middle(s, 1, i));
  }
  hit.strain = arc / ((to - from) * h) - 1;
  hit.hourglass_share = totals(s).hourglass_share();
  return hit;
}

TEST(LayerStrip, HitAcrossFollowsSmith) {
  const exact::ReferenceTable table(std::string(BALLAST_TEST_DATA) + "/yarn_transverse_impact.csv");
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const double speed = table.number(row, "V");
    const bool chosen = speed == 100 || speed == 200 || speed == 300 || speed == 370 || speed == 400;
    if (table.text(row, "yarn") != "KM2" || !chosen) {
      continue;
    }
    const Hit hit = hit_strip(table.number(row, "E"), table.number(row, "rho"), speed, 20e-6);
    const double strain = hit.strain / table.number(row, "eps"), wave = hit.wave / table.number(row, "Uprime_lagrangian");
    EXPECT_NEAR(strain, 1, 0.02) << speed;
    EXPECT_NEAR(wave, 1, 0.02) << speed;
    EXPECT_LT(hit.hourglass_share, 0.05) << speed;
  }
}

} // namespace
} // namespace ballast
