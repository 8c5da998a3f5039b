// Block: one logically structured mesh with its nodes, its cells and the materials in them.
//
// Staggered: nodes hold position, velocity, mass; cells hold, per material, volume fraction, mass,
// specific energy and only the history that the material's models need. Pressure is stored as a gauge
// pressure p - p_reference, so that a body at rest under ambient pressure feels exactly no force.
// Stress is tension-positive, pressure compression-positive. SI.
#pragma once

#include "core/awake.hpp"
#include "core/boundary.hpp"
#include "core/grid.hpp"
#include "core/mesh_map.hpp"
#include "core/threads.hpp"
#include "core/tile_store.hpp"
#include "materials/material.hpp"
#include "remap/mesh.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ballast {

/// Independent deviator components: 2D xx yy xy (rr zz rz), 3D also yz xz; zz (hoop) follows from the trace.
template <int Dim> inline constexpr int stress_components = Dim == 2 ? 3 : 5;

/// Components of a tensor of memory that are kept: xx yy zz xy, in 3D also yz zx; in 2D those stay zero.
template <int Dim> inline constexpr int memory_components = Dim == 2 ? 4 : 6;

/// Field numbers in a material's TileStore.
namespace field {
inline constexpr int fraction = 0; ///< volume fraction
inline constexpr int mass = 1;     ///< kg
inline constexpr int energy = 2;   ///< J/kg
inline constexpr int stress = 3;   ///< first deviator component, Pa (materials with strength)
template <int Dim> inline constexpr int plastic_strain = 3 + stress_components<Dim>;
template <int Dim> inline constexpr int damage = 4 + stress_components<Dim>; ///< materials with a failure model
/// Viscoelastic materials (which do not fail): free energy, J/kg, then the law's state less its rest, so that rest is zero.
template <int Dim> inline constexpr int free_energy = 4 + stress_components<Dim>;
template <int Dim> inline constexpr int memory = 5 + stress_components<Dim>;
} // namespace field

struct MaterialSlot {
  Material material;
  bool is_void = false;
  bool slides = false; ///< keeps its own velocity along interfaces with what does not (remap/sliding)
  bool strength = false;
  bool damages = false;        ///< has a failure model
  bool compacts = false;       ///< foam: its compaction is the last of the conserved fields
  bool variable_shear = false; ///< the shear modulus depends on the state and has a field
  double shear = 0;            ///< shear modulus if it does not, Pa
  GaugeReference reference; ///< the material's initial state
  TileStore store;
  int memories = 0; ///< tensors that a viscoelastic material remembers

  int compaction_field() const { return store.conserved() - 1; } ///< of what compacts only
  int pressure_field() const { return store.conserved(); }
  int modulus_field() const { return store.conserved() + 1; }
  int flow_stress_field() const { return store.conserved() + 2; } ///< with strength only
  int shear_field() const { return store.conserved() + 3; }       ///< with variable_shear only
};

/// Mass (kg), centre of mass (m), its velocity (m/s), mean square distance from it (m2) or from a symmetry plane, where the
/// block has one at its lower side, and that one's rate (m2/s), of some materials of a block.
struct Bulk {
  double mass = 0;
  std::array<double, 3> centre = {0, 0, 0}, velocity = {0, 0, 0}, spread = {0, 0, 0}, spread_rate = {0, 0, 0};
};

/// Shear modulus of a material with strength in a cell, Pa; of what has molten a trace, never zero.
inline double shear_of(const MaterialSlot& slot, int r, int i) {
  return slot.variable_shear ? slot.store.row(slot.shear_field(), r)[i] : slot.shear;
}

enum class MotionPolicy {
  lagrangian, ///< never remapped
  eulerian,   ///< back to the initial mesh
  follow,     ///< back to the initial mesh, moved and stretched with some materials (ale/follow)
  relax       ///< on to a smoothed mesh (ale/relax)
};

struct Motion {
  MotionPolicy policy = MotionPolicy::eulerian;
  int remap_every = 1;
  double remap_quality = 0; ///< above 0: remapped when a cell's shape falls below it (ale/mesh_quality) instead of every so many steps

  std::vector<int> leaders = {};                       ///< follow: materials of the block
  std::array<bool, 3> axes = {false, false, false};    ///< follow: along which axes
  std::array<bool, 3> stretches = {false, false, false}; ///< follow: along which axes the mesh grows with their extent, too
  Bulk start = {};                                     ///< follow: the leaders at first
  /// follow: speed of the mesh's sides along their axis at the last remap, m/s.
  std::array<std::array<double, 2>, 3> side_speed = {};

  bool fixed_boundary = false; ///< relax: boundary nodes stay; else they go with the material
  int sweeps = 4;              ///< relax: of smoothing, each remap

  bool remaps() const { return policy != MotionPolicy::lagrangian; }
  /// Is the target mesh another after each remap, so that a restart must know the last?
  bool moves_target() const { return policy == MotionPolicy::follow || policy == MotionPolicy::relax; }
};

inline constexpr std::int8_t mixed_cell = -1;

/// How the volume change of a mixed cell is shared among its materials (ale/closure).
enum class Closure { pressure_relaxation, tipton, equal_strain };

template <int Dim> struct Block {
  std::string name = "mesh";
  Grid grid;
  bool axisymmetric = false;
  MeshMap map; ///< how the initial mesh came about
  Motion motion;
  BoundarySet boundary;
  Closure closure = Closure::pressure_relaxation;
  double reference_pressure = 0; ///< Pa; forces use p minus this

  std::array<RowField, Dim> position, velocity, next_position, next_velocity;
  std::array<RowField, Dim> target; ///< where the next remap brings the nodes
  /// follow: what the cell lo..hi (m) held at first, if it did not move; beyond the mesh this is still there.
  std::function<void(const std::array<double, 3>& lo, const std::array<double, 3>& hi, std::vector<remap::Outside>& parts)> outside;
  std::array<RowField, Dim> home; ///< follow, relax: where target was at first
  /// relax: weight of a node's lower neighbour along each axis, the upper one has the rest: 1 / distance in `home`.
  std::array<RowField, Dim> low_weight;
  RowField node_mass;
  /// Share of a cell's mass that goes to the lower node of each axis, by cell index + ghost.
  std::array<std::vector<double>, Dim> low_share;

  RowField volume, next_volume;
  RowField target_volume; ///< on the target mesh
  bool at_target = false, left_target = false; ///< is position the target, bit by bit; was it before the last Lagrangian step?
  RowField density, pressure, modulus, wave_speed; ///< of the whole cell
  std::array<RowField, stress_components<Dim>> stress; ///< empty unless a material has strength
  /// Of the cell, likewise: shear modulus (mixed: harmonic mean, 0 beside void or a fluid), sum of fraction x flow stress.
  RowField shear, flow_stress;
  std::array<RowField, Dim> strain_rate, length, viscosity; ///< along each logical axis
  std::array<RowField, 2> skew; ///< of the first mesh's cells (ale/subzonal_pressure); empty unless asked for
  RowField stable_step;       ///< s, that each cell allows for a CFL number of one
  std::vector<int> row_least; ///< by row, the cell that allows the least
  std::array<RowField, Dim> swept, mass_flux;               ///< faces, at the cell above them
  /// Interface normal of each mixed cell of a row, left to right; blocks with strength (ale/traction).
  std::vector<std::vector<std::array<double, 3>>> interface_normals;
  std::vector<std::int8_t> owner; ///< the only material of a cell, or mixed_cell

  remap::Sliding<Dim> sliding; ///< empty unless a material slides
  RowField damped_density;     ///< density, zero where two velocities meet: no hourglass damping there (sliding only)
  remap::Scratch remap_scratch; ///< work arrays of the remap, nothing to remember

  Awake awake;                 ///< the cells that a step looks at (ale/rest)
  double still_speed = 0;      ///< m/s; what is slower rests (ale/rest)
  double awake_steps = 0;      ///< sum over the steps of the share of cells that were awake

  std::vector<MaterialSlot> materials; ///< in priority order; void last

  std::int8_t* owner_row(int r) {
    return owner.data() + static_cast<std::ptrdiff_t>(r) * grid.cell_pitch() + grid.ghost[0];
  }
  const std::int8_t* owner_row(int r) const {
    return owner.data() + static_cast<std::ptrdiff_t>(r) * grid.cell_pitch() + grid.ghost[0];
  }
  bool any_sliding() const { return !sliding.material.empty(); }
  bool any_strength() const { return !stress[0].empty(); }
  int void_index() const {
    return !materials.empty() && materials.back().is_void ? static_cast<int>(materials.size()) - 1 : -1;
  }
};

/// Share of the mass of cell (i, j, k) that goes to its corner; bit a of `corner`: the upper node along axis a.
template <int Dim> double corner_share(const Block<Dim>& b, int corner, int i, int j, int k) {
  const int index[3] = {i, j, k};
  double share = 1;
  for (std::size_t a = 0; a < Dim; ++a) {
    const double low = b.low_share[a][static_cast<std::size_t>(index[a] + b.grid.ghost[a])];
    share *= (corner >> a & 1) != 0 ? 1 - low : low;
  }
  return share;
}

/// Velocity component (m/s) at node i of node row r: of what slides there, or of the rest.
template <int Dim> double velocity_of(const Block<Dim>& b, bool sliding, std::size_t d, int r, int i) {
  const double v = b.velocity[d].row(r)[i];
  if (!b.any_sliding()) {
    return v;
  }
  const double follows = remap::node_follows(b.sliding.node_mass.row(r)[i], b.node_mass.row(r)[i]);
  return v + ((sliding ? 1 : 0) - follows) * b.sliding.jump[d].row(r)[i];
}

/// Does what slides take more of cell i of cell row r than the rest?
template <int Dim> bool mostly_slides(const Block<Dim>& b, int r, int i) {
  double excess = 0;
  for (const MaterialSlot& slot : b.materials) {
    excess += slot.is_void ? 0.0 : (slot.slides ? 1 : -1) * slot.store.row(field::fraction, r)[i];
  }
  return excess > 0;
}

/// Allocates the arrays of a block on the given mesh lines (logical coordinates of block.map: m on a rectilinear mesh) and
/// computes target mesh, the sides' normals, volumes and mass shares. Materials must be set; their stores are made here, empty.
template <int Dim>
void allocate_block(Block<Dim>& block, const std::array<std::vector<double>, 3>& lines);

/// Volumes (m3) of some cells of a row on node positions `x`.
void cell_volumes(const Block<2>& b, const std::array<RowField, 2>& x, int j, int k, Span cells, double* volume);
void cell_volumes(const Block<3>& b, const std::array<RowField, 3>& x, int j, int k, Span cells, double* volume);

/// Skew of the first mesh's cells, where the block keeps that mesh; 3D blocks have none.
template <int Dim> void mark_subzones(Block<Dim>& block);

/// Volumes of the target mesh, ghosts too.
template <int Dim> void target_volumes(Block<Dim>& block, ThreadPool& pool);

/// Node masses of awake cells from cell masses: M_p = sum of the cells' shares.
template <int Dim> void compute_node_mass(Block<Dim>& block, ThreadPool& pool);

/// owner of some of a row's cells from their volume fractions.
template <int Dim> void compute_owner(Block<Dim>& block, int row, Span cells);

/// Runs of some cells of a row: pure ones (material, begin, end) and mixed cells, left to right.
struct RowRuns {
  struct Run {
    int material, begin, end;
  };
  std::vector<Run> pure;
  std::vector<int> mixed;

  void scan(const std::int8_t* owner, Span cells);
};

} // namespace ballast
