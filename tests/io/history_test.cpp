#include "core/io/history.hpp"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "temporary_folder.hpp"

namespace ballast::io {
namespace {

const std::vector<std::string> columns{"velocity_bullet [m/s]", "energy_total [J]"};

TEST(History, ReadsBackEveryBit) {
  const TemporaryFolder folder;
  HistoryWriter writer(folder / "history.csv", columns);
  writer.add(0.1, std::vector{1.0 / 3, -0.0});
  writer.add(0.2,
             std::vector{std::nan(""), 5e-324}); // read while the writer is open: rows are flushed
  const Table table = read_csv(folder / "history.csv");
  EXPECT_EQ(table.names,
            (std::vector<std::string>{"t", "velocity_bullet [m/s]", "energy_total [J]"}));
  EXPECT_EQ(table.columns[0], (std::vector{0.1, 0.2}));
  EXPECT_EQ(table.find("velocity_bullet")->at(0), 1.0 / 3);
  EXPECT_TRUE(std::isnan(table.find("velocity_bullet [m/s]")->at(1)));
  EXPECT_TRUE(std::signbit(table.columns[2][0]));
  EXPECT_EQ(table.columns[2][1], 5e-324);
  EXPECT_EQ(table.find("dt"), nullptr);
}

TEST(History, TruncatesOnRestart) {
  const TemporaryFolder folder;
  const auto path = folder / "history.csv";
  {
    HistoryWriter writer(path, columns);
    for (int k = 0; k < 10; ++k)
      writer.add(0.1 * k, std::vector{1.0 * k, 2.0 * k});
  }
  std::ofstream(path, std::ios::app) << "0.95,1"; // the row that a killed run left
  {
    HistoryWriter writer = HistoryWriter::reopen(path, columns, 0.1 * 3); // 0.1 * 3 itself stays
    writer.add(0.35, std::vector{7.0, 8.0});
  }
  const Table table = read_csv(path);
  EXPECT_EQ(table.columns[0], (std::vector{0.0, 0.1, 0.2, 0.1 * 3, 0.35}));
  EXPECT_EQ(table.columns[1].back(), 7.0);
  EXPECT_THROW(HistoryWriter::reopen(path, {"other [m]"}, 0.1), Error);
  EXPECT_EQ(read_csv(path).columns[0].size(), 5U) << "a refused restart must not touch the file";
}

TEST(History, RefusesRowsOfAnotherLength) {
  const TemporaryFolder folder;
  HistoryWriter writer(folder / "history.csv", columns);
  EXPECT_THROW(writer.add(0, std::vector{1.0}), Error);
  std::ofstream(folder / "bad.csv") << "t,a [m]\n0,1\n1,x\n";
  EXPECT_THROW(read_csv(folder / "bad.csv"), Error);
}

} // namespace
} // namespace ballast::io
