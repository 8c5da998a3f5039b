// Sheets of free point masses for tests of contact: no forces but what a test gives them.
#pragma once

#include "ale/layers/contact.hpp"

#include <cmath>
#include <functional>
#include <vector>

namespace ballast {

template <int Dim> struct Sheet {
  using Vec = std::array<double, Dim>;

  std::array<int, 2> segments = {1, 1};
  std::array<std::vector<double>, Dim> x, v;
  std::vector<double> mass;
  std::vector<char> alive;
  int outside = 1;

  int nodes_along(int axis) const { return axis < Dim - 1 ? segments[static_cast<std::size_t>(axis)] + 1 : 1; }
  int count() const { return static_cast<int>(mass.size()); }

  ContactSurface<Dim> view() {
    ContactSurface<Dim> s;
    s.segments = segments;
    for (std::size_t d = 0; d < Dim; ++d) {
      s.position[d] = x[d].data();
      s.velocity[d] = v[d].data();
    }
    s.mass = mass.data();
    s.outside = outside;
    s.alive = alive.empty() ? nullptr : alive.data();
    return s;
  }
  void move(double dt) {
    for (std::size_t d = 0; d < Dim; ++d) {
      for (std::size_t n = 0; n < mass.size(); ++n) {
        x[d][n] += dt * v[d][n];
      }
    }
  }
  void set_velocity(const Vec& u) {
    for (std::size_t d = 0; d < Dim; ++d) {
      v[d].assign(mass.size(), u[d]);
    }
  }
  Vec momentum() const {
    Vec p{};
    for (std::size_t d = 0; d < Dim; ++d) {
      for (std::size_t n = 0; n < mass.size(); ++n) {
        p[d] += mass[n] * v[d][n];
      }
    }
    return p;
  }
  /// About the origin; in 2D the last component.
  std::array<double, 3> angular_momentum() const {
    std::array<double, 3> l{};
    for (std::size_t n = 0; n < mass.size(); ++n) {
      for (std::size_t d = Dim == 3 ? 0 : 2; d < 3; ++d) {
        const std::size_t a = (d + 1) % 3, b = (d + 2) % 3;
        l[d] += mass[n] * (x[a][n] * v[b][n] - x[b][n] * v[a][n]);
      }
    }
    return l;
  }
  double kinetic_energy() const {
    double e = 0;
    for (std::size_t n = 0; n < mass.size(); ++n) {
      for (std::size_t d = 0; d < Dim; ++d) {
        e += 0.5 * mass[n] * v[d][n] * v[d][n];
      }
    }
    return e;
  }
};

/// place(a, b): where the node at the shares a, b of the sheet's sides stands. Masses: the node's share of the segments.
template <int Dim>
Sheet<Dim> make_sheet(std::array<int, 2> segments, int outside, double mass, const std::function<std::array<double, Dim>(double, double)>& place) {
  Sheet<Dim> s;
  s.segments = {segments[0], Dim == 3 ? segments[1] : 1};
  s.outside = outside;
  const int n = s.nodes_along(0), rows = s.nodes_along(1);
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < n; ++i) {
      const auto at = place(static_cast<double>(i) / segments[0], Dim == 3 ? static_cast<double>(j) / segments[1] : 0.0);
      for (std::size_t d = 0; d < Dim; ++d) {
        s.x[d].push_back(at[d]);
        s.v[d].push_back(0);
      }
      double share = i == 0 || i == n - 1 ? 0.5 : 1;
      share *= Dim == 3 && (j == 0 || j == rows - 1) ? 0.5 : 1;
      s.mass.push_back(share * mass / (segments[0] * (Dim == 3 ? segments[1] : 1)));
    }
  }
  return s;
}

/// A flat sheet, `side` by `side`, lowest corner (from, from), at the height.
template <int Dim> Sheet<Dim> flat_sheet(int n, double from, double side, double height, int outside, double mass) {
  return make_sheet<Dim>({n, n}, outside, mass, [&](double a, double b) {
    std::array<double, Dim> x{};
    x[0] = from + side * a;
    x[1] = from + side * b;
    x[Dim - 1] = height;
    return x;
  });
}

/// Turned about the origin by rotations in the planes 0-1 and, in 3D, 1-2 and 0-2.
template <int Dim> void turn(std::array<std::vector<double>, Dim>& f, double angle) {
  const auto in_plane = [&](std::size_t p, std::size_t q, double t) {
    for (std::size_t n = 0; n < f[0].size(); ++n) {
      const double a = f[p][n], b = f[q][n];
      f[p][n] = std::cos(t) * a - std::sin(t) * b;
      f[q][n] = std::sin(t) * a + std::cos(t) * b;
    }
  };
  in_plane(0, 1, angle);
  if constexpr (Dim == 3) {
    in_plane(1, 2, 0.7 * angle);
    in_plane(0, 2, -1.3 * angle);
  }
}

/// A little of everything, the same in every run.
inline double scatter(std::size_t n) {
  const double s = std::sin(12.9898 * static_cast<double>(n + 1)) * 43758.5453;
  return 2 * (s - std::floor(s)) - 1;
}

} // namespace ballast
