// Laws of blocks that start on curvilinear meshes: masses at nodes, falling evenly, planes of symmetry that are no grid axis.
#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "ale/relax.hpp"
#include "ale/simulation.hpp"
#include "core/hex_geometry.hpp"
#include "tests/uniform_lines.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace ballast {
namespace {

constexpr double right = 0.5 * std::numbers::pi;

Material gas() {
  Material m;
  m.name = "gas";
  m.density = 1;
  return m;
}

/// Gas of density 1 and pressure p(x, y) at the cells' middles on a mapped mesh.
template <class Pressure> Block<2> block_on(const MeshMap& map, bool rz, const std::array<std::vector<double>, 3>& lines, Pressure&& p) {
  Block<2> b;
  b.axisymmetric = rz;
  b.map = map;
  b.motion.policy = MotionPolicy::lagrangian;
  b.materials.push_back(make_slot(gas(), 0));
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int) {
    const int low = b.grid.node_row(j, 0), high = b.grid.node_row(j + 1, 0);
    const auto corners = [&](const RowField& f) { return std::array<double, 4>{f.row(low)[i], f.row(low)[i + 1], f.row(high)[i + 1], f.row(high)[i]}; };
    fill_cell<2>(b, i, j, 0, std::vector<CellPart>{{0, 1, 1, energy(gas().eos, 1, p(corners(b.position[0]), corners(b.position[1])))}});
  });
  ThreadPool pool(1);
  compute_node_mass(b, pool);
  update_state(b, pool);
  return b;
}

Block<2> sector(int n) {
  // Pressure 3 - z, its mean over the cell's ring.
  const auto mean = [](const std::array<double, 4>& r, const std::array<double, 4>& z) {
    double weight = 0, sum = 0;
    constexpr double g[2] = {0.21132486540518713, 0.7886751345948129};
    for (const double s : g) {
      for (const double t : g) {
        const double w[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
        double rr = 0, zz = 0;
        for (std::size_t c = 0; c < 4; ++c) {
          rr += w[c] * r[c];
          zz += w[c] * z[c];
        }
        const double rs = (1 - t) * (r[1] - r[0]) + t * (r[2] - r[3]), rt = (1 - s) * (r[3] - r[0]) + s * (r[2] - r[1]);
        const double zs = (1 - t) * (z[1] - z[0]) + t * (z[2] - z[3]), zt = (1 - s) * (z[3] - z[0]) + s * (z[2] - z[1]);
        weight += rr * (rs * zt - rt * zs);
        sum += zz * rr * (rs * zt - rt * zs);
      }
    }
    return 3 - sum / weight;
  };
  return block_on({MapKind::spherical, {0, 0, 0}, 0}, true, {uniform(0, 2 * right, 2 * n), uniform(0.5, 1, n), {}}, mean);
}

/// A body force of one size everywhere moves all nodes alike: M_p = integral of N_p rho dV, by quadrature, axis and poles included.
TEST(MappedBlock, NodesOfASphericalSectorHaveTheMassesOfAUniformForce) {
  const int n = 6;
  const Block<2> b = sector(n);
  RowField want = RowField::of_nodes(b.grid);
  constexpr double x[3] = {-0.7745966692414834, 0, 0.7745966692414834}, w[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for_each_cell(b, [&](int i, int j, int) {
    const int rows[2] = {b.grid.node_row(j, 0), b.grid.node_row(j + 1, 0)};
    for (int q = 0; q < 9; ++q) {
      const double s = 0.5 + 0.5 * x[q % 3], t = 0.5 + 0.5 * x[q / 3];
      double r = 0, ds[2] = {0, 0}, dt[2] = {0, 0};
      for (int c = 0; c < 4; ++c) {
        const double shape_s = c & 1 ? s : 1 - s, shape_t = c & 2 ? t : 1 - t;
        for (std::size_t d = 0; d < 2; ++d) {
          const double at = b.position[d].row(rows[c >> 1])[i + (c & 1)];
          r += d == 0 ? shape_s * shape_t * at : 0.0;
          ds[d] += (c & 1 ? 1 : -1) * shape_t * at;
          dt[d] += (c & 2 ? 1 : -1) * shape_s * at;
        }
      }
      const double dv = 2 * std::numbers::pi * r * (ds[0] * dt[1] - ds[1] * dt[0]) * w[q % 3] * w[q / 3] / 4;
      for (int c = 0; c < 4; ++c) {
        want.row(rows[c >> 1])[i + (c & 1)] += dv * (c & 1 ? s : 1 - s) * (c & 2 ? t : 1 - t);
      }
    }
  });
  for (int j = 0; j <= n; ++j) {
    const int r = b.grid.node_row(j, 0);
    for (int i = 0; i <= 2 * n; ++i) {
      EXPECT_NEAR(b.node_mass.row(r)[i] / want.row(r)[i], 1, 1e-12) << i << " " << j;
    }
  }
}

struct Fall {
  double worst = 0, on_axis = 0, radial = 0;
};

/// Errors of the acceleration under p = 3 - z (exact: 0, 1), nodes of the free surfaces left out.
Fall fall_of(int n) {
  Scene<2> scene;
  scene.blocks.push_back(sector(n));
  Block<2>& b = scene.blocks[0];
  b.boundary.side[1] = {BoundarySide{BoundaryKind::free}, BoundarySide{BoundaryKind::free}};
  prepare(scene);
  Clock clock;
  clock.end_time = 1e-9;
  run(scene, clock);
  Fall out;
  for (int j = 1; j < n; ++j) {
    const int r = b.grid.node_row(j, 0);
    for (int i = 0; i <= 2 * n; ++i) {
      const double axial = std::abs(b.velocity[1].row(r)[i] / clock.time - 1);
      out.worst = std::max(out.worst, axial);
      out.on_axis = std::max(out.on_axis, i == 0 || i == 2 * n ? axial : 0.0);
      out.radial = std::max(out.radial, std::abs(b.velocity[0].row(r)[i] / clock.time));
    }
  }
  return out;
}

/// Second order along the axis at every node, those on the axis no worse; across it first order where r is of the size of a cell (hoop
/// forces of cells whose pressures differ are divided by masses that vanish there).
TEST(MappedBlock, SphericalSectorFallsEvenlyUnderALinearPressure) {
  const Fall coarse = fall_of(8), fine = fall_of(16);
  EXPECT_LT(fine.worst, 0.3 * coarse.worst);
  EXPECT_LT(fine.on_axis, 0.3 * coarse.on_axis);
  EXPECT_LT(fine.radial, 0.7 * coarse.radial);
}

/// Gas that streams through a mesh at rest, open all round but at the axis of an axisymmetric one, at the pressure beyond.
template <int Dim> void streams(const MeshMap& map, bool rz, const std::array<std::vector<double>, 3>& lines, int remap_every) {
  Scene<Dim> scene;
  Block<Dim> b;
  b.axisymmetric = rz;
  b.map = map;
  b.motion = {MotionPolicy::eulerian, remap_every};
  b.materials.push_back(make_slot(gas(), 0));
  b.reference_pressure = pressure(gas().eos, 1, 1.0);
  b.materials[0].reference = {1, 1.0, b.reference_pressure, 0.0};
  allocate_block(b, lines);
  for_each_cell(b, [&](int i, int j, int k) { fill_cell<Dim>(b, i, j, k, std::vector<CellPart>{{0, 1, 1, 1.0}}); });
  const std::array<double, 3> u = {rz ? 0 : 0.4, -0.3, 0.2};
  set_velocity(b, [&](const std::array<double, Dim>&, std::array<double, Dim>& v) { std::copy(u.begin(), u.begin() + Dim, v.begin()); });
  for (std::size_t a = 0; a < Dim; ++a) {
    for (int side = 0; side < 2; ++side) {
      const bool axis = rz && b.boundary.normal_of(static_cast<int>(a), side) == 0;
      b.boundary.side[a][static_cast<std::size_t>(side)].kind = axis ? BoundaryKind::symmetry : BoundaryKind::free;
    }
  }
  scene.blocks.push_back(std::move(b));
  prepare(scene);
  Clock clock;
  clock.end_time = 1;
  for (int step = 0; step < 24; ++step) {
    advance(scene, clock);
  }
  const Block<Dim>& done = scene.blocks[0];
  double worst = 0;
  for_each_cell(done, [&](int i, int j, int k) {
    const int r = done.grid.cell_row(j, k);
    worst = std::max({worst, std::abs(done.density.row(r)[i] - 1), std::abs(done.materials[0].store.row(field::energy, r)[i] - 1)});
    for (std::size_t d = 0; d < Dim; ++d) {
      worst = std::max(worst, std::abs(done.velocity[d].row(done.grid.node_row(j, k))[i] - u[d]));
    }
  });
  EXPECT_GT(clock.time, 0.01);
  EXPECT_LT(worst, 1e-12);
}

TEST(MappedBlock, UniformFlowThroughAMeshAtRestStaysUniform) {
  for (const int every : {1, 3}) {
    streams<2>({MapKind::polar, {0.1, 0, 0}, 0}, false, {uniform(0.3, 1, 7), uniform(0.2, 1.9, 9), {}}, every);
    streams<2>({MapKind::disc, {0, 0, 0}, 1}, false, {uniform(-1, 1, 12), uniform(-1, 1, 12), {}}, every);
    streams<2>({MapKind::spherical, {0, 0, 0}, 0}, true, {uniform(0, 2 * right, 12), uniform(0.3, 1, 7), {}}, every);
    streams<2>({MapKind::ball_section, {0, 0, 0}, 1}, true, {uniform(0, 1, 6), uniform(-1, 1, 12), {}}, every);
    const std::vector<std::array<double, 2>> outline = {{0, 1}, {0.4, 0.9}, {1, 0.4}};
    streams<2>({MapKind::turned_section, {0, 0, 0}, 0, outline}, true, {uniform(0, 1, 6), uniform(0, 1, 9), {}}, every);
    streams<3>({MapKind::turned, {0, 0, 0}, 0, outline}, false, {uniform(-1, 1, 8), uniform(-1, 1, 8), uniform(0, 1, 6)}, every);
    streams<3>({MapKind::cylindrical, {0, 0, 0}, 0}, false, {uniform(0.3, 1, 5), uniform(0.2, 1.9, 7), uniform(0, 1, 5)}, every);
    streams<3>({MapKind::rod, {0, 0, 0}, 1}, false, {uniform(-1, 1, 8), uniform(-1, 1, 8), uniform(0, 1, 4)}, every);
    streams<3>({MapKind::ball, {0, 0, 0}, 1}, false, {uniform(-1, 1, 8), uniform(-1, 1, 8), uniform(-1, 1, 8)}, every);
  }
}

/// Gas of random pressures in a quarter between planes of symmetry that are y = 0 and x = 0, not the grid's axes.
void stays_between_planes(const MeshMap& map, bool rz, const std::array<std::vector<double>, 3>& lines, MotionPolicy motion) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(0.5, 1.5);
  Scene<2> scene;
  scene.blocks.push_back(block_on(map, rz, lines, [&](const auto&, const auto&) { return some(random); }));
  Block<2>& b = scene.blocks[0];
  b.motion.policy = motion;
  b.boundary.side[rz ? 1 : 0] = {BoundarySide{BoundaryKind::free}, BoundarySide{BoundaryKind::free}};
  prepare(scene);
  Clock clock;
  clock.end_time = 1;
  const Totals start = totals(b);
  for (int step = 0; step < 30; ++step) {
    advance(scene, clock);
  }
  const int along = rz ? 1 : 0; // the grid's axis that is the radius
  double sliding = 0;
  for (int q = 0; q <= b.grid.cells[static_cast<std::size_t>(along)]; ++q) {
    for (int side = 0; side < 2; ++side) {
      const int end = side == 0 ? 0 : b.grid.cells[static_cast<std::size_t>(1 - along)];
      const int r = b.grid.node_row(rz ? q : end, 0), i = rz ? end : q;
      const auto normal = static_cast<std::size_t>(b.boundary.normal_of(1 - along, side));
      EXPECT_EQ(b.velocity[normal].row(r)[i], 0);
      EXPECT_EQ(b.position[normal].row(r)[i], 0);
      sliding = std::max(sliding, std::abs(b.velocity[1 - normal].row(r)[i]));
    }
  }
  EXPECT_GT(sliding, 0.01);
  const Totals end = totals(b);
  for (std::size_t d = rz ? 1 : 0; d < 2; ++d) { // hoop forces make radial momentum
    EXPECT_NEAR(end.momentum[d] + scene.ledger.momentum_out[d], start.momentum[d], 1e-13);
  }
  EXPECT_NEAR(end.mass[0] + scene.ledger.mass_out[0], start.mass[0], 1e-13 * start.mass[0]);
}

TEST(MappedBlock, PlanesOfSymmetryHoldTheirOwnComponent) {
  for (const MotionPolicy motion : {MotionPolicy::lagrangian, MotionPolicy::eulerian}) {
    stays_between_planes({MapKind::polar, {0, 0, 0}, 0}, false, {uniform(0.5, 1, 6), uniform(0, right, 8), {}}, motion);
    stays_between_planes({MapKind::spherical, {0, 0, 0}, 0}, true, {uniform(0, right, 8), uniform(0.5, 1, 6), {}}, motion);
  }
}

/// A sector whose radii shrink in proportion to how far they are from the outer one is harmonic in the radius: no node goes elsewhere.
TEST(MappedBlock, RelaxLeavesAContractionOfASectorAlone) {
  for (const MapKind kind : {MapKind::polar, MapKind::spherical}) {
    const bool rz = kind == MapKind::spherical;
    const MeshMap map{kind, {0, 0.2, 0}, 0};
    const std::vector<double> radii = uniform(0.5, 1, 8), angles = uniform(0, right, 5);
    Block<2> b = block_on(map, rz, rz ? std::array<std::vector<double>, 3>{angles, radii, {}} : std::array<std::vector<double>, 3>{radii, angles, {}},
                          [](const auto&, const auto&) { return 1.0; });
    b.motion.policy = MotionPolicy::relax;
    b.boundary.side[rz ? 1 : 0] = {BoundarySide{BoundaryKind::free}, BoundarySide{BoundaryKind::free}};
    start_motion(b);
    for (int j = 0; j <= b.grid.cells[1]; ++j) {
      const int r = b.grid.node_row(j, 0);
      for (int i = 0; i <= b.grid.cells[0]; ++i) {
        double &x = b.position[0].row(r)[i], &y = b.position[1].row(r)[i];
        const double radius = std::hypot(x, y - 0.2), part = 1 - 0.4 * (1 - radius) / radius;
        x *= part;
        y = 0.2 + part * (y - 0.2);
      }
    }
    ThreadPool pool(1);
    relax_target(b, pool);
    for (int j = 0; j <= b.grid.cells[1]; ++j) {
      const int r = b.grid.node_row(j, 0);
      for (int i = 0; i <= b.grid.cells[0]; ++i) {
        EXPECT_NEAR(b.target[0].row(r)[i], b.position[0].row(r)[i], 1e-14);
        EXPECT_NEAR(b.target[1].row(r)[i], b.position[1].row(r)[i], 1e-14);
      }
    }
    const int first = b.grid.node_row(0, 0); // the plane that starts at angle 0
    EXPECT_EQ(b.target[rz ? 0 : 1].row(first)[0], rz ? 0 : 0.2);
  }
}

/// Ghost nodes beyond a plane are its mirror images: u = x on the quarter goes on as x beyond x = 0 and y = 0.
TEST(MappedBlock, GhostNodesMirrorAcrossThePlane) {
  Block<2> b = block_on({MapKind::polar, {0, 0, 0}, 0}, false, {uniform(0.5, 1, 4), uniform(0, right, 4), {}}, [](const auto&, const auto&) { return 1.0; });
  set_velocity(b, [](const std::array<double, 2>& x, std::array<double, 2>& u) { u = x; });
  const int n = b.grid.cells[1];
  for (int d = 0; d < 2; ++d) {
    exchange_nodes(b.grid, b.boundary, d, b.velocity[static_cast<std::size_t>(d)]);
    for (int q = 1; q <= 2; ++q) {
      const double* u = b.velocity[static_cast<std::size_t>(d)].row(b.grid.node_row(-q, 0));
      const double* v = b.velocity[static_cast<std::size_t>(d)].row(b.grid.node_row(n + q, 0));
      for (int i = 0; i <= 4; ++i) {
        const double radius = 0.5 + 0.125 * i, low = -q * right / 4, high = right + q * right / 4;
        EXPECT_NEAR(u[i], radius * (d == 0 ? std::cos(low) : std::sin(low)), 1e-15);
        EXPECT_NEAR(v[i], radius * (d == 0 ? std::cos(high) : std::sin(high)), 1e-15);
      }
    }
  }
}

} // namespace
} // namespace ballast
