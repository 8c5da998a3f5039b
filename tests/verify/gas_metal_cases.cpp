// Gas beside metal at speed: a copper block flies through air at 500 m/s. It is a piston to the air on both
// sides: a shock ahead, a centred rarefaction behind, both exact.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include "materials/library.hpp"
#include "problems/build_scene.hpp"
#include "problems/run_measure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

constexpr double speed = 500, atmosphere = 101325, length = 1, rear = 0.4, front = 0.5, end_time = 4e-4;

/// Gas of ratio g, density rho, pressure p at rest beside a piston that moves into it (u > 0) or away (u < 0).
struct PistonGas {
  double pressure, density;
  double wave; ///< m/s, of the shock, or of the rarefaction's tail (behind the piston: positive is with it)
};

/// Landau and Lifshitz, Fluid Mechanics, section 99: the shock; the centred rarefaction.
PistonGas pushed(double g, double rho, double p, double u) {
  const double c = std::sqrt(g * p / rho), h = 0.25 * (g + 1) * u, s = h + std::sqrt(h * h + c * c);
  return {p + rho * s * u, rho * s / (s - u), s};
}
PistonGas drawn(double g, double rho, double p, double u) {
  const double c = std::sqrt(g * p / rho), b = 1 - 0.5 * (g - 1) * u / c;
  return {p * std::pow(b, 2 * g / (g - 1)), rho * std::pow(b, 2 / (g - 1)), u - c * b};
}

SceneSpec block_in_air(int cells, Closure closure, MotionPolicy motion, bool strength) {
  SceneSpec s;
  Material copper = *find_material("copper_ofhc"), air = *find_material("air");
  copper.specific_energy = energy(copper.eos, copper.density, atmosphere);
  air.specific_energy = energy(air.eos, air.density, atmosphere);
  if (!strength) {
    copper.strength = NoStrength{};
  }
  s.ambient_pressure = atmosphere;
  s.end_time = end_time;
  s.materials = {copper, air};
  s.background = 1;
  s.motion = {motion, 1};
  s.numerics.closure = closure;
  s.numerics.spall = false;
  s.energy_return = Switch::on;
  const double h = length / cells;
  for (int i = 0; i <= cells; ++i) {
    s.mesh_lines[0].push_back(i * h);
  }
  s.mesh_lines[1] = {0, h};
  s.bodies.push_back({"block", 0, Shape{Box{{rear, -1, -1}, {front, 1, 1}}}, {speed, 0, 0}, copper.density, atmosphere, copper.specific_energy});
  for (auto& side : s.boundaries) {
    side[0].kind = side[1].kind = BoundaryKind::symmetry;
  }
  return s;
}

/// Mean velocity of the copper by mass.
double copper_velocity(const Block<2>& b) { return measure_body(b, {0}, 0, 1.0).velocity; }

/// Least and largest specific energy of the air anywhere, in units of the air's own at rest.
struct Extremes {
  double least = 1e300, largest = -1e300;
};
Extremes air_energy(const Block<2>& b) {
  Extremes e;
  const MaterialSlot& air = b.materials[1];
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    if (air.store.row(field::mass, r)[i] > 0) {
      const double q = air.store.row(field::energy, r)[i] / air.material.specific_energy;
      e = {std::min(e.least, q), std::max(e.largest, q)};
    }
  });
  return e;
}

void fly(VerifyReport& r, const std::string& name, const SceneSpec& s, bool gated) {
  const Material& air = s.materials[1];
  const double g = std::get<IdealGas>(air.eos).gamma;
  const PistonGas ahead = pushed(g, air.density, atmosphere, speed), behind = drawn(g, air.density, atmosphere, speed);
  TubeRun<2> run = run_scene(build_scene<2>(s, 1), end_time);
  const auto cells = profile(run, 0);
  const auto pressure = [](const TubeCell& c) { return c.pressure; };
  const auto check = [&](const std::string& what, double want, double relative, double got) {
    gated ? r.close(name + ", " + what, want, relative, got) : r.note(name + ", " + what + " / exact", got / want);
  };
  const auto plateau = [&](const CellValue& v, double a, double b) { return mean_between(cells, v, a + 0.3 * (b - a), b - 0.3 * (b - a)); };
  const double nose = front + speed * end_time, tail = rear + speed * end_time;
  const double shock = front + ahead.wave * end_time, fan = rear + behind.wave * end_time;
  check("pressure ahead", ahead.pressure, 0.02, plateau(pressure, nose, shock));
  check("density ahead", ahead.density, 0.02, plateau([](const TubeCell& c) { return c.density; }, nose, shock));
  check("shock speed", ahead.wave, 0.01,
        (rightmost_crossing(cells, pressure, 0.5 * (atmosphere + ahead.pressure)) - front) / end_time);
  check("pressure behind", behind.pressure, 0.03, plateau(pressure, fan, tail));
  // The air's push alone slows the block: (p_ahead - p_behind) t / (rho L).
  const double slowed = (ahead.pressure - behind.pressure) * end_time / (s.materials[0].density * (front - rear));
  check("copper's velocity", speed - slowed, 1e-4, copper_velocity(run.scene.blocks[0]));
  const Extremes e = air_energy(run.scene.blocks[0]);
  r.note(name + ", least air energy / at rest", e.least);
  r.note(name + ", largest air energy / at rest", e.largest);
  r.note(name + ", energy floors", static_cast<double>(run.scene.ledger.energy_floors));
  r.note(name + ", slivers", static_cast<double>(run.scene.ledger.slivers));
  r.note(name + ", steps", static_cast<double>(run.clock.step));
  conserves(r, name, run);
}

void copper_in_air(VerifyReport& r) {
  const int n = 400;
  fly(r, "Lag", block_in_air(n, Closure::pressure_relaxation, MotionPolicy::lagrangian, true), true);
  fly(r, "Eul", block_in_air(n, Closure::pressure_relaxation, MotionPolicy::eulerian, true), true);
  fly(r, "Eul tipton", block_in_air(n, Closure::tipton, MotionPolicy::eulerian, true), false);
  fly(r, "Eul equal strain", block_in_air(n, Closure::equal_strain, MotionPolicy::eulerian, true), false);
  r.set_cells(n);
}

} // namespace

void add_gas_metal_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"copper_in_air", "copper at 500 m/s through air is a piston: shock ahead, rarefaction behind", copper_in_air});
}

} // namespace ballast::verify
