// A surface of flat triangles: vertices shared between facets, and what keeps it from enclosing a
// solid. Normals point out by the right-hand rule: the volume
//   V = 1/6 sum a . (b x c)   (divergence theorem)
// is positive.
#pragma once

#include "problems/shapes.hpp"

#include <string>
#include <vector>

namespace ballast {

using Facet = std::array<Point, 3>;

struct FacetMesh {
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> facets;
  Facet corners(std::size_t i) const {
    const auto& f = facets[i];
    return {vertices[static_cast<std::size_t>(f[0])],
            vertices[static_cast<std::size_t>(f[1])],
            vertices[static_cast<std::size_t>(f[2])]};
  }
};

/// Vertices that agree to the last bit become one.
FacetMesh weld(const std::vector<Facet>& soup);

/// Enclosed volume (m3); negative if the facets face inwards.
double enclosed_volume(const FacetMesh& mesh);

/// Why the facets enclose no solid, with the place (m) of the first flaw and how many there are:
/// a facet without area, an open edge (hole), an edge of more than two facets, neighbours that face
/// opposite ways, facets that face inwards. Empty: none.
std::string surface_flaw(const FacetMesh& mesh);

/// Where two facets cut each other; facets that lie in one plane are not looked at. Empty: nowhere.
std::string self_intersection(const FacetMesh& mesh);

} // namespace ballast
