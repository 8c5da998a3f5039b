// What a fabric's constants must be, and how they are printed.
#include "core/error.hpp"
#include "materials/fabric_curves.hpp"

#include <fmt/format.h>

namespace ballast {
namespace {

void require(bool holds, std::string_view where, std::string_view name, double value, std::string_view cure) {
  if (!holds) {
    throw Error(fmt::format("{}: {} is {:g}: {}", where, name, value, cure));
  }
}

void require_finite(const RationalFit& k, std::string_view where, std::string_view name) {
  const double constants[] = {k.a, k.b, k.c, k.d, k.e, k.f};
  for (int i = 0; i < 6; ++i) {
    require(std::isfinite(constants[i]), where, fmt::format("{}.{}", name, "abcdef"[i]), constants[i], "give a number");
  }
}

double denominator(const RationalFit& k, double E) { return 1 + E * (k.e + E * k.f); }

/// Green strain in [low, high] where q is least: an end or its vertex.
double least_denominator(const RationalFit& k, double low, double high) {
  double least = denominator(k, low) < denominator(k, high) ? low : high;
  const double vertex = k.f > 0 ? -0.5 * k.e / k.f : low;
  return vertex > low && vertex < high && denominator(k, vertex) < denominator(k, least) ? vertex : least;
}

void require_no_pole(const RationalFit& k, double low, double high, std::string_view where, std::string_view name) {
  const double at = least_denominator(k, low, high);
  if (!(denominator(k, at) > 0)) {
    throw Error(fmt::format("{}: {} has a pole: 1 + eE + fE^2 is {:g} at E = {:g}, within [{:g}, {:g}]: keep all printed digits of e and f "
                            "(e^2 < 4f has no pole)",
                            where, name, denominator(k, at), at, low, high));
  }
}

constexpr int samples = 1000; // of a curve, for its sign

void check_family(const YarnFamily& y, std::string_view where, std::string_view name) {
  require_finite(y.fit, where, name);
  require(y.rupture > 0 && std::isfinite(y.rupture), where, fmt::format("{}.rupture", name), y.rupture, "give the Green strain of the largest load, above 0");
  require(y.unload > 0 && std::isfinite(y.unload), where, fmt::format("{}.unload", name), y.unload,
          "stress cannot fall over no strain: give more than 0 (0.4 as printed, 0.02 for a short ramp)");
  require(y.fit.a > 0, where, fmt::format("{}.a", name), y.fit.a, "the initial modulus is above 0");
  require_no_pole(y.fit, 0, y.rupture, where, name);
  for (int i = 1; i <= samples; ++i) {
    const double E = y.rupture * i / samples;
    require(yarn_curve(y, E).stress > 0, where, fmt::format("{} stress at E = {:g}", name, E), yarn_curve(y, E).stress,
            "stretched yarns pull: check the signs and units of a to d (Pa)");
  }
}

void check_transverse(const RaftenbergFabric& m, std::string_view where) {
  require_finite(m.transverse, where, "transverse");
  require(m.transverse.a > 0, where, "transverse.a", m.transverse.a, "the initial modulus is above 0");
  const double most = m.solid ? solid_strain(m) : -0.5;
  require_no_pole(m.transverse, most, 0, where, "transverse");
  for (int i = 1; i < samples; ++i) {
    const double E = most * i / samples, stress = transverse_curve(m.transverse, m.form, E).stress;
    require(stress < 0, where, fmt::format("transverse stress at E = {:g}", E), stress, "a pressed fabric pushes: check the signs and units of a to d (Pa)");
  }
  if (m.solid) {
    const double slope = transverse_curve(m.transverse, m.form, most).slope;
    require(slope >= 0, where, "transverse slope at the solid density", slope, "the curve must still rise there: choose another solid density");
  }
}

void check_shear(const ShearLaw& g, std::string_view where, std::string_view name) {
  require(g.modulus >= 0 && std::isfinite(g.modulus), where, fmt::format("{}.modulus", name), g.modulus, "give 0 or more, in Pa");
  require(g.first_angle > 0 && g.second_angle >= g.first_angle, where, fmt::format("{}.second_angle", name), g.second_angle,
          fmt::format("angles are above 0 and grow (first_angle is {:g})", g.first_angle));
  const double moduli[] = {g.stiffer, g.stiffest};
  const double from[] = {g.first_angle, g.second_angle};
  for (int i = 0; i < 2; ++i) {
    require(!std::isfinite(from[i]) || moduli[i] > 0, where, fmt::format("{}.{}", name, i == 0 ? "stiffer" : "stiffest"), moduli[i],
            "a stage that is reached needs a modulus above 0, in Pa");
    require(std::isfinite(moduli[i]), where, fmt::format("{}.{}", name, i == 0 ? "stiffer" : "stiffest"), moduli[i], "give a number");
  }
}

void check_one(const RaftenbergFabric& m, std::string_view where) {
  require(m.density > 0 && std::isfinite(m.density), where, "density", m.density, "give areal density over thickness, kg/m3, above 0");
  if (m.solid) {
    require(m.solid->density > m.density && std::isfinite(m.solid->density), where, "solid.density", m.solid->density,
            fmt::format("the solid is denser than the fabric's {:g} kg/m3 (Kevlar 1440)", m.density));
    require(m.solid->bulk_modulus > 0 && std::isfinite(m.solid->bulk_modulus), where, "solid.bulk_modulus", m.solid->bulk_modulus, "give more than 0, in Pa");
  }
  check_family(m.warp, where, "warp");
  check_family(m.fill, where, "fill");
  check_transverse(m, where);
  check_shear(m.in_plane, where, "in_plane");
  check_shear(m.through, where, "through");
  if (m.rate) {
    require(m.rate->C >= 0 && std::isfinite(m.rate->C), where, "rate.C", m.rate->C, "give 0 or more: yarns grow stronger with rate");
    require(m.rate->reference_rate > 0, where, "rate.reference_rate", m.rate->reference_rate, "give more than 0, in 1/s");
  }
  require(m.coupling >= 0 && std::isfinite(m.coupling), where, "coupling", m.coupling, "give 0 (none) or more, in Pa");
}

void check_one(const HookeSolid& m, std::string_view where) {
  require(m.density > 0 && std::isfinite(m.density), where, "density", m.density, "give kg/m3, above 0");
  require(m.young > 0 && std::isfinite(m.young), where, "young", m.young, "give Young's modulus in Pa, above 0");
  require(m.poisson > -1 && m.poisson < 0.5, where, "poisson", m.poisson, "give Poisson's ratio between -1 and 0.5");
}

std::string describe_shear(const ShearLaw& g) {
  return std::isfinite(g.first_angle) ? fmt::format("{:g}, {:g} from {:g} rad, {:g} from {:g} rad", g.modulus, g.stiffer, g.first_angle, g.stiffest, g.second_angle)
                                      : fmt::format("{:g}", g.modulus);
}

std::string describe_family(const char* name, const YarnFamily& y) {
  return fmt::format("{} {:g} Pa at rupture E = {:g}, to zero over {:g}", name, yarn_curve(y, y.rupture).stress, y.rupture, y.unload);
}

std::string describe_one(const RaftenbergFabric& m) {
  constexpr const char* forms[] = {"A", "B", "C"};
  std::string out = fmt::format("decoupled orthotropic: {}; {}; transverse form {}; shear {} in plane, {} through, Pa",
                                describe_family("warp", m.warp), describe_family("fill", m.fill), forms[static_cast<int>(m.form)],
                                describe_shear(m.in_plane), describe_shear(m.through));
  out += m.solid ? fmt::format("; solid from {:g} kg/m3, K {:g} Pa", m.solid->density, m.solid->bulk_modulus) : "";
  out += m.secant_unloading ? "; secant unloading" : "";
  out += m.rate ? fmt::format("; rate factor C {:g} above {:g} /s", m.rate->C, m.rate->reference_rate) : "";
  return out + (m.coupling > 0 ? fmt::format("; coupling {:g} Pa", m.coupling) : "");
}

std::string describe_one(const HookeSolid& m) {
  return fmt::format("isotropic St Venant-Kirchhoff, E {:g} Pa, nu {:g}", m.young, m.poisson);
}

} // namespace

void check(const FabricModel& model, std::string_view where) {
  std::visit([where](const auto& m) { check_one(m, where); }, model);
}

double density(const FabricModel& model) {
  return std::visit([](const auto& m) { return m.density; }, model);
}

std::string describe(const FabricModel& model) {
  return std::visit([](const auto& m) { return describe_one(m); }, model);
}

} // namespace ballast
