// Outlines of solids of revolution: points in the deck or a CSV file.
#include "problems/scene_reading.hpp"

#include <fmt/format.h>
#include <fstream>

namespace ballast {
namespace {

/// Points of a CSV file "z_mm,r_mm"; `problem` says what is wrong with it.
Profile profile_from_file(const std::string& path, std::string& problem) {
  std::ifstream in(path);
  if (!in) {
    problem = fmt::format("cannot open {}", path);
    return {};
  }
  Profile profile;
  double scale = 0;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    if (line.empty() || line.front() == '#') {
      continue;
    }
    const auto comma = line.find(',');
    const std::string first = line.substr(0, comma);
    const std::string second = comma == std::string::npos ? "" : line.substr(comma + 1);
    if (scale == 0) {
      const Quantity unit = first.starts_with("z_")
                                ? parse_quantity("1 " + first.substr(2), Dimension::length)
                                : Quantity{};
      scale = unit.ok() ? unit.value : 0;
      if (scale <= 0 || second != "r_" + first.substr(2)) {
        problem = fmt::format("{}:{}: header \"{}\", wanted \"z_mm,r_mm\"", path, number, line);
        return {};
      }
      continue;
    }
    const Quantity z = parse_quantity(first, Dimension::none),
                   r = parse_quantity(second, Dimension::none);
    if (!z.ok() || !r.ok()) {
      problem = fmt::format("{}:{}: \"{}\" is not two numbers", path, number, line);
      return {};
    }
    profile.push_back({z.value * scale, r.value * scale});
  }
  return profile;
}

/// Sides of the outline, closed to the axis at both ends.
std::vector<std::array<std::array<double, 2>, 2>> sides_of(const Profile& profile) {
  std::vector<std::array<std::array<double, 2>, 2>> sides;
  sides.push_back({{{profile.front()[0], 0.0}, profile.front()}});
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    sides.push_back({profile[i], profile[i + 1]});
  }
  sides.push_back({{profile.back(), {profile.back()[0], 0.0}}});
  std::erase_if(sides, [](const auto& side) { return side[0] == side[1]; });
  return sides;
}

/// Where the outline crosses itself or runs back over itself; empty: nowhere.
std::string self_crossing(const Profile& profile) {
  using Place = std::array<double, 2>;
  const auto turn = [](const Place& a, const Place& b, const Place& p) {
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  };
  const auto apart = [](double a, double b) { return (a > 0 && b < 0) || (a < 0 && b > 0); };
  const auto sides = sides_of(profile);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto& [a, b] = sides[i];
    if (i + 1 < sides.size()) {
      const Place& c = sides[i + 1][1];
      if (turn(a, b, c) == 0 && (c[0] - b[0]) * (b[0] - a[0]) + (c[1] - b[1]) * (b[1] - a[1]) < 0) {
        return fmt::format("the outline runs back over itself at z = {:g} m, r = {:g} m", b[0], b[1]);
      }
    }
    for (std::size_t j = i + 2; j < sides.size(); ++j) {
      const auto& [p, q] = sides[j];
      const double at_p = turn(a, b, p), at_q = turn(a, b, q);
      if (apart(at_p, at_q) && apart(turn(p, q, a), turn(p, q, b))) {
        const double t = at_p / (at_p - at_q);
        return fmt::format("the outline crosses itself at z = {:g} m, r = {:g} m", p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]));
      }
    }
  }
  return "";
}

std::string profile_problem(const Profile& profile) {
  if (profile.size() < 2) {
    return fmt::format("an outline of {} points", profile.size());
  }
  const std::string crossing = self_crossing(profile);
  if (!crossing.empty()) {
    return crossing;
  }
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (profile[i][1] < 0) {
      return fmt::format("point {} has a negative radius {:g} m", i, profile[i][1]);
    }
    if (i > 0 && profile[i][0] < profile[i - 1][0]) {
      return fmt::format(
          "point {} goes back in z, {:g} m after {:g} m", i, profile[i][0], profile[i - 1][0]);
    }
  }
  return profile.back()[0] > profile.front()[0] ? "" : "an outline of no length";
}

/// Puts the points into the tree in place of the file's name: the resolved deck stands alone.
void inline_profile(DeckNode& node, const Profile& profile) {
  std::erase_if(node.fields, [](const auto& field) { return field.first == "file"; });
  DeckNode list;
  list.kind = DeckNode::Kind::array;
  for (const auto& point : profile) {
    DeckNode pair;
    pair.kind = DeckNode::Kind::array;
    for (const double value : point) {
      DeckNode number;
      number.kind = DeckNode::Kind::number;
      number.number = value;
      pair.items.push_back(number);
    }
    list.items.push_back(std::move(pair));
  }
  node.fields.emplace_back("profile", std::move(list));
}

std::optional<Profile> inline_points(Deck& deck, DeckNode& list) {
  const std::string allowed = "a list of [z, r] pairs of lengths";
  if (!list.is_array()) {
    deck.fail(list, fmt::format("{} is not wanted here", describe(list)), allowed);
    return std::nullopt;
  }
  Profile profile;
  for (DeckNode& pair : list.items) {
    if (!read_quantities(deck, pair, Dimension::length, {}, 2, 2)) {
      return std::nullopt;
    }
    profile.push_back({pair.items[0].number, pair.items[1].number});
  }
  return profile;
}

} // namespace

std::optional<Profile> read_profile(Deck& deck, const Section& in) {
  DeckNode* file = in.node("file");
  DeckNode* points = in.node("profile");
  if ((file == nullptr) == (points == nullptr)) {
    deck.fail({in.self().place,
                 in.self().key,
                 file == nullptr ? "has no outline" : "has two outlines",
                 "either `file` or `profile`"});
    return std::nullopt;
  }
  if (points != nullptr) {
    std::optional<Profile> profile = inline_points(deck, *points);
    const std::string problem = profile ? profile_problem(*profile) : "";
    if (!problem.empty()) {
      deck.fail(*points, problem, "at least two points [z, r], z never decreasing, r at least 0");
      return std::nullopt;
    }
    return profile;
  }
  std::string problem;
  Profile profile = profile_from_file(deck.resolve_path(file->text), problem);
  problem = problem.empty() ? profile_problem(profile) : problem;
  if (!problem.empty()) {
    deck.fail(*file, problem, "a CSV file with header z_mm,r_mm and z never decreasing");
    return std::nullopt;
  }
  inline_profile(in.self(), profile);
  return profile;
}

} // namespace ballast
