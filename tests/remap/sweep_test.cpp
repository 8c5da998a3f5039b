// Laws of a remap: what it must leave alone, what it must conserve, how fast its error falls.
#include "tests/remap/remap_box.hpp"

#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace ballast::remap {
namespace {

using std::numbers::pi;

template <int Dim> using Map = std::function<Point<Dim>(const Point<Dim>&)>;
template <int Dim> using Field = std::function<double(const Point<Dim>&)>;

/// One material everywhere: density and energy at the cells' centres, velocity at the nodes.
template <int Dim>
void fill_smooth(RemapBox<Dim>& box, const Field<Dim>& rho, const Field<Dim>& e, const Map<Dim>& u) {
  box.for_each_cell([&](int i, int j, int k) {
    const Point<Dim> x = box.centre(i, j, k);
    box.fill(0, i, j, k, 1, rho(x), e(x));
  });
  box.update_node_mass();
  box.set_velocity(u);
}

/// Interior nodes moved by `size` of a cell at random; bitwise the same for the same seed.
template <int Dim> Map<Dim> random_nodes(const RemapBox<Dim>& box, double size) {
  const BoxShape s = box.shape;
  return [s, size](const Point<Dim>& x) {
    Point<Dim> out = x;
    std::size_t seed = 17;
    bool inside = true;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double h = (s.high[d] - s.low[d]) / s.cells[d];
      seed = seed * 1000003 + static_cast<std::size_t>(std::lround((x[d] - s.low[d]) / h) + 4);
      inside = inside && x[d] > s.low[d] + 0.5 * h && x[d] < s.high[d] - 0.5 * h;
    }
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> amount(-size, size);
    for (std::size_t d = 0; d < Dim && inside; ++d) {
      out[d] += amount(random) * (s.high[d] - s.low[d]) / s.cells[d];
    }
    return out;
  };
}

/// A whirl about the box's middle in the first two axes that leaves the boundary alone.
template <int Dim> Map<Dim> whirl(double angle) {
  return [angle](const Point<Dim>& x) {
    Point<Dim> out = x;
    double w = angle;
    for (const double q : x) {
      w *= 4 * q * (1 - q);
    }
    const double a = x[0] - 0.5, b = x[1] - 0.5;
    out[0] += (std::cos(w) - 1) * a - std::sin(w) * b;
    out[1] += std::sin(w) * a + (std::cos(w) - 1) * b;
    return out;
  };
}

template <int Dim> Map<Dim> moved(double dx, double dy) {
  return [=](Point<Dim> x) {
    x[0] += dx;
    x[1] += dy;
    return x;
  };
}

constexpr std::array<int, 3> cells_of(int dim, int n) {
  return {n, n + 2, dim == 3 ? n - 1 : 1};
}

template <int Dim> void expect_uniform(bool axisymmetric, BoundaryKind boundary, const Map<Dim>& motion, bool random) {
  RemapBox<Dim> box({.cells = cells_of(Dim, 10), .axisymmetric = axisymmetric, .boundary = boundary});
  ThreadPool pool(1);
  fill_smooth<Dim>(box, [](const auto&) { return 2.0; }, [](const auto&) { return 3.0; },
                   [](const auto&) { Point<Dim> u; u.fill(0.7); return u; });
  for (int n = 0; n < 4; ++n) {
    const Map<Dim> map = random ? random_nodes(box, 0.3) : motion;
    box.move_to(n % 2 == 0 ? map : [](const Point<Dim>& x) { return x; }, {}, pool, n);
  }
  box.move_to(random ? random_nodes(box, 0.3) : motion, {}, pool, 0);
  const RowField swept = box.volume;
  box.update_volumes();
  // A swept volume is a sum of coordinate (up to 2) times a face's area, 0.01: a few hundred
  // such terms over all remaps.
  box.for_each_cell([&](int i, int j, int k) {
    const int r = box.grid.cell_row(j, k);
    EXPECT_NEAR(swept.row(r)[i], box.volume.row(r)[i], 1e-15 + 1e-13 * box.volume.row(r)[i]);
    EXPECT_NEAR(box.density(0, i, j, k), 2, 2 * (2e-13 + 1e-15 / box.volume.row(r)[i]));
    EXPECT_EQ(box.energy(0, i, j, k), 3);
  });
  box.for_each_node([&](int i, int j, int k) {
    for (std::size_t d = 0; d < Dim; ++d) {
      EXPECT_EQ(box.velocity[d].row(box.grid.node_row(j, k))[i], 0.7);
    }
  });
}

TEST(Remap, LeavesUniformStateUnderRandomMotion) {
  expect_uniform<2>(false, BoundaryKind::symmetry, {}, true);
  expect_uniform<2>(true, BoundaryKind::symmetry, {}, true);
  expect_uniform<3>(false, BoundaryKind::symmetry, {}, true);
}

TEST(Remap, LeavesUniformStateUnderLargeWhirl) {
  expect_uniform<2>(false, BoundaryKind::symmetry, whirl<2>(1.0), false);
  expect_uniform<2>(true, BoundaryKind::symmetry, whirl<2>(1.0), false);
  expect_uniform<3>(false, BoundaryKind::symmetry, whirl<3>(1.0), false);
}

TEST(Remap, LeavesUniformStateUnderShearAndTranslationThroughOpenSides) {
  const auto shear2 = [](Point<2> x) { x[0] += 0.4 * x[1] + 0.2; return x; };
  const auto shear3 = [](Point<3> x) { x[0] += 0.4 * x[1] - 0.3 * x[2]; x[2] += 0.2; return x; };
  expect_uniform<2>(false, BoundaryKind::outflow, shear2, false);
  expect_uniform<3>(false, BoundaryKind::outflow, shear3, false);
  expect_uniform<2>(true, BoundaryKind::outflow, [](Point<2> x) { x[1] += 0.4 * x[0] + 0.2; return x; }, false);
}

/// Largest error of a linear density and a linear velocity (at uniform density) after one affine motion,
/// over cells and nodes at least `margin` from the box's sides.
template <int Dim> std::array<double, 2> linear_error(const Map<Dim>& motion, int margin) {
  const auto linear = [](const Point<Dim>& x) { return 3 + x[0] - 0.5 * x[1] + (Dim == 3 ? 0.7 * x[Dim - 1] : 0.0); };
  std::array<double, 2> worst{};
  ThreadPool pool(1);
  const auto inner = [&](const Grid& g, int i, int j, int k, int extra) {
    return i >= margin && i < g.cells[0] + extra - margin && j >= margin && j < g.cells[1] + extra - margin &&
           (Dim == 2 || (k >= margin && k < g.cells[2] + extra - margin));
  };
  for (const bool velocity : {false, true}) {
    RemapBox<Dim> box({.cells = cells_of(Dim, 12), .boundary = BoundaryKind::outflow});
    fill_smooth<Dim>(box, velocity ? Field<Dim>([](const auto&) { return 2.0; }) : Field<Dim>(linear),
                     [](const auto&) { return 1.0; },
                     [&](const Point<Dim>& x) { Point<Dim> u; u.fill(linear(x)); return u; });
    box.move_to(motion, {}, pool, 0);
    if (!velocity) {
      box.for_each_cell([&](int i, int j, int k) {
        if (inner(box.grid, i, j, k, 0)) {
          worst[0] = std::max(worst[0], std::abs(box.density(0, i, j, k) - linear(box.centre(i, j, k))));
        }
      });
    } else {
      box.for_each_node([&](int i, int j, int k) {
        if (inner(box.grid, i, j, k, 1)) {
          for (std::size_t d = 0; d < Dim; ++d) {
            worst[1] = std::max(worst[1], std::abs(box.velocity[d].row(box.grid.node_row(j, k))[i] - linear(box.node(i, j, k))));
          }
        }
      });
    }
  }
  return worst;
}

TEST(Remap, IsExactForLinearFieldsOnAffineMeshesAwayFromSides) {
  const auto stretch2 = [](Point<2> x) { x[0] *= 1.02; x[1] = 0.99 * x[1] + 0.01; return x; };
  const auto stretch3 = [](Point<3> x) { x[0] *= 1.02; x[1] *= 0.98; x[2] *= 1.01; return x; };
  for (const auto& worst : {linear_error<2>(moved<2>(0.03, -0.02), 3), linear_error<2>(stretch2, 3),
                            linear_error<3>(moved<3>(0.03, -0.02), 3), linear_error<3>(stretch3, 3)}) {
    EXPECT_LT(worst[0], 2e-14); // values of 3: a dozen operations
    EXPECT_LT(worst[1], 2e-14);
  }
}

/// Two materials and void in blobs with random velocities, a closed box.
template <int Dim> RemapBox<Dim> blobs(bool axisymmetric) {
  RemapBox<Dim> box({.cells = cells_of(Dim, 12), .axisymmetric = axisymmetric, .materials = 2, .has_void = true});
  box.for_each_cell([&](int i, int j, int k) {
    const Point<Dim> x = box.centre(i, j, k);
    double a = 0, b = 0;
    for (const double q : x) {
      a += (q - 0.4) * (q - 0.4);
      b += (q - 0.6) * (q - 0.6);
    }
    const double f = std::clamp((0.3 - std::sqrt(a)) / 0.05, 0.0, 1.0);
    const double g = std::min(1 - f, std::clamp((0.35 - std::sqrt(b)) / 0.05, 0.0, 1.0));
    box.fill(0, i, j, k, f, 8 + x[0], 2 + x[1]);
    box.fill(1, i, j, k, g, 1 - 0.3 * x[1], 5 - x[0]);
    box.fill(2, i, j, k, 1 - f - g, 0, 0);
  });
  box.update_node_mass();
  box.set_velocity([](const Point<Dim>& x) {
    Point<Dim> u;
    for (std::size_t d = 0; d < Dim; ++d) {
      u[d] = std::sin(7 * x[0] + 3 * x[1] + 2 * static_cast<double>(d));
    }
    return u;
  });
  box.for_each_node([&](int i, int j, int k) {
    for (auto& u : box.velocity) {
      u.row(box.grid.node_row(j, k))[i] *= box.node_mass.row(box.grid.node_row(j, k))[i] > 0 ? 1 : 0;
    }
  });
  return box;
}

template <int Dim> void expect_conserved(bool axisymmetric) {
  RemapBox<Dim> box = blobs<Dim>(axisymmetric);
  const BoxTotals before = box.totals();
  ThreadPool pool(1);
  std::vector<double> mass = before.mass;
  double energy = before.energy(), scale = 0;
  for (double m : mass) {
    scale += m;
  }
  for (int n = 0; n < 6; ++n) {
    const Report r = n % 2 == 0 ? box.move_to(whirl<Dim>(0.4 + 0.1 * n), {}, pool, n)
                                : box.move_to(random_nodes(box, 0.2), {}, pool, n);
    energy -= r.sliver_energy + r.kinetic_loss - r.kinetic_returned;
    mass[0] -= r.sliver_mass; // slivers are round-off: either material's allowance
    EXPECT_LT(std::abs(r.sliver_mass), 1e-12 * scale);
    EXPECT_EQ(r.internal_out, 0);
  }
  const BoxTotals after = box.totals();
  for (std::size_t m = 0; m < 2; ++m) {
    EXPECT_NEAR(after.mass[m], mass[m], 1e-13 * mass[m]) << m;
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    EXPECT_NEAR(after.momentum[d], before.momentum[d], 1e-13 * scale);
  }
  EXPECT_NEAR(after.energy(), energy, 1e-13 * before.energy());
  const RowField shares = box.shares_of_mass();
  box.for_each_node([&](int i, int j, int k) {
    const int r = box.grid.node_row(j, k);
    EXPECT_NEAR(box.node_mass.row(r)[i], shares.row(r)[i], 1e-13 * scale / static_cast<double>(box.grid.cell_count()));
  });
}

TEST(Remap, ConservesMassMomentumEnergyAndNodeMassesStaySharesOfCells) {
  expect_conserved<2>(false);
  expect_conserved<2>(true);
  expect_conserved<3>(false);
}

/// Mean error of density and velocity after a cyclic whirl in N steps on N cells.
std::array<double, 2> cyclic_error(int n) {
  RemapBox<2> box({.cells = {n, n, 1}}), start({.cells = {n, n, 1}});
  ThreadPool pool(1);
  const auto bump = [](const Point<2>& x) { return 2 + std::cos(2 * pi * x[0]) * std::cos(2 * pi * x[1]); };
  for (RemapBox<2>* b : {&box, &start}) {
    fill_smooth<2>(*b, bump, [](const auto&) { return 1.0; },
                   [](const Point<2>& x) { return Point<2>{std::sin(pi * x[0]) * std::cos(pi * x[1]), 0}; });
  }
  for (int s = 1; s <= n; ++s) {
    box.move_to(whirl<2>(0.5 * (1 - std::cos(2 * pi * s / n))), {.limit = false}, pool, s);
  }
  std::array<double, 2> error{};
  box.for_each_cell([&](int i, int j, int k) { error[0] += std::abs(box.density(0, i, j, k) - start.density(0, i, j, k)) / (n * n); });
  box.for_each_node([&](int i, int j, int k) {
    const int r = box.grid.node_row(j, k);
    error[1] += std::abs(box.velocity[0].row(r)[i] - start.velocity[0].row(r)[i]) / (n * n);
  });
  return error;
}

TEST(Remap, IsSecondOrderOnSmoothCyclicMotion) {
  const auto coarse = cyclic_error(32), fine = cyclic_error(64);
  for (std::size_t q = 0; q < 2; ++q) {
    EXPECT_GE(std::log2(coarse[q] / fine[q]), 1.8) << q << ": " << coarse[q] << " " << fine[q];
  }
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

template <int Dim> void expect_same_bits() {
  const auto run = [](int threads) {
    RemapBox<Dim> box = blobs<Dim>(false);
    ThreadPool pool(threads);
    for (int n = 0; n < 3; ++n) {
      box.move_to(whirl<Dim>(0.5 * (n + 1)), {}, pool, n);
    }
    return box;
  };
  const RemapBox<Dim> one = run(1);
  for (const int threads : {2, 3}) {
    const RemapBox<Dim> other = run(threads);
    EXPECT_EQ(one.volume.data(), other.volume.data());
    EXPECT_EQ(one.velocity[0].data(), other.velocity[0].data());
    one.for_each_cell([&](int i, int j, int k) {
      for (std::size_t m = 0; m < one.stores.size(); ++m) {
        for (int field = 0; field < one.stores[m].conserved(); ++field) {
          const int r = one.grid.cell_row(j, k);
          EXPECT_EQ(one.stores[m].row(field, r)[i], other.stores[m].row(field, r)[i]);
        }
      }
    });
  }
}

TEST(Remap, GivesSameBitsForAnyThreadCount) {
  expect_same_bits<2>();
  expect_same_bits<3>();
}

} // namespace
} // namespace ballast::remap
