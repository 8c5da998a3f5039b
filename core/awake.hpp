// Awake: which cells of a block a step has to look at. All others rest, and a step would leave them as they are, bit
// for bit: they sleep.
//
// A cell is restless when a step may change it or what is beside it (ale/rest says which do). By each row the awake
// cells are one run: the hull of what is restless within `reach` cells, widened to tiles of `tile` cells. The reach
// holds all that a step brings about: the Lagrangian step moves the nodes of restless cells, the remap changes cells
// and nodes within two cells of them, closing voids looks three further on than fractions change, one.
// Cells fall asleep only when they were at rest for the whole of the step (with remaps: since before the last remap but
// one), so that every array that is held twice has the same in both copies.
// Tiles of eight keep the order in which lane_sum adds; what a sleeping cell would add to any sum is zero.
#pragma once

#include "core/grid.hpp"
#include "core/threads.hpp"

#include <algorithm>
#include <vector>

namespace ballast {

/// Cells, nodes or faces [begin, end) of a row.
struct Span {
  int begin = 0, end = 0;

  bool empty() const { return end <= begin; }
  int count() const { return end - begin; }
  bool holds(const Span& s) const { return s.empty() || (begin <= s.begin && s.end <= end); }
  bool operator==(const Span&) const = default;
};

/// The smallest run that holds both.
inline Span hull(const Span& a, const Span& b) {
  if (a.empty() || b.empty()) {
    return a.empty() ? b : a;
  }
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

class Awake {
public:
  static constexpr int reach = 4, tile = 8;

  Awake() = default;
  /// Everything awake.
  explicit Awake(const Grid& grid);

  /// By row number of the grid. Ghost rows are as the rows they mirror, ghost nodes rows as the edge's.
  const Span& cells(int row) const { return cells_[static_cast<std::size_t>(row)]; }
  /// Nodes of the awake cells around the row of nodes.
  const Span& nodes(int row) const { return nodes_[static_cast<std::size_t>(row)]; }

  /// Takes the restless cells found in each row, ghost rows' entries ignored. `remapped`: since the last call, or the
  /// block never is.
  void follow(const Grid& grid, std::vector<Span> restless, bool remapped);

  /// Share of the block's cells that are awake.
  double share() const { return share_; }
  /// Weighs the slabs for the cut. `mixed`: mixed awake cells of each slab, which cost more than pure ones.
  void weigh(const Grid& grid, const std::vector<int>& mixed);
  /// Slab at which part `part` of `parts` begins so that each part costs as much.
  int cut(int part, int parts) const;

private:
  void set(const Grid& grid, const std::vector<Span>& restless);

  std::vector<Span> cells_, nodes_;
  std::vector<Span> recent_, older_; ///< restless since the last remap, and from the one before to it
  std::vector<long> before_;         ///< what the slabs below cost, in pure cells
  double share_ = 1;
};

/// Calls body(begin, end, thread) on contiguous parts of [0, count), slabs or the planes of nodes around them, one a
/// thread, each of the same cost. Without `awake`: parts of equal length.
template <class Body> void parallel_awake(ThreadPool& pool, const Awake* awake, int count, Body&& body) {
  if (awake == nullptr) {
    parallel_ranges(pool, count, body);
    return;
  }
  const int threads = pool.size();
  pool.run([&](int t) {
    const int begin = t == 0 ? 0 : awake->cut(t, threads), end = t + 1 == threads ? count : awake->cut(t + 1, threads);
    if (begin < end) {
      body(begin, end, t);
    }
  });
}

} // namespace ballast
