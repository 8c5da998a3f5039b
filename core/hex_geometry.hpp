// Geometry of one cell: volume and its exact gradient by node position, S_p = dV/dx_p, so that
// dV/dt = sum_p S_p.u_p. Branch-free and inline: row kernels vectorise over i.
//
// 2D corners counter-clockwise (i,j) (i+1,j) (i+1,j+1) (i,j+1). In RZ (x = r, y = z) the volume is the
// full 2 pi integral of r dA, and S_r = A_r + H with the hoop part H_p = 2 pi integral N_p dA.
// 3D corners: those four at k, then at k+1; trilinear hexahedra (formula of LULESH, exact).
#pragma once

#include <numbers>

namespace ballast {

template <bool Axisymmetric> struct QuadGeometry {
  double x[4], y[4];

  double area() const {
    return 0.5 * ((x[2] - x[0]) * (y[3] - y[1]) - (x[3] - x[1]) * (y[2] - y[0]));
  }

  double volume() const {
    if constexpr (!Axisymmetric) {
      return area();
    } else {
      double sum = 0;
#pragma GCC unroll 4
      for (int p = 0; p < 4; ++p) {
        const int q = (p + 1) & 3;
        sum += (x[p] * x[p] + x[q] * x[q] + x[p] * x[q]) * (y[q] - y[p]); // bitwise symmetric in p, q
      }
      return std::numbers::pi / 3 * sum;
    }
  }

  /// S (total), and in RZ the hoop part H of its r component.
  void gradient(double (&sx)[4], double (&sy)[4], double (&hoop)[4]) const {
    const double a2 = 2 * area();
#pragma GCC unroll 4
    for (int p = 0; p < 4; ++p) {
      const int n = (p + 1) & 3, m = (p + 3) & 3;
      if constexpr (!Axisymmetric) {
        sx[p] = 0.5 * (y[n] - y[m]);
        sy[p] = 0.5 * (x[m] - x[n]);
        hoop[p] = 0;
      } else {
        constexpr double w = std::numbers::pi / 3;
        sx[p] = w * ((2 * x[p] + x[n]) * (y[n] - y[p]) + (2 * x[p] + x[m]) * (y[p] - y[m]));
        sy[p] = w * (x[m] - x[n]) * (x[m] + x[p] + x[n]);
        const double corner = (x[n] - x[p]) * (y[m] - y[p]) - (x[m] - x[p]) * (y[n] - y[p]);
        hoop[p] = std::numbers::pi / 6 * (corner + a2);
      }
    }
  }
};

/// Sums of a corner quantity with the signs of the trilinear modes, by butterflies: along the mid lines (four times
/// the difference from the low to the high face of an axis), and the hourglass modes eta zeta, zeta xi, xi eta,
/// xi eta zeta.
struct HexModes {
  double xi, eta, zeta, hourglass[4];
};
[[gnu::always_inline]] inline HexModes hex_modes(const double (&c)[8]) {
  const double s0 = c[0] + c[1], s1 = c[3] + c[2], s2 = c[4] + c[5], s3 = c[7] + c[6];
  const double d0 = c[1] - c[0], d1 = c[2] - c[3], d2 = c[5] - c[4], d3 = c[6] - c[7];
  const double se0 = s1 - s0, se1 = s3 - s2, ds0 = d0 + d1, ds1 = d2 + d3, de0 = d1 - d0, de1 = d3 - d2;
  return {ds0 + ds1, se0 + se1, (s2 + s3) - (s0 + s1), {se1 - se0, ds1 - ds0, de0 + de1, de1 - de0}};
}
/// Sum of the hourglass modes with weights w at every corner.
[[gnu::always_inline]] inline void hourglass_at_corners(const double (&w)[4], double (&out)[8]) {
  const double ab = w[0] + w[1], ba = w[0] - w[1], cd = w[2] + w[3], dc = w[2] - w[3];
  out[0] = ab + dc;
  out[1] = ba - dc;
  out[2] = dc - ab;
  out[3] = -ba - dc;
  out[4] = cd - ab;
  out[5] = -ba - cd;
  out[6] = ab + cd;
  out[7] = ba - cd;
}

struct HexGeometry {
  double x[8], y[8], z[8];

  void gradient(double (&bx)[8], double (&by)[8], double (&bz)[8]) const {
    static constexpr int T[8][6] = {{1, 2, 3, 4, 5, 7}, {2, 3, 0, 5, 6, 4}, {3, 0, 1, 6, 7, 5},
                                    {0, 1, 2, 7, 4, 6}, {7, 6, 5, 0, 3, 1}, {4, 7, 6, 1, 0, 2},
                                    {5, 4, 7, 2, 1, 3}, {6, 5, 4, 3, 2, 0}};
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      const int* t = T[p];
      bx[p] = component(y, z, t);
      by[p] = component(z, x, t);
      bz[p] = component(x, y, t);
    }
  }

  double volume() const {
    double bx[8], by[8], bz[8];
    gradient(bx, by, bz);
    return volume(bx);
  }
  /// V is linear in the x of all nodes at fixed y, z: V = sum x_p dV/dx_p.
  double volume(const double (&bx)[8]) const {
    double v = 0;
#pragma GCC unroll 8
    for (int p = 0; p < 8; ++p) {
      v += x[p] * bx[p];
    }
    return v;
  }

private:
  static double component(const double (&a)[8], const double (&b)[8], const int* t) {
    return ((a[t[1]] + a[t[2]]) * (b[t[0]] + b[t[1]]) - (a[t[0]] + a[t[1]]) * (b[t[1]] + b[t[2]]) +
            (a[t[0]] + a[t[4]]) * (b[t[3]] + b[t[4]]) - (a[t[3]] + a[t[4]]) * (b[t[0]] + b[t[4]]) -
            (a[t[2]] + a[t[5]]) * (b[t[3]] + b[t[5]]) + (a[t[3]] + a[t[5]]) * (b[t[2]] + b[t[5]])) *
           (1.0 / 12.0);
  }
};

} // namespace ballast
