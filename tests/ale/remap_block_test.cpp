// A block whose mesh would turn inside out: the failure says where and what.
#include "ale/fill.hpp"
#include "ale/phases.hpp"
#include "core/error.hpp"
#include "materials/library.hpp"

#include <gtest/gtest.h>
#include <string>

namespace ballast {
namespace {

TEST(RemapBlock, NamesBlockCellAndContentsOfACellTurnedInsideOut) {
  const Material copper = *find_material("copper_ofhc");
  Scene<2> scene;
  Block<2> b;
  b.name = "stack";
  b.materials.push_back(make_slot(copper, 0));
  allocate_block(b, {std::vector<double>{0, 1e-3, 2e-3, 3e-3}, std::vector<double>{0, 1e-3}, {}});
  for (int i = 0; i < 3; ++i) {
    const CellPart part{0, 1, copper.density, copper.specific_energy};
    fill_cell<2>(b, i, 0, 0, std::span(&part, 1));
  }
  scene.blocks.push_back(std::move(b));
  scene.ledger.mass_out.assign(1, 0.0);
  ThreadPool pool(1);
  Block<2>& block = scene.blocks[0];
  compute_node_mass(block, pool);
  update_state(block, pool);
  for (const int j : {0, 1}) { // the line between the first two cells, beyond the next one
    block.target[0].row(block.grid.node_row(j, 0))[1] = 2.5e-3;
  }
  try {
    remap_block(scene, block, 0);
    FAIL() << "taken";
  } catch (const NumericalFailure& failure) {
    const std::string what = failure.what();
    EXPECT_NE(what.find("block stack, cell (1, 0, 0)"), std::string::npos) << what;
    EXPECT_NE(what.find("copper_ofhc"), std::string::npos) << what;
  }
}

} // namespace
} // namespace ballast
