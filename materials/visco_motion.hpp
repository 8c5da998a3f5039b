// What a cell does in a step, from its velocity gradient at mid-step: the deformation between the step's ends and the
// rotation of half a step.
//
// With x_half = (x_n + x_np1)/2 and L = dv/dx_half, the deformation f = dx_np1/dx_n = (1 - L dt/2)^-1 (1 + L dt/2) is
// exact. Its path inside the step is taken as f(t) = exp(t X/dt), X = log f = 2 atanh(L dt/2): a constant gradient.
#pragma once

#include "materials/visco_tensor.hpp"

namespace ballast {

/// X = log f of L dt: odd powers up to 13. Truncation (|L dt|/2)^15 / 7.5: below 1e-10 for |L dt| < 0.5.
inline Mat path_exponent(const Mat& gradient_dt) {
  const Mat square = product(gradient_dt, gradient_dt);
  Mat sum = unit_mat;
  for (std::size_t a = 0; a < 9; ++a) {
    sum[a] /= 13;
  }
  for (int k = 11; k >= 1; k -= 2) {
    sum = product(square, sum);
    for (std::size_t a = 0; a < 9; ++a) {
      sum[a] = 0.25 * sum[a] + unit_mat[a] / k;
    }
  }
  return product(gradient_dt, sum);
}

/// exp(x) by its series to the tenth power: below 1e-11 for |x| < 0.5.
inline Mat exponential(const Mat& x) {
  Mat sum = unit_mat;
  for (int k = 10; k >= 1; --k) {
    sum = product(x, sum);
    for (std::size_t a = 0; a < 9; ++a) {
      sum[a] = sum[a] / k + unit_mat[a];
    }
  }
  return sum;
}

/// Less its third of the trace: the isochoric part of a path.
inline Mat without_trace(Mat x) {
  const double mean = (x[0] + x[4] + x[8]) / 3;
  x[0] -= mean;
  x[4] -= mean;
  x[8] -= mean;
  return x;
}

/// Square root of the Hughes-Winget rotation (1 - W dt/2)^-1 (1 + W dt/2): quaternion (1, w dt/2), w the vorticity's
/// half, is the whole rotation; added to 1 and normalised it is the half. Orthogonal to round-off.
inline Mat half_rotation(const Mat& gradient_dt) {
  const double a = 0.25 * (gradient_dt[7] - gradient_dt[5]), b = 0.25 * (gradient_dt[2] - gradient_dt[6]),
               c = 0.25 * (gradient_dt[3] - gradient_dt[1]);
  const double v2 = a * a + b * b + c * c, w = 1 + std::sqrt(1 + v2), inv = 2 / (w * w + v2);
  return {1 - inv * (b * b + c * c), inv * (a * b - w * c),     inv * (a * c + w * b),
          inv * (a * b + w * c),     1 - inv * (a * a + c * c), inv * (b * c - w * a),
          inv * (a * c - w * b),     inv * (b * c + w * a),     1 - inv * (a * a + b * b)};
}

} // namespace ballast
