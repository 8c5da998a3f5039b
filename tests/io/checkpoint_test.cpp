#include "core/io/checkpoint.hpp"

#include <bit>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "temporary_folder.hpp"

namespace ballast::io {
namespace {

std::vector<double> awkward_values(std::size_t count) {
  std::vector<double> values{0.0,
                             -0.0,
                             std::numeric_limits<double>::denorm_min(),
                             -std::numeric_limits<double>::infinity(),
                             std::bit_cast<double>(0x7ff8000000abcdefULL),
                             0.1,
                             std::nextafter(1.0, 2.0)};
  std::mt19937_64 bits(7);
  while (values.size() < count)
    values.push_back(std::bit_cast<double>(bits()));
  return values;
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits;
  for (double value : values)
    bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

std::string message_of(const auto& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no Error";
}

void flip_byte(const std::filesystem::path& path, std::streamoff at) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(at);
  const char byte = static_cast<char>(file.get() ^ 0x5a);
  file.seekp(at);
  file.put(byte);
}

TEST(Checkpoint, RestoresEveryBit) {
  const TemporaryFolder folder;
  const std::vector<std::size_t> sizes{7, 1023, 1024, 300'000}; // plain, compressed, several chunks
  const std::vector<std::int64_t> ints{
      std::numeric_limits<std::int64_t>::min(), -1, 0, std::numeric_limits<std::int64_t>::max()};
  CheckpointWriter writer(folder / "checkpoint.h5");
  for (std::size_t size : sizes)
    writer.put("block/ale/array" + std::to_string(size), awkward_values(size));
  writer.put("block/ale/none", std::vector<double>{});
  writer.put("ints", ints);
  writer.put("deck", "title = \"µ\"\n");
  writer.put("empty", "");
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5"))
      << "must not appear before commit()";
  writer.commit();

  const CheckpointReader reader(folder / "checkpoint.h5");
  for (std::size_t size : sizes)
    EXPECT_EQ(bits_of(reader.get_doubles("block/ale/array" + std::to_string(size))),
              bits_of(awkward_values(size)));
  EXPECT_TRUE(reader.get_doubles("block/ale/none").empty());
  EXPECT_EQ(reader.get_ints("ints"), ints);
  EXPECT_EQ(reader.get_string("deck"), "title = \"µ\"\n");
  EXPECT_EQ(reader.get_string("empty"), "");
  EXPECT_TRUE(reader.has("block/ale/none"));
  EXPECT_FALSE(reader.has("block/vest/none"));
}

TEST(Checkpoint, AbandonedWriterKeepsThePreviousFile) {
  const TemporaryFolder folder;
  CheckpointWriter first(folder / "checkpoint.h5");
  first.put("time", std::vector<double>{1.0});
  first.commit();
  {
    CheckpointWriter second(folder / "checkpoint.h5");
    second.put("time", std::vector<double>{2.0});
  }
  EXPECT_EQ(CheckpointReader(folder / "checkpoint.h5").get_doubles("time").at(0), 1.0);
  EXPECT_FALSE(std::filesystem::exists(folder / "checkpoint.h5.tmp"));
}

TEST(Checkpoint, ErrorsNameFileAndKey) {
  const TemporaryFolder folder;
  const auto path = folder / "checkpoint.h5";
  CheckpointWriter writer(path);
  writer.put("a/x", awkward_values(100'000));
  EXPECT_NE(message_of([&] { writer.put("a/x", "twice"); }).find("a/x"), std::string::npos);
  writer.commit();
  {
    const CheckpointReader reader(path);
    for (const std::string& message : {message_of([&] { (void)reader.get_doubles("a/y"); }),
                                       message_of([&] { (void)reader.get_ints("a/x"); })}) {
      EXPECT_NE(message.find("checkpoint.h5"), std::string::npos) << message;
      EXPECT_NE(message.find("Restart from another checkpoint"), std::string::npos) << message;
    }
  }
  flip_byte(path,
            static_cast<std::streamoff>(std::filesystem::file_size(path) /
                                        2)); // inside the only large array
  const std::string corrupt = message_of([&] { (void)CheckpointReader(path).get_doubles("a/x"); });
  EXPECT_NE(corrupt.find("'a/x' is corrupt"), std::string::npos) << corrupt;
  std::filesystem::resize_file(path, 5000);
  EXPECT_NE(message_of([&] { CheckpointReader reader(path); }).find("cut short"),
            std::string::npos);
  EXPECT_NE(message_of([&] { CheckpointReader reader(folder / "none.h5"); }).find("no such file"),
            std::string::npos);
}

} // namespace
} // namespace ballast::io
