// The single vortex (Rider & Kothe, J. Comput. Phys. 141 (1998) 112) as a run takes it: the mesh goes with the flow for N steps,
// then all is remapped to where it started. What remapping less often costs and gives.
#include "tests/remap/remap_box.hpp"
#include "tests/verify/cases.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast::verify {

namespace {

using std::numbers::pi;
using Point = remap::Point<2>;

constexpr double period = 8;

Point flow(const Point& x, double t) {
  const double a = std::cos(pi * t / period);
  return {2 * std::pow(std::sin(pi * x[0]), 2) * std::sin(pi * x[1]) * std::cos(pi * x[1]) * a,
          -2 * std::pow(std::sin(pi * x[1]), 2) * std::sin(pi * x[0]) * std::cos(pi * x[0]) * a};
}

/// Runge and Kutta's fourth order.
Point carried(const Point& x, double t, double dt) {
  const auto from = [&](const Point& k, double part) { return Point{x[0] + part * dt * k[0], x[1] + part * dt * k[1]}; };
  const Point k1 = flow(x, t), k2 = flow(from(k1, 0.5), t + 0.5 * dt), k3 = flow(from(k2, 0.5), t + 0.5 * dt), k4 = flow(from(k3, 1), t + dt);
  return {x[0] + dt / 6 * (k1[0] + 2 * k2[0] + 2 * k3[0] + k4[0]), x[1] + dt / 6 * (k1[1] + 2 * k2[1] + 2 * k3[1] + k4[1])};
}

struct Outcome {
  double l1 = 0, mass = 0, seconds = 0;
  long sweeps = 0;
};

Outcome vortex(int cells, int every) {
  remap::RemapBox<2> box({.cells = {cells, cells, 1}, .has_void = true, .boundary = BoundaryKind::symmetry});
  const double h = 1.0 / cells;
  std::vector<double> start;
  box.for_each_cell([&](int i, int j, int k) {
    constexpr int samples = 32;
    int in = 0;
    for (int s = 0; s < samples * samples; ++s) {
      in += std::hypot(box.line(0, i) + h * (s % samples + 0.5) / samples - 0.5, box.line(1, j) + h * (s / samples + 0.5) / samples - 0.75) < 0.15;
    }
    const double f = static_cast<double>(in) / (samples * samples);
    box.fill(0, i, j, k, f, 1, 1);
    box.fill(1, i, j, k, 1 - f, 0, 0);
    start.push_back(f);
  });
  const double mass = box.totals().mass[0];
  ThreadPool pool(1);
  Outcome out;
  double dropped = 0;
  const int steps = 32 * static_cast<int>(std::ceil(period * cells / 0.5 / 32)); // Courant number 1/2, a whole number of all intervals
  const double dt = period / steps;
  const auto began = std::chrono::steady_clock::now();
  for (int n = 0; n < steps; n += every) {
    box.for_each_node([&](int i, int j, int k) {
      const int r = box.grid.node_row(j, k);
      Point x = {box.position[0].row(r)[i], box.position[1].row(r)[i]};
      for (int s = 0; s < every; ++s) {
        x = carried(x, (n + s) * dt, dt);
      }
      box.position[0].row(r)[i] = x[0];
      box.position[1].row(r)[i] = x[1];
    });
    box.update_volumes();
    const remap::Report report = box.move_to([](const Point& x) { return x; }, {}, pool, n / every);
    out.sweeps += report.substeps;
    dropped += report.sliver_mass;
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  out.mass = std::abs(box.totals().mass[0] + dropped - mass) / mass;
  std::size_t at = 0;
  box.for_each_cell([&](int i, int j, int k) { out.l1 += std::abs(box.fraction(0, i, j, k) - start[at++]) * h * h; });
  return out;
}

void interval_case(VerifyReport& r) {
  constexpr int cells = 64;
  for (const int every : {1, 2, 4, 8, 16, 32}) {
    const Outcome o = vortex(cells, every);
    if (every == 1) {
      r.at_most("every step: L1(f)", 1.05e-2, o.l1); // as the sweeps alone are asked (case vortex)
    } else {
      r.note(fmt::format("every {} steps: L1(f)", every), o.l1);
    }
    r.at_most(fmt::format("every {}: mass", every), 1e-12, o.mass);
    r.note(fmt::format("every {}: sweeps of the whole mesh", every), static_cast<double>(o.sweeps));
    r.note(fmt::format("every {}: seconds", every), o.seconds);
  }
  r.set_cells(cells * cells);
}

} // namespace

void add_remap_interval_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"vortex_interval", "single vortex, the mesh carried by the flow and remapped every N steps", interval_case});
}

} // namespace ballast::verify
