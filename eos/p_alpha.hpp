// Foam that crushes for good: p-alpha of a solid with a straight pressure-density line.
//
//   p = p_rest + K (eta - 1/alpha),  eta = rho/rho_s: the solid's pressure over alpha (Carroll & Holt, J. Appl. Phys. 43 (1972) 1626)
// with K, rho_s of the solid and alpha = rho_s/rho of what is not pressed. Loading for the first time:
//   elastic, p = K_f (rho/rho0 - 1) up to the crush pressure p_e;
//   crushing, alpha = 1 + (alpha_e - 1) x^2, x = (p_s - p)/(p_s - p_e) (Herrmann, J. Appl. Phys. 40 (1969) 2490);
//   solid from p_s on, alpha = 1.
// From then on alpha stays: below the largest density so far p falls and rises along a line of slope K/rho_s (Herrmann's simplest
// choice: crushed foam is as stiff as its solid). The history is the compaction 1 - rho0/rho of that density, 0 until it crushes.
// Pressure depends on density and history alone: work goes to the energy, which only keeps the books, and does not press.
// Sound speed is the slope of the branch the state is on: on the crush curve that of further crushing, K/rho_s once it unloads.
#pragma once

#include <algorithm>
#include <cmath>

namespace ballast {

struct PAlpha {
  double rho0 = 100;           ///< of the foam, kg/m3
  double solid_density = 1000; ///< rho_s, kg/m3
  double K = 2e9;              ///< bulk modulus of the solid, Pa
  double foam_modulus = 1e6;   ///< K_f, elastic, at rho0, Pa
  double crush_pressure = 1e5; ///< p_e above rest, Pa
  double solid_pressure = 1e7; ///< p_s above rest, Pa
  double p_rest = 0;           ///< pressure at rho0: a scene sets its ambient, Pa

  /// Pressure less p_rest and its slope by eta.
  struct Branch {
    double p, slope;
  };
  double share() const { return rho0 / solid_density; } ///< eta at rest
  double first_crush() const { return share() * (1 + crush_pressure / foam_modulus); }
  /// For the first time.
  Branch loading(double eta) const {
    const double crush = first_crush(), slope = foam_modulus / share();
    return eta <= crush ? Branch{slope * (eta - share()), slope} : eta >= 1 + solid_pressure / K ? Branch{K * (eta - 1), K} : crushing(eta, crush);
  }
  Branch branch(double rho, double compaction) const {
    const double eta = rho / solid_density, largest = share() / (1 - compaction);
    return compaction > 0 && eta < largest ? Branch{loading(largest).p - K * (largest - eta), K} : loading(eta);
  }
  /// Of a cell at the end of a step: grows only, and only by crushing.
  double compacted(double rho, double compaction) const {
    return rho / solid_density > first_crush() ? std::max(compaction, 1 - rho0 / rho) : compaction;
  }

  double pressure(double rho, double) const { return p_rest + branch(rho, 0).p; }
  double sound_speed_squared(double rho, double) const { return branch(rho, 0).slope / solid_density; }
  double energy(double, double) const { return 0; }

private:
  /// Root x of 1/(1 + a x^2) + (p_s - w x)/K = eta in [0, 1]: Newton, halving where it leaves the bracket.
  Branch crushing(double eta, double crush) const {
    constexpr int most = 60;
    const double a = 1 / (crush - crush_pressure / K) - 1, w = solid_pressure - crush_pressure;
    double low = 0, high = 1, x = std::sqrt(std::clamp((1 / eta - 1) / a, 0.0, 1.0)), fall = 0;
    for (int it = 0; it < most; ++it) {
      const double inverse = 1 / (1 + a * x * x), excess = inverse + (solid_pressure - w * x) / K - eta;
      fall = 2 * a * x * inverse * inverse + w / K;
      (excess > 0 ? low : high) = x;
      const double next = x + excess / fall, inside = next > low && next < high ? next : 0.5 * (low + high);
      if (std::abs(inside - x) <= 1e-15) {
        break;
      }
      x = inside;
    }
    return {solid_pressure - w * x, w / fall};
  }
};

} // namespace ballast
