// What a remap works on: views into a block's nodes, cells and material stores. remap/ moves
// conserved quantities and knows no equation of state.
//
// Of every material's store, conserved field 0 is its volume fraction, 1 its mass (kg), 2 and up
// are intensive (per mass): specific energy first, then history. A void store has field 0 only.
#pragma once

#include "core/awake.hpp"
#include "core/grid.hpp"
#include "core/threads.hpp"
#include "core/tile_store.hpp"
#include "remap/normal.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace ballast::remap {

/// Work arrays a block keeps between remaps; empty ones are allocated when needed.
struct Scratch {
  RowField cell_mass, node_loss, next_node_mass;
};

/// Materials that slide along the rest. At a node that both own a part of they have velocities of their own, v_r and
/// v_s = v_r + jump, and the node moves with v = v_r + a jump, a = node_follows(). Of a force on the node the part along the
/// jump goes to both as they move it, a and 1 - a of it, the part across by mass: its work on the node is what they gain.
template <int Dim> struct Sliding {
  std::vector<char> material;                ///< by material: does it slide? Empty: none does
  RowField node_mass;                        ///< kg of the sliding materials by node
  std::array<RowField, Dim> jump, next_jump; ///< m/s, their velocity less that of the rest

  std::array<RowField, Dim> velocity, next_velocity; ///< scratch
  std::array<RowField, Dim> mass_flux;               ///< scratch, faces
  RowField cell_mass;                                ///< scratch
  RowField loss;                                     ///< scratch, J by node: what is to come back as heat
};

/// How far the velocity of a node (mass in kg) lies from that of the rest (0) to that of what slides (1). 0 where the rest
/// has half the mass or more, so that its surface keeps its shape; from there to 1 where it has none: a trace of it is not
/// to take the whole force (along the jump it gains at most twice F / M, and so does the node).
inline double node_follows(double sliding_mass, double mass) {
  const double rest = mass > 0 ? 1 - sliding_mass / mass : 1.0, follows = 1 - 2 * rest;
  return follows > 0 ? follows : 0.0;
}

/// A material beyond a side that feeds the block, its history zero; a void has no density.
struct Outside {
  int material = -1;
  double fraction = 1, density = 0, specific_energy = 0; ///< kg/m3, J/kg
};
/// What ghost cell (i, j, k) beyond a side holds; the fractions add up to one. Nothing: more of the edge cell.
using OutsideState = std::function<void(int axis, int side, const std::array<int, 3>& cell, std::vector<Outside>& parts)>;

template <int Dim> struct Mesh {
  const Grid& grid;
  bool axisymmetric = false;
  std::array<std::array<bool, 2>, 3> open{};         ///< sides material may cross
  std::array<std::array<bool, 2>, 3> fed{};          ///< open sides behind which there is what `outside` says
  OutsideState outside = {};                         ///< asked for ghost cells of sides that are fed, by one thread
  /// Sides that prescribe the velocity along their normal, the component that is (along the axis on a rectilinear mesh), and that
  /// velocity (m/s): their nodes keep it, what momentum the remap brings them goes to the wall.
  std::array<std::array<bool, 2>, 3> fixed{};
  std::array<std::array<int, 2>, 3> fixed_component = {{{0, 0}, {1, 1}, {2, 2}}};
  std::array<std::array<double, 2>, 3> fixed_velocity{};
  std::array<RowField, Dim>& position;               ///< in: where the nodes are; out: the target
  const std::array<RowField, Dim>& target;
  RowField& volume;      ///< m3; out: volumes swept to the target
  RowField& next_volume; ///< scratch
  std::array<RowField, Dim>& velocity;
  std::array<RowField, Dim>& next_velocity; ///< scratch
  RowField& node_mass;
  const std::array<std::vector<double>, Dim>&
      low_share;                        ///< mass share of the lower node, by cell + ghost
  std::array<RowField, Dim>& swept;     ///< scratch, faces: volume swept along +axis, m3
  std::array<RowField, Dim>& mass_flux; ///< scratch, faces: mass (but of what slides) along +axis, kg
  std::vector<TileStore*> materials;    ///< void last, if any
  bool has_void = false;
  /// Specific energy (J/kg) by material below which a return of kinetic energy may not bring it: 0 of a gas, of a
  /// condensed one (whose zero is a choice) where cold tension begins to matter. Empty: 0.
  std::vector<double> least_energy = {};
  std::vector<std::int8_t>& owner;                       ///< the only material of a cell, or -1
  Sliding<Dim>* sliding = nullptr; ///< optional
  Scratch* scratch = nullptr; ///< optional: without it every sweep allocates its own
  const Awake* awake = nullptr; ///< optional: what else there is stays as it is, so nothing looks at it
  std::array<RowField, Dim>* kept_target = nullptr; ///< optional: holds the same as target and may take position's place
  std::function<void(RowField&, int)> exchange_velocity; ///< fills ghosts of a component
  /// Optional: faces that sweep nothing, nonzero at the cell above, by cell rows with ghosts as in `owner`.
  const std::array<std::vector<char>, Dim>* closed = nullptr;

  /// Cells, nodes and faces of a row that are awake, by the number of the cell or node row.
  Span cells(int row) const { return awake != nullptr ? awake->cells(row) : Span{0, grid.cells[0]}; }
  Span nodes(int row) const { return awake != nullptr ? awake->nodes(row) : Span{0, grid.cells[0] + 1}; }
  /// The faces below the row's cells along `axis`, and along axis 0 the last one.
  Span faces(int axis, int row) const {
    const Span here = cells(row);
    if (axis == 0) {
      return here.empty() ? here : Span{here.begin, here.end + 1};
    }
    return hull(here, cells(row - grid.cell_row_stride(axis)));
  }

  std::int8_t* owner_row(int r) {
    return owner.data() + static_cast<std::ptrdiff_t>(r) * grid.cell_pitch() + grid.ghost[0];
  }
  const std::int8_t* owner_row(int r) const {
    return owner.data() + static_cast<std::ptrdiff_t>(r) * grid.cell_pitch() + grid.ghost[0];
  }
  int material_count() const { return static_cast<int>(materials.size()); }
  /// Reference density (kg/m3) by material: what weighs less than a sliver's share of a cell at this density is round-off
  /// too, whatever room it takes. Empty: 0.
  std::vector<double> reference_density = {};
  double reference_density_of(int m) const { return reference_density.empty() ? 0.0 : reference_density[static_cast<std::size_t>(m)]; }
  double least_energy_of(int m) const { return least_energy.empty() ? 0.0 : least_energy[static_cast<std::size_t>(m)]; }
  bool slides(int m) const { return sliding != nullptr && sliding->material[static_cast<std::size_t>(m)] != 0; }
  bool is_void(int m) const { return has_void && m == material_count() - 1; }
};

struct Settings {
  NormalMethod normal = NormalMethod::elvira;
  double largest_swept = 0.5; ///< of the donor's volume in one pseudo-step
  bool limit = true;          ///< off: unlimited second order, for order tests
  bool return_kinetic = true; ///< kinetic energy lost goes to internal energy
};

/// What a remap moved out of the block or lost.
struct Report {
  int substeps = 0;
  std::vector<double> mass_out;             ///< kg by material
  double internal_out = 0, kinetic_out = 0; ///< J
  std::array<double, 3> momentum_out = {0, 0, 0};
  double kinetic_loss = 0;     ///< J, lost by averaging velocities (before any return)
  double impact_loss = 0;      ///< J, of that, where what slides meets the rest or sticks to it
  double kinetic_returned = 0; ///< J, of that, put into internal energy
  long energy_floors = 0;      ///< cells where a negative return was cut
  double sliver_mass = 0, sliver_energy = 0;
  long slivers = 0;
  /// A cell that even the smallest part of the motion would turn inside out, i < 0: none. The block is then on its way
  /// between the meshes, all that was moved accounted for.
  std::array<int, 3> tangled = {-1, -1, -1};
};

/// Moves everything from mesh.position to mesh.target. `order`: which axis goes first alternates
/// with it.
template <int Dim>
Report remap(Mesh<Dim>& mesh, const Settings& settings, ThreadPool& pool, long order);

/// One pseudo-step with swept volumes already in mesh.swept (verification flows prescribe them).
template <int Dim>
void sweep_all(
    Mesh<Dim>& mesh, const Settings& settings, ThreadPool& pool, long order, Report& report);

} // namespace ballast::remap
