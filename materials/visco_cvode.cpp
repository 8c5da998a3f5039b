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
  void (*rate)(const System&, std::size_t cell, double s, const Sym& v, Sym& out, double& heat) = nullptr;
  void (*jacobian)(const System&, std::size_t cell, double s, const Sym& v, BranchJacobian& out) = nullptr;
  Sym (*enter)(const System&, std::size_t cell, const Sym& y) = nullptr;
  Sym (*leave)(const System&, std::size_t cell, double s, const Sym& v) = nullptr;
  double (*scale)(const System&, const Sym& y) = nullptr;
};

template <class Law, class Drive> struct Typed {
  static const Law& law(const System& s) { return *static_cast<const Law*>(s.law); }
  static const Drive& drive(const System& s, std::size_t cell) { return static_cast<const Drive*>(s.drives)[cell]; }
  static void rate(const System& s, std::size_t c, double t, const Sym& v, Sym& out, double& heat) {
    ballast::rate(law(s), drive(s, c), t, v, out, heat);
  }
  static void jacobian(const System& s, std::size_t c, double t, const Sym& v, BranchJacobian& out) {
    ballast::jacobian(law(s), drive(s, c), t, v, out);
  }
  static Sym enter(const System& s, std::size_t c, const Sym& y) { return to_variables(drive(s, c), y); }
  static Sym leave(const System& s, std::size_t c, double t, const Sym& v) { return from_variables(drive(s, c), t, v); }
  static double scale(const System& s, const Sym& y) { return error_scale(law(s), y); }
};

template <class Law, class Drive> System system_of(const Law& law, const Drive* drives, std::size_t cells) {
  using T = Typed<Law, Drive>;
  return {&law, drives, cells, T::rate, T::jacobian, T::enter, T::leave, T::scale};
}

Sym load(const double* x) { return {x[0], x[1], x[2], x[3], x[4], x[5]}; }

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
    Sym rate;
    system.rate(system, c, s, load(from + width * c), rate, to[width * c + 6]);
    std::copy_n(rate.data(), 6, to + width * c);
    for (std::size_t a = width * c; a < width * (c + 1); ++a) {
      sum += to[a];
    }
  }
  return std::isfinite(sum) ? 0 : 1; // 1: CVODE tries a smaller step
}

int weight_callback(N_Vector y, N_Vector weight, void* user) {
  const Job& job = *static_cast<Job*>(user);
  const double* from = N_VGetArrayPointer(y);
  double* to = N_VGetArrayPointer(weight);
  double s = 0;
  CVodeGetCurrentTime(job.cvode, &s);
  std::fill_n(to, N_VGetLength(weight), 1.0);
  for (std::size_t c = 0; c < job.system.cells; ++c) {
    const Sym state = job.system.leave(job.system, c, s, load(from + width * c));
    std::fill_n(to + width * c, 6, 1 / (job.tolerance * job.system.scale(job.system, state)));
  }
  return 0;
}

/// In place of the mean over all variables: the worst cell's.
double norm_callback(N_Vector v, N_Vector weight) {
  const auto size = static_cast<std::size_t>(N_VGetLength(v));
  return worst_cell_norm({N_VGetArrayPointer(v), size}, {N_VGetArrayPointer(weight), size});
}

double dot(const Sym& a, const Sym& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4] + a[5] * b[5];
}

/// x of (1 - gamma J) x = b for one cell: d x = b + gamma (left_0 z_0 + left_1 z_1), z_k = right_k x, two by two
/// (Woodbury); then the seventh.
bool solve_cell(double gamma, const BranchJacobian& j, const double* b, double* x) {
  const Sym right = load(b);
  const double d = 1 / (1 - gamma * j.diagonal), g = gamma * d;
  const double a00 = 1 - g * dot(j.right[0], j.left[0]), a01 = -g * dot(j.right[0], j.left[1]);
  const double a10 = -g * dot(j.right[1], j.left[0]), a11 = 1 - g * dot(j.right[1], j.left[1]);
  const double r0 = d * dot(j.right[0], right), r1 = d * dot(j.right[1], right), det = a00 * a11 - a01 * a10;
  if (!(std::abs(det) > 1e-14 * (std::abs(a00 * a11) + std::abs(a01 * a10)))) {
    return false;
  }
  const double z0 = (r0 * a11 - r1 * a01) / det, z1 = (r1 * a00 - r0 * a10) / det;
  const Sym solution = combine(d, right, g, combine(z0, j.left[0], z1, j.left[1]));
  std::copy_n(solution.data(), 6, x);
  x[6] = b[6] + gamma * dot(j.heat, solution);
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
    job.system.jacobian(job.system, c, s, load(state + width * c), j);
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
  Batch(SUNContext context, std::size_t cells, const BatchOptions& options) : storage_(width * cells) {
    job_.tolerance = options.tolerance;
    y_ = N_VMake_Serial(static_cast<sunindextype>(storage_.size()), storage_.data(), context);
    y_->ops->nvwrmsnorm = norm_callback;
    cvode_ = CVodeCreate(CV_BDF, context);
    job_.cvode = cvode_;
    CVodeSetErrHandlerFn(cvode_, stay_silent, nullptr);
    CVodeInit(cvode_, rate_callback, 0.0, y_);
    CVodeWFtolerances(cvode_, weight_callback);
    CVodeSetUserData(cvode_, &job_);
    CVodeSetMaxNumSteps(cvode_, options.most_steps);
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
      const Sym v = system.enter(system, c, states[c].y);
      std::copy_n(v.data(), 6, &storage_[width * c]);
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
        states[c] = {system.leave(system, c, 1, load(&storage_[width * c])), storage_[width * c + 6]};
      }
    }
    return flag;
  }
  /// Where a failed run stopped.
  [[nodiscard]] Sym state(std::size_t cell, double reached) const {
    return job_.system.leave(job_.system, cell, reached, load(&storage_[width * cell]));
  }

private:
  std::vector<double> storage_;
  Job job_;
  N_Vector y_ = nullptr;
  void* cvode_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
};

} // namespace

double worst_cell_norm(std::span<const double> values, std::span<const double> weights) {
  double worst = 0;
  for (std::size_t at = 0; at < values.size(); at += width) {
    double sum = 0;
    for (std::size_t a = at; a < at + 6; ++a) {
      sum += values[a] * weights[a] * values[a] * weights[a];
    }
    if (sum != sum) {
      return sum; // std::max would drop it
    }
    worst = std::max(worst, sum);
  }
  return std::sqrt(worst / 6);
}

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
      sizes[k] = std::make_unique<Batch>(context, std::size_t{1} << k, options);
    }
    return *sizes[k];
  }
};

BatchSolver::BatchSolver(const BatchOptions& options) : impl_(std::make_unique<Impl>()) {
  if (!(options.tolerance > 0 && options.tolerance < 1) || options.batch < 1 || options.batch > 4096 || options.most_steps < 1) {
    throw Error("viscoelastic batches: tolerance must be in (0, 1), cells in [1, 4096], steps at least 1");
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
void BatchSolver::reset_counts() { impl_->counts = {}; }

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
      first = first ? first : BatchFailure{static_cast<int>(cell), flag, reached, one.state(0, reached)};
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
