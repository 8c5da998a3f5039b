// Laws of how a block's slabs are shared among threads.
#include "core/awake.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

TEST(Awake, CutsSlabsByWhatTheyCost) {
  const Grid grid(2, {80, 10, 1});
  Awake awake(grid);
  EXPECT_EQ(awake.cut(1, 2), 5); // all alike: halves
  std::vector<int> mixed(10, 0);
  mixed[8] = mixed[9] = 60; // a bullet's mixed cells at one end
  awake.weigh(grid, mixed);
  EXPECT_GE(awake.cut(1, 2), 8);
  EXPECT_EQ(awake.cut(0, 2), 0);
  for (int part = 1; part < 4; ++part) {
    EXPECT_GE(awake.cut(part, 4), awake.cut(part - 1, 4));
  }
}

} // namespace
} // namespace ballast
