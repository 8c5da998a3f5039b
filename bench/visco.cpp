// Speed against error of viscoelastic material points (docs/viscoelasticity.md): CVODE by tolerance and batch, the fast
// path by substeps, and their mix; then which of the models need CVODE at all, by time step. Not a timed test: run it on
// a quiet machine.
//   ballast_bench_visco [cells, a multiple of 256 [steps]]
#include "materials/visco_fung.hpp"
#include "materials/visco_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

using namespace ballast;

constexpr std::size_t row_cells = 256;

/// Rows of one material at rest.
struct Rows {
  std::vector<std::vector<double>> values;
  std::vector<ViscoRow> rows;
  std::size_t states;

  template <class Law> Rows(const Law& law, std::size_t cells) : states(state_count(law)) {
    std::vector<double> rest(states);
    set_rest(law, rest);
    values.assign(9 + states + 6 + 4, std::vector<double>(cells, 1.0));
    for (std::size_t a = 0; a < states; ++a) {
      std::fill(values[9 + a].begin(), values[9 + a].end(), rest[a]);
    }
    for (std::size_t at = 0; at < cells; at += row_cells) {
      ViscoRow row;
      row.cells = static_cast<int>(row_cells);
      for (std::size_t a = 0; a < 9; ++a) {
        row.gradient[a] = &values[a][at];
      }
      for (std::size_t a = 0; a < states; ++a) {
        row.state[a] = &values[9 + a][at];
      }
      for (std::size_t a = 0; a < 6; ++a) {
        row.stress[a] = &values[9 + states + a][at];
      }
      row.volume_ratio = &values[15 + states][at];
      row.stored = &values[16 + states][at];
      row.dissipated = &values[17 + states][at];
      row.work = &values[18 + states][at];
      rows.push_back(row);
    }
  }
  [[nodiscard]] Sym stress(std::size_t cell) const {
    Sym s;
    for (std::size_t a = 0; a < 6; ++a) {
      s[a] = values[9 + states + a][cell];
    }
    return s;
  }
};

/// A front passes: each cell is loaded within a quarter of the steps, from its own moment on, then unloaded to a half.
/// Strains from 1e-4 to `largest`, in their own directions, with as much turning.
void set_gradients(Rows& r, std::size_t cells, int step, int steps, double dt, double largest) {
  for (std::size_t i = 0; i < cells; ++i) {
    const double x = static_cast<double>(i), phase = step - 0.4 * steps * (0.5 + 0.5 * std::sin(2.1 * x));
    const double load = phase >= 0 && phase < 0.25 * steps ? 4.0 / steps : phase >= 0.5 * steps && phase < 0.75 * steps ? -2.0 / steps : 0;
    const double rate = load * largest * std::pow(10, -4 * (0.5 + 0.5 * std::sin(0.37 * x))) / dt;
    const double a = rate * std::cos(x), b = rate * std::sin(x);
    const double g[9] = {a, 1.5 * b, 0, -0.5 * b, -0.5 * a, b, 0.3 * a, 0, -0.5 * a};
    for (std::size_t c = 0; c < 9; ++c) {
      r.values[c][i] = g[c];
    }
  }
}

struct Result {
  double microseconds = 0; ///< a cell-step
  std::vector<Sym> stress; ///< of every cell after every step
  TissueCounts counts;
};

struct Case {
  std::size_t cells = 0;
  int steps = 0;
  double dt = 0;      ///< s
  double largest = 0; ///< strain
};

template <class Law> Result run(const Law& law, const Case& c, const TissueOptions& options) {
  Rows r(law, c.cells);
  TissueIntegrator integrator(options);
  Result result;
  double seconds = 0;
  for (int k = 0; k < c.steps; ++k) {
    set_gradients(r, c.cells, k, c.steps, c.dt, c.largest);
    const std::clock_t start = std::clock(); // this process's own time: others may be busy
    for (ViscoRow& row : r.rows) {
      row.dt = c.dt;
      if (integrator.advance(law, row)) {
        std::printf("a cell failed\n");
      }
    }
    seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    for (std::size_t i = 0; i < c.cells; ++i) {
      result.stress.push_back(r.stress(i));
    }
  }
  result.microseconds = 1e6 * seconds / (static_cast<double>(c.cells) * c.steps);
  result.counts = integrator.counts();
  return result;
}

/// The fastest of three.
template <class Law> Result best(const Law& law, const Case& c, const TissueOptions& options) {
  Result result = run(law, c, options);
  for (int again = 0; again < 2; ++again) {
    result.microseconds = std::min(result.microseconds, run(law, c, options).microseconds);
  }
  return result;
}

/// Largest and root mean square, over the stress of each, at least a hundredth of the largest there is.
void print_errors(const Result& got, const Result& exact) {
  double largest = 0, worst = 0, sum = 0;
  for (const Sym& s : exact.stress) {
    largest = std::max(largest, norm(s));
  }
  for (std::size_t i = 0; i < got.stress.size(); ++i) {
    const double e = norm(combine(1, got.stress[i], -1, exact.stress[i])) / std::max(norm(exact.stress[i]), 0.01 * largest);
    worst = std::max(worst, e);
    sum += e * e;
  }
  std::printf("%9.1e %9.1e %10.3f", std::sqrt(sum / static_cast<double>(got.stress.size())), worst, got.microseconds);
}

TissueOptions options_of(BranchPath path, int substeps, double tolerance, double cvode, int batch) {
  TissueOptions o;
  o.path = path;
  o.substeps = substeps;
  o.tolerance = tolerance;
  o.cvode = {cvode, batch};
  return o;
}

template <class Law> void speed_against_error(const char* name, const Law& law, const Case& c) {
  std::printf("\n%s: %zu cells, %d steps of %g s, strains to %g\n%-28s %9s %9s %10s  CVODE steps a batch, cells by CVODE\n",
              name, c.cells, c.steps, c.dt, c.largest, "", "rms", "worst", "us/cell");
  const Result exact = run(law, c, options_of(BranchPath::cvode, 1, 1, 1e-10, 1));
  for (const int batch : {1, 16, 64, 256}) {
    for (const double rtol : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      const Result got = best(law, c, options_of(BranchPath::cvode, 1, 1, rtol, batch));
      std::printf("cvode %.0e batch %-10d ", rtol, batch);
      print_errors(got, exact);
      std::printf("  %.1f\n", static_cast<double>(got.counts.cvode.steps) / static_cast<double>(got.counts.cvode.batches));
    }
  }
  for (const int n : {1, 2, 4, 8}) {
    std::printf("fast, %d substeps            ", n);
    print_errors(best(law, c, options_of(BranchPath::fixed, n, 1, 1e-4, 64)), exact);
    std::printf("\n");
  }
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const Result got = best(law, c, options_of(BranchPath::mixed, 8, tolerance, 0.1 * tolerance, 64));
    std::printf("mixed, tolerance %.0e       ", tolerance);
    print_errors(got, exact);
    const auto& f = got.counts.fast;
    const double share = 100 / static_cast<double>(got.counts.stiff + f[0] + f[1] + f[2] + f[3]);
    std::printf("  %.2f %%; 1, 2, 4, 8 substeps: %.1f, %.1f, %.1f, %.1f %%\n",
                share * static_cast<double>(got.counts.stiff),
                share * static_cast<double>(f[0]),
                share * static_cast<double>(f[1]),
                share * static_cast<double>(f[2]),
                share * static_cast<double>(f[3]));
  }
}

/// us a cell-step of a law that needs no integrator.
template <class Law> void time_linear(const char* name, const Law& law, std::size_t cells) {
  Rows r(law, cells);
  set_gradients(r, cells, 0, 4, 1e-7, 1e-6);
  const int steps = 200;
  double seconds = 1e30;
  for (int again = 0; again < 3; ++again) {
    const std::clock_t start = std::clock();
    for (int k = 0; k < steps; ++k) {
      for (ViscoRow& row : r.rows) {
        row.dt = 1e-7;
        advance(law, row);
      }
    }
    seconds = std::min(seconds, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::printf("%s: %.3f us a cell-step\n", name, 1e6 * seconds / (steps * static_cast<double>(cells)));
}

/// Cell-branch-steps in which no number of substeps up to 8 meets the tolerance, by dt and largest strain.
template <class Law> void who_needs_cvode(const char* name, const Law& law, std::size_t cells, int steps, double tolerance) {
  std::printf("%-34s", name);
  for (const double dt : {2e-8, 1e-7, 1e-6, 1e-5}) {
    for (const double largest : {0.05, 0.5}) {
      const Result got = run(law, {cells, steps, dt, largest}, options_of(BranchPath::adaptive, 8, tolerance, 1e-4, 64));
      const auto& f = got.counts.fast;
      std::printf(" %6ld", got.counts.over);
      if (largest > 0.1 && dt > 9e-6) {
        std::printf("  of %ld", got.counts.over + f[0] + f[1] + f[2] + f[3]);
      }
    }
  }
  std::printf("\n");
}

} // namespace

int main(int argc, char** argv) {
  const std::size_t cells = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) / row_cells * row_cells : 256;
  const int steps = argc > 2 ? std::atoi(argv[2]) : 24;
  const PowerLawZener pair{1e4, 2, {{{1e6, 2e-9, 1e5, 3}, {1e6, 1e-6, 1e5, 3}}}};
  const PowerLawZener gelatin4{5e3, 1, {{{1e6, 1e-4, 1e5, 4}}}}, gelatin2{5e3, 1, {{{1e6, 1e-3, 1e5, 2}}}};
  const BergstroemBoyce table{{20000}, {100000}, 1, 0.05, -0.5, 20000, 4};
  const BergstroemBoyce brain{{300}, {1500}, 1e-4, 0.05, -0.6, 20, 4};
  speed_against_error("power law, tau0 2 ns and 1 us, m 3", pair, {cells, steps, 2e-8, 0.3});
  speed_against_error("Bergstroem-Boyce of the tables", table, {cells, steps, 1e-3, 0.5});
  std::printf("\n");
  time_linear("Prony, three branches", Prony{1e4, 3, {{{4e4, 1e-2}, {2e5, 1e-4}, {1e6, 2e-6}}}}, cells);
  time_linear("Fung, three branches", FungQlv{1e6, 5, 3, {{{0.3, 1e-2}, {0.3, 1e-4}, {0.3, 2e-6}}}}, cells);
  for (const double tolerance : {1e-3, 1e-5}) {
    std::printf("\ncell-branch-steps over %g with 8 substeps: dt 2e-8, 1e-7, 1e-6, 1e-5 s, each with strains to 0.05 and to 0.5 in %d steps\n",
                tolerance,
                steps / 4);
    who_needs_cvode("gelatin, power law, m 4, 0.1 ms", gelatin4, cells, steps, tolerance);
    who_needs_cvode("gelatin, power law, m 2, 1 ms", gelatin2, cells, steps, tolerance);
    who_needs_cvode("brain, Bergstroem-Boyce", brain, cells, steps, tolerance);
    who_needs_cvode("tissue, Bergstroem-Boyce (tables)", table, cells, steps, tolerance);
    who_needs_cvode("power law, 2 ns and 1 us, m 3", pair, cells, steps, tolerance);
  }
  return 0;
}
