#include "materials/strength.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {

double shear_modulus(const Strength& strength) {
  return std::visit(
      [](const auto& m) {
        if constexpr (std::is_same_v<std::decay_t<decltype(m)>, NoStrength>) {
          return 0.0;
        } else {
              return m.shear_modulus;
        }
      },
      strength);
}

bool has_strength(const Strength& strength) { return !std::holds_alternative<NoStrength>(strength); }

namespace {
std::string describe_one(const NoStrength&) { return "none"; }
std::string describe_one(const LinearHardening& m) {
  return fmt::format("J2, G {:g}, Y {:g}, H {:g} Pa", m.shear_modulus, m.yield, m.hardening);
}
std::string describe_one(const JohnsonCook& m) {
  return fmt::format("Johnson-Cook, G {:g}, A {:g}, B {:g} Pa, n {:g}, C {:g}, m {:g}",
                     m.shear_modulus, m.A, m.B, m.n, m.C, m.m);
}
} // namespace

std::string describe(const Strength& strength) {
  return std::visit([](const auto& m) { return describe_one(m); }, strength);
}

double flow_stress(const LinearHardening& m, const FlowState& s, double increment) {
  return m.yield + m.hardening * (s.plastic_strain + increment);
}

PlasticIncrement plastic_increment(const LinearHardening& m, const FlowState& s, double trial) {
  const double excess = trial - flow_stress(m, s, 0);
  return {excess > 0 ? excess / (3 * m.shear_modulus + m.hardening) : 0.0};
}

double flow_stress(const JohnsonCook& m, const FlowState& s, double increment) {
  const double ep = s.plastic_strain + increment;
  const double homologous = std::clamp(
      s.thermal_energy / (m.specific_heat * (m.melt_temperature - m.reference_temperature)), 0.0, 1.0);
  const double softening = homologous > 0 ? 1 - std::pow(homologous, m.m) : 1.0;
  const double rate = s.dt > 0 ? increment / s.dt / m.reference_rate : 0.0;
  const double hardening = m.A + (ep > 0 ? m.B * std::pow(ep, m.n) : 0.0);
  return hardening * (1 + m.C * std::log(std::max(rate, 1.0))) * softening;
}

PlasticIncrement plastic_increment(const JohnsonCook& m, const FlowState& s, double trial) {
  if (trial <= flow_stress(m, s, 0)) {
    return {0.0};
  }
  // r(d) = trial - 3 G d - sigma_y(d) falls from > 0 at 0 to <= 0 at trial/3G: regula falsi with the
  // Illinois weight, bisected every fourth time. B ep^n has an infinite slope at 0, so Newton is not safe.
  double low = 0, high = trial / (3 * m.shear_modulus);
  double r_low = trial - flow_stress(m, s, 0);
  double r_high = -flow_stress(m, s, high);
  const double tolerance = 1e-11 * trial;
  int side = 0;
  double d = high;
  for (int it = 1; it <= 100; ++it) {
    d = it % 4 == 0 ? 0.5 * (low + high) : (low * r_high - high * r_low) / (r_high - r_low);
    const double r = trial - 3 * m.shear_modulus * d - flow_stress(m, s, d);
    if (std::abs(r) <= tolerance || high - low <= 1e-15 * high) {
      return {d, true, it};
    }
    if (r > 0) {
      low = d;
      r_low = r;
      r_high *= side == 1 ? 0.5 : 1.0;
      side = 1;
    } else {
      high = d;
      r_high = r;
      r_low *= side == -1 ? 0.5 : 1.0;
      side = -1;
    }
  }
  return {d, false, 100};
}

} // namespace ballast
