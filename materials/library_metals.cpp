#include "materials/library_metals.hpp"

namespace ballast {
namespace {

// Spall pressures are switches of the right magnitude, not data (docs/materials.md).

Material lead_steinberg() {
  Material m{.name = "lead_steinberg",
             .eos = CubicGruneisen{.rho0 = 11340, .c0 = 2006, .s1 = 1.429, .s2 = 0.8506, .s3 = -1.64, .gamma0 = 2.74, .b = 0.54},
             .density = 11340,
             .spall_pressure = -0.4e9,
             .specific_heat = 124,
             .melt_temperature = 760,
             .source =
                 "Steinberg 1996, UCRL-MA-106439, via Uintah SCG_Lead.xml [R-2nd]: density, c0, S1, S2, S3, gamma0, b, G0, Y0, Ymax, "
                 "beta, n, B, cp, Tm0; G'p = 1.0 from its A = 11.63 /Mbar (the card says /Pa, which cannot be) [K1]; a 2.2 [K2]; "
                 "spall -0.4 GPa [K3]",
             .confidence = "R-2nd, K1, K2, K3"};
  m.strength = SteinbergGuinan{.shear_modulus = 8.6e9,
                               .yield = 8.0e6,
                               .yield_max = 100e6,
                               .beta = 110,
                               .n = 0.52,
                               .shear_per_pressure = 1.0,
                               .thermal_softening = 1.16e-3,
                               .melt_a = 2.2,
                               .melt_temperature = 760,
                               .specific_heat = 124,
                               .eos = condensed(m.eos)};
  return m;
}

Material copper_steinberg() {
  Material m{.name = "copper_steinberg",
             .eos = MieGruneisen{.rho0 = 8930, .c0 = 3940, .s = 1.489, .gamma0 = 2.02},
             .density = 8930,
             .spall_pressure = -1.3e9,
             .specific_heat = 383,
             .melt_temperature = 1790,
             .source =
                 "OFHC, half hard: Steinberg 1996, UCRL-MA-106439, via Uintah SCG_CopperOFHC.xml [R-2nd]: all but spall; G'p = 1.35 "
                 "from its A = 2.83 /Mbar (the card says /Pa) [K1]; Gamma rho constant, its b = 0.47 not used; spall -1.3 GPa [K2]",
             .confidence = "R-2nd, K1, K2"};
  m.strength = SteinbergGuinan{.shear_modulus = 47.7e9,
                               .yield = 0.12e9,
                               .yield_max = 0.64e9,
                               .beta = 36,
                               .n = 0.45,
                               .shear_per_pressure = 1.35,
                               .thermal_softening = 3.77e-4,
                               .melt_a = 1.5,
                               .melt_temperature = 1790,
                               .specific_heat = 383,
                               .eos = condensed(m.eos)};
  return m;
}

Material steel_1006() {
  return {.name = "steel_1006",
          .eos = MieGruneisen{.rho0 = 7896, .c0 = 4569, .s = 1.49, .gamma0 = 2.17},
          .strength = JohnsonCook{.shear_modulus = 81.8e9,
                                  .A = 350e6,
                                  .B = 275e6,
                                  .n = 0.36,
                                  .C = 0.022,
                                  .m = 1.0,
                                  .melt_temperature = 1811,
                                  .specific_heat = 452},
          .failure = JohnsonCookFailure{.D1 = -0.8,
                                        .D2 = 2.1,
                                        .D3 = -0.5,
                                        .D4 = 2e-4,
                                        .D5 = 0.61,
                                        .melt_temperature = 1811,
                                        .specific_heat = 452},
          .density = 7896,
          .spall_pressure = -1.7e9,
          .specific_heat = 452,
          .melt_temperature = 1811,
          .source =
              "mild steel: Johnson & Cook 1983 (strength) and 1985 (failure), c0, s, gamma0 of iron [K1]; the same strength is given for "
              "1020 [R:C1 2nd]; spall -1.5 to -2 GPa [K2]",
          .confidence = "K1, K2"};
}

Material steel_4340() {
  return {.name = "steel_4340",
          .eos = MieGruneisen{.rho0 = 7830, .c0 = 4578, .s = 1.33, .gamma0 = 1.67},
          .strength = JohnsonCook{.shear_modulus = 77.5e9,
                                  .A = 792e6,
                                  .B = 510e6,
                                  .n = 0.26,
                                  .C = 0.014,
                                  .m = 1.03,
                                  .melt_temperature = 1793,
                                  .specific_heat = 477},
          .failure = JohnsonCookFailure{.D1 = 0.05,
                                        .D2 = 3.44,
                                        .D3 = -2.12,
                                        .D4 = 0.002,
                                        .D5 = 0.61,
                                        .melt_temperature = 1793,
                                        .specific_heat = 477},
          .density = 7830,
          .spall_pressure = -2.0e9,
          .specific_heat = 477,
          .melt_temperature = 1793,
          .source =
              "hardness Rc 30: Johnson & Cook 1983 (strength, density, heat) and 1985 (failure) [K1]; c0, s, gamma0: Steinberg 1996 for "
              "4340 Rc 38 [K2]; G from E 200 GPa, nu 0.29 [K1]; spall -2 GPa [K3]",
          .confidence = "K1, K2, K3"};
}

Material al_6061_t6() {
  return {.name = "al_6061_t6",
          .eos = MieGruneisen{.rho0 = 2703, .c0 = 5386, .s = 1.339, .gamma0 = 1.99},
          .strength = JohnsonCook{.shear_modulus = 26e9,
                                  .A = 324e6,
                                  .B = 114e6,
                                  .n = 0.42,
                                  .C = 0.002,
                                  .m = 1.34,
                                  .melt_temperature = 925,
                                  .specific_heat = 896},
          .failure = JohnsonCookFailure{.D1 = -0.77,
                                        .D2 = 1.45,
                                        .D3 = -0.47,
                                        .D4 = 0,
                                        .D5 = 1.60,
                                        .melt_temperature = 925,
                                        .specific_heat = 896},
          .density = 2703,
          .spall_pressure = -1.1e9,
          .specific_heat = 896,
          .melt_temperature = 925,
          .source =
              "Uintah Al_BU card [R:U4]: all but spall (melting 925 to 933 K); its failure strain falls to nothing at 1.35 times the "
              "equivalent stress in mean tension; spall -1.1 GPa [K2]",
          .confidence = "R, K2"};
}

Material al_2024_t351() {
  return {.name = "al_2024_t351",
          .eos = MieGruneisen{.rho0 = 2785, .c0 = 5328, .s = 1.338, .gamma0 = 2.0},
          .strength = JohnsonCook{.shear_modulus = 27.6e9,
                                  .A = 265e6,
                                  .B = 426e6,
                                  .n = 0.34,
                                  .C = 0.015,
                                  .m = 1.0,
                                  .melt_temperature = 775,
                                  .specific_heat = 875},
          .failure = JohnsonCookFailure{.D1 = 0.13,
                                        .D2 = 0.13,
                                        .D3 = -1.5,
                                        .D4 = 0.011,
                                        .D5 = 0,
                                        .melt_temperature = 775,
                                        .specific_heat = 875},
          .density = 2785,
          .spall_pressure = -1.1e9,
          .specific_heat = 875,
          .melt_temperature = 775,
          .source =
              "Johnson & Cook 1983 (strength, heat) [K1], failure as widely quoted from their 1985 work [K2]; density, c0, s, gamma0: "
              "LASL Marsh, 2024 class [K1]; G 27.6 GPa [K1]; spall as 6061 [K3]",
          .confidence = "K1, K2, K3"};
}

} // namespace

std::vector<Material> modelled_metals() {
  return {lead_steinberg(), copper_steinberg(), steel_1006(), steel_4340(), al_6061_t6(), al_2024_t351()};
}

} // namespace ballast
