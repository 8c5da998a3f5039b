// Bodies that must not move under ambient pressure, and RZ meshes that must fall evenly.
#include "tests/observers.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

constexpr double atmosphere = 101325;

Material at_rest(const std::string& name, const Eos& eos, double density, const Strength& strength = NoStrength{}) {
  Material m;
  m.name = name;
  m.eos = eos;
  m.strength = strength;
  m.density = density;
  m.specific_energy = energy(eos, density, atmosphere);
  return m;
}

Material body_of(bool solid) {
  return solid ? at_rest("copper", MieGruneisen{8930, 3940, 1.489, 2.02}, 8930, LinearHardening{47.7e9, 120e6, 0})
               : at_rest("water", MieGruneisen{998, 1480, 1.92, 0.28}, 998);
}

/// Fraction of a cell inside the ball of radius 0.35 about (0.45, 0.52, 0.4), by 8 points an axis.
template <int Dim> double inside(const std::array<int, 3>& cell, int n) {
  const double centre[3] = {0.45, 0.52, 0.4};
  const int points = 8;
  int hits = 0, total = 0;
  for (int c = 0; c < points * points * (Dim == 3 ? points : 1); ++c) {
    const int at[3] = {c % points, c / points % points, c / points / points};
    double r2 = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double x = (cell[d] + (at[d] + 0.5) / points) / n - centre[d];
      r2 += x * x;
    }
    hits += r2 < 0.35 * 0.35;
    ++total;
  }
  return static_cast<double>(hits) / total;
}

template <int Dim> Scene<Dim> ball_in_air(int n, bool axisymmetric, bool solid, MotionPolicy motion) {
  Scene<Dim> scene;
  Block<Dim> b;
  b.axisymmetric = axisymmetric;
  b.motion = {motion, 1};
  b.reference_pressure = atmosphere;
  const Material body = body_of(solid), air = at_rest("air", IdealGas{1.4}, 1.2);
  b.materials.push_back(make_slot(body, atmosphere));
  b.materials.push_back(make_slot(air, atmosphere));
  std::array<std::vector<double>, 3> lines;
  for (std::size_t d = 0; d < Dim; ++d) {
    for (int i = 0; i <= n; ++i) {
      lines[d].push_back(0.01 * i / n);
    }
  }
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    const double f = inside<Dim>({i, j, k}, n);
    fill_cell<Dim>(b, i, j, k, std::vector<CellPart>{{0, f, body.density, body.specific_energy},
                               {1, 1 - f, air.density, air.specific_energy}});
  });
  scene.blocks.push_back(std::move(b));
  return scene;
}

template <int Dim> double fastest(const Block<Dim>& b) {
  double most = 0;
  for (const RowField& u : b.velocity) {
    for (const double v : u.data()) {
      most = std::isnan(v) ? v : std::max(most, std::abs(v));
    }
  }
  return most;
}

template <int Dim> void stays(VerifyReport& r, int n, bool axisymmetric, bool solid) {
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    StepLimit<Dim> limit(1000);
    const TubeRun<Dim> run = run_scene<Dim>(ball_in_air<Dim>(n, axisymmetric, solid, motion), 1e30, {&limit});
    const std::string name = fmt::format("{} {} {}", solid ? "copper" : "water",
                                         axisymmetric ? "RZ" : Dim == 2 ? "2D" : "3D", short_name(motion));
    r.at_most(name + ", largest velocity", 0, fastest(run.scene.blocks[0]));
    r.at_least(name + ", steps", 1000, static_cast<double>(run.clock.step));
    conserves(r, name, run);
  }
  r.set_cells(n * n);
}

void at_rest_case(VerifyReport& r) {
  for (const bool solid : {false, true}) {
    stays<2>(r, 16, false, solid);
    stays<2>(r, 16, true, solid);
    stays<3>(r, 8, false, solid);
  }
}

/// Gas with p = 2 - z on a mesh graded along both axes: du_z/dt = 1/rho at every node off the ends.
void even_fall(VerifyReport& r) {
  Scene<2> scene;
  Block<2> b;
  b.axisymmetric = true;
  b.motion.policy = MotionPolicy::lagrangian;
  Material m;
  m.name = "gas";
  m.density = 1;
  b.materials.push_back(make_slot(m, 0));
  std::array<std::vector<double>, 3> lines;
  for (int i = 0; i <= 20; ++i) {
    lines[0].push_back(0.05 * i * (1 + 0.05 * i));
    lines[1].push_back(0.05 * i * (1 - 0.02 * i));
  }
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) {
    const double z = 0.5 * (lines[1][static_cast<std::size_t>(j)] + lines[1][static_cast<std::size_t>(j) + 1]);
    fill_cell<2>(b, i, j, k, std::vector<CellPart>{{0, 1, 1, energy(m.eos, 1, 2 - z)}});
  });
  scene.blocks.push_back(std::move(b));
  StepLimit<2> limit(1);
  const TubeRun<2> run = run_scene<2>(std::move(scene), 1e30, {&limit});
  const Block<2>& done = run.scene.blocks[0];
  double uneven = 0, radial = 0;
  for (int j = 1; j < 20; ++j) {
    const int row = done.grid.node_row(j, 0);
    for (int i = 0; i <= 20; ++i) {
      uneven = std::max(uneven, std::abs(done.velocity[1].row(row)[i] / run.clock.time - 1));
      radial = std::max(radial, std::abs(done.velocity[0].row(row)[i] / run.clock.time));
    }
  }
  r.at_most("axial acceleration, worst node", 1e-12, uneven);
  r.note("radial acceleration, worst node", radial);
  conserves(r, "one step", run);
  r.set_cells(400);
}

} // namespace

void add_rest_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"at_rest", "a ball in air under 1 atm does not move in 1000 steps", at_rest_case});
  cases.push_back({"even_fall", "uniform axial acceleration in RZ is the same at every radius", even_fall});
}

} // namespace ballast::verify
