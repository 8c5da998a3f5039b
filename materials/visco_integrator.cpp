#include "materials/visco_integrator.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ballast {

TissueIntegrator::TissueIntegrator(const TissueOptions& options) : options_(options), solver_(options.cvode) {
  if (options.substeps < 1 || options.substeps > 8 || !std::has_single_bit(static_cast<unsigned>(options.substeps))) {
    throw Error("viscoelastic substeps must be 1, 2, 4 or 8");
  }
}

TissueCounts TissueIntegrator::counts() const {
  TissueCounts all = counts_;
  all.cvode = solver_.counts();
  return all;
}

void TissueIntegrator::reset_counts() {
  counts_ = {};
  solver_.reset_counts();
}

void add(TissueCounts& to, const TissueCounts& more) {
  for (std::size_t q = 0; q < to.fast.size(); ++q) {
    to.fast[q] += more.fast[q];
  }
  to.over += more.over;
  to.no_number += more.no_number;
  to.stiff += more.stiff;
  to.worst_estimate = std::max(to.worst_estimate, more.worst_estimate);
  to.cvode.batches += more.cvode.batches;
  to.cvode.cells += more.cvode.cells;
  to.cvode.steps += more.cvode.steps;
  to.cvode.rates += more.cvode.rates;
  to.cvode.solves += more.cvode.solves;
  to.cvode.failures += more.cvode.failures;
  to.cvode.seconds += more.cvode.seconds;
  to.seconds += more.seconds;
}

void TissueIntegrator::size_for(std::size_t cells) {
  if (states_.size() < cells) {
    states_.resize(cells);
    work_.resize(cells);
    turns_.resize(cells);
    strains_.resize(cells);
  }
}

/// The state becomes the best fast result where that is a number.
template <class Law, class Drive> TissueIntegrator::Fast TissueIntegrator::try_fast(const Law& law, const Drive& drive, std::size_t i) {
  const Sym start = states_[i].y;
  const bool estimated = options_.path != BranchPath::fixed;
  int n = estimated ? 1 : options_.substeps;
  FastStep step = fast_step(law, drive, start, n);
  double before = 0;
  double estimate = estimated ? elastic_number(law, drive, start) : 0;
  if (estimate > 0.1 * options_.tolerance) {
    estimate = std::max(estimate, 2 * options_.tolerance);
  }
  while (!(estimate <= options_.tolerance) && 2 * n <= options_.substeps) {
    n *= 2;
    const FastStep finer = fast_step(law, drive, start, n);
    const double scale = std::max(error_scale(law, finer.state.y), error_scale(law, start));
    // What is left of a geometric series of changes; of the first its ratio is not known: 1/2. A change that is small by
    // chance (the error changes sign) counts as a sixteenth of the one before.
    const double change = std::max(norm(combine(1, finer.state.y, -1, step.state.y)) / scale, before / 16);
    const double ratio = before > 0 ? std::clamp(change / before, 0.25, 0.75) : 0.5;
    estimate = change * ratio / (1 - ratio);
    before = change;
    step = finer;
  }
  if (!std::isfinite(contract(step.state.y, step.state.y) + step.state.dissipated)) {
    ++counts_.over;
    return Fast::no_number;
  }
  states_[i] = step.state;
  work_[i] = step.work;
  if (!(estimate <= options_.tolerance)) {
    ++counts_.over;
    return Fast::over;
  }
  ++counts_.fast[static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(n)))];
  counts_.worst_estimate = std::max(counts_.worst_estimate, estimate);
  return Fast::accepted;
}

namespace {
std::vector<PowerLawDrive>& chosen(std::vector<PowerLawDrive>& power, std::vector<BoyceDrive>&, const PowerLawBranch&) { return power; }
std::vector<BoyceDrive>& chosen(std::vector<PowerLawDrive>&, std::vector<BoyceDrive>& boyce, const BergstroemBoyce&) { return boyce; }
} // namespace

/// Integrates the cells of stiff_ and gives each the work that balances its energies.
template <class Law, class Drive>
std::optional<BatchFailure> TissueIntegrator::solve_stiff(const Law& law, std::span<const Drive> drives) {
  std::vector<Drive>& gathered = chosen(stiff_power_, stiff_boyce_, law);
  gathered.clear();
  for (const std::size_t i : stiff_) {
    gathered.push_back(drives[i]);
    prepare(gathered.back());
  }
  counts_.stiff += static_cast<long>(stiff_.size());
  std::optional<BatchFailure> failure = solver_.solve(law, std::span<const Drive>(gathered), std::span(stiff_states_));
  for (std::size_t k = 0; k < stiff_.size(); ++k) {
    const std::size_t i = stiff_[k];
    const double start = stored_energy(law, states_[i].y);
    states_[i] = stiff_states_[k];
    work_[i] = stored_energy(law, states_[i].y) - start + states_[i].dissipated;
  }
  if (failure) {
    failure->cell = static_cast<int>(stiff_[static_cast<std::size_t>(failure->cell)]);
  }
  return failure;
}

/// states_ from the start of the step to its end, with the dissipation and the work.
template <class Law, class Drive>
std::optional<BatchFailure> TissueIntegrator::advance_branch(const Law& law, std::span<const Drive> drives) {
  stiff_.clear();
  stiff_states_.clear();
  std::optional<BatchFailure> failure;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const BranchState start = states_[i];
    const Fast fast = options_.path == BranchPath::cvode ? Fast::over : try_fast(law, drives[i], i);
    if (fast == Fast::accepted) {
      continue;
    }
    if (options_.path == BranchPath::mixed || options_.path == BranchPath::cvode) {
      states_[i] = start;
      stiff_.push_back(i);
      stiff_states_.push_back(start);
    } else if (fast == Fast::no_number) {
      ++counts_.no_number;
      failure = failure ? failure : BatchFailure{static_cast<int>(i), 0, 0, start.y};
    }
  }
  return stiff_.empty() ? failure : solve_stiff(law, drives);
}

std::optional<TissueFailure> TissueIntegrator::advance(const PowerLawZener& m, const ViscoRow& row) {
  const auto cells = static_cast<std::size_t>(row.cells);
  size_for(cells);
  std::vector<PowerLawDrive>& drives = power_drives_;
  drives.resize(cells);
  for (std::size_t i = 0; i < cells; ++i) { // the long-term spring
    const Mat g = gradient_dt(row, i);
    turns_[i] = half_rotation(g);
    strains_[i] = deviator(symmetric_part(g));
    const Sym before = push(turns_[i], load_sym(row, 0, i));
    const Sym after = push(turns_[i], combine(1, before, 2 * m.long_shear, strains_[i]));
    store_sym(row, 0, i, after);
    const double stored = m.long_shear > 0 ? contract(after, after) / (4 * m.long_shear) : 0;
    const double work = contract(before, strains_[i]) + m.long_shear * contract(strains_[i], strains_[i]);
    store_result(row, i, after, stored, 0, work);
  }
  std::optional<TissueFailure> first;
  for (std::size_t b = 0; b < m.branches; ++b) {
    const PowerLawBranch& law = m.branch[b];
    for (std::size_t i = 0; i < cells; ++i) {
      drives[i] = {scaled(2 * law.shear, strains_[i]), row.dt};
      states_[i] = {push(turns_[i], load_sym(row, 6 * (b + 1), i)), 0};
      work_[i] = 0;
    }
    const auto failure = advance_branch(law, std::span<const PowerLawDrive>(drives));
    if (failure && !first) {
      first = TissueFailure{failure->cell, b, failure->reason, failure->reached, failure->state};
    }
    for (std::size_t i = 0; i < cells; ++i) {
      const Sym after = push(turns_[i], states_[i].y);
      store_sym(row, 6 * (b + 1), i, after);
      for (std::size_t a = 0; a < 6; ++a) {
        row.stress[a][i] += after[a] / row.volume_ratio[i];
      }
      row.stored[i] += stored_energy(law, after);
      row.dissipated[i] += states_[i].dissipated;
      row.work[i] += work_[i];
    }
  }
  return first;
}

std::optional<TissueFailure> TissueIntegrator::advance(const BergstroemBoyce& m, const ViscoRow& row) {
  const auto cells = static_cast<std::size_t>(row.cells);
  size_for(cells);
  boyce_drives_.resize(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    boyce_drives_[i] = {without_trace(path_exponent(gradient_dt(row, i))), unimodular(load_sym(row, 0, i)), row.dt};
    states_[i] = {unimodular(load_sym(row, 6, i)), 0};
    work_[i] = 0;
  }
  const auto failure = advance_branch(m, std::span<const BoyceDrive>(boyce_drives_));
  for (std::size_t i = 0; i < cells; ++i) {
    const BoyceDrive& drive = boyce_drives_[i];
    const Sym total = unimodular(push(exponential(drive.path), drive.total));
    const Sym elastic = unimodular(states_[i].y);
    store_sym(row, 0, i, total);
    store_sym(row, 6, i, elastic);
    const double energy = spring_energy(m.a, trace(total));
    const Sym stress = combine(spring_modulus(m.a, trace(total)).value,
                               deviator(total),
                               spring_modulus(m.b, trace(elastic)).value,
                               deviator(elastic));
    store_result(row, i, stress, energy + stored_energy(m, elastic), states_[i].dissipated,
                 energy - spring_energy(m.a, trace(drive.total)) + work_[i]);
  }
  if (failure) {
    return TissueFailure{failure->cell, 0, failure->reason, failure->reached, failure->state};
  }
  if (const int lost = first_without_number(row); lost >= 0) { // network A has no flow: nothing but its own chains stops it
    ++counts_.no_number;
    const auto i = static_cast<std::size_t>(lost);
    const Sym total = load_sym(row, 0, i);
    const bool locked = !std::isfinite(spring_modulus(m.a, trace(total)).value);
    return TissueFailure{lost, locked ? 1UL : 0UL, 0, 1, locked ? total : load_sym(row, 6, i)};
  }
  return std::nullopt;
}

} // namespace ballast
