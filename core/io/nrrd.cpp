// NRRD files: a text header, then the values, raw, as text or compressed by gzip; or those in a file of their own.
//
// Read here and not by VTK, whose reader (9.1) takes a first axis of nine voxels or fewer for the parts of a vector, reads
// only the first slice of what is compressed, and text from the top of the header.
#include "core/io/oriented_image.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <optional>
#include <unistd.h>
#include <zlib.h>

namespace ballast::io {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::optional<Type> type_named(const std::string& name) {
  static const std::map<std::string, Type> names = {
      {"signed char", Type::i8}, {"int8", Type::i8}, {"int8_t", Type::i8},
      {"uchar", Type::u8}, {"unsigned char", Type::u8}, {"uint8", Type::u8}, {"uint8_t", Type::u8},
      {"short", Type::i16}, {"short int", Type::i16}, {"signed short", Type::i16}, {"signed short int", Type::i16}, {"int16", Type::i16}, {"int16_t", Type::i16},
      {"ushort", Type::u16}, {"unsigned short", Type::u16}, {"unsigned short int", Type::u16}, {"uint16", Type::u16}, {"uint16_t", Type::u16},
      {"int", Type::i32}, {"signed int", Type::i32}, {"int32", Type::i32}, {"int32_t", Type::i32},
      {"uint", Type::u32}, {"unsigned int", Type::u32}, {"uint32", Type::u32}, {"uint32_t", Type::u32},
      {"longlong", Type::i64}, {"long long", Type::i64}, {"long long int", Type::i64}, {"signed long long", Type::i64}, {"signed long long int", Type::i64}, {"int64", Type::i64}, {"int64_t", Type::i64},
      {"ulonglong", Type::u64}, {"unsigned long long", Type::u64}, {"unsigned long long int", Type::u64}, {"uint64", Type::u64}, {"uint64_t", Type::u64},
      {"float", Type::f32}, {"double", Type::f64}};
  const auto at = names.find(name);
  return at == names.end() ? std::nullopt : std::optional(at->second);
}

/// Where the values are.
struct Source {
  std::string path, encoding;
  std::size_t skip = 0;   ///< bytes of the header before them
  bool swapped = false;   ///< other end first than here
};

std::string read_raw(const Source& from, char* bytes, std::size_t count) {
  std::ifstream in(from.path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(from.skip));
  in.read(bytes, static_cast<std::streamsize>(count));
  const auto got = static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount()));
  return got == count ? "" : fmt::format("{} has {} bytes of values, {} are needed", from.path, got, count);
}

std::string read_gzip(const Source& from, char* bytes, std::size_t count) {
  const int file = ::open(from.path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0 || ::lseek(file, static_cast<off_t>(from.skip), SEEK_SET) < 0) {
    return fmt::format("cannot open {}", from.path);
  }
  gzFile stream = gzdopen(file, "rb");
  std::size_t got = 0;
  while (got < count) {
    const int more = gzread(stream, bytes + got, static_cast<unsigned>(std::min<std::size_t>(count - got, 1U << 30)));
    if (more <= 0) {
      break;
    }
    got += static_cast<std::size_t>(more);
  }
  gzclose(stream);
  return got == count ? "" : fmt::format("{} has {} bytes of values once unpacked, {} are needed", from.path, got, count);
}

std::string read_text(const Source& from, std::vector<double>& values) {
  std::ifstream in(from.path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(from.skip));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(in >> values[i])) {
      return fmt::format("{} has {} values, {} are needed", from.path, i, values.size());
    }
  }
  return "";
}

template <class T> void read_as(const Source& from, OrientedImage& image) {
  const char* whole = "the whole file";
  if (from.encoding != "raw" && from.encoding != "gzip" && from.encoding != "gz") {
    std::vector<double> values(image.voxels());
    image.problem = read_text(from, values);
    image.cure = whole;
    if (image.problem.empty()) {
      take_labels(values.data(), image);
    }
    return;
  }
  std::vector<T> values(image.voxels());
  char* bytes = reinterpret_cast<char*>(values.data());
  const std::size_t count = values.size() * sizeof(T);
  image.problem = from.encoding == "raw" ? read_raw(from, bytes, count) : read_gzip(from, bytes, count);
  image.cure = whole;
  if (!image.problem.empty()) {
    return;
  }
  for (std::size_t i = 0; from.swapped && i < values.size(); ++i) {
    std::reverse(bytes + i * sizeof(T), bytes + (i + 1) * sizeof(T));
  }
  take_labels(values.data(), image);
}

void read_values(Type type, const Source& from, OrientedImage& image) {
  switch (type) {
  case Type::i8:
    return read_as<std::int8_t>(from, image);
  case Type::u8:
    return read_as<std::uint8_t>(from, image);
  case Type::i16:
    return read_as<std::int16_t>(from, image);
  case Type::u16:
    return read_as<std::uint16_t>(from, image);
  case Type::i32:
    return read_as<std::int32_t>(from, image);
  case Type::u32:
    return read_as<std::uint32_t>(from, image);
  case Type::i64:
    return read_as<std::int64_t>(from, image);
  case Type::u64:
    return read_as<std::uint64_t>(from, image);
  case Type::f32:
    return read_as<float>(from, image);
  case Type::f64:
    return read_as<double>(from, image);
  }
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
    image.size[a] = static_cast<std::size_t>(std::max(0.0, sizes[a]));
    image.first[a] = origin.empty() ? 0.0 : origin[a];
    for (std::size_t k = 0; k < 3; ++k) {
      image.step[a][k] = along.size() == 9 ? along[3 * a + k] : (a == k ? spacings[a] : 0.0);
    }
  }
}

Source find_values(const std::string& path, const TextHeader& header, OrientedImage& image) {
  Source from{path, lower_case(header.text("encoding")), header.bytes, false};
  const bool little = lower_case(header.text("endian")) != "big";
  from.swapped = little != (std::endian::native == std::endian::little);
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
  constexpr const char* known[] = {"raw", "gzip", "gz", "text", "txt", "ascii"};
  if (std::none_of(std::begin(known), std::end(known), [&](const char* word) { return from.encoding == word; })) {
    image.refuse(fmt::format("its encoding is \"{}\"", from.encoding), "raw, gzip or text");
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
  const Source from = find_values(path, header, image);
  const std::optional<Type> type = type_named(lower_case(header.text("type")));
  if (!type) {
    image.refuse(fmt::format("its type is \"{}\"", header.text("type")), "whole numbers, one a voxel: uint8 or uint16");
  }
  if (image.problem.empty()) {
    read_values(*type, from, image);
  }
  return image;
}

} // namespace ballast::io
