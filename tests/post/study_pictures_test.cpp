// Pictures of a study are of its last tables.
#include "post/study_pictures.hpp"
#include "tests/io/temporary_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace ballast::post {
namespace {

TEST(StudyPictures, ThoseOfAnEarlierReferenceGo) {
  const io::TemporaryFolder folder;
  std::ofstream(folder.path() / "study.json") << R"({"deck": "d.toml", "varied": [{"name": "n", "values": ["1", "2"]}], "runs": [
    {"name": "0", "values": ["1"], "ended": "finished", "wall_seconds": 1, "errors": {"L1 density": 0.2}},
    {"name": "1", "values": ["2"], "ended": "finished", "wall_seconds": 2, "errors": {"L1 density": 0.1}}]})";
  const auto pictures = folder.path() / "pictures";
  std::filesystem::create_directories(pictures);
  for (const char* name : {"front_exact_L1_density.png", "by_n_exact_L1_density.png", "mine.png"}) {
    std::ofstream(pictures / name) << "old";
  }
  std::ostringstream log;
  EXPECT_EQ(draw_study(folder.path(), log), 2);
  EXPECT_FALSE(std::filesystem::exists(pictures / "front_exact_L1_density.png"));
  EXPECT_FALSE(std::filesystem::exists(pictures / "by_n_exact_L1_density.png"));
  EXPECT_TRUE(std::filesystem::exists(pictures / "mine.png"));
  EXPECT_TRUE(std::filesystem::exists(pictures / "front_L1_density.png"));
}

} // namespace
} // namespace ballast::post
