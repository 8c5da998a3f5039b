#include "ale/embed/outline.hpp"

#include "ale/embed/padding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

using Point = std::array<double, 2>;

constexpr double apart = std::numeric_limits<double>::infinity();

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }
double distance(const Point& a, const Point& b) { return length_of(a[0] - b[0], a[1] - b[1]); }

/// A point on a plane of nodes, on segment `segment` at `part` of it.
struct OnPlane {
  int segment = -1; ///< none
  double part = 0, gap = 0;
  bool behind = false; ///< in the layer that the plane bounds
  bool at_end = false; ///< where the layer's run ends
  bool beyond = false; ///< past the end of the layer's run: nothing is over the point
};

class OutlineBuilder {
public:
  OutlineBuilder(const LayerStack<2>& s, const std::vector<char>& alive, const std::vector<double>& least, const std::vector<double>& own)
      : s_(s), alive_(alive), least_(least), own_(own.empty() ? least : own) {
    const int layers = s.grid.layers, nodes = s.grid.elements[0] + 1;
    for (auto& gap : gap_) {
      gap.assign(static_cast<std::size_t>(layers * nodes), apart);
    }
    ends_.resize(at(layers));
    for (int layer = 0; layer < layers; ++layer) {
      for (int i = 0; i < nodes; ++i) {
        if (ends(layer, i)) {
          ends_[at(layer)].push_back(i);
        }
        for (const bool low : {true, false}) {
          if (there(layer, i - 1) || there(layer, i)) {
            gap_at(layer, i, low) = gap_to_next(layer, low, place(i, plane(layer, low)), i);
          }
        }
      }
    }
  }

  std::vector<Outline> run() const {
    std::vector<Outline> out;
    const int n = s_.grid.elements[0];
    for (int layer = 0; layer < s_.grid.layers; ++layer) {
      const std::array<std::vector<std::vector<double>>, 2> over = {ends_over(layer, true), ends_over(layer, false)};
      for (int begin = 0; begin < n;) {
        int end = begin;
        while (there(layer, end)) {
          ++end;
        }
        if (end > begin) {
          out.push_back(loop(layer, begin, end, over));
        }
        begin = std::max(end, begin + 1);
      }
    }
    return out;
  }

private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  int through() const { return s_.grid.through; }
  /// The layer's lower plane of nodes, or its upper one.
  int plane(int layer, bool low) const { return layer * (through() + 1) + (low ? 0 : through()); }
  bool there(int layer, int i) const { return i >= 0 && i < s_.grid.elements[0] && alive_[s_.element(i, 0, layer * through())] != 0; }
  /// Does one of the layer's runs end at node i, so that there is nothing beyond?
  bool ends(int layer, int i) const {
    const int n = s_.grid.elements[0];
    const bool held = (i == 0 && s_.edge[0][0] != LayerEdge::free) || (i == n && s_.edge[0][1] != LayerEdge::free);
    return !held && there(layer, i - 1) != there(layer, i);
  }
  Point place(int i, int plane) const {
    const std::size_t n = s_.node(i, 0, plane);
    return {s_.position[0][n], s_.position[1][n]};
  }
  double& gap_at(int layer, int i, bool low) { return gap_[low ? 0 : 1][at(layer * (s_.grid.elements[0] + 1) + i)]; }
  double gap_at(int layer, int i, bool low) const { return gap_[low ? 0 : 1][at(layer * (s_.grid.elements[0] + 1) + i)]; }
  bool hidden_at(int layer, int i, bool low) const { return gap_at(layer, i, low) <= seen_slit * least_[at(i)]; }

  /// The point of a layer's plane nearest to x, searched from segment `start` on.
  OnPlane nearest(int layer, int plane, const Point& x, int start) const {
    constexpr double rounding = 1e-9, close = 1e-6;
    const int n = s_.grid.elements[0];
    const auto on = [&](int i) {
      const Point a = place(i, plane), b = place(i + 1, plane), along = {b[0] - a[0], b[1] - a[1]}, off = {x[0] - a[0], x[1] - a[1]};
      const double length = along[0] * along[0] + along[1] * along[1];
      const double where = length > 0 ? (off[0] * along[0] + off[1] * along[1]) / length : 0.0, t = std::clamp(where, 0.0, 1.0);
      const auto past = [&](double by) { return (where < -by && ends(layer, i)) || (where > 1 + by && ends(layer, i + 1)); };
      return OnPlane{i, t, length_of(off[0] - t * along[0], off[1] - t * along[1]), false, past(-close), past(rounding)};
    };
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
    best.behind = lies_behind(layer, plane, best.segment, best.part, x);
    return best;
  }

  /// Is x in the layer whose face is at part t of segment i nearest to it? At a node the two segments' normals count together.
  bool lies_behind(int layer, int plane, int i, double t, const Point& x) const {
    const bool low = plane == this->plane(layer, true);
    const int other = this->plane(layer, !low), beside = t == 0 ? i - 1 : t == 1 ? i + 1 : i;
    const auto along = [&](int k) {
      const Point a = place(k, plane), b = place(k + 1, plane);
      const double length = distance(a, b);
      return length > 0 ? Point{(b[0] - a[0]) / length, (b[1] - a[1]) / length} : Point{0, 0};
    };
    const auto on = [&](int p) {
      const Point a = place(i, p), b = place(i + 1, p);
      return Point{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
    };
    Point way = along(i);
    if (beside != i && there(layer, beside)) {
      const Point more = along(beside);
      way = {way[0] + more[0], way[1] + more[1]};
    }
    const Point foot = on(plane), off = {x[0] - foot[0], x[1] - foot[1]};
    const double above = way[0] * off[1] - way[1] * off[0];
    return (low ? above > 0 : above < 0) && length_of(off[0], off[1]) < distance(foot, on(other));
  }

  /// From a point on a layer's face to the nearest layer that lies over it on that side, negative where it lies in that; `apart` if none does.
  double gap_to_next(int layer, bool low, const Point& x, int start) const {
    double gap = apart;
    const double enough = seen_slit * least_[at(std::min(start, s_.grid.elements[0]))];
    for (int q = low ? layer - 1 : layer + 1; q >= 0 && q < s_.grid.layers && gap > enough; q += low ? -1 : 1) {
      const OnPlane on = nearest(q, plane(q, !low), x, start);
      gap = on.segment < 0 || on.beyond ? gap : std::min(gap, on.behind ? -on.gap : on.gap);
    }
    return gap;
  }

  /// Room added to a layer's face at node i: by what holds together there.
  double pad(int layer, int i, bool low) const {
    int first = layer, last = layer;
    const auto near = [&](int q) { return there(q, i - 1) || there(q, i); };
    while (low && hidden_at(last, i, false) && last + 1 < s_.grid.layers && near(last + 1)) {
      ++last;
    }
    while (!low && hidden_at(first, i, true) && first > 0 && near(first - 1)) {
      --first;
    }
    const std::size_t bottom = s_.node(i, 0, plane(first, true)), top = s_.node(i, 0, plane(last, false));
    const double below = s_.rest[1][bottom], above = s_.rest[1][top], now = distance(place(i, plane(first, true)), place(i, plane(last, false)));
    const Padding p = padding(own_[at(i)], std::min(above - below, now), below - s_.levels.front(), s_.levels.back() - above);
    return low ? p.below : p.above;
  }

  OutlineVertex vertex(int layer, int i, bool low) const {
    const std::size_t n = s_.node(i, 0, plane(layer, low));
    return {{n, n}, {1, 0}, {s_.position[0][n], s_.position[1][n]}, pad(layer, i, low), low ? 0 : 1, false};
  }
  OutlineVertex between(int layer, int i, double part, bool low) const {
    const OutlineVertex a = vertex(layer, i, low), b = vertex(layer, i + 1, low);
    return {{a.node[0], b.node[0]}, {1 - part, part}, {a.x[0] + part * (b.x[0] - a.x[0]), a.x[1] + part * (b.x[1] - a.x[1])},
            a.offset + part * (b.offset - a.offset), a.side, false};
  }

  /// The end x of another layer, its node k, where it lies on a layer's face. Where layers have slid far or lie folded the way down from k may stop short.
  void add_end(int layer, bool low, const Point& x, int k, std::vector<std::vector<double>>& parts) const {
    const int n = s_.grid.elements[0];
    const auto add = [&](int start) {
      const OnPlane on = nearest(layer, plane(layer, low), x, start);
      const bool there = on.segment >= 0 && (on.behind || on.gap <= seen_slit * least_[at(on.segment)]);
      if (there) {
        parts[at(on.segment)].push_back(on.part);
      }
      return there;
    };
    constexpr int apart_from_k = 4;
    bool found = add(std::min(k, n - 1));
    for (int i = apart_from_k / 2; i < n && !found; i += apart_from_k) {
      found = add(i);
    }
  }

  /// Where a layer's face goes under another layer or comes out because that ends: by segment, as parts of it.
  std::vector<std::vector<double>> ends_over(int layer, bool low) const {
    std::vector<std::vector<double>> parts(at(s_.grid.elements[0]));
    for (int q = low ? layer - 1 : layer + 1; q >= 0 && q < s_.grid.layers; q += low ? -1 : 1) {
      for (const int k : ends_[at(q)]) {
        add_end(layer, low, place(k, plane(q, !low)), k, parts);
      }
    }
    return parts;
  }

  /// Where, as parts of segment i of a layer's face, it may go under another layer or come out: where that layer ends (`parts`), or the slit is as
  /// wide as the mesh sees.
  std::vector<double> breaks(int layer, int i, bool low, std::vector<double> parts) const {
    constexpr double least = 1e-6;
    const double a = gap_at(layer, i, low) - seen_slit * least_[at(i)], b = gap_at(layer, i + 1, low) - seen_slit * least_[at(i + 1)];
    if (a < apart && b < apart && (a > 0) != (b > 0)) {
      parts.push_back(a / (a - b));
    }
    std::sort(parts.begin(), parts.end());
    std::vector<double> out;
    for (const double part : parts) {
      if (part > least && part < 1 - least && (out.empty() || part - out.back() > least)) {
        out.push_back(part);
      }
    }
    return out;
  }

  /// Vertices of a layer's face from node `begin` to node `end`.
  std::vector<OutlineVertex> face(int layer, int begin, int end, bool low, const std::vector<std::vector<double>>& over) const {
    std::vector<OutlineVertex> out;
    for (int i = begin; i < end; ++i) {
      std::vector<double> ends = breaks(layer, i, low, over[at(i)]);
      ends.push_back(1);
      double from = 0;
      for (const double to : ends) {
        out.push_back(from > 0 ? between(layer, i, from, low) : vertex(layer, i, low));
        const Point a = place(i, plane(layer, low)), b = place(i + 1, plane(layer, low));
        const double part = 0.5 * (from + to);
        const Point middle = {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])};
        out.back().hidden = gap_to_next(layer, low, middle, i) <= seen_slit * 0.5 * (least_[at(i)] + least_[at(i + 1)]);
        from = to;
      }
    }
    out.push_back(vertex(layer, end, low));
    return out;
  }

  /// Does x, on layer's rim, lie in one of the layers below it (or above)? Not where that ends just there: both rims would be hidden.
  bool in_others(int layer, bool below, const Point& x, int start) const {
    bool in = false;
    for (int q = below ? layer - 1 : layer + 1; q >= 0 && q < s_.grid.layers && !in; q += below ? -1 : 1) {
      const OnPlane on = nearest(q, plane(q, !below), x, start);
      in = on.segment >= 0 && on.behind && !on.at_end;
    }
    return in;
  }
  /// Parts of a layer's rim at node i, from below, that lie in layers under it and over it: up to the first, from the second on.
  std::array<double, 2> covered_rim(int layer, int i) const {
    const Point a = place(i, plane(layer, true)), b = place(i, plane(layer, false));
    const auto covered = [&](bool low, double part) { return in_others(layer, low, {a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])}, i); };
    std::array<double, 2> out = {0, 1};
    for (const bool low : {true, false}) {
      double in = low ? 0 : 1, free = 1 - in;
      if (!(gap_at(layer, i, low) < 0) || !covered(low, in)) {
        continue;
      }
      if (covered(low, free)) { // all of it
        return {1, 1};
      }
      for (int halving = 0; halving < 20; ++halving) {
        const double middle = 0.5 * (in + free);
        (covered(low, middle) ? in : free) = middle;
      }
      out[low ? 0 : 1] = in;
    }
    return out;
  }
  /// The rest of a rim after its first vertex, which is `out`'s last: what lies in other layers is hidden.
  void add_rim(int layer, int i, bool upwards, Outline& out) const {
    const OutlineVertex a = vertex(layer, i, true), b = vertex(layer, i, false);
    const std::array<double, 2> covered = covered_rim(layer, i);
    const auto visible = [&](double part) { return part >= covered[0] && part < covered[1]; };
    out.back().hidden = !visible(upwards ? 0 : std::nextafter(1.0, 0.0));
    for (const double part : {upwards ? covered[0] : covered[1], upwards ? covered[1] : covered[0]}) {
      if (part > 0 && part < 1 && covered[0] < covered[1]) {
        OutlineVertex v = {{a.node[0], b.node[0]}, {1 - part, part}, {a.x[0] + part * (b.x[0] - a.x[0]), a.x[1] + part * (b.x[1] - a.x[1])}, a.offset + part * (b.offset - a.offset), 2, false};
        v.hidden = !visible(upwards ? part : std::nextafter(part, 0.0));
        out.push_back(v);
      }
    }
  }

  Outline loop(int layer, int begin, int end, const std::array<std::vector<std::vector<double>>, 2>& over) const {
    Outline out = face(layer, begin, end, true, over[0]), upper = face(layer, begin, end, false, over[1]);
    const int n = s_.grid.elements[0];
    const auto edge = [&](bool at_end, LayerEdge kind) { return !at_end || kind == LayerEdge::free ? 2 : kind == LayerEdge::symmetry ? -2 : -1; };
    out.back().side = edge(end == n, s_.edge[0][1]);
    if (out.back().side == 2) {
      add_rim(layer, end, true, out);
    }
    for (std::size_t k = upper.size(); k-- > 0;) { // a stretch belongs to the vertex it is left by, now the other way
      OutlineVertex v = upper[k];
      v.hidden = k > 0 && upper[k - 1].hidden;
      v.side = k > 0 ? 1 : edge(begin == 0, s_.edge[0][0]);
      out.push_back(v);
    }
    if (out.back().side == 2) {
      add_rim(layer, begin, false, out);
    }
    return out;
  }

  const LayerStack<2>& s_;
  const std::vector<char>& alive_;
  const std::vector<double>&least_, &own_;
  std::array<std::vector<double>, 2> gap_; ///< m: over nodes of lower and upper faces
  std::vector<std::vector<int>> ends_;     ///< by layer: nodes where its runs end
};

} // namespace

std::vector<Outline> find_outlines(const LayerStack<2>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, const std::vector<double>& own) {
  return OutlineBuilder(stack, alive, least_thickness, own).run();
}

} // namespace ballast
