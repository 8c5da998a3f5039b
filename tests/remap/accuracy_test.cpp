// How good a remap is: how fast its error falls, what shapes, extrema and mirror images keep.
#include "tests/remap/mesh_motions.hpp"

#include <gtest/gtest.h>
#include <functional>
#include <numbers>
#include <random>

namespace ballast::remap {
namespace {

using std::numbers::pi;

/// A motion of the unit box's inside, `part` from 0 to 1 and back; the sides keep their places.
template <int Dim> using Motion = std::function<Point<Dim>(const Point<Dim>&, double part)>;

template <int Dim> Motion<Dim> turning() {
  return [](const Point<Dim>& x, double part) { return whirl<Dim>(part)(x); };
}
/// Sheared along x by what vanishes at the sides.
template <int Dim> Motion<Dim> shearing() {
  return [](Point<Dim> x, double part) {
    double w = 0.25 * part;
    for (const double q : x) {
      w *= std::sin(pi * q);
    }
    x[0] += w * std::cos(pi * x[1]);
    return x;
  };
}
/// A sum of waves with amplitudes by lot, the same on every mesh.
template <int Dim> Motion<Dim> wandering() {
  return [](const Point<Dim>& x, double part) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> amount(-0.02, 0.02);
    Point<Dim> out = x;
    for (std::size_t d = 0; d < Dim; ++d) {
      for (int a = 1; a <= 3; ++a) {
        for (int b = 1; b <= 3; ++b) {
          double w = amount(random) * part;
          for (std::size_t q = 0; q < Dim; ++q) {
            w *= std::sin(pi * (q == 0 ? a : b) * x[q]);
          }
          out[d] += w;
        }
      }
    }
    return out;
  };
}

constexpr int moves_a_cell = 2; // of the mesh, for a whole cycle: moves_a_cell * n

/// Mean error of density and velocity after a cyclic motion on n cells an axis, remapped every so many moves.
template <int Dim> std::array<double, 2> cyclic_error(const Motion<Dim>& motion, int n, int every) {
  const std::array<int, 3> cells = {n, n, Dim == 3 ? n : 1};
  RemapBox<Dim> box({.cells = cells}), start({.cells = cells});
  ThreadPool pool(1);
  const auto bump = [](const Point<Dim>& x) { return 2 + std::cos(2 * pi * x[0]) * std::cos(2 * pi * x[1]); };
  const auto swirl = [](const Point<Dim>& x) {
    Point<Dim> u{};
    u[0] = std::sin(pi * x[0]) * std::cos(pi * x[1]);
    return u;
  };
  for (RemapBox<Dim>* b : {&box, &start}) {
    fill_smooth<Dim>(*b, bump, [](const auto&) { return 1.0; }, swirl);
  }
  const int moves = moves_a_cell * n;
  for (int s = every; s <= moves; s += every) {
    const double part = 0.5 * (1 - std::cos(2 * pi * s / moves));
    box.move_to([&](const Point<Dim>& x) { return motion(x, part); }, {.limit = false}, pool, s / every);
  }
  std::array<double, 2> error{};
  box.for_each_cell([&](int i, int j, int k) { error[0] += std::abs(box.density(0, i, j, k) - start.density(0, i, j, k)) * std::pow(n, -Dim); });
  box.for_each_node([&](int i, int j, int k) {
    const int r = box.grid.node_row(j, k);
    error[1] += std::abs(box.velocity[0].row(r)[i] - start.velocity[0].row(r)[i]) * std::pow(n, -Dim);
  });
  return error;
}

template <int Dim> void expect_second_order(const Motion<Dim>& motion, int n, const std::vector<int>& intervals, const char* name) {
  for (const int every : intervals) {
    const auto coarse = cyclic_error<Dim>(motion, n, every), fine = cyclic_error<Dim>(motion, 2 * n, every);
    for (std::size_t q = 0; q < 2; ++q) {
      EXPECT_GE(std::log2(coarse[q] / fine[q]), 1.8) << name << ", every " << every << ", " << (q == 0 ? "density" : "velocity") << ": " << coarse[q] << " " << fine[q];
    }
  }
}

TEST(Remap, IsSecondOrderOnSmoothMotionsHoweverFarApart) {
  expect_second_order<2>(turning<2>(), 32, {1, 2, 4, 8, 16, 32}, "turning");
  expect_second_order<2>(shearing<2>(), 32, {1, 4, 32}, "shearing");
  expect_second_order<2>(wandering<2>(), 32, {1, 4, 32}, "wandering");
  expect_second_order<3>(turning<3>(), 12, {1, 4}, "turning, 3D"); // few remaps in all are not enough for an order: 8 takes 24 cells
  expect_second_order<3>(shearing<3>(), 16, {16}, "shearing, 3D");
  expect_second_order<3>(wandering<3>(), 16, {16}, "wandering, 3D");
}

TEST(Remap, MakesNoNewExtrema) {
  RemapBox<2> box({.cells = {24, 24, 1}});
  ThreadPool pool(1);
  const auto step = [](const Point<2>& x) { return x[0] + 0.3 * x[1] > 0.6 ? 1.0 : 10.0; };
  fill_smooth<2>(box, step, step, [&](const Point<2>& x) { return Point<2>{step(x), -step(x)}; });
  for (int n = 1; n <= 10; ++n) {
    box.move_to(whirl<2>(0.1 * n), {.return_kinetic = false}, pool, n);
  }
  box.for_each_cell([&](int i, int j, int k) {
    for (const double q : {box.density(0, i, j, k), box.energy(0, i, j, k)}) {
      EXPECT_GE(q, 1 - 1e-12);
      EXPECT_LE(q, 10 + 1e-12);
    }
  });
  box.for_each_node([&](int i, int j, int k) {
    const double u = box.velocity[0].row(box.grid.node_row(j, k))[i];
    EXPECT_GE(u, 1 - 1e-12);
    EXPECT_LE(u, 10 + 1e-12);
  });
}

// The M80's way through void in small: a disc, 16 cells across, ten diameters on. The mesh moves away under
// it and comes back a step at a time: every face passes the same volume.
TEST(Remap, CarriesDiscTenDiametersThroughVoid) {
  constexpr int across = 16, steps = 400;
  RemapBox<2> box({.cells = {12 * across, 5 * across, 1}, .high = {12, 5, 1}, .has_void = true, .boundary = BoundaryKind::free});
  const auto inside = [&](int i, int j, double cx, double cy) {
    int count = 0;
    constexpr int samples = 32;
    for (int s = 0; s < samples * samples; ++s) {
      const double x = box.line(0, i) + (s % samples + 0.5) / samples / across - cx;
      const double y = box.line(1, j) + (s / samples + 0.5) / samples / across - cy;
      count += x * x + y * y < 0.25;
    }
    return count / static_cast<double>(samples * samples);
  };
  box.for_each_cell([&](int i, int j, int k) {
    const double f = inside(i, j, 1, 1.25);
    box.fill(0, i, j, k, f, 3, 1);
    box.fill(1, i, j, k, 1 - f, 0, 0);
  });
  box.update_node_mass();
  const Point<2> u = {3, 0.75};
  box.set_velocity([&](const auto&) { return u; });
  const RowField volume = box.volume;
  const BoxTotals before = box.totals();
  ThreadPool pool(1);
  Mesh<2> mesh = box.mesh();
  Report report;
  const double h = 1.0 / across;
  for (int n = 0; n < steps; ++n) {
    for (int j = 0; j <= box.grid.cells[1]; ++j) {
      for (int i = 0; i <= box.grid.cells[0]; ++i) {
        box.swept[0].row(box.grid.cell_row(j, 0))[i] = j < box.grid.cells[1] ? -10.0 / steps * h : 0;
        box.swept[1].row(box.grid.cell_row(j, 0))[i] = i < box.grid.cells[0] ? -2.5 / steps * h : 0;
      }
    }
    sweep_all(mesh, {}, pool, n, report);
    box.volume = volume;
    box.update_node_mass();
    box.for_each_node([&](int i, int j, int k) { // bare nodes rest in the code; here they keep the speed
      const int r = box.grid.node_row(j, k);
      for (std::size_t d = 0; d < 2; ++d) {
        double& v = box.velocity[d].row(r)[i];
        v = box.node_mass.row(r)[i] > 0 ? v : 0;
        // Round-off of the momentum that passes (a cell's) over the little mass that stays.
        const double mass = box.node_mass.row(r)[i];
        EXPECT_NEAR(v, mass > 0 ? u[d] : 0, u[d] * (1e-13 + 2e-15 * 3 * h * h / std::max(mass, 1e-300))) << n << " " << mass;
      }
    });
    if (HasFailure()) {
      return;
    }
  }
  const BoxTotals after = box.totals();
  EXPECT_NEAR(after.mass[0] + report.sliver_mass, before.mass[0], 1e-13 * before.mass[0]);
  EXPECT_NEAR(after.momentum[0], u[0] * before.mass[0], 1e-12 * before.mass[0]);
  double error = 0, sum = 0;
  box.for_each_cell([&](int i, int j, int k) {
    error += std::abs(box.fraction(0, i, j, k) - inside(i, j, 11, 3.75));
    sum += box.fraction(0, i, j, k);
  });
  RecordProperty("shape_error", std::to_string(error / sum));
  RecordProperty("sliver_mass", std::to_string(report.sliver_mass / before.mass[0]));
  std::printf("shape error %.3e, slivers %ld of mass %.1e\n", error / sum, report.slivers, report.sliver_mass / before.mass[0]);
  EXPECT_LT(error / sum, 2e-2); // 16 cells across: a few hundredths of a cell around the rim
}

TEST(Remap, MirroredProblemGivesMirroredAnswer) {
  const auto make = [](bool mirror) {
    RemapBox<2> box({.cells = {16, 16, 1}, .low = {-0.5, 0, 0}, .high = {0.5, 1, 1}, .materials = 2});
    const auto flip = [mirror](Point<2> x) { return Point<2>{mirror ? -x[0] : x[0], x[1]}; };
    box.for_each_cell([&](int i, int j, int k) {
      const Point<2> x = flip(box.centre(i, j, k));
      const double f = std::clamp((0.3 - std::hypot(x[0] + 0.1, x[1] - 0.5)) / 0.06, 0.0, 1.0);
      box.fill(0, i, j, k, f, 8 + x[0], 2 + x[1]);
      box.fill(1, i, j, k, 1 - f, 1 - 0.3 * x[1], 5 - x[0]);
    });
    box.update_node_mass();
    box.set_velocity([&](const Point<2>& x) { return Point<2>{(mirror ? -1 : 1) * std::sin(3 * flip(x)[0]) * 0.2, x[1]}; });
    ThreadPool pool(1);
    const auto motion = [&](const Point<2>& x) {
      Point<2> y = flip(x);
      const double w = 0.6 * (1 - 4 * y[0] * y[0]) * 4 * y[1] * (1 - y[1]), a = y[0], b = y[1] - 0.5;
      y[0] += (std::cos(w) - 1) * a - std::sin(w) * b;
      y[1] += std::sin(w) * a + (std::cos(w) - 1) * b;
      return flip(y);
    };
    box.move_to(motion, {}, pool, 0);
    box.move_to([](const auto& x) { return x; }, {}, pool, 1);
    return box;
  };
  const RemapBox<2> a = make(false), b = make(true);
  // Nodes mirror to the bit, sums over a cell's two sides to round-off, which
  // the normals' difference quotients (step 1e-7) amplify.
  a.for_each_cell([&](int i, int j, int k) {
    EXPECT_NEAR(a.fraction(0, i, j, k), b.fraction(0, 15 - i, j, k), 1e-9);
    EXPECT_NEAR(a.stores[1].row(1, a.grid.cell_row(j, k))[i], b.stores[1].row(1, a.grid.cell_row(j, k))[15 - i], 1e-11);
  });
  a.for_each_node([&](int i, int j, int k) {
    const int r = a.grid.node_row(j, k);
    EXPECT_NEAR(a.velocity[0].row(r)[i], -b.velocity[0].row(r)[16 - i], 1e-9);
  });
}

} // namespace
} // namespace ballast::remap
