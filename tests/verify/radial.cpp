#include "tests/verify/radial.hpp"

#include <cmath>

namespace ballast::verify {

template <int Dim> double centre_radius(const Block<Dim>& b, int i, int j, int k) {
  double r2 = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    double x = 0;
    for (int c = 0; c < (1 << Dim); ++c) {
      x += b.position[d].row(b.grid.node_row(j + ((c >> 1) & 1), k + ((c >> 2) & 1)))[i + (c & 1)] / (1 << Dim);
    }
    r2 += x * x;
  }
  return std::sqrt(r2);
}

template <int Dim> std::vector<TubeCell> radial_density(const Block<Dim>& b, double thick) {
  std::vector<double> mass(2000), volume(2000);
  for_each_cell(b, [&](int i, int j, int k) {
    const auto shell = static_cast<std::size_t>(centre_radius(b, i, j, k) / thick);
    const int r = b.grid.cell_row(j, k);
    mass[shell] += b.density.row(r)[i] * b.volume.row(r)[i];
    volume[shell] += b.volume.row(r)[i];
  });
  std::vector<TubeCell> out;
  for (std::size_t s = 0; s < mass.size(); ++s) {
    if (volume[s] > 0) {
      out.push_back({(static_cast<double>(s) + 0.5) * thick, thick, mass[s] / volume[s], 0, 0, false});
    }
  }
  return out;
}

template <int Dim> Spread density_spread(const Block<Dim>& b, double from, double to) {
  Spread s{0, std::numeric_limits<double>::infinity(), 0};
  double volume = 0;
  for_each_cell(b, [&](int i, int j, int k) {
    const double radius = centre_radius(b, i, j, k);
    if (radius >= from && radius <= to) {
      const int r = b.grid.cell_row(j, k);
      const double rho = b.density.row(r)[i];
      s.mean += rho * b.volume.row(r)[i];
      volume += b.volume.row(r)[i];
      s.low = std::min(s.low, rho);
      s.high = std::max(s.high, rho);
    }
  });
  s.mean /= volume;
  return s;
}

template double centre_radius<2>(const Block<2>&, int, int, int);
template double centre_radius<3>(const Block<3>&, int, int, int);
template std::vector<TubeCell> radial_density<2>(const Block<2>&, double);
template std::vector<TubeCell> radial_density<3>(const Block<3>&, double);
template Spread density_spread<2>(const Block<2>&, double, double);
template Spread density_spread<3>(const Block<3>&, double, double);

} // namespace ballast::verify
