// Order of accuracy on curvilinear meshes: a standing sound wave in a disc and in a ball (its section in RZ).
#include "tests/exact/standing_wave.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include "problems/build_scene.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

constexpr double amplitude = 1e-5; ///< of the ambient pressure's scale: squares of it are below the mesh's error

Material gas() {
  Material m;
  m.name = "gas";
  m.eos = IdealGas{1.4};
  m.density = 1;
  m.specific_energy = energy(m.eos, 1, 1 / 1.4); // sound speed 1
  return m;
}

double middle_radius(const Block<2>& b, int i, int j) {
  const int low = b.grid.node_row(j, 0), high = b.grid.node_row(j + 1, 0);
  const auto middle = [&](const RowField& x) { return 0.25 * (x.row(low)[i] + x.row(low)[i + 1] + x.row(high)[i] + x.row(high)[i + 1]); };
  return std::hypot(middle(b.position[0]), middle(b.position[1]));
}

/// A quarter of the disc or the ball, n cells from the middle to the edge.
Scene<2> at_rest(bool ball, MotionPolicy motion, int n) {
  const Material m = gas();
  SceneSpec s;
  s.geometry = ball ? Geometry::axisymmetric : Geometry::planar;
  s.map = {ball ? MapKind::ball_section : MapKind::disc, {0, 0, 0}, 1};
  s.ambient_pressure = 1 / 1.4;
  s.materials = {m};
  s.background = 0;
  s.motion = {motion, 1};
  for (std::size_t d = 0; d < 2; ++d) {
    for (int i = 0; i <= n; ++i) {
      s.mesh_lines[d].push_back(static_cast<double>(i) / n);
    }
    s.boundaries[d] = {Boundary{BoundaryKind::symmetry}, Boundary{BoundaryKind::free}};
  }
  return build_scene<2>(s, 1);
}

double error_of(bool ball, MotionPolicy motion, int n, VerifyReport& r) {
  const exact::StandingWave wave{ball};
  Scene<2> scene = at_rest(ball, motion, n);
  Block<2>& b = scene.blocks[0];
  for_each_cell(b, [&](int i, int j, int) { // adiabatic: rho' = p', e' = p / rho^2 rho' at sound speed 1
    const int row = b.grid.cell_row(j, 0);
    const double p = 1 / 1.4 + amplitude * wave.pressure(middle_radius(b, i, j), 0), rho = std::pow(p * 1.4, 1 / 1.4);
    b.materials[0].store.row(field::mass, row)[i] = rho * b.volume.row(row)[i];
    b.materials[0].store.row(field::energy, row)[i] = energy(gas().eos, rho, p);
  });
  const TubeRun<2> run = run_scene(std::move(scene), 1.25 * wave.period()); // p' is zero then: phase errors count in full
  const Block<2>& end = run.scene.blocks[0];
  double square = 0, volume = 0;
  for_each_cell(end, [&](int i, int j, int) {
    const int row = end.grid.cell_row(j, 0);
    const double miss = end.pressure.row(row)[i] / amplitude - wave.pressure(middle_radius(end, i, j), run.clock.time), v = end.volume.row(row)[i];
    square += v * miss * miss;
    volume += v;
  });
  conserves(r, fmt::format("{} {} {}", ball ? "ball RZ" : "disc", short_name(motion), n), run);
  return std::sqrt(square / volume);
}

void standing_wave(VerifyReport& r) {
  for (const bool ball : {false, true}) {
    for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
      const std::string name = fmt::format("{} {}", ball ? "ball RZ" : "disc", short_name(motion));
      double before = 0;
      for (const int n : {8, 16, 32}) {
        const double error = error_of(ball, motion, n, r);
        r.note(fmt::format("{}, {} cells: L2 of p', by amplitude", name, n), error);
        const std::string order = fmt::format("{}, {} cells: order", name, n);
        if (n == 16) {
          r.note(order, std::log2(before / error));
        } else if (n == 32) {
          r.at_least(order, 1.8, std::log2(before / error)); // second order, less what the kinks at the diagonals and the edge cost
        }
        before = error;
        r.set_cells(n * n);
      }
    }
  }
}

} // namespace

void add_standing_wave_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"standing_wave", "sound in a disc and a ball on curvilinear meshes: order of accuracy", standing_wave});
}

} // namespace ballast::verify
