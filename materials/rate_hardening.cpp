#include "materials/rate_hardening.hpp"

#include "materials/radial_return.hpp"

#include <algorithm>

namespace ballast {

double hardened(const PowerLawPlastic& m, double plastic_strain) {
  return m.coefficient * std::pow(m.first_strain + plastic_strain, m.exponent);
}

double hardened(const TabulatedHardening& m, double plastic_strain) {
  for (std::size_t i = 1; i < static_cast<std::size_t>(m.points); ++i) {
    if (plastic_strain < m.strain[i]) {
      const double part = (plastic_strain - m.strain[i - 1]) / (m.strain[i] - m.strain[i - 1]);
      return m.stress[i - 1] + part * (m.stress[i] - m.stress[i - 1]);
    }
  }
  return m.stress[static_cast<std::size_t>(m.points) - 1];
}

namespace {
template <class Model> double flow(const Model& m, const FlowState& s, double increment) {
  return hardened(m, s.plastic_strain + increment) * m.rate.factor(s.dt > 0 ? increment / s.dt : 0.0);
}

/// With a rate in y = (d/(C dt))^(1/p), the excess of the rate factor: q = h(ep + C dt y^p) (1 + y). In d itself the
/// factor rises so steeply from 0 that the root of a trial just above yield, y^p with p = 7 and more, need not be a number.
template <class Model> PlasticIncrement solve(const Model& m, const FlowState& s, double trial) {
  if (!m.rate.matters() || !(s.dt > 0)) {
    return solve_return(trial, m.shear_modulus, [&](double d) { return flow(m, s, d); });
  }
  const double at_rest = hardened(m, s.plastic_strain);
  if (trial <= at_rest) {
    return {0.0};
  }
  const auto increment = [&](double y) { return m.rate.constant * s.dt * std::pow(y, m.rate.exponent); };
  const auto residual = [&](double y) {
    const double d = increment(y);
    return trial - 3 * m.shear_modulus * d - hardened(m, s.plastic_strain + d) * (1 + y);
  };
  const double unrelieved = trial / at_rest - 1, slack = std::pow(trial / (3 * m.shear_modulus * m.rate.constant * s.dt), 1 / m.rate.exponent);
  const double high = std::min(unrelieved, slack); // without hardening and relief; relieved of all stress
  const PlasticIncrement y = falling_root(high, trial - at_rest, std::min(residual(high), 0.0), 1e-11 * trial, residual);
  return {increment(y.value), y.converged, y.iterations};
}
} // namespace

double flow_stress(const PowerLawPlastic& m, const FlowState& s, double increment) { return flow(m, s, increment); }
double flow_stress(const TabulatedHardening& m, const FlowState& s, double increment) { return flow(m, s, increment); }

PlasticIncrement plastic_increment(const PowerLawPlastic& m, const FlowState& s, double trial) {
  return solve(m, s, trial);
}
PlasticIncrement plastic_increment(const TabulatedHardening& m, const FlowState& s, double trial) {
  return solve(m, s, trial);
}

} // namespace ballast
