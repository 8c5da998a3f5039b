#include "ale/layers/layer_forces.hpp"

#include "ale/layers/layer_edges.hpp"
#include "ale/layers/layer_erosion.hpp"
#include "ale/layers/layer_guard.hpp"
#include "ale/layers/layer_rows.hpp"
#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace ballast {
namespace {

using namespace layer_element;

constexpr double crushed_volume = 1.0 / 20;

/// Constants of the law that the element needs beside the law.
template <int Dim> struct LawAtRest {
  FabricStress response;
  double relief = 0;                       ///< dE33 by d(E11 + E22) without stress through the thickness
  std::array<double, 2> lost = {};         ///< strain at which a family is lost
  std::array<double, Count<Dim>::quadratic> stiffness = {}, damping = {}; ///< Pa; Pa s/m
  std::array<double, 3> held = {}; ///< Pa: wave moduli of the held modes at rest
  double guard = 0;                ///< Pa
  double wave33 = 0;               ///< m/s: through the thickness at rest
  bool open_apart = false;         ///< no stress where it is thicker than at rest: plies that are apart do not meet
};

FabricStress response_at_rest(const FabricModel& model) {
  FabricState fresh;
  return std::visit([&fresh](const auto& law) { return evaluate(law, FabricTensor{}, fresh); }, model);
}

template <int Dim> LawAtRest<Dim> law_at_rest(const LayerStack<Dim>& s) {
  constexpr double never = std::numeric_limits<double>::infinity();
  LawAtRest<Dim> law;
  law.response = response_at_rest(s.model);
  law.lost = {never, never};
  if (const auto* fabric = std::get_if<RaftenbergFabric>(&s.model)) {
    law.lost = {fabric->warp.rupture + fabric->warp.unload, fabric->fill.rupture + fabric->fill.unload};
  } else {
    const double nu = std::get<HookeSolid>(s.model).poisson;
    law.relief = -nu / (1 - nu);
  }
  if (Dim == 2 && !s.axisymmetric) {
    law.lost[1] = std::min(law.lost[1], 0.0); // no fill in a plane: warp decides alone
  }
  const FabricTensor& C = law.response.tangent;
  const double through = std::max(C[2], std::min(C[0], C[1])), kappa = s.hourglass.stiffness;
  law.held = {kappa * C[0] / 3, kappa * C[1] / 3, kappa * through / 3};
  law.guard = through;
  law.wave33 = std::sqrt(C[2] / s.density);
  law.open_apart = std::holds_alternative<RaftenbergFabric>(s.model);
  constexpr std::size_t count = Count<Dim>::quadratic;
  std::array<double, count> modulus, share; // share: mean square over the element of what the mode varies by
  if constexpr (Dim == 3) {
    modulus = {C[0], C[1], C[5], C[4], through, through, C[0], C[1], through};
    share = {1. / 3, 1. / 3, 1. / 3, 1. / 3, 1. / 3, 1. / 3, 1. / 9, 1. / 9, 1. / 9};
  } else {
    modulus = {through};
    share = {1. / 3};
  }
  for (std::size_t k = 0; k < count; ++k) {
    law.stiffness[k] = kappa * modulus[k] * share[k];
    law.damping[k] = s.hourglass.viscosity * std::sqrt(s.density * modulus[k]) * share[k];
  }
  return law;
}

/// Work arrays of one row of elements.
template <int Dim> struct RowScratch {
  explicit RowScratch(int n) : count(static_cast<std::size_t>(n)), store(count * (28 + 2 * corners)) {
    double* next = store.data();
    const auto take = [&next, n](auto& pointers) {
      for (auto& p : pointers) {
        p = next;
        next += n;
      }
    };
    take(strain[0]), take(in_plane_up), take(stress[0]), take(stress[1]);
    take(wave[0]), take(wave[1]);
    strain[1] = {in_plane_up[0], in_plane_up[1], in_plane_up[2], in_plane_up[3], strain[0][4], strain[0][5]};
    for (auto* side : {&low, &high}) {
      for (auto& row : *side) {
        take(row);
      }
    }
  }
  static constexpr std::size_t corners = Count<Dim>::rows * Dim;
  std::size_t count;
  std::vector<double> store;
  std::array<std::array<double*, 6>, 2> strain, stress; ///< [point], in the law's order
  std::array<double*, 4> in_plane_up;                   ///< 11, 22, 33, 12
  std::array<std::array<double*, 3>, 2> wave;
  NodeRows<Dim, double*> low, high; ///< corner forces
};

/// What a row reports.
struct RowReport {
  long crushed = 0, turned = 0;
  int bad = 0; ///< elements whose stress is not finite
};

void add(RowReport& to, const RowReport& part) {
  to.crushed += part.crushed, to.turned += part.turned, to.bad += part.bad;
}

template <int Dim> struct ElementRow {
  LayerStack<Dim>& s;
  const LawAtRest<Dim>& law;
  RowScratch<Dim>& w;
  RowSizes sizes;
  std::size_t first; ///< element
  NodeRows<Dim, double*> x, v;
  std::array<double*, Count<Dim>::strains> Q_out;
  std::array<double*, Count<Dim>::hourglass> H_out;
};

template <int Dim> long find_strains(const ElementRow<Dim>& row) {
  constexpr bool three = Dim == 3;
  const RowSizes sizes = row.sizes;
  const auto x = row.x;
  const auto low = row.w.strain[0], up = row.w.strain[1];
  const char* alive = row.s.alive.data() + row.first;
  const double relief = 0.5 * row.law.relief;
  int crushed = 0;
#pragma GCC ivdep
  for (int i = 0; i < sizes.count; ++i) {
    const Gradients a = sizes.gradients(i, three);
    const Modes<Dim> c = modes_at(x, i);
    Strains<Dim> E = strains(c, a);
    const bool there = alive[i] != 0;
    crushed += there && volume_ratio(c, a) < crushed_volume ? 1 : 0;
    for (double& e : E) {
      e = there ? e : 0.0;
    }
    const double vary = relief * ((E[s11_up] - E[s11_low]) + (E[s22_up] - E[s22_low]));
    low[0][i] = E[s11_low], up[0][i] = E[s11_up];
    low[1][i] = E[s22_low], up[1][i] = E[s22_up];
    constexpr std::size_t at33 = three ? static_cast<std::size_t>(s33) : static_cast<std::size_t>(e33), at13 = three ? static_cast<std::size_t>(s13) : static_cast<std::size_t>(e13);
    low[2][i] = E[at33] - vary, up[2][i] = E[at33] + vary;
    if constexpr (three) {
      low[3][i] = 0.5 * E[s12_low], up[3][i] = 0.5 * E[s12_up];
      low[4][i] = 0.5 * E[s23];
    } else {
      low[3][i] = up[3][i] = low[4][i] = 0.0;
    }
    low[5][i] = 0.5 * E[at13];
  }
  return crushed;
}

/// Rates of extension, smoothed over rate_time.
template <int Dim> void find_rates(const ElementRow<Dim>& row, double dt) {
  const double part = row.s.rate_time > dt ? dt / row.s.rate_time : 1.0;
  for (std::size_t point = 0; point < 2; ++point) {
    double* const warp = row.s.rate[point][0].data() + row.first;
    double* const fill = row.s.rate[point][1].data() + row.first;
    for (int i = 0; i < row.sizes.count; ++i) {
      const Strains<Dim> rate = strain_form(modes_at(row.x, i), modes_at(row.v, i), row.sizes.gradients(i, Dim == 3));
      warp[i] += part * (rate[s11_low + point] - warp[i]);
      fill[i] += part * (rate[s22_low + point] - fill[i]);
    }
  }
}

template <int Dim> void find_stress(const ElementRow<Dim>& row) {
  for (std::size_t point = 0; point < 2; ++point) {
    FabricRows r;
    r.count = row.sizes.count;
    for (std::size_t k = 0; k < 6; ++k) {
      r.strain[k] = row.w.strain[point][k];
      r.stress[k] = row.w.stress[point][k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      r.wave_modulus[k] = row.w.wave[point][k];
    }
    for (std::size_t family = 0; family < 2; ++family) {
      r.largest[family] = row.s.largest[point][family].data() + row.first;
      if (!row.s.rate[point][family].empty()) {
        r.extension_rate[family] = row.s.rate[point][family].data() + row.first;
      }
    }
    evaluate(row.s.model, r);
  }
}

/// Stresses of the strains that do work, times the volume.
template <int Dim> [[gnu::always_inline]] inline Strains<Dim> work_stress(const RowScratch<Dim>& w, int i, double V) {
  const auto both = [&](std::size_t k) __attribute__((always_inline)) { return V * (0.5 * (w.stress[0][k][i] + w.stress[1][k][i])); };
  const auto at = [&](std::size_t point, std::size_t k) __attribute__((always_inline)) { return V * (0.5 * w.stress[point][k][i]); };
  if constexpr (Dim == 3) {
    return {at(0, 0), at(1, 0), at(0, 1), at(1, 1), at(0, 3), at(1, 3), both(2), both(4), both(5)};
  } else {
    return {at(0, 0), at(1, 0), at(0, 1), at(1, 1), both(2), both(5)};
  }
}

struct CornerReport {
  int bad = 0, turned = 0;
};

template <int Dim> CornerReport find_corner_forces(const ElementRow<Dim>& row) {
  constexpr bool three = Dim == 3;
  const RowSizes sizes = row.sizes;
  const LawAtRest<Dim> law = row.law;
  const RowScratch<Dim>& w = row.w;
  const auto x = row.x, v = row.v;
  const auto low = w.low, high = w.high;
  const char* alive = row.s.alive.data() + row.first;
  const auto Q_out = row.Q_out;
  const auto H_out = row.H_out;
  const double h3 = 2 / sizes.a3, h2 = three ? 2 / sizes.a2 : 0.0, least = row.s.guard.volume;
  const auto wave = w.wave[0]; // the faster point's is found here
  const auto wave_up = w.wave[1];
  const double quadratic = row.s.viscosity.quadratic, linear = row.s.viscosity.linear, density = row.s.density;
  double* shock = row.s.shock_volume.data() + row.first;
  constexpr std::size_t at33 = three ? static_cast<std::size_t>(s33) : static_cast<std::size_t>(e33);
  int bad = 0, turned = 0;
#pragma GCC ivdep
  for (int i = 0; i < sizes.count; ++i) {
    const Gradients a = sizes.gradients(i, three);
    const Modes<Dim> c = modes_at(x, i), c_rate = modes_at(v, i);
    const double V = alive[i] != 0 ? sizes.volume(i) : 0.0; // an eroded element has strain 0, hence finite stress
    Strains<Dim> Q = work_stress<Dim>(w, i, V);
    double total = 0;
#pragma GCC unroll 9
    for (std::size_t k = 0; k < Q.size(); ++k) {
      total += Q[k];
      Q_out[k][i] = Q[k];
    }
    bad += std::abs(total) < std::numeric_limits<double>::infinity() ? 0 : 1;
    const double pressing = s33_rate(c, c_rate, a), thickness = std::sqrt(stretch_square(c, a, 2)); // dE33/dt; lambda
    const double meeting = pressing < 0 && (thickness < 1 || !law.open_apart) ? -pressing * h3 / std::max(thickness, lost_volume) : 0.0;
    const double speed = quadratic * meeting + linear * law.wave33;
    shock[i] = -V * density * meeting * speed / std::max(thickness, lost_volume);
    Q[at33] += shock[i];
    Hourglass<Dim> H = hourglass_form(c, c, a);
    const Hourglass<Dim> rate = hourglass_form(c, c_rate, a);
#pragma GCC unroll 9
    for (std::size_t k = 0; k < Count<Dim>::quadratic; ++k) {
      const double h = three && (k == 0 || k == 6) ? 2 / a.a1 : three && (k == 1 || k == 7) ? h2 : h3;
      H[k] = V * (0.5 * law.stiffness[k] * H[k] + law.damping[k] * h * rate[k]);
    }
    const double J0 = H[Count<Dim>::quadratic] / Dim, J1 = H[Count<Dim>::quadratic + 1] / Dim;
    H[Count<Dim>::quadratic] = 0.5 * V * guard_slope(J0, least) * law.guard;
    H[Count<Dim>::quadratic + 1] = 0.5 * V * guard_slope(J1, least) * law.guard;
    turned += V > 0 && (J0 <= 0 || J1 <= 0) ? 1 : 0;
    const std::array<double, 3> stiffer = guard_waves<Dim>(c, a, J0, J1, least);
    for (std::size_t k = 0; k < 3; ++k) {
      wave[k][i] = std::max(std::max(wave[k][i], wave_up[k][i]), law.held[k] * stretch_square(c, a, k)) + law.guard * stiffer[k];
    }
    const double damped = (meeting > 0 ? speed : 0.0) + std::sqrt((meeting > 0 ? speed * speed : 0.0) + wave[2][i] / density);
    wave[2][i] = density * damped * damped;
#pragma GCC unroll 11
    for (std::size_t k = 0; k < H.size(); ++k) {
      H_out[k][i] = H[k];
    }
    Modes<Dim> p = {};
    pull_strains(Q, c, a, p);
    pull_hourglass(H, c, a, p);
    corner_forces(p, low, high, i);
  }
  return {bad, turned};
}

/// Largest stable step of each element: sum over the axes of c^2/h^2, c of the faster point, held modes and guard.
template <int Dim> void find_steps(const ElementRow<Dim>& row) {
  const RowSizes sizes = row.sizes;
  const auto& wave = row.w.wave[0];
  const char* alive = row.s.alive.data() + row.first;
  const double* lightest = row.s.at_rest.lightest.data();
  double* out = row.s.wave_step.data() + row.first;
  const double quarter = 0.25 / row.s.density;
#pragma GCC ivdep
  for (int i = 0; i < sizes.count; ++i) {
    const Gradients a = sizes.gradients(i, Dim == 3);
    const double squares = wave[0][i] * a.a1 * a.a1 + wave[1][i] * a.a2 * a.a2 + wave[2][i] * a.a3 * a.a3;
    const double step = 1 / std::sqrt(quarter * lightest[i] * std::max(squares, 1e-200)); // slack without shear: no limit
    out[i] = alive[i] != 0 ? step : std::numeric_limits<double>::infinity();
  }
}

template <int Dim> void gather(const ElementRow<Dim>& row, int j, int level) {
  const NodeRows<Dim, double*> force = node_rows(row.s, row.s.force, j, level);
  for (std::size_t r = 0; r < force.size(); ++r) {
    for (std::size_t d = 0; d < Dim; ++d) {
      double* f = force[r][d];
      const double *low = row.w.low[r][d], *high = row.w.high[r][d];
#pragma omp simd
      for (int i = 0; i < row.sizes.count; ++i) {
        f[i] += low[i];
      }
#pragma omp simd
      for (int i = 0; i < row.sizes.count; ++i) {
        f[i + 1] += high[i];
      }
    }
  }
}

/// Elements pressed to less than the guard's `torn`, or with a surface inside out, count as past every rupture: the next step erodes them.
template <int Dim> void tear(const ElementRow<Dim>& row) {
  constexpr double past = 1e9; // Green strain
  for (int i = 0; i < row.sizes.count; ++i) {
    const Gradients a = row.sizes.gradients(i, Dim == 3);
    const Modes<Dim> c = modes_at(row.x, i);
    const Hourglass<Dim> H = hourglass_form(c, c, a);
    const double J0 = H[Count<Dim>::quadratic] / Dim, J1 = H[Count<Dim>::quadratic + 1] / Dim;
    const std::size_t e = row.first + static_cast<std::size_t>(i);
    if (row.s.alive[e] != 0 && (volume_ratio(c, a) < row.s.guard.torn || J0 <= 0 || J1 <= 0)) {
      for (auto& point : row.s.largest) {
        for (auto& family : point) {
          family[e] = past;
        }
      }
    }
  }
}

template <int Dim> RowReport update_row(LayerStack<Dim>& s, const LawAtRest<Dim>& law, RowScratch<Dim>& scratch, int j, int level, double dt) {
  const ElementRow<Dim> row{s, law, scratch, row_sizes(s, j, level), s.element(0, j, level), node_rows(s, s.position, j, level), node_rows(s, s.velocity, j, level),
                            element_rows<Count<Dim>::strains>(s, s.stress_volume, j, level), element_rows<Count<Dim>::hourglass>(s, s.hourglass_volume, j, level)};
  RowReport report;
  report.crushed = find_strains(row);
  if (!s.rate[0][0].empty()) {
    find_rates(row, dt);
  }
  find_stress(row);
  const CornerReport corners = find_corner_forces(row);
  report.bad = corners.bad, report.turned = corners.turned;
  find_steps(row);
  gather(row, j, level);
  if (s.guard.torn > 0) {
    tear(row);
  }
  return report;
}

template <int Dim> [[noreturn]] void fail(const LayerStack<Dim>& s) {
  for (int level = 0; level < s.grid.levels(); ++level) {
    for (int j = 0; j < s.grid.elements[1]; ++j) {
      for (int i = 0; i < s.grid.elements[0]; ++i) {
        double total = 0;
        for (const double* stress : element_rows<Count<Dim>::strains>(s, s.stress_volume, j, level)) {
          total += stress[i];
        }
        if (!std::isfinite(total)) {
          throw NumericalFailure(fmt::format("{}: layer {}, element ({}, {}) of level {}: its stress is not finite; it is pressed to nothing or its nodes ran away", s.name, level / s.grid.through, i, j, level));
        }
      }
    }
  }
  throw NumericalFailure(fmt::format("{}: a stress is not finite", s.name));
}

} // namespace

template <int Dim> void update_forces(LayerStack<Dim>& s, double dt, LayerLedger& ledger, ThreadPool& pool) {
  for (auto& component : s.force) {
    std::fill(component.begin(), component.end(), 0.0);
  }
  const LawAtRest<Dim> law = law_at_rest(s);
  erode(s, law.lost, ledger);
  std::vector<RowReport> reports(static_cast<std::size_t>(pool.size()));
  // Rows of one colour share no node; colours follow each other in order, so each node's sum has one order.
  const int across = Dim == 3 ? 2 : 1;
  for (int colour = 0; colour < 2 * across; ++colour) {
    const int odd_level = colour / across, odd_j = colour % across;
    const int levels = (s.grid.levels() + 1 - odd_level) / 2, js = Dim == 3 ? (s.grid.elements[1] + 1 - odd_j) / 2 : 1;
    parallel_ranges(pool, levels * js, [&](int begin, int end, int thread) {
      RowScratch<Dim> scratch(s.grid.elements[0]);
      RowReport& sum = reports[static_cast<std::size_t>(thread)];
      for (int row = begin; row < end; ++row) {
        const RowReport r = update_row(s, law, scratch, row % js * across + odd_j, row / js * 2 + odd_level, dt);
        add(sum, r);
      }
    });
  }
  RowReport all;
  for (const RowReport& r : reports) {
    add(all, r);
  }
  ledger.crushed += all.crushed;
  ledger.turned_over += all.turned;
  if (all.bad > 0) {
    fail(s);
  }
  add_edge_forces(s);
}

template void update_forces<2>(LayerStack<2>&, double, LayerLedger&, ThreadPool&);
template void update_forces<3>(LayerStack<3>&, double, LayerLedger&, ThreadPool&);

} // namespace ballast
