#include "remap/normal_fit.hpp"

#include <limits>

namespace ballast::remap {

namespace {

// Fractions are O(1) and each gradient weighs at most 16 of them: below this it is round-off.
constexpr double no_gradient = 1e-13;

template <int Dim> Normal<Dim> first_axis() {
  Normal<Dim> n{};
  n[0] = 1.0;
  return n;
}

// ---- Youngs ----

double face_difference(const double* f, int axis, int at) {
  return f[at + stride[axis]] - f[at - stride[axis]];
}

double weighted_difference(const double* f, int axis, std::array<int, 1> t) {
  const auto diff = [&](int shift) { return face_difference(f, axis, centre<2> + shift); };
  return 2.0 * diff(0) + (diff(t[0]) + diff(-t[0]));
}

double weighted_difference(const double* f, int axis, std::array<int, 2> t) {
  const auto diff = [&](int shift) { return face_difference(f, axis, centre<3> + shift); };
  const double edges = (diff(t[0]) + diff(-t[0])) + (diff(t[1]) + diff(-t[1]));
  const double corners =
      (diff(t[0] + t[1]) + diff(-t[0] - t[1])) + (diff(t[0] - t[1]) + diff(t[1] - t[0]));
  return 4.0 * diff(0) + (2.0 * edges + corners);
}

template <int Dim> std::array<int, Dim - 1> other_axes(int axis) {
  std::array<int, Dim - 1> others;
  for (int k = 0; k < Dim - 1; ++k)
    others[k] = k < axis ? k : k + 1;
  return others;
}

// Down the gradient, not normalised; zero where there is none.
template <int Dim> Normal<Dim> youngs_direction(const double* f) {
  Normal<Dim> n;
  double largest = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    std::array<int, Dim - 1> t = other_axes<Dim>(axis);
    for (int& shift : t)
      shift = stride[shift];
    n[axis] = -weighted_difference(f, axis, t);
    largest = std::max(largest, std::abs(n[axis]));
  }
  return largest > no_gradient ? n : Normal<Dim>{};
}

// ---- Column heights ----

double column_height(const double* f, int axis, int at) {
  return f[at] + (f[at + stride[axis]] + f[at - stride[axis]]);
}

double centred_slope(const double* f, int axis, int at, int t) {
  return 0.5 * (column_height(f, axis, at + stride[t]) - column_height(f, axis, at - stride[t]));
}

// ---- Mixed Youngs-centred ----

// The centred-columns normal whose main axis dominates most; all zero where two axes tie.
template <int Dim> Normal<Dim> centred_columns(const double* f, const Normal<Dim>& down) {
  Normal<Dim> best{};
  double gentlest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < Dim; ++axis) {
    if (down[axis] == 0.0)
      continue;
    Normal<Dim> n;
    double steepness = 0.0;
    for (const int t : other_axes<Dim>(axis)) {
      n[t] = -centred_slope(f, axis, centre<Dim>, t);
      steepness += std::abs(n[t]);
    }
    n[axis] = std::copysign(1.0, down[axis]);
    if (steepness == gentlest)
      best = {};
    if (steepness < gentlest)
      best = n;
    gentlest = std::min(gentlest, steepness);
  }
  return best;
}

template <int Dim> double main_share(const Normal<Dim>& n) {
  Normal<Dim> size;
  for (int d = 0; d < Dim; ++d)
    size[d] = std::abs(n[d]);
  return *std::max_element(size.begin(), size.end()) / ordered_sum<Dim>(size);
}

// Aulisa et al.: centred columns flatten a steep plane; take them only where Youngs is flatter
// still.
template <int Dim> Normal<Dim> mixed_direction(const double* f, const Normal<Dim>& down) {
  const Normal<Dim> columns = centred_columns<Dim>(f, down);
  if (columns == Normal<Dim>{})
    return down;
  return main_share<Dim>(columns) > main_share<Dim>(down) ? down : columns;
}

// ---- Least-squares fit ----

constexpr int max_candidates = 8; // Youngs, mixed and, in 2D, three slopes along each axis

// The best candidates so far: more than one only where their misfits are equal to the last bit.
template <int Dim> struct Contest {
  const double* f;
  double misfit = std::numeric_limits<double>::infinity();
  int ties = 0;
  std::array<Normal<Dim>, max_candidates> normal;

  void enter(const Normal<Dim>& direction) {
    const Normal<Dim> n = unit<Dim>(direction);
    const double candidate = stencil_misfit<Dim>(n, f);
    if (candidate > misfit)
      return;
    if (candidate < misfit)
      ties = 0;
    misfit = candidate;
    for (int k = 0; k < ties; ++k)
      if (normal[k] == n)
        return;
    normal[ties++] = n;
  }
};

// Mean of the tied normals; fallback where they cancel.
template <int Dim> Normal<Dim> winner(const Contest<Dim>& contest, const Normal<Dim>& fallback) {
  if (contest.ties == 1)
    return contest.normal[0];
  Normal<Dim> sum;
  double largest = 0.0;
  for (int d = 0; d < Dim; ++d) {
    std::array<double, max_candidates> component;
    for (int k = 0; k < contest.ties; ++k)
      component[k] = contest.normal[k][d];
    sum[d] = balanced_sum(component.data(), component.data() + contest.ties);
    largest = std::max(largest, std::abs(sum[d]));
  }
  return unit<Dim>(largest > 1e-6 * contest.ties ? sum : fallback);
}

// Backward, centred and forward differences of the columns that run along axis.
void enter_columns(Contest<2>& contest, const Normal<2>& down, int axis) {
  const int t = 1 - axis;
  const auto height = [&](int side) {
    return column_height(contest.f, axis, centre<2> + side * stride[t]);
  };
  Normal<2> n;
  n[axis] = std::copysign(1.0, down[axis]);
  for (const double slope :
       {height(0) - height(-1), 0.5 * (height(1) - height(-1)), height(1) - height(0)}) {
    n[t] = -slope;
    contest.enter(n);
  }
}

template <int Dim> Normal<Dim> elvira(const double* f, const Normal<Dim>& down) {
  Contest<Dim> contest{.f = f, .normal = {}};
  contest.enter(mixed_direction<Dim>(f, down));
  contest.enter(down);
  if constexpr (Dim == 2) {
    // Both axes or none: swapping them must not matter.
    const bool exact = contest.misfit <= exact_misfit;
    for (int axis = 0; axis < 2 && !exact; ++axis)
      if (down[axis] != 0.0)
        enter_columns(contest, down, axis);
  }
  return improved<Dim>(winner<Dim>(contest, down), f);
}

} // namespace

template <int Dim> double stencil_misfit(const Normal<Dim>& n, const double* f) {
  const Frame<Dim> frame = frame_of<Dim>(n);
  Stencil<Dim> residual;
  residuals(frame, f, residual);
  return product<Dim>(frame, residual, residual);
}

template <int Dim> Normal<Dim> interface_normal(NormalMethod method, const double* f) {
  const Normal<Dim> down = youngs_direction<Dim>(f);
  if (down == Normal<Dim>{})
    return first_axis<Dim>();
  switch (method) {
  case NormalMethod::youngs:
    return unit<Dim>(down);
  case NormalMethod::mixed_youngs_centred:
    return unit<Dim>(mixed_direction<Dim>(f, down));
  case NormalMethod::elvira:
    break;
  }
  return elvira<Dim>(f, down);
}

template double stencil_misfit<2>(const Normal<2>&, const double*);
template double stencil_misfit<3>(const Normal<3>&, const double*);
template Normal<2> interface_normal<2>(NormalMethod, const double*);
template Normal<3> interface_normal<3>(NormalMethod, const double*);

} // namespace ballast::remap
