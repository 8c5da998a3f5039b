#pragma once

/// Types shared by the exact solutions. SI or any consistent set of units.

namespace ballast::exact {

/// Symmetry of a one-dimensional flow; the value is the dimension j of the volume r^j.
enum class Geometry { planar = 1, cylindrical = 2, spherical = 3 };

/// One point of a flow. Pressure is compression-positive.
struct FlowState {
  double density;
  double velocity;
  double pressure;
};

} // namespace ballast::exact
