// Strong shock tubes that break codes with floors, and Sod along every axis.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"
#include "tests/exact/riemann_cases.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace ballast::verify {

namespace {

constexpr MotionPolicy both[] = {MotionPolicy::lagrangian, MotionPolicy::eulerian};

const exact::RiemannCase& named(std::string_view name) {
  return *std::find_if(exact::riemann_cases.begin(), exact::riemann_cases.end(),
                       [&](const exact::RiemannCase& c) { return c.name == name; });
}

/// Runs to the end at CFL 0.5 without a floor; L1 errors and observed order reported.
void strong(VerifyReport& r, const exact::RiemannCase& c, double length, int coarse) {
  const exact::Riemann exact(c.left, c.right);
  for (const MotionPolicy motion : both) {
    double density[2] = {}, pressure[2] = {};
    for (const int level : {0, 1}) {
      const int n = coarse << (2 * level);
      Tube tube = riemann_tube(c.left, c.right, c.interface_position, c.time, n);
      tube.length = length;
      tube.motion = motion;
      tube.numerics.cfl = 0.5;
      if (c.left.velocity != c.right.velocity && motion == MotionPolicy::eulerian) {
        tube.ends = {{{BoundaryKind::outflow, 0}, {BoundaryKind::outflow, 0}}};
      }
      const std::string name = fmt::format("{} N {}", short_name(motion), n);
      const TubeRun<2> run = run_tube<2>(tube);
      const TubeError e = error_against(profile(run, 0), exact, c.interface_position, c.time);
      density[level] = e.density / length;
      pressure[level] = e.pressure / length;
      r.close(name + ", end time", c.time, 1e-12, run.clock.time);
      untouched(r, name, run);
      conserves(r, name, run);
      r.note(name + ", L1(rho)", density[level]);
    }
    r.note(fmt::format("{} order of L1(rho)", short_name(motion)), std::log2(density[0] / density[1]) / 2);
    r.note(fmt::format("{} order of L1(p)", short_name(motion)), std::log2(pressure[0] / pressure[1]) / 2);
  }
  r.set_cells(4L * coarse);
}

template <int Dim> std::vector<TubeCell> sod_along(VerifyReport& r, int axis, MotionPolicy motion) {
  const exact::RiemannCase& c = named("riemann_sod_t0.2");
  Tube tube = riemann_tube(c.left, c.right, c.interface_position, c.time, 100);
  tube.axis = axis;
  tube.motion = motion;
  const TubeRun<Dim> run = run_tube<Dim>(tube);
  conserves(r, fmt::format("{} {}D along {}", short_name(motion), Dim, "xyz"[axis]), run);
  return profile(run, axis);
}

double largest_difference(const std::vector<TubeCell>& a, const std::vector<TubeCell>& b) {
  double worst = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    worst = std::max({worst, std::abs(a[i].density - b[i].density), std::abs(a[i].velocity - b[i].velocity),
                      std::abs(a[i].pressure - b[i].pressure), std::abs(a[i].centre - b[i].centre)});
  }
  return worst;
}

/// Values are of order one and 200 steps each add some ulp: 1e-12 is round-off.
void sod_axes(VerifyReport& r) {
  for (const MotionPolicy motion : both) {
    const std::vector<TubeCell> x = sod_along<2>(r, 0, motion);
    const char* name = short_name(motion);
    r.at_most(fmt::format("{} 2D along y - along x", name), 1e-12, largest_difference(x, sod_along<2>(r, 1, motion)));
    for (int axis = 0; axis < 3; ++axis) {
      r.at_most(fmt::format("{} 3D along {} - 2D along x", name, "xyz"[axis]), 1e-12,
                largest_difference(x, sod_along<3>(r, axis, motion)));
    }
  }
  r.set_cells(100);
}

} // namespace

void add_strong_tube_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"leblanc", "LeBlanc tube ends without a floor",
                   [](VerifyReport& r) { strong(r, named("riemann_leblanc_standard"), 9, 400); }});
  cases.push_back({"einfeldt_123", "123 double rarefaction ends without a floor",
                   [](VerifyReport& r) { strong(r, named("riemann_123_einfeldt"), 1, 100); }});
  cases.push_back({"toro3", "Toro's test 3, pressure ratio 1e5, ends without a floor",
                   [](VerifyReport& r) { strong(r, named("riemann_toro3_strong"), 1, 100); }});
  cases.push_back({"toro4", "Toro's test 4, pressure ratio 1e4, ends without a floor",
                   [](VerifyReport& r) { strong(r, named("riemann_toro4_strong"), 1, 100); }});
  cases.push_back({"sod_axes", "Sod is the same along x, y and z", sod_axes});
}

} // namespace ballast::verify
