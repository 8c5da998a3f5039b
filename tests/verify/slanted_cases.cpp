// One-dimensional flows on meshes whose lines do not follow them: Saltzman's piston, LeBlanc's tube, the 123 double
// rarefaction, each several cells across.
//
// Saltzman: Dukowicz and Meltz, J. Comput. Phys. 99 (1992) 115. Mesh x = x_i + (h - y) sin(w pi x_i / L), w = 1 there; here w also
// such that the initial jump lies on a straight mesh line. An eulerian block keeps the slanted mesh.
#include "tests/exact/riemann_cases.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <string_view>

namespace ballast::verify {

namespace {

struct Slanted {
  int cells, across;
  double length;
  int waves; ///< half waves of the slant along the tube
  MotionPolicy motion;
  Material gas;
};

/// Block of square cells, slanted; filled by `state`(x of the cell's middle row).
template <class State> Block<2> slanted_block(const Slanted& s, State&& state) {
  const double h = s.length / s.cells, height = s.across * h;
  Block<2> b;
  b.motion = {s.motion, 1};
  b.materials.push_back(make_slot(s.gas, 0));
  std::array<std::vector<double>, 3> lines;
  for (int i = 0; i <= s.cells; ++i) {
    lines[0].push_back(i * h);
  }
  for (int j = 0; j <= s.across; ++j) {
    lines[1].push_back(j * h);
  }
  allocate_block(b, lines);
  for (int j = 0; j <= s.across; ++j) {
    double* x = b.position[0].row(b.grid.node_row(j, 0));
    for (int i = 1; i < s.cells; ++i) {
      x[i] += (height - j * h) * std::sin(s.waves * std::numbers::pi * i / s.cells);
    }
    std::copy(x, x + s.cells + 1, b.target[0].row(b.grid.node_row(j, 0)));
  }
  for (int j = 0; j < s.across; ++j) {
    cell_volumes(b, b.position, j, 0, Span{0, b.grid.cells[0]}, b.volume.row(b.grid.cell_row(j, 0)));
  }
  exchange_cells(b.grid, b.volume);
  b.target_volume = b.volume;
  for_each_cell(b, [&](int i, int j, int k) {
    const TubeState t = state((i + 0.5) * h);
    fill_cell<2>(b, i, j, k, std::vector<CellPart>{{0, 1, t.density, t.specific_energy}});
  });
  return b;
}

/// Cells of row j, left to right.
std::vector<TubeCell> row_profile(const Block<2>& b, int j) {
  const int r = b.grid.cell_row(j, 0), n0 = b.grid.node_row(j, 0), n1 = b.grid.node_row(j + 1, 0);
  const auto edge = [&](const RowField& f, int i) { return 0.5 * (f.row(n0)[i] + f.row(n1)[i]); };
  std::vector<TubeCell> out;
  for (int i = 0; i < b.grid.cells[0]; ++i) {
    const double x0 = edge(b.position[0], i), x1 = edge(b.position[0], i + 1);
    const double u = 0.5 * (edge(b.velocity[0], i) + edge(b.velocity[0], i + 1));
    out.push_back({0.5 * (x0 + x1), x1 - x0, b.density.row(r)[i], u, b.pressure.row(r)[i], false});
  }
  return out;
}

/// A front by row: where the density crosses `level`, from the right or from the left.
struct Front {
  double mean = 0, spread = 0;
};
Front front_of(const Block<2>& b, double level, bool from_right) {
  Front f;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    const auto cells = row_profile(b, j);
    const auto density = [](const TubeCell& c) { return c.density; };
    const double x = from_right ? rightmost_crossing(cells, density, level) : leftmost_crossing(cells, density, level);
    f.mean += x / b.grid.cells[1];
    low = std::min(low, x);
    high = std::max(high, x);
  }
  f.spread = high - low;
  return f;
}

/// Mean over all rows of a value between two places.
double plateau(const Block<2>& b, const CellValue& value, double from, double to) {
  double sum = 0;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    sum += mean_between(row_profile(b, j), value, from, to) / b.grid.cells[1];
  }
  return sum;
}

// Saltzman: gamma 5/3, cold gas at rest, piston at 1 m/s. The shock runs at 4/3, the density behind it is 4. The wall sends it back
// at 2/3 into gas that comes at 1, density 10; piston and shock meet at 0.9.
constexpr double cold = 1e-4; ///< J/kg, of the gas ahead: 2e-4 of what is behind; Dukowicz and Meltz

TubeRun<2> saltzman_to(VerifyReport& r, const std::string& name, double time, bool& ended) {
  Material m;
  m.name = "gas";
  m.eos = IdealGas{5.0 / 3};
  m.density = 1;
  Block<2> b = slanted_block({100, 10, 1, 1, MotionPolicy::lagrangian, m}, [](double) { return TubeState{0, 1, 0, cold}; });
  b.boundary.side[0] = {{{BoundaryKind::wall, 1}, {BoundaryKind::wall, 0}}};
  set_velocity(b, [](const std::array<double, 2>& x, std::array<double, 2>& u) { u[0] = x[0] < 1e-9 ? 1 : 0; });
  Scene<2> scene;
  scene.blocks.push_back(std::move(b));
  TubeRun<2> run;
  ended = ends(r, name, std::move(scene), time, run);
  return run;
}

void saltzman(VerifyReport& r) {
  const auto density = [](const TubeCell& c) { return c.density; };
  for (const double time : {0.6, 0.7, 0.85, 0.925}) {
    const std::string name = fmt::format("Lag t {}", time);
    bool ended = false;
    const TubeRun<2> run = saltzman_to(r, name, time, ended);
    if (!ended) {
      continue;
    }
    const Block<2>& b = run.scene.blocks[0];
    if (time < 0.75) {
      const double at = 4 * time / 3;
      const Front f = front_of(b, 2.5, true);
      r.close(name + ", shock position", at, 0.01, f.mean);
      r.note(name + ", shock position, spread by row", f.spread);
      r.close(name + ", density behind", 4, 0.05, plateau(b, density, time + 0.25 * (at - time), at - 0.25 * (at - time)));
    } else if (time < 0.9) {
      const Front f = front_of(b, 7, false);
      r.close(name + ", returned shock's position", 1 - (time - 0.75) * 2 / 3, 0.01, f.mean);
      r.note(name + ", returned shock, spread by row", f.spread);
    }
    conserves(r, name, run);
    r.note(name + ", steps", static_cast<double>(run.clock.step));
  }
  r.set_cells(1000);
}

const exact::RiemannCase& named(std::string_view name) {
  return *std::find_if(exact::riemann_cases.begin(), exact::riemann_cases.end(), [&](const exact::RiemannCase& c) { return c.name == name; });
}

struct TubeOnSlant {
  exact::RiemannCase problem;
  double length;
  int cells, across, waves;
};

Scene<2> slanted_tube(const TubeOnSlant& t, MotionPolicy motion) {
  const Material m = gas("gas", t.problem.left);
  const exact::GasState &l = t.problem.left, &q = t.problem.right;
  Block<2> b = slanted_block({t.cells, t.across, t.length, t.waves, motion, m}, [&](double x) {
    const exact::GasState& s = x < t.problem.interface_position ? l : q;
    return TubeState{0, s.density, s.velocity, energy(m.eos, s.density, s.pressure)};
  });
  set_velocity(b, [&](const std::array<double, 2>& x, std::array<double, 2>& u) {
    const double off = x[0] - t.problem.interface_position;
    u[0] = std::abs(off) < 1e-9 ? 0.5 * (l.velocity + q.velocity) : off < 0 ? l.velocity : q.velocity;
  });
  const bool parting = l.velocity != q.velocity;
  const BoundaryKind open = parting && motion == MotionPolicy::eulerian ? BoundaryKind::outflow : BoundaryKind::wall;
  b.boundary.side[0] = {{{open, l.velocity}, {open, q.velocity}}};
  Scene<2> scene;
  scene.blocks.push_back(std::move(b));
  return scene;
}

void tube_case(VerifyReport& r, const TubeOnSlant& t) {
  const exact::Riemann exact(t.problem.left, t.problem.right);
  const bool shock = t.problem.left.velocity == t.problem.right.velocity;
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    const std::string name = short_name(motion);
    TubeRun<2> run;
    if (!ends(r, name, slanted_tube(t, motion), t.problem.time, run)) {
      continue;
    }
    const Block<2>& b = run.scene.blocks[0];
    if (shock) {
      const double at = t.problem.interface_position + exact.waves().right_head * t.problem.time;
      const Front f = front_of(b, 0.5 * (t.problem.right.density + exact.star_density_right()), true);
      r.close(name + ", shock position", at, 0.01, f.mean);
      r.note(name + ", shock position, spread by row", f.spread);
    }
    TubeError error;
    for (int j = 0; j < t.across; ++j) {
      const TubeError e = error_against(row_profile(b, j), exact, t.problem.interface_position, t.problem.time);
      error.density += e.density / (t.across * t.length);
      error.pressure += e.pressure / (t.across * t.length);
    }
    r.note(name + ", L1(rho)", error.density);
    r.note(name + ", L1(p)", error.pressure);
    untouched(r, name, run);
    conserves(r, name, run);
    r.note(name + ", steps", static_cast<double>(run.clock.step));
  }
  r.set_cells(static_cast<long>(t.cells) * t.across);
}

} // namespace

void add_slanted_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"saltzman", "Saltzman's piston on his skewed mesh, 100 x 10", saltzman});
  cases.push_back({"leblanc_2d", "LeBlanc's tube on slanted cells, 1800 x 3",
                   [](VerifyReport& r) { tube_case(r, {named("riemann_leblanc_standard"), 9, 1800, 3, 3}); }});
  cases.push_back({"einfeldt_123_2d", "123 double rarefaction on slanted cells, 200 x 10",
                   [](VerifyReport& r) { tube_case(r, {named("riemann_123_einfeldt"), 1, 200, 10, 2}); }});
}

} // namespace ballast::verify
