// The solid-shell element of fabric layers: strains, and the modes that have none at its points, as quadratic forms of its shape.
//
// A brick at rest with sizes h, corners at xi, eta, zeta = +-1, a = 2/h. Its shape is x = c0 + c1 xi + c2 eta + c3 zeta +
// c12 xi eta + c23 eta zeta + c13 xi zeta + c123 xi eta zeta. With g1(zeta) = dx/dX1 = a1 (c1 + c13 zeta) on the middle line
// xi = eta = 0, g2 likewise and g3 = a3 c3, Green strain is
//   E11 = (g1.g1 - 1)/2, E22, 2 E12 = g1.g2   at zeta = -+1/sqrt 3,
//   E33 = (g3.g3 - 1)/2, 2 E23 = a2 c2.g3, 2 E13 = a1 c1.g3   at the centre: no shear or thickness locking in bending;
// around an axis E22 = ((r/R)^2 - 1)/2 at the two points, in a plane E22 = 0.
// The other modes are held by the terms of Green strain that these miss and that do not lock:
//   E11 by eta and eta zeta, E22 by xi and xi zeta, E33 by xi, eta and xi eta, 2 E13 by eta, 2 E23 by xi  (2D: E33 by xi).
// They vanish in every linear map of the rest shape and do not see rotations. Of each quantity k, form_k(c, d) is the symmetric
// form with value form_k(c, c)/2 and rate form_k(c, dc/dt), `pull` the derivative of sum Q_k value_k by the modes.
// The last two held quantities are volumes over those at rest, signed, in the middle of the lower and the upper surface:
//   J = (g1 x g2).g3 with g1 = a1 (c1 +- c13), g2 likewise (2D: g1 x g3, without the hoop)
// of degree Dim: form_k(c, c) is Dim times the value. Strains do not tell an element from its mirror image; these do.
// Inner loops are unrolled by force: else loops over elements do not vectorise.
#pragma once

#include <array>
#include <cstddef>

namespace ballast::layer_element {

constexpr double upper_point = 0.577350269189625764509; // zeta

template <int Dim> struct Count;
template <> struct Count<2> {
  static constexpr std::size_t modes = 4, strains = 6, quadratic = 1, hourglass = quadratic + 2, rows = 2;
};
template <> struct Count<3> {
  static constexpr std::size_t modes = 7, strains = 9, quadratic = 9, hourglass = quadratic + 2, rows = 4;
};

// Modes in 3D; in 2D, where eta is not: c1, c3, c13 and the mean.
enum Mode3 : std::size_t { c1, c2, c3, c12, c23, c13, c123 };
enum Mode2 : std::size_t { p1, p3, p13, p0 };
// Strains in 3D, _ at the lower and ^ at the upper point; in 2D s12 and s23 are not.
enum Strain3 : std::size_t { s11_low, s11_up, s22_low, s22_up, s12_low, s12_up, s33, s23, s13 };
enum Strain2 : std::size_t { e11_low, e11_up, e22_low, e22_up, e33, e13 };

template <int Dim> using Vector = std::array<double, Dim>;
template <int Dim> using Modes = std::array<Vector<Dim>, Count<Dim>::modes>;
template <int Dim> using Strains = std::array<double, Count<Dim>::strains>;
template <int Dim> using Hourglass = std::array<double, Count<Dim>::hourglass>;

/// Of an element: 2/h along 1, 2, 3; in 2D a2 is 1/R of its middle, 0 in a plane.
struct Gradients {
  double a1 = 0, a2 = 0, a3 = 0;
};

/// Rows of nodes of an element row: j, then plane; each Dim components.
template <int Dim, class Pointer> using NodeRows = std::array<std::array<Pointer, Dim>, Count<Dim>::rows>;

template <std::size_t N> [[gnu::always_inline]] inline double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = a[0] * b[0];
#pragma GCC unroll 3
  for (std::size_t d = 1; d < N; ++d) {
    sum += a[d] * b[d];
  }
  return sum;
}

template <std::size_t N> [[gnu::always_inline]] inline void add(std::array<double, N>& to, double factor, const std::array<double, N>& a) {
#pragma GCC unroll 3
  for (std::size_t d = 0; d < N; ++d) {
    to[d] += factor * a[d];
  }
}

/// factor (a + part b)
template <std::size_t N> [[gnu::always_inline]] inline std::array<double, N> slope(double factor, const std::array<double, N>& a, double part, const std::array<double, N>& b) {
  std::array<double, N> out;
#pragma GCC unroll 3
  for (std::size_t d = 0; d < N; ++d) {
    out[d] = factor * (a[d] + part * b[d]);
  }
  return out;
}

[[gnu::always_inline]] inline Vector<3> cross(const Vector<3>& a, const Vector<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Volume over that at rest in the middle of a surface (zeta = -1, 1) and its derivatives by g1, g2, g3; in 2D by g1 and g3.
template <int Dim> struct SurfaceVolume {
  Vector<Dim> by1, by2, by3;
};
[[gnu::always_inline]] inline SurfaceVolume<3> surface_volume(const Modes<3>& c, const Gradients& a, double zeta) {
  const Vector<3> g1 = slope(a.a1, c[c1], zeta, c[c13]), g2 = slope(a.a2, c[c2], zeta, c[c23]), g3 = {a.a3 * c[c3][0], a.a3 * c[c3][1], a.a3 * c[c3][2]};
  return {cross(g2, g3), cross(g3, g1), cross(g1, g2)};
}
[[gnu::always_inline]] inline SurfaceVolume<2> surface_volume(const Modes<2>& c, const Gradients& a, double zeta) {
  const Vector<2> g1 = slope(a.a1, c[p1], zeta, c[p13]), g3 = {a.a3 * c[p3][0], a.a3 * c[p3][1]};
  return {{g3[1], -g3[0]}, {0, 0}, {-g1[1], g1[0]}};
}
[[gnu::always_inline]] inline double volume_form(const SurfaceVolume<3>& J, const Modes<3>& d, const Gradients& a, double zeta) {
  return dot(J.by1, slope(a.a1, d[c1], zeta, d[c13])) + dot(J.by2, slope(a.a2, d[c2], zeta, d[c23])) + a.a3 * dot(J.by3, d[c3]);
}
[[gnu::always_inline]] inline double volume_form(const SurfaceVolume<2>& J, const Modes<2>& d, const Gradients& a, double zeta) {
  return dot(J.by1, slope(a.a1, d[p1], zeta, d[p13])) + a.a3 * dot(J.by3, d[p3]);
}
[[gnu::always_inline]] inline void pull_volume(double Q, const SurfaceVolume<3>& J, const Gradients& a, double zeta, Modes<3>& p) {
  add(p[c1], a.a1 * Q, J.by1), add(p[c13], zeta * a.a1 * Q, J.by1);
  add(p[c2], a.a2 * Q, J.by2), add(p[c23], zeta * a.a2 * Q, J.by2);
  add(p[c3], a.a3 * Q, J.by3);
}
[[gnu::always_inline]] inline void pull_volume(double Q, const SurfaceVolume<2>& J, const Gradients& a, double zeta, Modes<2>& p) {
  add(p[p1], a.a1 * Q, J.by1), add(p[p13], zeta * a.a1 * Q, J.by1);
  add(p[p3], a.a3 * Q, J.by3);
}

template <class Pointer> [[gnu::always_inline]] inline Modes<3> modes_at(const NodeRows<3, Pointer>& x, int i) {
  Modes<3> c;
#pragma GCC unroll 3
  for (std::size_t d = 0; d < 3; ++d) {
    const double S0 = x[0][d][i + 1] + x[0][d][i], T0 = x[0][d][i + 1] - x[0][d][i];
    const double S1 = x[1][d][i + 1] + x[1][d][i], T1 = x[1][d][i + 1] - x[1][d][i];
    const double S2 = x[2][d][i + 1] + x[2][d][i], T2 = x[2][d][i + 1] - x[2][d][i];
    const double S3 = x[3][d][i + 1] + x[3][d][i], T3 = x[3][d][i + 1] - x[3][d][i];
    c[c1][d] = 0.125 * ((T0 + T1) + (T2 + T3));
    c[c2][d] = 0.125 * ((S1 - S0) + (S3 - S2));
    c[c3][d] = 0.125 * ((S2 - S0) + (S3 - S1));
    c[c12][d] = 0.125 * ((T1 - T0) + (T3 - T2));
    c[c23][d] = 0.125 * ((S3 - S2) - (S1 - S0));
    c[c13][d] = 0.125 * ((T2 - T0) + (T3 - T1));
    c[c123][d] = 0.125 * ((T3 - T2) - (T1 - T0));
  }
  return c;
}

template <class Pointer> [[gnu::always_inline]] inline Modes<2> modes_at(const NodeRows<2, Pointer>& x, int i) {
  Modes<2> c;
#pragma GCC unroll 3
  for (std::size_t d = 0; d < 2; ++d) {
    const double S0 = x[0][d][i + 1] + x[0][d][i], T0 = x[0][d][i + 1] - x[0][d][i];
    const double S1 = x[1][d][i + 1] + x[1][d][i], T1 = x[1][d][i + 1] - x[1][d][i];
    c[p1][d] = 0.25 * (T0 + T1);
    c[p3][d] = 0.25 * (S1 - S0);
    c[p13][d] = 0.25 * (T1 - T0);
    c[p0][d] = 0.25 * (S0 + S1);
  }
  return c;
}

/// Forces at the corners, minus the derivative by their places: low[row][d][i] at node i, high at node i + 1.
[[gnu::always_inline]] inline void corner_forces(const Modes<3>& p, const NodeRows<3, double*>& low, const NodeRows<3, double*>& high, int i) {
#pragma GCC unroll 3
  for (std::size_t d = 0; d < 3; ++d) {
    const double S0 = -p[c2][d] - p[c3][d] + p[c23][d], T0 = p[c1][d] - p[c12][d] - p[c13][d] + p[c123][d];
    const double S1 = p[c2][d] - p[c3][d] - p[c23][d], T1 = p[c1][d] + p[c12][d] - p[c13][d] - p[c123][d];
    const double S2 = -p[c2][d] + p[c3][d] - p[c23][d], T2 = p[c1][d] - p[c12][d] + p[c13][d] - p[c123][d];
    const double S3 = p[c2][d] + p[c3][d] + p[c23][d], T3 = p[c1][d] + p[c12][d] + p[c13][d] + p[c123][d];
    low[0][d][i] = 0.125 * (T0 - S0), high[0][d][i] = -0.125 * (T0 + S0);
    low[1][d][i] = 0.125 * (T1 - S1), high[1][d][i] = -0.125 * (T1 + S1);
    low[2][d][i] = 0.125 * (T2 - S2), high[2][d][i] = -0.125 * (T2 + S2);
    low[3][d][i] = 0.125 * (T3 - S3), high[3][d][i] = -0.125 * (T3 + S3);
  }
}

[[gnu::always_inline]] inline void corner_forces(const Modes<2>& p, const NodeRows<2, double*>& low, const NodeRows<2, double*>& high, int i) {
#pragma GCC unroll 3
  for (std::size_t d = 0; d < 2; ++d) {
    const double S0 = p[p0][d] - p[p3][d], T0 = p[p1][d] - p[p13][d];
    const double S1 = p[p0][d] + p[p3][d], T1 = p[p1][d] + p[p13][d];
    low[0][d][i] = 0.25 * (T0 - S0), high[0][d][i] = -0.25 * (T0 + S0);
    low[1][d][i] = 0.25 * (T1 - S1), high[1][d][i] = -0.25 * (T1 + S1);
  }
}

[[gnu::always_inline]] inline Strains<3> strain_form(const Modes<3>& c, const Modes<3>& d, const Gradients& a) {
  Strains<3> out;
#pragma GCC unroll 3
  for (std::size_t point = 0; point < 2; ++point) {
    const double zeta = point == 0 ? -upper_point : upper_point;
    const Vector<3> g1 = slope(a.a1, c[c1], zeta, c[c13]), g2 = slope(a.a2, c[c2], zeta, c[c23]);
    const Vector<3> k1 = slope(a.a1, d[c1], zeta, d[c13]), k2 = slope(a.a2, d[c2], zeta, d[c23]);
    out[s11_low + point] = dot(g1, k1);
    out[s22_low + point] = dot(g2, k2);
    out[s12_low + point] = dot(g1, k2) + dot(k1, g2);
  }
  out[s33] = a.a3 * a.a3 * dot(c[c3], d[c3]);
  out[s23] = a.a2 * a.a3 * (dot(c[c2], d[c3]) + dot(d[c2], c[c3]));
  out[s13] = a.a1 * a.a3 * (dot(c[c1], d[c3]) + dot(d[c1], c[c3]));
  return out;
}

[[gnu::always_inline]] inline Strains<2> strain_form(const Modes<2>& c, const Modes<2>& d, const Gradients& a) {
  Strains<2> out;
#pragma GCC unroll 3
  for (std::size_t point = 0; point < 2; ++point) {
    const double zeta = point == 0 ? -upper_point : upper_point;
    out[e11_low + point] = dot(slope(a.a1, c[p1], zeta, c[p13]), slope(a.a1, d[p1], zeta, d[p13]));
    out[e22_low + point] = a.a2 * (c[p0][0] + zeta * c[p3][0]) * (a.a2 * (d[p0][0] + zeta * d[p3][0]));
  }
  out[e33] = a.a3 * a.a3 * dot(c[p3], d[p3]);
  out[e13] = a.a1 * a.a3 * (dot(c[p1], d[p3]) + dot(d[p1], c[p3]));
  return out;
}

/// Green strain, shears doubled.
[[gnu::always_inline]] inline Strains<3> strains(const Modes<3>& c, const Gradients& a) {
  Strains<3> out = strain_form(c, c, a);
  for (std::size_t k = 0; k < 9; ++k) {
    const bool shear = k == s12_low || k == s12_up || k == s23 || k == s13;
    out[k] = 0.5 * (out[k] - (shear ? 0.0 : 1.0));
  }
  return out;
}

[[gnu::always_inline]] inline Strains<2> strains(const Modes<2>& c, const Gradients& a) {
  Strains<2> out = strain_form(c, c, a);
  const double ring = a.a2 > 0 ? 1.0 : 0.0;
  const Strains<2> rest = {1, 1, ring, ring, 1, 0};
  for (std::size_t k = 0; k < 6; ++k) {
    out[k] = 0.5 * (out[k] - rest[k]);
  }
  return out;
}

[[gnu::always_inline]] inline Hourglass<3> hourglass_form(const Modes<3>& c, const Modes<3>& d, const Gradients& a) {
  const auto both = [&](std::size_t m, std::size_t n) __attribute__((always_inline)) { return dot(c[m], d[n]) + dot(d[m], c[n]); };
  const double a11 = a.a1 * a.a1, a22 = a.a2 * a.a2, a33 = a.a3 * a.a3;
  return {a11 * both(c1, c12),
          a22 * both(c2, c12),
          a.a1 * a.a3 * (both(c12, c3) + both(c1, c23)),
          a.a2 * a.a3 * (both(c12, c3) + both(c2, c13)),
          a33 * both(c3, c13),
          a33 * both(c3, c23),
          a11 * (both(c1, c123) + both(c13, c12)),
          a22 * (both(c2, c123) + both(c23, c12)),
          a33 * (both(c3, c123) + both(c13, c23)),
          volume_form(surface_volume(c, a, -1), d, a, -1),
          volume_form(surface_volume(c, a, 1), d, a, 1)};
}

[[gnu::always_inline]] inline Hourglass<2> hourglass_form(const Modes<2>& c, const Modes<2>& d, const Gradients& a) {
  return {a.a3 * a.a3 * (dot(c[p3], d[p13]) + dot(d[p3], c[p13])), volume_form(surface_volume(c, a, -1), d, a, -1), volume_form(surface_volume(c, a, 1), d, a, 1)};
}

/// p += derivative of sum Q_k strain_k by the modes.
[[gnu::always_inline]] inline void pull_strains(const Strains<3>& Q, const Modes<3>& c, const Gradients& a, Modes<3>& p) {
#pragma GCC unroll 3
  for (std::size_t point = 0; point < 2; ++point) {
    const double zeta = point == 0 ? -upper_point : upper_point;
    const Vector<3> g1 = slope(a.a1, c[c1], zeta, c[c13]), g2 = slope(a.a2, c[c2], zeta, c[c23]);
    const double q11 = a.a1 * Q[s11_low + point], q22 = a.a2 * Q[s22_low + point], q12 = Q[s12_low + point];
    add(p[c1], q11, g1), add(p[c1], a.a1 * q12, g2);
    add(p[c13], zeta * q11, g1), add(p[c13], zeta * a.a1 * q12, g2);
    add(p[c2], q22, g2), add(p[c2], a.a2 * q12, g1);
    add(p[c23], zeta * q22, g2), add(p[c23], zeta * a.a2 * q12, g1);
  }
  const double q33 = a.a3 * a.a3 * Q[s33], q23 = a.a2 * a.a3 * Q[s23], q13 = a.a1 * a.a3 * Q[s13];
  add(p[c3], q33, c[c3]), add(p[c3], q23, c[c2]), add(p[c3], q13, c[c1]);
  add(p[c2], q23, c[c3]);
  add(p[c1], q13, c[c3]);
}

[[gnu::always_inline]] inline void pull_strains(const Strains<2>& Q, const Modes<2>& c, const Gradients& a, Modes<2>& p) {
#pragma GCC unroll 3
  for (std::size_t point = 0; point < 2; ++point) {
    const double zeta = point == 0 ? -upper_point : upper_point;
    const Vector<2> g1 = slope(a.a1, c[p1], zeta, c[p13]);
    add(p[p1], a.a1 * Q[e11_low + point], g1);
    add(p[p13], zeta * a.a1 * Q[e11_low + point], g1);
    const double hoop = Q[e22_low + point] * a.a2 * a.a2 * (c[p0][0] + zeta * c[p3][0]);
    p[p0][0] += hoop;
    p[p3][0] += zeta * hoop;
  }
  const double q33 = a.a3 * a.a3 * Q[e33], q13 = a.a1 * a.a3 * Q[e13];
  add(p[p3], q33, c[p3]), add(p[p3], q13, c[p1]);
  add(p[p1], q13, c[p3]);
}

[[gnu::always_inline]] inline void pull_hourglass(const Hourglass<3>& Q, const Modes<3>& c, const Gradients& a, Modes<3>& p) {
  const auto both = [&](double q, std::size_t m, std::size_t n) __attribute__((always_inline)) { add(p[m], q, c[n]), add(p[n], q, c[m]); };
  const double a11 = a.a1 * a.a1, a22 = a.a2 * a.a2, a33 = a.a3 * a.a3;
  both(a11 * Q[0], c1, c12);
  both(a22 * Q[1], c2, c12);
  both(a.a1 * a.a3 * Q[2] + a.a2 * a.a3 * Q[3], c12, c3);
  both(a.a1 * a.a3 * Q[2], c1, c23);
  both(a.a2 * a.a3 * Q[3], c2, c13);
  both(a33 * Q[4], c3, c13);
  both(a33 * Q[5], c3, c23);
  both(a11 * Q[6], c1, c123), both(a11 * Q[6], c13, c12);
  both(a22 * Q[7], c2, c123), both(a22 * Q[7], c23, c12);
  both(a33 * Q[8], c3, c123), both(a33 * Q[8], c13, c23);
  pull_volume(Q[9], surface_volume(c, a, -1), a, -1, p);
  pull_volume(Q[10], surface_volume(c, a, 1), a, 1, p);
}

[[gnu::always_inline]] inline void pull_hourglass(const Hourglass<2>& Q, const Modes<2>& c, const Gradients& a, Modes<2>& p) {
  const double q = a.a3 * a.a3 * Q[0];
  add(p[p3], q, c[p13]);
  add(p[p13], q, c[p3]);
  pull_volume(Q[1], surface_volume(c, a, -1), a, -1, p);
  pull_volume(Q[2], surface_volume(c, a, 1), a, 1, p);
}

/// Volume over that at rest, on the middle line at the centre; in 2D times the hoop's length.
[[gnu::always_inline]] inline double volume_ratio(const Modes<3>& c, const Gradients& a) {
  const Vector<3>&u = c[c1], &v = c[c2], &w = c[c3];
  return a.a1 * a.a2 * a.a3 * (u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) + u[2] * (v[0] * w[1] - v[1] * w[0]));
}

[[gnu::always_inline]] inline double volume_ratio(const Modes<2>& c, const Gradients& a) {
  const double hoop = a.a2 > 0 ? a.a2 * c[p0][0] : 1.0;
  return a.a1 * a.a3 * (c[p1][0] * c[p3][1] - c[p1][1] * c[p3][0]) * hoop;
}

} // namespace ballast::layer_element
