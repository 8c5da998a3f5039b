#include "materials/visco_prony.hpp"

#include <algorithm>

namespace ballast {

namespace {

/// The long-term spring is a branch that does not relax.
struct Step {
  double shear, x;
  Relaxation relaxation;
};

struct Steps {
  std::size_t count = 0;
  std::array<Step, most_visco_branches + 1> at{};
};

Steps steps_of(const Prony& m, double dt) {
  Steps steps;
  steps.at[steps.count++] = {m.long_shear, 0, relaxation(0)};
  for (std::size_t b = 0; b < m.branches; ++b) {
    const double x = dt / m.branch[b].time;
    steps.at[steps.count++] = {m.branch[b].shear, x, relaxation(x)};
  }
  return steps;
}

} // namespace

std::size_t state_count(const Prony& m) { return 6 * (m.branches + 1); }

std::vector<std::string> state_names(const Prony& m) {
  std::vector<std::string> names;
  append_tensor_names(names, "prony_long");
  for (std::size_t b = 0; b < m.branches; ++b) {
    append_tensor_names(names, "prony_" + std::to_string(b + 1));
  }
  return names;
}

void set_rest(const Prony& m, std::span<double> state) { std::fill_n(state.begin(), state_count(m), 0.0); }

double instant_shear(const Prony& m) {
  double sum = m.long_shear;
  for (std::size_t b = 0; b < m.branches; ++b) {
    sum += m.branch[b].shear;
  }
  return sum;
}

void advance(const Prony& m, const ViscoRow& row) {
  const Steps steps = steps_of(m, row.dt);
  for (std::size_t i = 0; i < static_cast<std::size_t>(row.cells); ++i) {
    const Mat g = gradient_dt(row, i), turn = half_rotation(g);
    const Sym strain = deviator(symmetric_part(g));
    Sym total{};
    double stored = 0, dissipated = 0, work = 0;
    for (std::size_t b = 0; b < steps.count; ++b) {
      const Step& step = steps.at[b];
      if (step.shear == 0) {
        continue;
      }
      const Sym before = push(turn, load_sym(row, 6 * b, i));
      const Relaxed end = relax_branch(before, scaled(2 * step.shear, strain), step.shear, step.x, step.relaxation);
      const Sym after = push(turn, end.stress);
      store_sym(row, 6 * b, i, after);
      total = combine(1, total, 1, after);
      stored += contract(after, after) / (4 * step.shear);
      dissipated += end.dissipated;
      work += end.work;
    }
    store_result(row, i, total, stored, dissipated, work);
  }
}

} // namespace ballast
