// Viscoelastic deviators in the step: the memory of a row of cells through its law (materials/visco), the Cauchy deviator to
// where other materials keep theirs, so that forces, closures, mixed cells and embedding know no second kind of stress.
//
// Memory is kept in fields that a remap mixes by mass, less the law's state at rest: what is at rest holds zeros, and so does
// what flows in. The free energy kept beside it is mixed, too; how much less the mixed memory holds shows in the next
// step, start = end - work + dissipated by the law, and the difference is booked as lost.
// Cells at rest are passed over: which cells share a batch of CVODE's does not depend on what sleeps.
#pragma once

#include "ale/lagrange_parts.hpp"
#include "ale/scene.hpp"

namespace ballast {

/// Of a tensor's six components (xx yy zz xy yz zx) those that are the stress fields, in their order.
template <int Dim> constexpr std::array<std::size_t, stress_components<Dim>> stress_of_tensor() {
  if constexpr (Dim == 2) {
    return {0, 1, 3};
  } else {
    return {0, 1, 3, 4, 5};
  }
}

/// Cells [begin, begin + count) of row (j, k) that hold a viscoelastic material.
template <int Dim> struct TissueRun {
  std::size_t material = 0;
  int j = 0, k = 0, begin = 0, count = 0;
  const double* gradient[Dim == 2 ? 5 : 9]; ///< velocity gradient times dt, of the first cell (ale/corner_force, WorkRows)
};

/// Work arrays of one thread.
struct TissueScratch {
  std::vector<double> rows;
  std::vector<int> active;
};

/// Integrators for every thread and room in the ledger, if a block holds tissue.
template <int Dim> void prepare_tissue(Scene<Dim>& scene);

/// One step of a run; cells' next_volume, masses and fractions must be those of its end. Adds to sums.tissue; what cannot be
/// integrated is reported in sums.trouble: the row is then good for nothing.
template <int Dim>
void advance_tissue(Block<Dim>& block, const TissueRun<Dim>& run, double dt, TissueIntegrator& integrator, TissueScratch& scratch, StepSums<Dim>& sums);

/// A sliver carries no deviator (ale/strength_update) and remembers nothing.
template <int Dim> void forget(Block<Dim>& block, std::size_t material, int row, int i, StepSums<Dim>& sums);

/// The interface of normal n has cut cell i's deviator by -(d n + n d), d in its plane, Pa: the memory takes the elastic shear that
/// does so, and what branches hold against each other stays.
template <int Dim> void free_memory(MaterialSlot& slot, const std::array<double, 3>& d, const std::array<double, 3>& n, int row, int i);

/// Sets the flow stresses of cells of a row: far above what the deviator is or soon can be, so that nothing is cut back to them.
template <int Dim> void set_flow_stress(MaterialSlot& slot, int row, int begin, int count);

/// Adds a step's sums to the ledger.
template <int Dim> void book_tissue(Scene<Dim>& scene, const StepSums<Dim>& sums);

/// Takes the integrators' counts to the ledger; of a step that does not stand only what was spent on it and what failed. `sums`: by block.
template <int Dim> void book_counts(Scene<Dim>& scene, const std::vector<StepSums<Dim>>& sums, bool stands);

/// NumericalFailure naming cell, material and state.
template <int Dim> [[noreturn]] void throw_trouble(const Block<Dim>& block, const TissueTrouble& trouble, const Clock& clock);

} // namespace ballast
