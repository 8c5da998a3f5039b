// Stacks of fabric layers from a deck: what is read and built.
#include "ale/layers/layer_step.hpp"
#include "problems/layers_report.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_report.hpp"
#include "tests/problems/layers_scenes.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

using namespace layers_scenes;

TEST(Layers, ComeAsTheNamedVest) {
  const LayersSpec l = layers_of(axisymmetric);
  EXPECT_EQ(l.plies, 29);
  EXPECT_EQ(l.layers, 5);
  EXPECT_NEAR(l.areal_density(), 5.2272, 1e-12);
  EXPECT_NEAR(l.thickness, 6.67e-3, 1e-15);
  EXPECT_EQ(l.subcycles, 0);
  EXPECT_EQ(l.edge[0][0], LayerEdge::symmetry);
  EXPECT_EQ(l.edge[0][1], LayerEdge::free);
  EXPECT_EQ(l.lines[0].front(), 0);
  EXPECT_EQ(l.lines[0].back(), 0.15);
  EXPECT_NEAR(l.lines[0][20], 0.02, 1e-15); // uniform to there
  EXPECT_LT(l.lines[0].back() - *(l.lines[0].end() - 2), 5.001e-3);
  EXPECT_TRUE(l.lines[1].empty());
}

TEST(Layers, TwoOfArealDensityThicknessAndDensityGiveTheThird) {
  const auto with = [](std::vector<std::string> settings) { return layers_of(axisymmetric, settings); };
  const auto set = [](const std::string& what) { return "layers.vest." + what; };
  const LayersSpec a = with({set("areal_density=4 kg/m2"), set("thickness=5 mm")});
  EXPECT_NEAR(a.density(), 800, 1e-12);
  const LayersSpec b = with({set("density=900 kg/m3"), set("thickness=5 mm")});
  EXPECT_NEAR(b.areal_density(), 4.5, 1e-14);
  const LayersSpec c = with({set("areal_density=450 g/m2"), set("density=900 kg/m3"), set("layers=2")});
  EXPECT_NEAR(c.thickness, 0.5e-3, 1e-18);
  EXPECT_EQ(c.plies, 2); // of 0.18 kg/m2
  const LayersSpec half = with({set("areal_density=2.7037 kg/m2")}); // 15 plies' weight: their thickness too
  EXPECT_EQ(half.plies, 15);
  EXPECT_NEAR(half.thickness, 15 * 0.23e-3, 1e-15);
  const LayersSpec plies = with({set("plies=58")}); // of 0.23 mm and 0.18025 kg/m2
  EXPECT_NEAR(plies.thickness, 2 * 6.67e-3, 1e-15);
  EXPECT_NEAR(plies.areal_density(), 2 * 5.2272, 1e-12);
  const LayersSpec thin = with({set("thickness=4 mm")}); // the same plies, thinner: as much load of a width
  EXPECT_NEAR(thin.areal_density(), 5.2272, 1e-12);
  const auto& as_named = std::get<RaftenbergFabric>(plies.model);
  const auto& denser = std::get<RaftenbergFabric>(thin.model);
  EXPECT_NEAR(denser.warp.fit.c * thin.thickness, as_named.warp.fit.c * 6.67e-3, 1e-9 * as_named.warp.fit.c);
  EXPECT_NEAR(denser.in_plane.modulus * thin.thickness, as_named.in_plane.modulus * 6.67e-3, 1e-9 * as_named.in_plane.modulus);
  EXPECT_EQ(denser.transverse.a, as_named.transverse.a);
  // Three that agree to their printed digits.
  EXPECT_NEAR(with({set("areal_density=5.227 kg/m2"), set("thickness=6.67 mm"), set("density=783.7 kg/m3")}).density(), 783.7, 1e-9);
}

TEST(Layers, FabricTakesEveryOption) {
  const std::string options = axisymmetric + R"(
[fabrics.kevlar_km2_raftenberg]
unload = 0.02
transverse_form = "C"
shear_in_plane = "awg"
shear_through = "20 MPa"
solid = { bulk_modulus = "6 GPa" }
secant_unloading = true
rate = true
coupling = "1 GPa"
warp = { rupture = 0.12 }
)";
  const auto law = std::get<RaftenbergFabric>(layers_of(options).model);
  EXPECT_EQ(law.warp.unload, 0.02);
  EXPECT_EQ(law.fill.unload, 0.02);
  EXPECT_EQ(law.warp.rupture, 0.12);
  EXPECT_EQ(law.warp.fit.a, 1.35322e9); // as named
  EXPECT_EQ(law.form, TransverseForm::c);
  EXPECT_EQ(law.in_plane.stiffest, awg_shear().stiffest);
  EXPECT_EQ(law.through.modulus, 20e6);
  EXPECT_FALSE(std::isfinite(law.through.first_angle));
  EXPECT_EQ(law.solid->bulk_modulus, 6e9);
  EXPECT_EQ(law.solid->density, 1440);
  EXPECT_TRUE(law.secant_unloading);
  EXPECT_EQ(law.rate->C, RateFactor{}.C);
  EXPECT_EQ(law.coupling, 1e9);
  const auto off = std::get<RaftenbergFabric>(layers_of(options, {"fabrics.kevlar_km2_raftenberg.solid=false", "fabrics.kevlar_km2_raftenberg.shear_through=1 GPa"}).model);
  EXPECT_FALSE(off.solid);
  EXPECT_EQ(off.through.modulus, 1e9);
}

TEST(Layers, NewFabricsAreDescribedInTheDeck) {
  const std::string felt = axisymmetric + R"(plies = 3
layers = 3
areal_density = "2 kg/m2"
thickness = "6 mm"
[fabrics.felt]
law = "hooke"
young = "10 MPa"
poisson = 0.1
)";
  const auto law = std::get<HookeSolid>(layers_of(felt, {"layers.vest.fabric=felt"}).model);
  EXPECT_EQ(law.young, 10e6);
  EXPECT_NEAR(law.density, 2 / 6e-3, 1e-9);
}

TEST(Layers, AroundAnAxisOneFamilyMayLieBothWays) {
  const auto law = std::get<RaftenbergFabric>(layers_of(axisymmetric, {"layers.vest.yarns=fill"}).model);
  EXPECT_EQ(law.warp.rupture, 0.149961);
  EXPECT_EQ(law.fill.rupture, 0.149961);
}

TEST(Layers, ResolvedDecksReadBack) {
  const std::string options = axisymmetric + "[fabrics.kevlar_km2_raftenberg]\nshear_in_plane = \"awg\"\nsolid = true\nrate = {}\n";
  for (const std::string& text : {options, solid("0 mm", "-6 mm")}) {
    Deck deck = Deck::parse(text, "test.toml");
    read_scene(deck);
    ASSERT_TRUE(deck.clean()) << deck.error_report();
    const std::string once = write_toml(deck.root());
    Deck again = Deck::parse(once, "resolved.toml");
    read_scene(again);
    EXPECT_TRUE(again.clean()) << again.error_report();
    EXPECT_EQ(once, write_toml(again.root()));
  }
}

TEST(Layers, LieBehindTheFrontAsTheShotGoes) {
  std::string up = axisymmetric;
  up.replace(up.find("\"370 m/s\""), 9, "\"-370 m/s\"");
  const LayersSpec l = layers_of(up, {"layers.vest.front=-10 mm"});
  EXPECT_EQ(l.direction, -1);
  const LayerStack<2> s = build_stack<2>(l, Geometry::axisymmetric);
  EXPECT_NEAR(s.levels.back(), -10e-3, 1e-17);
  EXPECT_NEAR(s.levels.front(), -10e-3 - 6.67e-3, 1e-15);
}

TEST(Layers, PlanesOfSymmetryCutTheStack) {
  const auto built = [](const char* x, const char* y) { return build_stack<3>(layers_of(solid(x, y)), Geometry::three_d); };
  const LayerStack<3> quarter = built("0 mm", "0 mm"), half = built("0 mm", "-6 mm"), whole = built("-6 mm", "-6 mm");
  const double area = 0.06 * 0.06;
  EXPECT_NEAR(totals(whole).mass, 5.2272 * area, 1e-12 * area);
  EXPECT_NEAR(totals(half).mass, 5.2272 * area / 2, 1e-12 * area);
  EXPECT_NEAR(totals(quarter).mass, 5.2272 * area / 4, 1e-12 * area);
  EXPECT_EQ(quarter.edge[1][0], LayerEdge::symmetry);
  EXPECT_EQ(half.edge[0][0], LayerEdge::symmetry);
  EXPECT_EQ(half.edge[1][0], LayerEdge::elastic);
  EXPECT_EQ(half.lines[1].size(), 13U);
  EXPECT_EQ(half.lines[1][6], 0);
  EXPECT_EQ(whole.grid.levels(), 10);
}

TEST(Layers, InAPlaneTheyReachBothWays) {
  const std::string text = R"(
title = "plate on vest"
geometry = "planar"
end_time = "1 us"
[[body]]
name = "plate"
material = "lead"
velocity = [0, "370 m/s"]
shape = { box = { from = ["-2 mm", "-6 mm"], to = ["2 mm", "0 mm"] } }
[mesh]
x = { from = "-2 mm", to = "2 mm", cells = 4 }
y = { from = "-6 mm", to = "0 mm", cells = 6 }
[motion]
policy = "relax"
[[layers]]
name = "vest"
fabric = "kevlar_hooke_wstm"
front = "0 mm"
half_width = "50 mm"
size = "5 mm"
edges = "fixed"
)";
  const LayerStack<2> whole = build_stack<2>(layers_of(text), Geometry::planar), half = build_stack<2>(layers_of(text, {"mesh.x.from=0 mm", "mesh.x.lower=symmetry"}), Geometry::planar);
  EXPECT_NEAR(totals(whole).mass, 5.2272 * 0.1, 1e-13);
  EXPECT_NEAR(totals(half).mass, 5.2272 * 0.05, 1e-13);
  EXPECT_EQ(whole.edge[0][0], LayerEdge::fixed);
  EXPECT_EQ(half.edge[0][0], LayerEdge::symmetry);
  EXPECT_EQ(half.edge[0][1], LayerEdge::fixed);
}

TEST(Layers, ABodyFittedQuarterBulletMayTouchTheFront) {
  const std::string text = R"(
title = "M80 on vest"
geometry = "3d"
end_time = "900 us"
[[body]]
use = "bullet/m80"
tip = [0, 0, 0]
velocity = "823 m/s"
[mesh]
map = "rod"
outer_radius = "4 mm"
u = { from = 0, to = 1, cells = 2 }
v = { from = -1, to = 1, cells = 4 }
z = { from = "-29 mm", to = "0 mm", cells = 10 }
[motion]
policy = "relax"
[[layers]]
name = "vest"
fabric = "kevlar_km2_raftenberg"
front = "0 mm"
half_width = "150 mm"
cells = 10
)";
  const LayersSpec l = layers_of(text);
  EXPECT_EQ(l.lines[0].front(), 0); // the plane u = 0 of the mesh is x = 0
  EXPECT_EQ(l.lines[1].front(), -0.15);
  Deck deck = Deck::parse(text, "test.toml", {"layers.vest.front=-1 mm"}); // the tip is 2 mm of a square of 300 mm
  read_scene(deck);
  EXPECT_NE(deck.error_report().find("overlaps body"), std::string::npos) << deck.error_report();
}

TEST(Layers, TableSaysWhatAStackWeighsAndCosts) {
  const SceneSpec scene = scene_of(axisymmetric);
  const LayersCost cost = layers_cost(scene.layers[0], scene);
  EXPECT_NEAR(cost.mass, 5.2272 * std::numbers::pi * 0.15 * 0.15, 1e-9);
  // The step that the whole stack takes at rest.
  LayerStack<2> s = build_stack<2>(scene.layers[0], scene.geometry);
  LayerLedger ledger;
  ThreadPool pool(1);
  update_forces(s, 0, ledger, pool);
  EXPECT_NEAR(cost.step, stable_step(s).dt, 1e-6 * cost.step);
  EXPECT_EQ(cost.elements, static_cast<double>(s.element_count()));
  EXPECT_EQ(cost.nodes, static_cast<double>(s.node_count()));
  const std::string table = scene_table(scene);
  for (const char* part : {"vest", "5 layers of 5.8 plies", "5.2272 kg/m2", "369.489 g", "transverse form B", "stable step"}) {
    EXPECT_NE(table.find(part), std::string::npos) << part << "\n" << table;
  }
}

TEST(Layers, StableStepOfElasticEdgesIsTheStacks) {
  const SceneSpec scene = scene_of(solid("0 mm", "0 mm"), {"layers.vest.edge_stiffness=1000 GPa"}); // that the springs set it
  LayerStack<3> s = build_stack<3>(scene.layers[0], scene.geometry);
  LayerLedger ledger;
  ThreadPool pool(1);
  update_forces(s, 0, ledger, pool);
  const double cost = layers_cost(scene.layers[0], scene).step;
  EXPECT_NEAR(cost, stable_step(s).dt, 1e-6 * cost);
}

TEST(Layers, ReferenceNamesEveryKey) {
  const std::string text = scene_keys::reference();
  for (const SectionSpec* section : {&scene_keys::layers(), &scene_keys::fabric(), &scene_keys::yarns(), &scene_keys::shear(), &scene_keys::solid(), &scene_keys::rate()}) {
    EXPECT_NE(text.find("## " + section->header), std::string::npos) << section->header;
  }
}

} // namespace
} // namespace ballast
