// LayerStack: a stack of fabric layers, one structured Lagrangian block whose node planes are doubled at the slidelines.
//
// A layer is `through` elements thick; neighbouring layers touch and slide (ale/layers/slideline). Layers lie across the last
// axis, the shot's; the first layer is the lowest. Material axes at rest: 1 and 2 in the layer (x and y; r and hoop around an
// axis; x and nothing in a plane), 3 through it. At rest the elements are bricks on lines graded in the plane.
// Elements are solid-shells (ale/layers/layer_forces): strains in the plane at two points through the thickness, the others at
// the centre, second Piola-Kirchhoff stress from materials/fabric. Nodes hold position, velocity and mass, velocities at the
// time of the positions; elements hold what the fabric remembers, the heat and work that went into them, and whether they are there.
// SI; stress tension-positive.
#pragma once

#include "materials/fabric.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace ballast {

/// What holds an edge of the stack in its plane.
enum class LayerEdge {
  symmetry, ///< a plane of symmetry or the axis: no velocity across it
  free,
  fixed,   ///< no velocity at all
  elastic  ///< springs in the plane, a stiffness a node's share of the edge
};

/// Stabilisation of the element's modes that have no strain at its points (ale/layers/layer_element).
struct LayerHourglass {
  double stiffness = 0.2; ///< of the moduli at rest; through the thickness at least the weaker yarns': cloth is soft until pressed
  double viscosity = 0;   ///< of rho c h, c the fastest wave at rest
};

/// Artificial viscosity through the thickness: a law that stiffens as it is pressed makes shocks, and what they waste is heat. Without it the
/// layers hand an impact on as the balls of Newton's cradle do and the last one leaves faster than what struck. A pressure
/// density v (quadratic v + linear c), v the speed at which the faces come together, c the wave at rest; of cloth only where it is pressed: plies that are apart do not meet.
struct LayerViscosity {
  double quadratic = 1.5;
  double linear = 0.06;
};

/// What keeps elements from turning inside out where their law lets them: cloth pressed in its plane costs nothing, weak shear
/// through the thickness lets a side pass the other. In compression beyond, as no fabric is.
struct LayerGuard {
  double shortest = 0.2; ///< of its length at rest: an edge in the plane closes no further, an impact (ale/layers/layer_folds); 0: no end
  double volume = 0.1;   ///< of that at rest, in the middle of both surfaces: pressure K (volume/J - 1) below, K the thickness' modulus of LayerHourglass; 0: none
  double torn = 0;       ///< of that at rest: an element pressed to less is taken as torn through and erodes; 0: never
  bool either = false;   ///< an element erodes once either family of yarns is lost, else when both are
};

/// How the elements of a stack lie side by side.
struct LayerGrid {
  std::array<int, 2> elements = {1, 1}; ///< in the plane; {n, 1} in 2D
  int layers = 1, through = 1;          ///< elements through a layer

  int planes() const { return layers * (through + 1); } ///< of nodes
  int levels() const { return layers * through; }       ///< of elements
  int nodes_along(int axis) const { return elements[static_cast<std::size_t>(axis)] + 1; }
};

/// What does not change along i: geometry at rest of the elements of a row.
struct LayerRest {
  std::vector<double> gradient; ///< 2/h, 1/m
  std::vector<double> hoop;     ///< 1/R of the middle, 1/m; 0 without an axis
  std::vector<double> span;     ///< h, m; around an axis 2 pi R h, m2
  std::vector<double> lightest; ///< at least 1: (fastest/mean)^2 of an element whose corners weigh differently
};

template <int Dim> struct LayerStack {
  /// Of an element: strains that do work, modes without strain (ale/layers/layer_element).
  static constexpr std::size_t strains = Dim == 3 ? 9 : 6, hourglass_modes = Dim == 3 ? 11 : 3;

  std::string name = "layers";
  LayerGrid grid;
  bool axisymmetric = false;
  FabricModel model;
  double density = 0; ///< at rest, kg/m3
  LayerHourglass hourglass;
  LayerGuard guard;
  LayerViscosity viscosity;
  std::array<std::array<LayerEdge, 2>, 2> edge = {{{LayerEdge::free, LayerEdge::free}, {LayerEdge::free, LayerEdge::free}}}; ///< [axis][low, high]
  double edge_stiffness = 0; ///< of elastic edges, N/m for a metre of edge (3D, and around an axis a metre of its circle)

  std::array<std::vector<double>, 2> lines; ///< at rest, in the plane, m; the second only in 3D
  std::vector<double> levels;               ///< at rest, of the planes at layer and element faces: levels() + 1, m

  // Nodes: i fastest, then j, then plane.
  std::array<std::vector<double>, Dim> rest, position, velocity, force; ///< force: at `position`, N
  std::vector<double> mass;                                            ///< kg; around an axis of the whole ring

  // Elements: i fastest, then j, then level. Two points through the thickness, low and high.
  std::array<std::array<std::vector<double>, 2>, 2> largest; ///< [point][warp, fill] largest Green strain so far
  std::vector<double> energy;           ///< J: internal, work of the element's stresses
  std::vector<double> hourglass_energy; ///< J: of its stabilisation
  std::vector<double> shock_heat;       ///< J: of its artificial viscosity
  std::vector<double> wave_step;        ///< s: largest stable step of the element, at `force`'s strains
  std::vector<char> alive;              ///< 0: eroded, its mass stays at its nodes

  // What the step keeps from one phase to the next. To go on bit for bit from a file, keep force, wave_step and these too: the
  // forces hold a viscous part at the velocity of the half step, which update_forces would not find again.
  LayerRest at_rest;
  // Rows of elements one after the other, in each all strains, i fastest: apart, as many streams would meet in one cache set.
  std::vector<double> stress_volume;    ///< J: stress of each strain times the volume at rest
  std::vector<double> hourglass_volume; ///< J: likewise
  std::vector<double> shock_volume;     ///< J: of the viscosity, by element
  std::array<std::vector<double>, Dim> kept_velocity;                ///< before contact, m/s: for the account
  std::array<std::array<std::vector<double>, 2>, 2> rate;            ///< [point][warp, fill] smoothed dE/dt, 1/s; empty unless the law wants it
  double rate_time = 1e-6;                                           ///< s: over which it is smoothed
  double step = 0;                                                   ///< s: the last one, 0 at the start

  bool three_d() const { return Dim == 3; }
  std::size_t node(int i, int j, int plane) const {
    return (static_cast<std::size_t>(plane) * static_cast<std::size_t>(Dim == 3 ? grid.nodes_along(1) : 1) + static_cast<std::size_t>(j)) * static_cast<std::size_t>(grid.nodes_along(0)) +
           static_cast<std::size_t>(i);
  }
  std::size_t element(int i, int j, int level) const {
    return (static_cast<std::size_t>(level) * static_cast<std::size_t>(grid.elements[1]) + static_cast<std::size_t>(j)) * static_cast<std::size_t>(grid.elements[0]) + static_cast<std::size_t>(i);
  }
  /// Where quantity k of `kinds` of the elements (0, j, level) on stands in stress_volume and hourglass_volume.
  std::size_t in_row(std::size_t k, std::size_t kinds, int j, int level) const {
    return element(0, j, level) * kinds + k * static_cast<std::size_t>(grid.elements[0]);
  }
  /// The lower plane of nodes of an element level.
  int plane_below(int level) const { return level / grid.through * (grid.through + 1) + level % grid.through; }
  std::size_t node_count() const { return mass.size(); }
  std::size_t element_count() const { return energy.size(); }
};

/// What a stack gained and lost, from its start. J, kg m/s.
struct LayerLedger {
  double edge_work = 0;          ///< energy stored in elastic edges
  double contact_loss = 0;       ///< kinetic energy lost in impacts of surfaces (slidelines and blocks): ale/layers/layer_account
  double friction_loss = 0;      ///< of that, by friction
  double eroded_energy = 0;      ///< internal energy of eroded elements: they keep it
  std::array<double, 3> edge_impulse = {0, 0, 0}; ///< given to the stack by held edges
  long eroded_elements = 0;
  long crushed = 0;              ///< element-steps whose volume fell below a twentieth of that at rest
  long turned_over = 0;          ///< element-steps with a surface inside out
  long behind = 0;               ///< node-steps inside the next layer or a block without contact: come in past an edge, through a hole; not in `deepest`
  double deepest = 0;            ///< m: largest penetration of neighbouring layers seen
  double edge_loss = 0;          ///< kinetic energy of nodes that a held edge stopped at the start
  double step_change = 0;        ///< what the account's kinetic energy lost where a step was longer than the one before
  double load_work = 0;          ///< done on the stack by the mesh it lies in (ale/layers/layer_load)
};

/// What a stack is made of.
struct LayerInput {
  std::string name = "layers";
  FabricModel model;
  std::array<std::vector<double>, 2> lines; ///< at rest, in the plane, m; the second only in 3D
  std::vector<double> levels;               ///< at rest, m: layers x through + 1 of them
  int layers = 1, through = 1;
  bool axisymmetric = false;
  std::array<std::array<LayerEdge, 2>, 2> edge = {{{LayerEdge::free, LayerEdge::free}, {LayerEdge::free, LayerEdge::free}}};
  double edge_stiffness = 0;
  LayerHourglass hourglass = {};
  LayerGuard guard = {};
  LayerViscosity viscosity = {};
};

/// A stack at rest, its forces zero. Nodes weigh density times the corner volumes of their bricks: the sum is exact.
/// Throws Error: name, what is wrong, the cure.
template <int Dim> LayerStack<Dim> make_stack(const LayerInput& input);

/// Evenly spaced lines or levels.
std::vector<double> even_lines(double from, double to, int elements);

} // namespace ballast
