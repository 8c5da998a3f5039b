#include "materials/library.hpp"

#include "materials/library_metals.hpp"
#include "materials/library_tissues.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr double atmosphere = 101325;

MieGruneisen gruneisen(double rho0, double c0, double s, double gamma0) {
  return {.rho0 = rho0, .c0 = c0, .s = s, .gamma0 = gamma0};
}

Material finished(Material m) {
  m.specific_energy = energy(m.eos, m.density, atmosphere);
  return m;
}

// Spall pressures of the metals are switches of the right magnitude, not data (materials.md 2).

Material lead() {
  return {
      .name = "lead",
      .eos = gruneisen(11350, 2051, 1.46, 2.77),
      .strength = LinearHardening{.shear_modulus = 5.52e9, .yield = 34.5e6},
      .density = 11350,
      .spall_pressure = -0.4e9,
      .specific_heat = 124,
      .melt_temperature = 600.6,
      .source =
          "density, G, perfect plasticity 34.5 MPa: Raftenberg 2004 [S]; c0, s, gamma0: LASL "
          "Marsh compendium [K1]; heat capacity: Uintah SCG_Lead [R-2nd]; melting at 1 atm [K1]; "
          "spall -0.4 GPa [K3]",
      .confidence = "S, K1, K3"};
}

Material lead_antimony() {
  return {
      .name = "lead_antimony",
      .eos = gruneisen(11000, 2051, 1.46, 2.77),
      .strength = JohnsonCook{.shear_modulus = 5.52e9,
                              .A = 24e6,
                              .B = 300e6,
                              .n = 1,
                              .C = 0.1,
                              .m = 1,
                              .reference_rate = 5e-4,
                              .reference_temperature = 293,
                              .melt_temperature = 760,
                              .specific_heat = 124},
      .density = 11000,
      .spall_pressure = -0.4e9,
      .specific_heat = 124,
      .melt_temperature = 760,
      .source =
          "density of Pb-3 % Sb [K2]; c0, s, gamma0 of lead, LASL Marsh [K1]; G: the paper's lead [S]; "
          "Johnson-Cook of a 7.62 mm bullet's lead (Borvik via Flores-Johnson 2011, MaterialMap) "
          "[R:M2 2nd]: 70 MPa at 1e5 /s before it hardens, the paper's 34.5 MPa is `lead`; spall -0.4 GPa [K3]",
      .confidence = "R-2nd, S, K2, K3"};
}

Material copper_ofhc() {
  return {.name = "copper_ofhc",
          .eos = gruneisen(8960, 3940, 1.489, 2.02),
          .strength = JohnsonCook{.shear_modulus = 46e9,
                                  .A = 90e6,
                                  .B = 292e6,
                                  .n = 0.31,
                                  .C = 0.025,
                                  .m = 1.09,
                                  .reference_rate = 1,
                                  .reference_temperature = 293,
                                  .melt_temperature = 1356,
                                  .specific_heat = 383},
          .density = 8960,
          .spall_pressure = -1.3e9,
          .specific_heat = 383,
          .melt_temperature = 1356,
          .source =
              "Uintah copper cards, Johnson-Cook 1983 [R:U2, R:M3]; spall -1.2 to -1.5 GPa [K2]",
          .confidence = "R, K2"};
}

Material gilding_metal() {
  return {.name = "gilding_metal",
          .eos = gruneisen(8800, 3850, 1.46, 2.0),
          .strength = JohnsonCook{.shear_modulus = 44e9,
                                  .A = 206e6,
                                  .B = 505e6,
                                  .n = 0.42,
                                  .C = 0.01,
                                  .m = 1.68,
                                  .reference_rate = 5e-4,
                                  .reference_temperature = 293,
                                  .melt_temperature = 1318,
                                  .specific_heat = 376},
          .density = 8800,
          .spall_pressure = -1.3e9,
          .specific_heat = 376,
          .melt_temperature = 1318,
          .source =
              "C22000, Cu 90 Zn 10: density, melting, heat capacity [K1]; G, c0, s, gamma0 between "
              "copper and brass [K3]; strength: none found for it, that of a brass bullet jacket "
              "(Flores-Johnson 2011 [R-2nd]) [K3], since a jacket is drawn and so hard; the soft end "
              "is annealed copper, 90 MPa, 292 MPa, 0.31, 0.025, 1.09, 1 /s; spall [K3]",
          .confidence = "K1, K3"};
}

Material water() {
  return {
      .name = "water",
      .eos = gruneisen(998, 1480, 1.92, 0.28),
      .density = 998,
      .spall_pressure = -0.1e6,
      .specific_heat = 4186,
      .source =
          "density, c0 1480 m/s, s 1.92 (to 1.98) [K1]; gamma0 0.28,; cut-off -0.1 MPa: AWG card "
          "[R:M4 2nd]",
      .confidence = "K1, R-2nd"};
}

Material air() {
  return {.name = "air",
          .eos = IdealGas{1.4},
          .density = 1.2,
          .specific_heat = 719,
          .conductivity = 0.026,
          .source =
              "gamma 1.4, 1.2 kg/m3, cv 719 J/kg/K: AWG card [R:M4 2nd] and common knowledge [K1]; 0.026 W/m/K [K1]",
          .confidence = "K1"};
}

Material gelatin_10() {
  return {
      .name = "gelatin_10",
      .eos = gruneisen(1030, 1520, 1.8, 0.17),
      .strength = LinearHardening{.shear_modulus = 0.28e6, .yield = 0.22e6, .hardening = 1e3},
      .failure = JohnsonCookFailure{.D1 = 0.9},
      .density = 1030,
      .spall_pressure = -14e3,
      .specific_heat = 3700,
      .source =
          "density, yield 0.22 MPa, hardening 1 kPa, failure strain 0.9, cut-off 14 kPa: Wen 2013 via Zochowski 2019 "
          "[R:M1 2nd]; G 0.28 MPa reads its 0.85 MPa as Young's modulus [K2]; c0, s, gamma0, cp: "
          "an MPM code's card [R:G5 2nd]. Rate-independent: real gelatin stiffens 100-fold at "
          "1000 /s",
      .confidence = "R-2nd, K2"};
}

Material muscle() {
  return {
      .name = "muscle",
      .eos = gruneisen(1058, 1562, 1.8, 0.3),
      .strength = LinearHardening{.shear_modulus = 0.3e6, .yield = 0.2e6},
      .density = 1058,
      .spall_pressure = -0.1e6,
      .specific_heat = 3600,
      .source =
          "density and sound speed across the fibres: MDPI Bioengineering 2025 [R:T1]; s, gamma0 "
          "of "
          "water-like tissue [K2]; G 0.3 MPa, yield 0.2 MPa: order of gelatin at ballistic rates, "
          "where muscle carries 10-100 times its quasi-static stress [K3]; cut-off of water [K3]",
      .confidence = "R, K2, K3"};
}

const std::vector<Material>& library() {
  static const std::vector<Material> all = [] {
    std::vector<Material> made = {lead(), lead_antimony(), copper_ofhc(), gilding_metal(), water(), air(), gelatin_10(), muscle()};
    const std::vector<Material> metals = modelled_metals();
    made.insert(made.begin() + 4, metals.begin(), metals.end()); // after the other metals
    const std::vector<Material> tissues = viscoelastic_tissues();
    made.insert(made.end(), tissues.begin(), tissues.end());
    const std::vector<Material> torso = torso_tissues();
    made.insert(made.end(), torso.begin(), torso.end());
    std::transform(made.begin(), made.end(), made.begin(), finished);
    return made;
  }();
  return all;
}

} // namespace

const Material* find_material(std::string_view name) {
  const auto& all = library();
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const Material& m) { return m.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::vector<std::string> material_names() {
  std::vector<std::string> names;
  for (const Material& m : library()) {
    names.push_back(m.name);
  }
  return names;
}

std::string describe(const Material& m) {
  const double c = std::sqrt(sound_speed_squared(m.eos, m.density, m.specific_energy));
  std::string out =
      fmt::format("{}\n  density     {:g} kg/m3, sound speed {:.0f} m/s\n  eos         {}\n  "
                  "strength    {}\n",
                  m.name,
                  m.density,
                  c,
                  describe(m.eos),
                  describe(m.strength));
  out += m.failure ? fmt::format("  failure     {}\n", describe(*m.failure)) : "";
  out += std::isfinite(m.spall_pressure) ? fmt::format("  spall       {:g} Pa\n", m.spall_pressure)
                                         : std::string("  spall       never\n");
  if (m.specific_heat > 0) {
    out += fmt::format("  heat        {:g} J/kg/K", m.specific_heat);
    out += m.melt_temperature > 0 ? fmt::format(", melts at {:g} K\n", m.melt_temperature) : "\n";
  }
  out += m.conductivity > 0 ? fmt::format("  conducts    {:g} W/m/K\n", m.conductivity) : "";
  return out + fmt::format("  source      {}\n  confidence  {}\n", m.source, m.confidence);
}

} // namespace ballast
