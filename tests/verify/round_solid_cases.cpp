// Round solids in 3D against the same in 2D: the beryllium cylinder on a cylindrical sector (planar: polar), Taylor's rod on the disc
// map (axisymmetric: a rectilinear mesh). The shell's cells are the 2D cells by one layer, so it must stop where the planar one does.
#include "tests/verify/cases.hpp"
#include "tests/verify/measure.hpp"

#include "problems/build_scene.hpp"
#include "problems/run_measure.hpp"
#include "problems/scene_reader.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast::verify {

namespace {

const std::string problems = std::string(BALLAST_SOURCE_DIR) + "/problems/";

template <int Dim> double inner_radius(const Block<Dim>& b, int j) {
  const int r = b.grid.node_row(j, 0);
  return std::hypot(b.position[0].row(r)[0], b.position[1].row(r)[0]);
}

/// problems/shell_collapse.toml, half as fine, to 120 us (it stops at 129); 3D: one layer of it.
SceneSpec shell(bool solid) {
  SceneSpec s = read_scene(problems + "shell_collapse.toml", {"mesh.refine=0.5"}).scene;
  s.end_time = 120e-6;
  if (solid) {
    s.geometry = Geometry::three_d;
    s.map.kind = MapKind::cylindrical;
    s.mesh_lines[2] = {0, 1e-3};
    s.boundaries[2] = {Boundary{BoundaryKind::symmetry}, Boundary{BoundaryKind::symmetry}};
    s.bodies[0].radial->along = 2;
    auto& parts = std::get<Combination>(s.bodies[0].shape.form).parts;
    for (Shape& part : parts) {
      const double radius = std::get<Sphere>(part.form).radius;
      part.form = Cylinder{{0, 0, -1}, {0, 0, 1}, radius};
    }
  }
  return s;
}

void shell_3d(VerifyReport& r) {
  const TubeRun<2> flat = run_scene(build_scene<2>(shell(false), 1), 120e-6);
  const TubeRun<3> solid = run_scene(build_scene<3>(shell(true), 1), 120e-6);
  const Block<3>& b = solid.scene.blocks[0];
  const double want = inner_radius(flat.scene.blocks[0], 0) * 1e3;
  r.note("planar: inner radius (mm)", want);
  // The hourglass control and the viscosity's lengths are other formulas in 3D; both act little here.
  r.close("3D: inner radius (mm)", want, 1e-3, inner_radius(b, 0) * 1e3);
  double least = 1, most = 0;
  for (int j = 0; j <= b.grid.cells[1]; ++j) {
    least = std::min(least, inner_radius(b, j));
    most = std::max(most, inner_radius(b, j));
  }
  r.at_most("3D: inner radius, spread over the angle", 1e-9, most / least - 1); // every angle is the same problem turned
  conserves(r, "3D", solid);
  r.set_cells(b.grid.cell_count());
}

/// 4 cells to the edge. The issue asks for 2 % between RZ and 3D.
void taylor_3d(VerifyReport& r) {
  const TubeRun<2> flat = run_scene(build_scene<2>(read_scene(problems + "taylor_copper.toml", {"mesh.refine=0.25"}).scene, 1), 80e-6);
  const TubeRun<3> solid = run_scene(build_scene<3>(read_scene(problems + "taylor_copper_3d.toml", {"mesh.refine=0.5"}).scene, 1), 80e-6);
  const BodyMeasure rz = measure_body(flat.scene.blocks[0], {0}, 1, 1.0), rod = measure_body(solid.scene.blocks[0], {0}, 2, 1.0);
  r.note("RZ: length (mm)", rz.front * 1e3);
  r.note("RZ: foot radius (mm)", rz.radius * 1e3);
  r.close("3D: length (mm)", rz.front * 1e3, 0.02, rod.front * 1e3);
  r.close("3D: foot radius (mm)", rz.radius * 1e3, 0.02, rod.radius * 1e3);
  conserves(r, "3D", solid);
  r.set_cells(solid.scene.blocks[0].grid.cell_count());
}

} // namespace

void add_round_solid_cases(std::vector<VerifyCase>& cases) {
  cases.push_back({"shell_cylinder_3d", "the beryllium cylinder on a cylindrical sector in 3D moves as the planar one", shell_3d});
  cases.push_back({"taylor_rod_3d", "Taylor's rod in 3D on the disc map against axisymmetric", taylor_3d});
}

} // namespace ballast::verify
