// Absorbing sides: plane waves in water and copper against the reflection that the condition itself has.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"
#include "materials/library.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast::verify {

namespace {

constexpr double amplitude = 1e-4; // of the wave speed
constexpr int width = 20;          // cells under a pulse

double pulse_at(double s) { // one unit long, about 0
  return std::abs(s) < 0.5 ? std::pow(std::cos(std::numbers::pi * s), 2) : 0.0;
}

struct Wave {
  Material material;
  bool shear = false;             ///< displaces across its way
  double angle = 0;               ///< of its way to the normal of the side, rad
  std::array<int, 2> cells;       ///< across, along the side's normal
  std::array<double, 2> through;  ///< a point the middle of the pulse is on at first, in pulse lengths
  bool axisymmetric = false;
};

double speed_of(const Wave& w) {
  const double rho = w.material.density, c = std::sqrt(sound_speed_squared(w.material.eos, rho, w.material.specific_energy));
  const double g = has_strength(w.material.strength) ? shear_modulus(w.material.strength) : 0.0;
  return w.shear ? std::sqrt(g / rho) : std::sqrt(c * c + 4.0 / 3 * g / rho);
}

/// A pulse one metre long in a planar block on its way up to an absorbing side.
Scene<2> scene_of(const Wave& w, MotionPolicy motion) {
  const Material& m = w.material;
  const double c = speed_of(w), rho = m.density, h = 1.0 / width;
  const std::array<double, 2> way = {std::sin(w.angle), std::cos(w.angle)};
  const auto along = [&](double x, double y) { return pulse_at((x - w.through[0]) * way[0] + (y - w.through[1]) * way[1]); };
  Block<2> b;
  b.axisymmetric = w.axisymmetric;
  b.motion = {motion, 1};
  b.reference_pressure = pressure(m.eos, rho, m.specific_energy);
  b.materials.push_back(make_slot(m, b.reference_pressure));
  std::array<std::vector<double>, 3> lines;
  for (std::size_t d = 0; d < 2; ++d) {
    for (int i = 0; i <= w.cells[d]; ++i) {
      lines[d].push_back(h * i);
    }
  }
  allocate_block(b, lines);
  b.boundary.side[1] = {BoundarySide{BoundaryKind::free, 0, {}}, BoundarySide{BoundaryKind::absorbing, 0, {}}};
  b.boundary.side[0] = b.boundary.side[1];
  if (w.angle == 0 && !w.shear) {
    b.boundary.side[0] = {BoundarySide{BoundaryKind::symmetry, 0, {}}, BoundarySide{BoundaryKind::symmetry, 0, {}}};
  }
  for_each_cell(b, [&](int i, int j, int k) {
    const double v = amplitude * along(h * (i + 0.5), h * (j + 0.5)), squeeze = w.shear ? 0 : v;
    const double e = m.specific_energy + (0.5 * c * c * squeeze + b.reference_pressure / rho) * squeeze;
    fill_cell<2>(b, i, j, k, std::vector<CellPart>{{0, 1, rho * (1 + squeeze), e}});
    if (has_strength(m.strength)) { // of the strain -v way (x) way, or of the shear -v across
      const double g = shear_modulus(m.strength);
      TileStore& store = b.materials[0].store;
      const int r = b.grid.cell_row(j, k);
      store.row(field::stress, r)[i] = w.shear ? 0 : 2.0 / 3 * g * v;      // xx, way = y
      store.row(field::stress + 1, r)[i] = w.shear ? 0 : -4.0 / 3 * g * v; // yy
      store.row(field::stress + 2, r)[i] = w.shear ? -g * v : 0;           // xy
    }
  });
  set_velocity(b, [&](const std::array<double, 2>& x, std::array<double, 2>& u) {
    const double v = c * amplitude * along(x[0], x[1]);
    u = w.shear ? std::array<double, 2>{v, 0} : std::array<double, 2>{v * way[0], v * way[1]};
  });
  Scene<2> scene;
  scene.numerics.linear_q = scene.numerics.quadratic_q = 0; // what comes back is the side's alone
  scene.blocks.push_back(std::move(b));
  prepare(scene);
  return scene;
}

Material elastic_copper() {
  Material m = copper_at_zero();
  m.strength = LinearHardening{.shear_modulus = 46e9, .yield = 1e15};
  m.spall_pressure = -std::numeric_limits<double>::infinity();
  return m;
}

void head_on(VerifyReport& r, const std::string& name, const Wave& w) {
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    const double c = speed_of(w), way = static_cast<double>(w.cells[1]) / width - w.through[1];
    const TubeRun<2> run = run_scene(scene_of(w, motion), (way + 1.2) / c);
    double back = 0;
    const Block<2>& b = run.scene.blocks[0];
    for (int j = 0; j <= b.grid.cells[1]; ++j) {
      back = std::max(back, std::abs(b.velocity[w.shear ? 0 : 1].row(b.grid.node_row(j, 0))[w.cells[0] / 2]));
    }
    const std::string full = fmt::format("{} {}", short_name(motion), name);
    r.at_most(full + ", share that comes back", 0.03, back / (amplitude * c));
    conserves(r, full, run);
  }
}

void head_on_cases(VerifyReport& r) {
  head_on(r, "sound in water", {*find_material("water"), false, 0, {1, 4 * width}, {0, 3}});
  head_on(r, "sound in water, RZ", {*find_material("water"), false, 0, {4, 4 * width}, {0, 3}, true});
  head_on(r, "pressure wave in copper", {elastic_copper(), false, 0, {1, 4 * width}, {0, 3}});
  // The sides' edges are far: 3 pulse lengths, 2.7 of way.
  head_on(r, "shear wave in copper", {elastic_copper(), true, 0, {12 * width, 2 * width}, {0, 1}});
  r.set_cells(4 * width);
}

/// Pressure at a point one pulse length below the side: the wave passes, then its echo, (1 - cos a)/(1 + cos a) of it.
class Probe : public Observer<2> {
public:
  Probe(double x, double y, double turn) : x_(x), y_(y), turn_(turn) {}
  bool record(const Scene<2>& scene, const Clock& clock) override {
    const Block<2>& b = scene.blocks[0];
    const double p = std::abs(b.pressure.row(b.grid.cell_row(static_cast<int>(y_ * width), 0))[static_cast<int>(x_ * width)]);
    double& most = clock.time < turn_ ? passing : echo;
    most = std::max(most, p);
    return true;
  }
  double passing = 0, echo = 0;

private:
  double x_, y_, turn_;
};

void at_45_degrees(VerifyReport& r) {
  const double angle = std::numbers::pi / 4, side = std::sqrt(0.5);
  const Wave w{*find_material("water"), false, angle, {12 * width, 6 * width}, {4, 4}};
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    const double c = speed_of(w), passes = 3 * side / c, comes_back = passes + 2 * side / c; // at (6, 5)
    Probe probe(6, 5, 0.5 * (passes + comes_back));
    const TubeRun<2> run = run_scene(scene_of(w, motion), comes_back + 0.5 / c, {&probe});
    const std::string name = fmt::format("{} sound at 45 degrees", short_name(motion));
    r.at_most(name + ", share that comes back", 0.18, probe.echo / probe.passing);
    r.close(name + ", against the condition's own", (1 - side) / (1 + side), 0.1, probe.echo / probe.passing);
    conserves(r, name, run);
  }
  r.set_cells(12 * width * 6 * width);
}

} // namespace

void add_absorbing_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"absorbing", "a plane wave that arrives head on at an absorbing side does not come back", head_on_cases});
  cases.push_back({"absorbing_45", "one that arrives at 45 degrees: 17 % come back", at_45_degrees});
}

} // namespace ballast::verify
