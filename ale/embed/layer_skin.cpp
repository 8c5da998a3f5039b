#include "ale/embed/layer_skin.hpp"

#include "ale/embed/padding.hpp"
#include "ale/embed/points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

using Point = std::array<double, 3>;

constexpr double apart = std::numeric_limits<double>::infinity();
constexpr int cuts = 4; ///< of a quadrilateral that is hidden in part, along each side

struct Column {
  int i, j;
};
constexpr Column corner_of[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

class SkinBuilder {
public:
  SkinBuilder(const LayerStack<3>& s, const std::vector<char>& alive, const std::vector<double>& least, ThreadPool& pool, const std::vector<double>& own)
      : s_(s), alive_(alive), least_(least), own_(own.empty() ? least : own), pool_(pool), nx_(s.grid.elements[0]), ny_(s.grid.elements[1]) {}

  Skin run() {
    const auto faces = static_cast<std::size_t>(2 * s_.grid.layers), nodes = s_.node(0, 0, 1);
    skin_.vertices.resize(faces * nodes);
    gap_.assign(faces * nodes, apart);
    plain_.assign(faces * nodes, 0);
    across_.assign(faces * nodes, {0, 0, 0});
    std::vector<Part> parts(static_cast<std::size_t>(s_.grid.layers)); // vertices belong to one layer
    parallel_ranges(pool_, s_.grid.layers, [&](int begin, int end, int) {
      for (int layer = begin; layer < end; ++layer) {
        Part& part = parts[static_cast<std::size_t>(layer)];
        for_columns(layer, [&](Column c) { add_quads(layer, c, part); });
        add_normals(part);
      }
    });
    let_faces_go_on();
    for_node_rows([&](int layer, Column n, bool low) { find_gap(layer, n, low); });
    for_node_rows([&](int layer, Column n, bool low) { skin_.vertices[at(layer, n, low)].offset = pad(layer, n, low); });
    std::vector<Quad> whole;
    for (Part& part : parts) {
      whole.insert(whole.end(), part.begin(), part.end());
    }
    constexpr int run = 64;
    const int runs = (static_cast<int>(whole.size()) + run - 1) / run;
    std::vector<std::vector<SkinPatch>> cut(static_cast<std::size_t>(runs));
    parallel_turns(pool_, runs, [&](int n) {
      const std::size_t first = static_cast<std::size_t>(n) * run, last = std::min(first + run, whole.size());
      for (std::size_t q = first; q < last; ++q) {
        add_visible(whole[q], cut[static_cast<std::size_t>(n)]);
      }
    });
    for (const std::vector<SkinPatch>& some : cut) {
      skin_.patches.insert(skin_.patches.end(), some.begin(), some.end());
    }
    return std::move(skin_);
  }

private:
  struct Quad {
    SkinPatch patch;
    int layer;
    Column column;
  };
  using Part = std::vector<Quad>; ///< of a layer
  int plane(int layer, bool low) const { return layer * (s_.grid.through + 1) + (low ? 0 : s_.grid.through); }
  std::size_t at(int layer, Column n, bool low) const {
    return (static_cast<std::size_t>(2 * layer + (low ? 0 : 1)) * static_cast<std::size_t>(ny_ + 1) + static_cast<std::size_t>(n.j)) * static_cast<std::size_t>(nx_ + 1) + static_cast<std::size_t>(n.i);
  }
  std::size_t node(int layer, Column n, bool low) const { return s_.node(n.i, n.j, plane(layer, low)); }
  Point place(int layer, Column n, bool low) const {
    const std::size_t q = node(layer, n, low);
    return {s_.position[0][q], s_.position[1][q], s_.position[2][q]};
  }
  double least(Column n) const { return least_[static_cast<std::size_t>(n.j) * static_cast<std::size_t>(nx_ + 1) + static_cast<std::size_t>(n.i)]; }
  bool there(int layer, Column c) const {
    return c.i >= 0 && c.j >= 0 && c.i < nx_ && c.j < ny_ && alive_[s_.element(c.i, c.j, layer * s_.grid.through)] != 0;
  }
  /// Does the layer end between a column and its neighbour along an axis? Not where an edge is held: there it goes on.
  bool ends(int layer, Column c, int axis, int step) const {
    const Column to = {c.i + (axis == 0 ? step : 0), c.j + (axis == 0 ? 0 : step)};
    const int n = axis == 0 ? to.i : to.j, count = axis == 0 ? nx_ : ny_;
    if (n < 0 || n >= count) {
      return s_.edge[static_cast<std::size_t>(axis)][n < 0 ? 0 : 1] == LayerEdge::free;
    }
    return !there(layer, to);
  }

  /// Columns that are there.
  template <class Visit> void for_columns(int layer, Visit&& body) const {
    for (int j = 0; j < ny_; ++j) {
      for (int i = 0; i < nx_; ++i) {
        if (there(layer, {i, j})) {
          body(Column{i, j});
        }
      }
    }
  }
  /// Calls body(layer, node, low) for the nodes of what is there, in no order.
  template <class Visit> void for_node_rows(Visit&& body) const {
    parallel_turns(pool_, s_.grid.layers * (ny_ + 1), [&](int row) { // dear where layers are torn
      const int layer = row / (ny_ + 1), j = row % (ny_ + 1);
      for (int i = 0; i <= nx_; ++i) {
        if (there(layer, {i - 1, j - 1}) || there(layer, {i, j - 1}) || there(layer, {i - 1, j}) || there(layer, {i, j})) {
          body(layer, Column{i, j}, true);
          body(layer, Column{i, j}, false);
        }
      }
    });
  }

  struct Corner {
    Column n;
    bool low;
  };
  void add_quad(int layer, Column c, int side, const std::array<Corner, 4>& corners, Part& part) {
    SkinPatch p{};
    p.side = side;
    p.high = {1, 1};
    for (std::size_t q = 0; q < 4; ++q) {
      p.node[q] = node(layer, corners[q].n, corners[q].low);
      p.vertex[q] = static_cast<int>(at(layer, corners[q].n, corners[q].low));
      skin_.vertices[at(layer, corners[q].n, corners[q].low)].x = place(layer, corners[q].n, corners[q].low);
    }
    part.push_back({p, layer, c});
  }
  void add_quads(int layer, Column c, Part& part) {
    const auto [i, j] = c;
    const Column a = {i, j}, b = {i + 1, j}, o = {i + 1, j + 1}, d = {i, j + 1};
    add_quad(layer, c, 0, {{{a, true}, {d, true}, {o, true}, {b, true}}}, part);
    add_quad(layer, c, 1, {{{a, false}, {b, false}, {o, false}, {d, false}}}, part);
    const auto rim = [&](Column from, Column to) { add_quad(layer, c, 2, {{{from, true}, {to, true}, {to, false}, {from, false}}}, part); };
    if (ends(layer, c, 0, -1)) {
      rim(d, a);
    }
    if (ends(layer, c, 0, 1)) {
      rim(b, o);
    }
    if (ends(layer, c, 1, -1)) {
      rim(a, b);
    }
    if (ends(layer, c, 1, 1)) {
      rim(o, d);
    }
  }
  void add_normals(const Part& part) {
    for (const Quad& quad : part) {
      const SkinPatch& p = quad.patch;
      for (std::size_t q = 0; q < 4; ++q) {
        SkinVertex& v = skin_.vertices[static_cast<std::size_t>(p.vertex[q])];
        const Point &next = skin_.vertices[static_cast<std::size_t>(p.vertex[(q + 1) & 3])].x, &last = skin_.vertices[static_cast<std::size_t>(p.vertex[(q + 3) & 3])].x;
        const Point n = cross(minus(next, v.x), minus(last, v.x));
        const double length = std::sqrt(dot(n, n));
        for (std::size_t d = 0; d < 3 && length > 0; ++d) {
          v.normal[d] += n[d] / length;
          across_[static_cast<std::size_t>(p.vertex[q])][d] += p.side < 2 ? n[d] / length : 0.0;
        }
      }
    }
  }
  /// Where an edge is held.
  void let_faces_go_on() {
    for (int axis = 0; axis < 2; ++axis) {
      for (const int end : {0, 1}) {
        if (s_.edge[static_cast<std::size_t>(axis)][static_cast<std::size_t>(end)] == LayerEdge::free) {
          continue;
        }
        const int fixed = end == 0 ? 0 : axis == 0 ? nx_ : ny_;
        for (int face = 0; face < 2 * s_.grid.layers; ++face) {
          for (int k = 0; k <= (axis == 0 ? ny_ : nx_); ++k) {
            skin_.vertices[at(face / 2, axis == 0 ? Column{fixed, k} : Column{k, fixed}, face % 2 == 0)].normal[static_cast<std::size_t>(axis)] = 0;
          }
        }
      }
    }
  }

  /// The point of a layer's face nearest to x.
  struct OnFace {
    double gap = apart; ///< none
    bool behind = false; ///< x is in the layer that the face bounds
    bool at_end = false, beyond = false; ///< where the layer ends, past it
    Column column = {0, 0};
    int layer = 0;
    bool found() const { return gap < apart; }
    double room() const { return behind ? -gap : gap; }
  };
  OnFace on(int layer, bool low, Column c, const Point& x) const {
    constexpr double rounding = 1e-9, close = 1e-6;
    Point p[4], along[2], off{};
    for (std::size_t q = 0; q < 4; ++q) {
      p[q] = place(layer, {c.i + corner_of[q].i, c.j + corner_of[q].j}, low);
    }
    for (std::size_t d = 0; d < 3; ++d) {
      along[0][d] = 0.5 * (p[1][d] + p[2][d] - p[0][d] - p[3][d]);
      along[1][d] = 0.5 * (p[3][d] + p[2][d] - p[0][d] - p[1][d]);
      off[d] = x[d] - 0.25 * (p[0][d] + p[1][d] + p[2][d] + p[3][d]);
    }
    const double uu = dot(along[0], along[0]), uv = dot(along[0], along[1]), vv = dot(along[1], along[1]), det = uu * vv - uv * uv;
    if (!(det > 0)) {
      return {};
    }
    const double bu = dot(off, along[0]), bv = dot(off, along[1]);
    const std::array<double, 2> at = {0.5 + (vv * bu - uv * bv) / det, 0.5 + (uu * bv - uv * bu) / det};
    OnFace out;
    out.column = c;
    for (int axis = 0; axis < 2; ++axis) {
      const double t = at[static_cast<std::size_t>(axis)];
      const auto past = [&](double by) { return (t < -by && ends(layer, c, axis, -1)) || (t > 1 + by && ends(layer, c, axis, 1)); };
      out.beyond = out.beyond || past(rounding);
      out.at_end = out.at_end || past(-close);
    }
    const auto w = corner_weights(std::clamp(at[0], 0.0, 1.0), std::clamp(at[1], 0.0, 1.0));
    Point to = x, through{}; // from the face to x, and to the layer's other face
    for (std::size_t q = 0; q < 4; ++q) {
      const Point other = place(layer, {c.i + corner_of[q].i, c.j + corner_of[q].j}, !low);
      for (std::size_t d = 0; d < 3; ++d) {
        to[d] -= w[q] * p[q][d];
        through[d] += w[q] * (other[d] - p[q][d]);
      }
    }
    out.gap = std::sqrt(dot(to, to));
    const double up = dot(to, cross(along[0], along[1]));
    out.behind = (low ? up > 0 : up < 0) && out.gap * out.gap < dot(through, through);
    return out;
  }
  OnFace nearest(int layer, bool low, const Point& x, Column start) const {
    OnFace best;
    for (int step = 0; step < 8; ++step) { // layers slide
      const Column middle = best.found() ? best.column : start;
      for (int j = middle.j - 1; j <= middle.j + 1; ++j) {
        for (int i = middle.i - 1; i <= middle.i + 1; ++i) {
          const OnFace next = there(layer, {i, j}) ? on(layer, low, {i, j}, x) : OnFace{};
          best = next.gap < best.gap ? next : best;
        }
      }
      if (!best.found() || (best.column.i == middle.i && best.column.j == middle.j)) {
        break;
      }
    }
    return best;
  }

  /// The place nearest to a point on a layer's face, of the nearest layer that lies over it on that side.
  OnFace over(int layer, bool low, const Point& x, Column start) const {
    for (int q = low ? layer - 1 : layer + 1; q >= 0 && q < s_.grid.layers; q += low ? -1 : 1) {
      OnFace next = nearest(q, !low, x, start);
      if (next.found() && !next.beyond) {
        next.layer = q;
        return next;
      }
    }
    return {};
  }
  /// Is a layer whole for `reach` columns around one, but for its ends?
  bool is_whole(int layer, Column c, int reach) const {
    for (int j = std::max(0, c.j - reach); j <= std::min(ny_ - 1, c.j + reach); ++j) {
      for (int i = std::max(0, c.i - reach); i <= std::min(nx_ - 1, c.i + reach); ++i) {
        if (!there(layer, {i, j})) {
          return false;
        }
      }
    }
    return true;
  }

  /// At a node; `plain_` where the next layer is whole around it: between such nodes it is linear.
  void find_gap(int layer, Column n, bool low) {
    const std::size_t here = at(layer, n, low);
    const int q = low ? layer - 1 : layer + 1;
    if (q < 0 || q >= s_.grid.layers) {
      plain_[here] = 1;
      return;
    }
    const SkinVertex& v = skin_.vertices[here];
    bool own = true, both = true;
    for (const Column& c : corner_of) {
      const Column column = {n.i - c.i, n.j - c.j};
      const bool outside = column.i < 0 || column.j < 0 || column.i >= nx_ || column.j >= ny_;
      own = own && (outside || there(layer, column));
      both = both && own && (outside || there(q, column));
    }
    if (both) {
      const Point off = minus(place(q, n, !low), v.x);
      const Point& normal = across_[here];
      const double length = std::sqrt(dot(normal, normal)), across = length > 0 ? dot(off, normal) / length : 0.0, square = dot(off, off);
      const auto length_beside = [&](const std::vector<double>& line, int at) {
        const auto next = static_cast<std::size_t>(at + 1 < static_cast<int>(line.size()) ? at : at - 1);
        return line[next + 1] - line[next];
      };
      const double edge = std::min(length_beside(s_.lines[0], n.i), length_beside(s_.lines[1], n.j));
      if (square - across * across < 0.0625 * edge * edge) {
        const Point through = minus(place(q, n, low), place(q, n, !low));
        gap_[here] = across * across < dot(through, through) ? across : std::abs(across); // else it is through that layer
        plain_[here] = 1;
        return;
      }
    }
    const OnFace next = over(layer, low, v.x, n);
    gap_[here] = next.room();
    plain_[here] = own && next.found() && next.layer == q && is_whole(q, next.column, 1) ? 1 : 0;
  }
  bool hidden_at(int layer, Column n, bool low) const { return gap_[at(layer, n, low)] <= seen_slit * least(n); }

  /// Room added to a layer's face at a node: by what holds together there.
  double pad(int layer, Column n, bool low) const {
    int first = layer, last = layer;
    const auto near = [&](int q) { return there(q, {n.i - 1, n.j - 1}) || there(q, {n.i, n.j - 1}) || there(q, {n.i - 1, n.j}) || there(q, n); };
    while (low && last + 1 < s_.grid.layers && hidden_at(last, n, false) && near(last + 1)) {
      ++last;
    }
    while (!low && first > 0 && hidden_at(first, n, true) && near(first - 1)) {
      --first;
    }
    const std::size_t bottom = node(first, n, true), top = node(last, n, false);
    const Point off = minus(place(last, n, false), place(first, n, true));
    const double below = s_.rest[2][bottom], above = s_.rest[2][top];
    const Padding p = padding(own_[static_cast<std::size_t>(n.j) * static_cast<std::size_t>(nx_ + 1) + static_cast<std::size_t>(n.i)], std::min(above - below, std::sqrt(dot(off, off))), below - s_.levels.front(), s_.levels.back() - above);
    return low ? p.below : p.above;
  }

  /// Adds a face in parts where it is hidden in part; a rim is only where it lies in other layers.
  void add_visible(const Quad& quad, std::vector<SkinPatch>& out) const {
    const SkinPatch& whole = quad.patch;
    if (whole.side == 2 && !std::any_of(whole.vertex.begin(), whole.vertex.end(), [&](int v) { return gap_[static_cast<std::size_t>(v)] < 0; })) {
      out.push_back(whole);
      return;
    }
    const bool low = whole.side == 0, rim = whole.side == 2;
    std::array<double, 4> room; // beyond what is closed, at the corners
    bool plain = true, all = true, none = true;
    double enough = 0;
    for (std::size_t q = 0; q < 4; ++q) {
      const auto v = static_cast<std::size_t>(whole.vertex[q]), n = v % s_.node(0, 0, 1);
      room[q] = gap_[v] - seen_slit * least_[n];
      plain = plain && plain_[v] != 0;
      all = all && room[q] <= 0;
      none = none && room[q] > 0;
      enough += 0.25 * seen_slit * least_[n];
    }
    plain = plain && !rim;
    if (plain && (all || none)) {
      out.push_back(whole);
      out.back().hidden = all;
      return;
    }
    std::array<char, cuts * cuts> hidden{};
    for (int k = 0; k < cuts * cuts; ++k) {
      const auto w = corner_weights((k % cuts + 0.5) / cuts, (k / cuts + 0.5) / cuts);
      double gap = 0;
      Point x{};
      for (std::size_t q = 0; q < 4; ++q) {
        gap += w[q] * room[q];
        for (std::size_t d = 0; d < 3; ++d) {
          x[d] += w[q] * skin_.vertices[static_cast<std::size_t>(whole.vertex[q])].x[d];
        }
      }
      const auto above = [&](bool below) { return over(quad.layer, below, x, quad.column); };
      const auto in_other = [&](const OnFace& o) { return o.behind && !o.at_end; }; // else both rims would be hidden
      hidden[static_cast<std::size_t>(k)] = (rim ? in_other(above(true)) || in_other(above(false)) : plain ? gap <= 0 : above(low).room() <= enough) ? 1 : 0;
    }
    const auto count = std::count(hidden.begin(), hidden.end(), 1);
    if (count == 0 || count == cuts * cuts) {
      out.push_back(whole);
      out.back().hidden = count > 0;
      return;
    }
    for (int k = 0; k < cuts * cuts; ++k) {
      SkinPatch part = whole;
      part.low = {static_cast<double>(k % cuts) / cuts, static_cast<double>(k / cuts) / cuts};
      part.high = {static_cast<double>(k % cuts + 1) / cuts, static_cast<double>(k / cuts + 1) / cuts};
      part.hidden = hidden[static_cast<std::size_t>(k)] != 0;
      out.push_back(part);
    }
  }

  const LayerStack<3>& s_;
  const std::vector<char>& alive_;
  const std::vector<double>&least_, &own_;
  ThreadPool& pool_;
  const int nx_, ny_;
  Skin skin_;
  std::vector<double> gap_;   ///< m: over vertices; negative: in that layer
  std::vector<char> plain_;
  std::vector<Point> across_; ///< over vertices: normal without the rims', not unit
};

} // namespace

Skin find_skin(const LayerStack<3>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, ThreadPool& pool, const std::vector<double>& own) {
  return SkinBuilder(stack, alive, least_thickness, pool, own).run();
}

} // namespace ballast
