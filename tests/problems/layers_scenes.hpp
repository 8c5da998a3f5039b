// Decks with a stack of fabric layers that tests share.
#pragma once

#include "problems/build_layers.hpp"
#include "problems/scene_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace ballast::layers_scenes {

inline const std::string axisymmetric = R"(
title = "disc on vest"
geometry = "axisymmetric"
end_time = "680 us"
[[body]]
name = "disc"
material = "lead"
velocity = ["0 m/s", "370 m/s"]
shape = { cylinder = { from = ["0 mm", "-6.23 mm"], to = ["0 mm", "0 mm"], radius = "6 mm" } }
[mesh]
r = { from = "0 mm", to = "6 mm", size = "0.5 mm" }
z = { from = "-6.23 mm", to = "0 mm", size = "0.5 mm" }
[motion]
policy = "relax"
[results]
bullet = ["disc"]
[[layers]]
name = "vest"
fabric = "kevlar_km2_raftenberg"
front = "0 mm"
half_width = "150 mm"
to = "20 mm"
size = ["1 mm", "5 mm"]
)";

/// Quarters, halves and wholes of a 3D scene by the planes of symmetry of its mesh.
inline std::string solid(const std::string& x, const std::string& y) {
  return fmt::format(R"(
title = "disc on vest"
geometry = "3d"
end_time = "10 us"
symmetry = [{}{}]
[[body]]
name = "disc"
material = "lead"
velocity = [0, 0, "370 m/s"]
shape = {{ cylinder = {{ from = [0, 0, "-6 mm"], to = [0, 0, 0], radius = "6 mm" }} }}
[mesh]
x = {{ from = "{}", to = "6 mm", cells = 4 }}
y = {{ from = "{}", to = "6 mm", cells = 4 }}
z = {{ from = "-6 mm", to = "0 mm", cells = 4 }}
[motion]
policy = "relax"
[[layers]]
name = "vest"
fabric = "kevlar_km2_raftenberg"
front = "1 mm"
half_width = "30 mm"
cells = 6
edges = "elastic"
edge_stiffness = "10 MPa"
elements_through = 2
)",
                     x == "0 mm" ? "\"x\"" : "", y == "0 mm" ? (x == "0 mm" ? ", \"y\"" : "\"y\"") : "", x, y);
}

inline SceneSpec scene_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  Deck deck = Deck::parse(text, "test.toml", settings);
  SceneSpec scene = read_scene(deck);
  EXPECT_TRUE(deck.clean()) << deck.error_report();
  EXPECT_EQ(scene.layers.size(), 1U);
  return scene;
}

inline LayersSpec layers_of(const std::string& text, const std::vector<std::string>& settings = {}) { return scene_of(text, settings).layers.at(0); }

} // namespace ballast::layers_scenes
