// Closed surfaces of facets: what encloses no solid is told, what does is filled like any shape.
#include "facet_bodies.hpp"
#include "problems/facet_winding.hpp"
#include "problems/scene_report.hpp"
#include "problems/stl_file.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace ballast {
namespace {

using testing::ball_mesh;
using testing::box_facets;
using testing::surface_of;

constexpr double pi = std::numbers::pi;

struct CellBox {
  Point lo, hi;
};

CellBox cell_of(const Point& lo, const Point& hi, int n, int i, int j, int k) {
  const int at[3] = {i, j, k};
  CellBox c{};
  for (std::size_t d = 0; d < 3; ++d) {
    c.lo[d] = lo[d] + (hi[d] - lo[d]) * at[d] / n;
    c.hi[d] = lo[d] + (hi[d] - lo[d]) * (at[d] + 1) / n;
  }
  return c;
}

template <class Each> void for_cells(const Point& lo, const Point& hi, int n, Each&& each) {
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        each(cell_of(lo, hi, n, i, j, k));
      }
    }
  }
}

TEST(ClosedSurface, FineBallFillsAsTheSphereWithinItsChord) {
  const FacetMesh mesh = ball_mesh({0.03, -0.02, 0.01}, 1, 5); // 20480 facets
  const Shape facets = surface_of(mesh), sphere{Sphere{{0.03, -0.02, 0.01}, 1}};
  double longest = 0;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const Facet f = mesh.corners(i);
    longest = std::max(longest, std::hypot(f[0][0] - f[1][0], f[0][1] - f[1][1], f[0][2] - f[1][2]));
  }
  const double sagitta = longest * longest / 6; // circumradius L/sqrt(3): L^2/3 / (2 R)
  const int n = 16;
  const double side = 2.4 / n;
  double volume = 0, worst = 0;
  for_cells({-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}, n, [&](const CellBox& c) {
    const double f = fraction(facets, Geometry::three_d, c.lo, c.hi);
    volume += f * side * side * side;
    worst = std::max(worst, std::abs(f - fraction(sphere, Geometry::three_d, c.lo, c.hi)));
  });
  // Lines err by 1e-3 of a cell each; the sphere's part of a cell is at most sqrt(3) sides square.
  EXPECT_LT(worst, sagitta / side * std::sqrt(3.0) + 2e-3);
  EXPECT_NEAR(volume, enclosed_volume(mesh), 1e-12); // a surface alone is cut exactly
  EXPECT_NEAR(volume, 4 * pi / 3, 4 * pi * sagitta + 2e-4);
}

TEST(ClosedSurface, VerticesAndEdgesOnTheMeshsPlanesAreCutExactly) {
  const FacetMesh mesh = ball_mesh({0, 0, 0}, 1, 3); // vertices in the planes x, y, z = 0
  const Shape ball = surface_of(mesh), shifted = surface_of(ball_mesh({1e-9, 2e-10, -1e-9}, 1, 3));
  double volume = 0;
  for_cells({-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}, 12, [&](const CellBox& c) {
    const double f = fraction(ball, Geometry::three_d, c.lo, c.hi);
    volume += f * 0.008;
    EXPECT_NEAR(f, fraction(shifted, Geometry::three_d, c.lo, c.hi), 1e-6); // shift of 1e-9 in 0.2
  });
  EXPECT_NEAR(volume, enclosed_volume(mesh), 1e-12);
}

TEST(ClosedSurface, CutAloneOrWithOthersItCoversTheSame) {
  const FacetMesh mesh = ball_mesh({0.02, 0.01, 0}, 1, 3);
  const Shape alone = surface_of(mesh);
  const Shape all{Box{{-3, -3, -3}, {3, 3, 3}}}; // by lines: a combination
  const Shape lines{Combination{Combination::Kind::intersect, {alone, all}}};
  for_cells({-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}, 9, [&](const CellBox& c) {
    EXPECT_NEAR(fraction(alone, Geometry::three_d, c.lo, c.hi), fraction(lines, Geometry::three_d, c.lo, c.hi), 2e-3);
  });
  const Shape* bodies[] = {&all, &alone}; // the ball in something: the shares are all there is
  double shares[2];
  visible_fractions(bodies, Geometry::three_d, {0.9, -0.1, -0.1}, {1.1, 0.1, 0.1}, shares);
  EXPECT_EQ(shares[0] + shares[1], 1);
  EXPECT_GT(shares[0], 0);
  EXPECT_GT(shares[1], 0);
}

TEST(ClosedSurface, BoxOfFacetsFillsAsTheBoxOnAnyMesh) {
  const Point lo{-0.5, -0.25, 0}, hi{0.5, 0.75, 0.5};
  const Shape facets = surface_of(weld(box_facets(lo, hi))), box{Box{lo, hi}};
  for (const int n : {8, 7}) { // faces on the mesh's own planes, and across cells
    for_cells({-1, -1, -1}, {1, 1, 1}, n, [&](const CellBox& c) {
      const double f = fraction(facets, Geometry::three_d, c.lo, c.hi);
      const double exact = fraction(box, Geometry::three_d, c.lo, c.hi);
      EXPECT_NEAR(f, exact, 1e-12); // aligned faces are exact
      if (n == 8) {
        EXPECT_TRUE(f == 0 || f == 1) << f;
      }
    });
  }
}

TEST(ClosedSurface, RaysThroughCornersAndEdgesAreDecided) {
  const ClosedSurface cube(weld(box_facets({0, 0, 0}, {1, 1, 1})));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-0.5, 1.5);
  for (int i = 0; i < 2000; ++i) {
    const Point p{any(random), any(random), any(random)};
    const bool in = p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1 && p[2] > 0 && p[2] < 1;
    EXPECT_EQ(cube.contains(p), in);
  }
  // A cell whose known points, corners and the cube's edges are in line with the asked ones.
  const SurfacePiece piece(cube, {-1, -1, -1}, {2, 2, 2});
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 10; ++j) {
      for (int k = 0; k <= 10; ++k) {
        const Point p{-1 + 0.3 * i + 0.01, -1 + 0.3 * j + 0.01, -1 + 0.3 * k + 0.01};
        EXPECT_EQ(piece.contains(p, cube), cube.contains(p));
      }
    }
  }
  const Point rim{0.5, 0.5, 0.5}; // straight through the diagonals of two faces
  EXPECT_EQ(crossing(rim, {1, 0, 0}, 10, {{{1, 0, 0}, {1, 1, 1}, {1, 0, 1}}}), Crossing::tie);
  EXPECT_EQ(crossing(rim, {-1, 0, 0}, 10, {{{1, 0, 0}, {1, 1, 1}, {1, 0, 1}}}), Crossing::none);
}

TEST(ClosedSurface, DistanceIsToTheNearestFacet) {
  const Shape cube = surface_of(weld(box_facets({0, 0, 0}, {1, 1, 1}))), box{Box{{0, 0, 0}, {1, 1, 1}}};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 2);
  for (int i = 0; i < 500; ++i) {
    const Point p{any(random), any(random), any(random)};
    EXPECT_NEAR(signed_distance(cube, p), signed_distance(box, p), 1e-14);
  }
}

TEST(SurfaceFlaw, NamesThePlaceOfTheHole) {
  std::vector<Facet> cube = box_facets({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(surface_flaw(weld(cube)), "");
  const Facet gone = cube.back(); // of the lid z = 1
  cube.pop_back();
  const std::string flaw = surface_flaw(weld(cube));
  EXPECT_NE(flaw.find("a hole at "), std::string::npos) << flaw;
  EXPECT_NE(flaw.find(", 1) m"), std::string::npos) << flaw; // its edges lie in z = 1
  EXPECT_NE(flaw.find("3 open edges"), std::string::npos) << flaw;
  cube.push_back({gone[0], gone[2], gone[1]});
  EXPECT_NE(surface_flaw(weld(cube)).find("opposite ways"), std::string::npos) << surface_flaw(weld(cube));
}

TEST(SurfaceFlaw, FlatCrowdedAndInsideOutSurfacesAreTold) {
  std::vector<Facet> cube = box_facets({0, 0, 0}, {1, 1, 1});
  std::vector<Facet> inwards = cube;
  for (Facet& f : inwards) {
    std::swap(f[1], f[2]);
  }
  EXPECT_NE(surface_flaw(weld(inwards)).find("inwards"), std::string::npos);
  std::vector<Facet> two = cube; // share the edge x = y = 1
  const std::vector<Facet> other = box_facets({1, 1, 0}, {2, 2, 1});
  two.insert(two.end(), other.begin(), other.end());
  EXPECT_NE(surface_flaw(weld(two)).find("4 facets share the edge at (1, 1, 0.5) m"), std::string::npos) << surface_flaw(weld(two));
  cube.push_back({Point{0, 0, 0}, Point{1, 0, 0}, Point{2, 0, 0}});
  EXPECT_NE(surface_flaw(weld(cube)).find("facet 13 at (0, 0, 0) m has no area"), std::string::npos);
}

TEST(SurfaceFlaw, FacetsThatCutEachOtherAreFound) {
  std::vector<Facet> cubes = box_facets({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(self_intersection(weld(cubes)), "");
  const std::vector<Facet> apart = box_facets({2, 0, 0}, {3, 1, 1}), into = box_facets({0.7, 0.6, 0.45}, {1.7, 1.6, 1.45});
  std::vector<Facet> two = cubes;
  two.insert(two.end(), apart.begin(), apart.end());
  EXPECT_EQ(self_intersection(weld(two)), "");
  cubes.insert(cubes.end(), into.begin(), into.end());
  EXPECT_EQ(surface_flaw(weld(cubes)), ""); // each is closed
  EXPECT_NE(self_intersection(weld(cubes)).find("cut each other at "), std::string::npos);
  EXPECT_EQ(self_intersection(ball_mesh({0, 0, 0}, 1, 4)), "");
}

/// The facets of several boxes; `inwards`: the last one faces in.
FacetMesh boxes(std::initializer_list<CellBox> all, bool inwards = false) {
  std::vector<Facet> facets;
  for (const CellBox& box : all) {
    for (Facet f : box_facets(box.lo, box.hi)) {
      if (inwards && &box == all.end() - 1) {
        std::swap(f[1], f[2]);
      }
      facets.push_back(f);
    }
  }
  return weld(facets);
}

TEST(SurfaceFlaw, SolidsThatShareSpaceAreFound) {
  const CellBox cube{{1, 1, 1}, {3, 3, 3}};
  const FacetMesh sharing[] = {
      boxes({cube, {{2, 2, 2}, {4, 4, 4}}}), // edges through the diagonals of faces
      boxes({cube, {{2, 1, 1}, {4, 3, 3}}}), // faces in one plane
      boxes({cube, {{1, 1, 1.5}, {3, 3, 2.5}}}),
      boxes({{{1, 1, 1}, {5, 5, 5}}, {{2, 2, 2}, {4, 4, 4}}}), // one in the other
      boxes({{{0, 0, 0}, {100, 100, 100}}, {{40, 40, 40}, {40.1, 40.1, 40.1}}}),
      boxes({cube, {{4, 4, 4}, {5, 5, 5}}}, true), // a cavity in nothing
  };
  for (const FacetMesh& mesh : sharing) {
    EXPECT_EQ(surface_flaw(mesh), "") << "each is closed";
    EXPECT_NE(shared_space(mesh), "") << &mesh - sharing;
  }
}

TEST(SurfaceFlaw, SolidsApartAndCavitiesAreNone) {
  const CellBox cube{{1, 1, 1}, {3, 3, 3}};
  const FacetMesh apart[] = {
      boxes({cube}), boxes({cube, {{4, 4, 4}, {5, 5, 5}}}),
      boxes({cube, {{3, 1.5, 1.5}, {4, 2.5, 2.5}}}),                 // one flush on the other
      boxes({{{1, 1, 1}, {5, 5, 5}}, {{2, 2, 2}, {4, 4, 4}}}, true), // hollow
      ball_mesh({0.1, 0.2, 0.3}, 1, 4),
  };
  for (const FacetMesh& mesh : apart) {
    EXPECT_EQ(shared_space(mesh), "") << &mesh - apart;
  }
}

// ---- files ----

std::string write_file(const std::string& name, const std::string& bytes) {
  const auto path = std::filesystem::temp_directory_path() / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path.string();
}

std::string text_of(const std::vector<Facet>& facets) {
  std::string out = "solid part\n";
  for (const Facet& f : facets) {
    out += "  facet normal 0 0 0\n    outer loop\n";
    for (const Point& p : f) {
      out += fmt::format("      vertex {} {:e} {}\n", p[0], p[1], p[2]);
    }
    out += "    endloop\n  endfacet\n";
  }
  return out + "endsolid part\n";
}

std::string binary_of(const std::vector<Facet>& facets) {
  std::string out(80, 's');
  const auto put = [&](const auto& value) { out.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(facets.size()));
  for (const Facet& f : facets) {
    for (int i = 0; i < 3; ++i) {
      put(0.0F);
    }
    for (const Point& p : f) {
      for (const double x : p) {
        put(static_cast<float>(x));
      }
    }
    put(static_cast<std::uint16_t>(0));
  }
  return out;
}

TEST(Stl, TextAndBinaryGiveTheSameFacets) {
  const std::vector<Facet> box = box_facets({-12.7, 0.1, 3}, {1.3, 4.4, 5.55});
  const StlFile text = read_stl(write_file("ballast_text.stl", text_of(box)), 1e-3);
  const StlFile binary = read_stl(write_file("ballast_binary.stl", binary_of(box)), 1e-3);
  EXPECT_EQ(text.problem + binary.problem, "");
  EXPECT_EQ(text.facets, binary.facets); // 12.7 as float32 is 12.7
  EXPECT_EQ(text.facets.size(), 12u);
  EXPECT_EQ(text.facets[0][0][0], -12.7 * 1e-3);
  EXPECT_NE(text.checksum, binary.checksum);
}

TEST(Stl, BrokenFilesAreToldWithTheirPlace) {
  const std::vector<Facet> box = box_facets({0, 0, 0}, {1, 1, 1});
  const auto problem = [](const std::string& bytes) { return read_stl(write_file("ballast_broken.stl", bytes), 1).problem; };
  std::string text = text_of(box), binary = binary_of(box);
  EXPECT_NE(problem(text.substr(0, 300)).find("breaks off"), std::string::npos);
  EXPECT_NE(problem("solid x\nfacet normal 0 0 0\nouter loop\nvertex 0 one 2\n").find("line 4: \"one\""), std::string::npos);
  EXPECT_NE(problem("solid x\nfacet\nouter loop\nvertex 0 1 2\nendloop\nendfacet\nendsolid").find("line 6: a facet of 1"), std::string::npos);
  EXPECT_NE(problem(binary.substr(0, 500)).find("12 facets, 684 bytes"), std::string::npos);
  binary.replace(84 + 12, 4, std::string("\x00\x00\xc0\x7f", 4)); // not a number
  EXPECT_NE(problem(binary).find("facet 1 "), std::string::npos);
  EXPECT_NE(read_stl("/nowhere/at_all.stl", 1).problem.find("cannot open"), std::string::npos);
}

} // namespace
} // namespace ballast
