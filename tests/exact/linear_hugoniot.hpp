#pragma once

/// Mie-Grueneisen material with a linear shock law U_s = c0 + s u_p (SI), zero pressure and energy
/// at the reference density:
///   p = p_H + Gamma rho (e - e_H),  p_H = rho0 c0^2 eta / (1 - s eta)^2,  e_H = p_H eta / (2
///   rho0), eta = 1 - rho0 / rho.
/// In expansion (eta < 0) s is taken as 0: p_H and its slope stay continuous and the pole of a
/// stretched metal is avoided; tests/data/mg_plate_impact.csv makes the same choice. Reference:
/// Meyers, Dynamic Behavior of Materials (1994), ch. 4-5.

namespace ballast::exact {

/// Which product of the Grueneisen coefficient stays constant.
enum class GruneisenLaw { constant_gamma, constant_rho_gamma };

struct LinearHugoniot {
  double density;     ///< rho0, kg/m^3
  double sound_speed; ///< c0, m/s
  double slope;       ///< s
  double gruneisen;   ///< Gamma0
};

[[nodiscard]] inline double compression(const LinearHugoniot& material, double density) {
  return 1.0 - material.density / density;
}

[[nodiscard]] inline double hugoniot_slope(const LinearHugoniot& material, double eta) {
  return eta > 0.0 ? material.slope : 0.0;
}

/// Pa, on the principal Hugoniot.
[[nodiscard]] inline double hugoniot_pressure(const LinearHugoniot& material, double density) {
  const double eta = compression(material, density);
  const double pole = 1.0 - hugoniot_slope(material, eta) * eta;
  return material.density * material.sound_speed * material.sound_speed * eta / (pole * pole);
}

/// Pa, at any density (kg/m^3) and specific energy (J/kg).
[[nodiscard]] inline double
pressure(const LinearHugoniot& material, GruneisenLaw law, double density, double specific_energy) {
  const double on_hugoniot = hugoniot_pressure(material, density);
  const double energy = 0.5 * on_hugoniot * compression(material, density) / material.density;
  const double rho = law == GruneisenLaw::constant_gamma ? density : material.density;
  return on_hugoniot + material.gruneisen * rho * (specific_energy - energy);
}

} // namespace ballast::exact
