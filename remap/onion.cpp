#include "remap/onion.hpp"

namespace ballast::remap {

namespace {

template <int Dim> Interface<Dim> interface_of(NormalMethod method, const double* cumulated) {
  std::array<double, stencil_size<Dim>> f;
  for (int k = 0; k < stencil_size<Dim>; ++k)
    f[k] = std::clamp(cumulated[k], 0.0, 1.0);
  const double fraction = f[stencil_size<Dim> / 2];
  // Empty or full: a plane on the cell's own face, which no slab's round-off can cut.
  if (fraction == 0.0 || fraction == 1.0)
    return {.n = {1.0}, .alpha = fraction};
  const Normal<Dim> n = interface_normal<Dim>(method, f.data());
  return {.n = n, .alpha = plane_constant<Dim>(n, fraction)};
}

// Rounds all but the largest down to multiples of the width's last bit: every sum of them is then
// exact, in any order, and so is the rest that the largest takes.
void close_sum(double* volumes, int size, double width) {
  double* largest = std::max_element(volumes, volumes + size);
  const double bit = std::nextafter(width, 2.0) - width;
  double others = 0.0;
  for (double* v = volumes; v != volumes + size; ++v) {
    if (v == largest)
      continue;
    *v = std::floor(*v / bit) * bit;
    others += *v;
  }
  *largest = width - others;
}

} // namespace

template <int Dim>
void onion_interfaces(NormalMethod method,
                      const double* cumulated,
                      int count,
                      Interface<Dim>* interfaces) {
  for (int k = 0; k < count; ++k)
    interfaces[k] = interface_of<Dim>(method, cumulated + k * stencil_size<Dim>);
}

template <int Dim>
void slab_volumes(
    const Interface<Dim>* interfaces, int count, int axis, double lo, double hi, double* volumes) {
  const double width = hi - lo;
  if (width <= 0.0) {
    std::fill_n(volumes, count + 1, 0.0);
    return;
  }
  double taken = 0.0; // by the materials so far; a crossing plane cannot take back
  for (int k = 0; k < count; ++k) {
    const double below =
        std::min(width, slab_volume<Dim>(interfaces[k].n, interfaces[k].alpha, axis, lo, hi));
    volumes[k] = std::max(below - taken, 0.0);
    taken = std::max(below, taken);
  }
  volumes[count] = width - taken;
  close_sum(volumes, count + 1, width);
}

template void onion_interfaces<2>(NormalMethod, const double*, int, Interface<2>*);
template void onion_interfaces<3>(NormalMethod, const double*, int, Interface<3>*);
template void slab_volumes<2>(const Interface<2>*, int, int, double, double, double*);
template void slab_volumes<3>(const Interface<3>*, int, int, double, double, double*);

} // namespace ballast::remap
