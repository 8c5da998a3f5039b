// The way back from a step's work: what the work pass changes in the cells of a block, kept row by row as it is about to change. The step is
// then taken again, smaller, where tissue could not be integrated (ale/lagrange_step). Nodes need no copy: their new positions and
// velocities stand beside the old ones until the step is over.
#pragma once

#include "ale/block.hpp"

#include <vector>

namespace ballast {

struct StepUndo {
  struct Row {
    Span cells;
    std::vector<double> values; ///< of every material that is there, field by field
  };
  std::vector<Row> rows; ///< by row of cells; without cells where nothing has changed
};

/// May the block hold a viscoelastic material whose branches are integrated (linear and quasi-linear ones have closed forms)?
template <int Dim> bool integrates_tissue(const Block<Dim>& block);

/// No row has changed.
template <int Dim> void begin_undo(const Block<Dim>& block, StepUndo& undo);

/// Row `row` is about to change in these cells. Rows may come from several threads.
template <int Dim> void keep_row(const Block<Dim>& block, int row, Span cells, StepUndo& undo);

/// All rows as they were when they were kept, to the bit.
template <int Dim> void undo_rows(Block<Dim>& block, const StepUndo& undo);

} // namespace ballast
