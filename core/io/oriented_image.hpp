// An image as its file has it, before it is put along x, y, z. Private to core/io: see label_image.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <map>
#include <string>
#include <vector>

namespace ballast::io {

struct OrientedImage {
  std::array<std::size_t, 3> size{};               ///< along the image's own axes, the first fastest
  std::array<std::array<double, 3>, 3> step{};     ///< step[a]: from a voxel to the next along axis a
  std::array<double, 3> first{};                   ///< centre of the first voxel
  std::vector<std::uint16_t> labels;
  std::string problem, cure;

  void refuse(std::string what, std::string instead) {
    if (problem.empty()) {
      problem = std::move(what);
      cure = std::move(instead);
    }
  }
  std::size_t voxels() const { return size[0] * size[1] * size[2]; }
};

/// Fills `image.labels`, or refuses the first value that is no label.
template <class T> void take_labels(const T* values, OrientedImage& image) {
  constexpr double most = 65535;
  const std::size_t n = image.voxels();
  image.labels.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto value = static_cast<double>(values[i]);
    if (!(value >= 0 && value <= most && value == std::floor(value))) {
      const std::size_t row = i / image.size[0];
      image.refuse(fmt::format("voxel ({}, {}, {}) of the file holds {:g}", i % image.size[0], row % image.size[1], row / image.size[1], value),
                   "a label image: whole numbers from 0 to 65535 (a scan in grey values has to be segmented first)");
      return;
    }
    image.labels[i] = static_cast<std::uint16_t>(value);
  }
}

/// "key = value" lines of a MetaImage header, "key: value" lines of a NRRD header, keys in lower case; `bytes`: where the
/// data begins, if they are in the same file.
struct TextHeader {
  std::map<std::string, std::string> fields;
  std::size_t bytes = 0;
  bool has(const std::string& key) const { return fields.count(key) != 0; }
  std::string text(const std::string& key) const;
};
/// Up to the line of key `last`, or to an empty line.
TextHeader read_text_header(const std::string& path, char separator, const std::string& last);
/// All numbers of a text; brackets and commas are blanks.
std::vector<double> numbers_in(const std::string& text);
std::string lower_case(std::string text);

OrientedImage read_meta_image(const std::string& path);
OrientedImage read_nrrd(const std::string& path);
OrientedImage read_nifti(const std::string& path);

} // namespace ballast::io
