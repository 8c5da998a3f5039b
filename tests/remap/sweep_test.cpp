// Laws of a remap: what it must leave alone, what it must conserve.
#include "tests/remap/mesh_motions.hpp"

#include <gtest/gtest.h>

namespace ballast::remap {
namespace {

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

// As after many Lagrangian steps between two remaps: whole turns at once, many cells far.
TEST(Remap, LeavesUniformStateHoweverFarTheMeshMovesAtOnce) {
  for (const double angle : {0.1, 0.4, 1.6, 2.6}) {
    expect_uniform<2>(false, BoundaryKind::symmetry, whirl<2>(angle), false);
    expect_uniform<2>(true, BoundaryKind::symmetry, whirl<2>(angle), false);
  }
  for (const double cells : {1.0, 8.0, 32.0}) {
    expect_uniform<2>(false, BoundaryKind::outflow, moved<2>(0.1 * cells, -0.07 * cells), false);
  }
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
