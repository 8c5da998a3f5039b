// Solids that deform and travel in RZ: the Taylor rod (copper, 227 m/s), and the M80 bullet carried
// ten lengths through void.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"
#include "tests/uniform_lines.hpp"

#include "problems/build_scene.hpp"
#include "problems/run_measure.hpp"
#include "problems/scene_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

// Copper of the published benchmark: rho 8930, E 117 GPa, nu 0.35, Y 0.4 GPa, H 0.1 GPa.
Material taylor_copper() {
  constexpr double youngs = 117e9, poisson = 0.35, rho = 8930;
  const double bulk = youngs / (3 * (1 - 2 * poisson));
  Material m;
  m.name = "copper";
  m.eos = MieGruneisen{rho, std::sqrt(bulk / rho), 1.49, 2.0};
  m.strength = LinearHardening{youngs / (2 * (1 + poisson)), 0.4e9, 0.1e9};
  m.density = rho;
  return m;
}

struct Rod {
  double length = 0, foot = 0; ///< mm
  TubeRun<2> run;
};

Rod taylor_rod(MotionPolicy motion, int across) {
  constexpr double radius = 3.2e-3, length = 32.4e-3, speed = 227;
  const double h = radius / across;
  SceneSpec s;
  s.geometry = Geometry::axisymmetric;
  s.ambient_pressure = 0;
  s.end_time = 80e-6;
  s.materials = {taylor_copper()};
  s.numerics.spall = false;
  s.motion = {motion, 1};
  const bool fitted = motion == MotionPolicy::lagrangian || motion == MotionPolicy::relax, follows = motion == MotionPolicy::follow;
  if (follows) { // from the wall and the axis outwards
    s.motion.leaders = {0};
    s.motion.stretches = {true, true, false};
  }
  const double r_end = fitted ? radius : h * std::ceil(9e-3 / h);
  const int nz = static_cast<int>(std::lround(length / h));
  const int above = fitted ? 0 : follows ? nz / 2 : 4; // the mesh shrinks more than the rod
  s.mesh_lines[0] = uniform(0, r_end, static_cast<int>(std::lround(r_end / h)));
  s.mesh_lines[1] = uniform(0, length * (nz + above) / nz, nz + above);
  s.bodies.push_back({"rod", 0, Shape{Box{{0, 0, -1}, {radius, length, 1}}}, {0, -speed, 0}, 8930, 0, 0});
  for (auto& side : s.boundaries) {
    side[0].kind = BoundaryKind::symmetry;
    side[1].kind = BoundaryKind::free;
  }
  TubeRun<2> run = run_scene(build_scene<2>(s, 1), s.end_time);
  const BodyMeasure m = measure_body(run.scene.blocks[0], {0}, 1, 1.0);
  return {m.front * 1e3, m.radius * 1e3, std::move(run)};
}

void taylor_case(VerifyReport& r) {
  const Rod coarse = taylor_rod(MotionPolicy::lagrangian, 8);
  r.note("Lag 8 across: length (mm)", coarse.length);
  r.note("Lag 8 across: foot radius (mm)", coarse.foot);
  conserves(r, "Lag 8 across", coarse.run);
  const Rod lag = taylor_rod(MotionPolicy::lagrangian, 16);
  r.set_cells(lag.run.scene.blocks[0].grid.cell_count());
  r.between("Lag 16 across: length (mm)", 21.3, 21.6, lag.length);
  r.between("Lag 16 across: foot radius (mm)", 7.0, 7.35, lag.foot);
  conserves(r, "Lag 16 across", lag.run);
  const Rod eul = taylor_rod(MotionPolicy::eulerian, 16);
  r.close("Eul 16 across: length (mm)", lag.length, 0.02, eul.length);
  r.close("Eul 16 across: foot radius (mm)", lag.foot, 0.02, eul.foot);
  conserves(r, "Eul 16 across", eul.run);
  const Rod relaxed = taylor_rod(MotionPolicy::relax, 16);
  r.close("relax 16 across: length (mm)", lag.length, 0.005, relaxed.length);
  r.close("relax 16 across: foot radius (mm)", lag.foot, 0.005, relaxed.foot);
  conserves(r, "relax 16 across", relaxed.run);
  const Rod followed = taylor_rod(MotionPolicy::follow, 16);
  r.close("follow 16 across: length (mm)", lag.length, 0.02, followed.length);
  r.close("follow 16 across: foot radius (mm)", lag.foot, 0.02, followed.foot);
  conserves(r, "follow 16 across", followed.run);
  r.note("steps: Lag", static_cast<double>(lag.run.clock.step));
  r.note("steps: relax", static_cast<double>(relaxed.run.clock.step));
  r.note("steps: Eul", static_cast<double>(eul.run.clock.step));
  r.note("steps: follow", static_cast<double>(followed.run.clock.step));
}

/// The M80 of problems/m80_tissue.toml through empty space: 285 mm at 823 m/s.
void carry(VerifyReport& r, int remap_every) {
  constexpr double speed = 823, distance = 0.285, h = 0.5e-3;
  ReadScene read = read_scene(std::string(BALLAST_SOURCE_DIR) + "/problems/m80_tissue.toml");
  SceneSpec& s = read.scene;
  s.bodies.erase(std::remove_if(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.name == "tissue"; }), s.bodies.end());
  s.gauges.clear();
  s.motion = {MotionPolicy::eulerian, remap_every};
  s.mesh_lines[0] = uniform(0, 6e-3, static_cast<int>(std::lround(6e-3 / h)));
  const double from = -32e-3, to = from + 32e-3 + distance + 4e-3;
  s.mesh_lines[1] = uniform(from, to, static_cast<int>(std::lround((to - from) / h)));
  s.end_time = distance / speed;
  TubeRun<2> run = run_scene(build_scene<2>(s, 1), s.end_time);
  Scene<2>& scene = run.scene;
  if (run.clock.step % remap_every != 0) {
    remap_block(scene, scene.blocks[0], run.clock.step);
    new_state(scene, scene.blocks[0], true);
    run.end = totals(scene.blocks[0]);
  }
  const Totals &start = run.start, &end = run.end;
  // The distance is a whole number of cells: the start shifted by it is the exact answer.
  SceneSpec shifted = s;
  const int shift = static_cast<int>(std::lround(distance / h));
  const Scene<2> reference = build_scene<2>(shifted, 1);
  const Block<2>&a = reference.blocks[0], &b = scene.blocks[0];
  double error = 0, volume = 0;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    for (std::size_t m = 0; m + 1 < b.materials.size(); ++m) {
      for (int i = 0; i < b.grid.cells[0]; ++i) {
        const double want = j >= shift ? a.materials[m].store.row(field::fraction, a.grid.cell_row(j - shift, 0))[i] : 0.0;
        const double got = b.materials[m].store.row(field::fraction, b.grid.cell_row(j, 0))[i];
        error += std::abs(want - got) * b.volume.row(b.grid.cell_row(j, 0))[i];
        volume += want * b.volume.row(b.grid.cell_row(j, 0))[i];
      }
    }
  }
  const BodyMeasure all = measure_body(b, {0, 1}, 1, 1.0);
  for (std::size_t m = 0; m < 2; ++m) {
    r.at_most(fmt::format("N {}: mass of {}", remap_every, b.materials[m].material.name), 1e-12,
              std::abs(end.mass[m] - start.mass[m]) / start.mass[m]);
  }
  conserves(r, fmt::format("N {}", remap_every), run);
  r.note(fmt::format("N {}: dropped slivers / mass", remap_every), scene.ledger.sliver_mass / (start.mass[0] + start.mass[1]));
  r.note(fmt::format("N {}: left the block / mass", remap_every), (scene.ledger.mass_out[0] + scene.ledger.mass_out[1]) / (start.mass[0] + start.mass[1]));
  r.note(fmt::format("N {}: shape, L1 of fraction / volume", remap_every), error / volume);
  r.note(fmt::format("N {}: speed / 823 m/s - 1", remap_every), all.velocity / speed - 1);
  r.set_cells(b.grid.cell_count());
}

} // namespace

void add_solid_impact_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"taylor_rod", "copper Taylor rod, 227 m/s, against published codes", taylor_case});
  for (const int n : {1, 4, 16}) {
    cases.push_back({fmt::format("m80_carried_{}", n), "M80 carried ten lengths through void: mass exact, shape and speed kept",
                     [n](VerifyReport& r) { carry(r, n); }});
  }
}

} // namespace ballast::verify
