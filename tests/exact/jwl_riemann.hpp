#pragma once

#include "tests/exact/flow_state.hpp"

/// Riemann problem of one JWL material, V = rho0/rho:
///   p = f(V) + w rho e,  f = A (1 - w/(R1 V)) exp(-R1 V) + B (1 - w/(R2 V)) exp(-R2 V).
/// Linear in e, so both wave curves close by hand. Shock from (p0, rho0): e - e0 = (p + p0)(v0 - v)/2.
/// Isentrope: p = A exp(-R1 V) + B exp(-R2 V) + C V^(-1 - w), and the velocity jump int c drho/rho by
/// Simpson's rule (converged to 1e-12). The star state is the root of the jumps' sum in pressure.
/// Reference: Kamm, LA-UR-14-28175 (2015). Units: any consistent set.

namespace ballast::exact {

struct JwlLaw {
  double rho0, A, B, R1, R2, omega;
};

class JwlRiemann {
public:
  /// Throws std::runtime_error when no star pressure is found between 1e-6 and 1e3 times the states' own.
  JwlRiemann(const JwlLaw& law, const FlowState& left, const FlowState& right);

  [[nodiscard]] double star_pressure() const { return star_pressure_; }
  [[nodiscard]] double star_velocity() const { return star_velocity_; }
  [[nodiscard]] double star_density_left() const { return left_.star_density; }
  [[nodiscard]] double star_density_right() const { return right_.star_density; }
  /// Velocities of the left and right wave: outer and inner edge, equal for a shock.
  [[nodiscard]] double left_head() const { return left_.head; }
  [[nodiscard]] double left_tail() const { return left_.tail; }
  [[nodiscard]] double right_tail() const { return right_.tail; }
  [[nodiscard]] double right_head() const { return right_.head; }

  /// State on the ray x/t from the initial interface.
  [[nodiscard]] FlowState at(double x_over_t) const;

private:
  struct Side {
    FlowState far{};
    double direction = 1; ///< -1: its wave runs left
    double star_density = 0, head = 0, tail = 0;
    bool shock = false;
  };
  double jump(const Side& side, double pressure, double& density) const;
  double isentrope(const Side& side, double density, double& sound) const;
  [[nodiscard]] double rarefied_velocity(const Side& side, double density) const;
  void finish(Side& side) const;
  [[nodiscard]] FlowState sample(const Side& side, double x_over_t) const;

  JwlLaw law_;
  Side left_, right_;
  double star_pressure_ = 0, star_velocity_ = 0;
};

/// Specific energy at a density and pressure.
[[nodiscard]] double jwl_energy(const JwlLaw& law, double density, double pressure);

} // namespace ballast::exact
