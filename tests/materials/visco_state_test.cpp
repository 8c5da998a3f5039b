// What every viscoelastic law promises to those who carry its state.
#include "visco_points.hpp"

#include "materials/visco.hpp"

#include <set>

namespace ballast {
namespace {

std::vector<TissueLaw> laws() {
  return {Prony{1e4, 2, {{{1e5, 1e-6}, {1e4, 1e-4}}}}, FungQlv{1e5, 5, 1, {{{0.5, 1e-4}}}}, gelatin_power_law(), elastomer_boyce()};
}

TEST(TissueLaw, StateIsDeclaredAndNamed) {
  for (const TissueLaw& law : laws()) {
    const auto names = state_names(law);
    EXPECT_EQ(names.size(), state_count(law));
    EXPECT_LE(names.size(), most_visco_state);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  }
}

TEST(TissueLaw, RestStaysAtRest) {
  for (const TissueLaw& law : laws()) {
    TissueIntegrator by(by_path(BranchPath::mixed));
    Points p(law, 3);
    const auto before = p.state;
    for (std::size_t i = 0; i < 3; ++i) {
      p.move(i, Mat{}, 1e-3);
    }
    ASSERT_FALSE(advance(law, by, p.row));
    EXPECT_EQ(p.state, before) << law.index();
    EXPECT_EQ(norm(p.stress_of(1)), 0);
    EXPECT_EQ(p.stored[1], 0);
    EXPECT_EQ(p.dissipated[1], 0);
  }
}

/// Free energy of the mean of two strained cells less the mean of theirs, over the latter.
double gained_by_mixing(const TissueLaw& law, const std::array<Mat, 2>& first, double time, const std::array<Mat, 2>& second) {
  TissueIntegrator by(by_path(BranchPath::mixed));
  Points p(law, 3);
  const auto step = [&](const std::array<Mat, 2>& motion, double dt) {
    for (std::size_t i = 0; i < 2; ++i) {
      p.move(i, motion[i], dt);
    }
    p.move(2, Mat{}, dt);
    EXPECT_FALSE(advance(law, by, p.row));
  };
  step(first, time);
  step(second, 1e-12);
  const double parts = 0.5 * (p.stored[0] + p.stored[1]);
  for (auto& row : p.state) {
    row[2] = 0.5 * (row[0] + row[1]);
  }
  step({}, 1e-30);
  return p.stored[2] / parts - 1;
}

TEST(TissueLaw, AMixtureHoldsLessThanItsPartsButForFungs) {
  for (std::size_t n = 0; n < 4; ++n) {
    for (int k = 0; k < 60 && n != 1; ++k) { // Prony, power law, Bergstroem-Boyce
      const auto motion = [&](int seed, double size) {
        return without_trace({size * std::sin(seed), size * std::cos(2 * seed), 0, size * std::cos(3 * seed), size * std::sin(5 * seed), 0, 0, 0, 0});
      };
      EXPECT_LT(gained_by_mixing(laws()[n], {motion(7 * k + 1, 0.4), motion(7 * k + 2, 0.4)}, 1e-4, {motion(7 * k + 3, 0.4), motion(7 * k + 4, 0.4)}), 1e-12) << n;
    }
  }
  // Fung's: branches that have come to rest at large strains, pulled back to small ones on either side of none.
  const auto pulled = [](double e) { return Mat{e, 0, 0, 0, -0.5 * e, 0, 0, 0, -0.5 * e}; };
  EXPECT_GT(gained_by_mixing(laws()[1], {pulled(0.6), pulled(0.2)}, 1, {pulled(-0.3), pulled(-0.5)}), 0.5);
  EXPECT_LT(gained_by_mixing(laws()[1], {pulled(0.4), pulled(-0.4)}, 1e-6, {pulled(0), pulled(0)}), -0.9);
}

TEST(TissueLaw, FirstMotionMeetsTheInstantModulus) {
  for (const TissueLaw& law : laws()) {
    TissueIntegrator by(by_path(BranchPath::mixed));
    Points p(law, 1);
    p.move(0, {0, 1e-6, 0, 1e-6, 0, 0, 0, 0, 0}, 1e-15);
    ASSERT_FALSE(advance(law, by, p.row));
    EXPECT_NEAR(p.stress[3][0] / (2e-6 * instant_shear(law)), 1, 1e-6) << law.index();
  }
}

TEST(TissueLaw, VolumeChangeAloneGivesNoDeviator) {
  for (const TissueLaw& law : laws()) {
    TissueIntegrator by(by_path(BranchPath::mixed));
    Points p(law, 1);
    p.ratio[0] = 0.9;
    p.move(0, {-0.035, 0, 0, 0, -0.035, 0, 0, 0, -0.035}, 1e-6);
    ASSERT_FALSE(advance(law, by, p.row));
    EXPECT_LT(norm(p.stress_of(0)), 1e-9) << law.index();
    p.move(0, {0, 0.02, 0, 0.02, 0, 0, 0, 0, 0}, 1e-9);
    ASSERT_FALSE(advance(law, by, p.row));
    EXPECT_NEAR(p.stress[3][0] * 0.9 / (0.04 * instant_shear(law)), 1, 0.02) << law.index(); // Cauchy = Kirchhoff / J
  }
}

} // namespace
} // namespace ballast
