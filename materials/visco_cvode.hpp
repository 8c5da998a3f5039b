// Stiff branches of many cells at once by SUNDIALS' CVODE (BDF, Newton with the laws' own Jacobians).
//
// A batch of cells is one system of 7 variables a cell over the unit step; its matrix is one block a cell (a multiple of
// the unit matrix and two dyads), solved where it is needed, and its error is that of its worst cell (a mean over the
// batch would dilute one hot cell). CVODE starts anew for every batch: results depend on the cells of the batch, not on
// history, threads or order. Cost: docs/viscoelasticity.md.
// Hindmarsh et al., ACM TOMS 31 (2005) 363.
#pragma once

#include "materials/visco_bergstroem_boyce.hpp"
#include "materials/visco_power_law.hpp"

#include <memory>
#include <optional>
#include <span>

namespace ballast {

struct BatchOptions {
  double tolerance = 1e-4; ///< of CVODE's local error, relative to the law's error_scale
  int batch = 16;          ///< cells, at most 4096
  int most_steps = 5000;   ///< of CVODE's in the unit step; more is a failure
};

struct BatchCounts {
  long batches = 0, cells = 0;
  long steps = 0, rates = 0, solves = 0; ///< of batches: internal steps, evaluations of rates, block solves
  long failures = 0;                     ///< cells
  double seconds = 0;
};

struct BatchFailure {
  int cell = 0;   ///< in the given span
  int reason = 0; ///< CVODE's flag
  double reached = 0; ///< of the unit step
  Sym state{};    ///< there
};

/// Of a vector of CVODE's, seven values a cell, times their weights: the root mean square of the worst cell's first six; NaN if any cell has none.
double worst_cell_norm(std::span<const double> values, std::span<const double> weights);

/// Owned by one thread: SUNDIALS' context, solvers and buffers of every batch size that came up.
class BatchSolver {
public:
  /// Throws Error if the options are out of range.
  explicit BatchSolver(const BatchOptions& options);
  ~BatchSolver();
  BatchSolver(BatchSolver&&) noexcept;
  BatchSolver& operator=(BatchSolver&&) noexcept;

  /// Over one step, in batches of neighbours in the span; drives have been through prepare. A batch that fails is done again cell by cell; cells that
  /// still fail keep their state, the first of them is returned. Laws: PowerLawBranch, BergstroemBoyce.
  template <class Law, class Drive>
  [[nodiscard]] std::optional<BatchFailure>
  solve(const Law& law, std::span<const Drive> drives, std::span<BranchState> states);

  [[nodiscard]] const BatchCounts& counts() const;
  void reset_counts();

private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace ballast
