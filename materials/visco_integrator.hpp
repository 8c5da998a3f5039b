// One step of a row of tissue: each nonlinear branch by the fast path where its own error estimate allows, else by CVODE.
//
// Estimate: the change from n/2 to n exponential substeps, n = 2, 4, 8, by the law's error_scale, extrapolated by the ratio
// of the last two changes (1/4 where the step is resolved, more where it is stiff). Cells that relax by less than a tenth
// of the tolerance take one substep. Errors are relative to the larger of |s| at the step's ends. What no n brings below
// the tolerance goes to CVODE together with its like in the row (mixed), or is counted (adaptive).
#pragma once

#include "materials/visco_cvode.hpp"
#include "materials/visco_prony.hpp"

#include <array>
#include <vector>

namespace ballast {

enum class BranchPath {
  fixed,    ///< `substeps` exponential substeps, no estimate
  adaptive, ///< as many as the tolerance needs, up to `substeps`; cells beyond it are counted, and stay
  mixed,    ///< adaptive, cells beyond it by CVODE
  cvode     ///< every cell by CVODE
};

struct TissueOptions {
  BranchPath path = BranchPath::mixed;
  int substeps = 8;         ///< 1, 2, 4 or 8
  double tolerance = 1e-3;  ///< of the fast path's estimate
  BatchOptions cvode{};
};

/// Cell-branch-steps.
struct TissueCounts {
  std::array<long, 4> fast{}; ///< accepted after 1, 2, 4, 8 substeps
  long over = 0;              ///< the fast path's estimate is above the tolerance (or no number)
  long no_number = 0;         ///< fails without CVODE: of those, or a network A beyond its lock
  long stiff = 0;             ///< integrated by CVODE
  double worst_estimate = 0;  ///< of accepted cells
  BatchCounts cvode{};
  double seconds = 0; ///< of all threads: rows of tissue from fields to fields, CVODE's part included
};

/// Sums; the larger worst estimate.
void add(TissueCounts& to, const TissueCounts& more);

struct TissueFailure {
  int cell = 0; ///< of the row
  std::size_t branch = 0; ///< Bergstroem-Boyce: 0 network B, 1 network A (its chains beyond their lock)
  int reason = 0;     ///< CVODE's flag; 0: no number
  double reached = 0; ///< of the step
  Sym state{};        ///< there
};

/// Owned by one thread. The result depends on the row alone, not on what the object did before.
class TissueIntegrator {
public:
  explicit TissueIntegrator(const TissueOptions& options);

  /// One step; Prony rows need no integrator. Bergstroem-Boyce tensors are made unimodular first (a remap mixes them).
  /// A branch of a cell that fails neither strains nor relaxes (it may have turned) and is counted; the first is returned. The row's other
  /// cells and branches have moved on by then: who takes the step again keeps a copy (ale/step_undo).
  [[nodiscard]] std::optional<TissueFailure> advance(const PowerLawZener& m, const ViscoRow& row);
  [[nodiscard]] std::optional<TissueFailure> advance(const BergstroemBoyce& m, const ViscoRow& row);

  [[nodiscard]] TissueCounts counts() const;
  void reset_counts();

private:
  template <class Law, class Drive>
  std::optional<BatchFailure> advance_branch(const Law& law, std::span<const Drive> drives);
  enum class Fast { accepted, over, no_number };
  template <class Law, class Drive> Fast try_fast(const Law& law, const Drive& drive, std::size_t i);
  template <class Law, class Drive>
  std::optional<BatchFailure> solve_stiff(const Law& law, std::span<const Drive> drives);
  void size_for(std::size_t cells);

  TissueOptions options_;
  TissueCounts counts_;
  BatchSolver solver_;
  // Of the branch at hand, by cell of the row; what goes to CVODE.
  std::vector<BranchState> states_;
  std::vector<double> work_;
  std::vector<Mat> turns_;
  std::vector<Sym> strains_;
  std::vector<PowerLawDrive> power_drives_, stiff_power_;
  std::vector<BoyceDrive> boyce_drives_, stiff_boyce_;
  std::vector<std::size_t> stiff_;
  std::vector<BranchState> stiff_states_;
};

} // namespace ballast
