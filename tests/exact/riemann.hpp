#pragma once

#include "tests/exact/flow_state.hpp"

/// Riemann problem of two stiffened gases, each side with its own constants:
///   p = (gamma - 1) rho e - gamma p_inf,   c^2 = gamma (p + p_inf) / rho;   ideal gas: p_inf = 0.
/// The star pressure is the root of f_L(p) + f_R(p) + u_R - u_L = 0, f the velocity jump over a
/// shock or a rarefaction. With P = p + p_inf every relation is the ideal-gas one.
/// Reference: Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed., ch. 4;
/// Ivings, Causon, Toro, Int. J. Numer. Meth. Fluids 28 (1998) 395 for the stiffened gas.
/// Units: any consistent set.

namespace ballast::exact {

struct GasState {
  double density;
  double velocity;
  double pressure;
  double gamma;
  double p_infinity = 0.0;
};

/// Velocities of the waves' edges; head is the outer edge. Head equals tail for a shock.
struct WaveSpeeds {
  double left_head;
  double left_tail;
  double contact;
  double right_tail;
  double right_head;
};

class Riemann {
public:
  struct Sample {
    double density;
    double velocity;
    double pressure;
    bool left; ///< material of the left state (left of the contact, or of the vacuum's middle)
  };

  /// Throws std::invalid_argument unless density > 0, gamma > 1, p + p_inf >= 0 on both sides.
  Riemann(GasState left, GasState right);

  [[nodiscard]] double star_pressure() const { return star_pressure_; }
  /// Contact velocity; with a vacuum, the mean of the vacuum's two edges.
  [[nodiscard]] double star_velocity() const { return star_velocity_; }
  [[nodiscard]] double star_density_left() const { return left_.star_density; }
  [[nodiscard]] double star_density_right() const { return right_.star_density; }
  [[nodiscard]] const WaveSpeeds& waves() const { return waves_; }

  /// True when the sides part faster than the gases can follow. Each side then expands to
  /// p = -min(p_inf): the vacuum of an ideal gas, a free surface of water against air. For two
  /// stiffened gases this is the end of the EOS, not a cavitation model.
  [[nodiscard]] bool vacuum() const { return vacuum_; }

  /// State on the ray x/t, x measured from the initial interface. Inside a vacuum: density 0,
  /// velocity x/t.
  [[nodiscard]] Sample at(double x_over_t) const;

private:
  struct Side {
    GasState gas;
    double direction; ///< -1: its wave runs left
    double star_velocity;
    double star_density;
    double head; ///< outer and inner edge of the wave, times `direction`
    double tail;
  };

  static Side make_side(const GasState& gas, double direction, double star_pressure);
  [[nodiscard]] FlowState sample(const Side& side, double x_over_t) const;

  Side left_{};
  Side right_{};
  WaveSpeeds waves_{};
  double star_pressure_ = 0.0;
  double star_velocity_ = 0.0;
  bool vacuum_ = false;
};

} // namespace ballast::exact
