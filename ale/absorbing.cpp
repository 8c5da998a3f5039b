#include "ale/absorbing.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace ballast {

namespace {

template <int Dim> using Vector = Eigen::Matrix<double, Dim, 1>;
template <int Dim> using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim> Vector<Dim> position_of(const Block<Dim>& b, const std::array<int, 3>& node) {
  Vector<Dim> x;
  for (int d = 0; d < Dim; ++d) {
    x[d] = b.position[static_cast<std::size_t>(d)].row(b.grid.node_row(node[1], node[2]))[node[0]];
  }
  return x;
}

/// The node's share of the area (m2; by metre of depth; around the axis) of an edge cell's face across `axis`; `step` leads along the
/// face, by axis, from the node to the cell's other nodes.
template <int Dim> Vector<Dim> area_share(const Block<Dim>& b, const std::array<int, 3>& node, int axis, const std::array<int, 3>& step) {
  const auto at = [&](bool first, bool second) { // along the face's one or two directions
    std::array<int, 3> n = node;
    bool used = false;
    for (int d = 0; d < Dim; ++d) {
      if (d != axis) {
        const auto a = static_cast<std::size_t>(d);
        n[a] += (used ? second : first) ? step[a] : 0;
        used = true;
      }
    }
    return position_of(b, n);
  };
  if constexpr (Dim == 2) {
    const Vector<2> here = at(false, false), there = at(true, false), along = there - here;
    const double weight = b.axisymmetric ? std::numbers::pi * (2 * here[0] + there[0]) / 3 : 0.5;
    return weight * Vector<2>(-along[1], along[0]);
  } else {
    const Vector<3> a = at(true, true) - at(false, false), c = at(true, false) - at(false, true);
    return 0.125 * a.cross(c);
  }
}

/// Z of one node, kg/s: of every edge cell of every absorbing side that it touches.
template <int Dim> Matrix<Dim> impedance(const Block<Dim>& b, const std::array<int, 3>& node) {
  const Grid& g = b.grid;
  Matrix<Dim> z = Matrix<Dim>::Zero();
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const auto a = static_cast<std::size_t>(axis);
      if (b.boundary.at(axis, side).kind != BoundaryKind::absorbing || node[a] != (side == 0 ? 0 : g.cells[a])) {
        continue;
      }
      for (int corner = 0; corner < (1 << Dim); ++corner) {
        if ((corner >> axis & 1) != side) {
          continue; // bit d: the cell below the node along d
        }
        std::array<int, 3> cell = node, step = {0, 0, 0};
        bool inside = true;
        for (int d = 0; d < Dim; ++d) {
          const auto q = static_cast<std::size_t>(d);
          cell[q] -= corner >> d & 1;
          step[q] = (corner >> d & 1) != 0 ? -1 : 1;
          inside = inside && cell[q] >= 0 && cell[q] < g.cells[q];
        }
        if (!inside) {
          continue;
        }
        const int r = g.cell_row(cell[1], cell[2]), i = cell[0];
        if (!(b.modulus.row(r)[i] > 0)) {
          continue; // void beside it: nothing presses from beyond
        }
        const Vector<Dim> area = area_share(b, node, axis, step);
        const double size = area.norm(), rho = b.density.row(r)[i], shear = b.any_strength() ? b.shear.row(r)[i] : 0.0;
        if (!(size > 0)) {
          continue;
        }
        const Matrix<Dim> normal = area * area.transpose() / (size * size);
        z += size * rho * b.wave_speed.row(r)[i] * normal + size * std::sqrt(rho * shear) * (Matrix<Dim>::Identity() - normal);
      }
    }
  }
  for (int axis = 0; axis < Dim; ++axis) { // where another side sets the node's velocity no traction moves it
    const auto a = static_cast<std::size_t>(axis);
    const auto sets = [&](int side) { return b.boundary.fixes_normal_velocity(axis, side) || b.boundary.at(axis, side).kind == BoundaryKind::outflow; };
    if ((node[a] == 0 && sets(0)) || (node[a] == g.cells[a] && sets(1))) {
      z.row(axis).setZero();
      z.col(axis).setZero();
    }
  }
  return z;
}

} // namespace

template <int Dim> void absorb_row(Block<Dim>& b, int j, int k, double dt, double* const (&force)[Dim], BoundaryEffect& effect) {
  const Grid& g = b.grid;
  const int r = g.node_row(j, k), index[3] = {0, j, k};
  const auto absorbs = [&](int axis, int side) { return b.boundary.at(axis, side).kind == BoundaryKind::absorbing; };
  bool whole_row = false;
  for (int axis = 1; axis < Dim; ++axis) {
    whole_row = whole_row || (index[axis] == 0 && absorbs(axis, 0)) || (index[axis] == g.cells[static_cast<std::size_t>(axis)] && absorbs(axis, 1));
  }
  const double* m = b.node_mass.row(r);
  const Span nodes = b.awake.nodes(r);
  for (int i = nodes.begin; i < nodes.end; ++i) {
    const bool edge = (i == 0 && absorbs(0, 0)) || (i == g.cells[0] && absorbs(0, 1));
    if (!(whole_row || edge) || !(m[i] > 0)) {
      continue;
    }
    const Matrix<Dim> z = impedance(b, {i, j, k});
    // Where two velocities meet the traction moves both alike: their centre of mass is what it sees and works on.
    Vector<Dim> u, free, apart;
    for (int d = 0; d < Dim; ++d) {
      const auto a = static_cast<std::size_t>(d);
      u[d] = mean_velocity<Dim>(b, b.velocity, b.sliding.jump, a, r, i);
      free[d] = mean_velocity<Dim>(b, b.next_velocity, b.sliding.next_jump, a, r, i);
      apart[d] = free[d] - b.next_velocity[a].row(r)[i];
    }
    const Matrix<Dim> half = (0.5 * dt / m[i]) * z;
    const Vector<Dim> next = (Matrix<Dim>::Identity() + half).inverse() * (free - half * u);
    const Vector<Dim> mean = 0.5 * (u + next), pull = -(z * mean);
    for (int d = 0; d < Dim; ++d) {
      const auto a = static_cast<std::size_t>(d);
      b.next_velocity[a].row(r)[i] = next[d] - apart[d];
      force[d][i] += pull[d];
      effect.impulse[a] += dt * pull[d];
    }
    effect.work += dt * pull.dot(mean);
  }
}

template <int Dim> std::array<double, Dim> absorbing_force(const Block<Dim>& b, const std::array<int, 3>& node) {
  const int r = b.grid.node_row(node[1], node[2]), i = node[0];
  Vector<Dim> mean;
  for (int d = 0; d < Dim; ++d) {
    const auto a = static_cast<std::size_t>(d);
    mean[d] = 0.5 * (mean_velocity<Dim>(b, b.velocity, b.sliding.jump, a, r, i) + mean_velocity<Dim>(b, b.next_velocity, b.sliding.next_jump, a, r, i));
  }
  const Vector<Dim> pull = -(impedance(b, node) * mean);
  std::array<double, Dim> force;
  std::copy(pull.begin(), pull.end(), force.begin());
  return force;
}

template std::array<double, 2> absorbing_force<2>(const Block<2>&, const std::array<int, 3>&);
template std::array<double, 3> absorbing_force<3>(const Block<3>&, const std::array<int, 3>&);
template void absorb_row<2>(Block<2>&, int, int, double, double* const (&)[2], BoundaryEffect&);
template void absorb_row<3>(Block<3>&, int, int, double, double* const (&)[3], BoundaryEffect&);

} // namespace ballast
