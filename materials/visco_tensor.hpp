// Symmetric tensors of six components (xx, yy, zz, xy, yz, zx) and 3x3 matrices (row by row), for material points.
#pragma once

#include <array>
#include <cmath>

namespace ballast {

using Sym = std::array<double, 6>;
using Mat = std::array<double, 9>;

inline constexpr Sym unit_sym{1, 1, 1, 0, 0, 0};
inline constexpr Mat unit_mat{1, 0, 0, 0, 1, 0, 0, 0, 1};

inline double trace(const Sym& s) { return s[0] + s[1] + s[2]; }
/// a : b; shears count twice.
inline double contract(const Sym& a, const Sym& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}
/// Frobenius: sqrt(a : a).
inline double norm(const Sym& a) { return std::sqrt(contract(a, a)); }

inline Sym combine(double x, const Sym& a, double y, const Sym& b) {
  return {x * a[0] + y * b[0], x * a[1] + y * b[1], x * a[2] + y * b[2], x * a[3] + y * b[3], x * a[4] + y * b[4], x * a[5] + y * b[5]};
}
inline Sym scaled(double x, const Sym& a) { return {x * a[0], x * a[1], x * a[2], x * a[3], x * a[4], x * a[5]}; }
inline Sym deviator(const Sym& a) {
  const double mean = trace(a) / 3;
  return {a[0] - mean, a[1] - mean, a[2] - mean, a[3], a[4], a[5]};
}

inline Mat product(const Mat& a, const Mat& b) {
  Mat c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    }
  }
  return c;
}
inline Mat transposed(const Mat& a) { return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}; }
inline double determinant(const Mat& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) + a[2] * (a[3] * a[7] - a[4] * a[6]);
}
inline Sym symmetric_part(const Mat& a) {
  return {a[0], a[4], a[8], 0.5 * (a[1] + a[3]), 0.5 * (a[5] + a[7]), 0.5 * (a[2] + a[6])};
}
inline Mat full(const Sym& s) { return {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]}; }

/// m s m^T.
inline Sym push(const Mat& m, const Sym& s) {
  const Mat p = product(m, full(s));
  const auto row = [&](std::size_t i, std::size_t j) {
    return p[3 * i] * m[3 * j] + p[3 * i + 1] * m[3 * j + 1] + p[3 * i + 2] * m[3 * j + 2];
  };
  return {row(0, 0), row(1, 1), row(2, 2), row(0, 1), row(1, 2), row(0, 2)};
}
/// m s + s m^T.
inline Sym drag(const Mat& m, const Sym& s) { return scaled(2, symmetric_part(product(m, full(s)))); }

/// cof(a + b) - cof(a) - cof(b); twice the cofactor where a = b.
inline Sym mixed_cofactor(const Sym& a, const Sym& b) {
  return {a[1] * b[2] + a[2] * b[1] - 2 * a[4] * b[4],
          a[0] * b[2] + a[2] * b[0] - 2 * a[5] * b[5],
          a[0] * b[1] + a[1] * b[0] - 2 * a[3] * b[3],
          a[4] * b[5] + a[5] * b[4] - a[3] * b[2] - a[2] * b[3],
          a[3] * b[5] + a[5] * b[3] - a[4] * b[0] - a[0] * b[4],
          a[3] * b[4] + a[4] * b[3] - a[5] * b[1] - a[1] * b[5]};
}
inline Sym cofactor(const Sym& a) { return scaled(0.5, mixed_cofactor(a, a)); }
inline double determinant(const Sym& a) {
  return a[0] * (a[1] * a[2] - a[4] * a[4]) - a[3] * (a[3] * a[2] - a[4] * a[5]) + a[5] * (a[3] * a[4] - a[1] * a[5]);
}
inline Sym inverse(const Sym& a) { return scaled(1 / determinant(a), cofactor(a)); }
/// a / det(a)^(1/3).
inline Sym unimodular(const Sym& a) { return scaled(1 / std::cbrt(determinant(a)), a); }
/// By Sylvester: all leading minors positive.
inline bool positive_definite(const Sym& a) {
  return a[0] > 0 && a[0] * a[1] - a[3] * a[3] > 0 && determinant(a) > 0;
}

} // namespace ballast
