#include "materials/steinberg_guinan.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {
constexpr double room = 300; // K, to which Steinberg's constants belong

double squeeze(const SteinbergGuinan& m, double density) { return std::max(0.0, 1 - m.eos.rho0 / density); }
} // namespace

double temperature(const SteinbergGuinan& m, double density, double heat) {
  const double x = squeeze(m, density), s = m.eos.s1, c2 = m.eos.c0 * m.eos.c0;
  const double cold = c2 * x * x * (0.5 + x * (2 * s / 3 + x * (18 * s * s + 12 * m.eos.s2 - 2 * m.eos.gamma0 * s) / 24));
  return m.reference_temperature * std::exp(m.eos.gamma0 * x) + (heat - cold) / m.specific_heat;
}

double melting_temperature(const SteinbergGuinan& m, double density) {
  const double x = squeeze(m, density);
  return m.melt_temperature * std::exp(2 * m.melt_a * x) * std::pow(1 - x, -2 * (m.eos.gamma0 - m.melt_a - 1.0 / 3));
}

double shear_ratio(const SteinbergGuinan& m, double density, double pressure, double heat) {
  const double T = temperature(m, density, heat);
  if (T >= melting_temperature(m, density)) {
    return 0;
  }
  const double eta = std::max(density / m.eos.rho0, 0.5); // tension spalls long before: only to keep p / eta^(1/3) finite
  return std::max(0.0, 1 + m.shear_per_pressure / m.shear_modulus * pressure / std::cbrt(eta) - m.thermal_softening * (T - room));
}

} // namespace ballast
