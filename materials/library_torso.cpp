// Tissues of the torso and their simulants. Sound speeds are measured; most strengths are orders of magnitude.
#include "materials/library_tissues.hpp"

#include <cmath>

namespace ballast {
namespace {

/// Water-like (s 1.8, gamma0 0.3), its longitudinal wave of speed `wave` at rest: K = rho wave^2 - 4/3 G.
MieGruneisen wet(double rho0, double wave, double shear) {
  return {.rho0 = rho0, .c0 = std::sqrt(wave * wave - 4.0 / 3 * shear / rho0), .s = 1.8, .gamma0 = 0.3};
}

/// Rigid mineral in it: s 1.5, gamma0 1.
MieGruneisen bony(double rho0, double wave, double shear) {
  return {.rho0 = rho0, .c0 = std::sqrt(wave * wave - 4.0 / 3 * shear / rho0), .s = 1.5, .gamma0 = 1};
}

Material skin() {
  constexpr double G = 0.33e6;
  return {.name = "skin",
          .eos = wet(1131, 1655, G),
          .strength = LinearHardening{.shear_modulus = G, .yield = 10e6},
          .density = 1131,
          .spall_pressure = -0.1e6,
          .specific_heat = 3400,
          .source = "density and sound speed: MDPI Bioengineering 2025 [R:T1]; s, gamma0 of water-like tissue [K2]; G 0.33 MPa: Manschot 1986 in the human body model "
                    "VIVA+ 50F [R:H1], at small strain: its stress of 0.284 MPa at 0.094 is 3 times stiffer; yield of the order of the tensile strength, 10 MPa [K3]; cut-off of "
                    "water [K3]; heat capacity [K2]",
          .confidence = "R, K2, K3"};
}

Material heart() {
  constexpr double G = 5e3, fast = 50e3;
  return {.name = "heart",
          .eos = wet(1097, 1586, G + fast),
          .strength = Viscoelastic{Prony{.long_shear = G, .branches = 1, .branch = {{{fast, 1e-3}}}}},
          .density = 1097,
          .spall_pressure = -0.1e6,
          .specific_heat = 3700,
          .source = "density and sound speed of myocardium: MDPI Bioengineering 2025 [R:T1]; s, gamma0 of water-like tissue [K2]; passive muscle wall without its blood: "
                    "5 kPa in the end, ten times that for the first millisecond [K3]; cut-off of water [K3]; heat capacity [K2]",
          .confidence = "R, K2, K3"};
}

Material liver() {
  constexpr double G = 1.8e3, fast = 18e3;
  return {.name = "liver",
          .eos = wet(1084, 1540, G + fast),
          .strength = Viscoelastic{Prony{.long_shear = G, .branches = 1, .branch = {{{fast, 1e-3}}}}},
          .density = 1084,
          .spall_pressure = -0.1e6,
          .specific_heat = 3500,
          .source = "density and sound speed: MDPI Bioengineering 2025 [R:T1]; s, gamma0 of water-like tissue [K2]; quasi-static G 1.8 +- 0.4 kPa (PMC6925591 [R:T3]), ten "
                    "times that for the first millisecond [K3]; it tears at 0.27 MPa and true strain 0.38 [R:T3]: not modelled; cut-off of water [K3]; heat capacity [K2]",
          .confidence = "R, K2, K3"};
}

Material lung() {
  return {.name = "lung",
          .eos = Bubbly{.rho0 = 200, .gas_fraction = 1 - 200 / 1050.0, .gamma = 1.2, .c0 = 1540, .skeleton_modulus = 9e3},
          .strength = LinearHardening{.shear_modulus = 13.5e3, .yield = 5e3, .hardening = 10e3},
          .density = 200,
          .spall_pressure = -10e3,
          .specific_heat = 3700,
          .source = "inflated, 200 kg/m3 [K1]: tissue of 1050 kg/m3, 1540 m/s [K2] with air at 1 atm; gamma 1.2 between isothermal and adiabatic, as in Axelsson & Yelverton's "
                    "chest [K1]; Rater 2013 in the human body model VIVA+ 50F: E 27 kPa at small strain [R:H1], taken with Poisson's ratio 0 [K3], levels off at 5 to 6 kPa at "
                    "strains of 0.2 to 0.3 [R:H1]; cut-off, absolute [K3]; heat capacity of the tissue [K2]",
          .confidence = "K1, R, K3"};
}

Material blood() {
  return {.name = "blood",
          .eos = wet(1060, 1570, 0),
          .density = 1060,
          .spall_pressure = -0.1e6,
          .specific_heat = 3620,
          .source = "density, sound speed, heat capacity [K1]; s, gamma0 of water-like tissue [K2]; cut-off of water [K3]; viscosity left out",
          .confidence = "K1, K2, K3"};
}

Material costal_cartilage() {
  constexpr double G = 17.5e6; // E 49 MPa, nu 0.4
  return {.name = "costal_cartilage",
          .eos = wet(1033, 1665, G),
          .strength = TabulatedHardening{.shear_modulus = G, .points = 3, .strain = {0, 0.1675, 0.33}, .stress = {4.85e6, 9e6, 10e6}},
          .density = 1033,
          .spall_pressure = -5e6,
          .specific_heat = 3500,
          .source = "density [R:T1] and middle of the sound speeds 1565 to 1770 m/s [R:T2] of cartilage; s, gamma0 of water-like tissue [K2]; human body model VIVA+ 50F: E 49 MPa, "
                    "nu 0.4, 4.85 MPa, 9 at 0.1675, 10 at 0.33 [R:H1]: its bulk modulus of 82 MPa is left for the acoustic one; cut-off of the order of the yield "
                    "stress [K3]; heat capacity [K2]",
          .confidence = "R, K2, K3"};
}

Material cortical_bone() {
  constexpr double G = 14.7e9 / 2.6; // E 14.7 GPa, nu 0.3
  return {.name = "cortical_bone",
          .eos = bony(1862, 3194, G),
          .strength = TabulatedHardening{.shear_modulus = G,
                                         .points = 3,
                                         .strain = {0, 0.0152, 0.1},
                                         .stress = {101.4e6, 139.3e6, 351e6},
                                         .rate = {.constant = 2500, .exponent = 7}},
          .density = 1862,
          .spall_pressure = -100e6,
          .specific_heat = 1300,
          .source = "density and longitudinal wave speed: MDPI Bioengineering 2025 [R:T1]; s, gamma0 [K3]; ribs and sternum of the human body model VIVA+ 50F (Iraeus 2020): E 14.7 GPa, "
                    "nu 0.3, 101.4 MPa, 139.3 at 0.0152, 351 at 0.1, Cowper-Symonds 2500 /s, 7 [R:H1]; without failure: bone breaks at plastic strains of 0.01 to 0.03 [K2]; cut-off "
                    "of the order of its tensile strength [K3]; heat capacity [K2]",
          .confidence = "R, K2, K3"};
}

Material trabecular_bone() {
  constexpr double G = 40e6 / 2.9; // E 40 MPa, nu 0.45
  return {.name = "trabecular_bone",
          .eos = bony(572, 2325, G),
          .strength = TabulatedHardening{.shear_modulus = G, .points = 3, .strain = {0, 0.05, 0.1}, .stress = {1.8e6, 3.8e6, 5e6}},
          .density = 572,
          .spall_pressure = -2e6,
          .specific_heat = 2000,
          .source = "density and wave speed: MDPI Bioengineering 2025 [R:T1]; s, gamma0 [K3]; ribs and sternum of the human body model VIVA+ 50F: E 40 MPa, nu 0.45, 1.8 MPa, 3.8 at "
                    "0.05, 5 at 0.1 [R:H1]; the two do not agree: E and nu make 152 MPa of the 3.1 GPa that the ultrasound speed takes, which here is all bulk modulus; no crushing of "
                    "pores; cut-off of the order of the yield stress [K3]; heat capacity [K2]",
          .confidence = "R, K3"};
}

Material intercostal_muscle() {
  constexpr double G = 36e3, fast = 0.36e6;
  return {.name = "intercostal_muscle",
          .eos = wet(1058, 1562, G + fast),
          .strength = Viscoelastic{Prony{.long_shear = G, .branches = 1, .branch = {{{fast, 1e-3}}}}},
          .density = 1058,
          .spall_pressure = -0.1e6,
          .specific_heat = 3600,
          .source = "density and sound speed of muscle across the fibres: MDPI Bioengineering 2025 [R:T1]; s, gamma0 of water-like tissue [K2]; Poulard & Subit 2015 in the human body "
                    "model VIVA+ 50F: 8.7 kPa at 0.081, so G 36 kPa at small strain [R:H1] [D]: without its stiffening, to 781 kPa at 0.6; ten times that for the first millisecond "
                    "[K3]; cut-off of water [K3]; heat capacity [K2]",
          .confidence = "R, D, K3"};
}

Material gelatin_20() {
  constexpr double G = 0.7e6;
  return {.name = "gelatin_20",
          .eos = MieGruneisen{.rho0 = 1060, .c0 = std::sqrt(1550.0 * 1550 - 4.0 / 3 * G / 1060), .s = 1.8, .gamma0 = 0.17},
          .strength = LinearHardening{.shear_modulus = G, .yield = 0.55e6, .hardening = 2.5e3},
          .failure = JohnsonCookFailure{.D1 = 0.9},
          .density = 1060,
          .spall_pressure = -35e3,
          .specific_heat = 3500,
          .source = "density, sound speed [K2]; s, gamma0 of the 10 % card [R:G5 2nd]; G, yield, hardening and cut-off 2.5 times those of `gelatin_10`, for 20 % is 2 to 3 times as stiff "
                    "[K2] [K3]; failure strain of the 10 % card [R:M1 2nd] [K3]; heat capacity [K2]",
          .confidence = "K2, K3"};
}

Material plastilina() {
  constexpr double E = 14.2e6, nu = 0.49, K = 0.24e6, n = 0.014;
  const double first = std::pow(E / K, 1 / (n - 1)); // where the power law meets Hooke's line: 0.0160
  return {.name = "plastilina",
          .eos = MieGruneisen{.rho0 = 1878, .c0 = 1500, .s = 1.5, .gamma0 = 0.5},
          .strength = PowerLawPlastic{.shear_modulus = E / (2 * (1 + nu)), .coefficient = K, .first_strain = first, .exponent = n},
          .density = 1878,
          .spall_pressure = -0.1e6,
          .specific_heat = 1000,
          .source = "Roma Plastilina No. 1: density, E 14.2 MPa, nu 0.49, power law 0.24 MPa (eps0 + ep)^0.014: Zochowski 2019 [R:M1 2nd], eps0 0.016 from E and the law [D]; the card has "
                    "no rate factor; bulk: c0 1500 m/s, so 4.2 GPa, s 1.5, gamma0 0.5 of oil, wax and mineral without air [K3]: the card's nu makes 0.24 GPa, softer than any "
                    "of them; cut-off, heat capacity [K3]",
          .confidence = "R-2nd, D, K3"};
}

} // namespace

std::vector<Material> torso_tissues() {
  return {skin(), heart(), liver(), lung(), blood(), costal_cartilage(), cortical_bone(), trabecular_bone(), intercostal_muscle(), gelatin_20(), plastilina()};
}

} // namespace ballast
