#pragma once

/// Sound in a disc or a ball of radius 1 whose edge is held at the ambient pressure, sound speed 1: the gravest symmetric mode
///   p' = f(k r) cos(k t),  f = J0 (disc, k = 2.404825557695773) or sin(x)/x (ball, k = pi),
/// of p_tt = div grad p. Linear: p' small against the ambient pressure.

#include <cmath>
#include <numbers>

namespace ballast::exact {

struct StandingWave {
  bool ball = false;

  [[nodiscard]] double wave_number() const { return ball ? std::numbers::pi : 2.404825557695773; }
  [[nodiscard]] double period() const { return 2 * std::numbers::pi / wave_number(); }
  /// p' at a radius (0 to 1) and time, 1 at the centre at the start.
  [[nodiscard]] double pressure(double radius, double time) const {
    const double x = wave_number() * radius;
    const double shape = !ball ? std::cyl_bessel_j(0, x) : x > 1e-8 ? std::sin(x) / x : 1.0;
    return shape * std::cos(wave_number() * time);
  }
};

} // namespace ballast::exact
