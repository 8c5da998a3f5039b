#include "ale/embed/layer_body.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace ballast {

namespace {

template <std::size_t N> double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < N; ++d) {
    sum += a[d] * b[d];
  }
  return sum;
}
template <std::size_t N> std::array<double, N> minus(const std::array<double, N>& a, const std::array<double, N>& b) {
  std::array<double, N> out{};
  for (std::size_t d = 0; d < N; ++d) {
    out[d] = a[d] - b[d];
  }
  return out;
}

/// Levels of the first and the last element left of a column, first above last: none.
struct Column {
  int first = 0, last = -1;
  bool empty() const { return first > last; }
};

template <int Dim> Column column_at(const LayerStack<Dim>& s, const std::vector<char>& alive, int i, int j) {
  Column c{s.grid.levels(), -1};
  for (int level = 0; level < s.grid.levels(); ++level) {
    if (alive[s.element(i, j, level)] != 0) {
      c.first = std::min(c.first, level);
      c.last = level;
    }
  }
  return c;
}

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

/// Nodes of one plane that make a stretch of a face, and a column it belongs to.
struct Run {
  int plane, column, first, last;
};

/// Where the face of the inner run's layer meets the outer run's edge at node k: the near node of that of its segments which is nearest to the
/// edge, on what is left of the layer. `left`: the inner one is left of the edge.
int meeting_node(const LayerStack<2>& s, const std::vector<char>& alive, const Run& inner, const Run& outer, int k, bool lower, bool left) {
  const std::size_t edge = s.node(k, 0, outer.plane + (lower ? s.grid.through : -s.grid.through)); // on the side that faces the inner layer
  const int level = inner.plane / (s.grid.through + 1) * s.grid.through;
  const auto there = [&](int i) { return i >= 0 && i < s.grid.elements[0] && alive[s.element(i, 0, level)] != 0; };
  const auto square = [&](int i) { // of the distance to segment i
    const std::size_t a = s.node(i, 0, inner.plane), b = a + 1;
    const std::array<double, 2> x = {s.position[0][edge], s.position[1][edge]}, from = {s.position[0][a], s.position[1][a]}, to = {s.position[0][b], s.position[1][b]};
    const auto along = minus(to, from), off = minus(x, from);
    const double length = dot(along, along), t = length > 0 ? std::clamp(dot(off, along) / length, 0.0, 1.0) : 0.0;
    return dot(off, off) - 2 * t * dot(off, along) + t * t * length;
  };
  int at = there(left ? k - 1 : k) ? (left ? k - 1 : k) : (left ? k : k - 1);
  if (!there(at)) {
    return k;
  }
  for (const int step : {-1, 1}) {
    while (there(at + step) && square(at + step) < square(at)) {
      at += step;
    }
  }
  return left ? at : at + 1;
}

} // namespace

/// Around each run of columns: along the lower faces, up the rim, back along the upper ones; the body lies to the left.
template <> void LayerBody<2>::add_faces(const LayerStack<2>& s, const std::vector<char>& alive, const std::vector<double>& least) {
  const int n = s.grid.elements[0];
  std::vector<Column> columns;
  for (int i = 0; i < n; ++i) {
    columns.push_back(column_at(s, alive, i, 0));
  }
  const double bottom = s.levels.front(), top = s.levels.back();
  const auto vertex = [&](int i, int plane, bool lower, const Column& c) {
    const std::size_t node = s.node(i, 0, plane);
    const std::size_t first = s.node(i, 0, s.plane_below(c.first)), last = s.node(i, 0, s.plane_below(c.last) + 1);
    const double low = s.rest[1][first], high = s.rest[1][last];
    const double now = std::hypot(s.position[0][last] - s.position[0][first], s.position[1][last] - s.position[1][first]);
    const Padding pad = padding(least[static_cast<std::size_t>(i)], std::min(high - low, now), low - bottom, top - high);
    Vertex v{node, {s.position[0][node], s.position[1][node]}, lower ? pad.below : pad.above, {}, false};
    vertices_.push_back(v);
    return static_cast<int>(vertices_.size()) - 1;
  };
  // Of the columns from begin to end, the nodes of one face. Where it steps from one layer to another, whose nodes may have slid away from
  // each other, the inner layer's face goes on to or ends where the outer one's edge lies over it.
  const auto chain = [&](int begin, int end, bool lower) {
    std::vector<Run> runs;
    for (int i = begin; i < end; ++i) {
      const Column& c = columns[static_cast<std::size_t>(i)];
      const int plane = lower ? s.plane_below(c.first) : s.plane_below(c.last) + 1;
      if (runs.empty() || runs.back().plane != plane) {
        runs.push_back({plane, i, i, i});
      }
      runs.back().last = i + 1;
    }
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
      Run &left = runs[r], &right = runs[r + 1];
      const bool left_is_inner = lower ? left.plane > right.plane : left.plane < right.plane;
      (left_is_inner ? left.last : right.first) = meeting_node(s, alive, left_is_inner ? left : right, left_is_inner ? right : left, right.column, lower, left_is_inner);
    }
    std::vector<int> out;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const Run& run = runs[r];
      for (int i = run.first; i <= std::max(run.first, run.last); ++i) {
        out.push_back(vertex(i, run.plane, lower, columns[static_cast<std::size_t>(run.column)]));
      }
      if (r + 1 == runs.size()) {
        break;
      }
      // The edges of the layers that end here, from the outer face of the outermost to the inner face of the innermost, or back.
      const Run& next = runs[r + 1];
      const bool outer_first = lower ? run.plane < next.plane : run.plane > next.plane;
      const Run &outer = outer_first ? run : next, &inner = outer_first ? next : run;
      const int k = next.column, column = outer_first ? k - 1 : k, inward = lower ? 1 : -1;
      std::vector<int> edge;
      for (int plane = outer.plane + inward; plane != inner.plane; plane += inward) {
        if (alive[s.element(column, 0, std::min(plane / (s.grid.through + 1) * s.grid.through, s.grid.levels() - 1))] != 0 && (plane % (s.grid.through + 1) == 0 || plane % (s.grid.through + 1) == s.grid.through)) {
          edge.push_back(plane);
        }
      }
      if (!outer_first) {
        std::reverse(edge.begin(), edge.end());
      }
      for (const int plane : edge) {
        out.push_back(vertex(k, plane, lower, columns[static_cast<std::size_t>(column)]));
      }
    }
    return out;
  };
  for (int begin = 0; begin < n;) {
    if (columns[static_cast<std::size_t>(begin)].empty()) {
      ++begin;
      continue;
    }
    int end = begin;
    while (end < n && !columns[static_cast<std::size_t>(end)].empty()) {
      ++end;
    }
    const std::vector<int> lower = chain(begin, end, true), upper = chain(begin, end, false); // along i
    const auto face = [&](int a, int b, int side) {
      auto &va = vertices_[static_cast<std::size_t>(a)], &vb = vertices_[static_cast<std::size_t>(b)];
      const std::array<double, 2> along = minus(vb.x, va.x);
      const double length = std::sqrt(dot(along, along));
      if (!(length > 0)) {
        return;
      }
      const std::array<double, 2> normal = {along[1] / length, -along[0] / length};
      for (std::size_t d = 0; d < 2; ++d) {
        va.normal[d] += normal[d];
        vb.normal[d] += normal[d];
      }
      faces_.push_back({{a, b}, normal, side});
    };
    // The stack's own edge is no rim unless it is free: beyond it the faces go on.
    const bool goes_on_low = begin == 0 && s.edge[0][0] != LayerEdge::free, goes_on_high = end == n && s.edge[0][1] != LayerEdge::free;
    for (std::size_t k = 0; k + 1 < lower.size(); ++k) {
      face(lower[k], lower[k + 1], 0);
    }
    if (!goes_on_high) {
      face(lower.back(), upper.back(), 2);
    }
    for (std::size_t k = upper.size(); k-- > 1;) {
      face(upper[k], upper[k - 1], 1);
    }
    if (!goes_on_low) {
      face(upper.front(), lower.front(), 2);
    }
    if (goes_on_low) {
      vertices_[static_cast<std::size_t>(lower.front())].end = vertices_[static_cast<std::size_t>(upper.front())].end = true;
    }
    if (goes_on_high) {
      vertices_[static_cast<std::size_t>(lower.back())].end = vertices_[static_cast<std::size_t>(upper.back())].end = true;
    }
    begin = end;
  }
}

template <int Dim> LayerBody<Dim>::LayerBody(const LayerStack<Dim>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, double bin) {
  add_faces(stack, alive, least_thickness);
  if (!faces_.empty()) {
    fill_bins(bin);
  }
}

template <int Dim> void LayerBody<Dim>::fill_bins(double bin) {
  low_ = high_ = vertices_.front().x;
  for (const Vertex& v : vertices_) {
    for (std::size_t d = 0; d < Dim; ++d) {
      low_[d] = std::min(low_[d], v.x[d]);
      high_[d] = std::max(high_[d], v.x[d]);
    }
  }
  bin_ = bin;
  for (const Vertex& v : vertices_) {
    thickest_ = std::max(thickest_, v.offset);
  }
  constexpr double most = 4096; // bins along an axis
  std::size_t count = 1;
  for (std::size_t d = 0; d < Dim; ++d) {
    bin_ = std::max(bin_, (high_[d] - low_[d]) / most);
  }
  for (std::size_t d = 0; d < Dim; ++d) {
    bins_[d] = static_cast<int>((high_[d] - low_[d]) / bin_) + 1;
    count *= static_cast<std::size_t>(bins_[d]);
  }
  const auto for_bins = [&](const Face& f, auto&& body) {
    std::array<int, Dim> a{}, b{};
    for (std::size_t d = 0; d < Dim; ++d) {
      double lo = vertices_[static_cast<std::size_t>(f.vertex[0])].x[d], hi = lo;
      for (const int v : f.vertex) {
        lo = std::min(lo, vertices_[static_cast<std::size_t>(v)].x[d]);
        hi = std::max(hi, vertices_[static_cast<std::size_t>(v)].x[d]);
      }
      a[d] = static_cast<int>((lo - low_[d]) / bin_);
      b[d] = static_cast<int>((hi - low_[d]) / bin_);
    }
    std::array<int, Dim> at = a;
    for (;;) {
      std::size_t where = 0;
      for (std::size_t d = Dim; d-- > 0;) {
        where = where * static_cast<std::size_t>(bins_[d]) + static_cast<std::size_t>(at[d]);
      }
      body(where);
      std::size_t d = 0;
      while (d < Dim && ++at[d] > b[d]) {
        at[d] = a[d];
        ++d;
      }
      if (d == Dim) {
        return;
      }
    }
  };
  first_.assign(count + 1, 0);
  for (const Face& f : faces_) {
    for_bins(f, [&](std::size_t at) { ++first_[at + 1]; });
  }
  for (std::size_t at = 0; at < count; ++at) {
    first_[at + 1] += first_[at];
  }
  binned_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for_bins(faces_[f], [&](std::size_t at) { binned_[static_cast<std::size_t>(next[at]++)] = static_cast<int>(f); });
  }
}

template <> bool LayerBody<2>::foot(const std::array<double, 2>& point, double reach, BodyFoot<2>& out, int side) const {
  if (faces_.empty()) {
    return false;
  }
  double best = 1e300;
  const double far = reach + thickest_;
  std::array<int, 2> a{}, b{};
  for (std::size_t d = 0; d < 2; ++d) {
    // What lies beyond an end looks at the end's own bin.
    a[d] = static_cast<int>(std::clamp(std::floor((point[d] - far - low_[d]) / bin_), -1.0, static_cast<double>(bins_[d])));
    b[d] = static_cast<int>(std::clamp(std::floor((point[d] + far - low_[d]) / bin_), -1.0, static_cast<double>(bins_[d])));
    if (d == 0) {
      a[d] = std::min(a[d], bins_[d] - 1);
      b[d] = std::max(b[d], 0);
    }
    a[d] = std::max(a[d], 0);
    b[d] = std::min(b[d], bins_[d] - 1);
  }
  double best_part = 0;
  int found = -1;
  for (int y = a[1]; y <= b[1]; ++y) {
    for (int x = a[0]; x <= b[0]; ++x) {
      const auto at = static_cast<std::size_t>(y * bins_[0] + x);
      for (int q = first_[at]; q < first_[at + 1]; ++q) {
        const int f = binned_[static_cast<std::size_t>(q)];
        const Face& face = faces_[static_cast<std::size_t>(f)];
        if (side >= 0 && face.side == 1 - side) {
          continue;
        }
        const Vertex &va = vertices_[static_cast<std::size_t>(face.vertex[0])], &vb = vertices_[static_cast<std::size_t>(face.vertex[1])];
        const auto along = minus(vb.x, va.x), from = minus(point, va.x);
        double t = dot(from, along) / dot(along, along);
        t = va.end && t < 0 ? t : std::max(t, 0.0);
        t = vb.end && t > 1 ? t : std::min(t, 1.0);
        const std::array<double, 2> off = {from[0] - t * along[0], from[1] - t * along[1]};
        const double square = dot(off, off);
        if (square < best || (square == best && f < found)) {
          best = square;
          best_part = t;
          found = f;
        }
      }
    }
  }
  if (found < 0 || best > far * far) {
    return false;
  }
  const Face& face = faces_[static_cast<std::size_t>(found)];
  const Vertex &va = vertices_[static_cast<std::size_t>(face.vertex[0])], &vb = vertices_[static_cast<std::size_t>(face.vertex[1])];
  const auto along = minus(vb.x, va.x), from = minus(point, va.x);
  const std::array<double, 2> off = {from[0] - best_part * along[0], from[1] - best_part * along[1]};
  const bool at_a = best_part == 0 && !va.end, at_b = best_part == 1 && !vb.end;
  const std::array<double, 2>& outward = at_a ? va.normal : at_b ? vb.normal : face.normal;
  const double distance = std::sqrt(best), scale = std::sqrt(dot(along, along));
  const bool outside = dot(off, outward) > 0;
  if (distance > 1e-9 * scale && (at_a || at_b)) {
    for (std::size_t d = 0; d < 2; ++d) {
      out.normal[d] = (outside ? 1 : -1) * off[d] / distance;
    }
  } else {
    const double length = std::sqrt(dot(outward, outward));
    for (std::size_t d = 0; d < 2; ++d) {
      out.normal[d] = length > 0 ? outward[d] / length : face.normal[d];
    }
  }
  out.node = {va.node, vb.node};
  out.weight = {1 - best_part, best_part};
  out.level = (outside ? distance : -distance) - ((1 - best_part) * va.offset + best_part * vb.offset);
  out.side = face.side;
  return std::abs(out.level) <= reach;
}

template <> bool LayerBody<2>::near(const std::array<double, 2>& p, double reach) const {
  const double far = reach + thickest_;
  return !faces_.empty() && p[1] > low_[1] - far && p[1] < high_[1] + far; // along the layers faces may go on
}

template <> bool LayerBody<2>::inside(const std::array<double, 2>& p) const {
  bool in = false; // a ray along the last axis, down: closed at ends that go on, since faces reach on there
  for (const Face& face : faces_) {
    const Vertex &va = vertices_[static_cast<std::size_t>(face.vertex[0])], &vb = vertices_[static_cast<std::size_t>(face.vertex[1])];
    double x = p[0];
    const bool forward = va.x[0] < vb.x[0];
    const Vertex &left = forward ? va : vb, &right = forward ? vb : va;
    x = left.end && x < left.x[0] ? left.x[0] : x;
    x = right.end && x >= right.x[0] ? std::nextafter(right.x[0], left.x[0]) : x;
    if ((va.x[0] <= x) != (vb.x[0] <= x)) {
      const double y = va.x[1] + (x - va.x[0]) / (vb.x[0] - va.x[0]) * (vb.x[1] - va.x[1]);
      in = in != (y < p[1]);
    }
  }
  return in;
}

template LayerBody<2>::LayerBody(const LayerStack<2>&, const std::vector<char>&, const std::vector<double>&, double);

} // namespace ballast
