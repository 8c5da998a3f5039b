// Laws of curvilinear meshes in scenes: fractions, radial speeds, what decks make of them, what is measured on them.
#include "ale/fill.hpp"
#include "problems/build_scene.hpp"
#include "problems/mapped_fractions.hpp"
#include "problems/run_measure.hpp"
#include "problems/scene_reader.hpp"
#include "problems/scene_report.hpp"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

constexpr double pi = std::numbers::pi;

SceneSpec scene_of(const std::string& text) {
  Deck deck = Deck::parse(text, "test.toml");
  SceneSpec scene = read_scene(deck);
  EXPECT_TRUE(deck.clean()) << deck.error_report();
  return scene;
}

std::string deck(const std::string& geometry, const std::string& body, const std::string& mesh, const std::string& motion = "lagrangian") {
  return std::string("title = \"t\"\ngeometry = \"") + geometry + "\"\nend_time = \"1 us\"\n[[body]]\nname = \"b\"\nmaterial = \"copper_ofhc\"\n" + body +
         "\n[mesh]\n" + mesh + "\n[motion]\npolicy = \"" + motion + "\"\n";
}

const std::string hollow_disc = "shape = { difference = [ { sphere = { centre = [0, 0], radius = 0.1 } }, { sphere = { centre = [0, 0], radius = 0.08 } } ] }\n"
                                "velocity_radial = { speed = \"-400 m/s\", at = \"80 mm\" }";
const std::string polar = "map = \"polar\"\nradius = { from = \"60 mm\", to = \"110 mm\", cells = 25 }\nangle = { from = \"0 deg\", to = \"90 deg\", cells = 9 }";

double most_mixed(const Block<2>& b) {
  double most = 0;
  for_each_cell(b, [&](int i, int j, int) {
    const double f = b.materials[0].store.row(field::fraction, b.grid.cell_row(j, 0))[i];
    most = std::max(most, std::min(f, 1 - f));
  });
  return most;
}

/// The mesh has lines at 80 and 100 mm: their chords cut into the hollow, and yet no cell is mixed.
TEST(MappedMesh, SurfacesThatAreMeshSurfacesLeaveCellsPure) {
  EXPECT_EQ(most_mixed(build_scene<2>(scene_of(deck("planar", hollow_disc, polar, "eulerian")), 1).blocks[0]), 0);
  const std::string sector = "map = \"spherical\"\nradius = { from = \"60 mm\", to = \"110 mm\", cells = 25 }\nangle = { from = \"0 deg\", to = \"180 deg\", cells = 9 }";
  EXPECT_EQ(most_mixed(build_scene<2>(scene_of(deck("axisymmetric", hollow_disc, sector, "eulerian")), 1).blocks[0]), 0);
  const std::string square = "map = \"disc\"\nouter_radius = 0.2\nu = { from = 0, to = 1, cells = 8 }\nv = { from = -1, to = 1, cells = 16 }";
  EXPECT_EQ(most_mixed(build_scene<2>(scene_of(deck("planar", "shape = { sphere = { centre = [0, 0], radius = 0.2 } }", square, "eulerian")), 1).blocks[0]), 0);
}

/// Volumes of bodies that cut cells anyhow, summed with the curved cells' exact volumes.
TEST(MappedMesh, FractionsAddUpToTheBodysVolume) {
  const Shape ball{Sphere{{0.03, 0.75, 0}, 0.2}}, box{Box{{-9, 0.6, -9}, {9, 0.85, 9}}};
  const Shape* shapes[] = {&ball, &box};
  double volume[2] = {0, 0}, shares[2];
  const int n = 30;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double r0 = 0.4 + 0.6 * i / n, r1 = 0.4 + 0.6 * (i + 1) / n, a0 = pi * j / n, a1 = pi * (j + 1) / n;
      mapped_fractions(shapes, {MapKind::polar, {0, 0, 0}, 0}, Geometry::planar, {r0, a0, 0}, {r1, a1, 0}, shares);
      volume[0] += shares[0] * 0.5 * (r1 * r1 - r0 * r0) * (a1 - a0);
      volume[1] += shares[1] * 0.5 * (r1 * r1 - r0 * r0) * (a1 - a0);
    }
  }
  // The box hides a belt of the disc; of the box itself the part of the ring of radii 0.4 to 1 with 0.6 < y < 0.85.
  const auto below = [](double y, double r) { return y * std::sqrt(r * r - y * y) + r * r * std::asin(y / r); }; // of a disc, from y = 0
  const double belt = below(0.1, 0.2) + below(0.15, 0.2);
  EXPECT_NEAR(volume[0], pi * 0.04 - belt, 2e-5);
  EXPECT_NEAR(volume[1], below(0.85, 1) - below(0.6, 1), 5e-5);
}

/// Volume error of a ball in a rod of n x n x n / 2 cells, relative.
double ball_in_rod(int n) {
  const Shape ball{Sphere{{0.3, 0.1, 0.5}, 0.35}};
  const Shape* shapes[] = {&ball};
  double volume = 0, share = 0;
  const MeshMap rod{MapKind::rod, {0, 0, 0}, 1};
  for (int cell = 0; cell < n * n * n / 2; ++cell) {
    const int i = cell % n, j = cell / n % n, k = cell / (n * n);
    const Point lo = {-1 + 2.0 * i / n, -1 + 2.0 * j / n, 2.0 * k / n}, hi = {-1 + 2.0 * (i + 1) / n, -1 + 2.0 * (j + 1) / n, 2.0 * (k + 1) / n};
    mapped_fractions(shapes, rod, Geometry::three_d, lo, hi, {&share, 1});
    volume += share * mapped_cell_volume(rod, Geometry::three_d, lo, hi);
  }
  return std::abs(volume / (4 * pi / 3 * std::pow(0.35, 3)) - 1);
}

/// Cells have straight edges, fractions are of curved ones: second order.
TEST(MappedMesh, FractionsOfABallInARodAddUp) {
  const double coarse = ball_in_rod(12), fine = ball_in_rod(24);
  EXPECT_LT(coarse, 6e-3);
  EXPECT_LT(fine, 0.4 * coarse) << coarse << " " << fine;
}

/// The default power keeps every volume: the flux through all radii is one.
TEST(RadialVelocity, IsFreeOfDivergenceByDefault) {
  const SceneSpec plane = scene_of(deck("planar", hollow_disc, polar));
  EXPECT_EQ(plane.bodies[0].radial->power, 1);
  const Point u = plane.bodies[0].velocity_at({0.06, 0.08, 0});
  EXPECT_NEAR(u[0], -400 * 0.8 * 0.6, 1e-10);
  EXPECT_NEAR(u[1], -400 * 0.8 * 0.8, 1e-10);
  const std::string sector = "map = \"spherical\"\nradius = { from = \"60 mm\", to = \"110 mm\", cells = 5 }\nangle = { from = \"0 deg\", to = \"180 deg\", cells = 9 }";
  const SceneSpec ring = scene_of(deck("axisymmetric", hollow_disc, sector));
  EXPECT_EQ(ring.bodies[0].radial->power, 2);
  EXPECT_NEAR(ring.bodies[0].velocity_at({0, 0.1, 0})[1], -400 * 0.64, 1e-10);
  RadialVelocity axis{3, 2, 1, {0, 0, 7}, 2};
  EXPECT_NEAR(axis({0, 4, 1})[1], 1.5, 1e-15);
  EXPECT_EQ(axis({0, 4, 1})[2], 0);
  EXPECT_EQ(axis({0, 0, 1}), Point{});
}

/// Nodes get the velocity at their own place, whatever the cells.
TEST(RadialVelocity, NodesMoveAlongTheirRadius) {
  const Scene<2> scene = build_scene<2>(scene_of(deck("planar", hollow_disc, "map = \"polar\"\nradius = { from = \"80 mm\", to = \"100 mm\", cells = 5 }\nangle = { from = \"0 deg\", to = \"90 deg\", cells = 9 }")), 1);
  const Block<2>& b = scene.blocks[0];
  for (int j = 0; j <= 9; ++j) {
    const int r = b.grid.node_row(j, 0);
    for (int i = 0; i <= 5; ++i) {
      const double x = b.position[0].row(r)[i], y = b.position[1].row(r)[i], speed = -400 * 0.08 / std::hypot(x, y);
      EXPECT_NEAR(b.velocity[0].row(r)[i], speed * x / std::hypot(x, y), 1e-10);
      EXPECT_NEAR(b.velocity[1].row(r)[i], speed * y / std::hypot(x, y), 1e-10);
    }
  }
}

TEST(MappedMesh, SidesAreSymmetricWherePlanesCutTheBody) {
  const SceneSpec quarter = scene_of(deck("planar", hollow_disc, polar));
  EXPECT_EQ(quarter.boundaries[0][0].kind, BoundaryKind::free);
  EXPECT_EQ(quarter.boundaries[0][1].kind, BoundaryKind::free);
  EXPECT_EQ(quarter.boundaries[1][0].kind, BoundaryKind::symmetry);
  EXPECT_EQ(quarter.boundaries[1][1].kind, BoundaryKind::symmetry);
  EXPECT_NEAR(quarter.mesh_lines[1].back(), pi / 2, 1e-15);
  const Scene<2> scene = build_scene<2>(quarter, 1);
  EXPECT_EQ(scene.blocks[0].boundary.normal[1], (std::array<int, 2>{1, 0}));
  const SceneSpec rod = scene_of(deck("3d", "shape = { cylinder = { from = [0, 0, 0], to = [0, 0, 0.02], radius = 0.003 } }",
                                      "map = \"rod\"\nouter_radius = \"3 mm\"\nu = { from = 0, to = 1, cells = 4 }\nv = { from = -1, to = 1, cells = 8 }\n"
                                      "z = { from = 0, to = 0.02, cells = 20, lower = \"wall\" }"));
  EXPECT_EQ(rod.boundaries[0][0].kind, BoundaryKind::symmetry);
  EXPECT_EQ(rod.boundaries[1][0].kind, BoundaryKind::free);
  EXPECT_EQ(rod.boundaries[2][0].kind, BoundaryKind::wall);
  // Chords: the octagon's area with 8 cells on the half circle, by the rod's own table and by the block.
  EXPECT_NEAR(filled_bodies(rod)[0].volume, totals(build_scene<3>(rod, 1).blocks[0]).volume[0], 1e-15);
}

const std::string bullet = "title = \"t\"\ngeometry = \"{}\"\nend_time = \"1 us\"\n[[body]]\nuse = \"bullet/m882\"\ntip = [{}]\n"
                           "[mesh]\nmap = \"turned\"\noutline = {{ use = \"bullet/m882\", tip = [{}] }}\n{}z = {{ size = \"{} mm\" }}\n[motion]\npolicy = \"relax\"\n";
std::string bullet_deck(bool solid, int across, double size) {
  const std::string tip = solid ? "0, 0, 0.003" : "0, 0.003", u = fmt::format("{{ from = 0, to = 1, cells = {} }}\n", across);
  return fmt::format(fmt::runtime(bullet), solid ? "3d" : "axisymmetric", tip, tip, "u = " + u + (solid ? "v = " + u : ""), size);
}

/// The mesh is the bullet and nothing else: no void beside it, and its mass but for what chords cut off.
TEST(MappedMesh, TurnedMeshHoldsTheBulletAndNothingElse) {
  const double exact = 8.00575e-3; // of the outline
  double before = 0;
  for (const int n : {9, 18}) {
    const SceneSpec spec = scene_of(bullet_deck(false, n, 4.5 / n));
    EXPECT_EQ(spec.mesh_lines[1].front(), 0.003 - 0.0155);
    EXPECT_EQ(spec.mesh_lines[1].back(), 0.003);
    const Scene<2> scene = build_scene<2>(spec, 1);
    const Totals t = totals(scene.blocks[0]);
    double volume = 0;
    for_each_cell(scene.blocks[0], [&](int i, int j, int) { volume += scene.blocks[0].volume.row(scene.blocks[0].grid.cell_row(j, 0))[i]; });
    EXPECT_NEAR(t.volume[0] + t.volume[1], volume, 1e-14 * volume);
    const double missing = 1 - (t.mass[0] + t.mass[1]) / exact;
    EXPECT_LT(std::abs(missing), n == 9 ? 4e-4 : 1e-4);
    before = missing;
  }
  EXPECT_GT(before, -1e-4);
  const Scene<3> solid = build_scene<3>(scene_of(bullet_deck(true, 6, 0.75)), 1);
  const Totals t = totals(solid.blocks[0]);
  EXPECT_NEAR(4 * (t.mass[0] + t.mass[1]), exact, 5e-3 * exact); // 24 chords around
}

TEST(MappedMesh, ResolvedDeckReadsBackToItself) {
  Deck first = Deck::parse(deck("planar", hollow_disc, polar), "test.toml");
  read_scene(first);
  ASSERT_TRUE(first.clean()) << first.error_report();
  const std::string once = write_toml(first.root());
  Deck again = Deck::parse(once, "resolved.toml");
  const SceneSpec s = read_scene(again);
  ASSERT_TRUE(again.clean()) << again.error_report();
  EXPECT_EQ(once, write_toml(again.root()));
  EXPECT_EQ(s.mesh_lines, scene_of(deck("planar", hollow_disc, polar)).mesh_lines);
}

/// A gauge anywhere in the mesh finds its cell, and a velocity linear in place exactly.
TEST(MappedMesh, VelocityAtAPointIsThatOfItsPlace) {
  Scene<2> scene = build_scene<2>(scene_of(deck("planar", hollow_disc, polar, "eulerian")), 1);
  Block<2>& b = scene.blocks[0];
  set_velocity(b, [](const std::array<double, 2>& x, std::array<double, 2>& u) { u = {3 * x[0] - x[1], 5 * x[1] + 1}; });
  for (const double angle : {0.1, 0.7, 1.5}) {
    for (const double radius : {0.0611, 0.08, 0.1083}) {
      const std::array<double, 3> at = {radius * std::cos(angle), radius * std::sin(angle), 0};
      const auto u = velocity_at(b, find_cell(b, at), at);
      EXPECT_NEAR(u[0], 3 * at[0] - at[1], 1e-12);
      EXPECT_NEAR(u[1], 5 * at[1] + 1, 1e-12);
    }
  }
  const BodyMeasure m = measure_body(b, {0}, 0, 1.0);
  EXPECT_NEAR(m.front, 0.1, 1e-12);
  EXPECT_NEAR(m.radius, 0.1, 1e-12);
}

} // namespace
} // namespace ballast
