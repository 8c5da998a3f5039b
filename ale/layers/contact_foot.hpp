// Feet of points on one segment: along the interpolated normals of its corners, and orthogonal ones.
#pragma once

#include "ale/layers/contact_surface.hpp"

namespace ballast {

/// A field on a segment: f + a f_a + b f_b + a b f_ab.
template <int Dim> struct Patch {
  std::array<double, Dim> f, f_a, f_b, f_ab;

  /// at(c): the field at a corner.
  template <class Corner> explicit Patch(Corner&& at) {
    const std::array<double, Dim> low = at(0), high = at(1);
    f = low;
    for (std::size_t d = 0; d < Dim; ++d) {
      f_a[d] = high[d] - low[d];
      f_b[d] = f_ab[d] = 0;
    }
    if constexpr (Dim == 3) {
      const std::array<double, 3> low_high = at(2), high_high = at(3);
      for (std::size_t d = 0; d < 3; ++d) {
        f_b[d] = low_high[d] - low[d];
        f_ab[d] = high_high[d] - high[d] - f_b[d];
      }
    }
  }
  std::array<double, Dim> value(double a, double b) const {
    std::array<double, Dim> v;
    for (std::size_t d = 0; d < Dim; ++d) {
      v[d] = f[d] + a * f_a[d] + b * (f_b[d] + a * f_ab[d]);
    }
    return v;
  }
  std::array<double, Dim> along_a(double b) const {
    std::array<double, Dim> v;
    for (std::size_t d = 0; d < Dim; ++d) {
      v[d] = f_a[d] + b * f_ab[d];
    }
    return v;
  }
  std::array<double, Dim> along_b(double a) const {
    std::array<double, Dim> v;
    for (std::size_t d = 0; d < Dim; ++d) {
      v[d] = f_b[d] + a * f_ab[d];
    }
    return v;
  }
};

/// Places of a segment.
template <int Dim> Patch<Dim> places(const ContactSurface<Dim>& s, int segment) {
  const auto corner = s.corners_of(segment);
  return Patch<Dim>([&](std::size_t c) { return s.place(corner[c]); });
}

/// A foot: shares of the corners follow from `local`.
template <int Dim> struct Foot {
  std::array<double, 2> local = {0.5, 0.5};
  double gap = 0;
  std::array<double, Dim> normal{};
  bool found = false; ///< on the bilinear patch or its continuation
};

/// Foot along the interpolated normals, starting from `start`.
template <int Dim> Foot<Dim> find_foot(const ContactSurface<Dim>& s, int segment, const std::array<double, Dim>& point, const std::array<double, 2>& start);

/// Orthogonal foot near `foot`; `foot` itself where it is too far from the patch for that to matter.
template <int Dim> Foot<Dim> orthogonal_foot(const ContactSurface<Dim>& s, int segment, const std::array<double, Dim>& point, const Foot<Dim>& foot);

/// Half the longest diagonal of a segment, m.
template <int Dim> double segment_extent(const ContactSurface<Dim>& s, int segment);

} // namespace ballast
