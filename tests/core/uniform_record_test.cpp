// Uniform record: linear between steps, so the mean rates lose nothing.
#include "core/uniform_record.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace ballast {
namespace {

/// Steps from 0.1 to 3 intervals.
double step_of(int n) { return 1e-6 * (0.1 + 2.9 * std::abs(std::sin(n * 1.7))); }

TEST(UniformRecord, KeepsWhatIsLinearInTime) {
  UniformRecord record(1e-6, 2);
  double t = 0;
  for (int n = 0; n < 100; t += step_of(n), ++n) {
    record.add(t, std::vector<double>{2 - 3e5 * t, 7});
  }
  ASSERT_GT(record.size(), 100U);
  for (std::size_t k = 0; k < record.size(); ++k) {
    EXPECT_NEAR(record.column(0)[k], 2 - 0.3 * static_cast<double>(k), 1e-12);
    EXPECT_EQ(record.column(1)[k], 7);
  }
}

TEST(UniformRecord, MeanRatesAddUpToTheWholeChange) {
  UniformRecord record(1e-6, 1);
  double t = 0;
  for (int n = 0; n < 300; t += 0.2 * step_of(n), ++n) { // several steps an interval
    record.add(t, std::vector<double>{std::sin(3e5 * t)});
  }
  const std::vector<double> rate = rates(record.column(0), 1e-6);
  const double sum = 1e-6 * std::accumulate(rate.begin(), rate.end(), 0.0);
  EXPECT_NEAR(sum, record.column(0).back() - record.column(0).front(), 1e-13);
  EXPECT_EQ(rate.size() + 1, record.size());
  EXPECT_EQ(every(rate, 20).size(), (rate.size() + 19) / 20);
  EXPECT_EQ(every(rate, 20)[1], rate[20]);
}

TEST(UniformRecord, GoesOnFromItsMemoryBitForBit) {
  UniformRecord whole(1e-6, 1), part(1e-6, 1), again(1e-6, 1);
  double t = 0;
  for (int n = 0; n < 60; t += step_of(n), ++n) {
    const std::vector<double> value = {std::exp(-2e5 * t)};
    whole.add(t, value);
    if (n < 31) {
      part.add(t, value);
    }
    if (n == 30) {
      EXPECT_EQ(again.recall(part.memory()), part.memory().size());
    }
    if (n > 30) {
      again.add(t, value);
    }
  }
  EXPECT_EQ(again.memory(), whole.memory());
}

} // namespace
} // namespace ballast
