// A plate with strength carried a hundred cells through an eulerian mesh, in a void and in a gas that goes along: its thickness, its
// shape, and what stress the remap makes in it.
#include "materials/library.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include "problems/build_scene.hpp"
#include "problems/run_measure.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

constexpr double h = 1e-3, speed = 500, atmosphere = 101325;
constexpr int travel = 100, thick = 10, tall = 8, across = 16; ///< cells

/// A plate `thick` x `tall` cells of copper that flies along x. `tilted`: its faces lie at 45 degrees instead.
SceneSpec flying_plate(bool gas, bool tilted) {
  SceneSpec s;
  Material copper = *find_material("copper_ofhc"), air = *find_material("air");
  const double pressure = gas ? atmosphere : 0;
  copper.specific_energy = energy(copper.eos, copper.density, pressure);
  air.specific_energy = energy(air.eos, air.density, pressure);
  s.ambient_pressure = pressure;
  s.end_time = travel * h / speed;
  s.materials = {copper};
  if (gas) {
    s.materials.push_back(air);
    const Shape everywhere{Box{{-1, -1, -1}, {1, 1, 1}}};
    s.bodies.push_back({"air", 1, everywhere, {speed, 0, 0}, air.density, pressure, air.specific_energy});
  }
  for (int i = 0; i <= travel + 3 * thick; ++i) {
    s.mesh_lines[0].push_back(i * h);
  }
  for (int j = 0; j <= across; ++j) {
    s.mesh_lines[1].push_back(j * h);
  }
  const double x = 5 * h, y = 0.5 * (across - tall) * h, w = thick * h, v = tall * h;
  Shape plate{Box{{x, y, -1}, {x + w, y + v, 1}}};
  if (tilted) { // a square on its corner
    const double r = 0.5 * v * std::sqrt(2.0), cx = x + r, cy = 0.5 * across * h, q = std::sqrt(0.5) * 0.5 * v * 2;
    const auto side = [&](double a, double b) { return Shape{HalfSpace{{cx + a * q * std::sqrt(0.5), cy + b * q * std::sqrt(0.5), 0}, {a, b, 0}}}; };
    plate = Shape{Combination{Combination::Kind::intersect, {side(1, 1), side(1, -1), side(-1, 1), side(-1, -1)}}};
  }
  s.bodies.push_back({"plate", 0, plate, {speed, 0, 0}, copper.density, pressure, copper.specific_energy});
  s.motion = {MotionPolicy::eulerian, 1};
  s.boundaries[0][0].kind = BoundaryKind::free;
  s.boundaries[0][1].kind = BoundaryKind::free;
  if (gas) {
    s.boundaries[0][0] = {BoundaryKind::inflow, 0, 1, {speed, 0, 0}, air.density, atmosphere, air.specific_energy};
    s.boundaries[0][1].kind = BoundaryKind::outflow;
  }
  s.boundaries[1][0].kind = s.boundaries[1][1].kind = BoundaryKind::symmetry;
  return s;
}

struct Noise {
  double pressure = 0, deviator = 0, shape = 0; ///< Pa, Pa; sum |f - f0| over sum f0
};

/// Stress in cells of mostly copper; its shape against the start, moved by the whole number of cells.
Noise noise_in(const Block<2>& b, const Block<2>& start) {
  Noise n;
  double volume = 0;
  const TileStore &now = b.materials[0].store, &then = start.materials[0].store;
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    const auto share = [&](const TileStore& store, int at) { return at >= 0 && store.has_row(r) ? store.row(field::fraction, r)[at] : 0.0; };
    const double f = share(now, i), f0 = share(then, i - travel);
    n.shape += std::abs(f - f0);
    volume += f0;
    if (f > 0.5) {
      n.pressure = std::max(n.pressure, std::abs(b.pressure.row(r)[i]));
      for (const RowField& s : b.stress) {
        n.deviator = std::max(n.deviator, std::abs(s.row(r)[i]));
      }
    }
  });
  n.shape /= volume;
  return n;
}

void carried(VerifyReport& r) {
  for (const bool gas : {false, true}) {
    for (const bool tilted : {false, true}) {
      const std::string name = fmt::format("{}{}", gas ? "in gas" : "in void", tilted ? ", on its corner" : "");
      const SceneSpec spec = flying_plate(gas, tilted);
      const Scene<2> start = build_scene<2>(spec, 1);
      const BodyMeasure before = measure_body(start.blocks[0], {0}, 0, 1.0);
      TubeRun<2> run;
      if (!ends(r, name, build_scene<2>(spec, 1), spec.end_time, run)) {
        continue;
      }
      const BodyMeasure after = measure_body(run.scene.blocks[0], {0}, 0, 1.0);
      const Noise n = noise_in(run.scene.blocks[0], start.blocks[0]);
      r.at_most(name + ", change of thickness / cell", 1, std::abs((after.front - after.rear) - (before.front - before.rear)) / h);
      r.note(name + ", shape, sum|f-f0| / sum f0", n.shape);
      r.note(name + ", pressure made in it (Pa)", n.pressure);
      r.note(name + ", deviator made in it (Pa)", n.deviator);
      r.note(name + ", speed lost / speed", 1 - after.velocity / speed);
      conserves(r, name, run);
      r.note(name + ", steps", static_cast<double>(run.clock.step));
    }
  }
  r.set_cells((travel + 3L * thick) * across);
}

} // namespace

void add_carried_plate_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"carried_plate", "a copper plate carried 100 cells in void and in gas keeps its thickness", carried});
}

} // namespace ballast::verify
