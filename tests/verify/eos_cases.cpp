// Equations of state beyond gases and linear Us-up: JWL, cubic Us-up, linear bulk, bubbly lung, p-alpha foam.
#include "tests/exact/cubic_impact.hpp"
#include "tests/exact/jwl_riemann.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

const CellValue pressure_of = [](const TubeCell& c) { return c.pressure; };
const CellValue velocity_of = [](const TubeCell& c) { return c.velocity; };
const CellValue density_of = [](const TubeCell& c) { return c.density; };

/// The middle half of a plateau: clear of the shock's width and of wall heating.
double middle(const std::vector<TubeCell>& cells, const CellValue& v, double a, double b) {
  return mean_between(cells, v, a + 0.25 * (b - a), b - 0.25 * (b - a));
}

/// Lee's products at half and at twice their reference density (tests/data/riemann_jwl_lee.csv; cm, us, Mbar).
struct JwlProblem {
  exact::JwlLaw law{1.905, 632.1, -0.04472, 11.3, 1.13, 0.8938};
  exact::FlowState left{0.9525, 0, 1}, right{3.81, 0, 2};
  double interface = 50, length = 100, time = 20;
  exact::JwlRiemann exact{law, left, right};

  Material products(const char* name, const exact::FlowState& s) const {
    Material m;
    m.name = name;
    m.eos = Jwl{law.rho0, law.A, law.B, law.R1, law.R2, law.omega, 0};
    m.density = s.density;
    m.specific_energy = energy(m.eos, s.density, s.pressure);
    return m;
  }
  /// `parted`: the two sides are two materials, so that their contact is an interface.
  TubeRun<2> run(int cells, MotionPolicy motion, bool parted) const {
    Tube t;
    t.cells = cells;
    t.length = length;
    t.interface = interface;
    t.end_time = time;
    t.motion = motion;
    t.materials = {products("left", left), products(parted ? "right" : "left", right)};
    t.left = {0, left.density, left.velocity, t.materials[0].specific_energy};
    t.right = {1, right.density, right.velocity, t.materials[1].specific_energy};
    return run_tube<2>(t);
  }
};

struct JwlErrors {
  double density = 0, pressure = 0; ///< L1, mean over the tube
};

JwlErrors errors_of(const JwlProblem& p, const std::vector<TubeCell>& cells) {
  JwlErrors e;
  for (const TubeCell& c : cells) {
    const exact::FlowState s = p.exact.at((c.centre - p.interface) / p.time);
    e.density += c.mixed ? 0 : std::abs(c.density - s.density) * c.width / p.length;
    e.pressure += c.mixed ? 0 : std::abs(c.pressure - s.pressure) * c.width / p.length;
  }
  return e;
}

/// First order: L1 falls as h for shock and rarefaction edges; 0.85 leaves room for the interface's cell.
void jwl_rows(VerifyReport& r, const JwlProblem& p, MotionPolicy motion) {
  const std::string name = short_name(motion);
  JwlErrors last;
  for (const int n : {200, 400, 800}) {
    const TubeRun<2> run = p.run(n, motion, true);
    const auto cells = profile(run.scene.blocks[0], 0);
    const JwlErrors e = errors_of(p, cells);
    const std::string size = fmt::format("{} N {}", name, n);
    r.note(size + " L1(rho)", e.density);
    r.note(size + " L1(p)", e.pressure);
    if (n > 200) {
      r.at_least(size + " order of L1(rho)", 0.85, std::log2(last.density / e.density));
      r.at_least(size + " order of L1(p)", 0.85, std::log2(last.pressure / e.pressure));
    }
    conserves(r, size, run);
    last = e;
    if (n == 800) {
      const auto at = [&](double speed) { return p.interface + p.time * speed; };
      const double contact = at(p.exact.star_velocity()), shock = at(p.exact.left_head()), tail = at(p.exact.right_tail());
      r.close(name + ", star p left", p.exact.star_pressure(), 0.01, middle(cells, pressure_of, shock, contact));
      r.close(name + ", star p right", p.exact.star_pressure(), 0.01, middle(cells, pressure_of, contact, tail));
      r.close(name + ", star u", p.exact.star_velocity(), 0.01, middle(cells, velocity_of, shock, contact));
      r.close(name + ", star rho left", p.exact.star_density_left(), 0.01, middle(cells, density_of, shock, contact));
      r.close(name + ", star rho right", p.exact.star_density_right(), 0.01, middle(cells, density_of, contact, tail));
    }
  }
}

/// As one material the Eulerian contact smears: a mixture at density between has another pressure than both sides, as in
/// any conservative scheme, and sends out sound. Reported.
void jwl_case(VerifyReport& r) {
  const JwlProblem p;
  jwl_rows(r, p, MotionPolicy::lagrangian);
  jwl_rows(r, p, MotionPolicy::eulerian);
  for (const int n : {200, 400, 800}) {
    const TubeRun<2> run = p.run(n, MotionPolicy::eulerian, false);
    const auto cells = profile(run.scene.blocks[0], 0);
    const JwlErrors e = errors_of(p, cells);
    const std::string size = fmt::format("Eul, one material, N {}", n);
    r.note(size + " L1(rho)", e.density);
    r.note(size + " L1(p)", e.pressure);
    r.note(size + ", energy not returned", conservation(run).worst());
    r.note(size + ", energy floors", static_cast<double>(run.scene.ledger.energy_floors));
  }
  r.set_cells(800);
}

Material metal(const char* name, const exact::CubicHugoniot& h, double gamma0, double b) {
  Material m;
  m.name = name;
  m.eos = CubicGruneisen{h.density, h.sound_speed, h.s1, h.s2, h.s3, gamma0, b};
  m.density = h.density;
  return m;
}

/// Copper on lead, both by the cubic form (copper's higher terms are 0); the linear part of lead's fit alone would miss
/// the pressure by 2 %. Tolerance: the 1 % of plate impacts.
void cubic_case(VerifyReport& r) {
  const exact::CubicHugoniot copper{8930, 3940, 1.489, 0, 0}, lead{11340, 2006, 1.429, 0.8506, -1.64};
  const double speed = 2000;
  const exact::CubicImpact s = exact::cubic_impact(copper, lead, speed);
  const exact::CubicImpact linear = exact::cubic_impact(copper, {11340, 2006, 1.429, 0, 0}, speed);
  r.note("p by the linear part alone, error", linear.target.pressure / s.target.pressure - 1);
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    Tube t;
    t.cells = 200;
    const double flyer_shock = speed - s.flyer.shock_speed, share = s.flyer.shock_speed / (s.flyer.shock_speed + s.target.shock_speed);
    t.interface = std::round(share * t.cells) / t.cells;
    t.end_time = 0.85 * std::min(t.interface / s.flyer.shock_speed, (1 - t.interface) / s.target.shock_speed);
    t.materials = {metal("copper", copper, 2.02, 0.47), metal("lead", lead, 2.74, 0.54)};
    t.left = {0, copper.density, speed, 0};
    t.right = {1, lead.density, 0, 0};
    t.motion = motion;
    if (motion == MotionPolicy::eulerian) {
      t.ends = {{{BoundaryKind::inflow, speed}, {BoundaryKind::wall, 0}}};
    }
    const double travel = 0.8 * s.target.shock_speed * t.end_time;
    Arrival arrival(pressure_of, 0.5 * s.target.pressure, t.interface + travel);
    const TubeRun<2> run = run_watched(t, {&arrival});
    const auto cells = profile(run.scene.blocks[0], 0);
    const double contact = t.interface + s.velocity * t.end_time;
    const double left = t.interface + flyer_shock * t.end_time, right = t.interface + s.target.shock_speed * t.end_time;
    const std::string name = short_name(motion);
    r.close(name + ", flyer p", s.flyer.pressure, 0.01, middle(cells, pressure_of, left, contact));
    r.close(name + ", target p", s.target.pressure, 0.01, middle(cells, pressure_of, contact, right));
    r.close(name + ", target u", s.velocity, 0.01, middle(cells, velocity_of, contact, right));
    r.close(name + ", target rho", s.target.density, 0.01, middle(cells, density_of, contact, right));
    r.close(name + ", target shock arrival", travel / s.target.shock_speed, 0.01, arrival.time());
    conserves(r, name, run);
  }
  r.set_cells(200);
}

/// A wall moves into a barotropic liquid: U (U - u) = K/rho0 and p = rho0 U u exactly, for sound and for shocks.
void linear_bulk_case(VerifyReport& r) {
  Material liquid;
  liquid.name = "liquid";
  liquid.eos = LinearBulk{1000, 2.25e9, 0, 0};
  liquid.density = 1000;
  const double c = 1500;
  for (const double u : {0.1, 100.0}) {
    for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
      const double speed = 0.5 * u + std::sqrt(0.25 * u * u + c * c), p = 1000 * speed * u;
      const bool moving = motion == MotionPolicy::lagrangian;
      const double frame = moving ? 0 : -u;
      Tube t;
      t.cells = 200;
      t.motion = motion;
      t.materials = {liquid, liquid};
      t.left = t.right = {0, 1000, frame, 0};
      t.ends = {{{BoundaryKind::wall, moving ? u : 0}, {moving ? BoundaryKind::wall : BoundaryKind::inflow, moving ? 0 : -u}}};
      t.end_time = 0.9 / speed;
      Arrival arrival(pressure_of, 0.5 * p, 0.8);
      const TubeRun<2> run = run_watched(t, {&arrival});
      const auto cells = profile(run.scene.blocks[0], 0);
      const std::string name = fmt::format("{} {:g} m/s", short_name(motion), u);
      r.close(name + ", wave speed", speed + frame, 0.01, 0.8 / arrival.time()); // the front is two to three of 200 cells wide
      r.close(name + ", p", p, 0.01, mean_between(cells, pressure_of, 0.2, 0.7));
      r.close(name + ", u", u, 0.01, mean_between(cells, velocity_of, 0.2, 0.7) - frame);
      conserves(r, name, run);
    }
  }
  r.set_cells(200);
}

/// A wall moves into lung, gently and as hard as collapses its gas. Behind the front gas and tissue bear P: the law of eos/bubbly gives
/// the density in closed form, and mass and momentum U^2 = p rho1/(rho0 (rho1 - rho0)), u = p/(rho0 U), p = P - P0. No energy: it is barotropic.
void lung_case(VerifyReport& r) {
  constexpr double rho0 = 200, gas = 1 - 200 / 1050.0, P0 = 101325, gamma = 1.2, K = 1050 * 1540.0 * 1540.0;
  Material lung;
  lung.name = "lung";
  lung.eos = Bubbly{.rho0 = rho0, .gas_fraction = gas, .gas_pressure = P0, .gamma = gamma, .c0 = 1540, .p_rest = 0};
  lung.density = rho0;
  const double wood = std::sqrt(1 / (rho0 * (gas / (gamma * P0) + (1 - gas) / K)));
  for (const double p : {1e-3 * P0, P0, 100 * P0}) {
    const double rho1 = rho0 / (gas * std::pow(P0 / (P0 + p), 1 / gamma) + (1 - gas) * std::pow(1 + 7 * p / K, -1.0 / 7));
    const double speed = std::sqrt(p * rho1 / (rho0 * (rho1 - rho0))), u = p / (rho0 * speed);
    for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
      const bool moving = motion == MotionPolicy::lagrangian;
      const double frame = moving ? 0 : -u;
      Tube t;
      t.cells = 200;
      t.motion = motion;
      t.materials = {lung, lung};
      t.left = t.right = {0, rho0, frame, 0};
      t.ends = {{{BoundaryKind::wall, moving ? u : 0}, {moving ? BoundaryKind::wall : BoundaryKind::inflow, moving ? 0 : -u}}};
      // In the frame of the Eulerian mesh a front that squeezes hard hardly leaves the wall.
      const double reach = 0.9 / speed * (speed + frame), place = reach * 0.8 / 0.9;
      t.end_time = 0.9 / speed;
      Arrival near(pressure_of, 0.5 * p, 0.4 * place), far(pressure_of, 0.5 * p, place); // the front takes a cell's time to form
      const TubeRun<2> run = run_watched(t, {&near, &far});
      const auto cells = profile(run.scene.blocks[0], 0);
      const double wall = moving ? u * t.end_time : 0;
      const std::string name = fmt::format("{} {:g} kPa", short_name(motion), p / 1000);
      r.close(name + ", wave speed", speed + frame, 0.02, 0.6 * place / (far.time() - near.time()));
      r.close(name + ", p", p, 0.02, middle(cells, pressure_of, wall, reach));
      r.close(name + ", rho", rho1, 0.02, middle(cells, density_of, wall, reach));
      r.close(name + ", u", u, 0.02, middle(cells, velocity_of, wall, reach) - frame);
      conserves(r, name, run);
    }
  }
  r.note("Wood's speed, m/s", wood);
  r.set_cells(200);
}

/// A wall drives foam past crushing: an elastic wave to the crush pressure, then a shock, both by mass and momentum alone
/// (it is barotropic). Herrmann's curve gives the density behind the shock in closed form.
void foam_case(VerifyReport& r) {
  constexpr double rho0 = 100, solid = 1000, K = 2e9, soft = 20e6, pe = 1e5, ps = 1e7, p = 1e6;
  Material foam;
  foam.name = "foam";
  foam.eos = PAlpha{.rho0 = rho0, .solid_density = solid, .K = K, .foam_modulus = soft, .crush_pressure = pe, .solid_pressure = ps};
  foam.density = rho0;
  const double rho_e = rho0 * (1 + pe / soft), alpha_e = 1 / (rho_e / solid - pe / K), x = (ps - p) / (ps - pe);
  const double rho1 = solid * (1 / (1 + (alpha_e - 1) * x * x) + p / K);
  const double flux_e = std::sqrt(pe / (1 / rho0 - 1 / rho_e)), flux = std::sqrt((p - pe) / (1 / rho_e - 1 / rho1));
  const double precursor = flux_e / rho0, u_e = pe / flux_e, u = u_e + (p - pe) / flux, shock = u_e + flux / rho_e;
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    const bool moving = motion == MotionPolicy::lagrangian;
    const double frame = moving ? 0 : -u;
    Tube t;
    t.cells = 400;
    t.motion = motion;
    t.materials = {foam, foam};
    t.left = t.right = {0, rho0, frame, 0};
    t.ends = {{{BoundaryKind::wall, moving ? u : 0}, {moving ? BoundaryKind::wall : BoundaryKind::inflow, moving ? 0 : -u}}};
    t.end_time = 0.9 / precursor;
    const double place = 0.9 * (shock + frame) * t.end_time;
    Arrival first(pressure_of, 0.5 * pe, 0.8), second(pressure_of, 0.5 * (p + pe), place);
    const TubeRun<2> run = run_watched(t, {&first, &second});
    const auto cells = profile(run.scene.blocks[0], 0);
    const double wall = moving ? u * t.end_time : 0, front = (shock + frame) * t.end_time, far = (precursor + frame) * t.end_time;
    const std::string name = short_name(motion);
    r.close(name + ", elastic wave speed", precursor + frame, 0.02, 0.8 / first.time());
    r.close(name + ", crushing wave speed", shock + frame, 0.02, place / second.time());
    r.close(name + ", elastic p", pe, 0.02, middle(cells, pressure_of, front, far));
    r.close(name + ", crushed p", p, 0.02, middle(cells, pressure_of, wall, front));
    r.close(name + ", crushed rho", rho1, 0.02, middle(cells, density_of, wall, front));
    r.close(name + ", crushed u", u, 0.02, middle(cells, velocity_of, wall, front) - frame);
    const Block<2>& b = run.scene.blocks[0];
    const MaterialSlot& slot = b.materials[0];
    const int row = b.grid.cell_row(0, 0), station = static_cast<int>(0.25 * t.cells * (moving ? shock * t.end_time : front));
    r.close(name + ", compaction", 1 - rho0 / rho1, 0.02, slot.store.row(slot.compaction_field(), row)[station]);
    conserves(r, name, run);
  }
  r.set_cells(400);
}

} // namespace

void add_eos_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"jwl", "JWL Riemann problem (Lee's products) against its exact solution", jwl_case});
  cases.push_back({"plates_cubic", "copper on lead by cubic Us-up at 2000 m/s by impedance matching", cubic_case});
  cases.push_back({"linear_bulk", "waves in a linear bulk liquid: speed and amplitude, small and large", linear_bulk_case});
  cases.push_back({"lung", "a wall moves into bubbly lung: Wood's speed, and shocks that press its gas out", lung_case});
  cases.push_back({"foam", "a wall drives p-alpha foam: elastic wave and crushing shock", foam_case});
}

} // namespace ballast::verify
