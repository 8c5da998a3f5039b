#include "ale/embed/outline.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

using Point = std::array<double, 2>;

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Levels of the first and the last element left of a column, first above last: none.
struct Column {
  int first = 0, last = -1;
  bool empty() const { return first > last; }
};

/// Room (m) that a column's node lacks to `least`, shared between its lower and upper faces: where it has lost elements, since
/// that room was covered before, else below.
struct Padding {
  double below = 0, above = 0;
};
Padding padding(double least, double left, double lost_below, double lost_above) {
  const double need = std::max(0.0, least - left), lost = lost_below + lost_above;
  const double share = lost > 0 ? lost_below / lost : 1.0;
  return {need * share, need * (1 - share)};
}

/// A point on a plane of nodes, on segment `segment` at `part` of it.
struct OnPlane {
  int segment = -1; ///< none
  double part = 0, gap = 0;
};

/// Nodes of one layer that make a stretch of a face.
struct Run {
  int layer, column, first, last; ///< column: one it belongs to
};

class OutlineBuilder {
public:
  OutlineBuilder(const LayerStack<2>& s, const std::vector<char>& alive, const std::vector<double>& least) : s_(s), alive_(alive), least_(least) {
    for (int i = 0; i < s.grid.elements[0]; ++i) {
      Column c{s.grid.levels(), -1};
      for (int level = 0; level < s.grid.levels(); ++level) {
        if (alive[s.element(i, 0, level)] != 0) {
          c.first = std::min(c.first, level);
          c.last = level;
        }
      }
      columns_.push_back(c);
    }
  }

  std::vector<Outline> run() {
    std::vector<Outline> out;
    const int n = s_.grid.elements[0];
    for (int begin = 0; begin < n;) {
      if (columns_[at(begin)].empty()) {
        ++begin;
        continue;
      }
      int end = begin;
      while (end < n && !columns_[at(end)].empty()) {
        ++end;
      }
      const bool on_low = begin == 0 && s_.edge[0][0] != LayerEdge::free, on_high = end == n && s_.edge[0][1] != LayerEdge::free;
      out.push_back({chain(begin, end, true, on_low, on_high), chain(begin, end, false, true, true), on_low, on_high, {}});
      for (int layer = 0; layer + 1 < s_.grid.layers; ++layer) {
        find_gaps(begin, end, layer, out.back().gaps);
      }
      clefts_.clear();
      begin = end;
    }
    return out;
  }

private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int through() const { return s_.grid.through; }
  /// The layer's plane of nodes on the chain's side of it, or on the other.
  int plane(int layer, bool low) const { return layer * (through() + 1) + (low ? 0 : through()); }
  bool there(int layer, int i) const { return i >= 0 && i < s_.grid.elements[0] && alive_[s_.element(i, 0, layer * through())] != 0; }
  Point place(int i, int plane) const {
    const std::size_t n = s_.node(i, 0, plane);
    return {s_.position[0][n], s_.position[1][n]};
  }

  /// Room added to a column's face at its node i.
  double pad(int i, const Column& c, bool lower) const {
    const std::size_t first = s_.node(i, 0, s_.plane_below(c.first)), last = s_.node(i, 0, s_.plane_below(c.last) + 1);
    const double low = s_.rest[1][first], high = s_.rest[1][last];
    const double now = distance(place(i, s_.plane_below(c.first)), place(i, s_.plane_below(c.last) + 1));
    const Padding p = padding(least_[at(i)], std::min(high - low, now), low - s_.levels.front(), s_.levels.back() - high);
    return lower ? p.below : p.above;
  }
  /// Room added to either side of a layer that stands alone.
  double pad_alone(int layer, int i) const { return 0.5 * std::max(0.0, least_[at(i)] - distance(place(i, plane(layer, true)), place(i, plane(layer, false)))); }

  OutlineVertex vertex(int i, int plane, double offset, int side) const {
    const std::size_t n = s_.node(i, 0, plane);
    return {{n, n}, {1, 0}, {s_.position[0][n], s_.position[1][n]}, offset, side};
  }
  OutlineVertex between(int i, double part, int plane, double offset, int side) const {
    const Point a = place(i, plane), b = place(i + 1, plane);
    return {{s_.node(i, 0, plane), s_.node(i + 1, 0, plane)}, {1 - part, part}, {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])}, offset, side};
  }

  /// The point of a layer's plane nearest to x, from segment `start` on; what is left of it only.
  OnPlane nearest(int layer, int plane, const Point& x, int start) const {
    const auto on = [&](int i) {
      const Point a = place(i, plane), b = place(i + 1, plane), along = {b[0] - a[0], b[1] - a[1]}, off = {x[0] - a[0], x[1] - a[1]};
      const double length = along[0] * along[0] + along[1] * along[1];
      const double t = length > 0 ? std::clamp((off[0] * along[0] + off[1] * along[1]) / length, 0.0, 1.0) : 0.0;
      return OnPlane{i, t, std::hypot(off[0] - t * along[0], off[1] - t * along[1])};
    };
    const int n = s_.grid.elements[0];
    int from = -1;
    for (int off = 0; off < n && from < 0; ++off) {
      from = there(layer, start + off) ? start + off : there(layer, start - off) ? start - off : -1;
    }
    if (from < 0) {
      return {};
    }
    OnPlane best = on(from);
    for (const int step : {-1, 1}) { // over holes, too
      for (int i = from + step; i >= 0 && i < n; i += step) {
        const OnPlane next = there(layer, i) ? on(i) : best;
        if (next.gap > best.gap) {
          break;
        }
        best = next;
      }
    }
    return best;
  }

  /// Where the outer layer's edge at node k meets the inner layer.
  struct Junction {
    int edge = 0;
    OnPlane inner;
    double out = 0; ///< on the outer layer's other face: as node plus part, from k on
    bool parted = false;
  };
  Junction meet(int outer, int inner, int k, bool outer_is_right, bool lower) const {
    const int other = plane(outer, !lower), face = plane(inner, lower), step = outer_is_right ? 1 : -1;
    Junction j;
    j.edge = k;
    j.out = k;
    j.inner = nearest(inner, face, place(k, other), outer_is_right ? k - 1 : k);
    if (j.inner.segment < 0 || j.inner.gap <= least_[at(k)]) {
      return j;
    }
    j.parted = true;
    double excess = j.inner.gap - least_[at(k)];
    // One element short of the outer layer's other end: a layer that has come off altogether hangs on there.
    for (int i = k; there(outer, outer_is_right ? i + 1 : i - 2); i += step) {
      const OnPlane next = nearest(inner, face, place(i + step, other), outer_is_right ? i : i - 1);
      if (next.segment < 0) {
        break;
      }
      const double there_excess = next.gap - least_[at(i + step)];
      const double part = there_excess <= 0 ? excess / (excess - there_excess) : 1.0;
      j.out = i + step * part;
      j.inner = part < 1 ? nearest(inner, face, point(j.out, other), next.segment) : next;
      excess = there_excess;
      if (there_excess <= 0) {
        break;
      }
    }
    return j;
  }
  Point point(double where, int plane) const {
    const int i = std::min(static_cast<int>(where), s_.grid.elements[0] - 1);
    return between(i, where - i, plane, 0, 0).x;
  }

  /// One face of the columns from begin to end, and at a rim the edges of the layers one over the other, if it is no end that goes on.
  std::vector<OutlineVertex> chain(int begin, int end, bool lower, bool on_low, bool on_high) {
    const int side = lower ? 0 : 1;
    // Runs of columns of one layer, and of no width where layers end over each other.
    std::vector<Run> runs;
    std::vector<int> edges;
    for (int q = columns_[at(begin)].last / through(); !on_low && q > columns_[at(begin)].first / through(); --q) {
      if (there(q, begin)) {
        runs.push_back({q, begin, begin, begin});
        edges.resize(runs.size() - 1, begin);
      }
    }
    for (int i = begin; i < end; ++i) {
      const Column& c = columns_[at(i)];
      const int layer = (lower ? c.first : c.last) / through();
      if (runs.empty() || runs.back().layer != layer) {
        if (!runs.empty()) {
          const int from = runs.back().layer, step = layer > from ? 1 : -1, column = (layer > from) == lower ? i - 1 : i; // the outer one's
          for (int q = from + step; q != layer; q += step) {
            if (there(q, column)) {
              runs.push_back({q, column, i, i});
              edges.push_back(i);
            }
          }
          edges.push_back(i);
        }
        runs.push_back({layer, i, i, i});
      }
      runs.back().last = i + 1;
    }
    for (int q = columns_[at(end - 1)].first / through() + 1; !on_high && q <= columns_[at(end - 1)].last / through(); ++q) {
      if (there(q, end - 1)) {
        runs.push_back({q, end - 1, end, end});
        edges.push_back(end);
      }
    }
    std::vector<Junction> junctions;
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
      Run &left = runs[r], &right = runs[r + 1];
      const bool outer_is_right = lower ? left.layer > right.layer : left.layer < right.layer;
      const Run &outer = outer_is_right ? right : left, &inner = outer_is_right ? left : right;
      junctions.push_back(meet(outer.layer, inner.layer, edges[r], outer_is_right, lower));
      Junction& j = junctions.back();
      const auto same = [&](const Cleft& c) { return c.layer == std::min(outer.layer, inner.layer) && c.from <= std::max<double>(j.edge, j.out) && std::min<double>(j.edge, j.out) <= c.to; };
      if (j.parted && std::any_of(clefts_.begin(), clefts_.end(), same)) { // come off from one hole to the next
        j.parted = false;
        j.out = j.edge;
        j.inner = nearest(inner.layer, plane(inner.layer, lower), place(j.edge, plane(outer.layer, !lower)), outer_is_right ? j.edge - 1 : j.edge);
      }
      if (junctions.back().parted) {
        clefts_.push_back({std::min(outer.layer, inner.layer), std::min<double>(edges[r], junctions.back().out), std::max<double>(edges[r], junctions.back().out)});
      }
      const OnPlane& on = junctions.back().inner;
      if (on.segment >= 0) {
        (outer_is_right ? left.last : right.first) = outer_is_right ? on.segment : on.segment + 1;
      }
    }
    std::vector<OutlineVertex> out;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const Run& run = runs[r];
      // Nodes over a gap belong to a flap.
      const int flap_low = r > 0 && junctions[r - 1].parted && junctions[r - 1].out > junctions[r - 1].edge ? static_cast<int>(std::ceil(junctions[r - 1].out)) : -1;
      const int flap_high = r < junctions.size() && junctions[r].parted && junctions[r].out < junctions[r].edge ? static_cast<int>(junctions[r].out) : s_.grid.elements[0] + 1;
      for (int i = run.first; i <= run.last; ++i) {
        const bool flap = i < flap_low || i > flap_high;
        out.push_back(vertex(i, plane(run.layer, lower), flap ? pad_alone(run.layer, i) : pad(i, columns_[at(run.column)], lower), side));
      }
      if (r < junctions.size()) {
        join(run, runs[r + 1], junctions[r], lower, out);
      }
    }
    return out;
  }

  /// How much wider than the mesh sees is the gap over a layer's node?
  double gap_over(int layer, int i) const {
    const OnPlane on = nearest(layer + 1, plane(layer + 1, true), place(i, plane(layer, false)), i);
    const bool stands = std::min(rest_thickness(layer, i), rest_thickness(layer + 1, i)) > least_[at(i)]; // else a cell may see both sides of a layer
    return on.segment < 0 || !stands ? -least_[at(i)] : on.gap - least_[at(i)];
  }
  double rest_thickness(int layer, int i) const { return s_.rest[1][s_.node(i, 0, plane(layer, false))] - s_.rest[1][s_.node(i, 0, plane(layer, true))]; }
  /// Where a layer and the next have parted, away from holes: closed outlines, along the upper layer's lower face and back along the lower one's upper face.
  void find_gaps(int begin, int end, int layer, std::vector<std::vector<OutlineVertex>>& out) const {
    for (int i = begin; i < end;) {
      int last = i; // of this stretch of both layers
      while (last < end && there(layer, last) && there(layer + 1, last)) {
        ++last;
      }
      for (int a = i + 1; a < last; ++a) {
        if (!(gap_over(layer, a) > 0)) {
          continue;
        }
        int b = a;
        while (b + 1 < last && gap_over(layer, b + 1) > 0) {
          ++b;
        }
        const double ga = gap_over(layer, a), gb = gap_over(layer, b), before = gap_over(layer, a - 1), after = gap_over(layer, b + 1);
        const double from = before > 0 ? a - 1.0 : a - ga / (ga - before), to = after > 0 ? b + 1.0 : b + gb / (gb - after);
        const bool known = std::any_of(clefts_.begin(), clefts_.end(), [&](const Cleft& c) { return c.layer == layer && c.from <= to && from <= c.to; });
        if (std::vector<OutlineVertex> loop = known ? std::vector<OutlineVertex>{} : gap_outline(layer, from, to); !loop.empty()) {
          out.push_back(std::move(loop));
        }
        a = b + 1;
      }
      i = std::max(last, i + 1);
    }
  }
  std::vector<OutlineVertex> gap_outline(int layer, double from, double to) const {
    const int face = plane(layer, false), other = plane(layer + 1, true);
    const OnPlane low = nearest(layer + 1, other, point(from, face), static_cast<int>(from)), high = nearest(layer + 1, other, point(to, face), static_cast<int>(to));
    if (low.segment < 0 || high.segment < low.segment) {
      return {};
    }
    std::vector<OutlineVertex> loop = {between(low.segment, low.part, other, 0, 0)};
    for (int i = low.segment + 1; i <= high.segment; ++i) {
      loop.push_back(vertex(i, other, 0, 0));
    }
    loop.push_back(between(high.segment, high.part, other, 0, 0));
    const int last = std::min(static_cast<int>(to), s_.grid.elements[0] - 1), first = static_cast<int>(from);
    loop.push_back(between(last, to - last, face, 0, 1));
    for (int i = static_cast<int>(std::ceil(to)) - 1; i > from; --i) {
      loop.push_back(vertex(i, face, 0, 1));
    }
    loop.push_back(between(first, from - first, face, 0, 0));
    return loop;
  }

  /// What lies between two runs, left to right.
  void join(const Run& left, const Run& right, const Junction& j, bool lower, std::vector<OutlineVertex>& out) const {
    const int side = lower ? 0 : 1, k = j.edge;
    const bool outer_is_right = lower ? left.layer > right.layer : left.layer < right.layer;
    const Run &outer = outer_is_right ? right : left, &inner = outer_is_right ? left : right;
    const int other = plane(outer.layer, !lower);
    std::vector<OutlineVertex> way; // from the inner layer to the outer one's edge
    if (j.inner.segment >= 0) {
      const int near = outer_is_right ? j.inner.segment : j.inner.segment + 1;
      way.push_back(between(j.inner.segment, j.inner.part, plane(inner.layer, lower), pad(near, columns_[at(inner.column)], lower), side));
    }
    if (j.parted) {
      const int last = std::min(static_cast<int>(j.out), s_.grid.elements[0] - 1);
      way.push_back(between(last, j.out - last, other, 0, side));
      const int step = outer_is_right ? -1 : 1;
      for (int i = outer_is_right ? static_cast<int>(std::ceil(j.out)) - 1 : static_cast<int>(std::floor(j.out)) + 1; (outer_is_right ? i >= k : i <= k); i += step) {
        way.push_back(vertex(i, other, pad_alone(outer.layer, i), side));
      }
    } else {
      way.push_back(vertex(k, other, pad(k, columns_[at(outer.column)], lower), side));
    }
    // Back along the gap on the outer layer's other side: `side` belongs to the face on to the next vertex from left to right.
    const std::size_t first = j.inner.segment >= 0 ? 1 : 0;
    for (std::size_t q = first; j.parted && q + 1 < way.size(); ++q) {
      way[outer_is_right ? q : q + 1].side = 1 - side;
    }
    if (!outer_is_right) {
      std::reverse(way.begin(), way.end());
    }
    out.insert(out.end(), way.begin(), way.end());
  }

  /// A gap between a layer and the next that an outline already follows, by nodes.
  struct Cleft {
    int layer;
    double from, to;
  };

  const LayerStack<2>& s_;
  const std::vector<char>& alive_;
  const std::vector<double>& least_;
  std::vector<Column> columns_;
  std::vector<Cleft> clefts_;
};

} // namespace

std::vector<Outline> find_outlines(const LayerStack<2>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness) {
  return OutlineBuilder(stack, alive, least_thickness).run();
}

} // namespace ballast
