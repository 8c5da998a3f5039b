// InjurySpec: the injury measures that a deck asks for, resolved and validated, in SI.
#pragma once

#include <string>
#include <vector>

namespace ballast {

struct InjurySpec {
  int axis = 1;         ///< deflections, velocities and forces are along it
  double direction = 1; ///< +1 or -1: the way of the shot
  int sternum = -1, spine = -1;      ///< indices into SceneSpec::gauges, -1: none
  double chest_depth = 0;            ///< D0, m; 0: not given
  int back_stack = -1, back_gauge = -1; ///< whose deflection is the back face's: of SceneSpec::layers, or a gauge
  std::string back_face;             ///< its name
  std::vector<int> accelerometers;   ///< gauges
  std::vector<int> filters;          ///< CFC classes
  double record_every = 1e-6;        ///< s
  double sample_every = 20e-6;       ///< s
  std::vector<int> organs;           ///< indices into SceneSpec::materials
  std::vector<int> force_on;         ///< likewise
  std::vector<int> blast;            ///< gauges whose pressure loads a chest wall
  std::vector<int> impactor;         ///< bodies; empty: energy and diameter are given
  double impactor_energy = 0;        ///< J; 0: of the bodies, or none asked for
  double impactor_diameter = 0;      ///< m; likewise
  double copies = 1;                 ///< the scene's share of a body times this is the whole: planes of symmetry halve it
  double body_mass = 0;              ///< kg; 0: not given
  double wall_thickness = 0;         ///< m

  bool has_impact() const { return impactor_diameter > 0; }
};

} // namespace ballast
