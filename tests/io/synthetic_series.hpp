// A made-up axisymmetric dump series with known geometry: a lead disc (a sphere in RZ) flies
// through a gel block with air above it. Mixed cells carry polygons cut by hand. It tests the
// writers and shows what post/report draws without a run.
#pragma once

#include <filesystem>
#include <vector>

#include "core/io/vtk.hpp"

namespace ballast::io::synthetic {

struct DiscScene {
  int nr = 60, nz = 140;
  double r_end = 0.030, z_begin = -0.030, z_end = 0.040; // m
  double radius = 0.005, speed = 800, z_start = -0.012;  // the disc: m, m/s, m
  double gel_front = 0;                                  // gel fills z > gel_front
  double end_time = 40e-6;                               // s
  double disc_z(double time) const { return z_start + speed * time; }
};

/// The ALE block: materials 0 air, 1 gel, 2 lead.
GridDump disc_dump(const DiscScene& scene, double time);
/// A Lagrangian plate of material 3 that bends as the disc passes.
GridDump plate_dump(const DiscScene& scene, double time);

/// Writes fields.pvd and history.csv of `times` dumps into `dir`.
void write_run(const std::filesystem::path& dir, const DiscScene& scene, int times);

} // namespace ballast::io::synthetic
