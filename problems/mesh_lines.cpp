#include "problems/mesh_lines.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {
namespace {

struct Stretch {
  double a, b, size_a, size_b;
  double ratio() const { return size_b / size_a; }
  bool uniform() const { return std::abs(ratio() - 1) < 1e-9; }
  /// integral dx / size(x) with the size linear in x, which is what a geometric row is.
  double cells() const {
    const double wanted =
        uniform() ? (b - a) / size_a : (b - a) * std::log(ratio()) / (size_b - size_a);
    return std::max(1.0, std::ceil(wanted - 1e-6));
  }
  /// Place of node i of n.
  double node(double share) const {
    return uniform() ? a + (b - a) * share
                     : a + (b - a) * (std::pow(ratio(), share) - 1) / (ratio() - 1);
  }
};

std::vector<Stretch> stretches(const AxisPlan& plan) {
  const bool size_at_from = plan.size.size() > plan.to.size();
  std::vector<Stretch> out;
  double a = plan.from, size_a = plan.size.front();
  for (std::size_t i = 0; i < plan.to.size(); ++i) {
    const double size_b = plan.size[i + (size_at_from ? 1 : 0)];
    out.push_back({a, plan.to[i], size_a, size_b});
    a = plan.to[i];
    size_a = size_b;
  }
  return out;
}

} // namespace

double planned_cells(const AxisPlan& plan) {
  double cells = 0;
  for (const Stretch& s : stretches(plan)) {
    cells += s.cells();
  }
  return cells;
}

double steepest_ratio(const AxisPlan& plan) {
  double steepest = 1;
  for (const Stretch& s : stretches(plan)) {
    const double step = std::pow(s.ratio(), 1 / s.cells());
    steepest = std::max({steepest, step, 1 / step});
  }
  return steepest;
}

std::vector<double> mesh_lines(const AxisPlan& plan) {
  std::vector<double> nodes{plan.from};
  for (const Stretch& s : stretches(plan)) {
    const int n = static_cast<int>(s.cells());
    for (int i = 1; i < n; ++i) {
      nodes.push_back(s.node(static_cast<double>(i) / n));
    }
    nodes.push_back(s.b);
  }
  return nodes;
}

} // namespace ballast
