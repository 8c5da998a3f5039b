// A deck's equations of state, strength and failure arrive in the scene as written.
#include "problems/build_scene.hpp"
#include "problems/scene_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast {
namespace {

SceneSpec scene_with(const std::string& material, const std::string& keys, const std::string& ambient = "1 atm") {
  Deck deck = Deck::parse(fmt::format(R"(
title = "one block"
geometry = "planar"
end_time = "1 us"
ambient = {{ pressure = "{}" }}
[[body]]
name = "block"
material = "{}"
shape = {{ box = {{ from = ["0 mm", "0 mm"], to = ["4 mm", "4 mm"] }} }}
[mesh]
x = {{ from = "0 mm", to = "4 mm", size = "1 mm" }}
y = {{ from = "0 mm", to = "4 mm", size = "1 mm" }}
[materials.{}]
{}
)",
                                      ambient, material, material, keys),
                          "test.toml");
  SceneSpec scene = read_scene(deck);
  EXPECT_TRUE(deck.clean()) << deck.error_report();
  return scene;
}

TEST(MaterialModels, ChargeStartsWithItsEnergyNotAtTheAmbientPressure) {
  const std::string tnt = R"(eos = "jwl"
density = 1630
jwl_A = "371.2 GPa"
jwl_B = "3.231 GPa"
R1 = 4.15
R2 = 0.95
omega = 0.3
)";
  const SceneSpec s = scene_with("tnt", tnt + "detonation_energy = \"4.29 MJ/kg\"");
  EXPECT_EQ(s.bodies[0].specific_energy, 4.29e6);
  EXPECT_NEAR(s.bodies[0].pressure, 8.4e9, 0.1e9); // w rho e = 2.1 GPa and 6.3 GPa of the exponentials
  const SceneSpec cold = scene_with("tnt", tnt);
  EXPECT_NEAR(pressure(cold.materials[0].eos, 1630, cold.bodies[0].specific_energy), 101325, 1);
}

TEST(MaterialModels, LinearBulkRestsUnderTheAmbientPressure) {
  const SceneSpec s = scene_with("liquid", "eos = \"linear_bulk\"\ndensity = 1000\nbulk_modulus = \"2.2 GPa\"", "3 atm");
  EXPECT_EQ(s.bodies[0].pressure, 3 * 101325.0);
  const Scene<2> scene = build_scene<2>(s, 1);
  EXPECT_EQ(scene.blocks[0].pressure.row(scene.blocks[0].grid.cell_row(1, 0))[1], 0); // gauge, bitwise
}

TEST(MaterialModels, LungRestsUnderTheAmbientPressureWithItsGasAtOneAtmosphere) {
  for (const char* ambient : {"0 Pa", "1 atm"}) {
    const SceneSpec s = scene_with("foamy", "eos = \"bubbly\"\ndensity = 200\ngas_fraction = 0.8\nc0 = 1540\ngamma = 1.2\nskeleton_modulus = \"9 kPa\"", ambient);
    const auto& m = std::get<Bubbly>(s.materials[0].eos);
    EXPECT_EQ(m.gas_fraction, 0.8);
    EXPECT_EQ(m.gamma, 1.2);
    EXPECT_EQ(m.skeleton_modulus, 9e3);
    EXPECT_EQ(m.gas_pressure, 101325);
    EXPECT_EQ(m.rho0, 200);
    const Scene<2> scene = build_scene<2>(s, 1);
    EXPECT_EQ(scene.blocks[0].pressure.row(scene.blocks[0].grid.cell_row(1, 0))[1], 0); // gauge, bitwise
  }
  EXPECT_EQ(std::get<Bubbly>(scene_with("lung", "density = 300\ngas_fraction = 0.7").materials[0].eos).rho0, 300);
}

TEST(MaterialModels, FoamArrivesAsWrittenAndRestsUnderTheAmbientPressure) {
  const SceneSpec s = scene_with("pad", "eos = \"p_alpha\"\ndensity = 100\nsolid_density = 1000\nbulk_modulus = \"2 GPa\"\nfoam_modulus = \"1 MPa\"\ncrush_pressure = \"0.1 MPa\"\nsolid_pressure = \"10 MPa\"");
  const auto& m = std::get<PAlpha>(s.materials[0].eos);
  EXPECT_EQ(m.rho0, 100);
  EXPECT_EQ(m.solid_density, 1000);
  EXPECT_EQ(m.K, 2e9);
  EXPECT_EQ(m.foam_modulus, 1e6);
  EXPECT_EQ(m.crush_pressure, 1e5);
  EXPECT_EQ(m.solid_pressure, 1e7);
  const Scene<2> scene = build_scene<2>(s, 1);
  EXPECT_EQ(scene.blocks[0].pressure.row(scene.blocks[0].grid.cell_row(1, 0))[1], 0); // gauge, bitwise
}

TEST(MaterialModels, RateHardeningArrivesAsWritten) {
  const auto clay = std::get<PowerLawPlastic>(
      scene_with("muscle", "strength = \"power_law_plastic\"\nshear_modulus = \"4.8 MPa\"\nflow_coefficient = \"0.24 MPa\"\nflow_strain = 0.016\nn = 0.014\nrate_constant = \"40 1/s\"\nrate_exponent = 5")
          .materials[0].strength);
  EXPECT_EQ(clay.shear_modulus, 4.8e6);
  EXPECT_EQ(clay.coefficient, 0.24e6);
  EXPECT_EQ(clay.first_strain, 0.016);
  EXPECT_EQ(clay.exponent, 0.014);
  EXPECT_EQ(clay.rate.constant, 40);
  EXPECT_EQ(clay.rate.exponent, 5);
  const auto bone = std::get<TabulatedHardening>(scene_with("cortical_bone", "yield_strains = [0, 0.2]\nyield_stresses = [\"90 MPa\", \"95 MPa\"]").materials[0].strength);
  EXPECT_EQ(bone.points, 2);
  EXPECT_EQ(hardened(bone, 0.1), 92.5e6);
  EXPECT_EQ(bone.rate.constant, 2500); // the library's
  EXPECT_FALSE(has_rate(std::get<PowerLawPlastic>(scene_with("plastilina", "n = 0.02").materials[0].strength)));
  EXPECT_NE(tissue_law(scene_with("plastilina", "strength = \"prony\"\nlong_shear = \"2 kPa\"\nbranch_shear = [\"1 kPa\"]\nbranch_time = [\"1 ms\"]").materials[0].strength), nullptr);
}

TEST(MaterialModels, SteinbergGuinanTakesTheMaterialsThermalNumbers) {
  const SceneSpec s = scene_with("lead_steinberg", "yield = \"10 MPa\"\ns3 = -1.5\nmelt_temperature = \"700 K\"\ndensity = 11000");
  const auto& m = std::get<SteinbergGuinan>(s.materials[0].strength);
  EXPECT_EQ(m.yield, 10e6);
  EXPECT_EQ(m.yield_max, 100e6);
  EXPECT_EQ(m.melt_temperature, 700);
  EXPECT_EQ(m.eos.rho0, 11000);
  EXPECT_EQ(std::get<CubicGruneisen>(s.materials[0].eos).s3, -1.5);
}

TEST(MaterialModels, FailureIsTheDecksAndGoesWithTheStrength) {
  const SceneSpec changed = scene_with("steel_4340", "D1 = 0.1\nreference_rate = 2");
  EXPECT_EQ(changed.materials[0].failure->D1, 0.1);
  EXPECT_EQ(changed.materials[0].failure->D2, 3.44);
  EXPECT_EQ(changed.materials[0].failure->reference_rate, 2);
  EXPECT_FALSE(scene_with("steel_4340", "failure = \"none\"").materials[0].failure.has_value());
  EXPECT_FALSE(scene_with("steel_4340", "strength = \"none\"").materials[0].failure.has_value());
  const SceneSpec given = scene_with("copper_ofhc", "failure = \"johnson_cook\"\nD1 = 0.54\nD2 = 4.89\nD3 = -3.03\nD4 = 0.014\nD5 = 1.12");
  EXPECT_EQ(given.materials[0].failure->melt_temperature, 1356);
}

TEST(MaterialModels, ViscoelasticLawsArriveAsWritten) {
  const auto law = [](const SceneSpec& s) { return *tissue_law(s.materials[0].strength); };
  const auto prony = std::get<Prony>(law(scene_with("muscle", "strength = \"prony\"\nlong_shear = \"2 kPa\"\nbranch_shear = [\"1 kPa\", \"3 kPa\"]\nbranch_time = [\"1 ms\", \"2 us\"]")));
  EXPECT_EQ(prony.long_shear, 2e3);
  EXPECT_EQ(prony.branches, 2u);
  EXPECT_EQ(prony.branch[1].shear, 3e3);
  EXPECT_EQ(prony.branch[1].time, 2e-6);
  const auto power = std::get<PowerLawZener>(law(scene_with("gelatin_10_visco", "branch_exponent = [4]\nbranch_time = [\"0.1 ms\"]")));
  EXPECT_EQ(power.branches, 1u);
  EXPECT_EQ(power.branch[0].exponent, 4);
  EXPECT_EQ(power.branch[0].time, 1e-4);
  EXPECT_EQ(power.branch[0].shear, 1e6); // the library's
  const auto fung = std::get<FungQlv>(law(scene_with("muscle", "strength = \"fung\"\nshear_modulus = \"2 kPa\"\nstiffening = 3\nbranch_share = [0.5]\nbranch_time = [\"1 ms\"]")));
  EXPECT_EQ(fung.shear, 2e3);
  EXPECT_EQ(fung.stiffening, 3);
  EXPECT_EQ(fung.branch[0].share, 0.5);
  const auto boyce = std::get<BergstroemBoyce>(law(scene_with("brain", "lock_stretch = 3\nflow_rate = \"2 1/s\"")));
  EXPECT_EQ(boyce.a.lock_stretch, 3);
  EXPECT_EQ(boyce.b.lock_stretch, 3);
  EXPECT_EQ(boyce.rate, 2);
  EXPECT_EQ(boyce.b.shear, 1500);
  EXPECT_EQ(tissue_law(scene_with("brain", "strength = \"none\"").materials[0].strength), nullptr);
}

} // namespace
} // namespace ballast
