// Lung: gas bubbles in tissue, and a skeleton beside them. Pressure depends on density alone.
//
//   p = p_rest + (P - P0) + K_s (rho/rho0 - 1),   rho0/rho = phi0 (P0/P)^(1/gamma) + (1 - phi0) [1 + n (P - P0)/K]^(-1/n)
// P > 0 is the absolute pressure that gas and tissue share, P0 the gas's at rest (1 atm, whatever the scene's ambient),
// phi0 its share of the volume, K = rho_t c0^2 the tissue's modulus with rho_t = rho0/(1 - phi0) (gas has no mass),
// n = 7 (Tait, as water). Without the tissue's compression P = P0 [phi0/(phi0 - mu/(1 + mu))]^gamma, mu = rho/rho0 - 1;
// with it there is no pole. At rest c^2 = K_s/rho0 + Wood's: 1/(rho c^2) = phi0/(gamma P0) + (1 - phi0)/K
// (Wood, A Textbook of Sound, 1930). c^2 is the exact derivative and positive everywhere; tension ends at -P0 - K_s.
// Pressed until its tissue has half of its volume it goes on along a straight line: what n = 7 makes of a trace that is
// pressed a hundredfold is no pressure that anything has.
// Work goes to the energy, which only keeps the books: shock heat in the gas does not push back.
#pragma once

#include <cmath>

namespace ballast {

struct Bubbly {
  double rho0 = 200;             ///< of the whole, kg/m3
  double gas_fraction = 0.8;     ///< phi0, of the volume at rest
  double gas_pressure = 101325;  ///< P0, absolute, Pa
  double gamma = 1.4;            ///< of the gas; 1: isothermal
  double c0 = 1540;              ///< of the tissue, m/s
  double skeleton_modulus = 0;   ///< K_s, Pa
  double p_rest = 101325;        ///< pressure at rho0: a scene sets its ambient, Pa

  double tissue_modulus() const { return rho0 / (1 - gas_fraction) * c0 * c0; }

  double pressure(double rho, double) const {
    const Shared end = beyond(rho) ? volume(most()) : Shared{};
    const double P = end.P > 0 ? end.P + slope(end) * (rho - rho0 / end.v) : shared(rho).P;
    return p_rest + (P - gas_pressure) + skeleton_modulus * (rho / rho0 - 1);
  }
  double sound_speed_squared(double rho, double) const { return slope(beyond(rho) ? volume(most()) : shared(rho)) + skeleton_modulus / rho0; }
  /// Pa: what gas and tissue share where the straight line begins.
  double most() const { return gas_pressure + tissue_modulus() / n * (std::pow(tightest, -n) - 1); }
  double energy(double, double) const { return 0; }

private:
  static constexpr double n = 7, tightest = 0.5; ///< the last: of the tissue's volume
  struct Shared {
    double P, v, dv; // pressure of both, volume over that at rest, and its derivative by P
  };
  /// dP/drho.
  double slope(const Shared& s) const { return s.v * s.v / (rho0 * -s.dv); }
  bool beyond(double rho) const {
    constexpr double near = 0.75; // of the tissue's volume: what is looser need not be looked at
    const double x = rho0 / rho;
    return x < near * (1 - gas_fraction) && x < volume(most()).v;
  }
  Shared volume(double P) const {
    const double K = tissue_modulus(), stiff = K + n * (P - gas_pressure);
    const double gas = gas_fraction * std::pow(gas_pressure / P, 1 / gamma);
    const double tissue = (1 - gas_fraction) * std::pow(stiff / K, -1 / n);
    return {P, gas + tissue, -gas / (gamma * P) - tissue / stiff};
  }
  /// Newton on v^-gamma, which gas alone makes linear in P and which is concave for gas with tissue (n > gamma): from
  /// below the root it rises to it and cannot pass it. It starts at the largest of what gas alone or tissue alone would bear.
  Shared shared(double rho) const {
    constexpr double close = 1e-15;
    constexpr int most = 100; // 11 at worst over twelve decades of density, 2 on average
    const double x = rho0 / rho, room = x > 1 ? x - (1 - gas_fraction) : x; // tissue in tension swells by less than it fills
    const double gas = gas_pressure * std::pow(gas_fraction / room, gamma);
    const double full = x < 1 - gas_fraction ? gas_pressure + tissue_modulus() / n * (std::pow((1 - gas_fraction) / x, n) - 1) : 0.0;
    const double least = x < 1 ? gas_pressure : 0.0;
    Shared s = volume(std::fmax(std::fmax(gas, full), least));
    for (int it = 0; it < most; ++it) {
      const double step = s.v * (std::pow(s.v / x, gamma) - 1) / (-gamma * s.dv);
      if (!(step > close * s.P)) {
        break;
      }
      s = volume(s.P + step);
    }
    return s;
  }
};

} // namespace ballast
