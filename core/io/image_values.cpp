#include "core/io/image_values.hpp"

#include <algorithm>
#include <bit>
#include <fstream>
#include <zlib.h>

namespace ballast::io {
namespace {

std::string read_raw(std::ifstream& in, char* bytes, std::size_t count) {
  in.read(bytes, static_cast<std::streamsize>(count));
  const auto got = static_cast<std::size_t>(std::max<std::streamsize>(0, in.gcount()));
  return got == count ? "" : fmt::format("{} bytes of values, {} are needed", got, count);
}

std::string read_packed(std::ifstream& in, char* bytes, std::size_t count) {
  constexpr int either = 15 + 32; // the largest window; zlib or gzip, as it comes
  constexpr std::size_t most = 1 << 20;
  std::vector<char> piece(most);
  z_stream stream{};
  if (inflateInit2(&stream, either) != Z_OK) {
    return "values that cannot be unpacked";
  }
  std::size_t got = 0;
  int state = Z_OK;
  while (got < count && state == Z_OK) {
    if (stream.avail_in == 0) {
      in.read(piece.data(), static_cast<std::streamsize>(most));
      stream.avail_in = static_cast<uInt>(in.gcount());
      stream.next_in = reinterpret_cast<Bytef*>(piece.data());
      if (stream.avail_in == 0) {
        break;
      }
    }
    const std::size_t room = std::min<std::size_t>(count - got, 1U << 30);
    stream.next_out = reinterpret_cast<Bytef*>(bytes + got);
    stream.avail_out = static_cast<uInt>(room);
    state = inflate(&stream, Z_NO_FLUSH);
    got += room - stream.avail_out;
  }
  inflateEnd(&stream);
  return got == count ? "" : fmt::format("{} bytes of values once unpacked, {} are needed", got, count);
}

std::string read_text(std::ifstream& in, std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(in >> values[i])) {
      return fmt::format("{} values, {} are needed", i, values.size());
    }
  }
  return "";
}

template <class T> void read_as(const ValueSource& from, OrientedImage& image) {
  std::ifstream in(from.path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(from.skip));
  const auto good = [&](const std::string& lacking) {
    if (!lacking.empty()) {
      image.refuse(fmt::format("{} has {}", from.path, lacking), "the whole file");
    }
    return lacking.empty();
  };
  if (from.coding == ValueSource::Coding::text) {
    std::vector<double> values(image.voxels());
    if (good(read_text(in, values))) {
      take_labels(values.data(), image);
    }
    return;
  }
  std::vector<T> values(image.voxels());
  char* bytes = reinterpret_cast<char*>(values.data());
  const std::size_t count = values.size() * sizeof(T);
  if (!good(from.coding == ValueSource::Coding::raw ? read_raw(in, bytes, count) : read_packed(in, bytes, count))) {
    return;
  }
  const bool swapped = from.big_endian == (std::endian::native == std::endian::little);
  for (std::size_t i = 0; swapped && i < values.size(); ++i) {
    std::reverse(bytes + i * sizeof(T), bytes + (i + 1) * sizeof(T));
  }
  take_labels(values.data(), image);
}

} // namespace

void read_values(NumberType type, const ValueSource& from, OrientedImage& image) {
  constexpr double most = 1e10;
  if (const double voxels = static_cast<double>(image.size[0]) * static_cast<double>(image.size[1]) * static_cast<double>(image.size[2]); voxels > most) {
    return image.refuse(fmt::format("its header counts {:g} voxels", voxels), fmt::format("{:g} or fewer", most));
  }
  switch (type) {
  case NumberType::i8:
    return read_as<std::int8_t>(from, image);
  case NumberType::u8:
    return read_as<std::uint8_t>(from, image);
  case NumberType::i16:
    return read_as<std::int16_t>(from, image);
  case NumberType::u16:
    return read_as<std::uint16_t>(from, image);
  case NumberType::i32:
    return read_as<std::int32_t>(from, image);
  case NumberType::u32:
    return read_as<std::uint32_t>(from, image);
  case NumberType::i64:
    return read_as<std::int64_t>(from, image);
  case NumberType::u64:
    return read_as<std::uint64_t>(from, image);
  case NumberType::f32:
    return read_as<float>(from, image);
  case NumberType::f64:
    return read_as<double>(from, image);
  }
}

} // namespace ballast::io
