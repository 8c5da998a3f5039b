// Injury measures say what makes them weaker than they look: cut records, lost gauges, lower bounds.
#include "tests/problems/injury_push.hpp"

#include <gtest/gtest.h>

namespace ballast {
namespace {

using namespace injury_scenes;

TEST(InjuryWarnings, PeakAtTheEndMayGoOnGrowing) {
  const std::vector<std::string> all = summary_of(flight)["injury"]["warnings"];
  EXPECT_TRUE(warns(all, "sternum deflection is largest at"));
  EXPECT_TRUE(warns(all, "back-face signature is largest at"));
}

TEST(InjuryWarnings, FilteredPeakNeedsOneSpanOfTheFilterBehindIt) {
  const double peak = Push<2>::middle;
  const std::vector<std::string> long_enough = Push<2>(flight, 1, peak + 3e-3).warnings(), cut = Push<2>(flight, 1, peak + 0.9e-3).warnings();
  EXPECT_FALSE(warns(long_enough, "impact force"));
  EXPECT_FALSE(warns(long_enough, "peak acceleration middle, CFC"));
  EXPECT_TRUE(warns(cut, "impact force CFC1000 is largest"));
  EXPECT_TRUE(warns(cut, "peak acceleration middle, CFC1000 is largest"));
  EXPECT_FALSE(warns(cut, "peak acceleration middle, recorded is largest")); // of that the end is known
  EXPECT_TRUE(warns(Push<2>(flight, 1, peak + 1.5e-3).warnings(), "impact force CFC600"));
  EXPECT_FALSE(warns(Push<2>(flight, 1, peak + 1.5e-3).warnings(), "impact force CFC1000"));
}

TEST(InjuryWarnings, ShortRecordIsSaid) {
  EXPECT_TRUE(warns(Push<2>(flight, 1, 1.1e-3).warnings(), "less than 4 / CFC 1000"));
  EXPECT_TRUE(warns(Push<2>(flight, 1, 3.9e-3).warnings(), "less than 4 / CFC 1000"));
  EXPECT_FALSE(warns(Push<2>(flight, 1, 4.1e-3).warnings(), "less than 4 / CFC 1000"));
  EXPECT_TRUE(warns(Push<2>(flight, 1, 4.1e-3).warnings(), "less than 4 / CFC 600"));
}

/// The ball's scene before its first step, its gauges put where a test wants them.
struct Watched {
  io::TemporaryFolder folder;
  ReadScene read = read_text(folder, ball);
  Scene<2> scene = build_scene<2>(read.scene, 1);
  InjuryRecord<2> record{read.scene, slot_map(read.scene).slot};
  std::vector<double> gauges = {0.5e-3, 1.5e-3, 0, 0.5e-3, 12.5e-3, 0};

  std::vector<std::string> warnings() const { return injury_warnings(read.scene, record, {}); }
};

TEST(InjuryWarnings, GaugeWhoseMaterialIsGoneRidesNoMore) {
  Watched w;
  w.record.step(w.scene, 0, w.gauges);
  w.record.step(w.scene, 1e-6, w.gauges);
  EXPECT_FALSE(warns(w.warnings(), "rides no more"));
  w.gauges[1] = -3.5e-3; // in the ball
  w.record.step(w.scene, 2e-6, w.gauges);
  w.gauges[1] = 1.5e-3; // back again: too late
  w.record.step(w.scene, 3e-6, w.gauges);
  EXPECT_TRUE(warns(w.warnings(), "gauge \"sternum\" rides no more from 2e-06 s on"));
  EXPECT_FALSE(warns(w.warnings(), "\"spine\" rides no more"));
  InjuryRecord<2> again(w.read.scene, slot_map(w.read.scene).slot);
  again.recall(w.record.memory());
  EXPECT_EQ(injury_warnings(w.read.scene, again, {}), w.warnings());
}

TEST(InjuryWarnings, GaugeThatLeavesTheMeshRidesNoMore) {
  io::TemporaryFolder folder;
  const ReadScene read = read_text(folder, flight); // full of water
  const Scene<2> scene = build_scene<2>(read.scene, 1);
  for (const auto& [z, lost] : std::vector<std::pair<double, bool>>{{19e-3, false}, {22e-3, false}, {23e-3, true}, {-3e-3, true}}) { // cells of 5 mm
    InjuryRecord<2> record(read.scene, slot_map(read.scene).slot);
    record.step(scene, 0, std::vector<double>{2e-3, 11e-3, 0});
    record.step(scene, 1e-6, std::vector<double>{2e-3, z, 0});
    EXPECT_EQ(warns(injury_warnings(read.scene, record, {}), "rides no more"), lost) << z;
  }
}

TEST(InjuryWarnings, SqueezedLungGivesALowerBound) {
  for (const auto& [pressure, cut] : std::vector<std::pair<double, bool>>{{1e5, false}, {50e6, true}}) {
    Watched w;
    Block<2>& b = w.scene.blocks[0];
    for (int j = 0; j < b.grid.cells[1]; ++j) {
      std::fill_n(b.pressure.row(b.grid.cell_row(j, 0)), b.grid.cells[0], pressure);
    }
    for (int k = 0; k <= 100; ++k) {
      w.record.step(w.scene, k * 1e-5, w.gauges);
    }
    int bounds = 0;
    const std::vector<InjuryValue> values = injury_values(w.read.scene, w.record, {{1.0, 1.0}, {0, 1}});
    for (const InjuryValue& v : values) {
      bounds += v.at_least ? 1 : 0;
    }
    EXPECT_EQ(bounds, cut ? 2 : 0); // chest wall velocity and ASII
    EXPECT_EQ(warns(injury_warnings(w.read.scene, w.record, values), "lower bounds"), cut);
  }
}

} // namespace
} // namespace ballast
