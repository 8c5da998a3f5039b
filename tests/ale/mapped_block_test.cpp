// Laws of blocks that start on curvilinear meshes: masses at nodes, falling evenly, planes of symmetry that are no grid axis.
#include "ale/fill.hpp"
#include "ale/simulation.hpp"
#include "core/hex_geometry.hpp"

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

std::vector<double> uniform(double from, double to, int cells) {
  std::vector<double> x;
  for (int i = 0; i <= cells; ++i) {
    x.push_back(from + (to - from) * i / cells);
  }
  return x;
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

} // namespace
} // namespace ballast
