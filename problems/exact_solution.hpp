// Exact solutions of scenes: what `ballast run` measures its last state by and `ballast study --reference exact` its errors.
// The solutions themselves live in tests/exact and are linked into the program; tests/verify/scene_solutions.cpp recognises
// the scenes they hold for.
#pragma once

#include "problems/scene_spec.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace ballast {

struct ExactState {
  double density = 0, velocity = 0, pressure = 0; ///< kg/m3, m/s along the axis, Pa
};

/// One-dimensional, along a mesh axis.
struct ExactSolution {
  std::string law; ///< "Riemann problem of two gases"
  int axis = 0;
  double valid_until = 0; ///< s: then a wave reaches an end of the mesh
  std::function<ExactState(double x, double t)> at;
};

/// The exact solution of a scene; none: `why_not` says what it lacks.
using ExactSolver = std::function<std::optional<ExactSolution>(const SceneSpec& scene, std::string& why_not)>;
std::optional<ExactSolution> exact_solution_of(const SceneSpec& scene, std::string& why_not); ///< of the program

/// Mean error of a block at time t by the mean of what is exact, "L1_density", "L1_velocity", "L1_pressure", and the largest
/// by the largest, "Linf_..."; by volume, the value at a cell's centre.
template <int Dim> std::map<std::string, double> exact_errors(const Block<Dim>& block, const ExactSolution& exact, double t);

} // namespace ballast
