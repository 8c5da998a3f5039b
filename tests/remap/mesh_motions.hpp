// Smooth fields on a RemapBox, and motions of its nodes.
#pragma once

#include "tests/remap/remap_box.hpp"

#include <functional>
#include <random>

namespace ballast::remap {

template <int Dim> using Map = std::function<Point<Dim>(const Point<Dim>&)>;
template <int Dim> using Field = std::function<double(const Point<Dim>&)>;

/// One material everywhere: density and energy at the cells' centres, velocity at the nodes.
template <int Dim>
void fill_smooth(RemapBox<Dim>& box, const Field<Dim>& rho, const Field<Dim>& e, const Map<Dim>& u) {
  box.for_each_cell([&](int i, int j, int k) {
    const Point<Dim> x = box.centre(i, j, k);
    box.fill(0, i, j, k, 1, rho(x), e(x));
  });
  box.update_node_mass();
  box.set_velocity(u);
}

/// Interior nodes moved by `size` of a cell at random; bitwise the same for the same seed.
template <int Dim> Map<Dim> random_nodes(const RemapBox<Dim>& box, double size) {
  const BoxShape s = box.shape;
  return [s, size](const Point<Dim>& x) {
    Point<Dim> out = x;
    std::size_t seed = 17;
    bool inside = true;
    for (std::size_t d = 0; d < Dim; ++d) {
      const double h = (s.high[d] - s.low[d]) / s.cells[d];
      seed = seed * 1000003 + static_cast<std::size_t>(std::lround((x[d] - s.low[d]) / h) + 4);
      inside = inside && x[d] > s.low[d] + 0.5 * h && x[d] < s.high[d] - 0.5 * h;
    }
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> amount(-size, size);
    for (std::size_t d = 0; d < Dim && inside; ++d) {
      out[d] += amount(random) * (s.high[d] - s.low[d]) / s.cells[d];
    }
    return out;
  };
}

/// A whirl about the box's middle in the first two axes that leaves the boundary alone.
template <int Dim> Map<Dim> whirl(double angle) {
  return [angle](const Point<Dim>& x) {
    Point<Dim> out = x;
    double w = angle;
    for (const double q : x) {
      w *= 4 * q * (1 - q);
    }
    const double a = x[0] - 0.5, b = x[1] - 0.5;
    out[0] += (std::cos(w) - 1) * a - std::sin(w) * b;
    out[1] += std::sin(w) * a + (std::cos(w) - 1) * b;
    return out;
  };
}

template <int Dim> Map<Dim> moved(double dx, double dy) {
  return [=](Point<Dim> x) {
    x[0] += dx;
    x[1] += dy;
    return x;
  };
}

constexpr std::array<int, 3> cells_of(int dim, int n) {
  return {n, n + 2, dim == 3 ? n - 1 : 1};
}

} // namespace ballast::remap
