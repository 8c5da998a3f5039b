#include "problems/stl_file.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace ballast {
namespace {

static_assert(std::endian::native == std::endian::little, "STL floats are read as they lie");

constexpr std::size_t header_bytes = 84, facet_bytes = 50;

std::string fnv1a(const std::string& bytes) {
  std::uint64_t h = 1469598103934665603ULL;
  for (const char c : bytes) {
    h = (h ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  }
  return fmt::format("{:016x}", h);
}

/// Facets a binary file of these bytes says it has.
std::size_t stated_count(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header_bytes) {
    std::memcpy(&count, bytes.data() + 80, sizeof count);
  }
  return count;
}

/// The shortest decimal number that rounds to this float.
double decimal(float value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value);
  double out = value;
  std::from_chars(text, end.ptr, out);
  return out;
}

void read_binary(const std::string& bytes, double scale, StlFile& out) {
  out.facets.resize(stated_count(bytes));
  for (std::size_t i = 0; i < out.facets.size(); ++i) {
    const char* at = bytes.data() + header_bytes + i * facet_bytes + 12; // behind the normal
    for (Point& p : out.facets[i]) {
      for (double& x : p) {
        float value = 0;
        std::memcpy(&value, at, sizeof value);
        at += sizeof value;
        if (!std::isfinite(value)) {
          out.problem = fmt::format("facet {} has a coordinate that is no number", i + 1);
          return;
        }
        x = decimal(value) * scale;
      }
    }
  }
}

/// Words of one line, in lower case.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  bool inside = false;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r';
    if (!blank && !inside) {
      words.emplace_back();
    }
    if (!blank) {
      words.back().push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
    }
    inside = !blank;
  }
  return words;
}

bool read_number(const std::string& word, double& value) {
  const char* from = word.data() + (!word.empty() && word.front() == '+' ? 1 : 0);
  const auto end = std::from_chars(from, word.data() + word.size(), value);
  return end.ec == std::errc{} && end.ptr == word.data() + word.size() && std::isfinite(value);
}

/// Facets of a text file, line by line.
class TextReader {
public:
  TextReader(double scale, StlFile& out) : scale_(scale), out_(out) {}

  /// What is wrong with this line; empty: nothing.
  std::string take(const std::vector<std::string>& words) {
    const std::string& first = words.front();
    if (first == "vertex") {
      return take_vertex(words);
    }
    if (first == "facet") {
      corners_ = 0;
      open_ = true;
      return "";
    }
    if (first == "endfacet") {
      const bool three = open_ && corners_ == 3;
      open_ = false;
      if (!three) {
        return fmt::format("a facet of {} vertices", corners_);
      }
      out_.facets.push_back(facet_);
      return "";
    }
    ended_ = first == "endsolid";
    const bool known = ended_ || first == "solid" || first == "outer" || first == "endloop";
    return known ? "" : fmt::format("\"{}\" is no word of an STL file", first);
  }
  std::string end() const { return ended_ ? "" : "the file breaks off before `endsolid`"; }

private:
  std::string take_vertex(const std::vector<std::string>& words) {
    if (!open_ || corners_ == 3 || words.size() != 4) {
      return words.size() != 4 ? "a vertex has three coordinates" : "a vertex too many";
    }
    for (std::size_t k = 0; k < 3; ++k) {
      double x = 0;
      if (!read_number(words[k + 1], x)) {
        return fmt::format("\"{}\" is not a number", words[k + 1]);
      }
      facet_[corners_][k] = x * scale_;
    }
    ++corners_;
    return "";
  }

  double scale_;
  StlFile& out_;
  Facet facet_{};
  std::size_t corners_ = 0;
  bool open_ = false, ended_ = false;
};

void read_text(const std::string& bytes, double scale, StlFile& out) {
  TextReader reader(scale, out);
  int number = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    const std::vector<std::string> words = words_of(bytes.substr(at, end - at));
    ++number;
    at = end + 1;
    const std::string wrong = words.empty() ? "" : reader.take(words);
    if (!wrong.empty()) {
      out.problem = fmt::format("line {}: {}", number, wrong);
      return;
    }
  }
  out.problem = reader.end();
}

} // namespace

StlFile read_stl(const std::string& path, double scale) {
  StlFile out;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    out.problem = fmt::format("cannot open {}", path);
    return out;
  }
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  out.checksum = fnv1a(bytes);
  const std::size_t count = stated_count(bytes);
  if (bytes.size() >= header_bytes && bytes.size() == header_bytes + facet_bytes * count) {
    read_binary(bytes, scale, out);
  } else if (bytes.starts_with("solid")) {
    read_text(bytes, scale, out);
  } else {
    out.problem = fmt::format("neither text (`solid ...`) nor binary: the header counts {} facets, {} bytes; the file has {}",
                              count, header_bytes + facet_bytes * count, bytes.size());
  }
  return out;
}

} // namespace ballast
