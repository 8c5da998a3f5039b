// Torn cloth that becomes a material of the mesh (ale/embedding_debris): nothing of it is lost on the way.
#include "ale/embedding.hpp"
#include "tests/observers.hpp"
#include "tests/problems/restarts.hpp"
#include "tests/problems/run_deck.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numeric>

namespace ballast {
namespace {

const std::string deck = std::string(BALLAST_SOURCE_DIR) + "/problems/m80_vest_tissue.toml";

std::vector<std::string> sets(double until) {
  return {"mesh.refine=0.5", fmt::format("end_time=\"{} us\"", until), "materials.cloth={ base = \"water\" }", "layers.0.debris=\"cloth\""};
}

void expect_kept(const std::vector<std::string>& some) {
  const nlohmann::json j = run_written<2>(read_scene(deck, some), 2).summary;
  const nlohmann::json& vest = j["results"]["layers"]["vest"]["mass_kg"];
  const double became = vest["became_debris"].get<double>(), torn = vest["eroded"].get<double>();
  EXPECT_GT(became, 0.05 * torn);
  EXPECT_LT(became, torn);
  const nlohmann::json& cloth = j["mass_kg"]["cloth"];
  const double dropped = j["floors"]["sliver_mass_kg"].get<double>();
  EXPECT_NEAR(cloth["end"].get<double>(), became, 1e-10 * became + 1.001 * dropped);
  EXPECT_NEAR(cloth["left_block"].get<double>(), -became, 1e-10 * became); // a difference of sums over the stack
  EXPECT_LT(std::abs(j["energy_J"]["unaccounted"].get<double>()), 1e-8 * j["energy_J"]["start"].get<double>());
  const nlohmann::json& p = j["momentum_kg_m_per_s"];
  const double start = p["start"][1].get<double>();
  EXPECT_NEAR(p["end"][1].get<double>() + p["left_block"][1].get<double>() - p["given_by_edges_of_layers"][1].get<double>(), start, 1e-10 * start); // traces are dropped
}

/// M80 through the vest: what leaves the stack is in the mesh, and momentum and energy close; as something that slides, too.
TEST(Debris, OfATornVestKeepsMassMomentumAndEnergy) {
  expect_kept(sets(17));
  std::vector<std::string> slides = sets(15);
  slides.push_back("numerics.sliding=[\"muscle\", \"cloth\"]");
  expect_kept(slides);
}

TEST(Debris, ARestartGoesOnBitForBit) {
  const ReadScene read = read_scene(deck, sets(13));
  Scene<2> scene = build_scene<2>(read.scene, 1);
  Clock clock;
  clock.end_time = read.scene.end_time;
  long first = 0, last = 0; // steps in which something was shed
  double mass = std::accumulate(scene.layers[0].stack.mass.begin(), scene.layers[0].stack.mass.end(), 0.0);
  while (!clock.done()) {
    advance(scene, clock);
    const double now = std::accumulate(scene.layers[0].stack.mass.begin(), scene.layers[0].stack.mass.end(), 0.0);
    first = now < mass && first == 0 ? clock.step : first;
    last = now < mass && !clock.done() ? clock.step : last;
    mass = now;
  }
  ASSERT_GT(last, first);
  expect_restarts<2>(read.scene, {first, last}, [](const Scene<2>& s) {
    std::vector<double> state = s.layers[0].stack.mass;
    for (std::size_t d = 0; d < 2; ++d) {
      for (int j = 0; j <= s.blocks[0].grid.cells[1]; ++j) { // ghosts of a velocity are not state: they are filled before they are read
        const double* v = s.blocks[0].velocity[d].row(s.blocks[0].grid.node_row(j, 0));
        state.insert(state.end(), v, v + s.blocks[0].grid.cells[0] + 1);
      }
      const auto& x = s.layers[0].stack.position[d];
      state.insert(state.end(), x.begin(), x.end());
    }
    return state;
  });
}

TEST(Debris, NeedsAMeshThatItCanGoInto) {
  Deck contact = Deck::load(std::string(BALLAST_SOURCE_DIR) + "/problems/disc_vest_370_rz.toml", {"layers.0.debris=\"water\""});
  read_scene(contact);
  EXPECT_NE(contact.error_report().find("only of a stack inside a mesh"), std::string::npos);
  Deck unknown = Deck::load(deck, {"layers.0.debris=\"felt\""}), nothing = Deck::load(deck, {"layers.0.debris=\"void\""});
  read_scene(unknown);
  read_scene(nothing);
  EXPECT_FALSE(unknown.clean());
  Deck tissue = Deck::load(deck, {"layers.0.debris=\"muscle\""});
  read_scene(tissue);
  EXPECT_NE(tissue.error_report().find("its results would count torn cloth"), std::string::npos) << tissue.error_report();
  EXPECT_FALSE(nothing.clean());
}

} // namespace
} // namespace ballast
