// One pass of the remap beside bodies, private to ale/ (ale/embedding_remap). Declared here, defined by its phases:
// ale/embedding_remap (what takes part, what crosses faces), ale/embedding_pools (slivers and their roots), ale/embedding_momentum.
#pragma once

#include "ale/embedding_remap.hpp"
#include "ale/phases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace ballast {

/// Everything that cells hold, extensive: by cell and material its volume and, but for void, mass and mass x intensives.
class Contents {
public:
  /// Nothing, in `cells` of them.
  void assign(std::size_t cells, int size) {
    size_ = static_cast<std::size_t>(size);
    x_.assign(cells * size_, 0.0);
  }
  /// One more, that holds nothing.
  std::span<double> add() {
    x_.resize(x_.size() + size_, 0.0);
    return {x_.data() + x_.size() - size_, size_};
  }
  std::span<double> operator[](std::size_t c) { return {x_.data() + c * size_, size_}; }
  std::span<const double> operator[](std::size_t c) const { return {x_.data() + c * size_, size_}; }

private:
  std::size_t size_ = 0;
  std::vector<double> x_;
};

template <int Dim> class EmbeddedRemap {
public:
  EmbeddedRemap(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& b, remap::Mesh<Dim>* mesh, const remap::Settings& settings, long order)
      : scene_(scene), e_(e), b_(b), g_(b.grid), mesh_(mesh), settings_(settings), order_(order) {
    int at = 0;
    for (const MaterialSlot& slot : b.materials) {
      offset_.push_back(at);
      at += slot.is_void ? 1 : slot.store.conserved();
    }
    size_ = at;
  }

  /// Between remaps: slivers and their roots come to one state where they are.
  void pool();

  void run();

private:
  struct Transfer {
    int from, to; ///< places in cells_
    double mass;
    std::size_t group;
  };
  /// Of a material: 0, or 1 if it slides along the rest. The two have velocities of their own (remap/mesh.hpp, Sliding).
  std::size_t group_of(int m) const { return b_.materials[static_cast<std::size_t>(m)].slides ? 1 : 0; }

  std::size_t dense(const std::array<int, 3>& c) const { return e_.cell_at(g_, g_.cell_row(c[1], c[2]), c[0]); }
  bool inside(const std::array<int, 3>& c) const {
    bool in = true;
    for (std::size_t d = 0; d < Dim; ++d) {
      in = in && c[d] >= 0 && c[d] < g_.cells[d];
    }
    return in;
  }
  double at(std::size_t c, int material, int field) const { return contents_[c][static_cast<std::size_t>(offset_[static_cast<std::size_t>(material)] + field)]; }
  double& at(std::size_t c, int material, int field) { return contents_[c][static_cast<std::size_t>(offset_[static_cast<std::size_t>(material)] + field)]; }
  int materials() const { return static_cast<int>(b_.materials.size()); }
  int fields(int m) const { return b_.materials[static_cast<std::size_t>(m)].is_void ? 1 : b_.materials[static_cast<std::size_t>(m)].store.conserved(); }
  bool is_void(int m) const { return b_.materials[static_cast<std::size_t>(m)].is_void; }
  double mass_of(std::size_t c) const {
    double sum = 0;
    for (int m = 0; m < materials(); ++m) {
      sum += is_void(m) ? 0.0 : at(c, m, 1);
    }
    return sum;
  }
  /// By group.
  std::array<double, 2> masses_of(std::size_t c) const {
    std::array<double, 2> sum = {0, 0};
    for (int m = 0; m < materials(); ++m) {
      sum[group_of(m)] += is_void(m) ? 0.0 : at(c, m, 1);
    }
    return sum;
  }
  void transfer(std::size_t from, std::size_t to, double mass, std::size_t group) {
    if (mass != 0) {
      transfer_.push_back({static_cast<int>(mass > 0 ? from : to), static_cast<int>(mass > 0 ? to : from), std::abs(mass), group});
    }
  }
  /// What has gone from a cell to another since it held `before`.
  void transfer_change(std::size_t from, std::size_t to, const std::array<double, 2>& before) {
    const std::array<double, 2> now = masses_of(from);
    for (const std::size_t group : {0, 1}) {
      transfer(from, to, before[group] - now[group], group);
    }
  }

  void find_levels_on_the_way();

  /// Cells cut or covered before or after; their neighbours take part.
  void find_special();

  bool holds_anything(const std::array<int, 3>& c) const;

  struct Config {
    std::vector<int> kind;
    std::vector<CutCell<Dim>> cut;
    std::size_t at = 0; ///< in path_ and levels_
  };

  double open_of(const Config& config, const std::array<int, 3>& c) const {
    const int kind = config.kind[dense(c)];
    if (kind == covered_cell) {
      return 0;
    }
    return open_volume(level_cell<Dim>(g_, *path_[config.at], levels_[config.at], c), b_.axisymmetric);
  }
  double whole_of(const Config& config, const std::array<int, 3>& c) const {
    LevelCell<Dim> cell = level_cell<Dim>(g_, *path_[config.at], levels_[config.at], c);
    cell.level.fill(1);
    return open_volume(cell, b_.axisymmetric);
  }

  void gather();

  double aperture(const Config& config, std::size_t axis, const std::array<int, 3>& above) const {
    return face_opening<Dim>(g_, levels_[config.at], static_cast<int>(axis), above);
  }

  /// The side (faced_side) that a cell is open to, or was last; -1: several, or none known.
  int find_side(const std::array<int, 3>& c) const;

  /// Opening of a face of cell c, nothing if by now it opens to the body's other side.
  double own_aperture(const Levels<Dim>& levels, std::size_t c, std::size_t axis, const std::array<int, 3>& above) const;

  /// The neighbour behind the widest opening, weighed by its own room; chains of at most three.
  void find_roots(const Config& config, const std::vector<double>& volume, std::vector<int>& root);

  /// Open volume that crosses a face along +axis.
  double crossing(int axis, const std::array<int, 3>& above) const;

  /// Volumes by material of `volume` leaving a cell by its high or low end along an axis.
  void split(std::size_t c, std::size_t axis, bool high, double volume, std::span<double> out) const;

  void pool_contents(const std::vector<int>& root, Contents& pool, std::vector<char>& pooled) const;

  void move_through_faces();

  /// What crossed faces was drawn from pools: what is left in each has its pool's state, by the volumes that are left.
  void settle();

  /// Where a body is bent its open parts do not add up to what was swept: a cell's room stays near that, and void takes what is free.
  void keep_swept_rooms();

  /// What has far more room than a body leaves it goes on to a neighbour's void.
  void relieve();

  /// What was drawn from a pool is settled in one: who shared a root still does.
  void keep_pools();

  /// A trace of a material goes to the neighbour that has most of it.
  void hand_on_wisps();

  /// What has no room left goes to its root; where there is none, it stays as a pocket until there is.
  void bury();

  /// For what has no room and no root: the nearest cell on its side that has room and more of the same.
  std::size_t way_out(std::size_t c) const;

  /// Room of a cell when the pass is done, before the sweeps if they go on with it.
  double room(std::size_t c) const { return special_[dense(cells_[c])] != 0 ? to_volume_[c] : from_volume_[c] + swept_[c]; }

  /// Is everything as it was, and alike but for rounding? Then it stays so to the bit.
  bool at_rest(const std::vector<std::size_t>& members) const;

  /// What has come together in too little room keeps most of what it had; it is pressed out in the steps to come.
  void give_room(std::size_t root, const std::vector<std::size_t>& members);

  void equalise();

  /// Volume of a material as it will stand in its cell: void gives way, then all are squeezed.
  double fitted(std::size_t c, int m) const;

  /// A room that is not what geometry says is kept through the rest of the remap.
  void keep_room(std::size_t c) {
    if (special_[dense(cells_[c])] != 0 && room(c) > 0 && room(c) != open_of(target_, cells_[c])) {
      e_.pockets.push_back({cells_[c], room(c)});
    }
  }

  void scatter();

  /// The largest fraction makes the sum one.
  void settle_round_off(int r, int i);

  void move_momentum();

  Scene<Dim>& scene_;
  Embedding<Dim>& e_;
  Block<Dim>& b_;
  const Grid& g_;
  remap::Mesh<Dim>* mesh_;
  const remap::Settings settings_;
  long order_;
  std::vector<int> offset_;
  int size_ = 0;

  std::array<std::array<RowField, Dim>, Dim + 1> between_; // what of the path no field of the block holds
  std::array<const std::array<RowField, Dim>*, Dim + 1> path_ = {};
  std::array<Levels<Dim>, Dim + 1> levels_;
  Config lag_, target_;
  std::vector<char> special_;
  std::vector<int> place_;
  std::vector<std::array<int, 3>> cells_;
  Contents contents_, start_, pool_;
  std::vector<char> pooled_, touched_;
  std::vector<double> from_volume_, to_volume_, swept_;
  std::vector<int> root_, next_root_, side_;
  std::vector<Transfer> transfer_;
};

} // namespace ballast
