// Plates of OFHC copper after Johnson and Cook: the plastic wave of a symmetric impact.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <cmath>

namespace ballast::verify {

namespace {

double axial(const TubeCell& c) { return c.pressure - c.stress; }
double density(const TubeCell& c) { return c.density; }
double velocity(const TubeCell& c) { return c.velocity; }

// Each half meets a wall at `impact_speed`.
constexpr double impact_speed = 300, impact_length = 20e-3;
constexpr int impact_cells = 400;

Tube impact_tube(MotionPolicy motion, double end_time, bool energy_return) {
  Tube t;
  const Material copper = copper_at_zero();
  t.cells = impact_cells;
  t.length = impact_length;
  t.motion = motion;
  t.materials = {copper, copper};
  t.left = t.right = {0, copper.density, -impact_speed, copper.specific_energy};
  t.interface = 0.5 * impact_length;
  t.ends = {{{BoundaryKind::wall, 0},
             {motion == MotionPolicy::lagrangian ? BoundaryKind::wall : BoundaryKind::inflow, -impact_speed}}};
  t.end_time = end_time;
  t.numerics.energy_return = energy_return;
  return t;
}

/// State before or behind the plastic wave, velocities from the copper ahead of all waves.
struct WaveState {
  double stress, velocity, density;
};

struct Impact {
  WaveState ahead, behind;        ///< of the plastic wave
  double deviator, law_deviator;  ///< axial, behind; measured and from the law (Pa)
  double strain, law_strain;      ///< plastic, behind
  double speed;                   ///< of the plastic wave relative to the copper ahead of all waves, m/s
  TubeRun<2> run;
};

WaveState mean_state(const std::vector<TubeCell>& cells, double from, double to) {
  return {mean_between(cells, axial, from, to), mean_between(cells, velocity, from, to) + impact_speed,
          mean_between(cells, density, from, to)};
}

/// Mean by width of a field of the copper over cells with centres in [from, to].
double mean_field(const TubeRun<2>& run, int number, double from, double to) {
  const Block<2>& b = run.scene.blocks[0];
  const double* f = b.materials[0].store.row(number, b.grid.cell_row(0, 0));
  const auto cells = profile(run, 0);
  double sum = 0, width = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].centre >= from && cells[i].centre <= to) {
      sum += f[i] * cells[i].width;
      width += cells[i].width;
    }
  }
  return sum / width;
}

/// Copper behind the wave is at rest: its rate of flow has fallen to that of stress relaxation,
/// d sigma = C sigma_0 d(ln rate) = -3 G rate dt, so rate = C sigma_0 / (3 G t) a time t after the wave.
void expect_plateau(Impact& im, double age, double from, double to) {
  const Material& m = im.run.scene.blocks[0].materials[0].material;
  const auto& law = std::get<JohnsonCook>(m.strength);
  im.deviator = mean_between(profile(im.run, 0), [](const TubeCell& c) { return c.stress; }, from, to);
  im.strain = mean_field(im.run, field::plastic_strain<2>, from, to);
  // Uniaxial strain: deviator of the strain 2/3 ln(rho0/rho) = plastic part + s / 2G.
  im.law_strain = 2.0 / 3 * std::log(im.behind.density / m.density) + im.deviator / (2 * law.shear_modulus);
  const double heat = mean_field(im.run, field::energy, from, to) - m.specific_energy;
  const double homologous = heat / (law.specific_heat * (law.melt_temperature - law.reference_temperature));
  const double flow = (law.A + law.B * std::pow(im.law_strain, law.n)) * (1 - std::pow(homologous, law.m));
  const double rate = law.C * flow / (3 * law.shear_modulus * age);
  im.law_deviator = -2.0 / 3 * flow * (1 + law.C * std::log(rate / law.reference_rate));
}

Impact impact(MotionPolicy motion, bool energy_return) {
  const Material copper = copper_at_zero();
  const auto& eos = std::get<MieGruneisen>(copper.eos);
  const double g = shear_modulus(copper.strength);
  // Where to look: the fluid's shock and the small elastic wave, both in the wall's frame.
  const double shock = eos.c0 + eos.s * impact_speed - impact_speed;
  const double elastic = std::sqrt(eos.c0 * eos.c0 + 4 * g / (3 * copper.density)) - impact_speed;
  const double end = 0.9 * impact_length / elastic;
  const double full = copper.density * (shock + impact_speed) * impact_speed;
  Arrival first(axial, 0.5 * full, 0.4 * shock * end), second(axial, 0.5 * full, 0.8 * shock * end);
  TubeRun<2> run = run_watched(impact_tube(motion, end, energy_return), {&first, &second});
  const auto cells = profile(run, 0);
  const double at = rightmost_crossing(cells, axial, 0.5 * full), front = elastic * end;
  Impact im{mean_state(cells, at + 0.35 * (front - at), at + 0.65 * (front - at)), mean_state(cells, 0.25 * at, 0.75 * at),
            0, 0, 0, 0, 0.4 * shock * end / (second.time() - first.time()) + impact_speed, std::move(run)};
  expect_plateau(im, 0.5 * end, 0.25 * at, 0.75 * at);
  return im;
}

/// Lagrangian against Eulerian, and each against the jump laws across its own plastic wave.
void johnson_cook_impact(VerifyReport& r) {
  Impact reference{};
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    const std::string name = short_name(motion);
    Impact im = impact(motion, true);
    if (motion == MotionPolicy::eulerian) {
      const auto same = [&](const char* what, double want, double got) { r.close(name + " as Lag, " + what, want, 0.02, got); };
      same("plateau pressure", reference.behind.stress + reference.deviator, im.behind.stress + im.deviator);
      same("plateau deviator", reference.deviator, im.deviator);
      same("plateau velocity", reference.behind.velocity, im.behind.velocity);
      same("plateau plastic strain", reference.strain, im.strain);
      same("plastic wave speed", reference.speed, im.speed);
      same("precursor stress", reference.ahead.stress, im.ahead.stress);
    } else {
      r.note(name + ", plateau pressure", im.behind.stress + im.deviator);
      r.note(name + ", precursor stress", im.ahead.stress);
      r.note(name + ", plastic wave speed", im.speed);
    }
    r.close(name + ", plateau velocity", impact_speed, 0.01, im.behind.velocity);
    r.close(name + ", plateau deviator by the law", im.law_deviator, 0.02, im.deviator);
    r.close(name + ", plateau plastic strain by the law", im.law_strain, 0.01, im.strain);
    // Rankine-Hugoniot: rho1 (U - u1) = rho2 (U - u2), P2 - P1 = rho1 (U - u1) (u2 - u1).
    const double mass = im.ahead.density * (im.speed - im.ahead.velocity);
    r.close(name + ", mass through the wave", mass, 0.01, im.behind.density * (im.speed - im.behind.velocity));
    r.close(name + ", stress jump", mass * (im.behind.velocity - im.ahead.velocity), 0.01, im.behind.stress - im.ahead.stress);
    conserves(r, name, im.run);
    if (motion == MotionPolicy::lagrangian) {
      reference = std::move(im);
    }
  }
  // As decks with strength run: the remap's kinetic loss stays lost.
  const Impact lossy = impact(MotionPolicy::eulerian, false);
  r.close("Eul without energy return as Lag, plateau pressure", reference.behind.stress + reference.deviator, 0.02,
          lossy.behind.stress + lossy.deviator);
  r.close("Eul without energy return as Lag, plateau deviator", reference.deviator, 0.02, lossy.deviator);
  conserves(r, "Eul without energy return", lossy.run);
  r.set_cells(impact_cells);
}

} // namespace

void add_plate_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"johnson_cook_impact", "Johnson-Cook copper at 300 m/s on a wall: jump laws, flow law, Eulerian as Lagrangian",
                   johnson_cook_impact});
}

} // namespace ballast::verify
