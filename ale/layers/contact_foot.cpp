#include "ale/layers/contact_foot.hpp"
#include "ale/layers/contact_vector.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

constexpr double least_normal = 0.3; ///< where the corners' normals nearly cancel a segment is turned over in a fold: no foot there

template <int Dim> using Vec = std::array<double, Dim>;

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) { return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}; }
double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// A vector across a patch with these tangents, not of unit length.
Vec<3> upright(const Vec<3>& a, const Vec<3>& b) { return cross(a, b); }
Vec<2> upright(const Vec<2>& a, const Vec<2>&) { return {-a[1], a[0]}; }

template <int Dim> void add(Vec<Dim>& v, double factor, const Vec<Dim>& w) {
  for (std::size_t d = 0; d < Dim; ++d) {
    v[d] += factor * w[d];
  }
}

/// One Newton step of x = X + g N: changes local and gap by the returned amounts; false past the surface's focus.
bool newton(const Vec<3>& r, const Vec<3>& a, const Vec<3>& b, const Vec<3>& n, int outside, std::array<double, 3>& step) {
  const Vec<3> bn = cross(b, n), ab = cross(a, b);
  const double det = dot(a, bn), size = std::sqrt(dot(a, a) * dot(b, b));
  if (!(det * outside > 1e-3 * size)) {
    return false;
  }
  step = {dot(r, bn) / det, dot(r, cross(n, a)) / det, dot(r, ab) / det};
  return true;
}
bool newton(const Vec<2>& r, const Vec<2>& a, const Vec<2>&, const Vec<2>& n, int outside, std::array<double, 3>& step) {
  const double det = cross(a, n);
  if (!(det * outside > 1e-3 * std::sqrt(dot(a, a)))) {
    return false;
  }
  step = {cross(r, n) / det, 0, cross(a, r) / det};
  return true;
}

} // namespace

template <int Dim> Foot<Dim> find_foot(const ContactSurface<Dim>& s, int segment, const std::array<double, Dim>& point, const std::array<double, 2>& start) {
  const auto corner = s.corners_of(segment);
  const Patch<Dim> place = places(s, segment), normal([&](std::size_t c) { return node_normal(s, corner[c]); });
  Foot<Dim> foot;
  double& a = foot.local[0];
  double& b = foot.local[1];
  a = start[0];
  b = Dim == 3 ? start[1] : 0;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Vec<Dim> n = normal.value(a, b);
    Vec<Dim> r = point, x_a = place.along_a(b), x_b = place.along_b(a);
    add<Dim>(r, -1, place.value(a, b));
    if (iteration == 0) {
      foot.gap = dot(r, n) / dot(n, n);
    }
    add<Dim>(r, -foot.gap, n);
    add<Dim>(x_a, foot.gap, normal.along_a(b));
    add<Dim>(x_b, foot.gap, normal.along_b(a));
    std::array<double, 3> step;
    if (!newton(r, x_a, x_b, n, s.outside, step)) {
      return foot;
    }
    a += step[0];
    b += step[1];
    foot.gap += step[2];
    if (!(std::abs(a) < 1e3 && std::abs(b) < 1e3)) {
      return foot;
    }
    if (std::abs(step[0]) + std::abs(step[1]) < 1e-8) { // squared by the step just made
      foot.found = true;
      break;
    }
  }
  foot.normal = normal.value(a, b);
  const double length = std::sqrt(dot(foot.normal, foot.normal));
  foot.found = foot.found && length > least_normal;
  for (double& c : foot.normal) {
    c /= length;
  }
  foot.gap *= length;
  return foot;
}

template <int Dim> Foot<Dim> orthogonal_foot(const ContactSurface<Dim>& s, int segment, const std::array<double, Dim>& point, const Foot<Dim>& foot) {
  const Patch<Dim> place = places(s, segment);
  double a = foot.local[0], b = foot.local[1];
  Foot<Dim> out;
  for (int iteration = 0; iteration < 8 && !out.found; ++iteration) {
    const Vec<Dim> x_a = place.along_a(b), x_b = place.along_b(a);
    Vec<Dim> r = point;
    add<Dim>(r, -1, place.value(a, b));
    const double aa = dot(x_a, x_a), ra = dot(r, x_a);
    if (iteration == 0 && foot.gap * foot.gap > 0.01 * aa) {
      return foot;
    }
    double da = ra / aa, db = 0;
    if constexpr (Dim == 3) { // Newton's method of r.X_a = r.X_b = 0
      const double bb = dot(x_b, x_b), rb = dot(r, x_b), ab = dot(x_a, x_b) - dot(r, place.f_ab), det = aa * bb - ab * ab;
      if (!(det > 1e-6 * aa * bb)) {
        return foot;
      }
      da = (ra * bb - rb * ab) / det;
      db = (rb * aa - ra * ab) / det;
    }
    a += da;
    b += db;
    out.found = std::abs(da) + std::abs(db) < 1e-8;
  }
  Vec<Dim> r = point, n = upright(place.along_a(b), place.along_b(a));
  add<Dim>(r, -1, place.value(a, b));
  const double scale = s.outside / std::sqrt(dot(n, n));
  for (double& c : n) {
    c *= scale;
  }
  out.local = {a, b};
  out.gap = dot(r, n);
  out.normal = n;
  const bool near = std::abs(a - foot.local[0]) + std::abs(b - foot.local[1]) < 0.1;
  return out.found && near ? out : foot;
}

template <int Dim> double segment_extent(const ContactSurface<Dim>& s, int segment) {
  const auto corner = s.corners_of(segment);
  double square = 0;
  for (std::size_t c = 0; c < corner.size() / 2; ++c) {
    Vec<Dim> d = s.place(corner[corner.size() - 1 - c]);
    add<Dim>(d, -1, s.place(corner[c]));
    square = std::max(square, dot(d, d));
  }
  return 0.5 * std::sqrt(square);
}

#define BALLAST_INSTANTIATE(D) \
  template Foot<D> find_foot<D>(const ContactSurface<D>&, int, const std::array<double, D>&, const std::array<double, 2>&); \
  template Foot<D> orthogonal_foot<D>(const ContactSurface<D>&, int, const std::array<double, D>&, const Foot<D>&);             \
  template double segment_extent<D>(const ContactSurface<D>&, int);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
