// Shock tubes: one gas, two gases with the interface inside a cell, water-air, copper on tissue.
#include "tests/verify/cases.hpp"
#include "tests/verify/tube.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

struct Sides {
  exact::GasState left, right;
  double x0, time;
};
const Sides sod{{1, 0, 1, 1.4, 0}, {0.125, 0, 0.1, 1.4, 0}, 0.5, 0.2};
const Sides two_gamma{{1, 0, 2, 2, 0}, {0.125, 0, 0.1, 1.4, 0}, 0.5, 0.2};
const Sides water_air{{1000, 0, 1e9, 4.4, 6e8}, {50, 0, 1e5, 1.4, 0}, 0.7, 2.2e-4};
const Sides copper_tissue{{8930, 370, 1e5, 4, 8930 * 3940. * 3940 / 4 - 1e5},
                          {1000, 0, 1e5, 4.4, 1000 * 1500. * 1500 / 4.4 - 1e5}, 0.5, 1e-4};

struct Outcome {
  TubeError error;
  Conservation sums;
  long floors;
  double mixed_gas; ///< specific energy of the right material in mixed cells, mean by mass, against exact: relative error
};

/// Specific energy (J/kg) of the last material in the mixed cells, mean by mass; NaN without such cells.
double mixed_energy(const Block<2>& b) {
  double mass = 0, energy = 0;
  const TileStore& store = b.materials.back().store;
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    if (b.owner_row(r)[i] == mixed_cell) {
      mass += store.row(field::mass, r)[i];
      energy += store.row(field::mass, r)[i] * store.row(field::energy, r)[i];
    }
  });
  return energy / mass;
}

/// Exact specific energy (J/kg) right of the contact.
double right_of_contact(const exact::GasState& gas, const exact::Riemann& exact) {
  return (exact.star_pressure() + gas.gamma * gas.p_infinity) / ((gas.gamma - 1) * exact.star_density_right());
}

Outcome solve(const Sides& s, int cells, MotionPolicy motion, bool in_cell, Closure closure = Closure::pressure_relaxation) {
  Tube tube = riemann_tube(s.left, s.right, s.x0, s.time, cells);
  tube.motion = motion;
  tube.interface_in_cell = in_cell;
  tube.numerics.closure = closure;
  const TubeRun<2> run = run_tube<2>(tube);
  const exact::Riemann exact(s.left, s.right);
  return {error_against(profile(run, 0), exact, s.x0, s.time), conservation(run),
          run.scene.ledger.energy_floors + run.scene.ledger.slivers,
          mixed_energy(run.scene.blocks[0]) / right_of_contact(s.right, exact) - 1};
}

void report(VerifyReport& r, const std::string& name, double limit, double got, const Outcome& o) {
  r.at_most(name, limit, got);
  r.at_most(name + ", energy", 1e-12, o.sums.energy);
  r.at_most(name + ", mass", 1e-12, o.sums.mass);
  r.at_most(name + ", momentum", 1e-12, o.sums.momentum);
  r.at_most(name + ", kinetic energy not returned", 1e-12, o.sums.unreturned);
}

/// An error that is reported, not gated; the sums are gated all the same.
void report(VerifyReport& r, const std::string& name, double got, const Outcome& o) {
  r.note(name, got);
  r.at_most(name + ", conservation", 1e-12, o.sums.worst());
}

const char* name_of(MotionPolicy m) { return m == MotionPolicy::lagrangian ? "Lag" : "Eul"; }

void sod_case(VerifyReport& r) {
  const double limits[2][2] = {{5.3e-3, 1.4e-3}, {6.5e-3, 1.9e-3}};
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    for (const int n : {100, 400}) {
      const Outcome o = solve(sod, n, motion, false);
      report(r, fmt::format("{} N {} L1(rho)", name_of(motion), n), limits[motion == MotionPolicy::eulerian][n == 400],
             o.error.density, o);
    }
  }
  r.set_cells(400);
}

void two_gamma_case(VerifyReport& r) {
  const double limits[2] = {5.6e-3, 1.5e-3};
  for (const int n : {100, 400}) {
    const Outcome o = solve(two_gamma, n, MotionPolicy::lagrangian, true);
    report(r, fmt::format("Lag N {} L1(rho)", n), limits[n == 400], o.error.density, o);
    const Outcome e = solve(two_gamma, n, MotionPolicy::eulerian, true);
    report(r, fmt::format("Eul N {} L1(rho)", n), e.error.density, e);
  }
  r.set_cells(400);
}

void water_air_case(VerifyReport& r) {
  const double limits[2] = {7.6e6, 1.9e6};
  for (const int n : {100, 400}) {
    const Outcome o = solve(water_air, n, MotionPolicy::lagrangian, true);
    report(r, fmt::format("Lag N {} L1(p)", n), limits[n == 400], o.error.pressure, o);
    r.at_most(fmt::format("Lag N {} floors", n), 0, static_cast<double>(o.floors));
    r.note(fmt::format("Lag N {} gas energy in mixed cell, error", n), o.mixed_gas);
    const Outcome e = solve(water_air, n, MotionPolicy::eulerian, true);
    report(r, fmt::format("Eul N {} L1(p)", n), e.error.pressure, e);
    r.note(fmt::format("Eul N {} gas energy in mixed cell, error", n), e.mixed_gas);
    r.note(fmt::format("Eul N {} floors", n), static_cast<double>(e.floors));
  }
  r.set_cells(400);
}

void copper_tissue_case(VerifyReport& r) {
  const double limits[2] = {6.5e7, 1.6e7};
  for (const int n : {100, 400}) {
    const Outcome o = solve(copper_tissue, n, MotionPolicy::lagrangian, true);
    report(r, fmt::format("Lag N {} L1(p)", n), limits[n == 400], o.error.pressure, o);
    const Outcome e = solve(copper_tissue, n, MotionPolicy::eulerian, true);
    report(r, fmt::format("Eul N {} L1(p)", n), e.error.pressure, e);
  }
  r.set_cells(400);
}

} // namespace

void add_riemann_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"sod", "Sod shock tube against the exact Riemann solution", sod_case});
  cases.push_back({"two_gamma", "two-gamma Sod, interface in mid-cell", two_gamma_case});
  cases.push_back({"water_air", "water-air 1e4, interface in mid-cell", water_air_case});
  cases.push_back({"copper_tissue", "copper 370 m/s on tissue, interface in mid-cell", copper_tissue_case});
}

} // namespace ballast::verify
