// Where lines along a mesh axis meet the surfaces of shapes, and where sections jump.
#pragma once

#include "problems/shapes.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace ballast {

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

/// Candidates for where a line p + t e_k meets a surface; a few too many are harmless.
void cut(const Shape& shape, const Line& line, Cuts& cuts);

/// Coordinates along axis j where a section may jump or bend (`flat`: a 2D scene, where round sides do so too):
/// lines are never laid across them.
void jumps(const Shape& shape, std::size_t j, bool flat, std::vector<double>& out);

void cut(const Surface& s, const Line& line, Cuts& cuts);
void jumps(const Surface& s, std::size_t j, std::vector<double>& out);

void cut(const Voxels& v, const Line& line, Cuts& cuts);

} // namespace ballast
