#include "remap/plane.hpp"

namespace ballast::remap::canonical {

namespace {

// d corner_volume / d a: the area of the cut divided by |m|.
double corner_slope(const Normal<3>& m, double a) {
  const auto [m1, m2, m3] = m;
  const double t2 = std::max(a - m2, 0.0);
  const double t3 = std::max(a - m3, 0.0);
  return (2.0 * a - m1 - (t2 / m1) * t2 - (t3 / m1) * t3) / (2.0 * m2 * m3);
}

// The root of Scardovelli and Zaleski's cubics: centre + sqrt(p) (sqrt(3) sin t - cos t).
double cubic_root(double centre, double p, double q) {
  const double root = std::sqrt(std::max(p, 0.0));
  const double cosine = root > 0.0 ? std::clamp(q / (p * root), -1.0, 1.0) : 1.0;
  const double c = std::cos(std::acos(cosine) / 3.0);
  return centre + root * (std::sqrt(3.0 * (1.0 - c * c)) - c);
}

// Newton on a convex rising function: from the right it descends monotonically, from the left its
// first step lands on the right. The bracket only guards round-off.
double polish(const Normal<3>& m, double v, double a, double low, double high) {
  for (int iteration = 0; iteration < 5; ++iteration) {
    a = std::clamp(a, low, high);
    const double step = (corner_volume(m, a) - v) / corner_slope(m, a);
    a -= step;
    if (std::abs(step) < 1e-14 * a)
      break;
  }
  return std::clamp(a, low, high);
}

} // namespace

double corner_offset(const Normal<2>& m, double v) {
  const double wedge = v * 2.0 * m[1]; // equals m1 where the cut passes a corner
  return wedge < m[0] ? std::sqrt(wedge * m[0]) : 0.5 * (wedge + m[0]);
}

double corner_offset(const Normal<3>& m, double v) {
  const auto [m1, m2, m3] = m;
  const double m12 = m1 + m2;
  const double at_m1 = m2 > 0.0 ? m1 * m1 / (6.0 * m2 * m3) : 0.0;
  if (v < at_m1)
    return std::cbrt(6.0 * m1 * m2 * m3 * v);
  if (v < at_m1 + (m2 - m1) / (2.0 * m3))
    return 0.5 * (m1 + std::sqrt(m1 * m1 + 8.0 * m2 * m3 * (v - at_m1)));
  if (m12 <= m3 && v >= m12 / (2.0 * m3))
    return m3 * v + 0.5 * m12;
  const double kink = std::min(m12, m3);
  if (m12 <= m3 || v < corner_volume(m, kink)) {
    const double guess = cubic_root(m12, 2.0 * m1 * m2, 1.5 * m1 * m2 * (m12 - 2.0 * m3 * v));
    return polish(m, v, guess, m2, kink);
  }
  const double guess =
      cubic_root(0.5, m1 * (m2 + m3) + m2 * m3 - 0.25, 1.5 * m1 * m2 * m3 * (0.5 - v));
  return polish(m, v, guess, m3, 0.5);
}

} // namespace ballast::remap::canonical
