#include "problems/run_attitude.hpp"

#include "ale/fill.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <fmt/format.h>

namespace ballast {
namespace {

constexpr const char* axis_letters = "xyz";

template <int Dim> Point cell_centre(const Block<Dim>& b, int i, int j, int k) {
  Point x{};
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const int r = b.grid.node_row(j + (corner >> 1 & 1), k + (corner >> 2 & 1));
    for (std::size_t d = 0; d < Dim; ++d) {
      x[d] += b.position[d].row(r)[i + (corner & 1)] / (1 << Dim);
    }
  }
  return x;
}

/// each(mass, cell, slides) for what the slots hold of every cell.
template <int Dim, class Each>
void for_each_share(const Block<Dim>& b, const std::vector<int>& slots, Each&& each) {
  for_each_cell(b, [&](int i, int j, int k) {
    const int r = b.grid.cell_row(j, k);
    for (const int s : slots) {
      const MaterialSlot& slot = b.materials[static_cast<std::size_t>(s)];
      const double mass = slot.store.has_row(r) ? slot.store.row(field::mass, r)[i] : 0.0;
      if (mass > 0) {
        each(mass, std::array<int, 3>{i, j, k}, slot.slides);
      }
    }
  });
}

template <int Dim>
void add_momentum(const Block<Dim>& b, double mass, const std::array<int, 3>& cell, bool slides, Point& sum) {
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    const int r = b.grid.node_row(cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1));
    const double share = mass * corner_share(b, corner, cell[0], cell[1], cell[2]);
    for (std::size_t d = 0; d < Dim; ++d) {
      sum[d] += share * velocity_of(b, slides, d, r, cell[0] + (corner & 1));
    }
  }
}

/// Eigenvector of the eigenvalue that stands apart from the other two, towards the shot.
Point body_axis(const Eigen::Matrix3d& moments, int shot_axis, double direction) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments);
  const Eigen::Vector3d e = solver.eigenvalues(); // ascending
  const Eigen::Vector3d v = solver.eigenvectors().col(e[2] - e[1] >= e[1] - e[0] ? 2 : 0);
  const double side = v[shot_axis] * direction < 0 ? -1 : 1;
  return {side * v[0], side * v[1], side * v[2]};
}

} // namespace

template <int Dim>
AttitudeMeasure measure_attitude(const Block<Dim>& b,
                                 const std::vector<int>& slots,
                                 int shot_axis,
                                 double direction,
                                 const std::array<bool, 3>& mirrored) {
  AttitudeMeasure m;
  for_each_share(b, slots, [&](double mass, const std::array<int, 3>& cell, bool slides) {
    const Point x = cell_centre(b, cell[0], cell[1], cell[2]);
    m.mass += mass;
    for (std::size_t d = 0; d < Dim; ++d) {
      m.centre[d] += mass * x[d];
    }
    add_momentum(b, mass, cell, slides, m.momentum);
  });
  if (!(m.mass > 0)) {
    return m;
  }
  for (double& x : m.centre) {
    x /= m.mass;
  }
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for_each_share(b, slots, [&](double mass, const std::array<int, 3>& cell, bool) {
    const Point x = cell_centre(b, cell[0], cell[1], cell[2]);
    for (int p = 0; p < 3; ++p) {
      for (int q = 0; q < 3; ++q) {
        const auto a = static_cast<std::size_t>(p), c = static_cast<std::size_t>(q);
        const bool mixed = p != q && (mirrored[a] || mirrored[c]);
        moments(p, q) += mixed ? 0.0 : mass * (x[a] - (mirrored[a] ? 0.0 : m.centre[a])) * (x[c] - (mirrored[c] ? 0.0 : m.centre[c]));
      }
    }
  });
  m.axis = body_axis(moments / m.mass, shot_axis, direction);
  return m;
}

LateralRecord::LateralRecord(const SceneSpec& scene) : shot_axis_(scene.results.shot_axis), direction_(scene.results.shot_direction) {
  for (std::size_t a = 0; a < 3; ++a) {
    mirrored_[a] = scene.boundaries[a][0].kind == BoundaryKind::symmetry || scene.boundaries[a][1].kind == BoundaryKind::symmetry;
    const bool across = static_cast<int>(a) != shot_axis_;
    if (scene.geometry == Geometry::three_d && !scene.results.bullet.empty() && across && !mirrored_[a]) {
      axes_.push_back(static_cast<int>(a));
    }
  }
}

std::vector<std::string> LateralRecord::columns() const {
  std::vector<std::string> out;
  for (const int a : axes_) {
    for (const char* q : {"bullet_centre_{} [m]", "bullet_momentum_{} [kg m/s]", "bullet_side_force_{} [N]", "bullet_tilt_{} [rad]", "bullet_yaw_{} [rad]"}) {
      out.push_back(fmt::format(fmt::runtime(q), axis_letters[a]));
    }
  }
  return out;
}

std::vector<double> LateralRecord::add(double time, const AttitudeMeasure& m) {
  State& s = state_;
  std::vector<double> out;
  const auto along = static_cast<std::size_t>(shot_axis_);
  const double mass = m.mass > 0 ? m.mass : 1.0;
  if (!s.started) {
    s.time = time;
    s.momentum = m.momentum;
    for (std::size_t d = 0; d < 3; ++d) {
      s.velocity_start[d] = m.momentum[d] / mass;
      s.centre_start[d] = m.centre[d] - time * s.velocity_start[d];
    }
  }
  const double span = time - s.time;
  for (const int axis : axes_) {
    const auto a = static_cast<std::size_t>(axis);
    s.force[a] = span > 0 ? (m.momentum[a] - s.momentum[a]) / span : s.force[a];
    s.tilt[a] = std::atan2(m.axis[a], direction_ * m.axis[along]);
    s.yaw[a] = s.tilt[a] - std::atan2(m.momentum[a], direction_ * m.momentum[along]);
    s.deflection[a] = m.centre[a] - s.centre_start[a] - time * s.velocity_start[a];
    s.largest_yaw[a] = std::abs(s.yaw[a]) > std::abs(s.largest_yaw[a]) ? s.yaw[a] : s.largest_yaw[a];
    s.largest_force[a] = std::abs(s.force[a]) > std::abs(s.largest_force[a]) ? s.force[a] : s.largest_force[a];
    out.insert(out.end(), {m.centre[a], m.momentum[a], s.force[a], s.tilt[a], s.yaw[a]});
  }
  s.started = true;
  s.time = time;
  s.momentum = m.momentum;
  return out;
}

std::vector<double> LateralRecord::memory() const {
  if (axes_.empty()) {
    return {};
  }
  std::vector<double> out = {state_.started ? 1.0 : 0.0, state_.time};
  for (const Point* p : {&state_.centre_start, &state_.velocity_start, &state_.momentum, &state_.force, &state_.largest_yaw, &state_.largest_force}) {
    out.insert(out.end(), p->begin(), p->end());
  }
  return out;
}

std::size_t LateralRecord::recall(std::span<const double> numbers) {
  constexpr std::size_t count = 2 + 6 * 3;
  if (axes_.empty() || numbers.size() < count) {
    return 0;
  }
  state_.started = numbers[0] != 0;
  state_.time = numbers[1];
  std::size_t at = 2;
  for (Point* p : {&state_.centre_start, &state_.velocity_start, &state_.momentum, &state_.force, &state_.largest_yaw, &state_.largest_force}) {
    for (double& x : *p) {
      x = numbers[at++];
    }
  }
  return count;
}

template AttitudeMeasure measure_attitude<2>(const Block<2>&, const std::vector<int>&, int, double, const std::array<bool, 3>&);
template AttitudeMeasure measure_attitude<3>(const Block<3>&, const std::vector<int>&, int, double, const std::array<bool, 3>&);

} // namespace ballast
