// Remap beside bodies: what crosses the open parts of faces of cut cells, before the sweeps of all others.
//
// The bodies stand still; nodes go to their target one coordinate after the other as in remap/swept, and the open part of what each face
// sweeps (ale/embed/open_part) is what passes through it, so a plane body leaves volumes exact. Cells less than half open
// share one state with their root, the neighbour behind their widest opening: what leaves them is drawn from both, and at the end
// density and energy of every material are the same in both. What a body buries goes to the root whole. Momentum goes corner by
// corner with the mass, at the velocity of the corner it leaves.
#include "ale/embedding_remap.hpp"

#include "ale/phases.hpp"
#include "remap/internal.hpp"
#include "remap/reconstruct.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballast {

namespace {

constexpr double nothing = 1e-10;    ///< of a cell at reference density: a material's trace that is dropped, with an entry

constexpr double merged_below = 0.25; ///< of a whole cell: smaller slivers hold the same mixture as their root, void and all
constexpr double largest_stretch = 0.98; ///< of a cell's room: less than that is a void

/// Everything a cell holds, extensive: by material its volume and, but for void, mass and mass x intensives.
struct Contents {
  std::vector<double> x;
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
  void pool() {
    path_[0] = b_.position;
    levels_[0] = e_.next;
    find_cells<Dim>(b_, path_[0], levels_[0], lag_.kind, lag_.cut);
    target_ = lag_;
    find_special();
    gather();
    for (std::size_t c = 0; c < cells_.size(); ++c) { // as they are, but for what has no room
      to_volume_[c] = lag_.kind[dense(cells_[c])] == covered_cell ? 0.0 : from_volume_[c];
    }
    find_roots(target_, to_volume_, next_root_);
    bury();
    equalise();
    scatter();
    move_momentum();
  }

  void run() {
    find_levels_on_the_way();
    find_special();
    gather();
    find_roots(lag_, from_volume_, root_);
    move_through_faces();
    settle();
    find_roots(target_, to_volume_, next_root_);
    keep_pools();
    bury();
    equalise();
    scatter();
    move_momentum();
  }

private:
  struct Transfer {
    int from, to; ///< places in cells_
    double mass;
  };

  std::size_t dense(const std::array<int, 3>& c) const { return e_.cell_at(g_, g_.cell_row(c[1], c[2]), c[0]); }
  bool inside(const std::array<int, 3>& c) const {
    for (std::size_t d = 0; d < Dim; ++d) {
      if (c[d] < 0 || c[d] >= g_.cells[d]) {
        return false;
      }
    }
    return true;
  }
  double at(std::size_t c, int material, int field) const { return contents_[c].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(material)] + field)]; }
  double& at(std::size_t c, int material, int field) { return contents_[c].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(material)] + field)]; }
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

  void find_levels_on_the_way() {
    const std::vector<LayerBody<Dim>> bodies = bodies_of(scene_, e_);
    path_[0] = b_.position;
    levels_[0] = e_.next;
    for (int q = 0; q < Dim; ++q) {
      const auto next = static_cast<std::size_t>(q + 1), d = static_cast<std::size_t>(remap::sweep_axis(Dim, q, order_));
      path_[next] = path_[next - 1];
      path_[next][d] = b_.target[d];
      levels_[next] = find_levels<Dim>(g_, path_[next], bodies, &e_.now);
    }
    find_cells<Dim>(b_, path_[0], levels_[0], lag_.kind, lag_.cut);
    find_cells<Dim>(b_, path_[Dim], levels_[Dim], target_.kind, target_.cut);
    target_.at = Dim;
  }

  /// Cells cut or covered before or after; their neighbours take part.
  void find_special() {
    special_.assign(lag_.kind.size(), 0);
    place_.assign(lag_.kind.size(), -1);
    for (int k = 0; k < g_.cells[2]; ++k) {
      for (int j = 0; j < g_.cells[1]; ++j) {
        for (int i = 0; i < g_.cells[0]; ++i) {
          const std::size_t c = dense({i, j, k});
          special_[c] = lag_.kind[c] != open_cell || target_.kind[c] != open_cell ? 1 : 0;
        }
      }
    }
    const auto take = [&](const std::array<int, 3>& c) {
      if (place_[dense(c)] < 0) {
        place_[dense(c)] = static_cast<int>(cells_.size());
        cells_.push_back(c);
      }
    };
    for (int k = 0; k < g_.cells[2]; ++k) {
      for (int j = 0; j < g_.cells[1]; ++j) {
        for (int i = 0; i < g_.cells[0]; ++i) {
          const std::array<int, 3> c = {i, j, k};
          const std::size_t at_c = dense(c);
          if (special_[at_c] == 0 || (lag_.kind[at_c] == covered_cell && target_.kind[at_c] == covered_cell && !holds_anything(c))) {
            continue;
          }
          take(c);
          for (int axis = 0; axis < Dim; ++axis) {
            for (const int side : {-1, 1}) {
              std::array<int, 3> n = c;
              n[static_cast<std::size_t>(axis)] += side;
              if (inside(n)) {
                take(n);
              }
            }
          }
        }
      }
    }
    for (std::size_t a = 0; a < Dim; ++a) { // faces of special cells: the sweeps leave them
      e_.closed[a].assign(special_.size(), 0);
      for (int k = 0; k < g_.cells[2] + (a == 2 ? 1 : 0); ++k) {
        for (int j = 0; j < g_.cells[1] + (a == 1 ? 1 : 0); ++j) {
          for (int i = 0; i < g_.cells[0] + (a == 0 ? 1 : 0); ++i) {
            std::array<int, 3> above = {i, j, k}, below = {i, j, k};
            --below[a];
            const bool low = inside(below) && special_[dense(below)] != 0, high = inside(above) && special_[dense(above)] != 0;
            e_.closed[a][dense(above)] = low || high ? 1 : 0;
          }
        }
      }
    }
  }

  bool holds_anything(const std::array<int, 3>& c) const {
    for (const MaterialSlot& slot : b_.materials) {
      if (!slot.is_void && slot.store.row(field::mass, g_.cell_row(c[1], c[2]))[c[0]] > 0) {
        return true;
      }
    }
    return false;
  }

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
    return open_volume(level_cell<Dim>(g_, path_[config.at], levels_[config.at], c), b_.axisymmetric);
  }
  double whole_of(const Config& config, const std::array<int, 3>& c) const {
    LevelCell<Dim> cell = level_cell<Dim>(g_, path_[config.at], levels_[config.at], c);
    cell.level.fill(1);
    return open_volume(cell, b_.axisymmetric);
  }

  void gather() {
    for (const std::array<int, 3>& c : cells_) {
      const int r = g_.cell_row(c[1], c[2]), i = c[0];
      const bool special = special_[dense(c)] != 0;
      const double volume = b_.volume.row(r)[i];
      const bool covered = lag_.kind[dense(c)] == covered_cell;
      Contents now{std::vector<double>(static_cast<std::size_t>(size_), 0.0)};
      bool holds = false;
      for (int m = 0; m < materials(); ++m) {
        const MaterialSlot& slot = b_.materials[static_cast<std::size_t>(m)];
        const auto first = static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)]);
        now.x[first] = slot.store.row(field::fraction, r)[i] * volume;
        if (!slot.is_void) {
          const double mass = slot.store.row(field::mass, r)[i];
          holds = holds || mass > 0;
          now.x[first + 1] = mass;
          for (int f = 2; f < slot.store.conserved(); ++f) {
            now.x[first + static_cast<std::size_t>(f)] = mass * slot.store.row(f, r)[i];
          }
        }
      }
      if (covered && !holds) {
        now.x.back() = 0; // the void of a covered cell is no room
      }
      from_volume_.push_back(covered && !holds ? 0.0 : volume);
      to_volume_.push_back(special ? open_of(target_, c) : 0.0);
      swept_.push_back(0);
      contents_.push_back(std::move(now));
    }
    transfer_.clear();
  }

  double aperture(const Config& config, std::size_t axis, const std::array<int, 3>& above) const {
    return face_opening<Dim>(g_, levels_[config.at], static_cast<int>(axis), above);
  }

  /// The neighbour behind the widest opening, weighed by its own room; chains of at most three.
  void find_roots(const Config& config, const std::vector<double>& volume, std::vector<int>& root) {
    const auto n = cells_.size();
    root.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
      root[c] = static_cast<int>(c);
      const double whole = special_[dense(cells_[c])] != 0 ? whole_of(config, cells_[c]) : 0;
      if (special_[dense(cells_[c])] == 0 || !(volume[c] < sliver_share * whole) || (volume[c] == 0 && mass_of(c) == 0 && &config == &target_)) {
        continue;
      }
      double best = 0;
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        for (const int side : {-1, 1}) {
          std::array<int, 3> to = cells_[c];
          to[axis] += side;
          if (!inside(to) || place_[dense(to)] < 0) {
            continue;
          }
          const auto q = static_cast<std::size_t>(place_[dense(to)]);
          const std::array<int, 3>& face = side < 0 ? cells_[c] : to;
          // A face open at either end of the motion joins: what is buried goes where it came from.
          const double open = std::max({aperture(lag_, axis, face), aperture(target_, axis, face), face_opening<Dim>(g_, e_.now, static_cast<int>(axis), face)});
          const double room = special_[dense(to)] != 0 ? volume[q] : whole_of(config, to);
          if (room > volume[c] && open * room > best) {
            best = open * room;
            root[c] = static_cast<int>(q);
          }
        }
      }
    }
    for (int pass = 0; pass < 3; ++pass) {
      for (std::size_t c = 0; c < n; ++c) {
        root[c] = root[static_cast<std::size_t>(root[c])];
      }
    }
  }

  /// Open volume that crosses a face along +axis.
  double crossing(int axis, const std::array<int, 3>& above) const;

  /// Volumes by material of `volume` leaving a cell by its high or low end along an axis.
  void split(std::size_t c, std::size_t axis, bool high, double volume, std::vector<double>& out) const {
    out.assign(static_cast<std::size_t>(materials()), 0.0);
    const auto root = static_cast<std::size_t>(root_[c]);
    if (root != c || pooled_[c] != 0) {
      double all = 0;
      for (int m = 0; m < materials(); ++m) {
        all += std::max(pool_[root].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0);
      }
      for (int m = 0; m < materials() && all > 0; ++m) {
        out[static_cast<std::size_t>(m)] = volume * std::max(pool_[root].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0) / all;
      }
      if (root != c) {
        return;
      }
    }
    const std::array<int, 3>& cell = cells_[c];
    const int r = g_.cell_row(cell[1], cell[2]);
    const auto parts = remap::reconstruct_cell<Dim>(g_, mesh_->materials, settings_.normal, r, cell[0]);
    out.assign(static_cast<std::size_t>(materials()), 0.0);
    if (parts.count == 1) {
      out[static_cast<std::size_t>(parts.present[0])] = volume;
      return;
    }
    double slab[remap::most_materials], sum = 0;
    const double part = std::min(1.0, volume / from_volume_[c]);
    remap::slab_volumes<Dim>(parts.planes, parts.count - 1, static_cast<int>(axis), high ? 1 - part : 0.0, high ? 1.0 : part, slab);
    for (int q = 0; q < parts.count; ++q) {
      sum += slab[q];
    }
    for (int q = 0; q < parts.count && sum > 0; ++q) {
      out[static_cast<std::size_t>(parts.present[q])] = slab[q] / sum * volume;
    }
  }

  void pool_contents(const std::vector<int>& root, std::vector<Contents>& pool, std::vector<char>& pooled) const {
    pool.assign(cells_.size(), Contents{});
    pooled.assign(cells_.size(), 0);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto q = static_cast<std::size_t>(root[c]);
      if (pool[q].x.empty()) {
        pool[q].x.assign(static_cast<std::size_t>(size_), 0.0);
      }
      for (std::size_t n = 0; n < contents_[c].x.size(); ++n) {
        pool[q].x[n] += contents_[c].x[n];
      }
      pooled[q] = q != c ? 1 : pooled[q];
    }
  }

  void move_through_faces() {
    pool_contents(root_, pool_, pooled_);
    const std::vector<Contents> before = contents_;
    struct Crossing {
      std::size_t from, to;
      std::vector<double> volume;
    };
    std::vector<Crossing> crossings;
    for (std::size_t low = 0; low < cells_.size(); ++low) {
      for (std::size_t axis = 0; axis < Dim; ++axis) {
        std::array<int, 3> above = cells_[low];
        ++above[axis];
        if (!inside(above) || place_[dense(above)] < 0 || e_.closed[axis][dense(above)] == 0) {
          continue;
        }
        const double t = crossing(static_cast<int>(axis), above);
        const auto high = static_cast<std::size_t>(place_[dense(above)]);
        swept_[low] -= t;
        swept_[high] += t;
        if (t != 0) {
          crossings.push_back({t > 0 ? low : high, t > 0 ? high : low, {}});
          split(crossings.back().from, axis, t > 0, std::abs(t), crossings.back().volume);
        }
      }
    }
    // No cell of its own gives more of a material than it has.
    std::vector<std::vector<double>> given(cells_.size(), std::vector<double>(static_cast<std::size_t>(materials()), 0.0));
    for (const Crossing& x : crossings) {
      for (std::size_t m = 0; m < x.volume.size(); ++m) {
        given[static_cast<std::size_t>(root_[x.from])][m] += x.volume[m];
      }
    }
    for (const Crossing& x : crossings) {
      const auto root = static_cast<std::size_t>(root_[x.from]);
      for (int m = 0; m < materials(); ++m) {
        const auto mm = static_cast<std::size_t>(m);
        const auto first = static_cast<std::size_t>(offset_[mm]);
        const double held = pool_[root].x[first];
        const double v = given[root][mm] > held ? x.volume[mm] * std::max(held, 0.0) / given[root][mm] : x.volume[mm];
        if (!(v > 0)) {
          continue;
        }
        const double share = v / held;
        double mass = 0;
        for (int f = 0; f < fields(m); ++f) {
          const double amount = pool_[root].x[first + static_cast<std::size_t>(f)] * share;
          at(x.from, m, f) -= amount;
          at(x.to, m, f) += amount;
          mass = f == 1 ? amount : mass;
        }
        if (!is_void(m)) {
          transfer_.push_back({static_cast<int>(x.from), static_cast<int>(x.to), mass});
        }
      }
    }
  }

  /// What crossed faces was drawn from pools: what is left in each has its pool's state, by the volumes that are left.
  void settle() {
    std::vector<Contents> pool;
    std::vector<char> pooled;
    pool_contents(root_, pool, pooled);
    std::vector<double> before(cells_.size()), volume(cells_.size());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      before[c] = mass_of(c);
    }
    for (int m = 0; m < materials(); ++m) {
      std::fill(volume.begin(), volume.end(), 0.0);
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        volume[static_cast<std::size_t>(root_[c])] += std::max(at(c, m, 0), 0.0);
      }
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        const auto root = static_cast<std::size_t>(root_[c]);
        if (root == c && pooled[c] == 0) {
          continue;
        }
        const double share = volume[root] > 0 ? std::max(at(c, m, 0), 0.0) / volume[root] : (c == root ? 1.0 : 0.0);
        for (int f = 0; f < fields(m); ++f) {
          at(c, m, f) = share * pool[root].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)] + f)];
        }
      }
    }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const double change = mass_of(c) - before[c];
      if (root_[c] != static_cast<int>(c) && change != 0) {
        const int root = root_[c], cell = static_cast<int>(c);
        transfer_.push_back({change > 0 ? root : cell, change > 0 ? cell : root, std::abs(change)});
      }
    }
  }

  /// What was drawn from a pool is settled in one: who shared a root still does.
  void keep_pools() {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (next_root_[c] == static_cast<int>(c) && root_[c] != static_cast<int>(c)) {
        const int to = next_root_[static_cast<std::size_t>(root_[c])];
        next_root_[c] = to;
      }
    }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      next_root_[c] = next_root_[static_cast<std::size_t>(next_root_[c])];
    }
  }

  /// What has no room left goes to its root; where there is none, it stays as a pocket until there is.
  void bury() {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const auto root = static_cast<std::size_t>(next_root_[c]);
      if (special_[dense(cells_[c])] == 0 || to_volume_[c] > 0) {
        continue;
      }
      const double mass = mass_of(c);
      if (root == c) {
        to_volume_[c] = mass > 0 ? from_volume_[c] : 0.0;
        continue;
      }
      for (std::size_t n = 0; n < contents_[c].x.size(); ++n) {
        contents_[root].x[n] += contents_[c].x[n];
        contents_[c].x[n] = 0;
      }
      if (mass != 0) {
        transfer_.push_back({static_cast<int>(c), next_root_[c], mass});
      }
      next_root_[c] = static_cast<int>(c);
    }
  }

  /// Room of a cell when the pass is done, before the sweeps if they go on with it.
  double room(std::size_t c) const { return special_[dense(cells_[c])] != 0 ? to_volume_[c] : from_volume_[c] + swept_[c]; }

  /// What has come together in too little room keeps most of what it had; it is pressed out in the steps to come.
  void give_room(std::size_t root, const std::vector<std::size_t>& members) {
    constexpr double keeps = 0.85;
    double room_there = 0, filled = 0;
    for (const std::size_t c : members) {
      room_there += room(c);
      for (int m = 0; m < materials(); ++m) {
        filled += is_void(m) ? 0.0 : at(c, m, 0);
      }
    }
    if (special_[dense(cells_[root])] != 0 && keeps * filled > room_there) {
      to_volume_[root] += keeps * filled - room_there;
    }
  }

  void equalise() {
    std::vector<Contents> pool;
    std::vector<char> pooled;
    pool_contents(next_root_, pool, pooled);
    for (std::size_t root = 0; root < cells_.size(); ++root) {
      if (pooled[root] == 0) {
        if (next_root_[root] == static_cast<int>(root)) {
          give_room(root, {root});
        }
        continue;
      }
      std::vector<std::size_t> members;
      double whole = 0;
      bool valid = true;
      for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (static_cast<std::size_t>(next_root_[c]) == root) {
          members.push_back(c);
          whole += room(c);
          double sum = 0;
          for (int m = 0; m < materials(); ++m) {
            valid = valid && at(c, m, 0) >= 0;
            sum += at(c, m, 0);
          }
          valid = valid && std::abs(sum - room(c)) <= 0.05 * room(c);
          valid = valid && (c == root || room(c) > merged_below * whole_of(target_, cells_[c]));
        }
      }
      give_room(root, members);
      double held = 0;
      for (int m = 0; m < materials(); ++m) {
        held += std::max(pool[root].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0);
      }
      for (const std::size_t c : members) {
        const double before = mass_of(c);
        if (!valid) {
          for (int m = 0; m < materials(); ++m) {
            at(c, m, 0) = std::max(pool[root].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)])], 0.0) / held * room(c);
          }
        }
        mass_before_.push_back(before);
      }
      for (int m = 0; m < materials(); ++m) {
        if (is_void(m)) {
          continue;
        }
        double volume = 0;
        for (const std::size_t c : members) {
          volume += fitted(c, m);
        }
        for (const std::size_t c : members) {
          const double share = volume > 0 ? fitted(c, m) / volume : (c == root ? 1.0 : 0.0);
          for (int f = 1; f < fields(m); ++f) {
            at(c, m, f) = share * pool[root].x[static_cast<std::size_t>(offset_[static_cast<std::size_t>(m)] + f)];
          }
        }
      }
      std::size_t q = mass_before_.size() - members.size();
      for (const std::size_t c : members) {
        const double change = mass_of(c) - mass_before_[q++];
        if (c != root && change != 0) {
          transfer_.push_back({change > 0 ? static_cast<int>(root) : static_cast<int>(c), change > 0 ? static_cast<int>(c) : static_cast<int>(root), std::abs(change)});
        }
      }
    }
  }

  /// Volume of a material as it will stand in its cell: void gives way, then all are squeezed.
  double fitted(std::size_t c, int m) const {
    double sum = 0;
    for (int q = 0; q < materials(); ++q) {
      sum += is_void(q) ? 0.0 : std::max(at(c, q, 0), 0.0);
    }
    const double v = std::max(at(c, m, 0), 0.0);
    const auto root = static_cast<std::size_t>(next_root_[c]);
    const auto hollow = [&](std::size_t q) { return at(q, materials() - 1, 0) > 1e-9 * room(q); };
    // Room that geometry has left over is filled; of a sliver all of it if what is behind it is solid.
    const bool fills = !hollow(c) && !hollow(root) && sum > (root == c ? largest_stretch : 0.0) * room(c);
    return sum > room(c) || fills ? v * room(c) / sum : v;
  }

  void scatter() {
    e_.pockets.clear();
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const std::array<int, 3>& cell = cells_[c];
      const int r = g_.cell_row(cell[1], cell[2]), i = cell[0];
      const double volume = room(c);
      double left = 1;
      const bool covered = special_[dense(cell)] != 0 && !(volume > 0);
      for (int m = 0; m < materials(); ++m) {
        MaterialSlot& slot = b_.materials[static_cast<std::size_t>(m)];
        if (slot.is_void) {
          continue;
        }
        const double v = covered ? 0.0 : fitted(c, m), mass = at(c, m, 1);
        const bool some = v > 0 && mass > nothing * slot.material.density * volume;
        if (!some && mass != 0) {
          scene_.ledger.sliver_mass += mass;
          scene_.ledger.sliver_energy += at(c, m, 2);
          ++scene_.ledger.slivers;
        }
        if (!some && !slot.store.has_row(r)) {
          continue;
        }
        slot.store.allocate(slot.store.tile_of(r));
        slot.store.row(field::fraction, r)[i] = some ? v / volume : 0.0;
        slot.store.row(field::mass, r)[i] = some ? mass : 0.0;
        for (int f = 2; f < slot.store.conserved(); ++f) {
          slot.store.row(f, r)[i] = some ? at(c, m, f) / mass : 0.0;
        }
        left -= some ? v / volume : 0.0;
      }
      TileStore& gap = b_.materials.back().store;
      gap.allocate(gap.tile_of(r));
      gap.row(field::fraction, r)[i] = left > 1e-13 ? left : 0.0;
      b_.volume.row(r)[i] = covered ? whole_of(target_, cell) : volume;
      if (!covered && special_[dense(cell)] != 0 && volume != open_of(target_, cell)) {
        e_.pockets.push_back({cell, volume});
      }
      settle_round_off(r, i);
      compute_owner(b_, r, {i, i + 1});
    }
  }

  /// The largest fraction makes the sum one.
  void settle_round_off(int r, int i) {
    double sum = 0, most = 0;
    MaterialSlot* largest = nullptr;
    for (MaterialSlot& slot : b_.materials) {
      const double f = std::as_const(slot.store).row(field::fraction, r)[i];
      sum += f;
      if (f > most) {
        most = f;
        largest = &slot;
      }
    }
    if (largest != nullptr) {
      largest->store.row(field::fraction, r)[i] += 1 - sum;
    }
  }

  void move_momentum() {
    std::vector<std::size_t> nodes;
    std::vector<int> row, index;
    std::vector<int> of(static_cast<std::size_t>(g_.node_pitch()) * static_cast<std::size_t>(g_.node_rows()), -1);
    std::vector<std::array<double, Dim>> momentum, least, most; // of the velocities that meet at a node
    std::vector<std::array<int, 3>> home;                      // a cell that has it as a corner
    const auto corner = [&](std::size_t c, int bits) {
      std::array<int, 3> n = cells_[c];
      for (std::size_t a = 0; a < Dim; ++a) {
        n[a] += bits >> a & 1;
      }
      const int r = g_.node_row(n[1], n[2]);
      int& at_node = of[node_at(g_, r, n[0])];
      if (at_node < 0) {
        at_node = static_cast<int>(momentum.size());
        row.push_back(r);
        index.push_back(n[0]);
        std::array<double, Dim> p{};
        for (std::size_t d = 0; d < Dim; ++d) {
          p[d] = b_.node_mass.row(r)[n[0]] * b_.velocity[d].row(r)[n[0]];
        }
        momentum.push_back(p);
        std::array<double, Dim> u{};
        for (std::size_t d = 0; d < Dim; ++d) {
          u[d] = b_.velocity[d].row(r)[n[0]];
        }
        const bool held = b_.node_mass.row(r)[n[0]] > 0; // what holds nothing has no velocity of its own
        least.push_back(u);
        most.push_back(u);
        if (!held) {
          least.back().fill(std::numeric_limits<double>::infinity());
          most.back().fill(-std::numeric_limits<double>::infinity());
        }
        home.push_back(cells_[c]);
      }
      return static_cast<std::size_t>(at_node);
    };
    for (const Transfer& t : transfer_) {
      const auto from = static_cast<std::size_t>(t.from), to = static_cast<std::size_t>(t.to);
      for (int bits = 0; bits < (1 << Dim); ++bits) {
        const std::size_t a = corner(from, bits), z = corner(to, bits);
        const double leaves = t.mass * corner_share(b_, bits, cells_[from][0], cells_[from][1], cells_[from][2]);
        for (std::size_t d = 0; d < Dim; ++d) {
          const double u = b_.velocity[d].row(row[a])[index[a]], p = leaves * u;
          momentum[a][d] -= p;
          momentum[z][d] += p;
          least[z][d] = std::min(least[z][d], u);
          most[z][d] = std::max(most[z][d], u);
        }
      }
    }
    double before = 0, after = 0;
    std::vector<double> mass(momentum.size());
    for (std::size_t n = 0; n < momentum.size(); ++n) {
      for (std::size_t d = 0; d < Dim; ++d) {
        const double u = b_.velocity[d].row(row[n])[index[n]];
        before += 0.5 * b_.node_mass.row(row[n])[index[n]] * u * u;
      }
      mass[n] = b_.node_mass.row(row[n])[index[n]];
    }
    compute_node_mass(b_, *scene_.pool);
    // A node that more passes through than stays may be left with a speed that nothing there had: what is too much of its
    // momentum goes to the heaviest node of a cell it belongs to.
    for (std::size_t n = 0; n < momentum.size(); ++n) {
      const double m = b_.node_mass.row(row[n])[index[n]];
      std::size_t heaviest = n;
      double weight = m;
      for (int bits = 0; bits < (1 << Dim); ++bits) {
        std::array<int, 3> other = home[n];
        for (std::size_t a = 0; a < Dim; ++a) {
          other[a] += bits >> a & 1;
        }
        const int r = g_.node_row(other[1], other[2]), at_node = of[node_at(g_, r, other[0])];
        if (at_node >= 0 && b_.node_mass.row(r)[other[0]] > weight) {
          heaviest = static_cast<std::size_t>(at_node);
          weight = b_.node_mass.row(r)[other[0]];
        }
      }
      for (std::size_t d = 0; d < Dim && heaviest != n; ++d) {
        const double u = m > 0 ? momentum[n][d] / m : 0.0;
        const double kept = m > 0 && least[n][d] <= most[n][d] ? m * std::clamp(u, least[n][d], most[n][d]) : 0.0;
        momentum[heaviest][d] += momentum[n][d] - kept;
        momentum[n][d] = kept;
      }
    }
    for (std::size_t n = 0; n < momentum.size(); ++n) {
      const double m = b_.node_mass.row(row[n])[index[n]];
      for (std::size_t d = 0; d < Dim; ++d) {
        double& u = b_.velocity[d].row(row[n])[index[n]];
        u += m > 0 ? (momentum[n][d] - m * u) / m : 0.0;
        after += 0.5 * m * u * u;
      }
    }
    scene_.ledger.remap_kinetic_loss += before - after;
  }

  Scene<Dim>& scene_;
  Embedding<Dim>& e_;
  Block<Dim>& b_;
  const Grid& g_;
  remap::Mesh<Dim>* mesh_;
  const remap::Settings settings_;
  long order_;
  std::vector<int> offset_;
  int size_ = 0;

  std::array<std::array<RowField, Dim>, Dim + 1> path_;
  std::array<Levels<Dim>, Dim + 1> levels_;
  Config lag_, target_;
  std::vector<char> special_;
  std::vector<int> place_;
  std::vector<std::array<int, 3>> cells_;
  std::vector<Contents> contents_, pool_;
  std::vector<char> pooled_;
  std::vector<double> from_volume_, to_volume_, swept_, mass_before_;
  std::vector<int> root_, next_root_;
  std::vector<Transfer> transfer_;
};

template <int Dim> double EmbeddedRemap<Dim>::crossing(int axis, const std::array<int, 3>& above) const {
  const auto nodes = face_nodes<Dim>(axis, above);
  double sum = 0;
  for (std::size_t leg = 0; leg < Dim; ++leg) {
    SweptFace<Dim> f{};
    int side = open_side<Dim>(g_, levels_[leg], nodes);
    side = side >= 0 ? side : open_side<Dim>(g_, levels_[leg + 1], nodes);
    for (std::size_t q = 0; q < nodes.size(); ++q) {
      const int r = g_.node_row(nodes[q][1], nodes[q][2]), i = nodes[q][0];
      for (std::size_t d = 0; d < Dim; ++d) {
        f.before[q][d] = path_[leg][d].row(r)[i];
        f.after[q][d] = path_[leg + 1][d].row(r)[i];
      }
      f.level_before[q] = level_on<Dim>(g_, levels_[leg], nodes[q], side);
      f.level_after[q] = level_on<Dim>(g_, levels_[leg + 1], nodes[q], side);
    }
    sum += open_swept<Dim>(f, b_.axisymmetric);
  }
  return Dim == 2 && axis == 1 ? sum : -sum; // the face sweeps one way, what is there goes the other; 2D faces turn by axis
}

} // namespace

template <int Dim> void remap_embedded(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& b, remap::Mesh<Dim>& mesh, const remap::Settings& settings, long order) {
  EmbeddedRemap<Dim> pass(scene, e, b, &mesh, settings, order);
  pass.run();
  mesh.closed = &e.closed;
}

template <int Dim> void pool_embedded(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& b) {
  EmbeddedRemap<Dim>(scene, e, b, nullptr, {}, 0).pool();
}

template <int Dim> void restore_open_volumes(Scene<Dim>& scene, Embedding<Dim>& e, Block<Dim>& b) {
  e.now = find_levels<Dim>(b.grid, b.position, bodies_of(scene, e), &e.now);
  find_cells<Dim>(b, b.position, e.now, e.kind, e.cut);
  for (const CutCell<Dim>& c : e.cut) {
    b.volume.row(c.row)[c.cell[0]] = open_volume(level_cell<Dim>(b.grid, b.position, e.now, c.cell), b.axisymmetric);
  }
  for (const Pocket& p : e.pockets) {
    b.volume.row(b.grid.cell_row(p.cell[1], p.cell[2]))[p.cell[0]] = p.volume;
  }
}

template void remap_embedded<2>(Scene<2>&, Embedding<2>&, Block<2>&, remap::Mesh<2>&, const remap::Settings&, long);
template void remap_embedded<3>(Scene<3>&, Embedding<3>&, Block<3>&, remap::Mesh<3>&, const remap::Settings&, long);
template void pool_embedded<2>(Scene<2>&, Embedding<2>&, Block<2>&);
template void pool_embedded<3>(Scene<3>&, Embedding<3>&, Block<3>&);
template void restore_open_volumes<2>(Scene<2>&, Embedding<2>&, Block<2>&);
template void restore_open_volumes<3>(Scene<3>&, Embedding<3>&, Block<3>&);

} // namespace ballast
