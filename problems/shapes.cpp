#include "problems/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace ballast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point axis_of(const Cylinder& c) {
  Point a = c.to - c.from;
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}
/// The mesh axis a unit vector lies along, or -1.
int aligned_with(const Point& a) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(std::abs(a[k]) - 1) < 1e-12) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

/// Position along the axis and distance from it.
std::array<double, 2> turned(const Revolved& r, const Point& p) {
  const Point d = p - r.origin;
  const double z = dot(d, r.axis);
  return {z, std::sqrt(std::max(0.0, dot(d, d) - z * z))};
}

double segment_distance(const std::array<double, 2>& p,
                        const std::array<double, 2>& a,
                        const std::array<double, 2>& b) {
  const double dz = b[0] - a[0], dr = b[1] - a[1];
  const double length2 = dz * dz + dr * dr;
  const double t =
      length2 > 0 ? std::clamp(((p[0] - a[0]) * dz + (p[1] - a[1]) * dr) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p[0] - a[0] - t * dz, p[1] - a[1] - t * dr);
}

/// First profile segment that can reach z: index i of points i, i + 1.
std::size_t segment_at(const Revolved& r, double z) {
  const auto above =
      std::upper_bound(r.profile.begin(), r.profile.end(), z, [](double value, const auto& point) {
        return value < point[0];
      });
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, above - r.profile.begin()) - 1);
}

bool inside_outline(const Revolved& r, const std::array<double, 2>& p) {
  if (p[0] <= r.profile.front()[0] || p[0] >= r.profile.back()[0]) {
    return false;
  }
  const std::size_t i = segment_at(r, p[0]);
  const auto& a = r.profile[i];
  const auto& b = r.profile[i + 1];
  const double share = b[0] > a[0] ? (p[0] - a[0]) / (b[0] - a[0]) : 0.0;
  return p[1] < a[1] + share * (b[1] - a[1]);
}

// ---- signed distance ----

double distance_to(const Box& box, const Point& p) {
  double inside = -infinity, outside2 = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double d = std::max(box.from[k] - p[k], p[k] - box.to[k]);
    inside = std::max(inside, d);
    outside2 += d > 0 ? d * d : 0.0;
  }
  return inside > 0 ? std::sqrt(outside2) : inside;
}

double distance_to(const Sphere& s, const Point& p) {
  const Point d = p - s.centre;
  return std::sqrt(dot(d, d)) - s.radius;
}

double distance_to(const Cylinder& c, const Point& p) {
  const Point a = axis_of(c), d = p - c.from, end = c.to - c.from;
  const double along = dot(d, a);
  const double radial = std::sqrt(std::max(0.0, dot(d, d) - along * along)) - c.radius;
  return std::max({radial, -along, along - dot(end, a)});
}

double distance_to(const Revolved& r, const Point& p) {
  const auto q = turned(r, p);
  const std::array<double, 2> base{r.profile.front()[0], 0.0}, tip{r.profile.back()[0], 0.0};
  double d = std::min(segment_distance(q, base, r.profile.front()),
                      segment_distance(q, tip, r.profile.back()));
  for (std::size_t i = 0; i + 1 < r.profile.size(); ++i) {
    d = std::min(d, segment_distance(q, r.profile[i], r.profile[i + 1]));
  }
  return inside_outline(r, q) ? -d : d;
}

double distance_to(const HalfSpace& h, const Point& p) {
  return dot(p - h.point, h.outward);
}

double distance_to(const Combination& c, const Point& p) {
  double d = signed_distance(c.parts.front(), p);
  for (std::size_t i = 1; i < c.parts.size(); ++i) {
    const double other = signed_distance(c.parts[i], p);
    switch (c.kind) {
    case Combination::Kind::unite:
      d = std::min(d, other);
      break;
    case Combination::Kind::intersect:
      d = std::max(d, other);
      break;
    case Combination::Kind::subtract:
      d = std::max(d, -other);
      break;
    }
  }
  return d;
}

// ---- inside or not ----

template <class Form> bool holds(const Form& form, const Point& p) {
  return distance_to(form, p) < 0;
}
bool holds(const Revolved& r, const Point& p) {
  return inside_outline(r, turned(r, p));
}
bool holds(const Combination& c, const Point& p) {
  const auto in = [&](const Shape& part) { return contains(part, p); };
  switch (c.kind) {
  case Combination::Kind::unite:
    return std::any_of(c.parts.begin(), c.parts.end(), in);
  case Combination::Kind::intersect:
    return std::all_of(c.parts.begin(), c.parts.end(), in);
  case Combination::Kind::subtract:
    break;
  }
  return in(c.parts.front()) && std::none_of(c.parts.begin() + 1, c.parts.end(), in);
}

// ---- bounds ----

Bounds bounds_of(const Box& box) {
  return {box.from, box.to};
}

Bounds bounds_of(const Sphere& s) {
  Bounds b{s.centre, s.centre};
  for (std::size_t k = 0; k < 3; ++k) {
    b.lo[k] -= s.radius;
    b.hi[k] += s.radius;
  }
  return b;
}

/// Round a segment from - to along `axis` with the given radius.
Bounds tube(const Point& from, const Point& to, const Point& axis, double radius) {
  Bounds b;
  for (std::size_t k = 0; k < 3; ++k) {
    const double reach = radius * std::sqrt(std::max(0.0, 1 - axis[k] * axis[k]));
    b.lo[k] = std::min(from[k], to[k]) - reach;
    b.hi[k] = std::max(from[k], to[k]) + reach;
  }
  return b;
}

Bounds bounds_of(const Cylinder& c) {
  return tube(c.from, c.to, axis_of(c), c.radius);
}

Bounds bounds_of(const Revolved& r) {
  Point from = r.origin, to = r.origin;
  double radius = 0;
  for (const auto& point : r.profile) {
    radius = std::max(radius, point[1]);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    from[k] += r.profile.front()[0] * r.axis[k];
    to[k] += r.profile.back()[0] * r.axis[k];
  }
  return tube(from, to, r.axis, radius);
}

Bounds bounds_of(const HalfSpace& h) {
  Bounds b;
  const int k = aligned_with(h.outward);
  if (k >= 0) {
    const auto i = static_cast<std::size_t>(k);
    (h.outward[i] > 0 ? b.hi : b.lo)[i] = h.point[i];
  }
  return b;
}

Bounds bounds_of(const Combination& c) {
  Bounds b = bounds(c.parts.front());
  if (c.kind == Combination::Kind::subtract) {
    return b;
  }
  const bool unite = c.kind == Combination::Kind::unite;
  for (std::size_t i = 1; i < c.parts.size(); ++i) {
    const Bounds other = bounds(c.parts[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      b.lo[k] = unite ? std::min(b.lo[k], other.lo[k]) : std::max(b.lo[k], other.lo[k]);
      b.hi[k] = unite ? std::max(b.hi[k], other.hi[k]) : std::min(b.hi[k], other.hi[k]);
    }
  }
  return b;
}

// ---- where a line p + t e_k meets a surface: candidates, a few too many are harmless ----

struct Line {
  Point p;       ///< a point on it
  std::size_t k; ///< the mesh axis it runs along; t is the coordinate k itself
  double lo, hi; ///< the part of interest
};

class Cuts {
public:
  explicit Cuts(const Line& line) : line_(line) {}
  void add(double t) {
    if (t > line_.lo && t < line_.hi) {
      values.push_back(t);
    }
  }
  /// Roots of a t^2 + 2 b t + c = 0.
  void add_roots(double a, double b, double c) {
    if (std::abs(a) < 1e-14) {
      if (b != 0) {
        add(-c / (2 * b));
      }
      return;
    }
    const double d = b * b - a * c;
    if (d < 0) {
      return;
    }
    const double q = -(b + std::copysign(std::sqrt(d), b));
    add(q / a);
    if (q != 0) {
      add(c / q);
    }
  }
  std::vector<double> values;

private:
  const Line& line_;
};

void cut(const Box& box, const Line& line, Cuts& cuts) {
  cuts.add(box.from[line.k]);
  cuts.add(box.to[line.k]);
}

void cut(const Sphere& s, const Line& line, Cuts& cuts) {
  Point d = line.p - s.centre;
  d[line.k] = 0;
  const double c = s.centre[line.k], half2 = s.radius * s.radius - dot(d, d);
  if (half2 > 0) {
    cuts.add(c - std::sqrt(half2));
    cuts.add(c + std::sqrt(half2));
  }
}

/// The line relative to a solid of revolution: along(t) = z0 + za t, rho^2(t) = |d + t e|^2 -
/// along^2.
struct Relative {
  double z0, za, d2, dk;
  Relative(const Line& line, const Point& origin, const Point& axis) {
    Point d = line.p - origin;
    d[line.k] = -origin[line.k]; // so that t is the coordinate itself
    z0 = dot(d, axis);
    za = axis[line.k];
    d2 = dot(d, d);
    dk = d[line.k];
  }
  /// t where rho = r0 + slope (along - z_ref).
  void cone(double r0, double slope, double z_ref, Cuts& cuts) const {
    const double m2 = 1 + slope * slope, base = r0 + slope * (z0 - z_ref);
    cuts.add_roots(1 - m2 * za * za, dk - z0 * za - slope * za * base, d2 - z0 * z0 - base * base);
  }
  void plane(double z, Cuts& cuts) const {
    if (za != 0) {
      cuts.add((z - z0) / za);
    }
  }
};

void cut(const Cylinder& c, const Line& line, Cuts& cuts) {
  const Point a = axis_of(c), end = c.to - c.from;
  const Relative relative(line, c.from, a);
  relative.cone(c.radius, 0, 0, cuts);
  relative.plane(0, cuts);
  relative.plane(dot(end, a), cuts);
}

void cut(const Revolved& r, const Line& line, Cuts& cuts) {
  const Relative relative(line, r.origin, r.axis);
  const double at_lo = relative.z0 + relative.za * line.lo,
               at_hi = relative.z0 + relative.za * line.hi;
  const double z_lo = std::min(at_lo, at_hi), z_hi = std::max(at_lo, at_hi);
  relative.plane(r.profile.front()[0], cuts);
  relative.plane(r.profile.back()[0], cuts);
  for (std::size_t i = segment_at(r, z_lo); i + 1 < r.profile.size(); ++i) {
    const auto& a = r.profile[i];
    const auto& b = r.profile[i + 1];
    if (a[0] > z_hi) {
      break;
    }
    if (b[0] > a[0]) {
      relative.cone(a[1], (b[1] - a[1]) / (b[0] - a[0]), a[0], cuts);
    }
    relative.plane(a[0], cuts);
  }
}

void cut(const HalfSpace& h, const Line& line, Cuts& cuts) {
  Point d = line.p - h.point;
  d[line.k] = -h.point[line.k];
  if (h.outward[line.k] != 0) {
    cuts.add(-dot(d, h.outward) / h.outward[line.k]);
  }
}

void cut(const Shape& shape, const Line& line, Cuts& cuts);
void cut(const Combination& c, const Line& line, Cuts& cuts) {
  for (const Shape& part : c.parts) {
    cut(part, line, cuts);
  }
}
void cut(const Shape& shape, const Line& line, Cuts& cuts) {
  std::visit([&](const auto& form) { cut(form, line, cuts); }, shape.form);
}

// ---- coordinates along axis j where a section may jump or bend (`flat`: a 2D scene, where round
// sides do so too): lines are never laid across them ----

void jumps(const Box& box, std::size_t j, bool, std::vector<double>& out) {
  out.insert(out.end(), {box.from[j], box.to[j]});
}
void jumps(const Sphere& s, std::size_t j, bool flat, std::vector<double>& out) {
  if (flat) {
    out.insert(out.end(), {s.centre[j] - s.radius, s.centre[j] + s.radius});
  }
}
void jumps(const Cylinder& c, std::size_t j, bool flat, std::vector<double>& out) {
  const int k = aligned_with(axis_of(c));
  if (k == static_cast<int>(j) || (k >= 0 && flat)) {
    const Bounds b = bounds_of(c);
    out.insert(out.end(), {b.lo[j], b.hi[j]});
  }
}
void jumps(const Revolved& r, std::size_t j, bool flat, std::vector<double>& out) {
  const int k = aligned_with(r.axis);
  if (k < 0) {
    return;
  }
  for (const auto& point : r.profile) {
    if (static_cast<std::size_t>(k) == j) {
      out.push_back(r.origin[j] + r.axis[j] * point[0]);
    } else if (flat) {
      out.insert(out.end(), {r.origin[j] - point[1], r.origin[j] + point[1]});
    }
  }
}
void jumps(const HalfSpace& h, std::size_t j, bool, std::vector<double>& out) {
  if (aligned_with(h.outward) == static_cast<int>(j)) {
    out.push_back(h.point[j]);
  }
}
void jumps(const Shape& shape, std::size_t j, bool flat, std::vector<double>& out);
void jumps(const Combination& c, std::size_t j, bool flat, std::vector<double>& out) {
  for (const Shape& part : c.parts) {
    jumps(part, j, flat, out);
  }
}
void jumps(const Shape& shape, std::size_t j, bool flat, std::vector<double>& out) {
  std::visit([&](const auto& form) { jumps(form, j, flat, out); }, shape.form);
}

// ---- one cell ----

struct Cell {
  Geometry geometry;
  Point lo, hi;
  int dim() const { return dimensions(geometry); }
  double size(std::size_t k) const { return hi[k] - lo[k]; }
  Point centre() const {
    Point c{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim()); ++k) {
      c[k] = 0.5 * (lo[k] + hi[k]);
    }
    return c;
  }
  double half_diagonal() const {
    double d2 = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim()); ++k) {
      d2 += size(k) * size(k);
    }
    return 0.5 * std::sqrt(d2);
  }
};

enum class Side { outside, inside, cut };

Side side_of(const Shape& shape, const Cell& cell) {
  const Bounds b = bounds(shape);
  for (std::size_t k = 0; k < static_cast<std::size_t>(cell.dim()); ++k) {
    if (cell.hi[k] <= b.lo[k] || cell.lo[k] >= b.hi[k]) {
      return Side::outside;
    }
  }
  const double d = signed_distance(shape, cell.centre());
  if (std::abs(d) < cell.half_diagonal()) {
    return Side::cut;
  }
  return d < 0 ? Side::inside : Side::outside;
}

/// The last of `candidates` that holds p, or -1.
int owner(std::span<const Shape* const> shapes,
          std::span<const std::size_t> candidates,
          const Point& p) {
  for (auto it = candidates.rbegin(); it != candidates.rend(); ++it) {
    if (contains(*shapes[*it], p)) {
      return static_cast<int>(*it);
    }
  }
  return -1;
}

/// The axis nearest to the normal of the surface nearest to the cell's centre.
std::size_t normal_axis(std::span<const Shape* const> shapes,
                        std::span<const std::size_t> candidates,
                        const Cell& cell) {
  const Point c = cell.centre();
  double nearest = infinity;
  std::size_t axis = 0;
  for (const std::size_t s : candidates) {
    const double d = std::abs(signed_distance(*shapes[s], c));
    if (d >= nearest) {
      continue;
    }
    nearest = d;
    double steepest = -1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(cell.dim()); ++k) {
      Point a = c, b = c;
      a[k] -= 1e-3 * cell.half_diagonal();
      b[k] += 1e-3 * cell.half_diagonal();
      const double slope =
          std::abs(signed_distance(*shapes[s], b) - signed_distance(*shapes[s], a));
      if (slope > steepest) {
        steepest = slope;
        axis = k;
      }
    }
  }
  return axis;
}

/// The axis along which the owner changes most often on a coarse grid: lines along it meet the
/// surfaces most squarely. Where the grid hardly sees them (a corner cut off), the nearest surface
/// decides.
std::size_t best_axis(std::span<const Shape* const> shapes,
                      std::span<const std::size_t> candidates,
                      const Cell& cell) {
  constexpr int n = 5;
  const int nk = cell.dim() == 3 ? n : 1;
  std::array<int, n * n * n> owners{};
  const auto at = [&](int i, int j, int k) -> int& {
    return owners[static_cast<std::size_t>((k * n + j) * n + i)];
  };
  const auto place = [&](std::size_t axis, int i) {
    return cell.lo[axis] + (i + 0.5) / n * cell.size(axis);
  };
  std::array<int, 3> changes{};
  for (int k = 0; k < nk; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Point p{place(0, i), place(1, j), nk > 1 ? place(2, k) : 0.0};
        at(i, j, k) = owner(shapes, candidates, p);
        changes[0] += i > 0 && at(i, j, k) != at(i - 1, j, k);
        changes[1] += j > 0 && at(i, j, k) != at(i, j - 1, k);
        changes[2] += k > 0 && at(i, j, k) != at(i, j, k - 1);
      }
    }
  }
  const auto most = std::max_element(changes.begin(), changes.end());
  return 2 * *most < n * nk ? normal_axis(shapes, candidates, cell)
                            : static_cast<std::size_t>(most - changes.begin());
}

struct Abscissa {
  double x, weight;
};

/// Midpoints and widths of equal lines across axis k, `density` of them on a whole cell.
std::vector<Abscissa> lines_across(const Cell& part, std::size_t k, double whole, int density) {
  const int n = std::max(3, static_cast<int>(std::ceil(density * part.size(k) / whole)));
  std::vector<Abscissa> out;
  for (int i = 0; i < n; ++i) {
    const double x = part.lo[k] + (i + 0.5) * part.size(k) / n;
    const bool radius = part.geometry == Geometry::axisymmetric && k == 0;
    out.push_back({x, part.size(k) / n * (radius ? x : 1.0)});
  }
  return out;
}

/// Adds each owner's share of one line, `weight` its cross-section; r-lines weigh with r
/// themselves.
void cast_line(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               const Line& line,
               bool weigh_with_r,
               double weight,
               std::span<double> sums) {
  Cuts cuts(line);
  for (const std::size_t s : candidates) {
    cut(*shapes[s], line, cuts);
  }
  cuts.values.insert(cuts.values.end(), {line.lo, line.hi});
  std::sort(cuts.values.begin(), cuts.values.end());
  Point p = line.p;
  for (std::size_t i = 0; i + 1 < cuts.values.size(); ++i) {
    const double a = cuts.values[i], b = cuts.values[i + 1];
    if (b <= a) {
      continue;
    }
    p[line.k] = 0.5 * (a + b);
    const int who = owner(shapes, candidates, p);
    if (who >= 0) {
      sums[static_cast<std::size_t>(who)] += weight * (b - a) * (weigh_with_r ? p[line.k] : 1.0);
    }
  }
}

/// One part of a cell, free of aligned faces inside.
void cast_part(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               const Cell& part,
               const Cell& cell,
               std::span<double> sums) {
  const std::size_t k = best_axis(shapes, candidates, part);
  const bool flat = cell.dim() == 2;
  const std::size_t j = k == 0 ? 1 : 0;
  const std::size_t l = 3 - j - k; // the other transverse axis, 3D only
  const bool weigh = cell.geometry == Geometry::axisymmetric && k == 0;
  const auto across_j = lines_across(part, j, cell.size(j), flat ? 40 : 24);
  const auto across_l =
      flat ? std::vector<Abscissa>{{0.0, 1.0}} : lines_across(part, l, cell.size(l), 24);
  for (const Abscissa& b : across_l) {
    for (const Abscissa& a : across_j) {
      Line line{{}, k, part.lo[k], part.hi[k]};
      line.p[j] = a.x;
      line.p[l] = b.x;
      cast_line(shapes, candidates, line, weigh, a.weight * b.weight, sums);
    }
  }
}

/// Ends of the stretches that the jumps cut axis k of a cell into.
std::vector<double> stretches(std::span<const Shape* const> shapes,
                              std::span<const std::size_t> candidates,
                              const Cell& cell,
                              std::size_t k) {
  if (k == 2 && cell.dim() == 2) {
    return {0, 0};
  }
  std::vector<double> marks;
  for (const std::size_t s : candidates) {
    jumps(*shapes[s], k, cell.dim() == 2, marks);
  }
  const double least = 1e-12 * cell.size(k);
  std::erase_if(marks,
                [&](double m) { return !(m > cell.lo[k] + least && m < cell.hi[k] - least); });
  marks.insert(marks.end(), {cell.lo[k], cell.hi[k]});
  std::sort(marks.begin(), marks.end());
  const auto same = [&](double a, double b) { return b - a <= least; };
  marks.erase(std::unique(marks.begin(), marks.end(), same), marks.end());
  return marks;
}

/// Cuts the cell at aligned faces, which lines along any axis would miss or graze, and casts each
/// part.
void cast_cell(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               const Cell& cell,
               std::span<double> sums) {
  std::array<std::vector<double>, 3> marks;
  for (std::size_t k = 0; k < 3; ++k) {
    marks[k] = stretches(shapes, candidates, cell, k);
  }
  for (std::size_t k = 0; k + 1 < marks[2].size(); ++k) {
    for (std::size_t j = 0; j + 1 < marks[1].size(); ++j) {
      for (std::size_t i = 0; i + 1 < marks[0].size(); ++i) {
        const Cell part{cell.geometry,
                        {marks[0][i], marks[1][j], marks[2][k]},
                        {marks[0][i + 1], marks[1][j + 1], marks[2][k + 1]}};
        cast_part(shapes, candidates, part, cell, sums);
      }
    }
  }
}

double measure(const Cell& cell) {
  double v = cell.size(0) * cell.size(1);
  if (cell.geometry == Geometry::axisymmetric) {
    v *= 0.5 * (cell.lo[0] + cell.hi[0]);
  }
  return cell.dim() == 3 ? v * cell.size(2) : v;
}

} // namespace

Bounds bounds(const Shape& shape) {
  return std::visit([](const auto& form) { return bounds_of(form); }, shape.form);
}

bool contains(const Shape& shape, const Point& p) {
  return std::visit([&](const auto& form) { return holds(form, p); }, shape.form);
}

double signed_distance(const Shape& shape, const Point& p) {
  return std::visit([&](const auto& form) { return distance_to(form, p); }, shape.form);
}

void visible_fractions(std::span<const Shape* const> shapes,
                       Geometry geometry,
                       const Point& lo,
                       const Point& hi,
                       std::span<double> shares) {
  const Cell cell{geometry, lo, hi};
  std::fill(shares.begin(), shares.end(), 0.0);
  std::vector<std::size_t> candidates; // ascending
  bool any_cut = false;
  for (std::size_t s = shapes.size();
       s-- > 0;) { // from the top: what lies under a full one is hidden
    const Side side = side_of(*shapes[s], cell);
    if (side == Side::outside) {
      continue;
    }
    candidates.insert(candidates.begin(), s);
    any_cut = any_cut || side == Side::cut;
    if (side == Side::inside) {
      break;
    }
  }
  if (candidates.empty()) {
    return;
  }
  if (!any_cut) {
    shares[candidates.front()] = 1;
    return;
  }
  cast_cell(shapes, candidates, cell, shares);
  const double whole = measure(cell);
  for (double& share : shares) {
    share /= whole;
    share = share < 1e-12 ? 0.0 : (share > 1 - 1e-12 ? 1.0 : share);
  }
}

double fraction(const Shape& shape, Geometry geometry, const Point& lo, const Point& hi) {
  const Shape* one = &shape;
  double share = 0;
  visible_fractions({&one, 1}, geometry, lo, hi, {&share, 1});
  return share;
}

namespace {
std::string describe_one(const Box&) {
  return "box";
}
std::string describe_one(const Sphere& s) {
  return fmt::format("sphere, radius {:g} m", s.radius);
}
std::string describe_one(const Cylinder& c) {
  return fmt::format("cylinder, radius {:g} m", c.radius);
}
std::string describe_one(const Revolved& r) {
  return fmt::format("revolved profile of {} points", r.profile.size());
}
std::string describe_one(const HalfSpace&) {
  return "half space";
}
std::string describe_one(const Combination& c) {
  const char* names[] = {"union", "intersection", "difference"};
  return fmt::format("{} of {} shapes", names[static_cast<int>(c.kind)], c.parts.size());
}
} // namespace

std::string describe(const Shape& shape) {
  return std::visit([](const auto& form) { return describe_one(form); }, shape.form);
}

} // namespace ballast
