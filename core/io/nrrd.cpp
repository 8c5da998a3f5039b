// NRRD files: a text header, then the values, raw, as text or compressed by gzip; or those in a file of their own.
//
// Read here and not by VTK, whose reader (9.1) takes a first axis of nine voxels or fewer for the parts of a vector.
#include "core/io/image_values.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

namespace ballast::io {
namespace {

std::optional<NumberType> type_named(const std::string& name) {
  static const std::map<std::string, NumberType> names = {
      {"signed char", NumberType::i8}, {"int8", NumberType::i8}, {"int8_t", NumberType::i8},
      {"uchar", NumberType::u8}, {"unsigned char", NumberType::u8}, {"uint8", NumberType::u8}, {"uint8_t", NumberType::u8},
      {"short", NumberType::i16}, {"short int", NumberType::i16}, {"signed short", NumberType::i16}, {"signed short int", NumberType::i16}, {"int16", NumberType::i16}, {"int16_t", NumberType::i16},
      {"ushort", NumberType::u16}, {"unsigned short", NumberType::u16}, {"unsigned short int", NumberType::u16}, {"uint16", NumberType::u16}, {"uint16_t", NumberType::u16},
      {"int", NumberType::i32}, {"signed int", NumberType::i32}, {"int32", NumberType::i32}, {"int32_t", NumberType::i32},
      {"uint", NumberType::u32}, {"unsigned int", NumberType::u32}, {"uint32", NumberType::u32}, {"uint32_t", NumberType::u32},
      {"longlong", NumberType::i64}, {"long long", NumberType::i64}, {"long long int", NumberType::i64}, {"signed long long", NumberType::i64}, {"signed long long int", NumberType::i64}, {"int64", NumberType::i64}, {"int64_t", NumberType::i64},
      {"ulonglong", NumberType::u64}, {"unsigned long long", NumberType::u64}, {"unsigned long long int", NumberType::u64}, {"uint64", NumberType::u64}, {"uint64_t", NumberType::u64},
      {"float", NumberType::f32}, {"double", NumberType::f64}};
  const auto at = names.find(name);
  return at == names.end() ? std::nullopt : std::optional(at->second);
}

/// Size, steps and first voxel.
void read_frame(const TextHeader& header, OrientedImage& image) {
  const std::vector<double> sizes = numbers_in(header.text("sizes"));
  if (header.text("dimension") != "3" || sizes.size() != 3) {
    image.refuse(fmt::format("its dimension is {}, its sizes \"{}\"", header.text("dimension"), header.text("sizes")), "three axes and one number a voxel (dimension: 3)");
    return;
  }
  for (const char* key : {"axis mins", "axismins", "axis maxs", "axismaxs"}) {
    if (header.has(key)) {
      image.refuse(fmt::format("its place is given by `{}`", key), "`space origin`, the centre of the first voxel");
    }
  }
  const std::vector<double> along = numbers_in(header.text("space directions")), spacings = numbers_in(header.text("spacings")),
                            origin = numbers_in(header.text("space origin"));
  if ((along.size() != 9 && spacings.size() != 3) || (!origin.empty() && origin.size() != 3)) {
    image.refuse("its header does not say how large a voxel is, in three dimensions", "`space directions` (three vectors) or `spacings` (three numbers), and `space origin`");
    return;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    image.size[a] = static_cast<std::size_t>(std::clamp(sizes[a], 0.0, 1e6));
    image.first[a] = origin.empty() ? 0.0 : origin[a];
    for (std::size_t k = 0; k < 3; ++k) {
      image.step[a][k] = along.size() == 9 ? along[3 * a + k] : (a == k ? spacings[a] : 0.0);
    }
  }
}

ValueSource find_values(const std::string& path, const TextHeader& header, OrientedImage& image) {
  const std::string encoding = lower_case(header.text("encoding"));
  ValueSource from{path, header.bytes, ValueSource::Coding::raw, lower_case(header.text("endian")) == "big"};
  if (encoding == "gzip" || encoding == "gz") {
    from.coding = ValueSource::Coding::packed;
  } else if (encoding == "text" || encoding == "txt" || encoding == "ascii") {
    from.coding = ValueSource::Coding::text;
  } else if (encoding != "raw") {
    image.refuse(fmt::format("its encoding is \"{}\"", encoding), "raw, gzip or text");
  }
  const std::string file = header.has("data file") ? header.text("data file") : header.text("datafile");
  if (!file.empty()) {
    from.path = (std::filesystem::path(path).parent_path() / file).string();
    from.skip = 0;
    if (file.find(' ') != std::string::npos || lower_case(file) == "list" || !std::ifstream(from.path)) {
      image.refuse(fmt::format("its values are to be in \"{}\", which cannot be opened as one file", file), "the file of values beside the header, one for all");
    }
  }
  for (const char* key : {"byte skip", "byteskip", "line skip", "lineskip"}) {
    if (header.has(key) && header.text(key) != "0") {
      image.refuse(fmt::format("`{}: {}` is not read", key, header.text(key)), "a file without it");
    }
  }
  return from;
}

} // namespace

OrientedImage read_nrrd(const std::string& path) {
  OrientedImage image;
  char magic[5] = {};
  std::ifstream(path, std::ios::binary).read(magic, 4);
  if (std::strcmp(magic, "NRRD") != 0) {
    image.refuse(fmt::format("{} does not begin with NRRD", path), "a NRRD file");
    return image;
  }
  const TextHeader header = read_text_header(path, ':', "");
  read_frame(header, image);
  const ValueSource from = find_values(path, header, image);
  const std::optional<NumberType> type = type_named(lower_case(header.text("type")));
  if (!type) {
    image.refuse(fmt::format("its type is \"{}\"", header.text("type")), "whole numbers, one a voxel: uint8 or uint16");
  }
  if (image.problem.empty()) {
    read_values(*type, from, image);
  }
  return image;
}

} // namespace ballast::io
