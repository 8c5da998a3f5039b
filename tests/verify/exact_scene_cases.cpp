// Decks with an exact solution: what a run reports of its own error falls with the mesh, and scenes without one are told apart.
#include "problems/build_scene.hpp"
#include "problems/exact_solution.hpp"
#include "problems/scene_reader.hpp"
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

ReadScene deck(const std::string& name, const std::vector<std::string>& settings) {
  return read_scene(fmt::format("{}/problems/{}.toml", BALLAST_SOURCE_DIR, name), settings);
}

std::map<std::string, double> errors_of(const std::string& name, const std::string& motion, int refine) {
  const SceneSpec spec = deck(name, {fmt::format("motion.policy=\"{}\"", motion), fmt::format("mesh.refine={}", refine)}).scene;
  std::string why_not;
  const auto exact = exact_solution_of(spec, why_not);
  if (!exact) {
    return {};
  }
  const TubeRun<2> run = run_scene(build_scene<2>(spec, 1), spec.end_time);
  return exact_errors(run.scene.blocks[0], *exact, run.clock.time);
}

void exact_scenes(VerifyReport& r) {
  for (const char* name : {"sod", "plate_impact"}) {
    for (const char* motion : {"lagrangian", "eulerian", "relax"}) {
      const auto coarse = errors_of(name, motion, 1), fine = errors_of(name, motion, 4);
      const std::string what = fmt::format("{}, {}", name, motion);
      for (const char* quantity : {"L1_velocity", "L1_pressure"}) {
        const double before = coarse.count(quantity) != 0 ? coarse.at(quantity) : 1, after = fine.count(quantity) != 0 ? fine.at(quantity) : 1;
        r.note(fmt::format("{}: {}", what, quantity), before);
        r.at_least(fmt::format("{}: order of {}", what, quantity), 0.8, std::log2(before / after) / 2); // a shock's cell: first order
      }
    }
  }
  const auto refused = [&](const std::string& name, const std::vector<std::string>& settings) {
    std::string why_not;
    const bool none = !exact_solution_of(deck(name, settings).scene, why_not) && !why_not.empty();
    r.at_least(fmt::format("{} {}: told apart", name, settings.empty() ? std::string() : settings[0]), 1, none ? 1 : 0);
  };
  refused("m80_tissue", {});
  refused("sod", {"end_time=0.5"}); // a wave at a wall
  refused("plate_impact", {"materials.copper_fluid.base=\"copper_ofhc\"", "materials.copper_fluid.strength=\"linear_hardening\"",
                           "materials.copper_fluid.shear_modulus=\"47.7 GPa\"", "materials.copper_fluid.yield=\"120 MPa\""});
  refused("plate_impact", {"ambient.pressure=\"1 MPa\""});
  refused("sod", {"body.0.velocity_radial={speed=0.5,power=0}"}); // waves from anywhere but the plane between the halves
  refused("sod", {"mesh.y.upper=\"free\""});
  refused("sod", {"mesh.x.lower=\"free\""}); // 1 beside an ambient 0.1
  refused("sod", {"mesh.x.lower=\"absorbing\""});
  refused("sod", {"body.0.velocity=[0.5,0]"}); // leaves its wall
  refused("plate_impact", {"mesh.x.lower=\"free\""}); // the flyer leaves it, and void comes after
  refused("plate_impact", {"mesh.x.lower=\"absorbing\""});
  const auto known = [&](const std::string& name, const std::vector<std::string>& settings) {
    std::string why_not;
    const bool some = exact_solution_of(deck(name, settings).scene, why_not).has_value();
    r.at_least(fmt::format("{} {}: known", name, settings[0]), 1, some ? 1 : 0);
  };
  known("sod", {"mesh.x.lower=\"outflow\""});
  known("sod", {"mesh.x.upper=\"free\""});
  known("plate_impact", {"mesh.x.lower=\"free\"", "motion.policy=\"lagrangian\""}); // goes along with the flyer
}

} // namespace

void add_exact_scene_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"exact_scenes", "decks with an exact solution know their own error, which falls with the mesh", exact_scenes});
}

} // namespace ballast::verify
