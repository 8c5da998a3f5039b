// Rows of face fluxes: mass from volume by a limited density, other quantities with the mass.
//
// A face carries t along +axis, out of the cell below it for t > 0, above for t < 0.
#pragma once

#include "core/awake.hpp"
#include "core/grid.hpp"
#include "core/tile_store.hpp"
#include "remap/limiter.hpp"

#include <cmath>
#include <vector>

namespace ballast::remap {

inline constexpr double slope_fraction = 0.999;    ///< a donor holding less has no slope
inline constexpr double neighbour_fraction = 0.01; ///< nor has one beside a cell holding less

/// The four rows along the axis around a row of faces: cells two below, below, above, two above.
struct Line {
  int row[4];
  int shift[4]; // of i, for axis 0
};

inline Line line_of(const Grid& g, int axis, int j, int k) {
  const int r = g.cell_row(j, k), s = g.cell_row_stride(axis);
  if (axis == 0) {
    return {{r, r, r, r}, {-2, -1, 0, 1}};
  }
  return {{r - 2 * s, r - s, r, r + s}, {0, 0, 0, 0}};
}

/// RiseFactors of a row of faces in the mass coordinate.
struct FaceFactors {
  std::vector<double> central, edge;
  explicit FaceFactors(int faces) : central(static_cast<std::size_t>(faces)), edge(static_cast<std::size_t>(faces)) {}
};

/// Pointers of one quantity at the four cells of a line, shifted to face 0.
struct Four {
  const double* q[4];
};
inline Four four(const TileStore& s, int field, const Line& l) {
  return {{s.row(field, l.row[0]) + l.shift[0], s.row(field, l.row[1]) + l.shift[1],
           s.row(field, l.row[2]) + l.shift[2], s.row(field, l.row[3]) + l.shift[3]}};
}

/// Donor of face i, the cell it flows from (behind) and the one it flows to (ahead).
/// All four are loaded, then selected: a conditional load would keep the row loop from vectorising.
struct Three {
  double behind, mid, ahead;
};
[[gnu::always_inline]] inline Three pick(const Four& f, int i, std::uint64_t positive) {
  const double a = f.q[0][i], b = f.q[1][i], c = f.q[2][i], d = f.q[3][i];
  return {select(positive, a, d), select(positive, b, c), select(positive, c, b)};
}

/// Masses (kg) from volumes (m3) through a row of faces, by the limited density; factors for what they carry.
inline void mass_fluxes(const TileStore& store, const RowField& volumes, const Line& l, double unlimited, Span faces, const double* volume_flux, double* mass_flux, FaceFactors& factors) {
  const Four f = four(store, 0, l), m = four(store, 1, l);
  const Four v{{volumes.row(l.row[0]) + l.shift[0], volumes.row(l.row[1]) + l.shift[1],
                volumes.row(l.row[2]) + l.shift[2], volumes.row(l.row[3]) + l.shift[3]}};
  double *central = factors.central.data(), *edge = factors.edge.data();
#pragma omp simd
  for (int i = faces.begin; i < faces.end; ++i) {
    const double t = volume_flux[i];
    const std::uint64_t positive = where_positive(t);
    const Three vf = pick(f, i, positive), vm = pick(m, i, positive), vv = pick(v, i, positive);
    const bool good = (vf.mid > slope_fraction) & (vf.behind > neighbour_fraction) & (vf.ahead > neighbour_fraction);
    const auto density = [](double mass, double fraction, double volume) {
      const double held = fraction * volume;
      return mass / (held > 1e-300 ? held : 1e-300);
    };
    const double rho = density(vm.mid, vf.mid, vv.mid);
    const RiseFactors kv = rise_factors(0.5 * (vv.behind + vv.mid), 0.5 * (vv.mid + vv.ahead), vv.mid, 0.5 * (vv.mid - std::abs(t)));
    const double rise = limited_rise(density(vm.behind, vf.behind, vv.behind), rho, density(vm.ahead, vf.ahead, vv.ahead), kv.central, kv.edge, unlimited);
    const double some = t * (rho + (good ? rise : 0.0));
    const bool whole = (std::abs(t) == vf.mid * vv.mid) & (t != 0); // nothing stays behind, not even round-off
    const double all = select(positive, vm.mid, -vm.mid), given = whole ? all : some;
    mass_flux[i] = given;
    const RiseFactors km = rise_factors(0.5 * (vm.behind + vm.mid) + 1e-300, 0.5 * (vm.mid + vm.ahead) + 1e-300, vm.mid + 1e-300,
                                        0.5 * (vm.mid - std::abs(given)));
    central[i] = good ? km.central : 0.0;
    edge[i] = good ? km.edge : 0.0;
  }
}

/// An intensive quantity carried with the mass.
inline void intensive_fluxes(const TileStore& store, int field, const Line& l, double unlimited, Span faces, const double* mass_flux, const FaceFactors& factors, double* out) {
  const Four q = four(store, field, l);
  const double *central = factors.central.data(), *edge = factors.edge.data();
#pragma omp simd
  for (int i = faces.begin; i < faces.end; ++i) {
    const double t = mass_flux[i];
    const Three vq = pick(q, i, where_positive(t));
    out[i] = t * (vq.mid + limited_rise(vq.behind, vq.mid, vq.ahead, central[i], edge[i], unlimited));
  }
}

} // namespace ballast::remap
