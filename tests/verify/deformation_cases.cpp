// A sphere in LeVeque's deformation flow (SIAM J. Numer. Anal. 33 (1996) 627), T = 3, carried by the remap's own sweeps: it is drawn
// out into a thin sheet by t = T/2 and comes back. Faces "sweep" backwards the exact integral of the flow over them, so cells
// keep their volume to round-off (as in advection_cases).
#include "problems/shapes.hpp"
#include "tests/remap/remap_box.hpp"
#include "tests/verify/cases.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast::verify {

namespace {

using std::numbers::pi;

constexpr double turn_back = 3; ///< T

/// Integrals over each cell of one axis: of sin 2 pi x; and sin^2 pi x at its lines.
struct Line {
  std::vector<double> wave, bump;
};
Line line_of(int n) {
  Line l;
  for (int i = 0; i <= n; ++i) {
    const double x = static_cast<double>(i) / n, next = static_cast<double>(i + 1) / n, s = std::sin(pi * x);
    l.wave.push_back((std::cos(2 * pi * x) - std::cos(2 * pi * next)) / (2 * pi));
    l.bump.push_back(s * s);
  }
  return l;
}

/// u = 2 sin^2(pi x) sin(2 pi y) sin(2 pi z), v = -sin(2 pi x) sin^2(pi y) sin(2 pi z), w = -sin(2 pi x) sin(2 pi y) sin^2(pi z),
/// all times `factor`.
void prescribe(remap::RemapBox<3>& box, const Line& l, double factor) {
  const int n = box.grid.cells[0];
  const auto at = [](const std::vector<double>& v, int i) { return v[static_cast<std::size_t>(i)]; };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      const int r = box.grid.cell_row(j, k);
      double *sx = box.swept[0].row(r), *sy = box.swept[1].row(r), *sz = box.swept[2].row(r);
      for (int i = 0; i <= n; ++i) {
        sx[i] = j < n && k < n ? -2 * factor * at(l.bump, i) * at(l.wave, j) * at(l.wave, k) : 0;
        sy[i] = i < n && k < n ? factor * at(l.wave, i) * at(l.bump, j) * at(l.wave, k) : 0;
        sz[i] = i < n && j < n ? factor * at(l.wave, i) * at(l.wave, j) * at(l.bump, k) : 0;
      }
    }
  }
}

struct Returned {
  double l1, mass; ///< sum |f - f0| times the cell's volume; relative change of the mass
  int steps;
};

Returned deform(int n, double cfl, remap::NormalMethod normal) {
  remap::BoxShape shape{.cells = {n, n, n}, .has_void = true};
  remap::RemapBox<3> box(shape);
  const Shape sphere{Sphere{{0.35, 0.35, 0.35}, 0.15}};
  std::vector<double> start;
  box.for_each_cell([&](int i, int j, int k) {
    const double h = 1.0 / n, f = fraction(sphere, Geometry::three_d, {i * h, j * h, k * h}, {(i + 1) * h, (j + 1) * h, (k + 1) * h});
    box.fill(0, i, j, k, f, 1, 1);
    box.fill(1, i, j, k, 1 - f, 0, 0);
    start.push_back(f);
  });
  const RowField volume = box.volume;
  const double mass = box.totals().mass[0];
  ThreadPool pool(1);
  remap::Mesh<3> mesh = box.mesh();
  const remap::Settings settings{.normal = normal};
  remap::Report report;
  const int steps = static_cast<int>(std::ceil(turn_back * 2 * n / cfl)); // the largest speed is 2
  const double dt = turn_back / steps;
  const Line line = line_of(n);
  for (int s = 0; s < steps; ++s) {
    prescribe(box, line, dt * std::cos(pi * (s + 0.5) / steps));
    sweep_all(mesh, settings, pool, s, report);
    box.volume = volume; // to round-off what the sweeps left
  }
  Returned out{0, std::abs(box.totals().mass[0] + report.sliver_mass - mass) / mass, steps};
  std::size_t at = 0;
  box.for_each_cell([&](int i, int j, int k) { out.l1 += std::abs(box.fraction(0, i, j, k) - start[at++]) / (static_cast<double>(n) * n * n); });
  return out;
}

void report(VerifyReport& r, int n, double limit) {
  const Returned d = deform(n, 0.5, remap::NormalMethod::elvira);
  const std::string name = fmt::format("N {} L1(f)", n);
  if (limit > 0) {
    r.at_most(name, limit, d.l1);
  } else {
    r.note(name, d.l1);
  }
  r.at_most(fmt::format("N {}, mass", n), 1e-13, d.mass);
  r.note(fmt::format("N {}, steps", n), d.steps);
  r.set_cells(static_cast<long>(n) * n * n);
}

} // namespace

void add_deformation_cases(std::vector<VerifyCase>& cases) {
  // Published: Youngs 7.5e-3 / 2.8e-3, LVIRA 6.9e-3 / 2.4e-3 at 32 / 64. The gate is the issue's.
  cases.push_back({"deformation", "a sphere in LeVeque's 3D deformation flow, T = 3, 32^3 cells", [](VerifyReport& r) { report(r, 32, 0); }});
  cases.push_back({"deformation_64", "the same in 64^3 cells", [](VerifyReport& r) { report(r, 64, 3.0e-3); }, /*by_name=*/true});
}

} // namespace ballast::verify
