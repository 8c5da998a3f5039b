// Gas that expands into next to nothing: a gas of a millionth of its density, a void. As a tube against the exact solution, and
// as a round cloud in a quarter of the plane.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

const exact::GasState dense{1, 0, 1, 1.4, 0};

/// The time comes when the exact shock has run half the tube. Where the shock is, is reported: no mesh here holds the fan's thin
/// head. A Lagrangian cell of the dense gas has more mass than all of it (shock late); in an eulerian mesh what upwinding mixes into
/// it is too hot by the square of the speeds mixed (shock early); a second gas is heated in its mixed cells besides. The order of the
/// density's error, of a flow with kinks and a fan, is one.
void expansion(VerifyReport& r, const std::string& what, const exact::GasState& thin) {
  constexpr double x0 = 0.3, travel = 0.5;
  const exact::Riemann exact(dense, thin);
  const double time = travel / exact.waves().right_head;
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    double error[2] = {};
    for (const int level : {0, 1}) {
      const int n = 100 << (2 * level);
      Tube tube = riemann_tube(dense, thin, x0, time, n);
      tube.motion = motion;
      tube.ends = {{{BoundaryKind::wall, 0}, {BoundaryKind::wall, 0}}};
      const TubeRun<2> run = run_tube<2>(tube);
      const std::string name = fmt::format("{}{}, N {}", short_name(motion), what, n);
      const auto cells = profile(run, 0);
      r.close(name + ", end time", time, 1e-12, run.clock.time);
      const auto pressure = [](const TubeCell& c) { return c.pressure; };
      r.note(name + ", shock position (exact 0.8)", rightmost_crossing(cells, pressure, 0.5 * (thin.pressure + exact.star_pressure())));
      error[level] = error_against(cells, exact, x0, time).density;
      r.note(name + ", L1(rho)", error[level]);
      conserves(r, name, run);
      r.note(name + ", steps", static_cast<double>(run.clock.step));
    }
    r.at_least(short_name(motion) + what + ", order of L1(rho)", 0.8, 0.5 * std::log2(error[0] / error[1]));
  }
}

/// Lines of a tube of length one whose cells have as much mass beside x0 as beyond it: there they are equal, on the dense side they
/// grow away from x0 by `ratio` up to the same width.
std::vector<double> lines_of_equal_mass(double x0, int beyond, double thin, double ratio) {
  const double width = (1 - x0) / beyond;
  std::vector<double> lines;
  double x = x0;
  for (double h = width * thin; x > 0.5 * h; h = std::min(ratio * h, width)) {
    lines.insert(lines.begin(), x);
    x -= h;
  }
  lines.insert(lines.begin(), 0.0);
  for (int i = 1; i <= beyond; ++i) {
    lines.push_back(i == beyond ? 1 : x0 + i * width);
  }
  return lines;
}

/// Where the mesh resolves the fan's thin head, the shock is where it should be.
void expansion_of_equal_mass(VerifyReport& r, const std::string& what, const exact::GasState& thin) {
  constexpr double x0 = 0.3, travel = 0.5;
  const exact::Riemann exact(dense, thin);
  const double time = travel / exact.waves().right_head;
  Tube tube = riemann_tube(dense, thin, x0, time, 100);
  tube.lines = lines_of_equal_mass(x0, 100, thin.density, 1.1);
  tube.ends = {{{BoundaryKind::wall, 0}, {BoundaryKind::wall, 0}}};
  const TubeRun<2> run = run_tube<2>(tube);
  const std::string name = fmt::format("Lag{}, cells of equal mass at the interface", what);
  const auto cells = profile(run, 0);
  r.close(name + ", end time", time, 1e-12, run.clock.time);
  const auto pressure = [](const TubeCell& c) { return c.pressure; };
  r.close(name + ", shock position", x0 + travel, 0.01, rightmost_crossing(cells, pressure, 0.5 * (thin.pressure + exact.star_pressure())));
  r.note(name + ", L1(rho)", error_against(cells, exact, x0, time).density);
  conserves(r, name, run);
  r.note(name + ", cells", static_cast<double>(cells.size()));
  r.note(name + ", steps", static_cast<double>(run.clock.step));
}

void near_vacuum_tube(VerifyReport& r) {
  const exact::GasState same{1e-6, 0, 1e-6, 1.4, 0}, other{1e-6, 0, 1e-6, 5.0 / 3, 0};
  expansion(r, ", same gas", same);
  expansion(r, ", another gas", other);
  expansion_of_equal_mass(r, ", same gas", same);
  expansion_of_equal_mass(r, ", another gas", other);
  r.set_cells(400);
}

Material ideal(const char* name, double gamma, double density) {
  Material m;
  m.name = name;
  m.eos = IdealGas{gamma};
  m.density = density;
  return m;
}

/// Share of the square cell at (x, y) within the cloud, from 16 x 16 points.
double within(double x, double y, double h, double radius) {
  int hits = 0;
  for (int q = 0; q < 256; ++q) {
    hits += std::hypot(x + (q % 16 + 0.5) * h / 16, y + (q / 16 + 0.5) * h / 16) < radius;
  }
  return hits / 256.0;
}

/// A cloud of radius 0.3 in thin gas of another gamma (thin > 0) or in a void.
Scene<2> cloud(int n, MotionPolicy motion, double thin) {
  constexpr double radius = 0.3;
  Block<2> b;
  b.motion = {motion, 1};
  const Material gas = ideal("gas", 1.4, 1), rest = ideal("thin", 5.0 / 3, 1e-6);
  b.materials.push_back(make_slot(gas, 0));
  if (thin > 0) {
    b.materials.push_back(make_slot(rest, 0));
  } else {
    b.materials.push_back(make_void());
  }
  std::array<std::vector<double>, 3> lines;
  for (int i = 0; i <= n; ++i) {
    lines[0].push_back(static_cast<double>(i) / n);
  }
  lines[1] = lines[0];
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    const double h = 1.0 / n, f = within(i * h, j * h, h, radius);
    fill_cell<2>(b, i, j, k, std::vector<CellPart>{{0, f, 1, energy(gas.eos, 1, 1)}, {1, 1 - f, thin, thin > 0 ? energy(rest.eos, thin, thin) : 0}});
  });
  for (std::size_t d = 0; d < 2; ++d) {
    b.boundary.side[d][1] = {BoundaryKind::wall, 0};
  }
  Scene<2> scene;
  scene.blocks.push_back(std::move(b));
  return scene;
}

/// Its edge runs at nearly 2c/(gamma - 1) = 5.9: 0.1 brings it to 0.9.
void near_vacuum_cloud(VerifyReport& r) {
  constexpr int n = 100;
  for (const double thin : {1e-6, 0.0}) {
    for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
      if (!(thin > 0) && motion == MotionPolicy::lagrangian) {
        continue; // void has no mass to move a mesh by
      }
      const std::string name = fmt::format("{} {}", short_name(motion), thin > 0 ? "thin gas" : "void");
      TubeRun<2> run;
      if (motion == MotionPolicy::lagrangian) { // square cells around a round front tangle in the end
        try_scene(cloud(n, motion, thin), 0.1, run);
        r.note(name + ", end time (asked 0.1)", run.clock.time);
        continue;
      }
      if (!ends(r, name, cloud(n, motion, thin), 0.1, run)) {
        continue;
      }
      if (thin > 0) {
        conserves(r, name, run);
      } else { // the momentum and kinetic energy of dropped slivers are no entries of the ledger
        const Conservation c = conservation(run);
        r.at_most(name + ", conservation of mass", 1e-12, c.mass);
        r.note(name + ", energy unaccounted", c.energy);
        r.note(name + ", momentum unaccounted", c.momentum);
      }
      r.note(name + ", energy floors", static_cast<double>(run.scene.ledger.energy_floors));
      r.note(name + ", retries", static_cast<double>(run.scene.ledger.retries));
      r.note(name + ", steps", static_cast<double>(run.clock.step));
    }
  }
  r.set_cells(n * n);
}

} // namespace

void add_vacuum_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"near_vacuum_tube", "gas expands into gas of a millionth of its density", near_vacuum_tube});
  cases.push_back({"near_vacuum_cloud", "a round cloud of gas expands into thin gas and into void, 100 x 100 cells", near_vacuum_cloud});
}

} // namespace ballast::verify
