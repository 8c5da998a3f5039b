#pragma once
// What fits to a stencil share, private to remap/: the misfit of a plane, summed so that mirroring or
// swapping the stencil changes no bit, and the descent (LVIRA) that lowers it.

#include "remap/normal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ballast::remap {

inline constexpr std::array<int, 3> stride = {1, 3, 9};
template <int Dim> inline constexpr int centre = stencil_size<Dim> / 2;

// No step improves on this: 27 cells off by 1e-14, the round trip of a plane.
inline constexpr double exact_misfit = 27e-28;

// Sums must not depend on the order of axes, so terms are added in ascending order.
template <int Dim> double ordered_sum(Normal<Dim> terms) {
  std::sort(terms.begin(), terms.end());
  double sum = 0.0;
  for (const double term : terms)
    sum += term;
  return sum;
}

// A sum that the order of terms does not change and that mirrored terms exactly mirror.
inline double balanced_sum(double* begin, double* end) {
  for (double* term = begin; term != end; ++term) // by size; few terms
    for (double* q = term; q != begin && std::abs(*q) < std::abs(q[-1]); --q)
      std::swap(*q, q[-1]);
  double rise = 0.0;
  double fall = 0.0;
  for (const double* term = begin; term != end; ++term)
    (*term > 0.0 ? rise : fall) += *term;
  return rise + fall;
}

template <int Dim> Normal<Dim> unit(const Normal<Dim>& n) {
  Normal<Dim> squares;
  for (int d = 0; d < Dim; ++d)
    squares[d] = n[d] * n[d];
  const double length = std::sqrt(ordered_sum<Dim>(squares));
  Normal<Dim> scaled;
  for (int d = 0; d < Dim; ++d)
    scaled[d] = n[d] / length;
  return scaled;
}

// The stencil seen along n: axes mirrored and sorted so that every misfit is summed in an order
// that mirroring or swapping the stencil does not change.
template <int Dim> struct Frame {
  Normal<Dim> m;             // |n| ascending, summing to 1
  std::array<int, Dim> axis; // where each came from
  std::array<int, Dim> step; // signed stride in the stencil
  bool ambiguous = false;    // a zero or two equal components: the order is not unique
};

template <int Dim> Frame<Dim> frame_of(const Normal<Dim>& n) {
  Frame<Dim> frame;
  for (int d = 0; d < Dim; ++d)
    frame.axis[d] = d;
  const auto shorter = [&](int a, int b) { return std::abs(n[a]) < std::abs(n[b]); };
  if (shorter(frame.axis[1], frame.axis[0]))
    std::swap(frame.axis[0], frame.axis[1]);
  if constexpr (Dim == 3) {
    if (shorter(frame.axis[2], frame.axis[1]))
      std::swap(frame.axis[1], frame.axis[2]);
    if (shorter(frame.axis[1], frame.axis[0]))
      std::swap(frame.axis[0], frame.axis[1]);
  }
  double sum = 0.0;
  for (int d = 0; d < Dim; ++d)
    sum += std::abs(n[frame.axis[d]]);
  for (int d = 0; d < Dim; ++d) {
    frame.m[d] = std::abs(n[frame.axis[d]]) / sum;
    frame.step[d] = n[frame.axis[d]] < 0.0 ? -stride[frame.axis[d]] : stride[frame.axis[d]];
    frame.ambiguous |= frame.m[d] == (d == 0 ? 0.0 : frame.m[d - 1]);
  }
  return frame;
}

// visit(index in f, m.offset) over the stencil in the frame's order; equal m are added first, so
// that exchanging them changes no bit.
template <class Visit> void visit_stencil(const Frame<2>& frame, const Visit& visit) {
  for (int b = -1; b <= 1; ++b)
    for (int a = -1; a <= 1; ++a)
      visit(centre<2> + b * frame.step[1] + a * frame.step[0], a * frame.m[0] + b * frame.m[1]);
}

template <class Visit> void visit_stencil(const Frame<3>& frame, const Visit& visit) {
  const auto [m1, m2, m3] = frame.m;
  const bool last_pair = m2 == m3;
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b) {
      const int row = centre<3> + c * frame.step[2] + b * frame.step[1];
      for (int a = -1; a <= 1; ++a) {
        const double rise = last_pair ? a * m1 + (b * m2 + c * m3) : (a * m1 + b * m2) + c * m3;
        visit(row + a * frame.step[0], rise);
      }
    }
}

template <int Dim> using Stencil = std::array<double, stencil_size<Dim>>;

// residual[index] = volume of the plane in that cell - f[index].
template <int Dim>
void residuals(const Frame<Dim>& frame, const double* f, Stencil<Dim>& residual) {
  const double b = canonical::centred_offset<Dim>(frame.m, f[centre<Dim>]);
  visit_stencil(frame, [&](int index, double rise) {
    residual[index] = canonical::centred_volume<Dim>(frame.m, b - rise) - f[index];
  });
}

// Sum over the stencil of a b.
template <int Dim>
double product(const Frame<Dim>& frame, const Stencil<Dim>& a, const Stencil<Dim>& b) {
  Stencil<Dim> terms;
  int count = 0;
  visit_stencil(frame, [&](int index, double) { terms[count++] = a[index] * b[index]; });
  if (frame.ambiguous)
    return balanced_sum(terms.data(), terms.data() + count);
  double sum = 0.0;
  for (const double term : terms)
    sum += term;
  return sum;
}

// LVIRA: Gauss-Newton from a start on the normal's tilts; never worse than the start.
template <int Dim> Normal<Dim> improved(const Normal<Dim>& start, const double* f);

} // namespace ballast::remap
