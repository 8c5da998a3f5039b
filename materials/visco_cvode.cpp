#include "materials/visco_cvode.hpp"

#include "core/error.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <vector>

namespace ballast {

namespace {

constexpr std::size_t width = 7; // variables a cell; the last, the dissipation, follows from the others
static_assert(sizeof(BranchState) == width * sizeof(double));

/// A law over the cells of a batch, without its type.
struct System {
  const void* law = nullptr;
  const void* drives = nullptr;
  std::size_t cells = 0; ///< the rest of the vector is padding, at rest
  void (*rate)(const System&, std::size_t cell, double s, const double* y, double* out) = nullptr;
  void (*jacobian)(const System&, std::size_t cell, double s, const double* y, BranchJacobian& out) = nullptr;
  double (*scale)(const System&, const double* y) = nullptr;
};

template <class Law, class Drive> System system_of(const Law& law, const Drive* drives, std::size_t cells) {
  System system{&law, drives, cells};
  const auto law_of = [](const System& s) -> const Law& { return *static_cast<const Law*>(s.law); };
  static constexpr auto drive_of = [](const System& s, std::size_t c) -> const Drive& { return static_cast<const Drive*>(s.drives)[c]; };
  static constexpr auto get = law_of;
  system.rate = [](const System& s, std::size_t c, double t, const double* y, double* out) {
    ballast::rate(get(s), drive_of(s, c), t, y, out);
  };
  system.jacobian = [](const System& s, std::size_t c, double t, const double* y, BranchJacobian& out) {
    ballast::jacobian(get(s), drive_of(s, c), t, y, out);
  };
  system.scale = [](const System& s, const double* y) { return error_scale(get(s), y); };
  return system;
}

/// Relative tolerance and system: what CVODE's callbacks are given.
struct Job {
  System system;
  double tolerance = 0;
  void* cvode = nullptr;
};

int rate_callback(realtype s, N_Vector y, N_Vector out, void* user) {
  const System& system = static_cast<Job*>(user)->system;
  const double* from = N_VGetArrayPointer(y);
  double* to = N_VGetArrayPointer(out);
  std::fill_n(to + width * system.cells, static_cast<std::size_t>(N_VGetLength(out)) - width * system.cells, 0.0);
  double sum = 0;
  for (std::size_t c = 0; c < system.cells; ++c) {
    system.rate(system, c, s, from + width * c, to + width * c);
    sum += to[width * c + 6];
  }
  return std::isfinite(sum) ? 0 : 1; // 1: CVODE tries a smaller step
}

int weight_callback(N_Vector y, N_Vector weight, void* user) {
  const Job& job = *static_cast<Job*>(user);
  const double* from = N_VGetArrayPointer(y);
  double* to = N_VGetArrayPointer(weight);
  std::fill_n(to, N_VGetLength(weight), 1.0);
  for (std::size_t c = 0; c < job.system.cells; ++c) {
    std::fill_n(to + width * c, 6, 1 / (job.tolerance * job.system.scale(job.system, from + width * c)));
  }
  return 0;
}

/// In place of the mean over all variables: the worst cell's.
double worst_cell_norm(N_Vector v, N_Vector weight) {
  const double* x = N_VGetArrayPointer(v);
  const double* w = N_VGetArrayPointer(weight);
  double worst = 0;
  for (std::size_t at = 0; at < static_cast<std::size_t>(N_VGetLength(v)); at += width) {
    double sum = 0;
    for (std::size_t a = at; a < at + 6; ++a) {
      sum += x[a] * w[a] * x[a] * w[a];
    }
    worst = sum <= worst ? worst : sum; // NaN gets through
  }
  return std::sqrt(worst / 6);
}

/// x of (1 - gamma J) x = b for one cell: Gaussian elimination with row pivots, then the seventh.
bool solve_cell(double gamma, const BranchJacobian& j, const double* b, double* x) {
  std::array<double, 42> m;
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < 6; ++c) {
      m[7 * r + c] = (r == c ? 1 : 0) - gamma * j[6 * r + c];
    }
    m[7 * r + 6] = b[r];
  }
  for (std::size_t k = 0; k < 6; ++k) {
    std::size_t best = k;
    for (std::size_t r = k + 1; r < 6; ++r) {
      best = std::abs(m[7 * r + k]) > std::abs(m[7 * best + k]) ? r : best;
    }
    if (!(std::abs(m[7 * best + k]) > 0)) {
      return false;
    }
    if (best != k) {
      std::swap_ranges(&m[7 * k], &m[7 * k] + 7, &m[7 * best]);
    }
    for (std::size_t r = k + 1; r < 6; ++r) {
      const double factor = m[7 * r + k] / m[7 * k + k];
      for (std::size_t c = k + 1; c < 7; ++c) {
        m[7 * r + c] -= factor * m[7 * k + c];
      }
    }
  }
  double heat = b[6];
  for (std::size_t k = 6; k-- > 0;) {
    double sum = m[7 * k + 6];
    for (std::size_t c = k + 1; c < 6; ++c) {
      sum -= m[7 * k + c] * x[c];
    }
    x[k] = sum / m[7 * k + k];
    heat += gamma * j[36 + k] * x[k];
  }
  x[6] = heat;
  return true;
}

int block_solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  const Job& job = *static_cast<Job*>(solver->content);
  realtype s = 0, gamma = 0, rl1 = 0;
  N_Vector predicted = nullptr, y = nullptr, f = nullptr, zn1 = nullptr;
  void* user = nullptr;
  if (CVodeGetNonlinearSystemData(job.cvode, &s, &predicted, &y, &f, &gamma, &rl1, &zn1, &user) != CV_SUCCESS) {
    return -1;
  }
  const double* state = N_VGetArrayPointer(y);
  const double* right = N_VGetArrayPointer(b);
  double* left = N_VGetArrayPointer(x);
  BranchJacobian j;
  for (std::size_t c = 0; c < job.system.cells; ++c) {
    job.system.jacobian(job.system, c, s, state + width * c, j);
    if (!solve_cell(gamma, j, right + width * c, left + width * c)) {
      return 1;
    }
  }
  const std::size_t used = width * job.system.cells;
  std::copy(right + used, right + N_VGetLength(b), left + used);
  return 0;
}

int free_solver(SUNLinearSolver solver) {
  solver->content = nullptr; // ours
  SUNLinSolFreeEmpty(solver);
  return 0;
}

SUNLinearSolver_Type solver_type(SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_EMBEDDED; }

void stay_silent(int, const char*, const char*, char*, void*) {} // failures are returned

/// CVODE for one number of cells, over a buffer of its own.
class Batch {
public:
  Batch(SUNContext context, std::size_t cells, double tolerance) : storage_(width * cells) {
    job_.tolerance = tolerance;
    y_ = N_VMake_Serial(static_cast<sunindextype>(storage_.size()), storage_.data(), context);
    y_->ops->nvwrmsnorm = worst_cell_norm;
    cvode_ = CVodeCreate(CV_BDF, context);
    job_.cvode = cvode_;
    CVodeSetErrHandlerFn(cvode_, stay_silent, nullptr);
    CVodeInit(cvode_, rate_callback, 0.0, y_);
    CVodeWFtolerances(cvode_, weight_callback);
    CVodeSetUserData(cvode_, &job_);
    CVodeSetMaxNumSteps(cvode_, 5000);
    solver_ = SUNLinSolNewEmpty(context);
    solver_->content = &job_;
    solver_->ops->gettype = solver_type;
    solver_->ops->solve = block_solve;
    solver_->ops->free = free_solver;
    if (CVodeSetLinearSolver(cvode_, solver_, nullptr) != CV_SUCCESS) {
      throw Error("SUNDIALS refuses the block solver");
    }
  }
  ~Batch() {
    CVodeFree(&cvode_);
    SUNLinSolFree(solver_);
    N_VDestroy(y_);
  }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// CVODE's flag; the states change only on success.
  int run(const System& system, BranchState* states, BatchCounts& counts, double& reached) {
    job_.system = system;
    for (std::size_t c = 0; c < system.cells; ++c) {
      std::copy_n(states[c].y.data(), 6, &storage_[width * c]);
      storage_[width * c + 6] = 0;
    }
    std::fill(storage_.begin() + static_cast<std::ptrdiff_t>(width * system.cells), storage_.end(), 0.0);
    CVodeReInit(cvode_, 0.0, y_);
    CVodeSetStopTime(cvode_, 1.0);
    const int flag = CVode(cvode_, 1.0, y_, &reached, CV_NORMAL);
    long steps = 0, rates = 0, solves = 0;
    CVodeGetNumSteps(cvode_, &steps);
    CVodeGetNumRhsEvals(cvode_, &rates);
    CVodeGetNumNonlinSolvIters(cvode_, &solves);
    counts.steps += steps;
    counts.rates += rates;
    counts.solves += solves;
    ++counts.batches;
    if (flag >= 0) {
      for (std::size_t c = 0; c < system.cells; ++c) {
        std::copy_n(&storage_[width * c], 6, states[c].y.data());
        states[c].dissipated = storage_[width * c + 6];
      }
    }
    return flag;
  }
  [[nodiscard]] Sym state(std::size_t cell) const {
    Sym s;
    std::copy_n(&storage_[width * cell], 6, s.begin());
    return s;
  }

private:
  std::vector<double> storage_;
  Job job_;
  N_Vector y_ = nullptr;
  void* cvode_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

} // namespace

struct BatchSolver::Impl {
  BatchOptions options;
  BatchCounts counts;
  SUNContext context = nullptr;
  std::array<std::unique_ptr<Batch>, 13> sizes; ///< 1, 2, 4, ... cells

  ~Impl() {
    for (auto& size : sizes) {
      size.reset();
    }
    SUNContext_Free(&context);
  }
  Batch& batch_for(std::size_t cells) {
    const auto k = static_cast<std::size_t>(std::bit_width(cells - 1));
    if (!sizes[k]) {
      sizes[k] = std::make_unique<Batch>(context, std::size_t{1} << k, options.tolerance);
    }
    return *sizes[k];
  }
};

BatchSolver::BatchSolver(const BatchOptions& options) : impl_(std::make_unique<Impl>()) {
  if (!(options.tolerance > 0 && options.tolerance < 1) || options.batch < 1 || options.batch > 4096) {
    throw Error("viscoelastic batches: tolerance must be in (0, 1), cells in [1, 4096]");
  }
  impl_->options = options;
  if (SUNContext_Create(nullptr, &impl_->context) != 0) {
    throw Error("SUNDIALS gives no context");
  }
}
BatchSolver::~BatchSolver() = default;
BatchSolver::BatchSolver(BatchSolver&&) noexcept = default;
BatchSolver& BatchSolver::operator=(BatchSolver&&) noexcept = default;

const BatchCounts& BatchSolver::counts() const { return impl_->counts; }

template <class Law, class Drive>
std::optional<BatchFailure> BatchSolver::solve(const Law& law, std::span<const Drive> drives, std::span<BranchState> states) {
  const auto start = std::chrono::steady_clock::now();
  BatchCounts& counts = impl_->counts;
  std::optional<BatchFailure> first;
  const auto singly = [&](std::size_t cell) {
    double reached = 0;
    Batch& one = impl_->batch_for(1);
    const int flag = one.run(system_of(law, &drives[cell], 1), &states[cell], counts, reached);
    if (flag < 0) {
      ++counts.failures;
      first = first ? first : BatchFailure{static_cast<int>(cell), flag, reached, one.state(0)};
    }
  };
  const auto most = static_cast<std::size_t>(impl_->options.batch);
  for (std::size_t at = 0; at < states.size(); at += most) {
    const std::size_t cells = std::min(most, states.size() - at);
    counts.cells += static_cast<long>(cells);
    double reached = 0;
    Batch& batch = impl_->batch_for(cells);
    if (batch.run(system_of(law, &drives[at], cells), &states[at], counts, reached) < 0) {
      for (std::size_t c = at; c < at + cells; ++c) {
        singly(c);
      }
    }
  }
  counts.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return first;
}

template std::optional<BatchFailure>
BatchSolver::solve(const PowerLawBranch&, std::span<const PowerLawDrive>, std::span<BranchState>);
template std::optional<BatchFailure>
BatchSolver::solve(const BergstroemBoyce&, std::span<const BoyceDrive>, std::span<BranchState>);

} // namespace ballast
