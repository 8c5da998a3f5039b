// Pictures of back faces: one a stack and axis, from the profiles of the dumps that are shown.
#include "post/back_face_pictures.hpp"
#include "tests/io/temporary_folder.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace ballast::post {
namespace {

void write_profile(const std::filesystem::path& path) {
  std::ofstream(path) << "radius [m],deflection_x [m],velocity_x [m/s],deflection_y [m],velocity_y [m/s]\n0,nan,nan,nan,nan\n0.01,0.004,5,0.005,5\n0.1,0,0,0,0\n";
}

TEST(BackFacePictures, OneForEachStackAndAxis) {
  const io::TemporaryFolder folder;
  const std::vector<io::PvdEntry> times = {{0, "fields_0000.vtm"}, {1e-5, "fields_0001.vtm"}};
  std::ostringstream log;
  EXPECT_EQ(draw_back_face_pictures(folder.path(), times, "t", folder.path(), log), 0);
  write_profile(folder / "back_face_0001.csv");
  EXPECT_EQ(draw_back_face_pictures(folder.path(), times, "t", folder.path(), log), 2);
  EXPECT_TRUE(std::filesystem::exists(folder / "back_face_deflection_y.png"));
  EXPECT_EQ(draw_back_face_pictures(folder.path(), {}, "t", folder.path(), log), 0);
}

TEST(BackFacePictures, SeveralStacksKeepTheirNames) {
  const io::TemporaryFolder folder;
  for (const char* name : {"back_face_soft_vest_0000.csv", "back_face_pack_0000.csv"})
    write_profile(folder / name);
  std::ostringstream log;
  EXPECT_EQ(draw_back_face_pictures(folder.path(), {{0, "fields_0000.vtm"}}, "t", folder.path(), log), 4);
  EXPECT_TRUE(std::filesystem::exists(folder / "back_face_soft_vest_deflection_x.png"));
}

} // namespace
} // namespace ballast::post
