// Embedding: stacks of layers inside a block whose mesh stays behind (eulerian, follow, relax), as bodies in the way of what it holds.
//
// The block's own step and remap go on as everywhere. What a body takes of a cell is left out of the cell's volume: Block::volume of a
// cut cell is its open part (ale/embed/open_part), whose gradient gives the forces on nodes and body alike. A covered cell
// holds void that neither presses nor works. Nodes in or close to a body are tied to it where what is around them touches it:
// their velocity along the surface's normal is the surface's, their mass in that direction is carried by the layers' nodes
// (ale/layers/layer_load). Along the surface they are free, so it is smooth; where there is void between, they are free
// altogether. Tying is the one inelastic event.
//
// A step: begin (where are the bodies, who touches) - forces of cut cells - layers move with what hangs on them - tied nodes
// follow - volumes and work. The remap moves what crosses the openings of faces near a body by itself, before the sweeps
// (ale/embedding_remap).
#pragma once

#include "ale/corner_force.hpp"
#include "ale/embed/layer_body.hpp"
#include "ale/embed/open_part.hpp"
#include "ale/layers/layers.hpp"
#include "ale/scene.hpp"

#include <span>
#include <vector>

namespace ballast {

/// A node near a body.
template <int Dim> struct NodeFoot {
  BodyFoot<Dim> foot;
  int stack = 0;
  int row = 0, index = 0; ///< the node
  int other = -1;         ///< of a covered node: where in `feet` its foot on the other side stands
  bool tied = false;
  /// Tied: its speed along the unit vector `tie` is the dot product of `carry` with the surface's velocity. Both are the normal n; on walls
  /// tie lies in them and carry = n / (n.tie).
  std::array<double, Dim> tie = {}, carry = {};
};

/// Levels of a mesh's nodes, wherever they are.
template <int Dim> struct Levels {
  RowField level;             ///< m; of nodes out of reach of any body only the sign means something
  std::vector<int> foot_of;   ///< by node: where in `feet`, or -1
  std::vector<NodeFoot<Dim>> feet;
  Span rows;                  ///< along the last axis: nodes that are inside or near are in these rows only
};

template <int Dim> struct CutCell {
  std::array<int, 3> cell = {0, 0, 0};
  int row = 0;         ///< cell row
  double whole = 0;    ///< m3, with what the body takes
  double width = 0;    ///< m: least edge
  double viscosity = 0; ///< Pa, of the open part
  bool touches = false; ///< presses on the body or is about to
  int root = -1; ///< of a sliver: the cell whose state it shares, as row x pitch + index (Embedding::cell_at), or -1
  std::array<int, 3> root_cell = {};
  double scaled = 1; ///< of a sliver: by what the step scaled its materials' volumes; the pool they belong to takes it back and shares it
  std::array<int, 1 << Dim> foot = {}; ///< of its corners, in Levels::feet, or -1
  double open = 0; ///< m3 that the body leaves; what is there may have more where the body's shape has jumped
};

/// What pressure and deviator of a cut cell do in a step.
template <int Dim> struct CutForce {
  std::array<std::array<double, Dim>, 1 << Dim> corner = {}; ///< N
  std::array<double, 1 << Dim> push = {}; ///< N: on the body at a corner's foot, against its normal
  OpenPart<Dim> half;                     ///< at the half step
  double compression = 0;                 ///< up to it
};

/// What a body has buried and found no way out for: it waits.
struct Pocket {
  std::array<int, 3> cell = {0, 0, 0};
  double volume = 0; ///< m3
};

/// Kinds of cells: from 0 on the number of a cut cell.
inline constexpr int open_cell = -1, covered_cell = -2;

/// Of the room that a cell's materials fill: what a body may take of it in a step of natural length beyond its motion, where its shape jumps.
inline constexpr double most_squeeze = 0.002;

template <int Dim> struct Embedding {
  int block = 0;
  /// m, by stack and node of its planes: what a body must have there not to slip through cells (ale/embed/layer_body).
  std::vector<std::vector<double>> least_thickness;
  double bin = 0, longest_edge = 0; ///< m: of the search for feet; of cells around the stacks at the start

  Levels<Dim> now;           ///< at the block's positions
  Levels<Dim> next;          ///< at the end of the Lagrangian step
  std::vector<int> kind;     ///< by cell
  Span rows;                 ///< of nodes, beside which alone there are cut or covered cells (Levels::rows)
  std::vector<CutCell<Dim>> cut;

  std::vector<std::vector<char>> alive; ///< by stack: its elements at the start of the step, whose room the bodies take until its end
  double seconds = 0;                   ///< s of the clock on the wall, this run
  std::array<std::vector<char>, Dim> closed; ///< faces, at the cell above, that the remap's sweeps leave alone
  double least_width = 0;    ///< m: shortest edge of a cut cell
  double squeeze = most_squeeze; ///< of this step; while it begins, of the last one

  std::vector<CutForce<Dim>> force; ///< by cut cell
  std::vector<Pocket> pockets;      ///< of the last remap
  // Of the step, by stack: where its nodes were at its start, kinetic energy of the loaded ones before the load.
  std::vector<std::array<std::vector<double>, Dim>> start;
  std::vector<double> kinetic;

  std::size_t cell_at(const Grid& g, int r, int i) const { return static_cast<std::size_t>(r * g.cell_pitch() + i + g.ghost[0]); }
  int kind_of(const Grid& g, int r, int i) const { return kind[cell_at(g, r, i)]; }
};

/// Where node (r, i) stands in a dense array of nodes.
inline std::size_t node_at(const Grid& g, int r, int i) { return static_cast<std::size_t>(r * g.node_pitch() + i + g.ghost[0]); }

/// Corner p of a cell in the order of the corner forces, as (di, dj, dk).
template <int Dim> std::array<int, 3> corner_step(int p) {
  const int low = p & 3;
  return {low == 1 || low == 2 ? 1 : 0, low > 1 ? 1 : 0, Dim == 3 ? p >> 2 : 0};
}

/// Nodes of the face below cell `above` along an axis, turning as those of remap/swept do.
template <int Dim> std::array<std::array<int, 3>, 1 << (Dim - 1)> face_nodes(int axis, const std::array<int, 3>& above) {
  std::array<std::array<int, 3>, 1 << (Dim - 1)> nodes;
  nodes.fill(above);
  if constexpr (Dim == 2) {
    ++nodes[1][axis == 0 ? 1 : 0];
  } else {
    const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
    ++nodes[1][u];
    ++nodes[2][u];
    ++nodes[2][v];
    ++nodes[3][v];
  }
  return nodes;
}

/// Levels of all nodes at `position`. The same for any pool.
template <int Dim>
Levels<Dim> find_levels(const Grid& grid, const std::array<RowField, Dim>& position, const std::vector<LayerBody<Dim>>& bodies, ThreadPool& pool);

/// The bodies as the stacks stand.
template <int Dim> std::vector<LayerBody<Dim>> bodies_of(const Scene<Dim>& scene, const Embedding<Dim>& e);

/// What lies below all stacks is side 0, between the first two side 1, ...: the side that a foot faces. -1: a rim.
template <int Dim> int faced_side(const NodeFoot<Dim>& f) { return f.foot.side > 1 ? -1 : f.stack + f.foot.side; }

/// The foot that counts for a node beside what is open on `side` (below none: the nearest): where in `feet`, or -1.
template <int Dim> int foot_on(const Levels<Dim>& levels, std::size_t node, int side) {
  const int at = levels.foot_of[node];
  if (at < 0 || side < 0) {
    return at;
  }
  const NodeFoot<Dim>& f = levels.feet[static_cast<std::size_t>(at)];
  const int wrong = side > f.stack ? 0 : 1; // face of its stack, that faces away
  return f.other >= 0 && f.foot.side == wrong ? f.other : at;
}

/// Side on which the open ones of some nodes lie (faced_side); -1: several, a rim, or none near.
template <int Dim> int open_side(const Grid& grid, const Levels<Dim>& levels, std::span<const std::array<int, 3>> nodes);

/// Level of a node for what is open on `side`.
template <int Dim> double level_on(const Grid& grid, const Levels<Dim>& levels, const std::array<int, 3>& node, int side);

/// Corner positions and levels of a cell; `feet`: where in levels.feet the corners' stand, or -1.
template <int Dim> LevelCell<Dim> level_cell(const Grid& grid, const std::array<RowField, Dim>& position, const Levels<Dim>& levels, const std::array<int, 3>& cell, std::array<int, 1 << Dim>* feet = nullptr);

/// Open share of the face below cell `above` along an axis (2D: of its length).
template <int Dim> double face_opening(const Grid& grid, const Levels<Dim>& levels, int axis, const std::array<int, 3>& above);

/// Cut cells that are open by less than this share of the whole are slivers: they share their state with a root.
inline constexpr double sliver_share = 0.5;

/// Kinds and cut cells from levels. The same for any pool.
template <int Dim>
void find_cells(const Block<Dim>& b, const std::array<RowField, Dim>& position, const Levels<Dim>& levels, ThreadPool& pool, std::vector<int>& kind, std::vector<CutCell<Dim>>& cut);

/// What bodies must have where they are now not to slip through cells of the mesh that remaps lead to.
template <int Dim> void find_least_thickness(const Scene<Dim>& scene, Embedding<Dim>& e);

/// By stack and node of its planes (m): of that, what it must have by itself, where other stacks lie against it. Empty where there is one stack.
template <int Dim> std::vector<std::vector<double>> own_thickness(const Scene<Dim>& scene, const Embedding<Dim>& e);

/// What a step reads of the one before, beyond where everything is.
struct EmbeddingMemory {
  std::vector<std::vector<char>> alive; ///< Embedding::alive
  std::vector<std::int64_t> cells;      ///< Embedding::cell_at of those that were not open
  Span rows;                            ///< Embedding::rows
  std::vector<Pocket> pockets;
};
template <int Dim> EmbeddingMemory memory_of(const Embedding<Dim>& e);

/// Levels and cells anew, from where everything is: at the start of a run, and of its continuation with what it remembers.
template <int Dim> void find_bodies(Scene<Dim>& scene, Embedding<Dim>& e);
template <int Dim> void find_bodies(Scene<Dim>& scene, Embedding<Dim>& e, const EmbeddingMemory& memory);

/// Makes the block's cells hold what fits beside the bodies: once, at the start. Void gives way first.
template <int Dim> void prepare_embedding(Scene<Dim>& scene, Embedding<Dim>& e);

/// A step dt (s) far below the usual squeezes less: else one that has fallen falls on by the pressure that this makes.
template <int Dim> void set_squeeze(const Scene<Dim>& scene, Embedding<Dim>& e, double dt);

/// Start of a step: levels, cut cells; void takes the room of elements that have gone.
template <int Dim> void update_cells(Scene<Dim>& scene, Embedding<Dim>& e);

/// After it: what touches, which nodes are tied; tied ones take on the surface's normal velocity, an impact that keeps momentum.
template <int Dim> void tie_nodes(Scene<Dim>& scene, Embedding<Dim>& e);

/// Strain rates and lengths of cut cells as of whole ones, for the viscosity of their neighbours; after the block's rates.
template <int Dim> void embedded_rates(const Embedding<Dim>& e, Block<Dim>& b, ThreadPool& pool);

/// Is cell i of cell row r cut and open by less than a sliver's share?
template <int Dim> bool is_sliver(const Embedding<Dim>& e, const Block<Dim>& b, int r, int i) {
  const int kind = e.kind_of(b.grid, r, i);
  return kind >= 0 && b.volume.row(r)[i] < sliver_share * e.cut[static_cast<std::size_t>(kind)].whole;
}

/// Viscosity of cut cells, and the step they allow.
template <int Dim> void limit_embedded(Scene<Dim>& scene, Embedding<Dim>& e, DtLimit& limit);

/// Forces of all cut cells for a step of dt.
template <int Dim> void cut_forces(const Scene<Dim>& scene, Embedding<Dim>& e, double dt);

/// Corner forces, and work, of the row's cut and covered cells, in place of what the row's kernels made of them.
template <int Dim> void override_forces(const Scene<Dim>& scene, const Embedding<Dim>& e, int j, int k, const CornerRows<Dim>& out);
template <int Dim> void override_work(const Scene<Dim>& scene, const Embedding<Dim>& e, int j, int k, double dt, const WorkRows<Dim>& out);

/// Puts on the layers what the block's forces (in next_velocity) and tied nodes are to them; the layers' step comes next.
template <int Dim> void load_layers(Scene<Dim>& scene, Embedding<Dim>& e, double dt);

/// After it: tied nodes follow, the load comes off, energy that changed hands is booked.
template <int Dim> void follow_layers(Scene<Dim>& scene, Embedding<Dim>& e, double dt);

/// After the layers have moved: next_volume of cut cells.
template <int Dim> void embedded_volumes(Scene<Dim>& scene, Embedding<Dim>& e);

/// Of a foot along its normal, or another direction: speed (m/s); way in this step along the normal (m).
template <int Dim> double surface_speed(const Scene<Dim>& scene, const NodeFoot<Dim>& f, const std::array<double, Dim>& along);
template <int Dim> double surface_way(const Scene<Dim>& scene, const Embedding<Dim>& e, const NodeFoot<Dim>& f);

/// Relative rate at which a cut cell's open part closes, 1/s.
template <int Dim> double closing_rate(const Scene<Dim>& scene, const Embedding<Dim>& e, const CutCell<Dim>& c);

/// kg of each material but void below and above the last layer of a stack inside the mesh, across its holes; beside that layer's
/// surface, on the surface's side. Empty if nothing is left of it, or no mesh is around it.
template <int Dim> std::vector<std::array<double, 2>> masses_by_side(const Scene<Dim>& scene, std::size_t stack);

/// The block's embedding in the scene, or null.
template <int Dim> Embedding<Dim>* embedding_of(const Scene<Dim>& scene, const Block<Dim>& b);

} // namespace ballast
