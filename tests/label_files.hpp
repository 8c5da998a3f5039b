// Small label images, written byte by byte in each format that is read.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <string>
#include <vector>
#include <zlib.h>

namespace ballast::testing {

/// Along x, y, z in mm; `first`: centre of the first voxel.
struct TestImage {
  std::array<std::size_t, 3> size{};
  std::array<double, 3> spacing{1, 1, 1}, first{};
  std::vector<std::uint16_t> labels; ///< x fastest
};

inline std::string bytes_of(const TestImage& image, bool big_endian = false) {
  std::string out;
  for (const std::uint16_t label : image.labels) {
    const auto low = static_cast<char>(label & 255), high = static_cast<char>(label >> 8);
    out += big_endian ? std::string{high, low} : std::string{low, high};
  }
  return out;
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string packed(const std::string& bytes, const std::filesystem::path& scratch) {
  gzFile file = gzopen(scratch.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  std::ifstream in(scratch, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// As a compressed MetaImage has it.
inline std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(size);
  return out;
}

/// `more`: further lines; `data`: of ElementDataFile.
inline std::string mha_header(const TestImage& i, const std::string& more = "", const std::string& data = "LOCAL") {
  return fmt::format("ObjectType = Image\nNDims = 3\nBinaryData = True\n{}Offset = {} {} {}\nElementSpacing = {} {} {}\nDimSize = {} {} {}\n"
                     "ElementType = MET_USHORT\nElementDataFile = {}\n",
                     more, i.first[0], i.first[1], i.first[2], i.spacing[0], i.spacing[1], i.spacing[2], i.size[0], i.size[1], i.size[2], data);
}

/// `lines`: encoding and whatever else; `step`: a factor of each space direction.
inline std::string nrrd_header(const TestImage& i, const std::string& lines, std::array<double, 3> step = {1, 1, 1}) {
  return fmt::format("NRRD0004\n# a comment\ntype: uint16\ndimension: 3\nspace: left-posterior-superior\nsizes: {} {} {}\n"
                     "space directions: ({},0,0) (0,{},0) (0,0,{})\nspace origin: ({},{},{})\nendian: little\n{}\n\n",
                     i.size[0], i.size[1], i.size[2], i.spacing[0] * step[0], i.spacing[1] * step[1], i.spacing[2] * step[2], i.first[0], i.first[1],
                     i.first[2], lines);
}

/// NIfTI-1 in one file, place by the sform; rows of `turn`: unit vectors of x, y, z in voxel axes.
inline std::string nifti_bytes(const TestImage& i, std::array<std::array<float, 3>, 3> turn = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, float slope = 0) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(h.data() + at, &value, sizeof value); };
  put(0, std::int32_t{348});
  put(40, std::int16_t{3});
  for (std::size_t a = 0; a < 3; ++a) {
    put(42 + 2 * a, static_cast<std::int16_t>(i.size[a]));
    put(80 + 4 * a, static_cast<float>(i.spacing[a]));
  }
  for (std::size_t a = 3; a < 7; ++a) {
    put(42 + 2 * a, std::int16_t{1});
  }
  put(70, std::int16_t{512}); // uint16
  put(72, std::int16_t{16});
  put(76, 1.0F);
  put(108, 352.0F);
  put(112, slope);
  put(254, std::int16_t{1}); // sform_code
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t a = 0; a < 3; ++a) {
      put(280 + 16 * k + 4 * a, turn[k][a] * static_cast<float>(i.spacing[a]));
    }
    put(292 + 16 * k, static_cast<float>(i.first[k]));
  }
  std::memcpy(h.data() + 344, "n+1", 4);
  return h + bytes_of(i);
}

} // namespace ballast::testing
