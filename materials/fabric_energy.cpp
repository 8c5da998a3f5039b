// Strain energies of the fabric laws: integrals of their curves, by Gauss' rule on panels no curve bends much in.
#include "materials/fabric_curves.hpp"

namespace ballast {
namespace {

/// Integral of f from a to b: 32 panels of the five-point rule.
template <class Curve> double integral(Curve f, double a, double b) {
  constexpr double node[] = {0, 0.53846931010568309104, 0.90617984593866399280};
  constexpr double weight[] = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
  constexpr int panels = 32;
  const double half = 0.5 * (b - a) / panels;
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double middle = a + (2 * i + 1) * half;
    sum += weight[0] * f(middle);
    for (int k = 1; k < 3; ++k) {
      sum += weight[k] * (f(middle - half * node[k]) + f(middle + half * node[k]));
    }
  }
  return sum * half;
}

/// In s = ln(1 + 2E), where the pole at -1/2 lies at infinity; below the solid strain a straight line.
double transverse_energy(const RaftenbergFabric& m, double E) {
  const double solid = solid_strain(m);
  const double x = std::max(std::min(E, 0.0), solid), beyond = std::min(E, solid) - solid;
  const auto in_s = [&m](double s) {
    const double stretched = std::exp(s);
    return transverse_curve(m.transverse, m.form, 0.5 * (stretched - 1)).stress * 0.5 * stretched;
  };
  const double fit = x < 0 ? integral(in_s, 0, std::log1p(2 * x)) : 0.0;
  const CurvePoint p = transverse_curve(m.transverse, m.form, x);
  return beyond < 0 ? fit + p.stress * beyond + 0.5 * p.slope * beyond * beyond : fit;
}

/// S12 works on E12 and on E21: twice the integral over E, the integral over engineering shear.
double shear_energy(const ShearLaw& g, double E) {
  const double shear = 2 * std::abs(E);
  const double beyond = std::max(shear - g.first_angle, 0.0), far = std::max(shear - g.second_angle, 0.0);
  return 0.5 * (g.modulus * shear * shear + (g.stiffer - g.modulus) * beyond * beyond + (g.stiffest - g.stiffer) * far * far);
}

/// K (J - Js - Js ln(J/Js)), of -p = K (1 - Js/J), for J < Js.
double solid_energy(const RaftenbergFabric& m, const FabricTensor& E) {
  const double a = 1 + 2 * E[0], b = 1 + 2 * E[1], c = 1 + 2 * E[2], d = 2 * E[3], e = 2 * E[4], f = 2 * E[5];
  const double J = std::sqrt(a * (b * c - e * e) - d * (d * c - e * f) + f * (d * e - b * f));
  const double solid = m.density / m.solid->density;
  return J < solid ? m.solid->bulk_modulus * (J - solid - solid * std::log(J / solid)) : 0.0;
}

} // namespace

double strain_energy(const YarnFamily& y, double strain) {
  const double x = std::min(std::max(strain, 0.0), y.rupture);
  const double fit = integral([&y](double E) { return yarn_curve(y, E).stress; }, 0, x);
  const double down = std::min(std::max(strain - y.rupture, 0.0), y.unload);
  return fit + yarn_curve(y, y.rupture).stress * (down - 0.5 * down * down / y.unload);
}

double strain_energy(const RaftenbergFabric& m, const FabricTensor& E) {
  const double coupled = m.coupling * coupling_shape(m.warp.rupture, E[0]).value * coupling_shape(m.fill.rupture, E[1]).value;
  const double shear = shear_energy(m.in_plane, E[3]) + shear_energy(m.through, E[4]) + shear_energy(m.through, E[5]);
  return strain_energy(m.warp, E[0]) + strain_energy(m.fill, E[1]) + transverse_energy(m, E[2]) + shear + coupled + (m.solid ? solid_energy(m, E) : 0.0);
}

double strain_energy(const HookeSolid& m, const FabricTensor& E) {
  const double mu = m.young / (2 * (1 + m.poisson)), lambda = 2 * mu * m.poisson / (1 - 2 * m.poisson);
  const double trace = E[0] + E[1] + E[2];
  const double squares = E[0] * E[0] + E[1] * E[1] + E[2] * E[2] + 2 * (E[3] * E[3] + E[4] * E[4] + E[5] * E[5]);
  return 0.5 * lambda * trace * trace + mu * squares;
}

} // namespace ballast
