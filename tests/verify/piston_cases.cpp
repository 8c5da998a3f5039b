// Elastic wave and elastic-plastic pistons in uniaxial strain.
//
// Lag: the left wall moves into material at rest. Eul: the same in the piston's frame, the wall at rest
// and material flowing in from the right.
#include "tests/exact/elastic_plastic_piston.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

double axial(const TubeCell& c) { return c.pressure - c.stress; }

Tube piston_tube(const exact::ElasticPlasticPiston::Material& m, double speed, int cells, MotionPolicy motion) {
  Material solid;
  solid.name = "solid";
  solid.eos = MieGruneisen{m.hugoniot.density, m.hugoniot.sound_speed, m.hugoniot.slope, m.hugoniot.gruneisen, true};
  solid.strength = LinearHardening{m.shear_modulus, m.yield_stress, 0};
  solid.density = m.hugoniot.density;
  Tube t;
  t.cells = cells;
  t.motion = motion;
  t.materials = {solid, solid};
  const bool moving = motion == MotionPolicy::lagrangian;
  t.left = t.right = {0, solid.density, moving ? 0 : -speed, 0};
  t.ends = {{{BoundaryKind::wall, moving ? speed : 0},
             {moving ? BoundaryKind::wall : BoundaryKind::inflow, moving ? 0 : -speed}}};
  t.numerics.energy_return = true; // the gate of total energy to round-off asks for it
  return t;
}

/// A 1 m/s piston on copper that does not yield: the wave runs with sqrt((K + 4G/3)/rho).
void elastic_wave(VerifyReport& r) {
  const exact::ElasticPlasticPiston::Material copper{{8930, 3940, 1.489, 2.02}, 47.7e9, 1e30};
  const double u = 0.1, c = std::sqrt((8930 * 3940. * 3940 + 4 * 47.7e9 / 3) / 8930);
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    Tube tube = piston_tube(copper, u, 200, motion);
    tube.end_time = 0.9 / c;
    const double stress = 8930 * c * u;
    const double frame = motion == MotionPolicy::lagrangian ? 0 : -u;
    Arrival arrival(axial, 0.5 * stress, 0.8);
    const TubeRun<2> run = run_watched(tube, {&arrival});
    const auto cells = profile(run, 0);
    const std::string name = short_name(motion);
    r.close(name + ", wave speed", c + frame, 0.01, 0.8 / arrival.time());
    r.close(name + ", stress", stress, 0.02, mean_between(cells, axial, 0.2, 0.7));
    conserves(r, name, run);
  }
  r.set_cells(200);
}

struct Piston {
  exact::ElasticPlasticPiston::Material material;
  double speed;
  int cells;
};

/// Axial stress, velocity and density against a state, averaged over [from, to].
void plateau(VerifyReport& r, const std::string& name, const std::vector<TubeCell>& cells,
             const exact::ElasticPlasticState& want, double frame, double from, double to) {
  r.close(name + " stress", want.axial_stress(), 0.02, mean_between(cells, axial, from, to));
  const auto velocity = [&](const TubeCell& c) { return c.velocity - frame; };
  r.close(name + " velocity", want.velocity, 0.02, mean_between(cells, velocity, from, to));
  r.close(name + " density", want.density, 0.02,
          mean_between(cells, [](const TubeCell& c) { return c.density; }, from, to));
}

void piston(VerifyReport& r, const Piston& p) {
  const exact::ElasticPlasticPiston exact(p.material, p.speed);
  const double elastic = exact.yield_state().axial_stress(), full = exact.piston_state().axial_stress();
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    Tube tube = piston_tube(p.material, p.speed, p.cells, motion);
    const double frame = motion == MotionPolicy::lagrangian ? 0 : -p.speed;
    tube.end_time = 0.9 / (exact.elastic_speed() + frame);
    const double first = 0.8 * tube.end_time * (exact.elastic_speed() + frame);
    const double second = 0.8 * tube.end_time * (exact.plastic_speed() + frame);
    Arrival precursor(axial, 0.5 * elastic, first), plastic(axial, 0.5 * (elastic + full), second);
    const TubeRun<2> run = run_watched(tube, {&precursor, &plastic});
    const auto cells = profile(run, 0);
    const std::string name = short_name(motion);
    r.close(name + ", elastic speed", exact.elastic_speed(), 0.01, first / precursor.time() - frame);
    r.close(name + ", plastic speed", exact.plastic_speed(), 0.01, second / plastic.time() - frame);
    const double wall = (p.speed + frame) * tube.end_time;
    const double shock = (exact.plastic_speed() + frame) * tube.end_time;
    const double front = (exact.elastic_speed() + frame) * tube.end_time;
    const auto middle = [](double a, double b, double s) { return a + s * (b - a); };
    plateau(r, name + ", precursor", cells, exact.yield_state(), frame, middle(shock, front, 0.35),
            middle(shock, front, 0.65));
    plateau(r, name + ", plastic", cells, exact.piston_state(), frame, middle(wall, shock, 0.25),
            middle(wall, shock, 0.75));
    conserves(r, name, run);
  }
  r.set_cells(p.cells);
}

} // namespace

void add_piston_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"elastic_wave", "speed sqrt((K + 4G/3)/rho) of a small elastic wave", elastic_wave});
  const auto add = [&](const char* name, const char* law, const Piston& p) {
    cases.push_back({name, law, [p](VerifyReport& r) { piston(r, p); }});
  };
  add("piston_copper_20", "elastic-plastic piston, copper (Udaykumar) at 20 m/s",
      {{{8930, 3940, 1.49, 2}, 45e9, 90e6}, 20, 400});
  add("piston_copper_185", "elastic-plastic piston, copper at 185 m/s",
      {{{8930, 3940, 1.489, 2.02}, 47.7e9, 120e6}, 185, 400});
  add("piston_aluminium", "elastic-plastic piston, aluminium at 100 m/s",
      {{{2790, 5330, 1.34, 2}, 28.6e9, 260e6}, 100, 400});
  add("piston_lead", "elastic-plastic piston, lead at 50 m/s", {{{11350, 2051, 1.46, 2.77}, 8.6e9, 8e6}, 50, 800});
}

} // namespace ballast::verify
