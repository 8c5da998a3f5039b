#include "ale/strength_update.hpp"

#include "ale/phases.hpp"
#include "ale/tissue_update.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ballast {

namespace {

constexpr int chunk = 64; // cells whose trial stress is kept at hand

/// Has it a yield surface to return to?
template <class Model> constexpr bool flows = !std::is_same_v<Model, NoStrength> && !std::is_same_v<Model, Viscoelastic>;

/// von Mises equivalent stress sqrt(3/2 s:s) of deviator components.
double equivalent(const double* s, std::integral_constant<int, 2>) {
  const double zz = -s[0] - s[1];
  return std::sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + zz * zz + 2 * s[2] * s[2]));
}
double equivalent(const double* s, std::integral_constant<int, 3>) {
  const double zz = -s[0] - s[1];
  return std::sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + zz * zz + 2 * (s[2] * s[2] + s[3] * s[3] + s[4] * s[4])));
}

/// Shear moduli of a chunk of cells: one for all, or a row.
struct OneShear {
  double value;
  [[gnu::always_inline]] double operator()(int) const { return value; }
};
struct ShearRow {
  const double* value;
  [[gnu::always_inline]] double operator()(int i) const { return value[i]; }
};

/// Rotated stress plus elastic increment, for cells [0, count) from `at` on.
template <class Shear>
void trial(const Shear shear_at, int at, int count, const StressRows<2>& rows, double (*out)[chunk]) {
  const double *gxx = rows.gradient[0] + at, *gxy = rows.gradient[1] + at, *gyx = rows.gradient[2] + at,
               *gyy = rows.gradient[3] + at, *gtt = rows.gradient[4] + at;
  const double *sxx = rows.stress[0] + at, *syy = rows.stress[1] + at, *sxy = rows.stress[2] + at;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double w = 0.5 * (gxy[i] - gyx[i]), d = 1 / (1 + 0.25 * w * w);
    const double c = (1 - 0.25 * w * w) * d, s = w * d;
    const double xx = c * c * sxx[i] + 2 * c * s * sxy[i] + s * s * syy[i];
    const double yy = s * s * sxx[i] - 2 * c * s * sxy[i] + c * c * syy[i];
    const double xy = (c * c - s * s) * sxy[i] + c * s * (syy[i] - sxx[i]);
    const double mean = (gxx[i] + gyy[i] + gtt[i]) / 3, shear = shear_at(i);
    out[0][i] = xx + 2 * shear * (gxx[i] - mean);
    out[1][i] = yy + 2 * shear * (gyy[i] - mean);
    out[2][i] = xy + shear * (gxy[i] + gyx[i]);
  }
}

template <class Shear>
void trial(const Shear shear_at, int at, int count, const StressRows<3>& rows, double (*out)[chunk]) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double shear = shear_at(i);
    double g[9];
#pragma GCC unroll 9
    for (int q = 0; q < 9; ++q) {
      g[q] = rows.gradient[q][at + i];
    }
    const double s[9] = {rows.stress[0][at + i], rows.stress[2][at + i], rows.stress[4][at + i],
                         rows.stress[2][at + i], rows.stress[1][at + i], rows.stress[3][at + i],
                         rows.stress[4][at + i], rows.stress[3][at + i],
                         -rows.stress[0][at + i] - rows.stress[1][at + i]};
    // Q = I + 2/(1 + q.q) ([q] + [q]^2), q half the axial vector of the spin times dt.
    const double qx = 0.25 * (g[7] - g[5]), qy = 0.25 * (g[2] - g[6]), qz = 0.25 * (g[3] - g[1]);
    const double qq = qx * qx + qy * qy + qz * qz, f = 2 / (1 + qq);
    const double R[9] = {1 + f * (qx * qx - qq), f * (qx * qy - qz), f * (qx * qz + qy),
                         f * (qx * qy + qz), 1 + f * (qy * qy - qq), f * (qy * qz - qx),
                         f * (qx * qz - qy), f * (qy * qz + qx), 1 + f * (qz * qz - qq)};
    double rs[9], t[9];
#pragma GCC unroll 3
    for (int a = 0; a < 3; ++a) {
#pragma GCC unroll 3
      for (int b = 0; b < 3; ++b) {
        rs[3 * a + b] = R[3 * a] * s[b] + R[3 * a + 1] * s[3 + b] + R[3 * a + 2] * s[6 + b];
      }
    }
#pragma GCC unroll 3
    for (int a = 0; a < 3; ++a) {
#pragma GCC unroll 3
      for (int b = 0; b < 3; ++b) {
        t[3 * a + b] = rs[3 * a] * R[3 * b] + rs[3 * a + 1] * R[3 * b + 1] + rs[3 * a + 2] * R[3 * b + 2];
      }
    }
    const double mean = (g[0] + g[4] + g[8]) / 3;
    out[0][i] = t[0] + 2 * shear * (g[0] - mean);
    out[1][i] = t[4] + 2 * shear * (g[4] - mean);
    out[2][i] = t[1] + shear * (g[1] + g[3]);
    out[3][i] = t[5] + shear * (g[5] + g[7]);
    out[4][i] = t[2] + shear * (g[2] + g[6]);
  }
}

/// Shear modulus over the model's: 1 unless it depends on the state.
template <class Model, int Dim> double stiffening(const Model& model, const StressRows<Dim>& rows, int i) {
  if constexpr (std::is_same_v<Model, SteinbergGuinan>) {
    return rows.shear[i] / model.shear_modulus;
  } else {
    return 1;
  }
}

/// What carries no deviator.
template <class Model> bool molten(double stiffness) { return std::is_same_v<Model, SteinbergGuinan> && stiffness <= molten_shear; }
template <int Dim> bool broken(const StressRows<Dim>& rows, int i) { return rows.damage && has_failed(rows.damage[i]); }

template <int Dim> void drop_stress(const StressRows<Dim>& rows, int i) {
  for (int a = 0; a < stress_components<Dim>; ++a) {
    rows.stress[a][i] = 0;
  }
  rows.flow_stress[i] = 0;
}

/// Damage of cell i by a plastic increment that ends at equivalent stress q.
template <int Dim>
void accumulate_damage(const Material& material, double dt, double increment, double q, double heat, const StressRows<Dim>& rows, int i) {
  const double p = rows.pressure[i] + rows.reference_pressure;
  const FailureState state{q > 0 ? -p / q : 0.0, increment / dt, heat};
  double& damage = rows.damage[i];
  damage = std::min(most_damage, damage + increment / failure_strain(*material.failure, state));
}

template <int Dim, class Model>
int return_to_yield(const Model& model,
                    const Material& material,
                    double dt,
                    int at,
                    int count,
                    const StressRows<Dim>& rows,
                    const double (*t)[chunk]) {
  constexpr int n = stress_components<Dim>;
  double q[chunk];
  for (int i = 0; i < count; ++i) {
    double s[n];
    for (int a = 0; a < n; ++a) {
      s[a] = t[a][i];
    }
    q[i] = equivalent(s, std::integral_constant<int, Dim>{});
  }
  int unsolved = 0;
  for (int i = 0; i < count; ++i) {
    double scale = 1;
    const double heat = rows.energy[at + i] - material.specific_energy, stiffer = stiffening(model, rows, at + i);
    if (molten<Model>(stiffer)) {
      drop_stress(rows, at + i);
      continue;
    }
    const FlowState state{rows.plastic_strain[at + i], heat, dt, stiffer};
    const double shear = model.shear_modulus * stiffer;
    const PlasticIncrement d = broken(rows, at + i) ? PlasticIncrement{q[i] / (3 * shear)} : plastic_increment(model, state, q[i]);
    if (d.value > 0) {
      scale = std::max(0.0, 1 - 3 * shear * d.value / q[i]); // a molten metal returns to 0, not to round-off below it
      rows.plastic_strain[at + i] += d.value;
      rows.flow_stress[at + i] = scale * q[i];
    } else {
      rows.flow_stress[at + i] = flow_stress(model, state, 0);
    }
    unsolved += d.converged ? 0 : 1;
    for (int a = 0; a < n; ++a) {
      rows.stress[a][at + i] = scale * t[a][i];
    }
    if (rows.damage && d.value > 0) {
      accumulate_damage(material, dt, d.value, scale * q[i], heat, rows, at + i);
    }
    if (broken(rows, at + i)) {
      drop_stress(rows, at + i);
    }
  }
  return unsolved;
}

} // namespace

template <int Dim> StressRows<Dim> stress_rows(MaterialSlot& slot, double reference_pressure, int r, int at) {
  StressRows<Dim> s{};
  for (int a = 0; a < stress_components<Dim>; ++a) {
    s.stress[a] = slot.store.row(field::stress + a, r) + at;
  }
  s.plastic_strain = slot.store.row(field::plastic_strain<Dim>, r) + at;
  s.flow_stress = slot.store.row(slot.flow_stress_field(), r) + at;
  s.energy = slot.store.row(field::energy, r) + at;
  s.shear = slot.variable_shear ? slot.store.row(slot.shear_field(), r) + at : nullptr;
  s.damage = slot.damages ? slot.store.row(field::damage<Dim>, r) + at : nullptr;
  s.pressure = slot.store.row(slot.pressure_field(), r) + at;
  s.reference_pressure = reference_pressure;
  return s;
}
template StressRows<2> stress_rows<2>(MaterialSlot&, double, int, int);
template StressRows<3> stress_rows<3>(MaterialSlot&, double, int, int);

template <int Dim>
int update_stress(const Material& material, double dt, int count, const StressRows<Dim>& rows) {
  return std::visit(
      [&](const auto& model) {
        int failed = 0;
        using Model = std::decay_t<decltype(model)>;
        if constexpr (flows<Model>) {
          double t[stress_components<Dim>][chunk];
          for (int at = 0; at < count; at += chunk) {
            const int part = std::min(chunk, count - at);
            if constexpr (std::is_same_v<Model, SteinbergGuinan>) {
              trial(ShearRow{rows.shear + at}, at, part, rows, t);
            } else {
              trial(OneShear{model.shear_modulus}, at, part, rows, t);
            }
            failed += return_to_yield<Dim>(model, material, dt, at, part, rows, t);
          }
        }
        return failed;
      },
      material.strength);
}

template <int Dim> void pull_back_to_yield(const Material& material, int count, const StressRows<Dim>& rows) {
  std::visit(
      [&](const auto& model) {
        using Model = std::decay_t<decltype(model)>;
        if constexpr (flows<Model>) {
          constexpr int n = stress_components<Dim>;
          for (int i = 0; i < count; ++i) {
            const double stiffer = stiffening(model, rows, i);
            if (molten<Model>(stiffer) || broken(rows, i)) {
              drop_stress(rows, i);
              continue;
            }
            double s[n];
            for (int a = 0; a < n; ++a) {
              s[a] = rows.stress[a][i];
            }
            const double q = equivalent(s, std::integral_constant<int, Dim>{});
            const FlowState state{rows.plastic_strain[i], rows.energy[i] - material.specific_energy, 0, stiffer};
            const double limit = flow_stress(model, state, 0);
            // Rate hardening is not known here (it belongs to the next step's strain): a rate-dependent
            // material keeps its stress, and the next return brings it to the surface of its rate.
            if (has_rate(model)) {
              rows.flow_stress[i] = std::max(limit, q);
              continue;
            }
            rows.flow_stress[i] = limit;
            if (q > limit) {
              for (int a = 0; a < n; ++a) {
                rows.stress[a][i] *= limit / q;
              }
            }
          }
        }
      },
      material.strength);
}

template <int Dim> void relax_slivers(const double* fraction, int count, const StressRows<Dim>& rows) {
  constexpr double sliver = sliver_fraction;
  int found = 0;
#pragma omp simd reduction(+ : found)
  for (int i = 0; i < count; ++i) {
    found += (fraction[i] > 0) & (fraction[i] < sliver) ? 1 : 0;
  }
  for (int i = 0; i < count && found > 0; ++i) {
    if (fraction[i] > 0 && fraction[i] < sliver) {
      for (int a = 0; a < stress_components<Dim>; ++a) {
        rows.stress[a][i] = 0;
      }
    }
  }
}
template void relax_slivers<2>(const double*, int, const StressRows<2>&);
template void relax_slivers<3>(const double*, int, const StressRows<3>&);

template <int Dim> void pull_back_to_yield(Block<Dim>& b, ThreadPool& pool) {
  const Grid& g = b.grid;
  parallel_awake(pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        const Span cells = b.awake.cells(r);
        for (MaterialSlot& slot : b.materials) {
          if (cells.empty() || !slot.strength || !slot.store.has_row(r)) {
            continue;
          }
          const StressRows<Dim> rows = stress_rows<Dim>(slot, b.reference_pressure, r, cells.begin);
          if (slot.variable_shear) {
            refresh_shear(b, slot, r); // the remap has moved the state under it
          }
          if (slot.memories > 0) {
            set_flow_stress<Dim>(slot, r, cells.begin, cells.count());
          }
          pull_back_to_yield<Dim>(slot.material, cells.count(), rows);
          relax_slivers(std::as_const(slot.store).row(field::fraction, r) + cells.begin, cells.count(), rows);
        }
      }
    }
  });
}
template void pull_back_to_yield<2>(Block<2>&, ThreadPool&);
template void pull_back_to_yield<3>(Block<3>&, ThreadPool&);
template int update_stress<2>(const Material&, double, int, const StressRows<2>&);
template int update_stress<3>(const Material&, double, int, const StressRows<3>&);
template void pull_back_to_yield<2>(const Material&, int, const StressRows<2>&);
template void pull_back_to_yield<3>(const Material&, int, const StressRows<3>&);

} // namespace ballast
