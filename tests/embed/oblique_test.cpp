// Laws of slanted and turning layers in water: nothing leaks, no shear passes.
#include "tests/embed/channel.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

double env(const char* name, double otherwise) { return std::getenv(name) ? std::atof(std::getenv(name)) : otherwise; }

/// Two waters, one on each side of a plate turned by `angle` about (x, z) in a box; more than it wide, so that its ends lie outside.
struct Box {
  double cell = 1e-3, width = 12e-3, height = 60e-3;
  double angle = 0, x = 6e-3, z = 30e-3, thickness = 3e-3, pressure = 0;
};

Scene<2> two_waters(const Box& box, double density = 1e6) {
  Scene<2> scene;
  Block<2> b;
  b.motion = {MotionPolicy::eulerian, 1};
  b.materials.push_back(make_slot(channel_water(), 0));
  b.materials.push_back(make_slot(channel_water(), 0));
  b.materials[0].material.name = "below";
  b.materials[1].material.name = "above";
  b.materials.push_back(make_void());
  const int nx = static_cast<int>(std::lround(box.width / box.cell)), nz = static_cast<int>(std::lround(box.height / box.cell));
  allocate_block(b, std::array<std::vector<double>, 3>{even_lines(0, box.width, nx), even_lines(0, box.height, nz), {}});
  const double rho = 1000 * std::pow(1 + box.pressure / 6e8, 1 / 4.4), e = (box.pressure + 4.4 * 6e8) / (3.4 * rho);
  for_each_cell(b, [&](int i, int j, int k) {
    const double x = (i + 0.5) * box.cell - box.x, z = (j + 0.5) * box.cell - box.z + 0.5 * std::max(0.0, 1.05 * std::sqrt(2.0) * box.cell - box.thickness) / std::cos(box.angle);
    const CellPart part{-std::sin(box.angle) * x + std::cos(box.angle) * z > 0 ? 1 : 0, 1, rho, e};
    fill_cell<2>(b, i, j, k, std::span(&part, 1));
  });
  b.boundary.normal = {{{0, 0}, {1, 1}, {2, 2}}};
  for (std::size_t side = 0; side < 2; ++side) {
    b.boundary.side[0][side] = {BoundaryKind::symmetry, 0};
    b.boundary.side[1][side] = {BoundaryKind::symmetry, 0};
  }
  scene.blocks.push_back(std::move(b));
  const double half = 1.5 * std::hypot(box.width, box.height);
  LayerInput in;
  in.model = HookeSolid{1e13, 0.3, density};
  in.lines[0] = even_lines(-half, half, 40);
  in.levels = even_lines(-box.thickness / 2, box.thickness / 2, 1);
  Layers<2> l;
  l.stack = make_stack<2>(in);
  for (std::size_t n = 0; n < l.stack.node_count(); ++n) {
    const double x = l.stack.rest[0][n], z = l.stack.rest[1][n];
    l.stack.position[0][n] = box.x + std::cos(box.angle) * x - std::sin(box.angle) * z;
    l.stack.position[1][n] = box.z + std::sin(box.angle) * x + std::cos(box.angle) * z;
  }
  scene.layers.push_back(std::move(l));
  scene.numerics.energy_return = false;
  return scene;
}

void report(const Scene<2>& scene, const char* when, double time) {
  const Block<2>& b = scene.blocks[0];
  double wrong = 0, least = 1e300, most = -1e300, fastest = 0;
  const Grid& g = b.grid;
  for (int j = 0; j < g.cells[1]; ++j) {
    for (int i = 0; i < g.cells[0]; ++i) {
      const int r = g.cell_row(j, 0);
      for (std::size_t d = 0; d < 2; ++d) {
        fastest = std::max(fastest, std::abs(b.velocity[d].row(g.node_row(j, 0))[i]));
      }
      if (b.density.row(r)[i] > 0) {
        least = std::min(least, b.pressure.row(r)[i]);
        most = std::max(most, b.pressure.row(r)[i]);
        const double f0 = b.materials[0].store.row(1, r)[i], f1 = b.materials[1].store.row(1, r)[i];
        wrong += std::min(f0, f1) / (f0 + f1) * b.volume.row(r)[i];
      }
    }
  }
  fmt::print("{} t {:.4g} mixed {:.3e} p {:.5g} .. {:.5g} u {:.4g} layer u {:.6g} {:.6g}\n", when, time, wrong, least, most, fastest, scene.layers[0].stack.velocity[0][20], scene.layers[0].stack.velocity[1][20]);
}

TEST(EmbeddedObliquely, Trial) {
  Box box;
  box.angle = env("ANGLE", 30) * std::numbers::pi / 180;
  box.thickness = env("THICK", 3e-3);
  box.pressure = env("P", 0);
  Scene<2> scene = two_waters(box, env("RHO", 1e6));
  const double v = env("V", 0), along = env("ALONG", 0);
  auto& u = scene.layers[0].stack.velocity;
  for (std::size_t n = 0; n < u[0].size(); ++n) {
    u[0][n] = along * std::cos(box.angle);
    u[1][n] = v + along * std::sin(box.angle);
    u[0][n] -= env("SPIN", 0) * (scene.layers[0].stack.position[1][n] - box.z);
    u[1][n] += env("SPIN", 0) * (scene.layers[0].stack.position[0][n] - box.x);
  }
  scene.embedded.push_back(std::make_shared<Embedding<2>>());
  prepare(scene);
  Clock clock;
  clock.end_time = env("END", 20e-6);
  const Totals first = totals(scene.blocks[0]);
  const int every = static_cast<int>(env("EVERY", 20));
  while (!clock.done()) {
    advance(scene, clock);
    if (clock.step % every == 0) {
      report(scene, "step", clock.time);
    }
  }
  report(scene, "end ", clock.time);
  const Totals last = totals(scene.blocks[0]);
  fmt::print("steps {} dt {:.3g} mass {:.2e} {:.2e} loss {:.3e} given {:.4g} slivers {} {:.3g}\n", clock.step, clock.dt, last.mass[0] / first.mass[0] - 1, last.mass[1] / first.mass[1] - 1, scene.ledger.embedded_given - scene.layers[0].ledger.load_work,
             scene.ledger.embedded_given, scene.ledger.slivers, scene.ledger.sliver_mass);
}

} // namespace
} // namespace ballast
