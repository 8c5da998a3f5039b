// Thick beryllium shells that collapse until plastic work has taken their kinetic energy: cylinder (Verney) on a planar polar
// mesh, sphere (Howell & Ball) on a spherical sector in RZ.
#include "tests/exact/shell_collapse.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"
#include "tests/uniform_lines.hpp"

#include "problems/build_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace ballast::verify {

namespace {

constexpr double shear_modulus = 151.9e9; ///< Pa, of the published tests
constexpr double void_above = 2e-3;       ///< m of void outside an eulerian mesh's shell

/// Density and yield of the published tests, Hugoniot after Marsh.
Material beryllium(const exact::Shell& shell) {
  Material m;
  m.name = "beryllium";
  m.eos = MieGruneisen{shell.density, 7998, 1.124, 1.16};
  m.strength = LinearHardening{shear_modulus, shell.yield, 0};
  m.density = shell.density;
  return m;
}

/// A quarter: 0 to 90 degrees; `through` cells through the wall, about as long along it as across in the middle.
SceneSpec shell_scene(const exact::Shell& shell, double speed, MotionPolicy motion, int through, int around) {
  SceneSpec s;
  const bool fixed = motion == MotionPolicy::eulerian; // the shell moves through the mesh
  s.geometry = shell.sphere ? Geometry::axisymmetric : Geometry::planar;
  s.map.kind = shell.sphere ? MapKind::spherical : MapKind::polar;
  s.ambient_pressure = 0;
  s.materials = {beryllium(shell)};
  s.numerics.spall = false;
  s.motion = {motion, 1};
  const double h = (shell.outer - shell.inner) / through;
  const int inside = fixed ? static_cast<int>(std::ceil(0.6 * shell.inner / h)) : 0, outside = fixed ? static_cast<int>(std::lround(void_above / h)) : 0;
  const std::size_t radius = shell.sphere ? 1 : 0, angle = 1 - radius;
  s.mesh_lines[radius] = uniform(shell.inner - inside * h, shell.outer + outside * h, through + inside + outside);
  s.mesh_lines[angle] = uniform(0, 0.5 * std::numbers::pi, around);
  s.boundaries[radius] = {Boundary{BoundaryKind::free}, Boundary{BoundaryKind::free}};
  s.boundaries[angle] = {Boundary{BoundaryKind::symmetry}, Boundary{BoundaryKind::symmetry}};
  Body body{"shell", 0, Shape{Combination{Combination::Kind::subtract, {Shape{Sphere{{0, 0, 0}, shell.outer}}, Shape{Sphere{{0, 0, 0}, shell.inner}}}}}, {}, shell.density, 0, 0};
  body.radial = RadialVelocity{-speed, shell.inner, shell.sphere ? 2.0 : 1.0};
  s.bodies.push_back(body);
  return s;
}

/// Radii of a surface over the angle.
struct Radii {
  double least = 1e9, mean = 0, most = 0;
  double spread() const { return (most - least) / mean; }
};

/// Inner radius by angle: of the surface's nodes where they move with the material; on a mesh at rest of the column of cells between two angles: where the void
/// within would end if it filled the column's inner end.
Radii inner_radii(const Block<2>& b, bool sphere) {
  const Grid& g = b.grid;
  const int around = sphere ? g.cells[0] : g.cells[1], deep = sphere ? g.cells[1] : g.cells[0];
  const auto node = [&](int a, int q) {
    const int r = g.node_row(sphere ? q : a, 0), i = sphere ? a : q;
    return std::hypot(b.position[0].row(r)[i], b.position[1].row(r)[i]);
  };
  Radii out;
  const auto add = [&](double radius, int count) {
    out.least = std::min(out.least, radius);
    out.most = std::max(out.most, radius);
    out.mean += radius / count;
  };
  if (b.motion.policy != MotionPolicy::eulerian) {
    for (int a = 0; a <= around; ++a) {
      add(node(a, 0), around + 1);
    }
    return out;
  }
  const double n = sphere ? 3 : 2;
  for (int a = 0; a < around; ++a) {
    double cubed = std::pow(node(a, 0), n);
    for (int q = 0; q < deep; ++q) {
      const int r = g.cell_row(sphere ? q : a, 0), i = sphere ? a : q;
      const double f = std::as_const(b.materials[0].store).has_row(r) ? std::as_const(b.materials[0].store).row(field::fraction, r)[i] : 0.0;
      if (f > 0.5 && q > 0 && 0.5 * (node(a, q) + node(a, q + 1)) > 0.09) {
        break; // the void outside is not counted
      }
      cubed += (1 - f) * (std::pow(node(a, q + 1), n) - std::pow(node(a, q), n));
      if (f > 1 - 1e-6) {
        break;
      }
    }
    add(std::pow(cubed, 1 / n), around);
  }
  return out;
}

/// The smallest mean inner radius so far, its time, and how round it was.
class Collapse : public Observer<2> {
public:
  explicit Collapse(bool sphere) : sphere_(sphere) {}
  bool record(const Scene<2>& scene, const Clock& clock) override {
    const Radii now = inner_radii(scene.blocks[0], sphere_);
    if (now.mean < least.mean || time == 0) {
      least = now;
      time = clock.time;
    }
    return true;
  }
  Radii least;
  double time = 0;

private:
  bool sphere_;
};

struct Stop {
  double radius = 0, time = 0, spread = 0;
  TubeRun<2> run;
};

Stop collapse(const exact::Shell& shell, double speed, MotionPolicy motion, int through, int around) {
  const SceneSpec s = shell_scene(shell, speed, motion, through, around);
  Collapse watch(shell.sphere);
  TubeRun<2> run = run_scene(build_scene<2>(s, 1), shell.sphere ? 110e-6 : 150e-6, {&watch});
  return {watch.least.mean, watch.time, watch.least.spread(), std::move(run)};
}

/// The gate is 1.5 % of the stopping radius at 40 cells through the wall. The exact radius is that of an incompressible rigid
/// shell; what compression and the elastic range change is below 0.1 % (the table's Rf_elastic).
void shell_case(VerifyReport& r, bool sphere, MotionPolicy motion, double speed, bool refine) {
  exact::Shell shell;
  shell.sphere = sphere;
  const double want = exact::stopping_radius(shell, speed) * 1e3;
  shell.shear_modulus = shear_modulus;
  const std::string name = fmt::format("{} {:.1f} m/s", short_name(motion), speed);
  r.note(name + ", elastic, exact radius (mm)", exact::stopping_radius(shell, speed) * 1e3);
  for (const int through : refine ? std::vector<int>{10, 20, 40} : std::vector<int>{40}) {
    const Stop got = collapse(shell, speed, motion, through, 3 * through / 4);
    const std::string cells = fmt::format("{}, {} cells", name, through), at = cells + ": ";
    if (through == 40) {
      r.close(at + "stopping radius (mm)", want, 0.015, got.radius * 1e3);
    } else {
      r.note(at + "stopping radius (mm)", got.radius * 1e3);
    }
    r.note(at + "stops at (us)", got.time * 1e6);
    r.note(at + "inner radius, spread over the angle", got.spread);
    conserves(r, cells, got.run);
    r.set_cells(got.run.scene.blocks[0].grid.cell_count());
  }
}

} // namespace

void add_shell_cases(std::vector<VerifyCase>& cases) {
  struct Named {
    const char* name;
    bool sphere;
    double speeds[2];
  };
  for (const Named& n : {Named{"shell_cylinder", false, {417.1, 490.2}}, Named{"shell_sphere", true, {545.144686915, 619.787075503}}}) {
    cases.push_back({n.name, fmt::format("beryllium {} collapses and stops, polar mesh, Lagrangian", n.sphere ? "sphere (RZ)" : "cylinder"), [n](VerifyReport& r) {
                       shell_case(r, n.sphere, MotionPolicy::lagrangian, n.speeds[0], true);
                       shell_case(r, n.sphere, MotionPolicy::lagrangian, n.speeds[1], false);
                     }});
    cases.push_back({fmt::format("{}_relax", n.name), "the same, remapped to a smoothed mesh every step", [n](VerifyReport& r) {
                       shell_case(r, n.sphere, MotionPolicy::relax, n.speeds[0], false);
                       shell_case(r, n.sphere, MotionPolicy::relax, n.speeds[1], false);
                     }});
    cases.push_back({fmt::format("{}_eulerian", n.name), "the same through a polar mesh at rest", [n](VerifyReport& r) { shell_case(r, n.sphere, MotionPolicy::eulerian, n.speeds[0], false); }});
  }
}

} // namespace ballast::verify
