// The triple point: three gases, a shock from the left runs faster in the lower than in the upper and winds their meeting point up.
// S. Galera, P.-H. Maire, J. Breil, J. Comput. Phys. 229 (2010) 5755, section 7.3: [0, 7] x [0, 3], walls; left of x = 1 (rho, p, gamma)
// = (1, 1, 1.5), right of it below y = 1.5 (1, 0.1, 1.4), above (0.125, 0.1, 1.5). The deck problems/triple_point.toml is the same.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include "problems/build_scene.hpp"
#include "problems/scene_reader.hpp"

#include <limits>

namespace ballast::verify {

namespace {

/// Walls close the box: the gases must fill it at the end, each with positive pressure.
void sane(VerifyReport& r, const std::string& name, const TubeRun<2>& run) {
  const Block<2>& b = run.scene.blocks[0];
  double least = std::numeric_limits<double>::infinity(), volume = 0;
  for_each_cell(b, [&](int i, int j, int k) {
    const int row = b.grid.cell_row(j, k);
    least = std::min(least, b.pressure.row(row)[i] + b.reference_pressure);
    for (const MaterialSlot& slot : b.materials) {
      volume += slot.store.has_row(row) ? slot.store.row(field::fraction, row)[i] * b.volume.row(row)[i] : 0.0;
    }
  });
  r.at_least(name + ", least pressure", 0, least);
  r.close(name + ", volume of the gases", 21, 1e-12, volume);
  r.note(name + ", energy floors", static_cast<double>(run.scene.ledger.energy_floors));
  r.note(name + ", steps", static_cast<double>(run.clock.step));
}

/// Where the shock in the lower gas stands: the rightmost cell of the bottom row with p > 0.2, twice what is ahead.
double lower_shock(const TubeRun<2>& run) {
  const Block<2>& b = run.scene.blocks[0];
  const int row = b.grid.cell_row(0, 0), nodes = b.grid.node_row(0, 0);
  for (int i = b.grid.cells[0] - 1; i > 0; --i) {
    if (b.pressure.row(row)[i] + b.reference_pressure > 0.2) {
      return b.position[0].row(nodes)[i + 1];
    }
  }
  return 0;
}

void triple_point(VerifyReport& r) {
  const ReadScene read = read_scene(std::string(BALLAST_SOURCE_DIR) + "/problems/triple_point.toml");
  r.set_cells(static_cast<long>(cell_count(read.scene)));
  TubeRun<2> run;
  const SceneSpec& eulerian = read.scene;
  if (ends(r, "Eul", build_scene<2>(eulerian, 1), eulerian.end_time, run)) {
    conserves(r, "Eul", run);
    sane(r, "Eul", run);
    r.note("Eul, shock in the lower gas", lower_shock(run));
  }
  // A Lagrangian mesh sheared along the lower gas's surface fails as soon as the vortex forms: reported.
  SceneSpec lagrangian = read.scene;
  lagrangian.motion.policy = MotionPolicy::lagrangian;
  try_scene(build_scene<2>(lagrangian, 1), lagrangian.end_time, run);
  r.note("Lag, goes to t", run.clock.time);
}

} // namespace

void add_triple_point_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"triple_point", "three gases, a shock and a vortex: eulerian to t = 5", triple_point});
}

} // namespace ballast::verify
