#include "problems/mapped_fractions.hpp"

#include "core/hex_geometry.hpp"
#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace ballast {

namespace {

constexpr int samples_along = 16; ///< of a line, between which a change of owner is searched
constexpr int bisections = 40;

struct MappedCell {
  const MeshMap& map;
  Geometry geometry;
  Point lo, hi;

  int dim() const { return dimensions(geometry); }
  /// Place of unit coordinates s of the cell.
  Point at(const Point& s) const {
    Point q{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim()); ++k) {
      q[k] = lo[k] + s[k] * (hi[k] - lo[k]);
    }
    return place(map, q);
  }
  /// Volume by unit volume at s, but for 2 pi.
  double weight(const Point& s) const {
    constexpr double step = 1e-4;
    Point t[3] = {};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim()); ++k) {
      Point a = s, b = s;
      a[k] -= step;
      b[k] += step;
      t[k] = at(b) - at(a);
    }
    const double area = t[0][0] * t[1][1] - t[0][1] * t[1][0];
    if (dim() == 2) {
      return area * (geometry == Geometry::axisymmetric ? at(s)[0] : 1.0);
    }
    const Point across = {t[0][1] * t[1][2] - t[0][2] * t[1][1], t[0][2] * t[1][0] - t[0][0] * t[1][2], area};
    return dot(across, t[2]);
  }
  /// No point of the cell is further from its middle (nearly: sides bulge by less than the margin).
  double reach() const {
    constexpr double margin = 1.05;
    const Point c = at({0.5, 0.5, 0.5});
    double most = 0;
    for (int q = 0; q < (dim() == 3 ? 27 : 9); ++q) {
      const Point d = at({0.5 * (q % 3), 0.5 * (q / 3 % 3), 0.5 * (q / 9)}) - c;
      most = std::max(most, dot(d, d));
    }
    return margin * std::sqrt(most);
  }
};

/// Shapes that may show in the cell, ascending; `cut`: whether any of their surfaces may pass through it.
struct Candidates {
  std::vector<std::size_t> shapes;
  bool cut = false;
};

Candidates candidates_of(std::span<const Shape* const> shapes, const MappedCell& cell) {
  Candidates found;
  const Point c = cell.at({0.5, 0.5, 0.5});
  const double reach = cell.reach();
  for (std::size_t s = shapes.size(); s-- > 0;) { // what lies under a full one is hidden
    const double d = signed_distance(*shapes[s], c);
    if (d >= reach) {
      continue;
    }
    found.shapes.insert(found.shapes.begin(), s);
    if (d <= -reach) {
      break;
    }
    found.cut = true;
  }
  return found;
}

class Caster {
public:
  Caster(std::span<const Shape* const> shapes, const std::vector<std::size_t>& candidates, const MappedCell& cell)
      : shapes_(shapes), candidates_(candidates), cell_(cell) {}

  /// Adds each owner's weight to sums; returns the weight of the whole cell.
  double cast(std::span<double> sums) const {
    const std::size_t k = best_axis(), j = k == 0 ? 1 : 0, l = 3 - j - k;
    const int lines = cell_.dim() == 3 ? 12 : 24, layers = cell_.dim() == 3 ? lines : 1;
    double whole = 0;
    for (int b = 0; b < layers; ++b) {
      for (int a = 0; a < lines; ++a) {
        Point s{};
        s[j] = (a + 0.5) / lines;
        s[l] = cell_.dim() == 3 ? (b + 0.5) / layers : 0.0;
        whole += cast_line(s, k, sums);
      }
    }
    return whole;
  }

private:
  int owner(const Point& s) const {
    const Point p = cell_.at(s);
    for (auto it = candidates_.rbegin(); it != candidates_.rend(); ++it) {
      if (contains(*shapes_[*it], p)) {
        return static_cast<int>(*it);
      }
    }
    return -1;
  }

  /// The axis along which the owner changes most often on a coarse grid.
  std::size_t best_axis() const {
    constexpr int n = 5;
    const int layers = cell_.dim() == 3 ? n : 1;
    std::vector<int> owners;
    for (int q = 0; q < n * n * layers; ++q) {
      owners.push_back(owner({(q % n + 0.5) / n, (q / n % n + 0.5) / n, layers > 1 ? (q / (n * n) + 0.5) / n : 0.0}));
    }
    std::array<int, 3> changes{};
    for (int q = 0; q < n * n * layers; ++q) {
      const auto here = owners[static_cast<std::size_t>(q)];
      changes[0] += q % n > 0 && here != owners[static_cast<std::size_t>(q - 1)];
      changes[1] += q / n % n > 0 && here != owners[static_cast<std::size_t>(q - n)];
      changes[2] += q / (n * n) > 0 && here != owners[static_cast<std::size_t>(q - n * n)];
    }
    return static_cast<std::size_t>(std::max_element(changes.begin(), changes.end()) - changes.begin());
  }

  /// Where the owner `who` of s[k] = a ends before b.
  double change(Point s, std::size_t k, double a, double b, int who) const {
    for (int q = 0; q < bisections; ++q) {
      s[k] = 0.5 * (a + b);
      (owner(s) == who ? a : b) = s[k];
    }
    return 0.5 * (a + b);
  }

  /// Weight of the stretch a..b of a line.
  double stretch(Point s, std::size_t k, double a, double b) const {
    constexpr int parts = 4;
    double sum = 0;
    for (int q = 0; q < parts; ++q) {
      s[k] = a + (q + 0.5) / parts * (b - a);
      sum += cell_.weight(s) * (b - a) / parts;
    }
    return sum;
  }

  double cast_line(Point s, std::size_t k, std::span<double> sums) const {
    const auto sample = [](int q) { return (q + 0.5) / samples_along; };
    double from = 0, whole = 0;
    s[k] = sample(0);
    int who = owner(s);
    const auto end_at = [&](double to) {
      const double w = stretch(s, k, from, to);
      whole += w;
      if (who >= 0) {
        sums[static_cast<std::size_t>(who)] += w;
      }
      from = to;
    };
    for (int q = 1; q < samples_along; ++q) {
      s[k] = sample(q);
      const int next = owner(s);
      if (next != who) {
        end_at(change(s, k, sample(q - 1), sample(q), who));
        who = next;
      }
    }
    end_at(1);
    return whole;
  }

  std::span<const Shape* const> shapes_;
  const std::vector<std::size_t>& candidates_;
  const MappedCell& cell_;
};

/// Corners of the cell in the order of core/hex_geometry.
std::array<Point, 8> corners(const MeshMap& map, Geometry geometry, const Point& lo, const Point& hi) {
  std::array<Point, 8> p{};
  for (int c = 0; c < 8; ++c) {
    const bool i = (c & 3) == 1 || (c & 3) == 2, j = (c & 2) != 0, k = c >= 4 && geometry == Geometry::three_d;
    p[static_cast<std::size_t>(c)] = place(map, {i ? hi[0] : lo[0], j ? hi[1] : lo[1], k ? hi[2] : lo[2]});
  }
  return p;
}

template <bool Axisymmetric> double quad_volume(const std::array<Point, 8>& p) {
  const QuadGeometry<Axisymmetric> q{{p[0][0], p[1][0], p[2][0], p[3][0]}, {p[0][1], p[1][1], p[2][1], p[3][1]}};
  return q.volume();
}

} // namespace

void mapped_fractions(std::span<const Shape* const> shapes, const MeshMap& map, Geometry geometry, const Point& lo, const Point& hi, std::span<double> shares) {
  const MappedCell cell{map, geometry, lo, hi};
  std::fill(shares.begin(), shares.end(), 0.0);
  const Candidates found = candidates_of(shapes, cell);
  if (found.shapes.empty()) {
    return;
  }
  if (!found.cut) {
    shares[found.shapes.front()] = 1;
    return;
  }
  const double whole = Caster(shapes, found.shapes, cell).cast(shares);
  for (double& share : shares) {
    share /= whole;
    share = share < 1e-12 ? 0.0 : (share > 1 - 1e-12 ? 1.0 : share);
  }
}

double mapped_cell_volume(const MeshMap& map, Geometry geometry, const Point& lo, const Point& hi) {
  const auto p = corners(map, geometry, lo, hi);
  if (geometry != Geometry::three_d) {
    return geometry == Geometry::axisymmetric ? quad_volume<true>(p) : quad_volume<false>(p);
  }
  HexGeometry h{};
  for (std::size_t c = 0; c < 8; ++c) {
    h.x[c] = p[c][0];
    h.y[c] = p[c][1];
    h.z[c] = p[c][2];
  }
  return h.volume();
}

double mapped_cell_size(const MeshMap& map, Geometry geometry, const Point& lo, const Point& hi) {
  static constexpr std::size_t edges[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
  const auto p = corners(map, geometry, lo, hi);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < (geometry == Geometry::three_d ? 12U : 4U); ++e) {
    const Point d = p[edges[e][1]] - p[edges[e][0]];
    least = std::min(least, std::sqrt(dot(d, d)));
  }
  return least;
}

} // namespace ballast
