#include "problems/facet_mesh.hpp"

#include "problems/facet_tree.hpp"
#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <unordered_map>

namespace ballast {
namespace {

struct PointHash {
  std::size_t operator()(const Point& p) const {
    std::uint64_t h = 1469598103934665603ULL;
    for (const double x : p) {
      h = (h ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211ULL;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }
};

/// One side of a facet: its ends in ascending order, and whether the facet runs up it.
struct Side {
  int low, high;
  bool up;
  int facet;
  bool same_edge(const Side& o) const { return low == o.low && high == o.high; }
};

std::vector<Side> sorted_sides(const FacetMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.facets.size());
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const auto& f = mesh.facets[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = f[k], b = f[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<int>(i)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  return sides;
}

std::string place(const Point& p) {
  return fmt::format("({:g}, {:g}, {:g}) m", p[0], p[1], p[2]);
}

std::string middle_of(const FacetMesh& mesh, const Side& s) {
  const Point& a = mesh.vertices[static_cast<std::size_t>(s.low)];
  const Point& b = mesh.vertices[static_cast<std::size_t>(s.high)];
  return place({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])});
}

double area(const Facet& f) {
  const Point n = cross(f[1] - f[0], f[2] - f[0]);
  return 0.5 * std::sqrt(dot(n, n));
}

double longest_side(const Facet& f) {
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point d = f[(k + 1) % 3] - f[k];
    longest = std::max(longest, dot(d, d));
  }
  return std::sqrt(longest);
}

/// Flaws of one kind: the first with its text, and the count.
struct Flaws {
  std::string first;
  int count = 0;
  void add(std::string text) {
    first = count++ == 0 ? std::move(text) : first;
  }
  std::string text(const char* what) const {
    return count > 1 ? fmt::format("{}; {} {} in all", first, count, what) : first;
  }
};

std::string flat_facet(const FacetMesh& mesh) {
  constexpr double thin = 1e-12; // of the longest side squared: an area of rounding only
  Flaws flat;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const Facet f = mesh.corners(i);
    const double side = longest_side(f);
    if (!(area(f) > thin * side * side)) {
      flat.add(fmt::format("facet {} at {} has no area", i + 1, place(f[0])));
    }
  }
  return flat.text("such facets");
}

/// Every edge has two facets, and they run along it in opposite ways.
std::string edge_flaw(const FacetMesh& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  Flaws open, crowded, turned;
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    for (end = i; end < sides.size() && sides[end].same_edge(sides[i]); ++end) {
    }
    const Side& s = sides[i];
    if (end - i == 1) {
      open.add(fmt::format(
          "a hole at {}: no facet meets facet {} along that edge", middle_of(mesh, s), s.facet + 1));
    } else if (end - i > 2) {
      crowded.add(fmt::format("{} facets share the edge at {}", end - i, middle_of(mesh, s)));
    } else if (s.up == sides[i + 1].up) {
      turned.add(fmt::format("facets {} and {} face opposite ways at {}",
                             s.facet + 1,
                             sides[i + 1].facet + 1,
                             middle_of(mesh, s)));
    }
  }
  return open.count > 0      ? open.text("open edges")
         : crowded.count > 0 ? crowded.text("such edges")
                             : turned.text("such edges");
}

/// Where the segment p - q goes through the inside of a facet; nothing if it lies in its plane.
bool pierces(const Point& p, const Point& q, const Facet& f, Point& where) {
  const Point n = cross(f[1] - f[0], f[2] - f[0]);
  const double at_p = dot(p - f[0], n), at_q = dot(q - f[0], n);
  if (!((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))) {
    return false;
  }
  const double t = at_p / (at_p - at_q);
  for (std::size_t k = 0; k < 3; ++k) {
    where[k] = p[k] + t * (q[k] - p[k]);
  }
  const double slack = 1e-9 * dot(n, n);
  for (std::size_t k = 0; k < 3; ++k) {
    if (dot(cross(f[(k + 1) % 3] - f[k], where - f[k]), n) <= slack) {
      return false;
    }
  }
  return true;
}

/// Sides of facet i that do not end on facet j, against j.
bool cuts_into(const FacetMesh& mesh, std::size_t i, std::size_t j, Point& where) {
  const auto& a = mesh.facets[i];
  const auto& b = mesh.facets[j];
  const auto shared = [&](int v) { return std::find(b.begin(), b.end(), v) != b.end(); };
  const Facet from = mesh.corners(i), to = mesh.corners(j);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    if (!shared(a[k]) && !shared(a[l]) && pierces(from[k], from[l], to, where)) {
      return true;
    }
  }
  return false;
}

} // namespace

FacetMesh weld(const std::vector<Facet>& soup) {
  FacetMesh mesh;
  std::unordered_map<Point, int, PointHash> known;
  known.reserve(soup.size());
  mesh.facets.reserve(soup.size());
  for (const Facet& facet : soup) {
    std::array<int, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) {
      Point p = facet[k];
      for (double& x : p) {
        x += 0.0; // -0 is 0
      }
      const auto [at, made] = known.try_emplace(p, static_cast<int>(mesh.vertices.size()));
      if (made) {
        mesh.vertices.push_back(p);
      }
      ids[k] = at->second;
    }
    mesh.facets.push_back(ids);
  }
  return mesh;
}

double enclosed_volume(const FacetMesh& mesh) {
  const Point origin = mesh.vertices.empty() ? Point{} : mesh.vertices.front();
  double six = 0;
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const Facet f = mesh.corners(i);
    six += dot(f[0] - origin, cross(f[1] - origin, f[2] - origin));
  }
  return six / 6;
}

std::string surface_flaw(const FacetMesh& mesh) {
  if (mesh.facets.size() < 4) {
    return fmt::format("{} facets enclose nothing", mesh.facets.size());
  }
  std::string flaw = flat_facet(mesh);
  flaw = flaw.empty() ? edge_flaw(mesh) : flaw;
  if (flaw.empty() && !(enclosed_volume(mesh) > 0)) {
    flaw = fmt::format("the facets face inwards: they enclose {:g} m3", enclosed_volume(mesh));
  }
  return flaw;
}

std::string self_intersection(const FacetMesh& mesh) {
  const FacetTree tree(mesh);
  std::vector<int> near;
  Point where{};
  for (std::size_t i = 0; i < mesh.facets.size(); ++i) {
    const Bounds b = bounds_of(mesh.corners(i));
    near.clear();
    tree.collect(b.lo, b.hi, near);
    for (const int j : near) {
      const auto other = static_cast<std::size_t>(j);
      if (other != i && cuts_into(mesh, i, other, where)) {
        return fmt::format("facets {} and {} cut each other at {}", i + 1, other + 1, place(where));
      }
    }
  }
  return "";
}

} // namespace ballast
