// A prestressed elastic disc that turns like a rigid body, on the disc mesh: frame invariance on cells of every shape.
//
// Exact: with D = 0 the stress turns with the material (Jaumann) and the density stays, so u = w x r and a stress field at rest in
// space are a solution where div s + rho w^2 r e_r = 0 and s_rr = 0 at the edge. At p = 0 and uniform density
//   s_rr = A (a^2 - r^2),  s_tt = A a^2 - B r^2,  B = 3 A - rho w^2,  s_zz = -s_rr - s_tt
// fulfils both for any A; A = (3 - 2 nu) / (8 (1 - nu)) rho w^2 is that of an elastic cylinder at plane strain. No wave is left
// out: what moves is the mesh's error.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include "problems/build_scene.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast::verify {

namespace {

constexpr double radius = 10e-3, rim_speed = 200, density = 7850, poisson = 0.3;
constexpr double turn = 2 * std::numbers::pi * radius / rim_speed;

Material steel() {
  constexpr double shear = 80e9, bulk = 2 * shear * (1 + poisson) / (3 * (1 - 2 * poisson));
  Material m;
  m.name = "steel";
  m.eos = MieGruneisen{density, std::sqrt(bulk / density), 1.5, 2.0};
  m.strength = LinearHardening{shear, 100e9, 0};
  m.density = density;
  return m;
}

using Stress = std::array<double, 3>; // xx, yy, xy

Stress equilibrium(double x, double y) {
  const double inertia = density * rim_speed * rim_speed / (radius * radius), a2 = radius * radius;
  const double A = (3 - 2 * poisson) / (8 * (1 - poisson)) * inertia, B = 3 * A - inertia;
  const double r2 = x * x + y * y, rr = A * (a2 - r2), tt = A * a2 - B * r2;
  const double c2 = x * x / r2, s2 = y * y / r2, cs = x * y / r2;
  return {rr * c2 + tt * s2, rr * s2 + tt * c2, (rr - tt) * cs};
}

/// Disc at equilibrium, n cells across.
Scene<2> spinning(int n) {
  SceneSpec s;
  s.geometry = Geometry::planar;
  s.map = {MapKind::disc, {0, 0, 0}, radius};
  s.ambient_pressure = 0;
  s.materials = {steel()};
  s.numerics.spall = false;
  s.motion = {MotionPolicy::lagrangian, 1};
  for (std::size_t d = 0; d < 2; ++d) {
    for (int i = 0; i <= n; ++i) {
      s.mesh_lines[d].push_back(-1 + 2.0 * i / n);
    }
  }
  s.bodies.push_back({"disc", 0, Shape{Sphere{{0, 0, 0}, radius}}, {}, density, 0, 0});
  Scene<2> scene = build_scene<2>(s, 1);
  Block<2>& b = scene.blocks[0];
  set_velocity(b, [](const std::array<double, 2>& x, std::array<double, 2>& u) {
    u = {-rim_speed / radius * x[1], rim_speed / radius * x[0]};
  });
  for_each_cell(b, [&](int i, int j, int) {
    const int r = b.grid.cell_row(j, 0), low = b.grid.node_row(j, 0), high = b.grid.node_row(j + 1, 0);
    const auto middle = [&](const RowField& x) { return 0.25 * (x.row(low)[i] + x.row(low)[i + 1] + x.row(high)[i] + x.row(high)[i + 1]); };
    const Stress stress = equilibrium(middle(b.position[0]), middle(b.position[1]));
    for (int c = 0; c < 3; ++c) {
      b.materials[0].store.row(field::stress + c, r)[i] = stress[static_cast<std::size_t>(c)];
    }
  });
  return scene;
}

/// Stress of the block (pressure included) less that of another, by volume, relative to the other's; and how far the nodes are from home.
struct Drift {
  double stress = 0, place = 0, pressure = 0;
};

Drift drift_of(const Block<2>& now, const Block<2>& start) {
  double difference = 0, size = 0;
  Drift out;
  for_each_cell(now, [&](int i, int j, int) {
    const int r = now.grid.cell_row(j, 0);
    const auto square = [](double xx, double yy, double xy) { return xx * xx + yy * yy + (xx + yy) * (xx + yy) + 2 * xy * xy; };
    const auto at = [&](const Block<2>& b, std::size_t c) { return b.stress[c].row(r)[i]; };
    const double v = start.volume.row(r)[i], p = now.pressure.row(r)[i] - start.pressure.row(r)[i];
    difference += v * (square(at(now, 0) - at(start, 0), at(now, 1) - at(start, 1), at(now, 2) - at(start, 2)) + 3 * p * p);
    out.pressure += 3 * v * p * p;
    size += v * square(at(start, 0), at(start, 1), at(start, 2));
  });
  for (std::size_t d = 0; d < 2; ++d) {
    for (int j = 0; j <= now.grid.cells[1]; ++j) {
      const int r = now.grid.node_row(j, 0);
      for (int i = 0; i <= now.grid.cells[0]; ++i) {
        out.place = std::max(out.place, std::abs(now.position[d].row(r)[i] - start.position[d].row(r)[i]) / radius);
      }
    }
  }
  out.stress = std::sqrt(difference / size);
  out.pressure = std::sqrt(out.pressure / size);
  return out;
}

void spinning_disc(VerifyReport& r) {
  for (const int n : {16, 32}) {
    Scene<2> start = spinning(n);
    prepare(start);
    for (const int turns : {1, 2}) {
      const TubeRun<2> run = run_scene(spinning(n), turns * turn);
      const Drift d = drift_of(run.scene.blocks[0], start.blocks[0]);
      const std::string disc = fmt::format("{} cells across, {} turn(s)", n, turns), name = disc + ": ";
      if (n == 32) {
        r.at_most(name + "stress drift by turn, L2", 0.02, d.stress / turns); // the gate
      } else {
        r.note(name + "stress drift by turn, L2", d.stress / turns);
      }
      r.note(name + "of that, pressure", d.pressure / turns);
      r.note(name + "furthest node from home, by radius", d.place);
      conserves(r, disc, run);
      r.set_cells(run.scene.blocks[0].grid.cell_count());
    }
  }
}

} // namespace

void add_spinning_disc_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"spinning_disc", "a prestressed elastic disc on the disc mesh turns like a rigid body", spinning_disc});
}

} // namespace ballast::verify
