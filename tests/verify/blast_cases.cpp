// Noh's planar implosion and Sedov's blast on a Cartesian mesh.
#include "tests/exact/noh.hpp"
#include "tests/exact/sedov.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"
#include "tests/verify/radial.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

/// Gas falls on a wall at x = 0. Lag: the far end is a wall that falls along; Eul: it is an inflow of the
/// initial state at x = 1, which the shock (at 0.2) never meets.
void noh(VerifyReport& r) {
  const exact::Noh problem;
  const int n = 100;
  const double t = 0.6;
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    Tube tube = riemann_tube({1, -1, 0, problem.gamma}, {1, -1, 0, problem.gamma}, 0.5, t, n);
    tube.motion = motion;
    tube.ends = {{{BoundaryKind::wall, 0},
                  {motion == MotionPolicy::lagrangian ? BoundaryKind::wall : BoundaryKind::inflow, -1}}};
    const TubeRun<2> run = run_tube<2>(tube);
    const auto cells = profile(run, 0);
    const auto density = [](const TubeCell& c) { return c.density; };
    const double shock = exact::shock_speed(problem) * t;
    const double plateau = exact::state_at(problem, 0.5 * shock, t).density;
    const std::string name = short_name(motion);
    r.close(name + ", shock position", shock, 0.02, rightmost_crossing(cells, density, 0.5 * (1 + plateau)));
    r.close(name + ", plateau density", plateau, 0.02, mean_between(cells, density, 0.3 * shock, 0.8 * shock));
    r.note(name + ", density at the wall", cells.front().density);
    conserves(r, name, run);
    r.note(name + ", energy floors", static_cast<double>(run.scene.ledger.energy_floors));
  }
  r.set_cells(n);
}

/// The exact solution has a cold gas ahead. Here it holds 1e-8 of the energy behind the shock, so that
/// round-off of the work cannot make it negative (no step has a floor).
constexpr double ambient_energy = 1e-9;

template <int Dim> Scene<Dim> blast(int n, double box, double corner_energy, MotionPolicy motion) {
  Scene<Dim> scene;
  Block<Dim> b;
  b.motion = {motion, 1};
  Material m;
  m.name = "gas";
  m.eos = IdealGas{1.4};
  m.density = 1;
  b.materials.push_back(make_slot(m, 0));
  std::array<std::vector<double>, 3> lines;
  for (std::size_t d = 0; d < Dim; ++d) {
    for (int i = 0; i <= n; ++i) {
      lines[d].push_back(box * i / n);
    }
  }
  allocate_block(b, lines);
  const double cell = std::pow(box / n, Dim);
  for_each_cell(b, [&](int i, int j, int k) {
    const double e = i + j + k == 0 ? corner_energy / cell : ambient_energy;
    fill_cell<Dim>(b, i, j, k, std::vector<CellPart>{{0, 1, 1, e}});
  });
  scene.blocks.push_back(std::move(b));
  return scene;
}

template <int Dim> double peak_density(const Block<Dim>& b) {
  double peak = 0;
  for_each_cell(b, [&](int i, int j, int k) { peak = std::max(peak, b.density.row(b.grid.cell_row(j, k))[i]); });
  return peak;
}

/// The shock stands where the density, on its way out, passes half way from the measured peak to 1.
template <int Dim> void sedov(VerifyReport& r, int n, double box) {
  constexpr auto geometry = Dim == 2 ? exact::Geometry::cylindrical : exact::Geometry::spherical;
  const double energy = exact::Sedov(geometry, 1.4, 1, 1).energy_constant(); // R = 1 at t = 1
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    const TubeRun<Dim> run = run_scene(blast<Dim>(n, box, energy / (1 << Dim), motion), 1.0);
    const Block<Dim>& b = run.scene.blocks[0];
    const auto shells = radial_density(b, 0.5 * box / n);
    const auto density = [](const TubeCell& c) { return c.density; };
    double top = 1;
    for (const TubeCell& c : shells) {
      top = std::max(top, c.density);
    }
    const std::string name = short_name(motion);
    r.close(name + ", shock radius", 1, 0.01, rightmost_crossing(shells, density, 0.5 * (1 + top)));
    const double peak = peak_density(b);
    if (Dim == 3) {
      r.at_least(name + ", peak density", motion == MotionPolicy::lagrangian ? 4.2 : 3.0, peak);
    } else {
      r.note(name + ", peak density", peak);
    }
    r.note(name + ", steps", static_cast<double>(run.clock.step));
    conserves(r, name, run);
  }
  r.set_cells(std::lround(std::pow(n, Dim)));
}

} // namespace

void add_blast_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"noh", "Noh's planar implosion on a wall", noh});
  cases.push_back({"sedov_2d", "cylindrical blast in a quarter of 100 x 100 cells",
                   [](VerifyReport& r) { sedov<2>(r, 100, 1.2); }});
  cases.push_back({"sedov_3d", "spherical blast in an octant of 45^3 cells",
                   [](VerifyReport& r) { sedov<3>(r, 45, 1.2); }});
}

} // namespace ballast::verify
