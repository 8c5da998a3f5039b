// MetaImage files: "key = value" lines, then the values, raw, as text or compressed by zlib; or those in a file of their own.
//
// Read here and not by VTK, whose reader (9.1) takes what is cut off or cannot be unpacked for an image.
#include "core/io/image_values.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

namespace ballast::io {
namespace {

std::optional<NumberType> type_named(const std::string& name) {
  static const std::map<std::string, NumberType> names = {
      {"met_char", NumberType::i8},   {"met_uchar", NumberType::u8},  {"met_short", NumberType::i16},    {"met_ushort", NumberType::u16},
      {"met_int", NumberType::i32},   {"met_uint", NumberType::u32},  {"met_long", NumberType::i32},     {"met_ulong", NumberType::u32},
      {"met_float", NumberType::f32}, {"met_double", NumberType::f64}, {"met_long_long", NumberType::i64}, {"met_ulong_long", NumberType::u64}};
  const auto at = names.find(name);
  return at == names.end() ? std::nullopt : std::optional(at->second);
}

/// Numbers of the first of `keys` that the header has.
std::vector<double> numbers_of(const TextHeader& header, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (header.has(key)) {
      return numbers_in(header.text(key));
    }
  }
  return {};
}

bool is_true(const TextHeader& header, const char* key) {
  return lower_case(header.text(key)).starts_with("t");
}

/// Size, steps and first voxel.
void read_frame(const TextHeader& header, OrientedImage& image) {
  const std::vector<double> sizes = numbers_of(header, {"dimsize"}), spacing = numbers_of(header, {"elementspacing", "elementsize"}),
                            place = numbers_of(header, {"offset", "position", "origin"}),
                            turn = numbers_of(header, {"transformmatrix", "rotation", "orientation"});
  if (header.text("ndims") != "3" || sizes.size() != 3) {
    image.refuse(header.has("ndims") ? fmt::format("its NDims is {}, its DimSize \"{}\"", header.text("ndims"), header.text("dimsize")) : "it has no header of a MetaImage",
                 "NDims = 3, DimSize (three numbers), ElementSpacing ... ElementDataFile");
    return;
  }
  if (header.has("elementnumberofchannels") && header.text("elementnumberofchannels") != "1") {
    image.refuse(fmt::format("it has {} numbers a voxel", header.text("elementnumberofchannels")), "one label a voxel");
  }
  if (spacing.size() != 3) {
    image.refuse("its header does not say how large a voxel is", "ElementSpacing, three lengths");
    return;
  }
  if ((!place.empty() && place.size() != 3) || (!turn.empty() && turn.size() != 9)) {
    image.refuse("its Offset or its TransformMatrix is not of three dimensions", "three and nine numbers");
    return;
  }
  for (std::size_t a = 0; a < 3; ++a) {
    image.size[a] = static_cast<std::size_t>(std::clamp(sizes[a], 0.0, 1e6));
    image.first[a] = place.empty() ? 0.0 : place[a];
    for (std::size_t k = 0; k < 3; ++k) {
      image.step[a][k] = spacing[a] * (turn.empty() ? (a == k ? 1.0 : 0.0) : turn[3 * a + k]);
    }
  }
}

ValueSource find_values(const std::string& path, const TextHeader& header, OrientedImage& image) {
  ValueSource from{path, header.bytes};
  const std::string file = header.text("elementdatafile");
  if (lower_case(file) != "local") {
    from.path = (std::filesystem::path(path).parent_path() / file).string();
    from.skip = 0;
    if (file.empty() || file.find(' ') != std::string::npos || lower_case(file) == "list" || !std::ifstream(from.path)) {
      image.refuse(fmt::format("its values are to be in \"{}\", which cannot be opened as one file", file), "the file of values beside the header, one for all");
    }
  }
  const std::vector<double> skip = numbers_of(header, {"headersize"});
  if (!skip.empty() && skip[0] != 0) {
    image.refuse(fmt::format("`HeaderSize = {:g}` is not read", skip[0]), "a file of values that begins with them");
  }
  using Coding = ValueSource::Coding;
  from.coding = header.has("binarydata") && !is_true(header, "binarydata") ? Coding::text : is_true(header, "compresseddata") ? Coding::packed : Coding::raw;
  from.big_endian = is_true(header, "binarydatabyteordermsb") || is_true(header, "elementbyteordermsb");
  return from;
}

} // namespace

OrientedImage read_meta_image(const std::string& path) {
  OrientedImage image;
  const TextHeader header = read_text_header(path, '=', "elementdatafile");
  read_frame(header, image);
  const ValueSource from = image.problem.empty() ? find_values(path, header, image) : ValueSource{};
  const std::optional<NumberType> type = type_named(lower_case(header.text("elementtype")));
  if (!type) {
    image.refuse(fmt::format("its ElementType is \"{}\"", header.text("elementtype")), "whole numbers, one a voxel: MET_UCHAR or MET_USHORT");
  }
  if (image.problem.empty()) {
    read_values(*type, from, image);
  }
  return image;
}

} // namespace ballast::io
