// Laws of a study: every combination once, errors against the reference, what ran is kept.
#include "core/error.hpp"
#include "problems/study.hpp"
#include "tests/io/temporary_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>

namespace ballast {
namespace {

TEST(Study, ReadsVariations) {
  const Variation v = parse_variation(R"(mesh.r.size+mesh.z.size=["0.5 mm","3 mm"],"1 mm", 2)");
  EXPECT_EQ(v.keys, (std::vector<std::string>{"mesh.r.size", "mesh.z.size"}));
  EXPECT_EQ(v.values, (std::vector<std::string>{R"(["0.5 mm","3 mm"])", R"("1 mm")", "2"}));
  for (const char* bad : {"mesh.refine", "=1,2", "mesh.refine=", "mesh.refine=1,,2", "mesh.refine=1,1", "a+=1"}) {
    EXPECT_THROW(parse_variation(bad), Error) << bad;
  }
}

TEST(Study, RunsEveryCombinationOnce) {
  const auto points = study_points({parse_variation("a=1,2,3"), parse_variation("b+c=x,y")}, {"d=4"});
  ASSERT_EQ(points.size(), 6);
  EXPECT_EQ(points[0].values, (std::vector<std::string>{"1", "x"}));
  EXPECT_EQ(points[1].values, (std::vector<std::string>{"1", "y"}));
  EXPECT_EQ(points[5].values, (std::vector<std::string>{"3", "y"}));
  EXPECT_EQ(points[5].settings, (std::vector<std::string>{"d=4", "a=3", "b=y", "c=y"}));
  EXPECT_EQ(points[5].name, "005_a=3_b+c=y");
}

TEST(Study, RefusesAKeyThatIsVariedTwice) {
  EXPECT_THROW(study_points({parse_variation("a=1,2"), parse_variation("b+a=3,4")}, {}), Error);
  EXPECT_THROW(study_points({parse_variation("a+a=1,2")}, {}), Error);
}

TEST(Study, CasesDifferInDeckAndKeys) {
  const StudyCase window = parse_case(R"(a window: deck=problems/m80_window.toml; mesh.refine=0.5; title="a; b")");
  EXPECT_EQ(window.name, "a window");
  EXPECT_EQ(window.deck, "problems/m80_window.toml");
  EXPECT_EQ(window.settings, (std::vector<std::string>{"mesh.refine=0.5", R"(title="a; b")"}));
  EXPECT_TRUE(parse_case("as it is").settings.empty());
  for (const char* bad : {"", ": a=1", "a=1", "x: a", "x: =1", "x: a="}) {
    EXPECT_THROW(parse_case(bad), Error) << bad;
  }
  const auto points = study_points({window, parse_case("as it is")}, {parse_variation("n=1,2")}, {"d=4"});
  ASSERT_EQ(points.size(), 4);
  EXPECT_EQ(points[1].values, (std::vector<std::string>{"a window", "2"}));
  EXPECT_EQ(points[1].settings, (std::vector<std::string>{"d=4", "mesh.refine=0.5", R"(title="a; b")", "n=2"}));
  EXPECT_EQ(points[1].deck, "problems/m80_window.toml");
  EXPECT_EQ(points[2].deck, "");
  EXPECT_EQ(points[2].name, "002_as-it-is_n=1");
  EXPECT_THROW(study_points({window, window}, {}, {}), Error);
}

TEST(Study, ErrorsAreAgainstTheReference) {
  const io::TemporaryFolder folder;
  const auto write = [&](const char* name, const char* text) { std::ofstream(folder.path() / name) << text; };
  std::filesystem::create_directories(folder.path() / "a");
  std::filesystem::create_directories(folder.path() / "b");
  write("a/history.csv", "t,energy_total [J],bullet_velocity [m/s]\n0,1,100\n1,1,80\n2,1,60\n");
  write("b/history.csv", "t,energy_total [J],bullet_velocity [m/s]\n0,1,100\n2,1,80\n");
  StudyRow a, b;
  a.ended = b.ended = "finished";
  a.results = {{"bullet.velocity_m_per_s", 60}, {"conservation.mass_relative", 1}, {"exact.L1_density", 0.01}};
  b.results = {{"bullet.velocity_m_per_s", 80}, {"conservation.mass_relative", 2}, {"exact.L1_density", 0.02}};
  measure_errors(a, folder.path() / "a", b, folder.path() / "b");
  EXPECT_DOUBLE_EQ(a.errors.at("bullet.velocity_m_per_s"), 0.25);
  EXPECT_DOUBLE_EQ(a.errors.at("L1 bullet_velocity"), 0.1);    // 0, 10, 20 by trapezoids, over 100
  EXPECT_DOUBLE_EQ(a.errors.at("Linf bullet_velocity"), 0.2);
  EXPECT_EQ(a.errors.size(), 3); // neither the ledger, nor the round-off of conservation, nor a run's own error is an answer
}

TEST(Study, FinestIsOneRunAlone) {
  auto points = study_points({parse_variation("a=1,2,3")}, {});
  points[0].cells = 10;
  points[1].cells = points[2].cells = 20;
  try {
    require_one_finest(points);
    FAIL() << "two runs have the most cells";
  } catch (const Error& e) {
    const std::string what = e.what();
    EXPECT_EQ(what.find("000_a=1"), std::string::npos) << what;
    for (const char* part : {"--reference finest", "001_a=2, 002_a=3", "allowed: "}) {
      EXPECT_NE(what.find(part), std::string::npos) << what;
    }
  }
  points[1].cells = 30;
  EXPECT_NO_THROW(require_one_finest(points));
}

TEST(Study, AFolderClaimedForARunHoldsNoOtherAnswer) {
  const io::TemporaryFolder folder;
  std::ofstream(folder.path() / "summary.json") << R"({"ended": "finished", "deck_hash": "1"})";
  claim_folder(folder.path());
  EXPECT_EQ(read_study_row(folder.path()).ended, "");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "study.json"));
}

} // namespace
} // namespace ballast
