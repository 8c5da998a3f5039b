// Plane waves in a linear viscoelastic solid whose deviator relaxes by a Prony series and whose bulk is elastic.
//
//   G*(w) = G_inf + sum G_i i w tau_i / (1 + i w tau_i),  M* = G* (shear) or K + 4/3 G* (uniaxial strain),
//   k = w sqrt(rho/M*): speed w / Re k, attenuation -Im k (1/m).
// A step's front runs at c0 = sqrt(M(0)/rho) and its jump decays as exp(-x M'(0) / (-2 M(0) c0)).
// Christensen, Theory of Viscoelasticity (1982), ch. 2; Coleman & Gurtin, ARMA 19 (1965) 239.
#pragma once

#include <cmath>
#include <complex>
#include <vector>

namespace ballast::exact {

struct PronySeries {
  double long_shear = 0;            ///< Pa
  std::vector<double> shear, time; ///< Pa, s
  double bulk = 0, density = 1;     ///< Pa, kg/m3
};

struct PlaneWave {
  double speed = 0, attenuation = 0; ///< m/s, 1/m
};

inline std::complex<double> complex_shear(const PronySeries& m, double w) {
  std::complex<double> g = m.long_shear;
  for (std::size_t b = 0; b < m.shear.size(); ++b) {
    const std::complex<double> x(0, w * m.time[b]);
    g += m.shear[b] * x / (1.0 + x);
  }
  return g;
}

inline PlaneWave plane_wave(const PronySeries& m, double frequency, bool longitudinal) {
  const double w = 2 * M_PI * frequency;
  const std::complex<double> g = complex_shear(m, w), modulus = longitudinal ? m.bulk + 4.0 / 3.0 * g : g;
  const std::complex<double> k = w * std::sqrt(m.density / modulus);
  return {w / k.real(), -k.imag()};
}

/// Speed and decay (1/m) of a step's front.
inline PlaneWave front(const PronySeries& m, bool longitudinal) {
  double modulus = m.long_shear, slope = 0;
  for (std::size_t b = 0; b < m.shear.size(); ++b) {
    modulus += m.shear[b];
    slope += m.shear[b] / m.time[b];
  }
  if (longitudinal) {
    modulus = m.bulk + 4.0 / 3.0 * modulus;
    slope *= 4.0 / 3.0;
  }
  const double speed = std::sqrt(modulus / m.density);
  return {speed, slope / (2 * modulus * speed)};
}

inline PronySeries sls() { return {1e6, {3e6}, {2e-5}, 2.3e9, 1050}; }
inline PronySeries tissue_a() { return {1e4, {4e4, 2e5, 1e6}, {1e-2, 1e-4, 2e-6}, 2.3e9, 1050}; }
inline PronySeries gelatin_b() { return {5e4, {1e5, 5e5}, {5e-4, 1e-5}, 2.25e9, 1060}; }

} // namespace ballast::exact
