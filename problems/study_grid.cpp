// The points of a study.
#include "problems/study.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace ballast {

namespace {

/// Splits at `separator` where no quote or bracket is open.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      quote = c == quote ? char(0) : quote;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else {
      depth += (c == '[' || c == '{') ? 1 : (c == ']' || c == '}') ? -1 : 0;
    }
    if (c == separator && depth == 0 && quote == 0) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::string trimmed(const std::string& s) {
  const auto first = s.find_first_not_of(' '), last = s.find_last_not_of(' ');
  return first == std::string::npos ? std::string() : s.substr(first, last - first + 1);
}

/// Letters that are no trouble in a folder's name.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool fine = std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string("._=+-").find(c) != std::string::npos;
    if (fine) {
      out += c;
    } else if (!out.empty() && out.back() != '-' && c != '"') {
      out += '-';
    }
  }
  constexpr std::size_t most = 80;
  return out.substr(0, most);
}

} // namespace

Variation parse_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  Variation v;
  v.name = trimmed(text.substr(0, equals));
  for (const std::string& key : split(v.name, '+')) {
    v.keys.push_back(trimmed(key));
  }
  if (equals != std::string::npos) {
    for (const std::string& value : split(text.substr(equals + 1), ',')) {
      v.values.push_back(trimmed(value));
    }
  }
  const bool empty = std::any_of(v.keys.begin(), v.keys.end(), [](const auto& s) { return s.empty(); }) ||
                     std::any_of(v.values.begin(), v.values.end(), [](const auto& s) { return s.empty(); });
  if (equals == std::string::npos || empty) {
    throw Error(fmt::format("--vary {}: not understood\n  allowed: key.path=value,value,..., for example mesh.refine=0.5,1,2", text));
  }
  for (std::size_t i = 0; i < v.values.size(); ++i) {
    if (std::find(v.values.begin(), v.values.begin() + static_cast<std::ptrdiff_t>(i), v.values[i]) != v.values.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw Error(fmt::format("--vary {}: the value {} is there twice", text, v.values[i]));
    }
  }
  return v;
}

StudyCase parse_case(const std::string& text) {
  const std::size_t colon = text.find(':');
  StudyCase out;
  out.name = trimmed(text.substr(0, colon));
  const auto refuse = [&] {
    throw Error(fmt::format("--case {}: not understood\n  allowed: \"NAME: deck=FILE; key.path=value; ...\", for example \"window: motion.policy=\\\"follow\\\"\"", text));
  };
  if (out.name.empty() || out.name.find_first_of("=;") != std::string::npos) {
    refuse();
  }
  for (const std::string& part : split(colon == std::string::npos ? std::string() : text.substr(colon + 1), ';')) {
    const std::string setting = trimmed(part);
    const std::size_t equals = setting.find('=');
    if (setting.empty()) {
      continue;
    }
    if (equals == std::string::npos || equals == 0 || equals + 1 == setting.size()) {
      refuse();
    }
    if (trimmed(setting.substr(0, equals)) == "deck") {
      out.deck = trimmed(setting.substr(equals + 1));
    } else {
      out.settings.push_back(setting);
    }
  }
  return out;
}

std::vector<StudyPoint> study_points(const std::vector<StudyCase>& cases, const std::vector<Variation>& variations, const std::vector<std::string>& settings) {
  std::vector<StudyPoint> all;
  for (const StudyCase& c : cases) {
    if (std::count_if(cases.begin(), cases.end(), [&](const StudyCase& other) { return other.name == c.name; }) > 1) {
      throw Error(fmt::format("--case {}: the name is there twice", c.name));
    }
    std::vector<std::string> with = settings;
    with.insert(with.end(), c.settings.begin(), c.settings.end());
    for (StudyPoint& point : study_points(variations, with)) {
      point.name = fmt::format("{:03}_{}{}", all.size(), plain(c.name), point.name.substr(3));
      point.values.insert(point.values.begin(), c.name);
      point.deck = c.deck;
      all.push_back(std::move(point));
    }
  }
  return all;
}

std::vector<StudyPoint> study_points(const std::vector<Variation>& variations, const std::vector<std::string>& settings) {
  constexpr std::size_t most = 10000;
  std::vector<std::string> keys;
  for (const Variation& v : variations) {
    for (const std::string& key : v.keys) {
      if (std::find(keys.begin(), keys.end(), key) != keys.end()) {
        throw Error(fmt::format("--vary: {} is varied twice", key));
      }
      keys.push_back(key);
    }
  }
  std::size_t count = 1;
  for (const Variation& v : variations) {
    count *= v.values.size();
    if (count > most) {
      throw Error(fmt::format("--vary makes more than {} runs", most));
    }
  }
  std::vector<StudyPoint> points(count);
  for (std::size_t p = 0; p < count; ++p) {
    StudyPoint& point = points[p];
    point.settings = settings;
    std::string name;
    for (std::size_t v = 0, left = count, index = p; v < variations.size(); ++v) {
      left /= variations[v].values.size();
      const std::string& value = variations[v].values[index / left];
      index %= left;
      point.values.push_back(value);
      for (const std::string& key : variations[v].keys) {
        point.settings.push_back(key + "=" + value);
      }
      name += "_" + variations[v].name + "=" + value;
    }
    point.name = fmt::format("{:03}{}", p, plain(name));
  }
  return points;
}

} // namespace ballast
