#include "problems/facet_tree.hpp"

#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ballast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int leaf_size = 4;

bool overlap(const Bounds& b, const Point& lo, const Point& hi) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (b.hi[k] < lo[k] || b.lo[k] > hi[k]) {
      return false;
    }
  }
  return true;
}

void grow(Bounds& b, const Bounds& by) {
  for (std::size_t k = 0; k < 3; ++k) {
    b.lo[k] = std::min(b.lo[k], by.lo[k]);
    b.hi[k] = std::max(b.hi[k], by.hi[k]);
  }
}

Bounds nothing() {
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

/// Does the ray from o meet the box? Never a false no: the box is taken a little larger.
bool meets(const Bounds& b, const Point& o, const Point& d) {
  double from = 0, to = infinity;
  for (std::size_t k = 0; k < 3; ++k) {
    const double slack = 1e-12 * (std::abs(b.lo[k]) + std::abs(b.hi[k]) + std::abs(o[k]));
    const double lo = b.lo[k] - slack - o[k], hi = b.hi[k] + slack - o[k];
    if (d[k] == 0) {
      if (lo > 0 || hi < 0) {
        return false;
      }
      continue;
    }
    from = std::max(from, std::min(lo / d[k], hi / d[k]));
    to = std::min(to, std::max(lo / d[k], hi / d[k]));
  }
  return from <= to * (1 + 1e-12);
}

/// Square of the distance from a point to a box.
double distance2(const Bounds& b, const Point& p) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::max({b.lo[k] - p[k], p[k] - b.hi[k], 0.0});
    sum += d * d;
  }
  return sum;
}

/// Does the plane of the facet pass through the box (its corners on both sides, or on it)?
bool plane_meets(const Facet& f, const Point& lo, const Point& hi) {
  const Point n = cross(f[1] - f[0], f[2] - f[0]);
  Point middle{};
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = 0.5 * (lo[k] + hi[k]) - f[0][k];
    reach += 0.5 * (hi[k] - lo[k]) * std::abs(n[k]);
  }
  return std::abs(dot(middle, n)) <= reach * (1 + 1e-12);
}

} // namespace

Bounds bounds_of(const Facet& f) {
  Bounds b{f[0], f[0]};
  for (const Point& p : f) {
    grow(b, {p, p});
  }
  return b;
}

Crossing crossing(const Point& o, const Point& d, double reach, const Facet& facet) {
  const Point a = facet[0] - o, b = facet[1] - o, c = facet[2] - o;
  // Volumes that the ray spans with the three sides: one sign on all where it passes inside.
  const double u = dot(d, cross(c, b)), v = dot(d, cross(a, c)), w = dot(d, cross(b, a));
  const double size2 = std::max({dot(a, a), dot(b, b), dot(c, c)});
  const double rounding = 1e-14 * std::sqrt(dot(d, d)) * size2;
  const bool up = u > rounding || v > rounding || w > rounding;
  const bool down = u < -rounding || v < -rounding || w < -rounding;
  if (up && down) {
    return Crossing::none;
  }
  const double whole = u + v + w;
  if (std::abs(whole) <= 3 * rounding) {
    return Crossing::tie;
  }
  const double t = (u * dot(a, d) + v * dot(b, d) + w * dot(c, d)) / (whole * dot(d, d));
  if (!(t > 0 && t < reach)) {
    return Crossing::none;
  }
  const double least = std::min({std::abs(u), std::abs(v), std::abs(w)});
  return least <= rounding ? Crossing::tie : Crossing::through;
}

double facet_distance(const Point& p, const Facet& f) {
  const auto from = [&](const Point& q) {
    const Point d = p - q;
    return std::sqrt(dot(d, d));
  };
  const auto along = [&](const Point& q, const Point& e, double t) {
    return from({q[0] + t * e[0], q[1] + t * e[1], q[2] + t * e[2]});
  };
  const Point ab = f[1] - f[0], ac = f[2] - f[0], bc = f[2] - f[1];
  const double d1 = dot(ab, p - f[0]), d2 = dot(ac, p - f[0]);
  const double d3 = dot(ab, p - f[1]), d4 = dot(ac, p - f[1]);
  const double d5 = dot(ab, p - f[2]), d6 = dot(ac, p - f[2]);
  if (d1 <= 0 && d2 <= 0) {
    return from(f[0]);
  }
  if (d3 >= 0 && d4 <= d3) {
    return from(f[1]);
  }
  if (d6 >= 0 && d5 <= d6) {
    return from(f[2]);
  }
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    return along(f[0], ab, d1 / (d1 - d3));
  }
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    return along(f[0], ac, d2 / (d2 - d6));
  }
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return along(f[1], bc, (d4 - d3) / ((d4 - d3) + (d5 - d6)));
  }
  const Point n = cross(ab, ac);
  return std::abs(dot(p - f[0], n)) / std::sqrt(dot(n, n));
}

FacetTree::FacetTree(const FacetMesh& mesh) : mesh_(&mesh), order_(mesh.facets.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  std::vector<Point> centres(order_.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Facet f = mesh.corners(i);
    for (std::size_t k = 0; k < 3; ++k) {
      centres[i][k] = (f[0][k] + f[1][k] + f[2][k]) / 3;
    }
  }
  nodes_.emplace_back();
  build(0, 0, static_cast<int>(order_.size()), centres);
}

void FacetTree::build(int node, int begin, int end, const std::vector<Point>& centres) {
  Bounds box = nothing(), spread = nothing();
  for (int i = begin; i < end; ++i) {
    const Point& c = centres[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    grow(box, bounds_of(facet(i)));
    grow(spread, {c, c});
  }
  nodes_[static_cast<std::size_t>(node)].box = box;
  if (end - begin <= leaf_size) {
    nodes_[static_cast<std::size_t>(node)].first = begin;
    nodes_[static_cast<std::size_t>(node)].count = end - begin;
    return;
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    axis = spread.hi[k] - spread.lo[k] > spread.hi[axis] - spread.lo[axis] ? k : axis;
  }
  const int middle = begin + (end - begin) / 2;
  const auto at = [&](int i) { return order_.begin() + i; };
  std::nth_element(at(begin), at(middle), at(end), [&](int a, int b) {
    const double x = centres[static_cast<std::size_t>(a)][axis], y = centres[static_cast<std::size_t>(b)][axis];
    return x < y || (x == y && a < b); // one tree for one surface
  });
  const int child = static_cast<int>(nodes_.size());
  nodes_[static_cast<std::size_t>(node)].first = child;
  nodes_[static_cast<std::size_t>(node)].count = -1;
  nodes_.resize(nodes_.size() + 2);
  build(child, begin, middle, centres);
  build(child + 1, middle, end, centres);
}

/// Goes down where `enter`(box) is true; `leaf`(position in order_) returns false to stop.
template <class Enter, class Leaf> void FacetTree::walk(Enter&& enter, Leaf&& leaf) const {
  std::array<int, 128> stack{}; // halving: depth below 32 for any count
  int top = 0;
  stack[static_cast<std::size_t>(top++)] = 0;
  while (top > 0) {
    const Node& node = nodes_[static_cast<std::size_t>(stack[static_cast<std::size_t>(--top)])];
    if (!enter(node.box)) {
      continue;
    }
    if (node.count < 0) {
      stack[static_cast<std::size_t>(top++)] = node.first + 1;
      stack[static_cast<std::size_t>(top++)] = node.first;
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      if (!leaf(i)) {
        return;
      }
    }
  }
}

void FacetTree::collect(const Point& lo, const Point& hi, std::vector<int>& out) const {
  walk([&](const Bounds& b) { return overlap(b, lo, hi); },
       [&](int i) {
         if (overlap(bounds_of(facet(i)), lo, hi)) {
           out.push_back(order_[static_cast<std::size_t>(i)]);
         }
         return true;
       });
}

bool FacetTree::touches(const Point& lo, const Point& hi) const {
  bool found = false;
  walk([&](const Bounds& b) { return overlap(b, lo, hi); },
       [&](int i) {
         const Facet f = facet(i);
         found = overlap(bounds_of(f), lo, hi) && plane_meets(f, lo, hi);
         return !found;
       });
  return found;
}

int FacetTree::crossings(const Point& o, const Point& d) const {
  int count = 0;
  walk([&](const Bounds& b) { return meets(b, o, d); },
       [&](int i) {
         const Crossing c = crossing(o, d, infinity, facet(i));
         count = c == Crossing::tie ? -1 : count + (c == Crossing::through);
         return c != Crossing::tie;
       });
  return count;
}

double FacetTree::distance(const Point& p) const {
  double best = infinity;
  walk([&](const Bounds& b) { return distance2(b, p) < best * best; },
       [&](int i) {
         best = std::min(best, facet_distance(p, facet(i)));
         return true;
       });
  return best;
}

} // namespace ballast
