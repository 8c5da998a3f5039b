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

namespace {
/// By value: the compiler then knows that stores change neither the model nor the reference.
template <class Model>
void evaluate_model(const Model model, const GaugeReference ref, int count, const double* rho, const double* e, double* gauge_pressure, double* modulus) {
  const double rho_band = snap_ulp * std::abs(ref.rho), e_band = snap_ulp * std::abs(ref.e);
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double r = rho[i], energy = e[i];
    const double away = model.pressure(r, energy) - ref.p, c2 = model.sound_speed_squared(r, energy);
    const bool at_reference = (std::abs(r - ref.rho) <= rho_band) & (std::abs(energy - ref.e) <= e_band);
    const double difference = at_reference ? 0.0 : away;
    gauge_pressure[i] = difference + ref.offset;
    modulus[i] = r * c2;
  }
}
} // namespace

void evaluate_row(const Eos& eos, const GaugeReference& ref, int count, const double* rho, const double* e, double* gauge_pressure, double* modulus) {
  std::visit([&](const auto& model) { evaluate_model(model, ref, count, rho, e, gauge_pressure, modulus); }, eos);
}

} // namespace ballast
