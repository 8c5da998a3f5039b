#include "eos/eos.hpp"

#include <cmath>
#include <fmt/format.h>

namespace ballast {

double pressure(const Eos& eos, double rho, double e) {
  return std::visit([&](const auto& m) { return m.pressure(rho, e); }, eos);
}

double sound_speed_squared(const Eos& eos, double rho, double e) {
  return std::visit([&](const auto& m) { return m.sound_speed_squared(rho, e); }, eos);
}

double energy(const Eos& eos, double rho, double p) {
  return std::visit([&](const auto& m) { return m.energy(rho, p); }, eos);
}

namespace {
std::string describe_one(const IdealGas& m) { return fmt::format("ideal gas, gamma {:g}", m.gamma); }
std::string describe_one(const StiffenedGas& m) {
  return fmt::format("stiffened gas, gamma {:g}, p_infinity {:g} Pa", m.gamma, m.p_infinity);
}
std::string describe_one(const MieGruneisen& m) {
  return fmt::format("Mie-Grueneisen, rho0 {:g}, c0 {:g}, s {:g}, Gamma0 {:g}", m.rho0, m.c0, m.s, m.gamma0);
}

constexpr double snap_ulp = 16 * 2.220446049250313e-16; // mass / volume rounds by a few ulp
} // namespace

std::string describe(const Eos& eos) {
  return std::visit([](const auto& m) { return describe_one(m); }, eos);
}

void evaluate_row(const Eos& eos,
                  const GaugeReference& ref,
                  int count,
                  const double* rho,
                  const double* e,
                  double* gauge_pressure,
                  double* modulus) {
  const double rho_band = snap_ulp * std::abs(ref.rho);
  const double e_band = snap_ulp * std::abs(ref.e);
  std::visit(
      [&](const auto& shared) {
        const auto m = shared; // a local copy: the compiler then knows that stores do not change it
#pragma omp simd
        for (int i = 0; i < count; ++i) {
          const double p = m.pressure(rho[i], e[i]);
          const bool at_reference =
              (std::abs(rho[i] - ref.rho) <= rho_band) & (std::abs(e[i] - ref.e) <= e_band);
          gauge_pressure[i] = (at_reference ? 0.0 : p - ref.p) + ref.offset;
          modulus[i] = rho[i] * m.sound_speed_squared(rho[i], e[i]);
        }
      },
      eos);
}

} // namespace ballast
