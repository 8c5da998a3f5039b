// Nonlinear branches: what a flow law gives to the integrators, and the rate that is consistent with its own step.
//
// Two ways to integrate: an exponential step with a frozen rate (the fast path, here), and CVODE (visco_cvode), for
// which a law gives v' = F(v, s) over the unit step s in [0, 1], six variables v of its choice and the dissipation.
// The fast path freezes the relaxation number x = rate dt at the rate of the step's own middle,
//   x = number(y_half(x)),
// which is second order, exact in the steady state however large x is, and never overshoots: each result is a mean,
// with weights in [0, 1], of where the branch was and where it would settle.
#pragma once

#include "materials/visco_relaxation.hpp"
#include "materials/visco_tensor.hpp"

#include <algorithm>

namespace ballast {

/// y (Pa, or 1 for elastic strains) and what it has dissipated in the step, J/m3.
struct BranchState {
  Sym y{};
  double dissipated = 0;
};

/// Of the rates by the six variables (a shear and its twin are one): diagonal 1 + left_0 right_0^T + left_1 right_1^T;
/// and the gradient of the dissipation's rate.
struct BranchJacobian {
  double diagonal = 0;
  std::array<Sym, 2> left{}, right{};
  Sym heat{};
};

/// Gradient by the six variables of a function whose differential is g : dy.
inline Sym by_variables(const Sym& g) { return {g[0], g[1], g[2], 2 * g[3], 2 * g[4], 2 * g[5]}; }

struct FastStep {
  BranchState state;
  double work = 0; ///< J/m3, by quadrature of the fast path
};

/// Root of x = number(x) for x >= 0, number >= 0 and (nearly always) falling, to 1e-9 relative; NaN where number is.
/// In logarithms number is almost a straight line: regula falsi with the Illinois weight.
template <class Number> double solve_relaxation(Number&& number) {
  const double top = number(0.0);
  if (!(top > 1e-9)) {
    return top; // the step changes the rate by less than round-off
  }
  if (top < 1e-3) { // each round gains a factor m x/2
    return number(number(number(top)));
  }
  const auto gap = [&](double u) {
    const double n = number(std::exp(u));
    return n > 1e-300 ? std::clamp(std::log(n) - u, -60.0, 60.0) : n <= 1e-300 ? -60.0 : n; // the last: no number
  };
  double high = std::min(std::log(top), 60.0), g_high = gap(high);
  for (int k = 0; k < 40 && g_high > 0; ++k) { // number grew: s_n opposes the strain
    high += 1;
    g_high = gap(high);
  }
  double low = high > 0 ? 0 : high + g_high, g_low = gap(low);
  for (int k = 0; k < 40 && g_low < 0; ++k) {
    high = low;
    g_high = g_low;
    low -= k + 1;
    g_low = gap(low);
  }
  int side = 0;
  double u = high;
  for (int it = 0; it < 60; ++it) {
    u = g_low == g_high ? low : it % 4 == 3 ? 0.5 * (low + high) : (low * g_high - high * g_low) / (g_high - g_low);
    const double g = gap(u);
    if (g != g) {
      return g;
    }
    if (std::abs(g) <= 1e-9 || high - low < 1e-12) {
      break;
    }
    if (g > 0) {
      low = u;
      g_low = g;
      g_high *= side == 1 ? 0.5 : 1.0;
      side = 1;
    } else {
      high = u;
      g_high = g;
      g_low *= side == -1 ? 0.5 : 1.0;
      side = -1;
    }
  }
  return std::exp(u);
}

/// Weights of a relaxation towards a target that moves evenly from `start` to `end`.
struct Weights {
  double keep, start, end;
};
inline Weights weights(double x) {
  const double gone = -std::expm1(-x), share = x > 1e-8 ? gone / x : 1 - 0.5 * x;
  return {1 - gone, std::max(0.0, share - (1 - gone)), std::max(0.0, 1 - share)};
}

} // namespace ballast
