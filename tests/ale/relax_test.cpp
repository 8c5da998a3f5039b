// Laws of a mesh that relaxes, and of the quality that asks for a remap.
#include "ale/fill.hpp"
#include "ale/mesh_quality.hpp"
#include "ale/phases.hpp"
#include "ale/relax.hpp"
#include "materials/library.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace ballast {
namespace {

using Point = std::array<double, 3>;
using Map = std::function<Point(const Point&)>;

std::vector<double> graded(int cells) {
  std::vector<double> x = {0};
  for (int i = 0; i < cells; ++i) {
    x.push_back(x.back() + std::pow(1.2, i));
  }
  return x;
}

template <int Dim> void for_each_node(const Block<Dim>& b, const std::function<void(int, int, int)>& body) {
  for (int k = 0; k <= (Dim == 3 ? b.grid.cells[2] : 0); ++k) {
    for (int j = 0; j <= b.grid.cells[1]; ++j) {
      for (int i = 0; i <= b.grid.cells[0]; ++i) {
        body(i, j, k);
      }
    }
  }
}

template <int Dim> Point node(const Block<Dim>& b, const std::array<RowField, Dim>& x, int i, int j, int k) {
  Point p{};
  for (std::size_t d = 0; d < Dim; ++d) {
    p[d] = x[d].row(b.grid.node_row(j, k))[i];
  }
  return p;
}

template <int Dim> void move(Block<Dim>& b, std::array<RowField, Dim>& mesh, const Map& map) {
  for_each_node<Dim>(b, [&](int i, int j, int k) {
    const Point to = map(node<Dim>(b, b.home, i, j, k));
    for (std::size_t d = 0; d < Dim; ++d) {
      mesh[d].row(b.grid.node_row(j, k))[i] = to[d];
    }
  });
}

template <int Dim> Block<Dim> relaxing(BoundaryKind lower) {
  Block<Dim> b;
  b.materials.push_back(make_slot(*find_material("copper_ofhc"), 0));
  for (std::size_t d = 0; d < Dim; ++d) {
    b.boundary.side[d] = {{{lower}, {BoundaryKind::free}}};
  }
  allocate_block(b, {graded(6), graded(5), Dim == 3 ? graded(4) : std::vector<double>{}});
  b.motion.policy = MotionPolicy::relax;
  start_motion(b);
  return b;
}

template <int Dim> double farthest(const Block<Dim>& b, const std::array<RowField, Dim>& mesh, const Map& want) {
  double most = 0;
  for_each_node<Dim>(b, [&](int i, int j, int k) {
    const Point x = want(node<Dim>(b, b.home, i, j, k)), y = node<Dim>(b, mesh, i, j, k);
    for (std::size_t d = 0; d < Dim; ++d) {
      most = std::max(most, std::abs(x[d] - y[d]));
    }
  });
  return most;
}

template <int Dim> void leaves_affine_alone() {
  Block<Dim> b = relaxing<Dim>(BoundaryKind::free);
  const Map affine = [](const Point& x) { return Point{1 + 1.3 * x[0] - 0.4 * x[1], 0.5 * x[1] + 0.2 * x[0] + 0.1 * x[2], 2 * x[2] - x[0]}; };
  move<Dim>(b, b.position, affine);
  ThreadPool pool(1);
  place_target(b, pool);
  EXPECT_LT(farthest<Dim>(b, b.target, affine), 1e-13);
}
TEST(Relax, LeavesAMeshStretchedShearedAndTurnedAlone) {
  leaves_affine_alone<2>();
  leaves_affine_alone<3>();
}

TEST(Relax, SmoothsTheInsideAndLeavesTheBoundaryToTheMaterial) {
  Block<2> b = relaxing<2>(BoundaryKind::wall);
  const auto wavy = [](double size) {
    return [size](const Point& x) { return Point{x[0] + size * x[0] * std::sin(7 * x[0] + 5 * x[1]), x[1] + size * x[1] * std::cos(6 * x[0]), 0}; };
  };
  move<2>(b, b.position, wavy(0.03));
  b.motion.sweeps = 2000;
  ThreadPool pool(1);
  place_target(b, pool);
  const Grid& g = b.grid;
  for_each_node<2>(b, [&](int i, int j, int k) {
    const Point was = node<2>(b, b.position, i, j, k), is = node<2>(b, b.target, i, j, k), home = node<2>(b, b.home, i, j, k);
    if (i == g.cells[0] || j == g.cells[1]) {
      EXPECT_EQ(is, was); // free sides
      return;
    }
    if (i == 0) {
      EXPECT_EQ(is[0], was[0]); // along the wall x = 0
    }
    if (j == 0) {
      EXPECT_EQ(is[1], was[1]);
    }
    if (i > 0 && j > 0) { // displacement: the weighted mean of the neighbours'
      for (std::size_t d = 0; d < 2; ++d) {
        const auto u = [&](int di, int dj) { return node<2>(b, b.target, i + di, j + dj, k)[d] - node<2>(b, b.home, i + di, j + dj, k)[d]; };
        const auto mean = [&](int di, int dj) {
          const Point lo = node<2>(b, b.home, i - di, j - dj, k), hi = node<2>(b, b.home, i + di, j + dj, k);
          const double below = home[0] - lo[0] + home[1] - lo[1], above = hi[0] - home[0] + hi[1] - home[1];
          return (above * u(-di, -dj) + below * u(di, dj)) / (above + below);
        };
        EXPECT_NEAR(u(0, 0), 0.5 * (mean(1, 0) + mean(0, 1)), 1e-12);
      }
    }
  });
}

TEST(Relax, AFixedBoundaryIsBackAtHome) {
  Block<2> b = relaxing<2>(BoundaryKind::symmetry);
  b.motion.fixed_boundary = true;
  move<2>(b, b.position, [](const Point& x) { return Point{1.1 * x[0], 1.2 * x[1], 0}; });
  ThreadPool pool(1);
  b.motion.sweeps = 3000;
  place_target(b, pool);
  EXPECT_LT(farthest<2>(b, b.target, [](const Point& x) { return x; }), 1e-12);
  double volume = 0;
  for (int j = 0; j < b.grid.cells[1]; ++j) {
    for (int i = 0; i < b.grid.cells[0]; ++i) {
      volume += b.target_volume.row(b.grid.cell_row(j, 0))[i];
    }
  }
  EXPECT_NEAR(volume, graded(6).back() * graded(5).back(), 1e-12 * volume);
}

// A boundary pulled in across the mesh: the harmonic displacement would turn cells inside out.
TEST(Relax, NodesStayRatherThanTurnACellInsideOut) {
  Block<2> b = relaxing<2>(BoundaryKind::free);
  move<2>(b, b.position, [&](const Point& x) { // a deep notch from the right, the mesh pressed before it
    return Point{x[0] * (1 - 0.97 * std::exp(-std::pow(x[1] - 2.2, 2))), x[1], 0};
  });
  ThreadPool pool(1);
  const double before = mesh_quality<2>(b.grid, b.position, b.home, pool);
  ASSERT_GT(before, 0);
  for (const int sweeps : {1, 10, 1000}) {
    b.motion.sweeps = sweeps;
    place_target(b, pool);
    EXPECT_GT(mesh_quality<2>(b.grid, b.target, b.home, pool), 0.5 * before) << sweeps;
    double moved = 0;
    for_each_node<2>(b, [&](int i, int j, int k) { moved = std::max(moved, std::abs(node<2>(b, b.target, i, j, k)[0] - node<2>(b, b.position, i, j, k)[0])); });
    EXPECT_GT(moved, 0.05) << sweeps; // elsewhere it was smoothed
  }
}

template <int Dim> std::vector<double> thicknesses(const Block<Dim>& b, const std::array<RowField, Dim>& mesh) {
  std::vector<double> all, row(static_cast<std::size_t>(b.grid.cells[0]));
  for (int k = 0; k < b.grid.cells[2]; ++k) {
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      row_thickness<Dim>(b.grid, mesh, j, k, row.data());
      all.insert(all.end(), row.begin(), row.end());
    }
  }
  return all;
}

/// A free side drawn in like a bullet's base: harmonic displacements would press the cells before it to slivers.
template <int Dim> void never_thins() {
  Block<Dim> b = relaxing<Dim>(BoundaryKind::symmetry);
  move<Dim>(b, b.position, [](const Point& x) { return Point{x[0] * (1 - 0.6 * std::exp(-std::pow(x[1] - 3, 2))), x[1], x[2]}; });
  b.motion.sweeps = 200;
  ThreadPool pool(2);
  place_target(b, pool);
  const std::vector<double> home = thicknesses<Dim>(b, b.home), before = thicknesses<Dim>(b, b.position), after = thicknesses<Dim>(b, b.target);
  const double thinnest = *std::min_element(before.begin(), before.end());
  double most = 0;
  for (std::size_t c = 0; c < before.size(); ++c) {
    EXPECT_GE(after[c], std::min({1.5 * thinnest, 0.7 * home[c], before[c] * (1 - 1e-9)})) << c;
    most = std::max(most, after[c] - before[c]);
  }
  EXPECT_GT(most, 0.01 * thinnest); // and mends others
}
TEST(Relax, SmoothingMakesNoThinCellThinner) {
  never_thins<2>();
  never_thins<3>();
}

/// What no smoothing can mend holds nothing: the block's corner, a bullet's rim, turned past 180 degrees, and yet its cell's inner node is smoothed.
TEST(Relax, ACornerOfTheBlockHoldsNoOtherNode) {
  Block<2> b = relaxing<2>(BoundaryKind::symmetry);
  const int n = b.grid.cells[0], m = b.grid.cells[1], row = b.grid.node_row(m, 0), inner = b.grid.node_row(m - 1, 0);
  const double dx = b.home[0].row(row)[n] - b.home[0].row(row)[n - 1], dy = b.home[1].row(row)[n] - b.home[1].row(inner)[n];
  b.position[0].row(row)[n] -= 0.52 * dx;
  b.position[1].row(row)[n] -= 0.52 * dy;
  b.position[0].row(inner)[n - 1] += 0.2 * dx;
  ThreadPool pool(1);
  ASSERT_LT(mesh_quality<2>(b.grid, b.position, b.home, pool), 0);
  place_target(b, pool);
  EXPECT_LT(b.target[0].row(inner)[n - 1], b.position[0].row(inner)[n - 1] - 0.05 * dx);
}

/// Of a box of 3 x 2 (x 5), sheared along its long side: its height.
TEST(MeshQuality, ThicknessIsTheContentByTheLargestSide) {
  Block<2> b = relaxing<2>(BoundaryKind::free);
  double row[6];
  move<2>(b, b.position, [](const Point& x) { return Point{3 * x[0] + x[1], 2 * x[1], 0}; }); // the first cell is a unit square
  row_thickness<2>(b.grid, b.position, 0, 0, row);
  EXPECT_NEAR(row[0], 2, 1e-14);
  Block<3> c = relaxing<3>(BoundaryKind::free);
  move<3>(c, c.position, [](const Point& x) { return Point{3 * x[0] + 7 * x[2], 2 * x[1], 5 * x[2]}; });
  row_thickness<3>(c.grid, c.position, 0, 0, row);
  EXPECT_NEAR(row[0], 30 / std::hypot(2 * 5, 2 * 7), 1e-13); // the largest side is that of the lines y and z
  move<3>(c, c.position, [](const Point& x) { return Point{-x[0], x[1], x[2]}; });
  row_thickness<3>(c.grid, c.position, 0, 0, row);
  EXPECT_NEAR(row[0], -1, 1e-14);
}

template <int Dim> void quality_is(const Map& map, double want) {
  Block<Dim> b = relaxing<Dim>(BoundaryKind::free);
  move<Dim>(b, b.position, map);
  ThreadPool pool(2);
  EXPECT_NEAR(mesh_quality<Dim>(b.grid, b.position, b.home, pool), want, 1e-12);
}
TEST(MeshQuality, IsTheMeanRatioOfTheMapBetweenTwoMeshes) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const Map turned = [&](const Point& x) { return Point{3 * (c * x[0] - s * x[1]) + 1, 3 * (s * x[0] + c * x[1]), 3 * x[2] - 2}; };
  quality_is<2>(turned, 1);
  quality_is<3>(turned, 1);
  const Map stretched = [](const Point& x) { return Point{2 * x[0], x[1], x[2]}; };
  quality_is<2>(stretched, 2 * 2 / (4.0 + 1));
  quality_is<3>(stretched, 3 * std::cbrt(4.0) / (4.0 + 2));
  const Map sheared = [](const Point& x) { return Point{x[0] + 2 * x[1], x[1], x[2]}; };
  quality_is<2>(sheared, 2 / (2 + 4.0));
  quality_is<3>(sheared, 3 / (3 + 4.0));
  const Map mirrored = [](const Point& x) { return Point{-x[0], x[1], x[2]}; };
  quality_is<2>(mirrored, -1);
  quality_is<3>(mirrored, -1);
}

TEST(RemapDue, ByQualityOfTheMeshSinceTheLastRemap) {
  Block<2> b = relaxing<2>(BoundaryKind::free);
  ThreadPool pool(1);
  b.motion.remap_quality = 0.75;
  move<2>(b, b.position, [](const Point& x) { return Point{2 * x[0], x[1], 0}; });
  EXPECT_FALSE(remap_due(b, 0, pool)); // 0.8
  b.motion.remap_quality = 0.85;
  EXPECT_TRUE(remap_due(b, 0, pool));
  b.target = b.position;
  EXPECT_FALSE(remap_due(b, 0, pool));
  b.motion.remap_quality = 0;
  b.motion.remap_every = 3;
  EXPECT_FALSE(remap_due(b, 1, pool));
  EXPECT_TRUE(remap_due(b, 2, pool));
}

} // namespace
} // namespace ballast
