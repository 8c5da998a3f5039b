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

constexpr int chunk_cells = 64;

/// Of the cells from `at` on: half rotations, strain increments, and sums over branches.
struct Chunk {
  const ViscoRow* row = nullptr;
  int at = 0;
  double turn[9][chunk_cells], strain[6][chunk_cells], stress[6][chunk_cells];
  double stored[chunk_cells], dissipated[chunk_cells], work[chunk_cells];
};

[[gnu::always_inline]] inline void start_cell(Chunk& c, int i) {
  const Mat g = gradient_dt(*c.row, static_cast<std::size_t>(c.at + i)), turn = half_rotation(g);
  const Sym strain = deviator(symmetric_part(g));
  for (std::size_t a = 0; a < 9; ++a) {
    c.turn[a][i] = turn[a];
  }
  for (std::size_t a = 0; a < 6; ++a) {
    c.strain[a][i] = strain[a];
    c.stress[a][i] = 0;
  }
  c.stored[i] = c.dissipated[i] = c.work[i] = 0;
}

[[gnu::always_inline]] inline void relax_cell(Chunk& c, const Step& step, double* const* state, int i) {
  const Mat turn{c.turn[0][i], c.turn[1][i], c.turn[2][i], c.turn[3][i], c.turn[4][i], c.turn[5][i], c.turn[6][i], c.turn[7][i], c.turn[8][i]};
  const Sym strain{c.strain[0][i], c.strain[1][i], c.strain[2][i], c.strain[3][i], c.strain[4][i], c.strain[5][i]};
  const Sym start{state[0][i], state[1][i], state[2][i], state[3][i], state[4][i], state[5][i]};
  const Relaxed end = relax_branch(push(turn, start), scaled(2 * step.shear, strain), step.shear, step.x, step.relaxation);
  const Sym after = push(turn, end.stress);
  for (std::size_t a = 0; a < 6; ++a) {
    state[a][i] = after[a];
    c.stress[a][i] += after[a];
  }
  c.stored[i] += contract(after, after) / (4 * step.shear);
  c.dissipated[i] += end.dissipated;
  c.work[i] += end.work;
}

void relax_cells(Chunk& c, const Step& step, std::size_t first, int count) {
  double* state[6];
  for (std::size_t a = 0; a < 6; ++a) {
    state[a] = c.row->state[first + a] + c.at;
  }
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    relax_cell(c, step, state, i);
  }
}

[[gnu::always_inline]] inline void finish_cell(const Chunk& c, int i) {
  const Sym stress{c.stress[0][i], c.stress[1][i], c.stress[2][i], c.stress[3][i], c.stress[4][i], c.stress[5][i]};
  store_result(*c.row, static_cast<std::size_t>(c.at + i), stress, c.stored[i], c.dissipated[i], c.work[i]);
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
  Chunk chunk;
  for (int at = 0; at < row.cells; at += chunk_cells) {
    const int count = std::min(chunk_cells, row.cells - at);
    chunk.row = &row;
    chunk.at = at;
#pragma omp simd
    for (int i = 0; i < count; ++i) {
      start_cell(chunk, i);
    }
    for (std::size_t b = 0; b < steps.count; ++b) {
      if (steps.at[b].shear > 0) {
        relax_cells(chunk, steps.at[b], 6 * b, count);
      }
    }
#pragma omp simd
    for (int i = 0; i < count; ++i) {
      finish_cell(chunk, i);
    }
  }
}

} // namespace ballast
