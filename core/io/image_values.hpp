// The numbers of an image, from the file that has them. Private to core/io: see label_image.
#pragma once

#include "core/io/oriented_image.hpp"

namespace ballast::io {

enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

struct ValueSource {
  enum class Coding { raw, packed, text }; ///< packed: a zlib or gzip stream
  std::string path;
  std::size_t skip = 0; ///< bytes before the first value
  Coding coding = Coding::raw;
  bool big_endian = false;
};

/// Fills the labels of an image whose size is known, or says what is missing.
void read_values(NumberType type, const ValueSource& from, OrientedImage& image);

} // namespace ballast::io
