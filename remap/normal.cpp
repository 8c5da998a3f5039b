#include "remap/normal.hpp"

#include <limits>

namespace ballast::remap {

namespace {

constexpr std::array<int, 3> stride = {1, 3, 9};
template <int Dim> constexpr int centre = stencil_size<Dim> / 2;

// Fractions are O(1) and each gradient weighs at most 16 of them: below this it is round-off.
constexpr double no_gradient = 1e-13;

// No step improves on this: 27 cells off by 1e-14, the round trip of a plane.
constexpr double exact_misfit = 27e-28;

// Sums must not depend on the order of axes, so terms are added in ascending order.
template <int Dim> double ordered_sum(Normal<Dim> terms) {
  std::sort(terms.begin(), terms.end());
  double sum = 0.0;
  for (const double term : terms)
    sum += term;
  return sum;
}

// A sum that the order of terms does not change and that mirrored terms exactly mirror.
double balanced_sum(double* begin, double* end) {
  std::sort(begin, end, [](double a, double b) { return std::abs(a) < std::abs(b); });
  double rise = 0.0;
  double fall = 0.0;
  for (const double* term = begin; term != end; ++term)
    (*term > 0.0 ? rise : fall) += *term;
  return rise + fall;
}

template <int Dim> Normal<Dim> first_axis() {
  Normal<Dim> n{};
  n[0] = 1.0;
  return n;
}

template <int Dim> Normal<Dim> unit(const Normal<Dim>& n) {
  Normal<Dim> squares;
  for (int d = 0; d < Dim; ++d)
    squares[d] = n[d] * n[d];
  const double length = std::sqrt(ordered_sum<Dim>(squares));
  Normal<Dim> scaled;
  for (int d = 0; d < Dim; ++d)
    scaled[d] = n[d] / length;
  return scaled;
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

// The stencil seen along n: axes mirrored and sorted so that every misfit is summed in an order
// that mirroring or swapping the stencil does not change.
template <int Dim> struct Frame {
  Normal<Dim> m;             // |n| ascending, summing to 1
  std::array<int, Dim> axis; // where each came from
  std::array<int, Dim> step; // signed stride in the stencil
  bool ambiguous = false;    // a zero or two equal components: the order is not unique
};

template <int Dim> Frame<Dim> frame_of(const Normal<Dim>& n) {
  Frame<Dim> frame;
  for (int d = 0; d < Dim; ++d)
    frame.axis[d] = d;
  const auto shorter = [&](int a, int b) { return std::abs(n[a]) < std::abs(n[b]); };
  if (shorter(frame.axis[1], frame.axis[0]))
    std::swap(frame.axis[0], frame.axis[1]);
  if constexpr (Dim == 3) {
    if (shorter(frame.axis[2], frame.axis[1]))
      std::swap(frame.axis[1], frame.axis[2]);
    if (shorter(frame.axis[1], frame.axis[0]))
      std::swap(frame.axis[0], frame.axis[1]);
  }
  double sum = 0.0;
  for (int d = 0; d < Dim; ++d)
    sum += std::abs(n[frame.axis[d]]);
  for (int d = 0; d < Dim; ++d) {
    frame.m[d] = std::abs(n[frame.axis[d]]) / sum;
    frame.step[d] = n[frame.axis[d]] < 0.0 ? -stride[frame.axis[d]] : stride[frame.axis[d]];
    frame.ambiguous |= frame.m[d] == (d == 0 ? 0.0 : frame.m[d - 1]);
  }
  return frame;
}

// visit(index in f, m.offset) over the stencil in the frame's order; equal m are added first, so
// that exchanging them changes no bit.
template <class Visit> void visit_stencil(const Frame<2>& frame, const Visit& visit) {
  for (int b = -1; b <= 1; ++b)
    for (int a = -1; a <= 1; ++a)
      visit(centre<2> + b * frame.step[1] + a * frame.step[0], a * frame.m[0] + b * frame.m[1]);
}

template <class Visit> void visit_stencil(const Frame<3>& frame, const Visit& visit) {
  const auto [m1, m2, m3] = frame.m;
  const bool last_pair = m2 == m3;
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b) {
      const int row = centre<3> + c * frame.step[2] + b * frame.step[1];
      for (int a = -1; a <= 1; ++a) {
        const double rise = last_pair ? a * m1 + (b * m2 + c * m3) : (a * m1 + b * m2) + c * m3;
        visit(row + a * frame.step[0], rise);
      }
    }
}

template <int Dim> using Stencil = std::array<double, stencil_size<Dim>>;

// residual[index] = volume of the plane in that cell - f[index].
template <int Dim>
void residuals(const Frame<Dim>& frame, const double* f, Stencil<Dim>& residual) {
  const double b = canonical::centred_offset<Dim>(frame.m, f[centre<Dim>]);
  visit_stencil(frame, [&](int index, double rise) {
    residual[index] = canonical::centred_volume<Dim>(frame.m, b - rise) - f[index];
  });
}

// Sum over the stencil of a b.
template <int Dim>
double product(const Frame<Dim>& frame, const Stencil<Dim>& a, const Stencil<Dim>& b) {
  Stencil<Dim> terms;
  int count = 0;
  visit_stencil(frame, [&](int index, double) { terms[count++] = a[index] * b[index]; });
  if (frame.ambiguous)
    return balanced_sum(terms.data(), terms.data() + count);
  double sum = 0.0;
  for (const double term : terms)
    sum += term;
  return sum;
}

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

// ---- LVIRA: Gauss-Newton on two tilts of the normal ----

struct Descent {
  const double* f;
  Frame<3> frame;                // of the start: the order of sums
  std::array<Normal<3>, 2> tilt; // directions, which mirror and swap with the stencil
  Normal<3> n;
  Stencil<3> residual;
  double misfit;
};

// Along the two lesser axes; where the two greater are equal, along the least and from one equal
// axis to the other, since no rule may prefer one. Signs follow the normal's.
std::array<Normal<3>, 2> tilts(const Frame<3>& frame) {
  std::array<Normal<3>, 2> tilt{};
  const auto sign = [&](int d) { return frame.step[d] < 0 ? -1.0 : 1.0; };
  tilt[0][frame.axis[0]] = sign(0);
  tilt[1][frame.axis[1]] = sign(1);
  if (frame.m[1] == frame.m[2])
    tilt[1][frame.axis[2]] = -sign(2);
  return tilt;
}

Normal<3> tilted(const Normal<3>& n, const Normal<3>& tilt, double amount) {
  return {n[0] + amount * tilt[0], n[1] + amount * tilt[1], n[2] + amount * tilt[2]};
}

// d residual / d tilt by differences: truncation ~1e-7, round-off ~1e-8 of it. An ambiguous frame
// may mirror a tilt's sign, so there the difference is central.
void derivative(const Descent& at, const Normal<3>& tilt, Stencil<3>& slope) {
  constexpr double h = 1e-7;
  residuals(frame_of<3>(tilted(at.n, tilt, h)), at.f, slope);
  if (!at.frame.ambiguous) {
    for (int k = 0; k < 27; ++k)
      slope[k] = (slope[k] - at.residual[k]) / h;
    return;
  }
  Stencil<3> back;
  residuals(frame_of<3>(tilted(at.n, tilt, -h)), at.f, back);
  for (int k = 0; k < 27; ++k)
    slope[k] = (slope[k] - back[k]) / (2.0 * h);
}

// One step; false where it does not lower the misfit.
bool descend(Descent& at) {
  Stencil<3> first, second;
  derivative(at, at.tilt[0], first);
  derivative(at, at.tilt[1], second);
  const double a11 = product(at.frame, first, first);
  const double a12 = product(at.frame, first, second);
  const double a22 = product(at.frame, second, second);
  const double b1 = product(at.frame, first, at.residual);
  const double b2 = product(at.frame, second, at.residual);
  const double determinant = a11 * a22 - a12 * a12;
  if (!(determinant > 1e-10 * (a11 * a22)))
    return false;
  Descent next = at;
  next.n = tilted(tilted(at.n, at.tilt[0], (a12 * b2 - a22 * b1) / determinant),
                  at.tilt[1],
                  (a12 * b1 - a11 * b2) / determinant);
  residuals(frame_of<3>(next.n), at.f, next.residual);
  next.misfit = product(at.frame, next.residual, next.residual);
  if (!(next.misfit < at.misfit))
    return false;
  at = next;
  return true;
}

Normal<3> improved(const Normal<3>& start, const double* f) {
  constexpr int max_steps = 4;        // a plane needs three: the error squares from ~1e-2
  constexpr double worthwhile = 0.95; // curved interfaces settle after two
  const Frame<3> frame = frame_of<3>(start);
  // No pair of tilts has the cube diagonal's symmetry.
  if (frame.m[0] == frame.m[2])
    return start;
  Descent at{
      .f = f, .frame = frame, .tilt = tilts(frame), .n = start, .residual = {}, .misfit = 0.0};
  residuals(frame, f, at.residual);
  at.misfit = product(frame, at.residual, at.residual);
  for (int step = 0; step < max_steps && at.misfit > exact_misfit; ++step) {
    const double before = at.misfit;
    if (!descend(at) || at.misfit > worthwhile * before)
      break;
  }
  return unit<3>(at.n);
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
  const Normal<Dim> best = winner<Dim>(contest, down);
  if constexpr (Dim == 3)
    return improved(best, f);
  return best;
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
