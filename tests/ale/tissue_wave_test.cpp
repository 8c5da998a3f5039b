// Plane waves in viscoelastic solids through the whole step, against exact speeds, attenuations and a transient.
//
// One row of cells along x on rollers: the sides across y hold the x velocity at zero, so that shear waves are plane;
// waves along x have ordinary walls. Small amplitudes: the exact solutions are linear. No artificial viscosity: it would damp, too.
#include "tests/ale/tissue_blocks.hpp"
#include "tests/exact/reference_table.hpp"
#include "tests/exact/visco_wave.hpp"

#include <cmath>
#include <complex>
#include <gtest/gtest.h>

namespace ballast {
namespace {

using exact::PlaneWave;
using exact::PronySeries;

Prony law_of(const PronySeries& m) {
  Prony law{.long_shear = m.long_shear, .branches = m.shear.size()};
  for (std::size_t b = 0; b < m.shear.size(); ++b) {
    law.branch[b] = {m.shear[b], m.time[b]};
  }
  return law;
}

/// A bar of `cells` cells whose low end moves as `drive` says.
struct Bar {
  Scene<2> scene;
  Clock clock;
  std::size_t component; ///< of the velocity

  Bar(const PronySeries& m, bool longitudinal, double length, int cells, double dt)
      : scene(tissue_scene<2>(tissue_of(law_of(m), m.bulk, m.density), {even_lines(0, length, cells), even_lines(0, length / cells, 1), {}})),
        component(longitudinal ? 0 : 1) {
    BoundarySet& sides = scene.blocks[0].boundary;
    if (!longitudinal) {
      sides.normal[1] = {0, 0};
      sides.normal[0] = {1, 1};
    }
    scene.numerics.linear_q = scene.numerics.quadratic_q = 0;
    scene.numerics.dt_initial = scene.numerics.dt_max = dt;
    clock.end_time = 1e3;
    prepare(scene);
  }
  void step(double speed) {
    scene.blocks[0].boundary.side[0][0].velocity = speed;
    advance(scene, clock);
  }
  double velocity(int node) const { return scene.blocks[0].velocity[component].row(scene.blocks[0].grid.node_row(0, 0))[node]; }
};

/// Phase speed and attenuation between two nodes, once the wave is steady there.
PlaneWave measured(PronySeries m, bool longitudinal, double frequency, int cells_per_wave) {
  m.bulk = 4 * exact::complex_shear(m, 1e12).real(); // sound not much faster than shear, so that steps are not wasted
  const PlaneWave want = exact::plane_wave(m, frequency, longitudinal);
  const double wave = want.speed / frequency, dx = wave / cells_per_wave, fastest = exact::front(m, longitudinal).speed;
  const double sound = std::sqrt((m.bulk + 4.0 / 3.0 * exact::complex_shear(m, 1e12).real()) / m.density);
  const int per_period = static_cast<int>(std::ceil(sound / (0.4 * dx * frequency)));
  const double dt = 1 / (frequency * per_period);
  const int near = cells_per_wave / 2, far = near + cells_per_wave, periods = 6;
  const int cells = static_cast<int>(std::ceil(fastest * periods / (frequency * dx))) + 5; // nothing comes back from the end
  Bar bar(m, longitudinal, cells * dx, cells, dt);
  std::complex<double> a = 0, b = 0;
  for (int n = 0; n < periods * per_period; ++n) {
    const double phase = 2 * M_PI * (n + 1) / per_period, ramp = std::min(1.0, phase / (2 * M_PI));
    bar.step(1e-4 * want.speed * ramp * ramp * (3 - 2 * ramp) * std::sin(phase));
    if (n >= (periods - 1) * per_period) {
      const std::complex<double> turn = std::polar(1.0, -phase);
      a += bar.velocity(near) * turn;
      b += bar.velocity(far) * turn;
    }
  }
  EXPECT_EQ(bar.clock.dt, dt); // the step was stable
  const std::complex<double> ratio = b / a;
  const double turned = std::arg(ratio) <= 0 ? -std::arg(ratio) : 2 * M_PI - std::arg(ratio); // near one whole wave
  const double phase = turned < M_PI ? turned + 2 * M_PI : turned;
  return {2 * M_PI * frequency * wave / phase, -std::log(std::abs(ratio)) / wave};
}

void expect_wave(const PronySeries& m, bool longitudinal, double frequency) {
  PronySeries soft = m;
  soft.bulk = 4 * exact::complex_shear(m, 1e12).real();
  const PlaneWave want = exact::plane_wave(soft, frequency, longitudinal), got = measured(m, longitudinal, frequency, 60);
  // Dispersion of linear cells, (2 pi/60)^2/24 = 5e-4, and of the way the wave is measured.
  EXPECT_NEAR(got.speed / want.speed, 1, 0.001);
  EXPECT_NEAR(got.attenuation / want.attenuation, 1, 0.01);
}

TEST(TissueWave, ShearWavesHaveTheExactSpeedAndAttenuation) {
  expect_wave(exact::sls(), false, 5e3);
  expect_wave(exact::sls(), false, 2e4);
  expect_wave(exact::tissue_a(), false, 1e4);
  expect_wave(exact::tissue_a(), false, 1e5);
  expect_wave(exact::gelatin_b(), false, 1e4);
}
TEST(TissueWave, LongitudinalWavesHaveTheExactSpeedAndAttenuation) {
  expect_wave(exact::sls(), true, 5e3);
  expect_wave(exact::tissue_a(), true, 1e5);
  expect_wave(exact::gelatin_b(), true, 1e4);
}

/// Velocities of a standing shear wave on eight cells after 20 us, by steps of dt.
std::vector<double> swung(const TissueLaw& law, double dt) {
  constexpr int cells = 8;
  constexpr double length = 8e-4;
  Scene<2> scene = tissue_scene<2>(tissue_of(law, 4.4e6), {even_lines(0, length, cells), even_lines(0, length / cells, 1), {}});
  Block<2>& b = scene.blocks[0];
  b.boundary.normal[1] = {0, 0};
  b.boundary.normal[0] = {1, 1};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i <= cells; ++i) {
      b.velocity[1].row(b.grid.node_row(j, 0))[i] = i == cells ? 0 : 1e-4 * std::sin(M_PI * i / cells);
    }
  }
  scene.numerics.linear_q = scene.numerics.quadratic_q = 0;
  scene.numerics.dt_initial = scene.numerics.dt_max = dt;
  Clock clock;
  clock.end_time = 1;
  prepare(scene);
  for (long n = std::lround(20e-6 / dt); n > 0; --n) {
    advance(scene, clock);
    EXPECT_EQ(clock.dt, dt);
  }
  const double* u = scene.blocks[0].velocity[1].row(b.grid.node_row(0, 0));
  return {u + 1, u + cells};
}

TEST(TissueWave, ABranchAsShortAsTheStepIsSecondOrderInTime) {
  Prony prony{.long_shear = 1e5, .branches = 1};
  prony.branch[0] = {1e6, 4e-7};
  FungQlv fung{.shear = 1.1e6, .stiffening = 2, .branches = 1};
  fung.branch[0] = {1e6 / 1.1e6, 4e-7};
  for (const TissueLaw& law : {TissueLaw{prony}, TissueLaw{fung}}) {
    const std::vector<double> exact = swung(law, 1.25e-8);
    std::array<double, 3> error{};
    for (std::size_t level = 0; level < 3; ++level) {
      const std::vector<double> u = swung(law, 4e-7 / static_cast<double>(1 << level));
      for (std::size_t i = 0; i < u.size(); ++i) {
        error[level] = std::max(error[level], std::abs(u[i] - exact[i]) / exact[3]);
      }
    }
    EXPECT_LT(error[0], 4e-4);
    EXPECT_NEAR(error[0] / error[1], 4, 0.5);
    EXPECT_NEAR(error[1] / error[2], 4, 0.3);
  }
}

/// Mean over the points of a table behind the front, between shares `from` and `to` of the way to it, of the velocity over the exact one;
/// and the mean error over the whole profile.
constexpr double drive = 1e-3; // m/s; the table's is 1 m/s
struct Profile {
  double ratio = 0, error = 0;
};
Profile compare(const Bar& bar, const exact::ReferenceTable& table, double dx, double front, double from, double to) {
  Profile p;
  int behind = 0;
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    const double x = table.number(row, "x"), want = table.number(row, "velocity"), at = x / dx;
    const int node = static_cast<int>(at);
    const double got = bar.velocity(node) + (at - node) * (bar.velocity(node + 1) - bar.velocity(node));
    p.error += std::abs(got / drive - want) / static_cast<double>(table.row_count());
    if (x > from * front && x < to * front) {
      p.ratio += got / (drive * want);
      ++behind;
    }
  }
  p.ratio /= behind;
  return p;
}

TEST(TissueWave, AStepsFrontDecaysAsItShould) {
  const PronySeries m = exact::sls();
  PronySeries soft = m;
  soft.bulk = 16e6;
  const exact::ReferenceTable early(BALLAST_TEST_DATA "/visco_sls_step_velocity_t20us.csv"), late(BALLAST_TEST_DATA "/visco_sls_step_velocity_t60us.csv");
  const PlaneWave front = exact::front(m, false);
  const double dx = 1e-5, dt = 2e-8;
  Bar bar(soft, false, 4e-3, 400, dt);
  // Over a few cells: a sharper step would ring.
  const auto run_to = [&](double time) {
    while (bar.clock.time < time - 0.5 * dt) {
      bar.step(drive * std::min(1.0, (bar.clock.time + dt) / (8 * dx / front.speed)));
    }
  };
  const double delay = 4 * dx / front.speed; // of the step's middle
  run_to(2e-5 + delay);
  const Profile a = compare(bar, early, dx, front.speed * 2e-5, 0.8, 0.96);
  run_to(6e-5 + delay);
  const Profile b = compare(bar, late, dx, front.speed * 6e-5, 0.8, 0.96);
  const double path = front.speed * 4e-5;
  const double decay = front.attenuation - std::log(b.ratio / a.ratio) / path;
  EXPECT_NEAR(a.ratio, 1, 0.01);
  EXPECT_NEAR(b.ratio, 1, 0.01);
  EXPECT_NEAR(decay / front.attenuation, 1, 0.02);
}

} // namespace
} // namespace ballast
