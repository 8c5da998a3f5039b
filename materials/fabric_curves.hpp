// The one-component curves of the fabric law: stress and slope at a strain. Branch-free, so that rows of them vectorise.
#pragma once

#include "materials/fabric.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

struct CurvePoint {
  double stress = 0, slope = 0;
};

/// Printed curve of warp or fill: fit, ramp, zero.
[[gnu::always_inline]] inline CurvePoint yarn_curve(const YarnFamily& y, double E) {
  const RationalFit& k = y.fit;
  const double x = std::min(std::max(E, 0.0), y.rupture);
  const double q = 1 + x * (k.e + x * k.f);
  const double fit = x * (k.a + x * (k.b + x * (k.c + x * k.d))) / q;
  const double rise = (k.a + x * (2 * k.b + x * (3 * k.c + x * 4 * k.d)) - fit * (k.e + x * 2 * k.f)) / q;
  const double left = 1 - (E - y.rupture) / y.unload;
  const double stress = E < y.rupture ? fit : fit * std::max(left, 0.0);
  const double fall = left > 0 ? -fit / y.unload : 0.0;
  const double slope = E < y.rupture ? rise : fall;
  return {E < 0 ? 0.0 : stress, E < 0 ? 0.0 : slope};
}

/// Transverse curve in its form; below `solid_strain` along the tangent there.
[[gnu::always_inline]] inline CurvePoint transverse_curve(const RationalFit& k, TransverseForm form, double E, double solid_strain = -0.5) {
  const double pressed = std::min(E, 0.0);
  const double x = std::max(pressed, solid_strain);
  const double t = 1 + 2 * x;
  const double q = 1 + x * (k.e + x * k.f);
  const double t_again = form == TransverseForm::b ? t : 1.0, q_again = form == TransverseForm::c ? q : 1.0;
  const double denominator = t * q * t_again * q_again;
  const double fit = x * (k.a + x * (k.b + x * (k.c + x * k.d))) / denominator;
  const double rise = (k.a + x * (2 * k.b + x * (3 * k.c + x * 4 * k.d))) / denominator;
  const double of_t = (form == TransverseForm::b ? 4.0 : 2.0) / t;
  const double of_q = (form == TransverseForm::c ? 2.0 : 1.0) * (k.e + x * 2 * k.f) / q;
  const double slope = rise - fit * (of_t + of_q);
  const bool solid = (pressed < x) & (solid_strain > -0.5);
  return {solid ? fit + slope * (pressed - x) : fit, E > 0 ? 0.0 : slope};
}

/// Shear stress and tangent modulus at tensor shear E.
[[gnu::always_inline]] inline CurvePoint shear_curve(const ShearLaw& g, double E) {
  const double shear = 2 * std::abs(E);
  const double beyond = std::max(shear - g.first_angle, 0.0), far = std::max(shear - g.second_angle, 0.0);
  const double size = g.modulus * shear + (g.stiffer - g.modulus) * beyond + (g.stiffest - g.stiffer) * far;
  return {std::copysign(size, E), far > 0 ? g.stiffest : beyond > 0 ? g.stiffer : g.modulus};
}

/// g(E) of the coupling energy, g' and g''.
struct CouplingShape {
  double value = 0, slope = 0, curvature = 0;
};
inline CouplingShape coupling_shape(double rupture, double E) {
  const double x = std::min(std::max(E, 0.0), rupture);
  const bool inside = E >= 0 && E < rupture;
  return {x * x / 2 - x * x * x / (3 * rupture), x * (1 - x / rupture), inside ? 1 - 2 * x / rupture : 0.0};
}

/// Transverse Green strain at which fabric of no other strain is solid; -1/2 where the law has no solid.
inline double solid_strain(const RaftenbergFabric& law) {
  const double stretch = law.solid ? law.density / law.solid->density : 0.0;
  return 0.5 * (stretch * stretch - 1);
}

} // namespace ballast
