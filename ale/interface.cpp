#include "ale/interface.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

constexpr double spread = 0.1;       ///< weight of the gradients' spread beside their mean in the normal
constexpr double no_gradient = 1e-6; ///< of fraction from cell to cell

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

/// Direction in which a matrix with no negative eigenvalue is largest, zero if that is below `least`.
template <int Dim> Eigen::Vector3d principal(const Eigen::Matrix3d& m, double least) {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  if (!(m.trace() > least)) {
    return n;
  }
  if constexpr (Dim == 2) {
    const double d = 0.5 * (m(0, 0) - m(1, 1)), h = std::sqrt(d * d + m(0, 1) * m(0, 1));
    n = d >= 0 ? Eigen::Vector3d(d + h, m(0, 1), 0) : Eigen::Vector3d(m(0, 1), h - d, 0);
  } else {
    n = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors().col(2);
  }
  const double length = n.norm();
  return length > 0 ? Eigen::Vector3d(n / length) : Eigen::Vector3d::Zero();
}

} // namespace

double CellLayers::slip() const {
  double soft = 0;
  const double strongest = count > 0 ? layer[static_cast<std::size_t>(count) - 1].traction : 0.0;
  for (const Layer& l : *this) {
    soft += strongest > 0 ? l.fraction * (1 - l.traction / strongest) : 0.0;
  }
  return std::min(1.0, soft / full_slip);
}

double CellLayers::carried(double own) const {
  double softer = 0, limit = own;
  for (const Layer& l : *this) {
    softer += l.traction < own ? l.fraction : 0.0;
  }
  for (int k = count - 1; k >= 0; --k) {
    const Layer& l = layer[static_cast<std::size_t>(k)];
    if (l.traction < own) {
      limit += std::min(1.0, softer / full_slip) * (l.traction - limit);
      softer -= l.fraction;
    }
  }
  return limit;
}

template <int Dim> CellLayers layers_of(const Block<Dim>& b, int r, int i) {
  CellLayers c;
  for (std::size_t m = 0; m < b.materials.size() && c.count < max_materials_in_cell; ++m) {
    const MaterialSlot& slot = b.materials[m];
    const double f = slot.store.row(field::fraction, r)[i];
    if (f > 0) {
      const double t = slot.strength ? slot.store.row(slot.flow_stress_field(), r)[i] / std::sqrt(3.0) : 0.0;
      int at = c.count++;
      for (; at > 0 && c.layer[static_cast<std::size_t>(at) - 1].traction > t; --at) {
        c.layer[static_cast<std::size_t>(at)] = c.layer[static_cast<std::size_t>(at) - 1];
      }
      c.layer[static_cast<std::size_t>(at)] = {m, f, t};
    }
  }
  return c;
}

/// From a cell at a side of axis `a` to the next cell, m: half of that from beyond the side, where a symmetry plane or a wall has
/// the cell's mirror image and any other side a cell as far away.
template <int Dim> static Eigen::Vector3d step_at_side(const Block<Dim>& b, int a, const std::array<int, 3>& cell) {
  const auto ua = static_cast<std::size_t>(a);
  const int side = cell[ua] == 0 ? 0 : 1, sign = side == 0 ? 1 : -1;
  std::array<int, 3> inside = cell, edge = cell;
  inside[ua] += sign;
  edge[ua] += side;
  const Eigen::Vector3d here = centre(b, cell), step = sign * (centre(b, inside) - here);
  const int d = b.boundary.fixes_normal_velocity(a, side) ? b.boundary.normal_of(a, side) : -1;
  if (d < 0) {
    return step;
  }
  const double plane = b.position[static_cast<std::size_t>(d)].row(b.grid.node_row(edge[1], edge[2]))[edge[0]];
  Eigen::Vector3d beyond = Eigen::Vector3d::Zero(); // from the cell, outwards
  beyond[d] = 2 * (plane - here[d]);
  return 0.5 * (step - sign * beyond);
}

template <int Dim>
Eigen::Vector3d interface_normal(const Block<Dim>& b, const CellLayers& layers, const std::array<int, 3>& cell) {
  const Grid& g = b.grid;
  Eigen::Matrix3d dx = Eigen::Matrix3d::Identity();
  std::array<std::array<int, 3>, 3> at{}; // below, here, above, by axis
  for (std::size_t a = 0; a < 3; ++a) {
    for (int q = 0; q < 3; ++q) {
      at[a][static_cast<std::size_t>(q)] = std::clamp(cell[a] + q - 1, 0, std::max(0, g.cells[a] - 1));
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
    const bool at_side = above[ua] - below[ua] == 1; // beyond it is a cell of the same fraction
    dx.row(a) = at_side ? step_at_side(b, a, cell) : Eigen::Vector3d(0.5 * (centre(b, above) - centre(b, below)));
  }
  const Eigen::Matrix3d to_space = dx.inverse();
  const double size = dx.topLeftCorner<Dim, Dim>().squaredNorm();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double f[3][3][3] = {}, softer = 0;
  for (auto layer = layers.begin(); layer + 1 < layers.end(); ++layer) {
    softer += layer->fraction;
    for (std::size_t z = 0; z < (Dim == 3 ? 3 : 1); ++z) {
      for (std::size_t y = 0; y < 3; ++y) {
        const double* row = b.materials[layer->material].store.row(
            field::fraction, g.cell_row(at[1][y], Dim == 3 ? at[2][z] : 0));
        for (std::size_t x = 0; x < 3; ++x) {
          f[z][y][x] += row[at[0][x]];
        }
      }
    }
    constexpr int corners = 1 << Dim;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (int corner = 0; corner < corners; ++corner) {
      Eigen::Vector3d df = Eigen::Vector3d::Zero();
      for (int q = 0; q < corners; ++q) {
        const double value = f[(corner >> 2) + (q >> 2)][(corner >> 1 & 1) + (q >> 1 & 1)][(corner & 1) + (q & 1)];
        for (int a = 0; a < Dim; ++a) {
          df[a] += (q >> a & 1) != 0 ? value : -value;
        }
      }
      const Eigen::Vector3d gradient = to_space * (df * (2.0 / corners));
      mean += gradient / corners;
      square += gradient * gradient.transpose() / corners;
    }
    sum += std::min(softer, 1 - softer) * ((1 - spread) * mean * mean.transpose() + spread * square);
  }
  return principal<Dim>(sum, no_gradient * no_gradient / size);
}

template CellLayers layers_of<2>(const Block<2>&, int, int);
template CellLayers layers_of<3>(const Block<3>&, int, int);
template Eigen::Vector3d interface_normal<2>(const Block<2>&, const CellLayers&, const std::array<int, 3>&);
template Eigen::Vector3d interface_normal<3>(const Block<3>&, const CellLayers&, const std::array<int, 3>&);

} // namespace ballast
