// What keeps an element from turning inside out (LayerGuard): W(J) by its modulus at both surfaces, and its waves.
#pragma once

#include "ale/layers/layer_element.hpp"

#include <algorithm>

namespace ballast::layer_element {

/// dW/dJ of the guard by its modulus, W = J - least - least ln(J/least) below `least`; straight where all is lost.
constexpr double lost_volume = 1e-3;
[[gnu::always_inline]] inline double guard_slope(double J, double least) {
  const double x = std::max(J, lost_volume);
  return J < least ? 1 - least / x + std::min(J - x, 0.0) * least / (x * x) : 0.0;
}

/// Wave moduli of the guard by its modulus: J_,k^2 d2W/dJ2, the larger of the two surfaces.
template <int Dim>
[[gnu::always_inline]] inline std::array<double, 3> guard_waves(const Modes<Dim>& c, const Gradients& a, double J0, double J1, double least) {
  const auto bend = [least](double J) __attribute__((always_inline)) { const double x = std::max(J, lost_volume); return J < least ? least / (x * x) : 0.0; };
  const SurfaceVolume<Dim> low = surface_volume(c, a, -1), up = surface_volume(c, a, 1);
  const double b0 = bend(J0), b1 = bend(J1);
  return {std::max(b0 * dot(low.by1, low.by1), b1 * dot(up.by1, up.by1)), std::max(b0 * dot(low.by2, low.by2), b1 * dot(up.by2, up.by2)),
          std::max(b0 * dot(low.by3, low.by3), b1 * dot(up.by3, up.by3))};
}

/// Square of the stretch along an axis, 1 + 2E; in 2D 0 in the plane: nothing held varies by it there.
[[gnu::always_inline]] inline double stretch_square(const Modes<3>& c, const Gradients& a, std::size_t axis) {
  return axis == 0 ? a.a1 * a.a1 * dot(c[c1], c[c1]) : axis == 1 ? a.a2 * a.a2 * dot(c[c2], c[c2]) : a.a3 * a.a3 * dot(c[c3], c[c3]);
}
[[gnu::always_inline]] inline double stretch_square(const Modes<2>& c, const Gradients& a, std::size_t axis) {
  return axis == 0 ? 0.0 : axis == 1 ? 0.0 : a.a3 * a.a3 * dot(c[p3], c[p3]);
}

/// dE33/dt.
[[gnu::always_inline]] inline double s33_rate(const Modes<3>& c, const Modes<3>& rate, const Gradients& a) { return a.a3 * a.a3 * dot(c[c3], rate[c3]); }
[[gnu::always_inline]] inline double s33_rate(const Modes<2>& c, const Modes<2>& rate, const Gradients& a) { return a.a3 * a.a3 * dot(c[p3], rate[p3]); }

} // namespace ballast::layer_element
