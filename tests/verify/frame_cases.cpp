// Symmetries of a two-material problem in 2D: a dense ball of gas, off centre, hit by a hot corner.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

constexpr int cells = 24;

/// How the same problem is looked at.
struct View {
  bool mirrored = false; ///< x -> 1 - x
  bool swapped = false;  ///< x <-> y
  double drift = 0;      ///< m/s along x, of everything
};

/// Fraction of the ball in a cell, from 10 x 10 points placed symmetrically.
double ball(double x0, double y0) {
  int hits = 0;
  for (int q = 0; q < 100; ++q) {
    const double x = x0 + (q % 10 + 0.5) / (10 * cells) - 0.55, y = y0 + (q / 10 + 0.5) / (10 * cells) - 0.4;
    hits += x * x + y * y < 0.04;
  }
  return hits / 100.0;
}

Scene<2> scene_seen(const View& view, MotionPolicy motion) {
  Material heavy, light;
  heavy.name = "heavy";
  heavy.eos = IdealGas{1.6};
  heavy.density = 5;
  light.name = "light";
  Block<2> b;
  b.motion = {motion, 1};
  b.materials.push_back(make_slot(heavy, 0));
  b.materials.push_back(make_slot(light, 0));
  std::array<std::vector<double>, 3> lines;
  for (int i = 0; i <= cells; ++i) {
    lines[0].push_back(static_cast<double>(i) / cells);
  }
  lines[1] = lines[0];
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    int a = view.mirrored ? cells - 1 - i : i, c = j;
    if (view.swapped) {
      std::swap(a, c);
    }
    const double f = ball(static_cast<double>(a) / cells, static_cast<double>(c) / cells);
    const double p = a < 6 && c < 10 ? 10 : 1;
    fill_cell<2>(b, i, j, k, std::vector<CellPart>{{0, f, 5, energy(heavy.eos, 5, p)}, {1, 1 - f, 1, energy(light.eos, 1, p)}});
  });
  set_velocity(b, [&](const std::array<double, 2>&, std::array<double, 2>& u) { u[0] = view.drift; });
  b.boundary.side[0] = {{{BoundaryKind::wall, view.drift}, {BoundaryKind::wall, view.drift}}};
  Scene<2> scene;
  scene.blocks.push_back(std::move(b));
  return scene;
}

/// Worst difference of velocity and pressure, seen back from `view`; both are of order one.
double difference(const TubeRun<2>& run, const TubeRun<2>& other, const View& view) {
  const Block<2>&a = run.scene.blocks[0], &b = other.scene.blocks[0];
  double worst = std::abs(run.clock.time - other.clock.time);
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const int p = view.swapped ? j : i, jj = view.swapped ? i : j, ii = view.mirrored ? cells - p : p;
      const double ux = b.velocity[view.swapped ? 1 : 0].row(b.grid.node_row(jj, 0))[ii];
      const double uy = b.velocity[view.swapped ? 0 : 1].row(b.grid.node_row(jj, 0))[ii];
      const double seen = view.mirrored ? -ux : ux - view.drift;
      worst = std::max({worst, std::abs(a.velocity[0].row(a.grid.node_row(j, 0))[i] - seen),
                        std::abs(a.velocity[1].row(a.grid.node_row(j, 0))[i] - uy)});
      if (i < cells && j < cells) {
        const int pc = view.swapped ? j : i, jc = view.swapped ? i : j, ic = view.mirrored ? cells - 1 - pc : pc;
        worst = std::max(worst, std::abs(a.pressure.row(a.grid.cell_row(j, 0))[i] - b.pressure.row(b.grid.cell_row(jc, 0))[ic]));
      }
    }
  }
  return worst;
}

TubeRun<2> run_seen(const View& view, MotionPolicy motion) { return run_scene<2>(scene_seen(view, motion), 0.1); }

/// Round-off of 1e-16 on values of order 10, grown through 50 steps: 1e-11. Eul 1e-9, because a plane's
/// normal and offset, found by search, carry 1e-13 of their own into thin fractions.
void frames(VerifyReport& r) {
  const View mirrored{.mirrored = true}, swapped{.swapped = true}, drifting{.drift = 3};
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    const std::string name = short_name(motion);
    const TubeRun<2> plain = run_seen({}, motion), mirror = run_seen(mirrored, motion);
    r.at_most(name + ", mirrored in x", motion == MotionPolicy::lagrangian ? 1e-11 : 1e-9, difference(plain, mirror, mirrored));
    conserves(r, name, plain);
    conserves(r, name + " mirrored", mirror);
    const TubeRun<2> swap = run_seen(swapped, motion);
    conserves(r, name + " exchanged", swap);
    if (motion == MotionPolicy::lagrangian) {
      r.at_most(name + ", x and y exchanged", 1e-11, difference(plain, swap, swapped));
      const TubeRun<2> drift = run_seen(drifting, motion);
      r.at_most(name + ", from a moving frame", 1e-11, difference(plain, drift, drifting));
      conserves(r, name + " moving", drift);
    } else {
      r.note(name + ", x and y exchanged (sweep order)", difference(plain, swap, swapped));
    }
    r.note(name + ", steps", static_cast<double>(plain.clock.step));
  }
  r.set_cells(cells * cells);
}

} // namespace

void add_frame_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"frames", "two gases in 2D look the same mirrored, turned and from a moving frame", frames});
}

} // namespace ballast::verify
