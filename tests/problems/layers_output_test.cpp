// Stacks of fabric layers: the back face, columns of history.csv, dumps.
#include "ale/layers/layer_step.hpp"
#include "core/io/history.hpp"
#include "problems/layers_dump.hpp"
#include "problems/layers_measure.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/problems/layers_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ballast {
namespace {

using namespace layers_scenes;

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
  const LayerStack<3>* one = &s;
  const auto dumps = dump_layers<3>(std::span(&one, 1), {"lead"});
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

} // namespace
} // namespace ballast
