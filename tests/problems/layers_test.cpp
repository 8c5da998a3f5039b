// Stacks of fabric layers from a deck: what is read, built, measured and dumped.
#include "ale/layers/layer_step.hpp"
#include "core/io/history.hpp"
#include "problems/build_layers.hpp"
#include "problems/layers_dump.hpp"
#include "problems/layers_measure.hpp"
#include "problems/layers_report.hpp"
#include "problems/scene_keys.hpp"
#include "problems/scene_reader.hpp"
#include "problems/scene_report.hpp"
#include "tests/io/temporary_folder.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>

namespace ballast {
namespace {

const std::string axisymmetric = R"(
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
std::string solid(const std::string& x, const std::string& y) {
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

SceneSpec scene_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  Deck deck = Deck::parse(text, "test.toml", settings);
  SceneSpec scene = read_scene(deck);
  EXPECT_TRUE(deck.clean()) << deck.error_report();
  EXPECT_EQ(scene.layers.size(), 1U);
  return scene;
}

LayersSpec layers_of(const std::string& text, const std::vector<std::string>& settings = {}) { return scene_of(text, settings).layers.at(0); }

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
  const LayersSpec c = with({set("areal_density=450 g/m2"), set("density=900 kg/m3"), set("plies=5")});
  EXPECT_NEAR(c.thickness, 0.5e-3, 1e-18);
  const LayersSpec plies = with({set("plies=58")}); // of 0.23 mm and 0.18025 kg/m2
  EXPECT_NEAR(plies.thickness, 2 * 6.67e-3, 1e-15);
  EXPECT_NEAR(plies.areal_density(), 2 * 5.2272, 1e-12);
  const LayersSpec thin = with({set("thickness=4 mm")}); // the same cloth, pressed
  EXPECT_NEAR(thin.areal_density(), 5.2272, 1e-12);
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

/// Back face pushed to a cone of 10 mm that ends at 100 mm, other planes at rest.
LayerStack<2> cone(double direction) {
  LayersSpec spec = layers_of(axisymmetric);
  spec.direction = direction;
  LayerStack<2> s = build_stack<2>(spec, Geometry::axisymmetric);
  const int plane = direction > 0 ? s.grid.planes() - 1 : 0;
  for (int i = 0; i < s.grid.nodes_along(0); ++i) {
    const std::size_t n = s.node(i, 0, plane);
    s.position[1][n] += direction * std::max(0.0, 10e-3 * (1 - s.rest[0][n] / 0.1));
    s.velocity[1][n] = direction * 5;
  }
  return s;
}

TEST(BackFace, DomeOfACone) {
  for (const double direction : {1.0, -1.0}) {
    LayerStack<2> s = cone(direction);
    const LayerMeasure m = measure_layers(s, direction);
    EXPECT_NEAR(m.centre, 10e-3, 1e-15);
    EXPECT_NEAR(m.largest, 10e-3, 1e-15);
    EXPECT_NEAR(m.velocity, 5, 1e-15);
    EXPECT_NEAR(m.dome.at(0), 0.09, 1e-13);       // 10 mm (1 - r/R) = 1 mm
    EXPECT_NEAR(m.dome_part.at(0), 0.095, 1e-4);  // 0.5 mm; the cone's foot lies between two lines 5 mm apart
    EXPECT_EQ(m.eroded_mass, 0);
    // A hole of the first 10 mm: the face begins there, its mass is gone.
    const int level = direction > 0 ? s.grid.levels() - 1 : 0;
    for (int i = 0; i < 10; ++i) {
      s.alive[s.element(i, 0, level)] = 0;
    }
    const LayerMeasure hole = measure_layers(s, direction);
    EXPECT_NEAR(hole.largest, 9e-3, 1e-15);
    EXPECT_NEAR(hole.centre, 10e-3, 1e-15);
    EXPECT_NEAR(hole.eroded_mass, 5.2272 / 5 * std::numbers::pi * 1e-4, 1e-12);
  }
}

TEST(BackFace, DomeOfNothingAndOfAll) {
  const BackFaceLine flat{{0, 1, 2}, {0, 0, 0}, {0, 0, 0}, {1, 1, 1}}, gone{{0, 1, 2}, {3, 3, 3}, {0, 0, 0}, {0, 0, 0}}, moved{{0, 1, 2}, {3, 3, 3}, {0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(dome_radius(flat, 1e-3), 0);
  EXPECT_EQ(dome_radius(gone, 1e-3), 0);
  EXPECT_EQ(dome_radius(moved, 1e-3), 2);
}

TEST(BackFace, ColumnsAndValuesGoTogether) {
  const LayerStack<2> s = cone(1);
  LayerLedger ledger;
  ledger.contact_loss = 7;
  const auto columns = layer_columns(s);
  const auto values = layer_values(s, ledger, 1);
  ASSERT_EQ(columns.size(), values.size());
  const auto value = [&](const char* name) { return values.at(static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin())); };
  EXPECT_NEAR(value("vest_deflection [m]"), 10e-3, 1e-15);
  EXPECT_EQ(value("vest_contact_loss [J]"), 7);
  EXPECT_NEAR(value("vest_energy_kinetic [J]"), totals(s).kinetic, 0);
  EXPECT_GT(value("vest_momentum [kg m/s]"), 0);
  const LayerStack<3> quarter = build_stack<3>(layers_of(solid("0 mm", "0 mm")), Geometry::three_d);
  EXPECT_EQ(layer_columns(quarter).size(), layer_values(quarter, ledger, 1).size());
}

TEST(BackFace, ProfileReadsBack) {
  const io::TemporaryFolder folder;
  const LayerStack<2> s = cone(1);
  EXPECT_EQ(back_face_file(folder.path(), "vest", 1, 12).filename(), "back_face_0012.csv");
  EXPECT_EQ(back_face_file(folder.path(), "a/b", 2, 0).filename(), "back_face_a_b_0000.csv");
  const auto path = back_face_file(folder.path(), "vest", 1, 12);
  write_back_face(s, 1, path);
  const io::Table table = io::read_csv(path);
  ASSERT_NE(table.find("deflection_r"), nullptr);
  EXPECT_EQ(table.find("radius")->size(), s.lines[0].size());
  EXPECT_NEAR(table.find("deflection_r")->at(10), 9e-3, 1e-15);
}

TEST(LayerDump, LeavesErodedElementsOutAndKeepsStrainAndStress) {
  LayersSpec spec = layers_of(solid("0 mm", "-6 mm"));
  LayerStack<3> s = build_stack<3>(spec, Geometry::three_d);
  const std::array<double, 3> stretch = {1.05, 1.02, 0.9};
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t n = 0; n < s.node_count(); ++n) {
      s.position[d][n] = stretch[d] * s.rest[d][n];
      s.velocity[d][n] = d == 1 ? 3 : d == 2 ? 4 : 0;
    }
  }
  LayerLedger ledger;
  ThreadPool pool(1);
  update_forces(s, 0, ledger, pool);
  s.alive[s.element(2, 3, 1)] = 0;
  const auto dumps = dump_layers<3>(std::span(&s, 1), {"lead"});
  ASSERT_EQ(dumps.size(), 1U);
  const io::ElementDump& dump = dumps[0];
  EXPECT_EQ(dump.elements.size(), 8 * (s.element_count() - 1));
  EXPECT_EQ(dump.material_names, (std::vector<std::string>{"lead", "vest"}));
  EXPECT_EQ(dump.symmetry, (std::vector<std::string>{"x"}));
  const auto array = [&](const std::string& name) -> const std::vector<float>& {
    return std::find_if(dump.cell_arrays.begin(), dump.cell_arrays.end(), [&](const auto& a) { return a.name == name; })->values;
  };
  FabricState state;
  FabricTensor E = {};
  for (std::size_t d = 0; d < 3; ++d) {
    E[d] = 0.5 * (stretch[d] * stretch[d] - 1);
  }
  const FabricStress exact = evaluate(std::get<RaftenbergFabric>(s.model), E, state);
  constexpr double digits = 1e-6; // of a float
  for (std::size_t e = 0; e < dump.elements.size() / 8; ++e) {
    for (const std::size_t d : {0U, 1U, 2U}) {
      EXPECT_NEAR(array(fmt::format("green_strain_{}{}", d + 1, d + 1))[e], E[d], digits);
      EXPECT_NEAR(array(fmt::format("stress_{}{}", d + 1, d + 1))[e], exact.stress[d], digits * std::abs(exact.stress[d]));
    }
    EXPECT_NEAR(array("damage_warp")[e], E[0] / 0.132930, digits);
    EXPECT_NEAR(array("damage_fill")[e], E[1] / 0.149961, digits);
    EXPECT_NEAR(array("speed")[e], 5, digits * 5);
    EXPECT_EQ(array("material")[e], 1);
  }
  EXPECT_EQ(array("layer").back(), 4);
  double on_plane = 0;
  for (const float x : array("section")) {
    on_plane += static_cast<double>(x);
  }
  EXPECT_EQ(on_plane, 6 * 10); // a row of elements in each of ten levels
  const io::TemporaryFolder folder;
  io::VtkSeries series(folder.path(), "fields");
  EXPECT_NO_THROW(series.write(0, 0, {}, dumps));
  EXPECT_TRUE(std::filesystem::exists(folder / "fields_0000/vest.vtu"));
}

TEST(Layers, ReferenceNamesEveryKey) {
  const std::string text = scene_keys::reference();
  for (const SectionSpec* section : {&scene_keys::layers(), &scene_keys::fabric(), &scene_keys::yarns(), &scene_keys::shear(), &scene_keys::solid(), &scene_keys::rate()}) {
    EXPECT_NE(text.find("## " + section->header), std::string::npos) << section->header;
  }
}

} // namespace
} // namespace ballast
