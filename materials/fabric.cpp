#include "materials/fabric_curves.hpp"

#include <fmt/format.h>

namespace ballast {
namespace {

enum { xx, yy, zz, xy, yz, xz };

bool has_options(const RaftenbergFabric& m) {
  const bool locking = std::isfinite(m.in_plane.first_angle) || std::isfinite(m.through.first_angle);
  return m.solid || m.secant_unloading || m.rate || m.coupling > 0 || locking;
}

/// Bound of the acoustic tensor along each axis: Gershgorin's of sqrt(D) (1 + 2E) sqrt(D), D the moduli, plus S.
[[gnu::always_inline]] inline void bound_waves(const FabricTensor& E, FabricStress& out) {
  const auto root_of = [](double modulus) { return std::sqrt(std::max(modulus, 0.0)); };
  const double r11 = root_of(out.tangent[xx]), r22 = root_of(out.tangent[yy]), r33 = root_of(out.tangent[zz]);
  const double r12 = root_of(out.tangent[xy]), r23 = root_of(out.tangent[yz]), r13 = root_of(out.tangent[xz]);
  const double c11 = 1 + 2 * E[xx], c22 = 1 + 2 * E[yy], c33 = 1 + 2 * E[zz];
  const double c12 = 2 * std::abs(E[xy]), c23 = 2 * std::abs(E[yz]), c13 = 2 * std::abs(E[xz]);
  const auto bound = [&](double r1, double r2, double r3, double s) {
    const double b1 = r1 * (c11 * r1 + c12 * r2 + c13 * r3);
    const double b2 = r2 * (c12 * r1 + c22 * r2 + c23 * r3);
    const double b3 = r3 * (c13 * r1 + c23 * r2 + c33 * r3);
    return std::max(std::max(b1, std::max(b2, b3)) + s, 0.0);
  };
  out.wave_modulus[0] = bound(r11, r12, r13, out.stress[xx]);
  out.wave_modulus[1] = bound(r12, r22, r23, out.stress[yy]);
  out.wave_modulus[2] = bound(r13, r23, r33, out.stress[zz]);
}

/// Secant unloading and rate factor, on a point of the printed curve.
CurvePoint with_losses(const RaftenbergFabric& m, const YarnFamily& y, double E, double largest, double rate, CurvePoint p) {
  if (m.secant_unloading && largest > y.rupture && E > 0 && E < largest) {
    const double secant = yarn_curve(y, largest).stress / largest;
    // The toe of the curve lies below the secant: following the secant there would give back more than was put in.
    p = secant * E < p.stress ? CurvePoint{secant * E, secant} : p;
  }
  const double factor = m.rate ? 1 + m.rate->C * std::log(std::max(rate / m.rate->reference_rate, 1.0)) : 1.0;
  return {p.stress * factor, p.slope * factor};
}

/// Warp and fill stretched together; gone when one of them is.
void add_coupling(const RaftenbergFabric& m, const FabricTensor& E, const FabricState& s, FabricStress& out) {
  const bool whole = !is_lost(m.warp, s.largest[0]) && !is_lost(m.fill, s.largest[1]);
  const CouplingShape w = coupling_shape(m.warp.rupture, E[xx]), f = coupling_shape(m.fill.rupture, E[yy]);
  const double kappa = whole ? m.coupling : 0.0;
  out.stress[xx] += kappa * w.slope * f.value;
  out.stress[yy] += kappa * f.slope * w.value;
  out.tangent[xx] += kappa * w.curvature * f.value;
  out.tangent[yy] += kappa * f.curvature * w.value;
}

/// J^2 and the cofactors of C = 1 + 2E, C^-1 = cofactor / J^2.
struct RightCauchyGreen {
  double J2 = 1;
  FabricTensor cofactor = {};
};
RightCauchyGreen right_cauchy_green(const FabricTensor& E) {
  const double a = 1 + 2 * E[xx], b = 1 + 2 * E[yy], c = 1 + 2 * E[zz];
  const double d = 2 * E[xy], e = 2 * E[yz], f = 2 * E[xz];
  const FabricTensor k = {b * c - e * e, a * c - f * f, a * b - d * d, e * f - c * d, d * f - a * e, d * e - b * f};
  return {a * k[0] + d * k[3] + f * k[5], k};
}

/// S = -p J C^-1, p = K (Js/J - 1) for J < Js. Along N its waves have J^2 |dp/dJ| N C^-1 N exactly.
void add_solid(const RaftenbergFabric& m, const FabricTensor& E, FabricStress& out) {
  const RightCauchyGreen g = right_cauchy_green(E);
  const double solid = m.density / m.solid->density;
  if (!(g.J2 < solid * solid)) {
    return;
  }
  const double J = std::sqrt(g.J2), K = m.solid->bulk_modulus;
  FabricTensor inverse = g.cofactor;
  for (double& x : inverse) {
    x /= g.J2;
  }
  const double pJ = K * (solid - J), stiffness = K * solid; // p J;  -J^2 dp/dJ
  for (std::size_t k = 0; k < 6; ++k) {
    out.stress[k] -= pJ * inverse[k];
  }
  // d(-pJ C^-1)/dE: K J C^-1 x C^-1 of the change of pJ, 2 pJ of C^-1's.
  constexpr std::size_t first[] = {xx, yy, xx}, second[] = {yy, zz, zz};
  for (std::size_t k = 0; k < 3; ++k) {
    out.tangent[k] += (K * J + 2 * pJ) * inverse[k] * inverse[k];
    const double off = inverse[k + 3];
    out.tangent[k + 3] += K * J * off * off + pJ * (inverse[first[k]] * inverse[second[k]] + off * off);
    out.wave_modulus[k] += stiffness * inverse[k];
  }
}

template <bool Options>
[[gnu::always_inline]] inline FabricStress respond(const RaftenbergFabric& m, const FabricTensor& E, FabricState& s, const std::array<double, 2>& rate) {
  s.largest[0] = std::max(s.largest[0], E[xx]);
  s.largest[1] = std::max(s.largest[1], E[yy]);
  CurvePoint warp = yarn_curve(m.warp, E[xx]), fill = yarn_curve(m.fill, E[yy]);
  if constexpr (Options) {
    warp = with_losses(m, m.warp, E[xx], s.largest[0], rate[0], warp);
    fill = with_losses(m, m.fill, E[yy], s.largest[1], rate[1], fill);
  }
  const bool no_warp = is_lost(m.warp, s.largest[0]), no_fill = is_lost(m.fill, s.largest[1]);
  const CurvePoint press = transverse_curve(m.transverse, m.form, E[zz], Options ? solid_strain(m) : -0.5);
  FabricStress out;
  out.stress = {no_warp ? 0.0 : warp.stress, no_fill ? 0.0 : fill.stress, press.stress,
                2 * m.in_plane.modulus * E[xy], 2 * m.through.modulus * E[yz], 2 * m.through.modulus * E[xz]};
  out.tangent = {no_warp ? 0.0 : warp.slope, no_fill ? 0.0 : fill.slope, press.slope, m.in_plane.modulus, m.through.modulus, m.through.modulus};
  if constexpr (Options) {
    const CurvePoint shear[] = {shear_curve(m.in_plane, E[xy]), shear_curve(m.through, E[yz]), shear_curve(m.through, E[xz])};
    for (std::size_t k = 0; k < 3; ++k) {
      out.stress[k + 3] = shear[k].stress;
      out.tangent[k + 3] = shear[k].slope;
    }
    if (m.coupling > 0) {
      add_coupling(m, E, s, out);
    }
  }
  bound_waves(E, out);
  if constexpr (Options) {
    if (m.solid) {
      add_solid(m, E, out);
    }
  }
  return out;
}

[[gnu::always_inline]] inline FabricStress respond(const HookeSolid& m, const FabricTensor& E) {
  const double mu = m.young / (2 * (1 + m.poisson));
  const double lambda = 2 * mu * m.poisson / (1 - 2 * m.poisson);
  const double pressed = lambda * (E[xx] + E[yy] + E[zz]), along = lambda + 2 * mu;
  FabricStress out;
  out.stress = {pressed + 2 * mu * E[xx], pressed + 2 * mu * E[yy], pressed + 2 * mu * E[zz], 2 * mu * E[xy], 2 * mu * E[yz], 2 * mu * E[xz]};
  out.tangent = {along, along, along, mu, mu, mu};
  bound_waves(E, out);
  return out;
}

template <class Respond> void over_rows(const FabricRows& rows, Respond respond_one) {
  const FabricRows r = rows;
#pragma GCC ivdep // rows do not overlap; `omp simd` would keep the tensors in memory and not vectorise
  for (int i = 0; i < r.count; ++i) {
    const FabricTensor E = {r.strain[0][i], r.strain[1][i], r.strain[2][i], r.strain[3][i], r.strain[4][i], r.strain[5][i]};
    FabricState s{{r.largest[0][i], r.largest[1][i]}};
    const FabricStress out = respond_one(E, s, i);
    r.largest[0][i] = s.largest[0];
    r.largest[1][i] = s.largest[1];
    for (std::size_t k = 0; k < 6; ++k) {
      r.stress[k][i] = out.stress[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      r.wave_modulus[k][i] = out.wave_modulus[k];
    }
  }
}

void evaluate_rows(const RaftenbergFabric& m, const FabricRows& rows) {
  if (!has_options(m)) {
    over_rows(rows, [&m](const FabricTensor& E, FabricState& s, int) __attribute__((always_inline)) { return respond<false>(m, E, s, {}); });
    return;
  }
  const bool moving = rows.extension_rate[0] != nullptr && rows.extension_rate[1] != nullptr;
  over_rows(rows, [&](const FabricTensor& E, FabricState& s, int i) {
    const std::array<double, 2> rate = {moving ? rows.extension_rate[0][i] : 0.0, moving ? rows.extension_rate[1][i] : 0.0};
    return respond<true>(m, E, s, rate);
  });
}

void evaluate_rows(const HookeSolid& m, const FabricRows& rows) {
  over_rows(rows, [&m](const FabricTensor& E, FabricState&, int) __attribute__((always_inline)) { return respond(m, E); });
}

} // namespace

ShearLaw awg_shear() {
  return {.modulus = 4.14e6, .stiffer = 41.4e6, .stiffest = 345e6, .first_angle = 0.25, .second_angle = 0.35};
}

bool is_eroded(const RaftenbergFabric& law, const FabricState& state) {
  return is_lost(law.warp, state.largest[0]) && is_lost(law.fill, state.largest[1]);
}

FabricStress evaluate(const RaftenbergFabric& law, const FabricTensor& strain, FabricState& state, const std::array<double, 2>& extension_rate) {
  return has_options(law) ? respond<true>(law, strain, state, extension_rate) : respond<false>(law, strain, state, extension_rate);
}

FabricStress evaluate(const HookeSolid& law, const FabricTensor& strain, FabricState&, const std::array<double, 2>&) { return respond(law, strain); }

void evaluate(const FabricModel& model, const FabricRows& rows) {
  std::visit([&rows](const auto& m) { evaluate_rows(m, rows); }, model);
}

} // namespace ballast
