#include "ale/layers/contact_surface.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "core/error.hpp"

namespace ballast {

namespace {

template <int Dim> using Vec = std::array<double, Dim>;

template <int Dim> Vec<Dim> between(const ContactSurface<Dim>& s, int from, int to) {
  Vec<Dim> d;
  for (std::size_t c = 0; c < Dim; ++c) {
    d[c] = s.position[c][to] - s.position[c][from];
  }
  return d;
}

Vec<3> normal_of(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Calls visit(segment, its first node) for the segments around a node.
template <int Dim, class Visit> void for_each_segment_around(const ContactSurface<Dim>& s, int i, int j, Visit&& visit) {
  const int n = s.nodes_along(0);
  for (int sj = Dim == 3 ? std::max(j - 1, 0) : 0; sj <= (Dim == 3 ? std::min(j, s.segments[1] - 1) : 0); ++sj) {
    for (int si = std::max(i - 1, 0); si <= std::min(i, s.segments[0] - 1); ++si) {
      visit(sj * s.segments[0] + si, sj * n + si);
    }
  }
}

/// All segments around a node are there.
template <int Dim> bool whole(const ContactSurface<Dim>& s, int i, int j) {
  bool all = true;
  if (s.alive != nullptr) {
    for_each_segment_around(s, i, j, [&](int segment, int) { all = all && s.there(segment); });
  }
  return all;
}

/// Sum of the area normals of the segments that are there around a node.
template <int Dim> Vec<Dim> normal_sum(const ContactSurface<Dim>& s, int i, int j) {
  const int n = s.nodes_along(0);
  Vec<Dim> sum{};
  for_each_segment_around(s, i, j, [&](int segment, int first) {
    if (!s.there(segment)) {
      return;
    }
    if constexpr (Dim == 3) {
      const Vec<3> a = normal_of(between(s, first, first + n + 1), between(s, first + 1, first + n));
      sum = {sum[0] + a[0], sum[1] + a[1], sum[2] + a[2]};
    } else {
      const Vec<2> t = between(s, first, first + 1);
      sum = {sum[0] - t[1], sum[1] + t[0]};
    }
  });
  return sum;
}

/// The same where all segments are there: the chords across the node (one-sided at edges).
template <int Dim> Vec<Dim> normal_across(const ContactSurface<Dim>& s, int i, int j) {
  const int n = s.nodes_along(0), row = j * n;
  const Vec<Dim> a = between(s, row + std::max(i - 1, 0), row + std::min(i + 1, n - 1));
  if constexpr (Dim == 3) {
    return normal_of(a, between(s, std::max(j - 1, 0) * n + i, std::min(j + 1, s.rows() - 1) * n + i));
  } else {
    return {-a[1], a[0]};
  }
}

} // namespace

template <int Dim> std::array<double, Dim> node_normal(const ContactSurface<Dim>& s, int node) {
  constexpr unsigned all = (1U << Dim) - 1;
  const int n = s.nodes_along(0), i = node % n, j = node / n;
  Vec<Dim> v = whole(s, i, j) ? normal_across(s, i, j) : normal_sum(s, i, j);
  const unsigned held = s.held == nullptr ? 0 : s.held[node];
  double square = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    v[d] = held != all && (held >> d & 1) != 0 ? 0.0 : v[d]; // on a plane of symmetry the mirrored half has its say
    square += v[d] * v[d];
  }
  const double scale = square > 0 ? s.outside / std::sqrt(square) : 0.0;
  for (double& c : v) {
    c *= scale;
  }
  return v;
}

template <int Dim> bool on_sheet(const ContactSurface<Dim>& s, int node) {
  bool any = s.alive == nullptr;
  if (!any) {
    for_each_segment_around(s, node % s.nodes_along(0), node / s.nodes_along(0), [&](int segment, int) { any = any || s.there(segment); });
  }
  return any;
}

template <int Dim> void check_surface(const ContactSurface<Dim>& s, const char* name) {
  const auto refuse = [&](const char* what) { throw Error(fmt::format("contact surface '{}': {}", name, what)); };
  if (s.segments[0] < 1 || s.segments[1] < 1) {
    refuse("needs at least one segment along each axis");
  }
  if (s.outside != 1 && s.outside != -1) {
    refuse("outside is 1 or -1, the sign of the normal's side that touches");
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    if (s.position[d] == nullptr || s.velocity[d] == nullptr) {
      refuse("position or velocity is missing");
    }
  }
  if (s.mass == nullptr || !std::all_of(s.mass, s.mass + s.node_count(), [](double m) { return m > 0; })) {
    refuse("every node needs a mass above 0");
  }
  if (!(s.weight > 0)) {
    refuse("weight must be above 0: contact moves nodes by their velocity");
  }
}

template std::array<double, 2> node_normal<2>(const ContactSurface<2>&, int);
template bool on_sheet<2>(const ContactSurface<2>&, int);
template std::array<double, 3> node_normal<3>(const ContactSurface<3>&, int);
template bool on_sheet<3>(const ContactSurface<3>&, int);
template void check_surface<2>(const ContactSurface<2>&, const char*);
template void check_surface<3>(const ContactSurface<3>&, const char*);

} // namespace ballast
