// summary.json: its errors of conservation say all that the energies lack.
#include "problems/run_session.hpp"
#include "tests/io/temporary_folder.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ballast {
namespace {

nlohmann::json summary_of(const char* energy_return) {
  const io::TemporaryFolder folder;
  const ReadScene read = read_scene(BALLAST_SOURCE_DIR "/problems/sod.toml", {"mesh.x.cells=20", std::string("numerics.energy_return=") + energy_return});
  EXPECT_EQ(RunSession<2>(read, folder.path() / "run", 1, "", {}).run(), 0);
  std::ifstream in(folder.path() / "run" / "summary.json");
  return nlohmann::json::parse(in);
}

TEST(Summary, WhatTheRemapLostStandsBesideTheLedgersError) {
  const nlohmann::json off = summary_of("off"), on = summary_of("on");
  const double start = off["energy_J"]["start"], loss = off["energy_J"]["remap_kinetic_loss"];
  const double end = off["energy_J"]["end_total"], said = off["conservation_errors"]["remap_loss_not_returned_relative"];
  EXPECT_GT(said, 1e-4);
  EXPECT_DOUBLE_EQ(said, loss / start);
  EXPECT_NEAR(said, (start - end) / start, 1e-12); // closed walls: nothing else is missing
  EXPECT_LT(std::abs(off["conservation_errors"]["energy_relative"].get<double>()), 1e-12);
  EXPECT_LT(std::abs(on["conservation_errors"]["remap_loss_not_returned_relative"].get<double>()), 1e-12);
}

} // namespace
} // namespace ballast
