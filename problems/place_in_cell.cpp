#include "problems/place_in_cell.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace ballast {

template <int Dim> std::array<double, 2> node_range(const Block<Dim>& b, int component, const std::array<int, 3>& cell) {
  std::array<double, 2> x = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const int r = b.grid.node_row(cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1));
    const double at = b.position[static_cast<std::size_t>(component)].row(r)[cell[0] + (corner & 1)];
    x = {std::min(x[0], at), std::max(x[1], at)};
  }
  return x;
}

template <int Dim> std::array<double, Dim> place_in_cell(const Block<Dim>& b, const std::array<int, 3>& cell, const std::array<double, 3>& at) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  std::array<double, Dim> s{};
  s.fill(0.5);
  for (int turn = 0; turn < 8; ++turn) {
    Vector miss;
    Eigen::Matrix<double, Dim, Dim> slope = Eigen::Matrix<double, Dim, Dim>::Zero();
    for (int d = 0; d < Dim; ++d) {
      miss[d] = at[static_cast<std::size_t>(d)];
    }
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      const int r = b.grid.node_row(cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1));
      for (int d = 0; d < Dim; ++d) {
        const double x = b.position[static_cast<std::size_t>(d)].row(r)[cell[0] + (corner & 1)];
        double all = x;
        for (int a = 0; a < Dim; ++a) {
          const double part = s[static_cast<std::size_t>(a)];
          all *= (corner >> a & 1) != 0 ? part : 1 - part;
          double others = (corner >> a & 1) != 0 ? x : -x;
          for (int c = 0; c < Dim; ++c) {
            const double q = s[static_cast<std::size_t>(c)];
            others *= c == a ? 1 : (corner >> c & 1) != 0 ? q : 1 - q;
          }
          slope(d, a) += others;
        }
        miss[d] -= all;
      }
    }
    const Vector step = slope.inverse() * miss;
    for (int a = 0; a < Dim; ++a) {
      s[static_cast<std::size_t>(a)] = std::clamp(s[static_cast<std::size_t>(a)] + step[a], 0.0, 1.0);
    }
  }
  return s;
}

template std::array<double, 2> node_range<2>(const Block<2>&, int, const std::array<int, 3>&);
template std::array<double, 2> node_range<3>(const Block<3>&, int, const std::array<int, 3>&);
template std::array<double, 2> place_in_cell<2>(const Block<2>&, const std::array<int, 3>&, const std::array<double, 3>&);
template std::array<double, 3> place_in_cell<3>(const Block<3>&, const std::array<int, 3>&, const std::array<double, 3>&);

} // namespace ballast
