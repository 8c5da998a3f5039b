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
std::string describe_one(const CubicGruneisen& m) {
  return fmt::format("Mie-Grueneisen, cubic Us-up, rho0 {:g}, c0 {:g}, s1 {:g}, s2 {:g}, s3 {:g}, Gamma0 {:g}, b {:g}",
                     m.rho0, m.c0, m.s1, m.s2, m.s3, m.gamma0, m.b);
}
std::string describe_one(const Jwl& m) {
  return fmt::format("JWL, rho0 {:g}, A {:g}, B {:g} Pa, R1 {:g}, R2 {:g}, omega {:g}{}",
                     m.rho0, m.A, m.B, m.R1, m.R2, m.omega,
                     m.detonation_energy > 0 ? fmt::format(", {:g} J/kg", m.detonation_energy) : "");
}
std::string describe_one(const LinearBulk& m) {
  return fmt::format("linear bulk, rho0 {:g}, K {:g} Pa{}", m.rho0, m.K, m.gamma0 > 0 ? fmt::format(", Gamma0 {:g}", m.gamma0) : "");
}
std::string describe_one(const Bubbly& m) {
  return fmt::format("bubbly, rho0 {:g}, {:g} of it gas at {:g} Pa, gamma {:g}, tissue {:g} m/s, skeleton {:g} Pa",
                     m.rho0, m.gas_fraction, m.gas_pressure, m.gamma, m.c0, m.skeleton_modulus);
}
std::string describe_one(const PAlpha& m) {
  return fmt::format("p-alpha, rho0 {:g}, solid {:g} kg/m3, K {:g} Pa, foam K {:g} Pa, crushes from {:g} to {:g} Pa",
                     m.rho0, m.solid_density, m.K, m.foam_modulus, m.crush_pressure, m.solid_pressure);
}

Condensed condensed_one(const IdealGas&) { return {}; }
Condensed condensed_one(const StiffenedGas&) { return {}; }
Condensed condensed_one(const Jwl&) { return {}; }
Condensed condensed_one(const MieGruneisen& m) { return {m.rho0, m.c0, m.gamma0, m.s, 0}; }
Condensed condensed_one(const CubicGruneisen& m) { return {m.rho0, m.c0, m.gamma0, m.s1, m.s2}; }
Condensed condensed_one(const LinearBulk& m) { return {m.rho0, std::sqrt(m.K / m.rho0), m.gamma0, 0, 0}; }
Condensed condensed_one(const Bubbly& m) { return {m.rho0, std::sqrt(m.sound_speed_squared(m.rho0, 0)), 0, 0, 0}; }
Condensed condensed_one(const PAlpha& m) { return {m.rho0, std::sqrt(m.sound_speed_squared(m.rho0, 0)), 0, 0, 0}; }

constexpr double snap_ulp = 16 * 2.220446049250313e-16; // mass / volume rounds by a few ulp
} // namespace

std::string describe(const Eos& eos) {
  return std::visit([](const auto& m) { return describe_one(m); }, eos);
}

Condensed condensed(const Eos& eos) {
  return std::visit([](const auto& m) { return condensed_one(m); }, eos);
}

bool barotropic(const Eos& eos) {
  const auto* bulk = std::get_if<LinearBulk>(&eos);
  return std::holds_alternative<Bubbly>(eos) || std::holds_alternative<PAlpha>(eos) || (bulk != nullptr && bulk->gamma0 == 0);
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

void evaluate_foam(const PAlpha& eos, const GaugeReference& ref, int count, const double* rho, double* compaction, double* gauge_pressure, double* modulus) {
  for (int i = 0; i < count; ++i) {
    compaction[i] = eos.compacted(rho[i], compaction[i]);
    const PAlpha::Branch at = eos.branch(rho[i], compaction[i]);
    const bool at_reference = compaction[i] == 0 && std::abs(rho[i] - ref.rho) <= snap_ulp * ref.rho;
    gauge_pressure[i] = (at_reference ? 0.0 : eos.p_rest + at.p - ref.p) + ref.offset;
    modulus[i] = rho[i] * at.slope / eos.solid_density;
  }
}

} // namespace ballast
