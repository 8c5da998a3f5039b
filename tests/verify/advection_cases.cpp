// Interfaces carried by prescribed flows through the remap's own sweeps: Zalesak's slotted disk (Rudman,
// Int. J. Numer. Meth. Fluids 24 (1997) 671) and the single vortex (Rider & Kothe, J. Comput. Phys. 141
// (1998) 112). The mesh stands still: faces "sweep" what the stream function lets through, so volumes
// change sweep by sweep and are the cells' own again after the last.
#include "tests/remap/remap_box.hpp"
#include "tests/verify/cases.hpp"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>

namespace ballast::verify {

namespace {

using std::numbers::pi;

/// Area of the quarter disc of radius R about the origin within [0, x] x [0, y], odd in x and y.
double disc_in_corner(double radius, double x, double y) {
  const double a = std::min(std::abs(x), radius), b = std::min(std::abs(y), radius);
  double area = a * b;
  if (a * a + b * b > radius * radius) {
    const auto segment = [&](double q) { // integral of the arc's height over [0, q]
      return 0.5 * (q * std::sqrt(std::max(radius * radius - q * q, 0.0)) +
                    radius * radius * std::asin(std::min(q / radius, 1.0)));
    };
    const double top = std::sqrt(std::max(radius * radius - b * b, 0.0));
    area = top * b + segment(a) - segment(top);
  }
  return std::copysign(1.0, x) * std::copysign(1.0, y) * area;
}

struct Rectangle {
  double x0, x1, y0, y1;
  double area() const { return std::max(x1 - x0, 0.0) * std::max(y1 - y0, 0.0); }
};

double disc_in_rectangle(double radius, double cx, double cy, const Rectangle& r) {
  if (r.area() == 0) {
    return 0;
  }
  const auto corner = [&](double x, double y) { return disc_in_corner(radius, x - cx, y - cy); };
  return corner(r.x1, r.y1) - corner(r.x0, r.y1) - corner(r.x1, r.y0) + corner(r.x0, r.y0);
}

struct Advection {
  int cells;
  double length;
  int steps;
  double end_time;
  BoundaryKind boundary;
  std::function<double(const Rectangle&)> area;                     ///< of the material in a cell
  std::function<double(double x, double y, double time)> streaming; ///< u = d/dy, v = -d/dx
};

struct Carried {
  double l1, relative; ///< sum |f - f0| times the cell's area; over sum f0
  double mass;         ///< relative change
  double density;      ///< largest departure from one in cells with material
};

/// Swept volumes of one step: a face "sweeps" backwards what flows through it.
void prescribe(remap::RemapBox<2>& box, const Advection& a, double time, double dt) {
  const Grid& g = box.grid;
  const auto psi = [&](int i, int j) { return a.streaming(box.line(0, i), box.line(1, j), time) * dt; };
  for (int j = 0; j <= g.cells[1]; ++j) {
    double* sx = box.swept[0].row(g.cell_row(j, 0));
    double* sy = box.swept[1].row(g.cell_row(j, 0));
    double here = psi(0, j), above = psi(0, j + 1);
    for (int i = 0; i <= g.cells[0]; ++i) {
      const double next = psi(i + 1, j);
      sx[i] = j < g.cells[1] ? here - above : 0;
      sy[i] = i < g.cells[0] ? next - here : 0;
      here = next;
      above = psi(i + 1, j + 1);
    }
  }
}

Carried carry(const Advection& a, remap::NormalMethod normal = remap::NormalMethod::elvira) {
  remap::BoxShape shape{.cells = {a.cells, a.cells, 1}, .high = {a.length, a.length, 1}, .has_void = true, .boundary = a.boundary};
  remap::RemapBox<2> box(shape);
  const double h = a.length / a.cells;
  std::vector<double> start;
  box.for_each_cell([&](int i, int j, int k) {
    const Rectangle cell{box.line(0, i), box.line(0, i + 1), box.line(1, j), box.line(1, j + 1)};
    double f = std::clamp(a.area(cell) / cell.area(), 0.0, 1.0);
    f = f < 1e-12 ? 0.0 : f > 1 - 1e-12 ? 1.0 : f;
    box.fill(0, i, j, k, f, 1, 1);
    box.fill(1, i, j, k, 1 - f, 0, 0);
    start.push_back(f);
  });
  const RowField volume = box.volume;
  const double mass = box.totals().mass[0];
  ThreadPool pool(1);
  remap::Mesh<2> mesh = box.mesh();
  const remap::Settings settings{.normal = normal};
  remap::Report report;
  const double dt = a.end_time / a.steps;
  for (int n = 0; n < a.steps; ++n) {
    prescribe(box, a, (n + 0.5) * dt, dt);
    sweep_all(mesh, settings, pool, n, report);
    box.volume = volume; // to round-off what the sweeps left
  }
  Carried c{0, 0, std::abs(box.totals().mass[0] + report.mass_out[0] + report.sliver_mass - mass) / mass, 0};
  double sum = 0;
  std::size_t at = 0;
  box.for_each_cell([&](int i, int j, int k) {
    const double f = box.fraction(0, i, j, k);
    c.l1 += std::abs(f - start[at]) * h * h;
    sum += start[at++] * h * h;
    c.density = std::max(c.density, f > 1e-6 ? std::abs(box.density(0, i, j, k) - 1) : 0.0);
  });
  c.relative = c.l1 / sum;
  return c;
}

Advection vortex(int cells, double cfl) {
  const double time = 8;
  return {cells, 1, static_cast<int>(std::ceil(time * cells / cfl)), time, BoundaryKind::symmetry,
          [](const Rectangle& r) { return disc_in_rectangle(0.15, 0.5, 0.75, r); },
          [time](double x, double y, double t) {
            const double a = std::sin(pi * x), b = std::sin(pi * y);
            return a * a * b * b / pi * std::cos(pi * t / time);
          }};
}

/// One turn about (2, 2) in Rudman's 2524 steps (Courant number 1/4 at the box's edge).
Advection zalesak(int cells) {
  const double h = 4.0 / cells, half = 3 * h, slot_top = 2.25 + 30 * h;
  return {cells, 4, 2524 * cells / 200, 4 * pi, BoundaryKind::free,
          [=](const Rectangle& r) {
            const Rectangle slot{std::max(r.x0, 2 - half), std::min(r.x1, 2 + half), r.y0, std::min(r.y1, slot_top)};
            return disc_in_rectangle(0.5, 2, 2.75, r) - disc_in_rectangle(0.5, 2, 2.75, slot);
          },
          [](double x, double y, double) { return -0.25 * ((x - 2) * (x - 2) + (y - 2) * (y - 2)); }};
}

void vortex_case(VerifyReport& r) {
  struct Gate {
    int cells;
    double cfl, limit;
  };
  for (const Gate& g : {Gate{32, 0.5, 6.2e-2}, {64, 0.5, 1.05e-2}, {128, 0.5, 1.7e-3}, {64, 1, 7.0e-3}}) {
    const Carried c = carry(vortex(g.cells, g.cfl));
    const std::string name = fmt::format("N {} CFL {}", g.cells, g.cfl);
    r.at_most(name + " L1(f)", g.limit, c.l1);
    r.at_most(name + ", mass", 1e-13, c.mass);
    r.note(name + ", density - 1", c.density);
  }
  r.set_cells(128 * 128);
}

void zalesak_case(VerifyReport& r) {
  const Carried c = carry(zalesak(200));
  r.at_most("N 200 sum|f-f0|/sum f0", 1.2e-2, c.relative);
  r.at_most("N 200, mass", 1e-13, c.mass);
  r.note("N 200, density - 1", c.density);
  r.set_cells(200 * 200);
}

} // namespace

void add_advection_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"vortex", "Rider-Kothe single vortex, T = 8, by the remap's sweeps", vortex_case});
  cases.push_back({"zalesak", "Zalesak's slotted disk, one turn, by the remap's sweeps", zalesak_case});
}

} // namespace ballast::verify
