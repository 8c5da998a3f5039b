// Labels of an image as bodies: volumes to the last digit, what decks say, and what they may not.
#include "ale/phases.hpp"
#include "problems/build_scene.hpp"
#include "problems/mapped_fractions.hpp"
#include "problems/scene_reader.hpp"
#include "problems/shape_placement.hpp"
#include "problems/voxel_solid.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/label_files.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace ballast {
namespace {

using namespace testing;
using Kind = Combination::Kind;

/// Voxels of three sides, labels 1 and 2 by chance, 0 now and then.
TestImage chance(double none = 0.2) {
  TestImage image{{14, 6, 5}, {0.35, 1.1, 1.3}, {-2, 0.4, 3}, {}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, 1);
  for (int i = 0; i < 420; ++i) {
    const double x = any(random);
    image.labels.push_back(x < none ? 0 : x < 0.5 + 0.5 * none ? 1 : 2);
  }
  return image;
}

Shape solid_of(const TestImage& image, std::uint16_t label) {
  std::vector<bool> filled;
  for (const std::uint16_t at : image.labels) {
    filled.push_back(at == label);
  }
  VoxelIndex size{};
  Point corner{};
  for (std::size_t k = 0; k < 3; ++k) {
    size[k] = static_cast<std::ptrdiff_t>(image.size[k]);
    corner[k] = image.first[k] - 0.5 * image.spacing[k];
  }
  return Shape{Voxels{std::make_shared<const VoxelSolid>(size, corner, image.spacing, filled)}};
}

/// The volume of a label in lo..hi, voxel by voxel over the whole image.
double exact(const TestImage& image, std::uint16_t label, const Point& lo, const Point& hi) {
  double volume = 0;
  for (std::size_t v = 0; v < image.labels.size(); ++v) {
    const std::size_t at[3] = {v % image.size[0], v / image.size[0] % image.size[1], v / (image.size[0] * image.size[1])};
    double common = image.labels[v] == label ? 1 : 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double from = image.first[k] + (static_cast<double>(at[k]) - 0.5) * image.spacing[k];
      common *= std::max(0.0, std::min(hi[k], from + image.spacing[k]) - std::max(lo[k], from));
    }
    volume += common;
  }
  return volume;
}

/// Boxes of all sizes, in, across and beside the image.
template <class Each> void for_chance_boxes(Each&& each) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4, 10), side(0.01, 5);
  for (int i = 0; i < 2000; ++i) {
    const Point lo{place(random), place(random), place(random)};
    each(lo, Point{lo[0] + side(random), lo[1] + side(random), lo[2] + side(random)});
  }
}

TEST(Voxels, CellsTakeExactlyTheVolumeTheyShare) {
  const TestImage image = chance();
  const Shape one = solid_of(image, 1), two = solid_of(image, 2);
  const Shape* both[] = {&one, &two};
  for_chance_boxes([&](const Point& lo, const Point& hi) {
    const double cell = (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
    const double a = exact(image, 1, lo, hi) / cell, b = exact(image, 2, lo, hi) / cell;
    EXPECT_NEAR(fraction(one, Geometry::three_d, lo, hi), a, 1e-12);
    double shares[2] = {};
    visible_fractions(both, Geometry::three_d, lo, hi, shares);
    EXPECT_NEAR(shares[0], a, 1e-11); // planes nearer than 1e-12 of a cell are one
    EXPECT_NEAR(shares[1], b, 1e-11);
  });
}

TestImage fine() {
  TestImage image{{30, 31, 32}, {0.11, 0.12, 0.13}, {0.3, -0.4, 0}, {}};
  std::mt19937 random(5);
  for (int i = 0; i < 30 * 31 * 32; ++i) {
    image.labels.push_back(static_cast<std::uint16_t>(random() % 3));
  }
  return image;
}

/// More voxels in a cell than lines would be cast through it.
TEST(Voxels, FineVoxelsAreExactInCoarseCells) {
  const TestImage image = fine();
  const Shape one = solid_of(image, 1), two = solid_of(image, 2);
  const Shape* both[] = {&one, &two};
  const Point lo{0.5, -0.3, 0.2}, hi{3.3, 3.1, 4.2};
  double shares[2] = {};
  visible_fractions(both, Geometry::three_d, lo, hi, shares);
  for (std::uint16_t label = 1; label < 3; ++label) {
    EXPECT_NEAR(shares[label - 1], exact(image, label, lo, hi) / (2.8 * 3.4 * 4.0), 1e-11);
  }
}

/// Lines are cast where another shape than boxes passes through: exact all the same if its side is along the axes and the
/// voxels in the cell are few, else to the lines' width.
TEST(Voxels, LinesThroughThemFindTheirFaces) {
  const TestImage image = chance();
  const Shape one = solid_of(image, 1), two = solid_of(image, 2), over{HalfSpace{{0, 0, 5.6}, {0, 0, 1}}};
  const Shape* all[] = {&one, &two, &over};
  int cut = 0;
  for_chance_boxes([&](const Point& lo, Point hi) {
    hi[0] = std::min(hi[0], lo[0] + 2); // six planes at most
    if (lo[2] >= 5.6 || hi[2] <= 5.6) {
      return;
    }
    const double cell = (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
    double shares[3] = {};
    visible_fractions(all, Geometry::three_d, lo, hi, shares);
    const Point above{lo[0], lo[1], 5.6};
    EXPECT_NEAR(shares[0], exact(image, 1, above, hi) / cell, 1e-11);
    EXPECT_NEAR(shares[1], exact(image, 2, above, hi) / cell, 1e-11);
    cut += shares[0] > 0;
  });
  EXPECT_GT(cut, 50);
  const TestImage small = fine();
  const Shape grains = solid_of(small, 1), slanted{HalfSpace{{1.9, 1.4, 2.2}, {0.6, 0, 0.8}}};
  const Shape* both[] = {&grains, &slanted};
  double shares[2] = {};
  const Point lo{0.5, -0.3, 0.2}, hi{3.3, 3.1, 4.2};
  visible_fractions(both, Geometry::three_d, lo, hi, shares);
  EXPECT_NEAR(shares[1], 0.5, 1e-3);                                                 // through the middle
  EXPECT_NEAR(shares[0], 0.5 * exact(small, 1, lo, hi) / (2.8 * 3.4 * 4.0), 0.004); // 24 x 24 lines through 15 grains each: 0.47 / sqrt(8640), half of it
}

TEST(Voxels, LabelsFillTheImageWithoutGapsOrOverlap) {
  const TestImage image = chance(0);
  const Shape one = solid_of(image, 1), two = solid_of(image, 2), below{Box{{-20, -20, -20}, {20, 20, 20}}};
  const Shape* both[] = {&below, &one, &two};
  int within = 0;
  for_chance_boxes([&](const Point& lo, const Point& hi) {
    double shares[3] = {};
    visible_fractions(both, Geometry::three_d, lo, hi, shares);
    const bool inside = exact(image, 1, lo, hi) + exact(image, 2, lo, hi) > (1 - 1e-9) * (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
    EXPECT_NEAR(shares[0] + shares[1] + shares[2], 1, 1e-12);
    EXPECT_TRUE(!inside || shares[0] < 1e-12) << shares[0];
    within += inside;
  });
  EXPECT_GT(within, 20);
}

TEST(Voxels, CombineExactlyWithBoxesAndWellWithSpheres) {
  const TestImage image = chance(0);
  const Shape one = solid_of(image, 1), two = solid_of(image, 2);
  const Box box{{-1.05, 1.03, 3.77}, {1.49, 4.21, 6.11}};
  const Shape in_box{Combination{Kind::intersect, {one, Shape{box}}}};
  const Point lo{-2.1, 0.2, 3.1}, hi{2.1, 6.1, 8.3};
  const double cell = (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]);
  EXPECT_NEAR(fraction(in_box, Geometry::three_d, lo, hi) * cell, exact(image, 1, box.from, box.to), 1e-11);
  // A ball over both labels, cell by cell: what the three show is the ball's volume and the rest.
  const Sphere ball{{0, 3, 5.5}, 1.4};
  const Shape over{ball};
  const Shape* all[] = {&one, &two, &over};
  double sums[3] = {};
  const int n = 8;
  for (int q = 0; q < n * n * n; ++q) {
    const int at[3] = {q % n, q / n % n, q / (n * n)};
    Point a{}, b{};
    double v = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = lo[k] + (hi[k] - lo[k]) * at[k] / n;
      b[k] = lo[k] + (hi[k] - lo[k]) * (at[k] + 1) / n;
      v *= b[k] - a[k];
    }
    double shares[3] = {};
    visible_fractions(all, Geometry::three_d, a, b, shares);
    for (std::size_t s = 0; s < 3; ++s) {
      sums[s] += shares[s] * v;
    }
  }
  const double ball_volume = 4.0 / 3 * std::numbers::pi * 1.4 * 1.4 * 1.4;
  EXPECT_NEAR(sums[2] / ball_volume, 1, 1e-3); // the error of lines, as for all shapes
  EXPECT_NEAR((sums[0] + sums[1]) / (cell - ball_volume), 1, 1e-3);
}

/// As the cells of curved meshes ask: never too far, and of the right side.
TEST(Voxels, DistanceIsNeverTooFarAndSaysWhichSide) {
  TestImage image = chance(0.3);
  for (std::size_t v = 0; v < 252; ++v) {
    image.labels[v] = 1; // a part with an inside
  }
  const Shape shape = solid_of(image, 1);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Point> points;
  for (int i = 0; i < 1500; ++i) {
    points.push_back({4 * any(random), 3 + 4 * any(random), 5.5 + 4 * any(random)});
  }
  double deepest = 0;
  for (const Point& p : points) {
    const double d = signed_distance(shape, p);
    EXPECT_EQ(d < 0, contains(shape, p));
    deepest = std::min(deepest, d);
    for (const Point& q : points) {
      if (contains(shape, q) != contains(shape, p)) {
        EXPECT_LE(std::abs(d), std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      }
    }
  }
  EXPECT_LT(deepest, -0.4); // deeper than one voxel is known to be
}

/// Cells of a curved mesh are cast line by line; here the map is none, so that the exact share is known.
TEST(Voxels, MappedCellsSeeThemToTheirLines) {
  const TestImage image = chance(0);
  const Shape one = solid_of(image, 1);
  const Shape* shapes[] = {&one};
  double worst = 0, most = 0;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  for (int i = 0; i < 300; ++i) {
    const Point lo{-2 + 3.5 * any(random), 0.4 + 4 * any(random), 3 + 4 * any(random)}, hi{lo[0] + 0.5, lo[1] + 0.9, lo[2] + 0.8};
    double share = 0;
    mapped_fractions(shapes, MeshMap{}, Geometry::three_d, lo, hi, {&share, 1});
    worst = std::max(worst, std::abs(share - exact(image, 1, lo, hi) / (0.5 * 0.9 * 0.8)));
    most = std::max(most, share);
  }
  EXPECT_LT(worst, 3.0 / 24); // a face square to the lines is placed to half a line's width; three axes may have one
  EXPECT_EQ(most, 1);         // cells within the label
}

TEST(Voxels, TurnByRightAnglesAsASetOfPoints) {
  const Shape shape = solid_of(chance(), 2);
  const Placement at{rotation_xyz({std::numbers::pi / 2, std::numbers::pi, -std::numbers::pi / 2}), {0.3, 1, 2}, {0.1, -0.2, 0.5}};
  const Shape moved = placed(at, shape), shifted = placed({Placement{}.turn, {}, {0.25, -1, 2}}, shape);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1, 1);
  int in = 0;
  for (int i = 0; i < 3000; ++i) {
    const Point p{4 * any(random), 3 + 4 * any(random), 5.5 + 4 * any(random)};
    EXPECT_EQ(contains(shape, p), contains(moved, placed(at, p)));
    EXPECT_EQ(contains(shape, p), contains(shifted, {p[0] + 0.25, p[1] - 1, p[2] + 2}));
    in += contains(shape, p);
  }
  EXPECT_GT(in, 100);
  EXPECT_TRUE(can_turn(at.turn, shape));
  EXPECT_FALSE(can_turn(rotation_about({0, 0, 1}, 0.1), Shape{Combination{Kind::unite, {shape, shape}}}));
}

// ---- from decks ----

std::string deck_text(const std::string& bodies, const std::string& geometry = "3d", const std::string& mesh_from = "0 mm") {
  return fmt::format("title = \"t\"\ngeometry = \"{0}\"\nend_time = \"1 us\"\n{1}[mesh]\n{2} = {{ from = \"{3}\", to = \"11 mm\", size = \"1.5 mm\" }}\n"
                     "{4} = {{ from = 0, to = \"10 mm\", size = \"1.7 mm\" }}\n{5}",
                     geometry, bodies, geometry == "axisymmetric" ? "r" : "x", mesh_from, geometry == "axisymmetric" ? "z" : "y",
                     geometry == "3d" ? "z = { from = 0, to = \"8 mm\", size = \"0.9 mm\" }\n" : "");
}

std::string body_text(const std::string& name, const std::string& material, const std::string& voxels, const std::string& more = "") {
  return fmt::format("[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nshape = {{ voxels = {{ {} }}{} }}\n", name, material, voxels, more);
}

/// 11 x 10 x 8 mm from the origin, so that two labels fill the mesh to its sides; voxels cut by its lines.
TestImage wall() {
  TestImage image{{22, 8, 10}, {0.5, 1.25, 0.8}, {0.25, 0.625, 0.4}, {}};
  for (std::size_t v = 0; v < 22 * 8 * 10; ++v) {
    image.labels.push_back(v % 22 > 5 + v / 22 % 8 ? 3 : 7); // a slanted seam
  }
  return image;
}

Deck read(const std::string& text, SceneSpec& scene) {
  Deck deck = Deck::parse(text, "t.toml");
  scene = read_scene(deck);
  return deck;
}

/// Of all voxels with the label `l`, m3.
double volume_of(const TestImage& image, std::uint16_t l) {
  return static_cast<double>(std::count(image.labels.begin(), image.labels.end(), l)) * image.spacing[0] * image.spacing[1] * image.spacing[2] * 1e-9;
}

TEST(Voxels, BodiesOfTwoLabelsHaveTheMassesOfTheirVoxels) {
  const io::TemporaryFolder folder;
  const TestImage image = wall();
  write_bytes(folder / "wall.mha", mha_header(image) + bytes_of(image));
  const std::string file = fmt::format("file = \"{}\", ", (folder / "wall.mha").string());
  SceneSpec spec;
  const Deck deck = read(deck_text(body_text("skin", "water", file + "label = 3") + body_text("bone", "copper_ofhc", file + "label = [7]")), spec);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  const Scene<3> scene = build_scene<3>(spec, 1);
  const Block<3>& b = scene.blocks[0];
  const std::vector<double> mass = totals(b).mass;
  ASSERT_TRUE(b.materials.back().is_void);
  EXPECT_EQ(totals(b).volume.back(), 0); // the labels leave no gap
  for (std::size_t q = 0; q < 2; ++q) {
    const Body& body = spec.bodies[q];
    const int slot = slot_map(spec).slot[static_cast<std::size_t>(body.material)];
    EXPECT_NEAR(mass[static_cast<std::size_t>(slot)] / (body.density * volume_of(image, q == 0 ? 3 : 7)), 1, 1e-11) << body.name;
  }
}

TEST(Voxels, DecksGiveUnitsSeveralLabelsAndAPlace) {
  const io::TemporaryFolder folder;
  const TestImage image = wall();
  write_bytes(folder / "wall.nii", nifti_bytes(image));
  const std::string file = fmt::format("file = \"{}\", label = [3, 7]", (folder / "wall.nii").string());
  SceneSpec spec;
  const Deck deck = read(deck_text(body_text("all", "water", file) + body_text("small", "copper_ofhc", file + ", units = \"um\"", ", offset = [\"2 mm\", 0, \"1 mm\"]")), spec);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  const Bounds all = bounds(spec.bodies[0].shape), small = bounds(spec.bodies[1].shape);
  const double size[3] = {0.011, 0.010, 0.008}, offset[3] = {0.002, 0, 0.001};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(all.lo[k], 0, 1e-9);
    EXPECT_NEAR(all.hi[k], size[k], 1e-9);
    EXPECT_NEAR(small.lo[k], offset[k], 1e-12);
    EXPECT_NEAR(small.hi[k], offset[k] + 1e-3 * size[k], 1e-12);
  }
  EXPECT_EQ(describe(spec.bodies[0].shape).substr(0, 11), "1760 voxels");
}

TEST(Voxels, ResolvedDeckKeepsTheImageAndItsSum) {
  const io::TemporaryFolder folder;
  TestImage image = wall();
  const auto write = [&] { write_bytes(folder / "wall.nrrd", nrrd_header(image, "encoding: raw") + bytes_of(image)); };
  write();
  SceneSpec spec;
  const Deck deck = read(deck_text(body_text("all", "water", fmt::format("file = \"{}\", label = 3", (folder / "wall.nrrd").string()))), spec);
  ASSERT_TRUE(deck.clean()) << deck.error_report();
  const std::string resolved = write_toml(deck.root());
  EXPECT_NE(resolved.find("units = \"mm\""), std::string::npos);
  SceneSpec again;
  EXPECT_TRUE(read(resolved, again).clean());
  image.labels[0] = 3;
  write();
  EXPECT_NE(read(resolved, again).error_report().find("it is another one"), std::string::npos);
}

TEST(Voxels, DecksThatCannotBeAreToldWhereAndWhatWouldDo) {
  const io::TemporaryFolder folder;
  const TestImage image = wall();
  write_bytes(folder / "wall.mha", mha_header(image) + bytes_of(image));
  write_bytes(folder / "turned.mha", mha_header(image, "TransformMatrix = 0.8 0.6 0 -0.6 0.8 0 0 0 1\n") + bytes_of(image));
  const auto at = [&](const char* name) { return fmt::format("file = \"{}\", ", (folder / name).string()); };
  const std::string good = at("wall.mha");
  struct Case {
    std::string text, key, problem, cure;
  };
  const auto one = [&](const std::string& voxels, const std::string& more = "") { return deck_text(body_text("b", "water", voxels, more)); };
  TestImage corners{{3, 3, 3}, {20, 20, 20}, {-14, -14, -14}, std::vector<std::uint16_t>(27)}; // the mesh lies in the middle one of them
  corners.labels[0] = corners.labels[26] = 1;
  write_bytes(folder / "corners.mha", mha_header(corners) + bytes_of(corners));
  const std::vector<Case> cases = {
      {one(good + "label = 5"), "voxels.label", "no voxel of the image has the label 5", "3 (1000 voxels), 7 (760 voxels)"},
      {one(good + "label = [3, 5]"), "voxels.label[1]", "the label 5", "7 (760 voxels)"},
      {one(good + "label = 3.5"), "voxels.label", "3.5 is no label", "0 to 65535"},
      {one(good + "label = -3"), "voxels.label", "-3 is no label", "0 to 65535"},
      {one(good + "label = \"skin\""), "voxels.label", "is no label", "whole number"},
      {one(good + "label = []"), "voxels.label", "no label is given", "whole number"},
      {one(good + "units = \"mm\""), "voxels.label", "", ""},
      {one("label = 3"), "voxels.file", "", ""},
      {one("file = \"nowhere.mha\", label = 3"), "voxels.file", "cannot open", "beside the deck"},
      {one(at("turned.mha") + "label = 3"), "voxels.file", "turned", "resample"},
      {one(good + "label = 3, units = \"kg\""), "voxels.units", "no unit of length", "mm"},
      {one(good + "label = 3", ", offset = [\"90 mm\", 0, 0]"), "body[0]", "outside the mesh along x", "from 0 to"},
      {one(at("corners.mha") + "label = 1", ", offset = [\"-1 mm\", 0, 0]"), "shape", "no voxel of body \"b\" lies in the mesh", "offset"},
      {one(good + "label = 3", ", rotate = { axis = [0, 0, 1], angle = \"10 deg\" }"), "shape.rotate", "right angles only", "resampled"},
      {deck_text(body_text("b", "water", good + "label = 3"), "planar"), "shape.voxels", "planar", "3d"},
      {deck_text(body_text("b", "water", good + "label = 3"), "axisymmetric"), "shape.voxels", "axisymmetric", "3d"},
      {deck_text(body_text("b", "water", good + "label = 3") + "yaw = \"3 deg\"\ntip = [0, 0, 0]\n"), "shape", "this body leans", "no yaw"},
  };
  for (const Case& c : cases) {
    SceneSpec spec;
    const Deck deck = read(c.text, spec);
    const bool found = std::any_of(deck.errors().begin(), deck.errors().end(), [&](const DeckError& e) {
      return e.key.ends_with(c.key) && e.place.line > 0 && e.message.find(c.problem) != std::string::npos && e.allowed.find(c.cure) != std::string::npos;
    });
    EXPECT_TRUE(found) << c.text << "\nwanted " << c.key << ": " << c.problem << " / " << c.cure << "\ngot " << deck.error_report();
  }
}

} // namespace
} // namespace ballast
