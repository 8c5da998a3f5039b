// A tree of boxes over the facets of a surface: which facets a box touches, a ray crosses, and how
// far the nearest one is. Built by halving along the longest axis; leaves hold a few facets.
#pragma once

#include "problems/facet_mesh.hpp"

namespace ballast {

/// How a ray o + t d, 0 < t < reach, meets a facet. `tie`: within rounding of its rim, or along its
/// plane: ask along another ray.
enum class Crossing { none, through, tie };
Crossing crossing(const Point& o, const Point& d, double reach, const Facet& facet);

/// Distance from a point to a facet (Ericson, Real-Time Collision Detection, 5.1.5), m.
double facet_distance(const Point& p, const Facet& facet);

Bounds bounds_of(const Facet& facet);

class FacetTree {
public:
  /// The mesh must outlive the tree.
  explicit FacetTree(const FacetMesh& mesh);
  /// Adds the facets whose own boxes touch the box lo..hi, ascending along the tree.
  void collect(const Point& lo, const Point& hi, std::vector<int>& out) const;
  /// Does the box lo..hi touch the box of a facet and meet its plane?
  bool touches(const Point& lo, const Point& hi) const;
  /// Facets crossed by the ray from o along d; -1: a tie.
  int crossings(const Point& o, const Point& d) const;
  /// Distance to the nearest facet, m.
  double distance(const Point& p) const;

private:
  struct Node {
    Bounds box;
    int first = 0, count = 0; ///< of order_; count -1: children first and first + 1
  };
  void build(int node, int begin, int end, const std::vector<Point>& centres);
  Facet facet(int at) const { return mesh_->corners(static_cast<std::size_t>(order_[static_cast<std::size_t>(at)])); }
  template <class Enter, class Leaf> void walk(Enter&& enter, Leaf&& leaf) const;

  const FacetMesh* mesh_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

} // namespace ballast
