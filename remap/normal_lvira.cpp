// LVIRA: the normal of least misfit, by Gauss-Newton on its Dim - 1 tilts.
#include "remap/normal_fit.hpp"

namespace ballast::remap {

namespace {

template <int Dim> using Tilts = std::array<Normal<Dim>, Dim - 1>;

template <int Dim> struct Descent {
  const double* f;
  Frame<Dim> frame; // of the start: the order of sums
  Tilts<Dim> tilt;  // directions, which mirror and swap with the stencil
  Normal<Dim> n;
  Stencil<Dim> residual;
  double misfit;
};

// Along the lesser axes; where the two greater are equal, along the least (in 3D) and from one equal
// axis to the other, since no rule may prefer one. Signs follow the normal's.
template <int Dim> Tilts<Dim> tilts(const Frame<Dim>& frame) {
  Tilts<Dim> tilt{};
  const auto sign = [&](int d) { return frame.step[d] < 0 ? -1.0 : 1.0; };
  for (int d = 0; d < Dim - 1; ++d)
    tilt[d][frame.axis[d]] = sign(d);
  if (frame.m[Dim - 2] == frame.m[Dim - 1])
    tilt[Dim - 2][frame.axis[Dim - 1]] = -sign(Dim - 1);
  return tilt;
}

template <int Dim>
Normal<Dim> tilted(const Normal<Dim>& n, const Normal<Dim>& tilt, double amount) {
  Normal<Dim> out;
  for (int d = 0; d < Dim; ++d)
    out[d] = n[d] + amount * tilt[d];
  return out;
}

// d residual / d tilt by differences: truncation ~1e-7, round-off ~1e-8 of it. An ambiguous frame
// may mirror a tilt's sign, so there the difference is central.
template <int Dim>
void derivative(const Descent<Dim>& at, const Normal<Dim>& tilt, Stencil<Dim>& slope) {
  constexpr double h = 1e-7;
  residuals(frame_of<Dim>(tilted<Dim>(at.n, tilt, h)), at.f, slope);
  if (!at.frame.ambiguous) {
    for (int k = 0; k < stencil_size<Dim>; ++k)
      slope[k] = (slope[k] - at.residual[k]) / h;
    return;
  }
  Stencil<Dim> back;
  residuals(frame_of<Dim>(tilted<Dim>(at.n, tilt, -h)), at.f, back);
  for (int k = 0; k < stencil_size<Dim>; ++k)
    slope[k] = (slope[k] - back[k]) / (2.0 * h);
}

// The least-squares tilts; false where the equations are singular.
bool solve_tilts(const Descent<2>& at, std::array<double, 1>& amount) {
  Stencil<2> slope;
  derivative<2>(at, at.tilt[0], slope);
  const double a = product<2>(at.frame, slope, slope);
  amount = {-product<2>(at.frame, slope, at.residual) / a};
  return a > 0.0;
}

bool solve_tilts(const Descent<3>& at, std::array<double, 2>& amount) {
  Stencil<3> first, second;
  derivative<3>(at, at.tilt[0], first);
  derivative<3>(at, at.tilt[1], second);
  const double a11 = product(at.frame, first, first);
  const double a12 = product(at.frame, first, second);
  const double a22 = product(at.frame, second, second);
  const double b1 = product(at.frame, first, at.residual);
  const double b2 = product(at.frame, second, at.residual);
  const double determinant = a11 * a22 - a12 * a12;
  amount = {(a12 * b2 - a22 * b1) / determinant, (a12 * b1 - a11 * b2) / determinant};
  return determinant > 1e-10 * (a11 * a22);
}

// One step; false where it does not lower the misfit.
template <int Dim> bool descend(Descent<Dim>& at) {
  std::array<double, Dim - 1> amount;
  if (!solve_tilts(at, amount))
    return false;
  Descent<Dim> next = at;
  for (int d = 0; d < Dim - 1; ++d)
    next.n = tilted<Dim>(next.n, at.tilt[d], amount[d]);
  residuals(frame_of<Dim>(next.n), at.f, next.residual);
  next.misfit = product<Dim>(at.frame, next.residual, next.residual);
  if (!(next.misfit < at.misfit))
    return false;
  at = next;
  return true;
}

} // namespace

template <int Dim> Normal<Dim> improved(const Normal<Dim>& start, const double* f) {
  constexpr int max_steps = 4;        // a plane needs three: the error squares from ~1e-2
  constexpr double worthwhile = 0.95; // curved interfaces settle after two
  const Frame<Dim> frame = frame_of<Dim>(start);
  // In 3D no pair of tilts has the cube diagonal's symmetry.
  if (Dim == 3 && frame.m[0] == frame.m[Dim - 1])
    return start;
  Descent<Dim> at{.f = f,
                  .frame = frame,
                  .tilt = tilts<Dim>(frame),
                  .n = start,
                  .residual = {},
                  .misfit = 0.0};
  residuals(frame, f, at.residual);
  at.misfit = product<Dim>(frame, at.residual, at.residual);
  for (int step = 0; step < max_steps && at.misfit > exact_misfit; ++step) {
    const double before = at.misfit;
    if (!descend<Dim>(at) || at.misfit > worthwhile * before)
      break;
  }
  return unit<Dim>(at.n);
}

template Normal<2> improved<2>(const Normal<2>&, const double*);
template Normal<3> improved<3>(const Normal<3>&, const double*);

} // namespace ballast::remap
