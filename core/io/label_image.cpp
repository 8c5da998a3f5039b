#include "core/io/label_image.hpp"

#include "core/io/oriented_image.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace ballast::io {
namespace {

std::string fnv1a(const LabelImage& image) {
  std::uint64_t h = 1469598103934665603ULL;
  const auto add = [&h](const auto& values) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof values[0]; ++i) {
      h = (h ^ bytes[i]) * 1099511628211ULL;
    }
  };
  add(image.size);
  add(image.corner);
  add(image.spacing);
  add(image.labels);
  return fmt::format("{:016x}", h);
}

/// Which axis of space each axis of the image runs along, and whether up it.
struct Axes {
  std::array<std::size_t, 3> along{};
  std::array<bool, 3> up{};
};

/// Refuses what does not lie along x, y, z.
Axes axes_of(OrientedImage& image) {
  constexpr double slack = 1e-4; // of a step: what float32 headers and their quaternions leave of an exact axis
  Axes axes;
  std::array<int, 3> taken{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto& step = image.step[a];
    const double length = std::hypot(step[0], step[1], step[2]);
    if (!(length > 0) || !std::isfinite(length)) {
      image.refuse(fmt::format("axis {} of the image has the spacing {:g}", a + 1, length), "spacings above 0");
      return axes;
    }
    const auto longest = std::max_element(step.begin(), step.end(), [](double p, double q) { return std::abs(p) < std::abs(q); });
    axes.along[a] = static_cast<std::size_t>(longest - step.begin());
    axes.up[a] = *longest > 0;
    ++taken[axes.along[a]];
    for (std::size_t k = 0; k < 3; ++k) {
      if ((k != axes.along[a] && std::abs(step[k]) > slack * length) || taken[k] > 1) {
        image.refuse(fmt::format("the image is turned: its axis {} points along ({:.4g}, {:.4g}, {:.4g})", a + 1, step[0] / length, step[1] / length, step[2] / length),
                     "an image along x, y, z: resample it, by nearest neighbour so that labels stay whole");
        return axes;
      }
    }
  }
  return axes;
}

/// The voxels in the order of x, y, z.
void put_along_axes(OrientedImage&& from, LabelImage& out) {
  const Axes axes = axes_of(from);
  out.problem = from.problem;
  out.cure = from.cure;
  if (!out.problem.empty()) {
    return;
  }
  std::array<std::ptrdiff_t, 3> stride{}; // in the file's order, of a step up x, y, z
  std::ptrdiff_t start = 0, next = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t k = axes.along[a];
    const auto n = static_cast<std::ptrdiff_t>(from.size[a]);
    out.size[k] = from.size[a];
    out.spacing[k] = std::abs(from.step[a][k]);
    const double lowest = axes.up[a] ? from.first[k] : from.first[k] - static_cast<double>(n - 1) * out.spacing[k];
    out.corner[k] = lowest - 0.5 * out.spacing[k];
    stride[k] = axes.up[a] ? next : -next;
    start += axes.up[a] ? 0 : (n - 1) * next;
    next *= n;
  }
  if (start == 0 && stride[0] == 1 && stride[1] == static_cast<std::ptrdiff_t>(out.size[0])) {
    out.labels = std::move(from.labels);
    return;
  }
  out.labels.reserve(from.labels.size());
  for (std::size_t z = 0; z < out.size[2]; ++z) {
    for (std::size_t y = 0; y < out.size[1]; ++y) {
      const std::ptrdiff_t row = start + static_cast<std::ptrdiff_t>(z) * stride[2] + static_cast<std::ptrdiff_t>(y) * stride[1];
      for (std::size_t x = 0; x < out.size[0]; ++x) {
        out.labels.push_back(from.labels[static_cast<std::size_t>(row + static_cast<std::ptrdiff_t>(x) * stride[0])]);
      }
    }
  }
}

OrientedImage read_any(const std::string& path) {
  const std::string name = lower_case(std::filesystem::path(path).filename().string());
  const auto ends = [&](std::string_view with) { return name.ends_with(with); };
  OrientedImage none;
  if (!std::ifstream(path)) {
    none.refuse(fmt::format("cannot open {}", path), "a file beside the deck, or its whole path");
    return none;
  }
  if (ends(".mha") || ends(".mhd")) {
    return read_meta_image(path);
  }
  if (ends(".nrrd") || ends(".nhdr")) {
    return read_nrrd(path);
  }
  if (ends(".nii") || ends(".nii.gz")) {
    return read_nifti(path);
  }
  none.refuse(fmt::format("{} is no known kind of label image", name), "a name that ends in .mha, .mhd, .nrrd, .nhdr, .nii or .nii.gz");
  return none;
}

} // namespace

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

std::string TextHeader::text(const std::string& key) const {
  const auto at = fields.find(key);
  return at == fields.end() ? std::string{} : at->second;
}

TextHeader read_text_header(const std::string& path, char separator, const std::string& last) {
  constexpr std::size_t longest = 1 << 20; // of a header; other files may have no end of line at all
  std::ifstream in(path, std::ios::binary);
  TextHeader header;
  std::string line;
  const auto trimmed = [](const std::string& s) {
    const std::size_t from = s.find_first_not_of(" \t\r"), to = s.find_last_not_of(" \t\r");
    return from == std::string::npos ? std::string{} : s.substr(from, to - from + 1);
  };
  char c = 0;
  while (header.bytes < longest && in.get(c)) {
    ++header.bytes;
    if (c != '\n') {
      line.push_back(c);
      continue;
    }
    const std::string whole = trimmed(line);
    line.clear();
    const std::size_t at = whole.find(separator);
    const std::string key = lower_case(trimmed(whole.substr(0, at)));
    if (at != std::string::npos && whole.front() != '#') {
      header.fields[key] = trimmed(whole.substr(at + 1));
    }
    if (whole.empty() || key == last) {
      break;
    }
  }
  return header;
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> out;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    double value = 0;
    const auto read = std::from_chars(at + (*at == '+' ? 1 : 0), end, value);
    if (read.ec == std::errc{}) {
      out.push_back(value);
      at = read.ptr;
    } else {
      ++at;
    }
  }
  return out;
}

LabelImage read_label_image(const std::string& path) {
  LabelImage out;
  OrientedImage image = read_any(path);
  if (image.problem.empty() && image.voxels() == 0) {
    image.refuse("the image has no voxels", "one voxel or more along every axis");
  }
  put_along_axes(std::move(image), out);
  out.checksum = out.problem.empty() ? fnv1a(out) : "";
  return out;
}

} // namespace ballast::io
