#include "ale/embed/open_part.hpp"

#include <numbers>

namespace ballast {

namespace {

/// A polygon's volume (2D: area; around an axis the ring's) and its gradient to a vertex.
struct Polygon {
  static constexpr int most = 8;
  int count = 0;
  std::array<std::array<double, 2>, most> x = {};

  void add(const std::array<double, 2>& at) { x[static_cast<std::size_t>(count++)] = at; }
  const std::array<double, 2>& at(int v) const { return x[static_cast<std::size_t>((v + count) % count)]; }

  double volume(bool axisymmetric) const {
    // From the first vertex on: products of far coordinates would cost digits. Around an axis 2 pi (r0 A + integral of r - r0).
    const auto& o = at(0);
    double area = 0, moment = 0;
    for (int v = 1; v + 1 < count; ++v) {
      const double ax = at(v)[0] - o[0], ay = at(v)[1] - o[1], bx = at(v + 1)[0] - o[0], by = at(v + 1)[1] - o[1];
      const double twice = ax * by - bx * ay;
      area += 0.5 * twice;
      moment += twice * (ax + bx) / 6;
    }
    return axisymmetric ? 2 * std::numbers::pi * (o[0] * area + moment) : area;
  }
  std::array<double, 2> gradient(int v, bool axisymmetric) const {
    const auto &m = at(v - 1), &p = at(v), &n = at(v + 1);
    if (!axisymmetric) {
      return {0.5 * (n[1] - m[1]), 0.5 * (m[0] - n[0])};
    }
    constexpr double w = std::numbers::pi / 3;
    return {w * ((2 * p[0] + n[0]) * (n[1] - p[1]) + (2 * p[0] + m[0]) * (p[1] - m[1])), w * (m[0] - n[0]) * (m[0] + p[0] + n[0])};
  }
};

/// A vertex of the open polygon: a corner, or where the surface crosses the edge between two.
struct Vertex {
  int from, to; ///< corners; the same for a corner itself
  double part;  ///< of the way from one to the other
};

struct OpenPolygon {
  Polygon shape;
  std::array<Vertex, Polygon::most> vertex = {};

  void corner(const LevelCell<2>& c, int p) {
    vertex[static_cast<std::size_t>(shape.count)] = {p, p, 0};
    shape.add(c.x[static_cast<std::size_t>(p)]);
  }
  void crossing(const LevelCell<2>& c, int p, int q) {
    if (c.level[static_cast<std::size_t>(p)] < c.level[static_cast<std::size_t>(q)]) {
      std::swap(p, q); // both cells of an edge compute the same point, to the bit
    }
    const auto &a = c.x[static_cast<std::size_t>(p)], &b = c.x[static_cast<std::size_t>(q)];
    const double la = c.level[static_cast<std::size_t>(p)], lb = c.level[static_cast<std::size_t>(q)], t = la / (la - lb);
    vertex[static_cast<std::size_t>(shape.count)] = {p, q, t};
    shape.add({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
  }
};

/// The open polygons of a quadrilateral: one, or two at opposite corners with the body between.
int open_polygons(const LevelCell<2>& c, std::array<OpenPolygon, 2>& out) {
  bool open[4];
  int count = 0;
  for (int p = 0; p < 4; ++p) {
    open[p] = c.level[static_cast<std::size_t>(p)] > 0;
    count += open[p] ? 1 : 0;
  }
  if (count == 0) {
    return 0;
  }
  const bool saddle = count == 2 && open[0] == open[2];
  if (saddle) {
    int at = 0;
    for (int p = 0; p < 4; ++p) {
      if (open[p]) {
        auto& o = out[static_cast<std::size_t>(at++)];
        o.crossing(c, p, (p + 3) & 3);
        o.corner(c, p);
        o.crossing(c, p, (p + 1) & 3);
      }
    }
    return 2;
  }
  for (int p = 0; p < 4; ++p) {
    const int q = (p + 1) & 3;
    if (open[p]) {
      out[0].corner(c, p);
    }
    if (open[p] != open[q]) {
      out[0].crossing(c, p, q);
    }
  }
  return 1;
}

/// Open part of a triangle by its corners' levels, with the triangle's sense of rotation.
double open_triangle(const std::array<std::array<double, 2>, 3>& x, const std::array<double, 3>& level, bool axisymmetric) {
  Polygon shape;
  for (std::size_t p = 0; p < 3; ++p) {
    const std::size_t q = (p + 1) % 3;
    if (level[p] > 0) {
      shape.add(x[p]);
    }
    if ((level[p] > 0) != (level[q] > 0)) {
      const std::size_t a = level[p] > level[q] ? p : q, b = a == p ? q : p;
      const double t = level[a] / (level[a] - level[b]);
      shape.add({x[a][0] + t * (x[b][0] - x[a][0]), x[a][1] + t * (x[b][1] - x[a][1])});
    }
  }
  return shape.count > 2 ? shape.volume(axisymmetric) : 0.0;
}

} // namespace

template <> OpenPart<2> open_part<2>(const LevelCell<2>& c, bool axisymmetric) {
  std::array<OpenPolygon, 2> parts;
  const int count = open_polygons(c, parts);
  OpenPart<2> out;
  for (int k = 0; k < count; ++k) {
    const OpenPolygon& o = parts[static_cast<std::size_t>(k)];
    out.volume += o.shape.volume(axisymmetric);
    for (int v = 0; v < o.shape.count; ++v) {
      const auto g = o.shape.gradient(v, axisymmetric);
      const Vertex& at = o.vertex[static_cast<std::size_t>(v)];
      const auto p = static_cast<std::size_t>(at.from), q = static_cast<std::size_t>(at.to);
      for (std::size_t d = 0; d < 2; ++d) {
        out.at_node[p][d] += (1 - at.part) * g[d];
        out.at_node[q][d] += at.part * g[d];
      }
      if (p != q) { // t = a / (a - b)
        const double a = c.level[p], b = c.level[q], along = g[0] * (c.x[q][0] - c.x[p][0]) + g[1] * (c.x[q][1] - c.x[p][1]);
        const double square = (a - b) * (a - b);
        out.at_level[p] -= along * b / square;
        out.at_level[q] += along * a / square;
      }
    }
  }
  return out;
}

template <> double open_volume<2>(const LevelCell<2>& c, bool axisymmetric) {
  std::array<OpenPolygon, 2> parts;
  const int count = open_polygons(c, parts);
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    sum += parts[static_cast<std::size_t>(k)].shape.volume(axisymmetric);
  }
  return sum;
}

template <> double open_share<2>(const std::array<double, 2>& level) {
  const auto [a, b] = level;
  if (a > 0 && b > 0) {
    return 1;
  }
  return a > 0 ? a / (a - b) : b > 0 ? b / (b - a) : 0.0;
}

template <> double open_swept<2>(const SweptFace<2>& f, bool axisymmetric) {
  // The quadrilateral a, a', b', b in two triangles with their signs: crossed ones, too, add up.
  const auto &a = f.before[0], &b = f.before[1], &a1 = f.after[0], &b1 = f.after[1];
  return open_triangle({a, a1, b1}, {f.level_before[0], f.level_after[0], f.level_after[1]}, axisymmetric) +
         open_triangle({a, b1, b}, {f.level_before[0], f.level_after[1], f.level_before[1]}, axisymmetric);
}

} // namespace ballast
