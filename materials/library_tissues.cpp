#include "materials/library_tissues.hpp"

namespace ballast {
namespace {

/// Water-like: s 1.8, gamma0 0.3.
MieGruneisen wet(double rho0, double c0) { return {.rho0 = rho0, .c0 = c0, .s = 1.8, .gamma0 = 0.3}; }

// An Ogden card's modulus at rest is mu alpha/2; a Prony term's relaxation time 1/beta.

Material fat() {
  return {.name = "fat",
          .eos = wet(927, 1462),
          .strength = Viscoelastic{Prony{.long_shear = 300, .branches = 1, .branch = {{{3000, 1.0 / 310}}}}},
          .density = 927,
          .spall_pressure = -0.1e6,
          .specific_heat = 2300,
          .source = "density and sound speed of adipose tissue: MDPI Bioengineering 2025 [R:T1]; s, gamma0 of water-like tissue [K2]; Engelbrektsson 2011 in the "
                    "human body model VIVA+ 50F: Ogden mu 30 Pa, alpha 20, so 300 Pa at rest, Prony 3 kPa, 310 /s [R:H1]: without the card's stiffening "
                    "at large strain; cut-off of water [K3]; heat capacity [K2]",
          .confidence = "R, K2, K3"};
}

Material abdomen() {
  return {.name = "abdomen",
          .eos = wet(1056, 1550),
          .strength = Viscoelastic{Prony{.long_shear = 350, .branches = 3, .branch = {{{800, 1.0 / 6}, {1800, 1.0 / 50}, {2200, 1.0 / 600}}}}},
          .density = 1056,
          .spall_pressure = -0.1e6,
          .specific_heat = 3600,
          .source = "density and sound speed between liver and kidney: MDPI Bioengineering 2025 [R:T1] [K2]; s, gamma0 of water-like tissue [K2]; abdominal bulk of "
                    "the human body model VIVA+ 50F: Ogden mu 35 Pa, alpha 20, so 350 Pa at rest, Prony 0.8, 1.8, 2.2 kPa at 6, 50, 600 /s [R:H1]: "
                    "without the card's stiffening at large strain; cut-off of water [K3]",
          .confidence = "R, K2, K3"};
}

Material gelatin_10_visco() {
  return {.name = "gelatin_10_visco",
          .eos = MieGruneisen{.rho0 = 1030, .c0 = 1520, .s = 1.8, .gamma0 = 0.17},
          .strength = Viscoelastic{PowerLawZener{.long_shear = 5e3, .branches = 1, .branch = {{{1e6, 3e-4, 0.1e6, 3}}}}},
          .density = 1030,
          .spall_pressure = -14e3,
          .specific_heat = 3700,
          .source = "density, cut-off 14 kPa: Wen 2013 via Zochowski 2019 [R:M1 2nd]; c0, s, gamma0, cp: an MPM code's card [R:G5 2nd]; power law: orders of magnitude, "
                    "long-term 3 to 10 kPa, G1 1 MPa, tau0 0.1 to 1 ms, m 2 to 4 at 0.1 MPa [K3]",
          .confidence = "R-2nd, K3"};
}

Material brain() {
  return {.name = "brain",
          .eos = wet(1040, 1550),
          .strength = Viscoelastic{BergstroemBoyce{.a = {300}, .b = {1500}, .rate = 1e-4, .stretch_power = -0.6, .base = 20, .exponent = 4}},
          .density = 1040,
          .spall_pressure = -0.1e6,
          .specific_heat = 3600,
          .source = "density, sound speed [K2]; s, gamma0 of water-like tissue [K2]; Bergstroem-Boyce after Prevost 2011: order of mu_A 0.3 kPa, mu_B 1.5 kPa, gdot0 "
                    "1e-4 /s, C -0.6, m 2 to 4 [K3]; tau_base 20 Pa assumed [K3]; cut-off of water [K3]",
          .confidence = "K2, K3"};
}

} // namespace

std::vector<Material> viscoelastic_tissues() { return {fat(), abdomen(), gelatin_10_visco(), brain()}; }

} // namespace ballast
