// Facets of bodies that tests need: boxes and round balls.
#pragma once

#include "problems/closed_surface.hpp"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace ballast::testing {

inline std::vector<Facet> box_facets(const Point& lo, const Point& hi) {
  const auto corner = [&](int i) {
    return Point{i & 1 ? hi[0] : lo[0], i & 2 ? hi[1] : lo[1], i & 4 ? hi[2] : lo[2]};
  };
  constexpr int quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<Facet> out;
  for (const auto& q : quads) {
    out.push_back({corner(q[0]), corner(q[1]), corner(q[2])});
    out.push_back({corner(q[0]), corner(q[2]), corner(q[3])});
  }
  return out;
}

/// An icosahedron with its sides halved `halvings` times and pushed out to the sphere.
inline FacetMesh ball_mesh(const Point& centre, double radius, int halvings) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  FacetMesh m;
  m.vertices = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  m.facets = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
              {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
  for (int level = 0; level < halvings; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, made] = middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(m.vertices.size()));
      if (made) {
        const Point p = m.vertices[static_cast<std::size_t>(a)], q = m.vertices[static_cast<std::size_t>(b)];
        m.vertices.push_back({0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2])});
      }
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& f : m.facets) {
      const int a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    m.facets = std::move(finer);
  }
  for (Point& p : m.vertices) {
    const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = centre[k] + radius * p[k] / length;
    }
  }
  return m;
}

inline Shape surface_of(FacetMesh mesh) {
  return Shape{Surface{std::make_shared<const ClosedSurface>(std::move(mesh)), nullptr}};
}

} // namespace ballast::testing
