#include "ale/step_undo.hpp"

#include <algorithm>
#include <utility>

namespace ballast {

namespace {

/// Calls visit(field) for what the work pass changes: all that is conserved but the mass, and the flow stress.
template <class Visit> void for_changed(const MaterialSlot& slot, Visit&& visit) {
  visit(field::fraction);
  for (int f = field::energy; !slot.is_void && f < slot.store.conserved(); ++f) {
    visit(f);
  }
  if (slot.strength) {
    visit(slot.flow_stress_field());
  }
}

} // namespace

template <int Dim> bool integrates_tissue(const Block<Dim>& b) {
  return std::any_of(b.materials.begin(), b.materials.end(), [](const MaterialSlot& slot) {
    const TissueLaw* law = tissue_law(slot.material.strength);
    return slot.memories > 0 && (std::holds_alternative<PowerLawZener>(*law) || std::holds_alternative<BergstroemBoyce>(*law));
  });
}

template <int Dim> void begin_undo(const Block<Dim>& b, StepUndo& undo) {
  undo.rows.resize(static_cast<std::size_t>(b.grid.cell_rows()));
  for (StepUndo::Row& row : undo.rows) {
    row.cells = {};
  }
}

template <int Dim> void keep_row(const Block<Dim>& b, int r, Span cells, StepUndo& undo) {
  StepUndo::Row& kept = undo.rows[static_cast<std::size_t>(r)];
  kept.cells = cells;
  kept.values.clear();
  for (const MaterialSlot& slot : b.materials) {
    if (slot.store.has_row(r)) {
      for_changed(slot, [&](int f) {
        const double* values = slot.store.row(f, r);
        kept.values.insert(kept.values.end(), values + cells.begin, values + cells.end);
      });
    }
  }
}

template <int Dim> void undo_rows(Block<Dim>& b, const StepUndo& undo) {
  for (std::size_t r = 0; r < undo.rows.size(); ++r) {
    const StepUndo::Row& kept = undo.rows[r];
    const double* from = kept.values.data();
    for (MaterialSlot& slot : b.materials) {
      if (!kept.cells.empty() && slot.store.has_row(static_cast<int>(r))) {
        for_changed(slot, [&](int f) {
          std::copy_n(from, kept.cells.count(), slot.store.row(f, static_cast<int>(r)) + kept.cells.begin);
          from += kept.cells.count();
        });
      }
    }
  }
}

template bool integrates_tissue<2>(const Block<2>&);
template bool integrates_tissue<3>(const Block<3>&);
template void begin_undo<2>(const Block<2>&, StepUndo&);
template void begin_undo<3>(const Block<3>&, StepUndo&);
template void keep_row<2>(const Block<2>&, int, Span, StepUndo&);
template void keep_row<3>(const Block<3>&, int, Span, StepUndo&);
template void undo_rows<2>(Block<2>&, const StepUndo&);
template void undo_rows<3>(Block<3>&, const StepUndo&);

} // namespace ballast
