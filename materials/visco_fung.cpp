#include "materials/visco_fung.hpp"

#include "materials/visco_flow.hpp"

#include <algorithm>

namespace ballast {

namespace {

/// w exp(w) = z for z >= 0.
double lambert(double z) {
  double w = z < 1 ? z / (1 + z) : std::log(1 + z);
  for (int it = 0; it < 30; ++it) {
    const double change = (w - z * std::exp(-w)) / (1 + w); // Newton on w - z exp(-w), scaled by its slope at the root
    w -= change;
    if (std::abs(change) <= 1e-15 * w) {
      break;
    }
  }
  return w;
}

/// Largest q:e - W(e): the dual of W, J/m3.
double dual_energy(const FungQlv& m, const Sym& q) {
  const Sym e = strain_of(m, q);
  return contract(q, e) - elastic_energy(m, e);
}

struct Ends {
  Sym strain_n, strain, elastic_n, elastic;
};

/// Of one branch, per share g_i.
struct BranchStep {
  Sym q;
  double stored, dissipated, work, floored;
};

BranchStep step_branch(const FungQlv& m, const Ends& ends, const Sym& q_n, double x) {
  const Weights w = weights(x);
  const Sym q = combine(w.keep, q_n, 1, combine(w.start, ends.elastic_n, w.end, ends.elastic));
  const Relaxation r = relaxation(x);
  const Sym change = combine(1, q, -1, q_n), climb = combine(1, ends.strain, -1, ends.strain_n);
  const Sym mean = combine(1, combine(1 - x * r.first, q_n, x * r.first, ends.elastic_n), // of q over the step
                           0.5 - r.first, combine(1, ends.elastic, -1, ends.elastic_n));
  const double dual_n = dual_energy(m, q_n), dual = dual_energy(m, q);
  const double energy_n = elastic_energy(m, ends.strain_n), energy = elastic_energy(m, ends.strain);
  const double heat = contract(climb, combine(1, q, -1, mean)) + contract(ends.strain_n, change) - (dual - dual_n);
  // Where a step is so stiff that the curvature within it makes heat negative, the work takes what is missing: second order, and the balance holds.
  const double missing = std::max(0.0, -heat);
  return {q, energy + dual - contract(q, ends.strain), heat + missing, energy - energy_n - contract(mean, climb) + missing, missing};
}

} // namespace

std::size_t state_count(const FungQlv& m) { return 6 * (m.branches + 1); }

std::vector<std::string> state_names(const FungQlv& m) {
  std::vector<std::string> names;
  append_tensor_names(names, "fung_strain");
  for (std::size_t b = 0; b < m.branches; ++b) {
    append_tensor_names(names, "fung_" + std::to_string(b + 1));
  }
  return names;
}

void set_rest(const FungQlv& m, std::span<double> state) { std::fill_n(state.begin(), state_count(m), 0.0); }

double instant_shear(const FungQlv& m) { return m.shear; }

Sym elastic_stress(const FungQlv& m, const Sym& strain) {
  return scaled(2 * m.shear * std::exp(m.stiffening * contract(strain, strain)), strain);
}

double elastic_energy(const FungQlv& m, const Sym& strain) {
  const double square = contract(strain, strain);
  return m.shear * (m.stiffening > 0 ? std::expm1(m.stiffening * square) / m.stiffening : square);
}

// With r = |e|: r^2 exp(2 a r^2) = (|s|/2 G0)^2.
Sym strain_of(const FungQlv& m, const Sym& stress) {
  const double z = 2 * m.stiffening * contract(stress, stress) / (4 * m.shear * m.shear);
  return scaled(std::exp(-0.5 * lambert(z)) / (2 * m.shear), stress);
}

void advance(const FungQlv& m, const ViscoRow& row) {
  double lasting = 1;
  for (std::size_t b = 0; b < m.branches; ++b) {
    lasting -= m.branch[b].share;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(row.cells); ++i) {
    const Mat g = gradient_dt(row, i), turn = half_rotation(g);
    Ends ends;
    ends.strain_n = push(turn, load_sym(row, 0, i));
    ends.strain = combine(1, ends.strain_n, 1, deviator(symmetric_part(g)));
    ends.elastic_n = elastic_stress(m, ends.strain_n);
    ends.elastic = elastic_stress(m, ends.strain);
    store_sym(row, 0, i, push(turn, ends.strain));
    Sym total = ends.elastic;
    const double energy = elastic_energy(m, ends.strain);
    double stored = lasting * energy, dissipated = 0, floored = 0, work = lasting * (energy - elastic_energy(m, ends.strain_n));
    for (std::size_t b = 0; b < m.branches; ++b) {
      const double share = m.branch[b].share;
      const BranchStep end = step_branch(m, ends, push(turn, load_sym(row, 6 * (b + 1), i)), row.dt / m.branch[b].time);
      store_sym(row, 6 * (b + 1), i, push(turn, end.q));
      total = combine(1, total, -share, end.q);
      stored += share * end.stored;
      dissipated += share * end.dissipated;
      work += share * end.work;
      floored += share * end.floored;
    }
    store_result(row, i, push(turn, total), stored, dissipated, work);
    if (row.floored != nullptr) {
      row.floored[i] = floored;
    }
  }
}

} // namespace ballast
