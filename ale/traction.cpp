#include "ale/traction.hpp"

#include "ale/interface.hpp"
#include "ale/tissue_update.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ballast {

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

namespace {

constexpr double most_ease = 2; ///< of the cell's shear that a material takes: what yields carries no more

/// Cuts the shear traction of each deviator to what the interface carries. Twice is as good as once.
template <int Dim>
void cut_tractions(Block<Dim>& b, const CellLayers& layers, const Eigen::Vector3d& n, int r, int i) {
  for (const CellLayers::Layer& l : layers) {
    MaterialSlot& slot = b.materials[l.material];
    if (!slot.strength) {
      continue;
    }
    const Eigen::Matrix3d s = deviator_of<Dim>(slot, r, i);
    Eigen::Vector3d t = s * n;
    t -= n.dot(t) * n;
    const double size = t.norm(), carried = layers.carried(l.traction);
    if (!(size > carried + 1e-12 * l.traction)) { // not for round-off
      continue;
    }
    const Eigen::Vector3d d = (carried / size - 1) * t;
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
    if (slot.memories > 0) {
      free_memory<Dim>(slot, {d[0], d[1], d[2]}, {n[0], n[1], n[2]}, r, i);
    }
  }
}

template <int Dim> void traction_cell(Block<Dim>& b, int r, int i, const Eigen::Vector3d& n) {
  MixedCell cell;
  Eigen::Matrix3d T = Eigen::Matrix3d::Zero();
  double soft = 0;
  bool stiff = true;
  for (MaterialSlot& slot : b.materials) {
    const double f = std::as_const(slot).store.row(field::fraction, r)[i];
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
      p.modulus += n.squaredNorm() * 4 / 3 * shear_of(slot, r, i);
      T += f * (s - normal * Eigen::Matrix3d::Identity());
      soft += f / shear_of(slot, r, i);
    }
  }
  stiffen_cold(cell, b.reference_pressure);
  const CellPressure cp = mixed_pressure(b.closure, cell, -b.reference_pressure);
  const double mean = T.trace() / 3;
  b.pressure.row(r)[i] = cp.pressure - mean;
  b.stress[0].row(r)[i] = T(0, 0) - mean;
  b.stress[1].row(r)[i] = T(1, 1) - mean;
  b.stress[2].row(r)[i] = T(0, 1);
  if constexpr (Dim == 3) {
    b.stress[3].row(r)[i] = T(1, 2);
    b.stress[4].row(r)[i] = T(0, 2);
  }
  const double shear = stiff && soft > 0 ? 1 / soft : 0.0;
  b.shear.row(r)[i] = shear;
  b.modulus.row(r)[i] = std::max(0.0, cp.modulus - n.squaredNorm() * 4 / 3 * shear); // the force adds it for dev D
}

/// Makes the row's list of normals as long as its mixed cells are many, `awake` of them awake; those asleep keep theirs.
/// Returns the place of the first one awake.
template <int Dim> std::size_t make_room(Block<Dim>& b, int r, std::size_t awake) {
  auto& normals = b.interface_normals[static_cast<std::size_t>(r)];
  const Span cells = b.awake.cells(r);
  const std::int8_t* owner = b.owner_row(r);
  const auto before = std::count(owner, owner + cells.begin, mixed_cell);
  const auto after = std::count(owner + cells.end, owner + b.grid.cells[0], mixed_cell);
  const auto old = static_cast<std::ptrdiff_t>(normals.size()) - before - after, now = static_cast<std::ptrdiff_t>(awake);
  if (old > now) {
    normals.erase(normals.begin() + before + now, normals.begin() + before + old);
  } else {
    normals.insert(normals.begin() + before + old, static_cast<std::size_t>(now - old), {0, 0, 0});
  }
  return static_cast<std::size_t>(before);
}

} // namespace

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

template <int Dim> void update_traction(Block<Dim>& b, ThreadPool& pool, bool cut) {
  if (!b.any_strength() || b.materials.size() < 2) {
    return;
  }
  const Grid& g = b.grid;
  b.interface_normals.resize(static_cast<std::size_t>(g.cell_rows()));
  parallel_awake(pool, &b.awake, g.slabs(), [&](int begin, int end, int) {
    RowRuns runs;
    for (int s = begin; s < end; ++s) {
      for (int q = 0; q < g.rows_per_slab(); ++q) {
        const auto [j, k] = g.in_slab(s, q);
        const int r = g.cell_row(j, k);
        const Span awake = b.awake.cells(r);
        if (awake.empty()) {
          continue;
        }
        runs.scan(b.owner_row(r), awake);
        std::size_t at = make_room(b, r, runs.mixed.size());
        auto& normals = b.interface_normals[static_cast<std::size_t>(r)];
        for (const int i : runs.mixed) {
          const CellLayers layers = layers_of(b, r, i);
          const Eigen::Vector3d n = interface_normal(b, layers, {i, j, k});
          normals[at++] = {n[0], n[1], n[2]};
          if (cut) {
            cut_tractions(b, layers, n, r, i);
          }
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
  const CellLayers layers = layers_of(b, r, i);
  const double slip = layers.slip();
  const auto tangential = [&](const Eigen::Vector3d& v) { return Eigen::Vector3d(v - n.dot(v) * n); };
  const Eigen::Vector3d shear = tangential((gradient + gradient.transpose()) * n);
  // The traction that all would share if nothing yielded, then what the interface carries.
  Eigen::Vector3d common = shear;
  double soft = 0, open = 0, strongest = 0, yielding = 0;
  for (const CellLayers::Layer& l : layers) {
    const MaterialSlot& slot = b.materials[l.material];
    if (slot.strength) {
      const double compliance = l.fraction / shear_of(slot, r, i);
      common += compliance * tangential(deviator_of<Dim>(slot, r, i) * n);
      soft += compliance;
    } else {
      open += l.fraction;
    }
    strongest = std::max(strongest, l.traction);
  }
  common /= soft > 0 ? soft : 1;
  const double carried = layers.carried(strongest), size = common.norm();
  common *= size > carried ? carried / size : 1.0;
  const auto elastic = [&](const MaterialSlot& slot) {
    return Eigen::Vector3d((common - tangential(deviator_of<Dim>(slot, r, i) * n)) / shear_of(slot, r, i));
  };
  // What is then left of the shear is slip: in what is open, else in what yields.
  Eigen::Vector3d rest = (1 - std::min(1.0, open / full_slip)) * shear;
  for (const CellLayers::Layer& l : layers) {
    if (b.materials[l.material].strength) {
      rest -= l.fraction * elastic(b.materials[l.material]);
      yielding += l.fraction * (strongest - l.traction);
    }
  }
  rest *= size > carried && yielding > 0 ? 1 / yielding : 0.0;
  for (int k = 0; k < cell.count; ++k) {
    const MixedCell::Part& p = cell.part[k];
    const MaterialSlot& slot = b.materials[static_cast<std::size_t>(p.material)];
    work[k] = 0;
    if (!slot.strength) {
      continue;
    }
    const double volume = p.volume * (1 + compression);
    const Eigen::Matrix3d s = deviator_of<Dim>(slot, r, i);
    const double traction = slot.store.row(slot.flow_stress_field(), r)[i] / std::sqrt(3.0);
    Eigen::Vector3d own = elastic(slot) + (strongest - traction) * rest;
    const double most = most_ease * shear.norm();
    own *= own.norm() > most ? most / own.norm() : 1.0;
    const double stretch = p.volume_change / volume - gradient.trace();
    const Eigen::Vector3d jump = stretch * n + slip * (own - shear);
    const Eigen::Matrix3d l = gradient + jump * n.transpose();
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

template void update_traction<2>(Block<2>&, ThreadPool&, bool);
template void update_traction<3>(Block<3>&, ThreadPool&, bool);
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

} // namespace ballast
