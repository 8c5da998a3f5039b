#include "problems/exact_solution.hpp"

#include "ale/fill.hpp"

#include <cmath>

namespace ballast {

namespace {

struct Deviation {
  double sum = 0, exact_sum = 0, most = 0, exact_most = 0;
  void add(double got, double want, double weight) {
    sum += weight * std::abs(got - want);
    exact_sum += weight * std::abs(want);
    most = std::max(most, std::abs(got - want));
    exact_most = std::max(exact_most, std::abs(want));
  }
};

} // namespace

template <int Dim> std::map<std::string, double> exact_errors(const Block<Dim>& b, const ExactSolution& exact, double t) {
  const auto axis = static_cast<std::size_t>(exact.axis);
  Deviation density, velocity, pressure;
  for_each_cell(b, [&](int i, int j, int k) {
    double x = 0, u = 0;
    for (int corner = 0; corner < (1 << Dim); ++corner) {
      const int r = b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1)), n = i + (corner & 1);
      x += b.position[axis].row(r)[n] / (1 << Dim);
      u += b.velocity[axis].row(r)[n] / (1 << Dim);
    }
    const int r = b.grid.cell_row(j, k);
    const ExactState want = exact.at(x, t);
    const double volume = b.volume.row(r)[i];
    density.add(b.density.row(r)[i], want.density, volume);
    velocity.add(u, want.velocity, volume);
    pressure.add(b.pressure.row(r)[i] + b.reference_pressure, want.pressure, volume);
  });
  std::map<std::string, double> errors;
  const auto put = [&](const std::string& name, const Deviation& d) {
    if (d.exact_most > 0) {
      errors["L1_" + name] = d.sum / d.exact_sum;
      errors["Linf_" + name] = d.most / d.exact_most;
    }
  };
  put("density", density);
  put("velocity", velocity);
  put("pressure", pressure);
  return errors;
}

template std::map<std::string, double> exact_errors<2>(const Block<2>&, const ExactSolution&, double);
template std::map<std::string, double> exact_errors<3>(const Block<3>&, const ExactSolution&, double);

} // namespace ballast
