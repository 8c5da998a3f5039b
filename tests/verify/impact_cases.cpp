// Plate impacts of Mie-Grueneisen materials against impedance matching; the interface of copper on tissue.
#include "tests/exact/mie_gruneisen_impact.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

struct Named {
  const char* name;
  exact::LinearHugoniot law; ///< rho0, c0, s, Gamma0 as in tests/data/mg_materials.csv
};
const Named copper{"copper", {8930, 3940, 1.489, 2.02}};
const Named lead{"lead", {11350, 2051, 1.46, 2.77}};
const Named water{"water", {998, 1480, 1.92, 0.28}};
const Named gelatin{"gelatin20", {1060, 1570, 1.77, 0.17}};

Material fluid(const Named& n) {
  Material m;
  m.name = n.name;
  m.eos = MieGruneisen{n.law.density, n.law.sound_speed, n.law.slope, n.law.gruneisen, true};
  m.density = n.law.density;
  return m;
}

struct Plates {
  Named flyer, target;
  double speed;
};

/// Flyer from the left on a target at rest, the impact plane on a node, sized so that both shocks reach
/// 85 % of their plate at the end.
Tube plate_tube(const Plates& p, const exact::ImpactStates& s, int cells, MotionPolicy motion) {
  Tube t;
  t.cells = cells;
  const double share = s.flyer_shock_speed / (s.flyer_shock_speed + s.target_shock_velocity);
  t.interface = std::round(share * cells) / cells;
  t.end_time = 0.85 * std::min(t.interface / s.flyer_shock_speed, (1 - t.interface) / s.target_shock_velocity);
  t.materials = {fluid(p.flyer), fluid(p.target)};
  t.left = {0, p.flyer.law.density, p.speed, 0};
  t.right = {1, p.target.law.density, 0, 0};
  t.motion = motion;
  if (motion == MotionPolicy::eulerian) {
    t.ends = {{{BoundaryKind::inflow, p.speed}, {BoundaryKind::wall, 0}}};
  }
  return t;
}

void plates(VerifyReport& r, const Plates& p, MotionPolicy motion) {
  const exact::ImpactStates s = exact::PlateImpact(p.flyer.law, p.target.law, p.speed).states();
  const int cells = 200;
  const Tube tube = plate_tube(p, s, cells, motion);
  const CellValue pressure = [](const TubeCell& c) { return c.pressure; };
  const CellValue velocity = [](const TubeCell& c) { return c.velocity; };
  const double travel = 0.8 * s.target_shock_velocity * tube.end_time;
  Arrival arrival(pressure, 0.5 * s.pressure, tube.interface + travel);
  const TubeRun<2> run = run_watched(tube, {&arrival});
  const auto cells_now = profile(run, 0);
  const double contact = tube.interface + s.velocity * tube.end_time;
  const double left = tube.interface + s.flyer_shock_velocity * tube.end_time;
  const double right = tube.interface + s.target_shock_velocity * tube.end_time;
  const std::string name = fmt::format("{} on {} {:g} m/s {}", p.flyer.name, p.target.name, p.speed, short_name(motion));
  // The middle half of each shocked layer: clear of the shock's width and of the impact's wall heating.
  const auto middle = [&](const CellValue& v, double a, double b) {
    return mean_between(cells_now, v, a + 0.25 * (b - a), b - 0.25 * (b - a));
  };
  r.close(name + ", flyer p", s.pressure, 0.01, middle(pressure, left, contact));
  r.close(name + ", target p", s.pressure, 0.01, middle(pressure, contact, right));
  r.close(name + ", flyer u", s.velocity, 0.01, middle(velocity, left, contact));
  r.close(name + ", target u", s.velocity, 0.01, middle(velocity, contact, right));
  r.close(name + ", target shock arrival", travel / s.target_shock_velocity, 0.01, arrival.time());
  const double back = tube.interface - leftmost_crossing(cells_now, pressure, 0.5 * s.pressure);
  r.close(name + ", flyer shock speed", -s.flyer_shock_velocity, 0.01, back / tube.end_time);
  conserves(r, name, run);
  r.set_cells(cells);
}

/// As in the copper_tissue tube: stiffened gases, the interface in mid-cell.
void copper_tissue_interface(VerifyReport& r) {
  const exact::GasState left{8930, 370, 1e5, 4, 8930 * 3940. * 3940 / 4 - 1e5};
  const exact::GasState right{1000, 0, 1e5, 4.4, 1000 * 1500. * 1500 / 4.4 - 1e5};
  const exact::Riemann exact(left, right);
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    for (const int n : {100, 400}) {
      Tube tube = riemann_tube(left, right, 0.5, 1e-4, n);
      tube.motion = motion;
      tube.interface_in_cell = true;
      const TubeRun<2> run = run_tube<2>(tube);
      const auto cells = profile(run, 0);
      const double at = 0.5 + exact.star_velocity() * 1e-4;
      // Four cells each side of the interface, the mixed ones left out.
      const double p = mean_between(cells, [](const TubeCell& c) { return c.pressure; }, at - 4.5 / n, at + 4.5 / n);
      const double u = mean_between(cells, [](const TubeCell& c) { return c.velocity; }, at - 4.5 / n, at + 4.5 / n);
      const std::string name = fmt::format("{} N {}", short_name(motion), n);
      r.close(name + ", interface p", exact.star_pressure(), 0.015, p);
      r.close(name + ", interface u", exact.star_velocity(), 0.015, u);
      conserves(r, name, run);
    }
  }
  r.set_cells(400);
}

} // namespace

void add_impact_cases(std::vector<VerifyCase>& cases) {
  const auto both = [&](const char* name, const char* law, const Plates& p) {
    cases.push_back({name, law, [p](VerifyReport& r) {
                       plates(r, p, MotionPolicy::lagrangian);
                       plates(r, p, MotionPolicy::eulerian);
                     }});
  };
  both("plates_copper_lead", "copper on lead at 370 m/s by impedance matching", {copper, lead, 370});
  both("plates_lead_water", "lead on water at 445 m/s by impedance matching", {lead, water, 445});
  both("plates_lead_gelatin", "lead on gelatin at 823 m/s by impedance matching", {lead, gelatin, 823});
  cases.push_back({"copper_tissue_interface", "copper 370 m/s on tissue: interface state", copper_tissue_interface});
}

} // namespace ballast::verify
