#include "tests/exact/cubic_impact.hpp"

#include "tests/exact/find_root.hpp"

#include <stdexcept>

namespace ballast::exact {

ShockedState shocked(const CubicHugoniot& m, double u) {
  const auto velocity = [&](double eta) { return m.sound_speed * eta / (1 - m.s1 * eta - m.s2 * eta * eta - m.s3 * eta * eta * eta); };
  const double pole = m.s2 == 0 && m.s3 == 0 && m.s1 > 0 ? (1 - 1e-12) / m.s1 : 0.7;
  const RootResult root = find_root([&](double eta) { return velocity(eta) - u; }, 0.0, pole < 0.7 ? pole : 0.7);
  if (!root.converged) {
    throw std::invalid_argument("shocked: beyond the fit");
  }
  const double eta = root.value, speed = u / eta;
  return {u, speed, m.density * speed * u, m.density / (1 - eta), 0.5 * u * u};
}

CubicImpact cubic_impact(const CubicHugoniot& flyer, const CubicHugoniot& target, double speed) {
  const auto excess = [&](double u) { return shocked(flyer, speed - u).pressure - shocked(target, u).pressure; };
  const double u = find_root(excess, 1e-9 * speed, (1 - 1e-9) * speed).value;
  return {shocked(flyer, speed - u), shocked(target, u), u};
}

} // namespace ballast::exact
