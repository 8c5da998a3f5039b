// Scenes of injury measures that tests share, and what their runs say.
#pragma once

#include "problems/run_session.hpp"
#include "problems/scene_reader.hpp"
#include "tests/io/temporary_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ballast::injury_scenes {

using nlohmann::json;
using Path = std::filesystem::path;

/// A block of water that flies along z, watched at its middle.
inline constexpr const char* flight = R"(
title = "flight"
geometry = "axisymmetric"
end_time = "100 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "block"
material = "water"
velocity = ["0 m/s", "30 m/s"]
shape = { box = { from = ["0 mm", "0 mm"], to = ["10 mm", "20 mm"] } }
[mesh]
r = { from = "0 mm", to = "10 mm", cells = 2 }
z = { from = "0 mm", to = "20 mm", cells = 4 }
[motion]
policy = "lagrangian"
[[gauge]]
name = "middle"
at = ["2 mm", "11 mm"]
rides = true
[injury]
sternum = "middle"
chest_depth = "236 mm"
back_face = "middle"
filters = ["CFC1000", "CFC600"]
organs = ["water"]
force_on = ["water"]
impactor = ["block"]
body_mass = "64 kg"
)";

/// A ball of lead that meets muscle; sternum in front, spine behind.
inline constexpr const char* ball = R"(
title = "ball"
geometry = "axisymmetric"
end_time = "12 us"
ambient = { pressure = "0 Pa" }
[[body]]
name = "ball"
material = "lead"
shape = { sphere = { centre = ["0 mm", "-3.5 mm"], radius = "3 mm" } }
velocity = ["0 m/s", "200 m/s"]
[[body]]
name = "tissue"
material = "muscle"
shape = { box = { from = ["0 mm", "0 mm"], to = ["12 mm", "14 mm"] } }
[mesh]
r = { from = "0 mm", to = "14 mm", size = "1 mm" }
z = { from = "-8 mm", to = "16 mm", size = "1 mm" }
[results]
bullet = ["ball"]
[[gauge]]
name = "sternum"
at = ["0.5 mm", "1.5 mm"]
rides = true
[[gauge]]
name = "spine"
at = ["0.5 mm", "12.5 mm"]
rides = true
[injury]
sternum = "sternum"
spine = "spine"
chest_depth = "14 mm"
back_face = "sternum"
blast_gauges = ["sternum", "spine"]
accelerometers = ["sternum", "spine"]
record_every = "0.25 us"
sample_every = "2 us"
organs = ["muscle"]
force_on = ["muscle"]
impactor_energy = "20 J"
impactor_diameter = "20 mm"
)";

/// The block as a quarter in space, between planes of symmetry.
inline std::string quarter() {
  std::string text = flight;
  const auto change = [&](const std::string& from, const std::string& to) { text.replace(text.find(from), from.size(), to); };
  change("axisymmetric", "3d");
  change(R"(velocity = ["0 m/s", "30 m/s"])", R"(velocity = [0, 0, "30 m/s"])");
  change(R"(from = ["0 mm", "0 mm"], to = ["10 mm", "20 mm"])", R"(from = [0, 0, 0], to = ["10 mm", "10 mm", "20 mm"])");
  change("r = {", "y = { from = \"0 mm\", to = \"10 mm\", cells = 2, lower = \"symmetry\" }\nx = { lower = \"symmetry\", ");
  change(R"(at = ["2 mm", "11 mm"])", R"(at = ["2 mm", "2 mm", "11 mm"])");
  return text;
}

inline json summary_in(const Path& dir) {
  std::ifstream in(dir / "summary.json");
  return json::parse(in);
}

inline ReadScene read_text(const io::TemporaryFolder& folder, const std::string& text, const std::vector<std::string>& settings = {}) {
  std::ofstream(folder.path() / "deck.toml") << text;
  return read_scene((folder.path() / "deck.toml").string(), settings);
}

template <int Dim = 2> json summary_of(const std::string& text, int threads = 1, const std::vector<std::string>& settings = {}) {
  const io::TemporaryFolder folder;
  const ReadScene read = read_text(folder, text, settings);
  EXPECT_EQ(RunSession<Dim>(read, folder.path() / "run", threads, "", {}).run(), 0);
  return summary_in(folder.path() / "run");
}

inline double value_of(const json& injury, const char* key) { return injury["criteria"][key]["value"]; }

/// Is there a warning that says so?
inline bool warns(const std::vector<std::string>& warnings, const std::string& text) {
  return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return w.find(text) != std::string::npos; });
}

} // namespace ballast::injury_scenes
