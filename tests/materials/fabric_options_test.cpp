// What the options of the fabric law add, and that they add nothing where they are off.
#include "tests/materials/fabric_laws.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace ballast {
namespace {

using fabric_laws::paper;

FabricTensor at(std::size_t component, double E) {
  FabricTensor strain = {};
  strain[component] = E;
  return strain;
}

double stress(const RaftenbergFabric& law, std::size_t component, double E, FabricState& state, double rate = 0) {
  return evaluate(law, at(component, E), state, {rate, rate}).stress[component];
}
double stress(const RaftenbergFabric& law, std::size_t component, double E) {
  FabricState fresh;
  return stress(law, component, E, fresh);
}

FabricTensor random_strain(std::mt19937& random) {
  std::uniform_real_distribution<double> in_plane(-0.2, 0.6), through(-0.45, 0.1), shear(-0.1, 0.1);
  return {in_plane(random), in_plane(random), through(random), shear(random), shear(random), shear(random)};
}

void expect_same_bits(const RaftenbergFabric& law, const RaftenbergFabric& other, const FabricTensor& E, FabricState& one, FabricState& two) {
  const FabricStress a = evaluate(law, E, one), b = evaluate(other, E, two);
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(a.tangent, b.tangent);
  EXPECT_EQ(a.wave_modulus, b.wave_modulus);
  EXPECT_EQ(one.largest, two.largest);
}

TEST(FabricOptions, OffAreThePrintedLawBitForBit) {
  std::mt19937 random(1);
  const RaftenbergFabric printed = paper();
  RaftenbergFabric never = printed; // takes the path of the options, yet none can act
  never.in_plane.first_angle = never.in_plane.second_angle = never.through.first_angle = never.through.second_angle = 1e9;
  never.rate = RateFactor{};
  FabricState one, two;
  for (int i = 0; i < 2000; ++i) {
    if (i % 20 == 0) {
      one = two = {};
    }
    expect_same_bits(printed, never, random_strain(random), one, two);
  }
}

TEST(FabricOptions, ChangeNoBitWhereTheyDoNotAct) {
  std::mt19937 random(2);
  const RaftenbergFabric printed = paper();
  RaftenbergFabric secant = printed, solid = printed, coupled = printed;
  secant.secant_unloading = true;
  solid.solid = SolidHandOver{};
  coupled.coupling = 2e11;
  for (int i = 0; i < 2000; ++i) {
    FabricTensor E = random_strain(random);
    FabricState one, two;
    expect_same_bits(printed, secant, E, one, two); // first loading
    E[1] = -std::abs(E[1]);
    one = two = {};
    expect_same_bits(printed, coupled, E, one, two); // one family slack
    E = {0.2, 0.3, -0.2, 0.1, 0.1, 0};               // looser than the solid
    one = two = {};
    expect_same_bits(printed, solid, E, one, two);
  }
}

TEST(FabricOptions, RowsGiveTheBitsOfScalarCalls) {
  std::vector<FabricModel> models = {paper(), find_fabric("kevlar_hooke_wstm")->model};
  RaftenbergFabric law = paper();
  law.solid = SolidHandOver{};
  law.secant_unloading = true;
  law.rate = RateFactor{};
  law.coupling = 1e11;
  law.in_plane = awg_shear();
  models.emplace_back(law);
  constexpr int n = 37;
  for (const FabricModel& model : models) {
    std::mt19937 random(3);
    std::vector<std::vector<double>> field(19, std::vector<double>(n)); // 6 strains, 2 rates, 2 largest, 6 stresses, 3 waves
    FabricRows rows{.count = n};
    for (std::size_t k = 0; k < 6; ++k) {
      rows.strain[k] = field[k].data(), rows.stress[k] = field[10 + k].data();
    }
    for (std::size_t k = 0; k < 2; ++k) {
      rows.extension_rate[k] = field[6 + k].data(), rows.largest[k] = field[8 + k].data();
    }
    for (std::size_t k = 0; k < 3; ++k) {
      rows.wave_modulus[k] = field[16 + k].data();
    }
    std::vector<FabricState> states(n);
    for (int step = 0; step < 5; ++step) {
      std::vector<FabricStress> expected;
      for (std::size_t i = 0; i < n; ++i) {
        const FabricTensor E = random_strain(random);
        for (std::size_t k = 0; k < 6; ++k) {
          field[k][i] = E[k];
        }
        field[6][i] = 1e3 * E[0], field[7][i] = 1e4 * E[1];
        expected.push_back(std::visit([&](const auto& m) { return evaluate(m, E, states[i], {field[6][i], field[7][i]}); }, model));
      }
      evaluate(model, rows);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < 6; ++k) {
          EXPECT_EQ(field[10 + k][i], expected[i].stress[k]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_EQ(field[16 + k][i], expected[i].wave_modulus[k]);
        }
        EXPECT_EQ(field[8][i], states[i].largest[0]);
        EXPECT_EQ(field[9][i], states[i].largest[1]);
      }
    }
  }
}

TEST(FabricSolid, TakesOverContinuouslyAtItsDensity) {
  for (const TransverseForm form : {TransverseForm::a, TransverseForm::b, TransverseForm::c}) {
    RaftenbergFabric printed = paper();
    printed.form = form;
    RaftenbergFabric law = printed;
    law.solid = SolidHandOver{};
    const double stretch = law.density / 1440, handover = 0.5 * (stretch * stretch - 1);
    EXPECT_NEAR(handover, -0.352, 5e-4);
    EXPECT_EQ(stress(law, 2, handover + 1e-9), stress(printed, 2, handover + 1e-9));
    for (const double d : {1e-6, 1e-8, 1e-10}) { // S moves by its slope times d: K / stretch^3 and the curve's
      const double most = (8e9 / std::pow(stretch, 3) + 1.5e10) * d * 1.01;
      EXPECT_NEAR(stress(law, 2, handover - d), stress(printed, 2, handover), most);
      EXPECT_NEAR(stress(law, 0, 0), stress(printed, 0, 0), most);
    }
  }
}

TEST(FabricSolid, AddsThePressureOfASolidToTheTangentOfTheCurve) {
  RaftenbergFabric law = paper();
  law.solid = SolidHandOver{};
  const double start = law.density / 1440, handover = 0.5 * (start * start - 1);
  FabricState state;
  const FabricStress carried = evaluate(paper(), at(2, handover), state);
  for (const double stretch : {0.54, 0.5, 0.45, 0.4, 0.3, 0.2, 0.1}) {
    const double E = 0.5 * (stretch * stretch - 1), line = carried.stress[2] + carried.tangent[2] * (E - handover);
    const FabricTensor S = evaluate(law, at(2, E), state).stress;
    const double p = 8e9 * (start / stretch - 1); // K (rho/rho_solid - 1), uniaxial: J = stretch
    EXPECT_NEAR(S[0], -p * stretch, 1e-9 * p);    // -p J C^-1, first direction not stretched
    EXPECT_EQ(S[0], S[1]);
    EXPECT_NEAR(stretch * S[2], -p + stretch * line, 1e-9 * p); // Cauchy: F S F^T / J
  }
}

TEST(FabricSolid, KeepsTheDensityThatASolidHas) { // at the 1.7 GPa of a bullet at 823 m/s
  const auto density_at = [](const RaftenbergFabric& law, double pressure) {
    double stretch = 1;
    for (FabricState state; -stretch * stress(law, 2, 0.5 * (stretch * stretch - 1), state) < pressure;) {
      stretch -= 1e-4;
    }
    return law.density / stretch;
  };
  RaftenbergFabric law = paper();
  EXPECT_GT(density_at(law, 1.7e9), 2 * 1440) << "the printed curve lets solid Kevlar shrink to half";
  law.solid = SolidHandOver{};
  EXPECT_LT(density_at(law, 1.7e9), 1440 * (1 + 1.7 / 8));
}

TEST(FabricSolid, WaveCrossesItAtTheSoundSpeedOfTheSolid) {
  RaftenbergFabric law = paper();
  law.solid = SolidHandOver{};
  law.in_plane.modulus = law.through.modulus = 0;
  const double stretch = 0.4; // along the plane nothing but the solid: c = sqrt(K / rho_solid) in true lengths, those at rest
  FabricState state;
  const FabricStress s = evaluate(law, {-1e-9, -1e-9, 0.5 * (stretch * stretch - 1), 0, 0, 0}, state);
  EXPECT_NEAR(std::sqrt(s.wave_modulus[0] / law.density), std::sqrt(8e9 / 1440), 1e-2);
  EXPECT_GT(std::sqrt(s.wave_modulus[2] / law.density) * stretch, std::sqrt(8e9 / 1440)) << "through it the curve's tangent adds";
}

TEST(FabricSolid, StopsCrumplingInThePlane) {
  RaftenbergFabric law = paper();
  EXPECT_EQ(stress(law, 0, -0.4), 0);
  law.solid = SolidHandOver{};
  EXPECT_LT(stress(law, 0, -0.4), -1e8) << "J 0.447 is denser than the solid";
  EXPECT_EQ(stress(law, 0, -0.3), 0) << "J 0.632 is not";
}

TEST(FabricShear, AwgCurveLocks) {
  RaftenbergFabric law = paper();
  law.in_plane = awg_shear();
  EXPECT_NEAR(stress(law, 3, 0.1), 4.14e6 * 0.2, 1e-6);
  EXPECT_NEAR(stress(law, 3, -0.15), -(4.14e6 * 0.25 + 41.4e6 * 0.05), 1e-6);
  EXPECT_NEAR(stress(law, 3, 0.2), 4.14e6 * 0.25 + 41.4e6 * 0.1 + 345e6 * 0.05, 1e-6);
  EXPECT_NEAR(stress(law, 3, 0.125 + 1e-12), stress(law, 3, 0.125), 1); // continuous
  EXPECT_EQ(stress(law, 4, 0.2), 2 * 50e9 * 0.2) << "the other planes keep theirs";
}

TEST(FabricSecant, UnloadsTowardsTheOriginBelowTheCurve) {
  RaftenbergFabric law = paper();
  law.secant_unloading = true;
  for (std::size_t k = 0; k < 2; ++k) {
    FabricState state;
    const double top = stress(law, k, 0.3, state);
    EXPECT_EQ(top, stress(paper(), k, 0.3));
    for (const double E : {0.29, 0.2, 0.12, 0.05, 0.01, 0.001}) {
      const double secant = top / 0.3 * E, curve = stress(paper(), k, E);
      EXPECT_EQ(stress(law, k, E, state), std::min(secant, curve)) << k << ' ' << E;
    }
    EXPECT_EQ(stress(law, k, 0.3, state), top) << "reloads to where it left";
    EXPECT_EQ(stress(law, k, 0.4, state), stress(paper(), k, 0.4)) << "and on along the ramp";
  }
}

/// Work on one component along a path, trapezoids of `steps` a leg; ends at zero strain.
double work_of_path(const RaftenbergFabric& law, std::size_t k, const std::vector<double>& turns, int steps, double speed) {
  FabricState state;
  double work = 0, strain = 0, before = 0;
  for (const double turn : turns) {
    const double from = strain;
    for (int i = 1; i <= steps; ++i) {
      const double E = from + (turn - from) * i / steps;
      const double S = stress(law, k, E, state, turn > from ? speed : -speed);
      work += 0.5 * (S + before) * (E - strain);
      strain = E, before = S;
    }
  }
  return work;
}

TEST(FabricSecant, EveryClosedCycleLosesEnergy) {
  RaftenbergFabric law = paper();
  law.secant_unloading = true;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> turn(0, 0.6);
  for (std::size_t k = 0; k < 2; ++k) {
    for (int trial = 0; trial < 200; ++trial) {
      const std::vector<double> turns = {turn(random), turn(random), turn(random), turn(random), 0};
      const double largest = *std::max_element(turns.begin(), turns.end());
      const double work = work_of_path(law, k, turns, 4000, 0);
      EXPECT_GT(work, -100) << k << ": of 1e8 J/m3, the trapezoids' error";
      if (largest > 0.2) {
        EXPECT_GT(work, 1e6) << "past rupture the loss is large";
      }
    }
    // Each further cycle of the same element loses too: the stored energy at each strain only falls.
    double lost = 0;
    for (const double top : {0.1, 0.1329, 0.1331, 0.15, 0.151, 0.2, 0.3, 0.5, 0.56}) {
      std::vector<double> turns;
      for (const double t : {0.1, 0.1329, 0.1331, 0.15, 0.151, 0.2, 0.3, 0.5, 0.56}) {
        if (t <= top) {
          turns.insert(turns.end(), {t, 0.0});
        }
      }
      const double work = work_of_path(law, k, turns, 4000, 0);
      EXPECT_GT(work, lost - 200) << top;
      lost = work;
    }
  }
}

TEST(FabricSecant, BareSecantWouldGiveEnergyAway) { // why the lower of curve and secant is taken
  const YarnFamily warp = paper().warp;
  EXPECT_GT(0.5 * stress(paper(), 0, warp.rupture) * warp.rupture, strain_energy(warp, warp.rupture));
}

TEST(FabricRamp, ShorterRampTakesItsShareOfEnergy) {
  RaftenbergFabric law = paper();
  law.warp.unload = 0.02;
  const double in_ramp = strain_energy(law.warp, 1) - strain_energy(law.warp, law.warp.rupture);
  EXPECT_NEAR(in_ramp, 0.5 * stress(law, 0, law.warp.rupture) * 0.02, 1e-6 * in_ramp);
  EXPECT_EQ(stress(law, 0, 0.16), 0);
  FabricState state;
  (void)stress(law, 0, 0.16, state);
  EXPECT_TRUE(is_lost(law.warp, state.largest[0]));
}

TEST(FabricRate, RaisesStressOfExtensionOnlyAndLosesEnergy) {
  RaftenbergFabric law = paper();
  law.rate = RateFactor{};
  for (std::size_t k = 0; k < 2; ++k) {
    FabricState state;
    const double slow = stress(paper(), k, 0.08);
    EXPECT_NEAR(stress(law, k, 0.08, state, 1e3), slow * (1 + 0.02 * std::log(1e3)), 1e-9 * slow);
    EXPECT_EQ(stress(law, k, 0.08, state, 0.5), slow) << "below the reference rate";
    EXPECT_EQ(stress(law, k, 0.08, state, -1e3), slow) << "unloading";
    EXPECT_NEAR(stress(law, k, 0.08, state, 1 + 1e-9), slow, 1e-9 * slow) << "continuous at the reference";
    EXPECT_GT(work_of_path(law, k, {0.1, 0.02, 0.12, 0}, 1000, 1e3), 1e6);
  }
}

TEST(FabricCoupling, IsSymmetricAndLeavesUniaxialTestsAlone) {
  RaftenbergFabric law = paper();
  law.coupling = 2e11;
  FabricState state;
  for (const double E : {0.02, 0.1, 0.14, 0.3}) {
    EXPECT_EQ(stress(law, 0, E), stress(paper(), 0, E));
    EXPECT_EQ(stress(law, 1, E), stress(paper(), 1, E));
  }
  // d S11/d E22 = d S22/d E11: a potential.
  const double d = 1e-6;
  const auto along = [&](std::size_t k, double w, double f) {
    FabricState fresh;
    return evaluate(law, {w, f, 0, 0, 0, 0}, fresh).stress[k];
  };
  for (const auto& [w, f] : {std::pair{0.03, 0.05}, {0.1, 0.02}, {0.05, 0.14}}) {
    const double one = (along(0, w, f + d) - along(0, w, f - d)) / (2 * d), two = (along(1, w + d, f) - along(1, w - d, f)) / (2 * d);
    EXPECT_GT(one, 1e6);
    EXPECT_NEAR(one / two, 1, 1e-5);
  }
  EXPECT_NEAR(along(0, 0.05, 1e-9), stress(paper(), 0, 0.05), 1) << "grows from nothing";
  (void)evaluate(law, {0, 0.56, 0, 0, 0, 0}, state);
  EXPECT_EQ(evaluate(law, {0.05, 0.05, 0, 0, 0, 0}, state).stress[0], stress(paper(), 0, 0.05)) << "gone with the fill";
}

} // namespace
} // namespace ballast
