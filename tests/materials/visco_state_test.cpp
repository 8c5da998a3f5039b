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
