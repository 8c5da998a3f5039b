#include "ale/traction.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballast {

namespace {

constexpr double full_slip =
    0.05; ///< of a cell: with less soft matter in it the slip law fades out
constexpr double most_ease =
    2; ///< of the cell's shear that a material takes: the soft ones yield anyway

double fraction_of(const MaterialSlot& slot, int r, int i) {
  return slot.store.row(field::fraction, r)[i];
}

/// What of a cell sets the traction: void, else a fluid, else the least flow stress.
struct Weakest {
  std::size_t material = 0;
  double traction = std::numeric_limits<double>::infinity(); ///< shear traction it can carry, Pa
};
template <int Dim> Weakest weakest_of(const Block<Dim>& b, int r, int i) {
  Weakest w;
  for (std::size_t m = 0; m < b.materials.size(); ++m) {
    const MaterialSlot& slot = b.materials[m];
    if (fraction_of(slot, r, i) <= 0) {
      continue;
    }
    const double t = slot.is_void ? -1.0
                     : slot.strength
                         ? slot.store.row(slot.flow_stress_field(), r)[i] / std::sqrt(3.0)
                         : 0.0;
    if (t < w.traction) {
      w = {m, t};
    }
  }
  w.traction = std::max(0.0, w.traction);
  return w;
}

/// Share of the slip law: a trace of soft matter in a corner does not part what is strong.
double slip_share(double weak_fraction) {
  return std::min(1.0, weak_fraction / full_slip);
}

/// Centre of a cell.
template <int Dim> Eigen::Vector3d centre(const Block<Dim>& b, const std::array<int, 3>& cell) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const int r = b.grid.node_row(cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1));
    for (std::size_t d = 0; d < Dim; ++d) {
      x[static_cast<int>(d)] += b.position[d].row(r)[cell[0] + (corner & 1)];
    }
  }
  return x / (1 << Dim);
}

/// Unit normal of material m's surface in a cell, out of the others into it: gradient of its
/// fraction over the neighbours (Youngs), in space. Zero where the fraction does not vary.
template <int Dim>
Eigen::Vector3d normal_of(const Block<Dim>& b, std::size_t m, const std::array<int, 3>& cell) {
  const Grid& g = b.grid;
  Eigen::Vector3d df = Eigen::Vector3d::Zero();
  Eigen::Matrix3d dx = Eigen::Matrix3d::Identity();
  std::array<std::array<int, 3>, 3> at{}; // below, here, above, by axis
  for (std::size_t a = 0; a < 3; ++a) {
    for (int q = 0; q < 3; ++q) {
      at[a][static_cast<std::size_t>(q)] =
          std::clamp(cell[a] + q - 1, 0, std::max(0, g.cells[a] - 1));
    }
  }
  double f[3][3][3];
  for (std::size_t z = 0; z < 3; ++z) {
    for (std::size_t y = 0; y < 3; ++y) {
      const double* row =
          b.materials[m].store.row(field::fraction, g.cell_row(at[1][y], Dim == 3 ? at[2][z] : 0));
      for (std::size_t x = 0; x < 3; ++x) {
        f[z][y][x] = row[at[0][x]];
      }
    }
  }
  const double weight[3] = {1, 2, 1};
  for (int p = 0; p < 3; ++p) {
    for (int q = 0; q < 3; ++q) {
      const double w = weight[p] * weight[q];
      df[0] += w * (f[p][q][2] - f[p][q][0]);
      df[1] += w * (f[p][2][q] - f[p][0][q]);
      df[2] += Dim == 3 ? w * (f[2][p][q] - f[0][p][q]) : 0.0;
    }
  }
  for (int a = 0; a < Dim; ++a) {
    const auto ua = static_cast<std::size_t>(a);
    if (g.cells[ua] == 1) {
      continue; // nothing varies along it
    }
    std::array<int, 3> below = cell, above = cell;
    below[ua] = at[ua][0];
    above[ua] = at[ua][2];
    const bool at_side = above[ua] - below[ua] == 1; // beyond it the mirror image, of the same fraction
    dx.row(a) = (at_side ? 2 : 1) * (centre(b, above) - centre(b, below));
  }
  const Eigen::Vector3d n = dx.inverse() * df;
  const double length = n.norm();
  return std::isfinite(length) && length > 0 ? Eigen::Vector3d(n / length)
                                             : Eigen::Vector3d::Zero();
}

template <int Dim> void traction_cell(Block<Dim>& b, int r, int i, const Eigen::Vector3d& n) {
  MixedCell cell;
  Eigen::Matrix3d T = Eigen::Matrix3d::Zero();
  double soft = 0;
  bool stiff = true;
  for (MaterialSlot& slot : b.materials) {
    const double f = fraction_of(slot, r, i);
    if (f <= 0 || cell.count == max_materials_in_cell) {
      continue;
    }
    MixedCell::Part& p = cell.part[cell.count++];
    p.is_void = slot.is_void;
    p.volume = f;
    stiff = stiff && slot.strength;
    if (slot.is_void) {
      continue;
    }
    p.pressure = std::as_const(slot.store).row(slot.pressure_field(), r)[i];
    p.modulus = std::as_const(slot.store).row(slot.modulus_field(), r)[i];
    if (slot.strength) {
      const Eigen::Matrix3d s = deviator_of<Dim>(slot, r, i);
      const double normal = n.dot(s * n);
      p.pressure -= normal;
      p.modulus += 4.0 / 3.0 * shear_modulus(slot.material.strength);
      T += f * (s - normal * Eigen::Matrix3d::Identity());
      soft += f / shear_modulus(slot.material.strength);
    }
  }
  const CellPressure cp = mixed_pressure(cell, -b.reference_pressure);
  const double mean = T.trace() / 3;
  b.pressure.row(r)[i] = cp.pressure - mean;
  b.modulus.row(r)[i] = cp.modulus;
  b.stress[0].row(r)[i] = T(0, 0) - mean;
  b.stress[1].row(r)[i] = T(1, 1) - mean;
  b.stress[2].row(r)[i] = T(0, 1);
  if constexpr (Dim == 3) {
    b.stress[3].row(r)[i] = T(1, 2);
    b.stress[4].row(r)[i] = T(0, 2);
  }
  b.shear.row(r)[i] = stiff && soft > 0 ? 1 / soft : 0.0;
}

} // namespace

template <> Eigen::Matrix3d deviator_of<2>(const MaterialSlot& slot, int r, int i) {
  const double xx = slot.store.row(field::stress, r)[i],
               yy = slot.store.row(field::stress + 1, r)[i],
               xy = slot.store.row(field::stress + 2, r)[i];
  Eigen::Matrix3d s;
  s << xx, xy, 0, xy, yy, 0, 0, 0, -xx - yy;
  return s;
}
template <> Eigen::Matrix3d deviator_of<3>(const MaterialSlot& slot, int r, int i) {
  const auto at = [&](int a) { return slot.store.row(field::stress + a, r)[i]; };
  Eigen::Matrix3d s;
  s << at(0), at(2), at(4), at(2), at(1), at(3), at(4), at(3), -at(0) - at(1);
  return s;
}

template <> Eigen::Matrix3d gradient_of<2>(const WorkRows<2>& w, int i) {
  Eigen::Matrix3d l;
  l << w.gradient[0][i], w.gradient[1][i], 0, w.gradient[2][i], w.gradient[3][i], 0, 0, 0,
      w.gradient[4][i];
  return l;
}
template <> Eigen::Matrix3d gradient_of<3>(const WorkRows<3>& w, int i) {
  Eigen::Matrix3d l;
  for (int q = 0; q < 9; ++q) {
    l(q / 3, q % 3) = w.gradient[q][i];
  }
  return l;
}

template <int Dim> void update_traction(Block<Dim>& b, ThreadPool& pool) {
  if (!b.any_strength() || b.materials.size() < 2) {
    return;
  }
  const Grid& g = b.grid;
  b.interface_normals.resize(static_cast<std::size_t>(g.cell_rows()));
  parallel_ranges(pool, g.slabs(), [&](int begin, int end, int) {
    RowRuns runs;
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        auto& normals = b.interface_normals[static_cast<std::size_t>(r)];
        normals.clear();
        runs.scan(b.owner_row(r), g.cells[0]);
        for (const int i : runs.mixed) {
          const Eigen::Vector3d n = normal_of(b, weakest_of(b, r, i).material, {i, j, k});
          normals.push_back({n[0], n[1], n[2]});
          traction_cell(b, r, i, n);
        }
      }
    }
  });
}

template <int Dim>
void share_strain(const Block<Dim>& b,
                  const MixedCell& cell,
                  const Eigen::Vector3d& n,
                  int r,
                  int i,
                  const Eigen::Matrix3d& gradient,
                  double compression,
                  double (*out)[9],
                  double* work) {
  double soft = 0, whole = 0;
  bool fluid = false;
  for (int k = 0; k < cell.count; ++k) {
    const MaterialSlot& slot = b.materials[static_cast<std::size_t>(cell.part[k].material)];
    whole += cell.part[k].volume;
    fluid = fluid || !slot.strength;
    soft += slot.strength ? cell.part[k].volume / shear_modulus(slot.material.strength) : 0.0;
  }
  const double weight = slip_share(fraction_of(b.materials[weakest_of(b, r, i).material], r, i));
  Eigen::Vector3d shear = (gradient + gradient.transpose()) * n;
  shear -= n.dot(shear) * n;
  for (int k = 0; k < cell.count; ++k) {
    const MixedCell::Part& p = cell.part[k];
    const MaterialSlot& slot = b.materials[static_cast<std::size_t>(p.material)];
    work[k] = 0;
    if (!slot.strength) {
      continue;
    }
    const double volume = p.volume * (1 + compression);
    const double ease = fluid ? 0.0 : whole / (shear_modulus(slot.material.strength) * soft);
    const double stretch = p.volume_change / volume - gradient.trace();
    const Eigen::Vector3d jump = stretch * n + weight * (std::min(ease, most_ease) - 1) * shear;
    const Eigen::Matrix3d l = gradient + jump * n.transpose();
    const Eigen::Matrix3d s = deviator_of<Dim>(slot, r, i);
    work[k] = volume * ((s.cwiseProduct(l)).sum() - n.dot(s * n) * l.trace());
    double* o = out[k];
    if constexpr (Dim == 2) {
      o[0] = l(0, 0);
      o[1] = l(0, 1);
      o[2] = l(1, 0);
      o[3] = l(1, 1);
      o[4] = l(2, 2);
    } else {
      for (int q = 0; q < 9; ++q) {
        o[q] = l(q / 3, q % 3);
      }
    }
  }
}

template <int Dim>
void cut_traction(Block<Dim>& b, MaterialSlot& slot, const Eigen::Vector3d& n, int r, int i) {
  const Weakest w = weakest_of(b, r, i);
  const double weight = slip_share(fraction_of(b.materials[w.material], r, i));
  const Eigen::Matrix3d s = deviator_of<Dim>(slot, r, i);
  Eigen::Vector3d t = s * n;
  t -= n.dot(t) * n;
  const double size = t.norm();
  if (!(size > w.traction)) {
    return;
  }
  const Eigen::Vector3d d = weight * (w.traction / size - 1) * t;
  const auto add = [&](int component, int x, int y) {
    slot.store.row(field::stress + component, r)[i] += d[x] * n[y] + n[x] * d[y];
  };
  add(0, 0, 0);
  add(1, 1, 1);
  add(2, 0, 1);
  if constexpr (Dim == 3) {
    add(3, 1, 2);
    add(4, 0, 2);
  }
}

template void update_traction<2>(Block<2>&, ThreadPool&);
template void update_traction<3>(Block<3>&, ThreadPool&);
template void share_strain<2>(const Block<2>&,
                              const MixedCell&,
                              const Eigen::Vector3d&,
                              int,
                              int,
                              const Eigen::Matrix3d&,
                              double,
                              double (*)[9],
                              double*);
template void share_strain<3>(const Block<3>&,
                              const MixedCell&,
                              const Eigen::Vector3d&,
                              int,
                              int,
                              const Eigen::Matrix3d&,
                              double,
                              double (*)[9],
                              double*);
template void cut_traction<2>(Block<2>&, MaterialSlot&, const Eigen::Vector3d&, int, int);
template void cut_traction<3>(Block<3>&, MaterialSlot&, const Eigen::Vector3d&, int, int);

} // namespace ballast
