// How a bullet leans and drifts in a 3D run: side force, deflection, yaw.
//
// Of the bullet's mass inside the mesh, cells as points at their centres x, nodes' velocities u:
//   centre  X = sum m x / M,   momentum P = sum over nodes of the bullet's share of their mass times u,
//   side force F = dP/dt between two samples, along the axes across the shot,
//   axis: the eigenvector of S = sum m (x - X)(x - X)^T whose eigenvalue stands apart from the other
//         two: the axis of inertia that is the long one of a slender bullet, the short one of a flat,
//   tilt = angle from the shot's direction to that axis, yaw = tilt - angle to the velocity P / M,
// each in the plane of the shot and one axis across it. Axes with a plane of symmetry are left out:
// what the mesh holds is half of something that cannot lean that way. A bullet as wide as it is long
// has no axis; a turn past 90 degrees looks like one from the other side.
#pragma once

#include "ale/block.hpp"
#include "problems/scene_spec.hpp"

namespace ballast {

struct AttitudeMeasure {
  double mass = 0;  ///< kg
  Point centre{};   ///< m
  Point momentum{}; ///< kg m/s
  Point axis{};     ///< unit vector along the shot, or nothing without mass
};

/// `mirrored`: axes with a plane of symmetry, which the axis lies in.
template <int Dim>
AttitudeMeasure measure_attitude(const Block<Dim>& block,
                                 const std::vector<int>& slots,
                                 int shot_axis,
                                 double direction,
                                 const std::array<bool, 3>& mirrored);

/// Follows a bullet from sample to sample; what it remembers goes through checkpoints.
class LateralRecord {
public:
  explicit LateralRecord(const SceneSpec& scene);
  /// Axes across the shot that it is recorded along; empty: not at all.
  const std::vector<int>& axes() const { return axes_; }
  const std::array<bool, 3>& mirrored() const { return mirrored_; }
  std::vector<std::string> columns() const;
  /// Values of the columns at `time`.
  std::vector<double> add(double time, const AttitudeMeasure& m);

  /// What add() found, by axis.
  struct State {
    bool started = false;
    double time = 0;
    Point centre_start{}, velocity_start{}; ///< straight flight, from t = 0
    Point momentum{};
    Point deflection{}; ///< from the straight flight of the start, m
    Point tilt{}, yaw{}, largest_yaw{}; ///< rad
    Point force{}, largest_force{};     ///< N
  };
  const State& state() const { return state_; }
  std::vector<double> memory() const;
  /// The inverse; returns how many numbers it took.
  std::size_t recall(std::span<const double> numbers);

private:
  std::vector<int> axes_;
  std::array<bool, 3> mirrored_{};
  int shot_axis_ = 2;
  double direction_ = 1;
  State state_;
};

} // namespace ballast
