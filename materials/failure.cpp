#include "materials/failure.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {

double failure_strain(const JohnsonCookFailure& m, const FailureState& s) {
  constexpr double least = 1e-6, steepest = 1.5, largest_exponent = 700; // strain, triaxiality, of what is finite
  const double range = m.specific_heat > 0 ? m.melt_temperature - m.reference_temperature : 0.0;
  const double warmer = range > 0 ? m.start_temperature - m.reference_temperature + s.thermal_energy / m.specific_heat : 0.0;
  const double homologous = range > 0 ? std::clamp(warmer / range, 0.0, 1.0) : 0.0;
  const double ductile = m.D1 + m.D2 * std::exp(std::min(m.D3 * std::min(s.triaxiality, steepest), largest_exponent));
  const double rate = 1 + m.D4 * std::log(std::max(s.rate / m.reference_rate, 1.0));
  return std::max(least, ductile * rate * (1 + m.D5 * homologous));
}

std::string describe(const JohnsonCookFailure& m) {
  return fmt::format("Johnson-Cook, D1 {:g}, D2 {:g}, D3 {:g}, D4 {:g}, D5 {:g}, {:g} /s", m.D1, m.D2, m.D3, m.D4, m.D5, m.reference_rate);
}

} // namespace ballast
