#include "core/io/label_image.hpp"

#include "tests/label_files.hpp"
#include "temporary_folder.hpp"

#include <gtest/gtest.h>

namespace ballast::io {
namespace {

using namespace ballast::testing;

/// Every voxel its own label, above a byte; sides in decimals that no binary number has.
TestImage counted() {
  TestImage image{{5, 3, 4}, {0.7, 1.1, 2.3}, {-10.2, 0.4, 3}, {}};
  for (std::uint16_t i = 0; i < 60; ++i) {
    image.labels.push_back(static_cast<std::uint16_t>(250 + i));
  }
  return image;
}

void expect_same(const LabelImage& got, const TestImage& image, const std::string& what) {
  ASSERT_EQ(got.problem, "") << what;
  EXPECT_EQ(got.size, image.size) << what;
  EXPECT_EQ(got.spacing, image.spacing) << what;
  EXPECT_EQ(got.labels, image.labels) << what;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_DOUBLE_EQ(got.corner[k], image.first[k] - 0.5 * image.spacing[k]) << what;
  }
}

TEST(LabelImage, EveryFormatGivesTheSameVoxels) {
  const TemporaryFolder folder;
  const TestImage image = counted();
  const std::string raw = bytes_of(image), gz = packed(raw, folder / "scratch.gz");
  std::string text;
  for (const std::uint16_t label : image.labels) {
    text += fmt::format("{} ", label);
  }
  write_bytes(folder / "raw.bin", raw);
  write_bytes(folder / "big.bin", bytes_of(image, true));
  const std::vector<std::pair<std::string, std::string>> files = {
      {"local.mha", mha_header(image) + raw},
      {"zip.mha", mha_header(image, fmt::format("CompressedData = True\nCompressedDataSize = {}\n", deflated(raw).size())) + deflated(raw)},
      {"big.mha", mha_header(image, "BinaryDataByteOrderMSB = True\n") + bytes_of(image, true)},
      {"apart.mhd", mha_header(image, "", "raw.bin")},
      {"raw.nrrd", nrrd_header(image, "encoding: raw") + raw},
      {"gzip.nrrd", nrrd_header(image, "encoding: gzip") + gz},
      {"text.nrrd", nrrd_header(image, "encoding: text") + text},
      {"apart.nhdr", nrrd_header(image, "encoding: raw\nendian: big\ndata file: big.bin")},
      {"plain.nii", nifti_bytes(image)},
      {"packed.nii.gz", packed(nifti_bytes(image), folder / "scratch.gz")},
  };
  std::string sum;
  for (const auto& [name, bytes] : files) {
    write_bytes(folder / name, bytes);
    const LabelImage got = read_label_image((folder / name).string());
    expect_same(got, image, name);
    sum = sum.empty() ? got.checksum : sum;
    EXPECT_EQ(got.checksum, sum) << name; // what is in it, not how it is written
  }
  std::string as_text = mha_header(image);
  as_text.replace(as_text.find("True"), 4, "False");
  write_bytes(folder / "text.mha", as_text + text);
  expect_same(read_label_image((folder / "text.mha").string()), image, "text.mha");
}

/// The same block of space, stored from the other end or with its axes in another order.
TEST(LabelImage, AxesThatRunDownOrInAnotherOrderArePutAlongXYZ) {
  const TemporaryFolder folder;
  const TestImage image = counted();
  const auto label = [&](std::size_t x, std::size_t y, std::size_t z) { return image.labels[(z * 3 + y) * 5 + x]; };
  TestImage down = image; // x and y run down, as between LPS and RAS
  down.first = {image.first[0] + 4 * 0.7, image.first[1] + 2 * 1.1, image.first[2]};
  TestImage across{{4, 5, 3}, {2.3, 0.7, 1.1}, image.first, {}}; // z fastest, then x, then y
  down.labels.clear();
  for (std::size_t k = 0; k < 60; ++k) {
    down.labels.push_back(label(4 - k % 5, 2 - k / 5 % 3, k / 15));
    across.labels.push_back(label(k / 4 % 5, k / 20, k % 4));
  }
  const auto near = [&](const std::string& name, const std::string& bytes) {
    write_bytes(folder / name, bytes);
    const LabelImage got = read_label_image((folder / name).string());
    ASSERT_EQ(got.problem, "") << name;
    EXPECT_EQ(got.size, image.size) << name;
    EXPECT_EQ(got.labels, image.labels) << name;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(got.spacing[k], image.spacing[k], 1e-12) << name;
      EXPECT_NEAR(got.corner[k], image.first[k] - 0.5 * image.spacing[k], 1e-6) << name; // float32 offsets of NIfTI
    }
  };
  near("down.nrrd", nrrd_header(down, "encoding: raw", {-1, -1, 1}) + bytes_of(down));
  near("down.mha", mha_header(down, "TransformMatrix = -1 0 0 0 -1 0 0 0 1\n") + bytes_of(down));
  near("down.nii", nifti_bytes(down, {{{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}));
  near("across.mha", mha_header(across, "TransformMatrix = 0 0 1 1 0 0 0 1 0\n") + bytes_of(across));
  near("across.nii", nifti_bytes(across, {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}}));
}

TEST(LabelImage, SaysWhatIsWrongAndWhatWouldBeRight) {
  const TemporaryFolder folder;
  const TestImage image = counted();
  const std::string raw = bytes_of(image), half = raw.substr(0, raw.size() / 2), zipped = deflated(raw);
  const auto changed = [](std::string text, const std::string& from, const std::string& to) { return text.replace(text.find(from), from.size(), to); };
  const std::string negative = changed(mha_header(image), "MET_USHORT", "MET_SHORT") + std::string(118, '\0') + "\xff\xff";
  const std::string grey = changed(nrrd_header(image, "encoding: text"), "uint16", "float") + "0 1 2 3 4 5 6.5";
  std::string grey_values = grey;
  for (int i = 7; i < 60; ++i) {
    grey_values += " 0";
  }
  struct Case {
    std::string name, bytes, problem, cure;
  };
  const std::vector<Case> cases = {
      {"turned.mha", mha_header(image, "TransformMatrix = 0.8 0.6 0 -0.6 0.8 0 0 0 1\n") + raw, "turned: its axis 1 points along (0.8, 0.6, 0)", "nearest neighbour"},
      {"turned.nrrd", changed(nrrd_header(image, "encoding: raw"), "(0.7,0,0)", "(0.7,0.01,0)") + raw, "turned: its axis 1", "nearest neighbour"},
      {"turned.nii", nifti_bytes(image, {{{0.8F, -0.6F, 0}, {0.6F, 0.8F, 0}, {0, 0, 1}}}), "turned: its axis 1", "nearest neighbour"},
      {"vector.mha", mha_header(image, "ElementNumberOfChannels = 2\n") + raw + raw, "2 numbers a voxel", "one label"},
      {"vector.nrrd", changed(changed(nrrd_header(image, "encoding: raw"), "dimension: 3", "dimension: 4"), "sizes: ", "sizes: 3 ") + raw + raw + raw, "dimension is 4", "one number a voxel"},
      {"negative.mha", negative, "voxel (4, 2, 3) of the file holds -1", "0 to 65535"},
      {"grey.nrrd", grey_values, "voxel (1, 1, 0) of the file holds 6.5", "segmented"},
      {"scaled.nii", nifti_bytes(image, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 2), "scaled by 2", "scl_slope"},
      {"flat.mha", changed(mha_header(image), "NDims = 3", "NDims = 2") + raw, "NDims is 2", "NDims = 3"},
      {"unsized.mha", changed(mha_header(image), "ElementSpacing", "ElementSpocing") + raw, "how large a voxel is", "ElementSpacing"},
      {"flat.nrrd", changed(nrrd_header(image, "encoding: raw"), "(0.7,0,0)", "(0,0,0)") + raw, "axis 1 of the image has the spacing 0", "above 0"},
      {"cut.nrrd", nrrd_header(image, "encoding: raw") + half, "60 bytes of values, 120 are needed", "whole file"},
      {"cut_gz.nrrd", nrrd_header(image, "encoding: gzip") + packed(half, folder / "scratch.gz"), "60 bytes of values once unpacked", "whole file"},
      {"cut_text.nrrd", grey, "7 values, 60 are needed", "whole file"},
      {"cut.nii", nifti_bytes(image).substr(0, 400), "truncated", "whole file"},
      {"cut.mha", mha_header(image) + half, "60 bytes of values, 120 are needed", "whole file"},
      {"cut_text.mha", changed(mha_header(image), "True", "False") + "1 2 3", "3 values, 60 are needed", "whole file"},
      {"cut_zip.mha", mha_header(image, "CompressedData = True\nCompressedDataSize = 60\n") + zipped.substr(0, 30), "of values once unpacked, 120 are needed", "whole file"},
      {"broken_zip.mha", mha_header(image, fmt::format("CompressedData = True\nCompressedDataSize = {}\n", zipped.size())) + std::string(zipped.size(), 'x'), "0 bytes of values once unpacked, 120 are needed", "whole file"},
      {"alone.nhdr", nrrd_header(image, "encoding: raw\ndata file: nowhere.bin"), "nowhere.bin", "beside the header"},
      {"alone.mhd", mha_header(image, "", "nowhere.bin"), "nowhere.bin", "beside the header"},
      {"hex.nrrd", nrrd_header(image, "encoding: hex") + raw, "encoding is \"hex\"", "gzip"},
      {"not.nrrd", raw, "does not begin with NRRD", "NRRD"},
      {"not.nii", raw, "header", "whole file"},
      {"wall.vti", raw, "no known kind", ".nii.gz"},
  };
  for (const Case& c : cases) {
    write_bytes(folder / c.name, c.bytes);
    const LabelImage got = read_label_image((folder / c.name).string());
    EXPECT_NE(got.problem.find(c.problem), std::string::npos) << c.name << ": " << got.problem;
    EXPECT_NE(got.cure.find(c.cure), std::string::npos) << c.name << ": " << got.cure;
  }
  EXPECT_NE(read_label_image("/nowhere/at_all.mha").problem.find("cannot open /nowhere/at_all.mha"), std::string::npos);
}

} // namespace
} // namespace ballast::io
