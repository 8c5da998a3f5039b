#include "ale/embed/layer_body_3d.hpp"

#include "ale/embed/padding.hpp"
#include "ale/embed/points.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

using Point = std::array<double, 3>;

/// Parameters of a patch's corners.
std::array<double, 2> corner_place(const SkinPatch& p, std::size_t corner) { return {corner == 1 || corner == 2 ? p.high[0] : p.low[0], corner > 1 ? p.high[1] : p.low[1]}; }

} // namespace

LayerBody<3>::LayerBody(const LayerStack<3>& s, const std::vector<char>& alive, const std::vector<double>& least, double bin, ThreadPool& pool)
    : skin_(find_skin(s, alive, least, pool)), patches_(skin_.patches.size()) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    constexpr double none = std::numeric_limits<double>::infinity();
    hold_low_[axis] = s.edge[axis][0] == LayerEdge::free ? -none : s.lines[axis].front();
    hold_high_[axis] = s.edge[axis][1] == LayerEdge::free ? none : s.lines[axis].back();
    const std::vector<double>& lines = s.lines[axis];
    std::vector<double> ends = {lines.front()};
    for (const double at : lines) {
      if (at - ends.back() >= bin && at < lines.back()) {
        ends.push_back(at);
      }
    }
    ends.push_back(lines.back());
    ends_[axis] = std::move(ends);
  }
  parallel_ranges(pool, static_cast<int>(patches_.size()), [&](int begin, int end, int) {
    for (auto p = static_cast<std::size_t>(begin); p < static_cast<std::size_t>(end); ++p) {
      patches_[p] = measure(skin_.patches[p]);
    }
  });
  for (const Patch& p : patches_) {
    thickest_ = std::max(thickest_, p.offset);
  }
  if (!patches_.empty()) {
    fill_columns();
  }
}

LayerBody<3>::Patch LayerBody<3>::measure(const SkinPatch& p) const {
  Patch out{};
  for (std::size_t c = 0; c < 4; ++c) {
    const auto [u, v] = corner_place(p, c);
    const auto w = corner_weights(u, v);
    for (std::size_t q = 0; q < 4; ++q) {
      const SkinVertex& vertex = skin_.vertices[static_cast<std::size_t>(p.vertex[q])];
      out.offset = std::max(out.offset, vertex.offset);
      for (std::size_t d = 0; d < 3; ++d) {
        out.x[c][d] += w[q] * vertex.x[d];
      }
    }
    for (std::size_t d = 0; d < 3; ++d) {
      out.x[4][d] += 0.25 * out.x[c][d];
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    const auto ends = std::minmax({out.x[0][d], out.x[1][d], out.x[2][d], out.x[3][d]});
    out.low[d] = ends.first;
    out.high[d] = ends.second;
    out.size = std::max(out.size, out.high[d] - out.low[d]);
  }
  return out;
}

std::size_t LayerBody<3>::column(std::size_t axis, double x) const {
  const std::vector<double>& ends = ends_[axis];
  const auto above = std::upper_bound(ends.begin() + 1, ends.end() - 1, x) - ends.begin();
  return static_cast<std::size_t>(above - 1);
}

std::array<std::array<std::size_t, 2>, 2> LayerBody<3>::columns(const Point& point, std::array<double, 2> reach) const {
  std::array<std::array<std::size_t, 2>, 2> out;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double far = reach[axis] + overhang_[axis] + 1e-12 * (ends_[axis].back() - ends_[axis].front()); // on a line: both sides
    out[axis] = {column(axis, point[axis] - far), column(axis, point[axis] + far)};
  }
  return out;
}

void LayerBody<3>::fill_columns() {
  low_[2] = high_[2] = patches_.front().x[0][2];
  for (const Patch& p : patches_) {
    low_[2] = std::min(low_[2], p.low[2]);
    high_[2] = std::max(high_[2], p.high[2]);
  }
  const std::size_t across = ends_[0].size() - 1, count = across * (ends_[1].size() - 1);
  std::vector<std::size_t> own(patches_.size()); // the column of a patch's middle
  for (std::size_t p = 0; p < own.size(); ++p) {
    const std::array<std::size_t, 2> at = {column(0, patches_[p].x[4][0]), column(1, patches_[p].x[4][1])};
    own[p] = at[1] * across + at[0];
    for (std::size_t axis = 0; axis < 2; ++axis) {
      overhang_[axis] = at[axis] > 0 ? std::max(overhang_[axis], ends_[axis][at[axis]] - patches_[p].low[axis]) : overhang_[axis];
      overhang_[axis] = at[axis] + 2 < ends_[axis].size() ? std::max(overhang_[axis], patches_[p].high[axis] - ends_[axis][at[axis] + 1]) : overhang_[axis];
    }
  }
  const auto for_kinds = [&](std::size_t p, auto&& body) {
    static_assert(lower == 0 && upper == 1 && rim == 2); // as SkinPatch::side
    body(skin_.patches[p].hidden ? hidden : static_cast<Kind>(skin_.patches[p].side));
    if (!skin_.patches[p].hidden && patches_[p].offset > 0) {
      body(padded);
    }
  };
  constexpr double none = std::numeric_limits<double>::infinity();
  for (Columns& c : binned_) {
    c.first.assign(count + 1, 0);
    c.box.assign(count, {{none, none, none}, {-none, -none, -none}});
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    for_kinds(p, [&](Kind kind) { ++binned_[kind].first[own[p] + 1]; });
  }
  std::array<std::vector<int>, kinds> next;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    Columns& c = binned_[kind];
    for (std::size_t at = 0; at < count; ++at) {
      c.first[at + 1] += c.first[at];
    }
    c.patch.resize(static_cast<std::size_t>(c.first.back()));
    next[kind].assign(c.first.begin(), c.first.end() - 1);
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    for_kinds(p, [&](Kind kind) {
      Columns& c = binned_[kind];
      const Patch& patch = patches_[p];
      c.offset = std::max(c.offset, patch.offset);
      c.patch[static_cast<std::size_t>(next[kind][own[p]]++)] = static_cast<int>(p);
      for (std::size_t d = 0; d < 3; ++d) {
        c.box[own[p]].low[d] = std::min(c.box[own[p]].low[d], patch.low[d]);
        c.box[own[p]].high[d] = std::max(c.box[own[p]].high[d], patch.high[d]);
      }
    });
  }
}

LayerBody<3>::Point LayerBody<3>::held(Point point) const {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    point[axis] = std::clamp(point[axis], hold_low_[axis], hold_high_[axis]);
  }
  return point;
}

LayerBody<3>::OnPatch LayerBody<3>::on_patch(int patch, const Point& point) const {
  const Patch& p = patches_[static_cast<std::size_t>(patch)];
  OnPatch best;
  for (int edge = 0; edge < 4; ++edge) {
    const Point &a = p.x[static_cast<std::size_t>(edge)], &b = p.x[static_cast<std::size_t>((edge + 1) & 3)], &c = p.x[4];
    const Point w = nearest_on_triangle(point, a, b, c);
    double square = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double off = point[d] - w[0] * a[d] - w[1] * b[d] - w[2] * c[d];
      square += off * off;
    }
    if (square < best.square) {
      best = {square, patch, edge, w};
    }
  }
  return best;
}

std::array<double, 2> LayerBody<3>::place(const OnPatch& at) const {
  const SkinPatch& p = skin_.patches[static_cast<std::size_t>(at.patch)];
  const auto a = corner_place(p, static_cast<std::size_t>(at.edge)), b = corner_place(p, static_cast<std::size_t>((at.edge + 1) & 3));
  std::array<double, 2> out{};
  for (std::size_t d = 0; d < 2; ++d) {
    out[d] = at.weight[0] * a[d] + at.weight[1] * b[d] + at.weight[2] * 0.5 * (p.low[d] + p.high[d]);
  }
  return out;
}

std::array<double, 4> LayerBody<3>::weights(const OnPatch& at) const {
  const SkinPatch& p = skin_.patches[static_cast<std::size_t>(at.patch)];
  std::array<double, 4> out{};
  for (std::size_t c = 0; c < 4; ++c) {
    const auto [u, v] = corner_place(p, c);
    const auto w = corner_weights(u, v);
    const double share = 0.25 * at.weight[2] + (c == static_cast<std::size_t>(at.edge) ? at.weight[0] : 0.0) + (c == static_cast<std::size_t>((at.edge + 1) & 3) ? at.weight[1] : 0.0);
    for (std::size_t q = 0; q < 4; ++q) {
      out[q] += share * w[q];
    }
  }
  return out;
}

bool LayerBody<3>::outside_of(const OnPatch& at, const Point& point, Point& outward) const {
  const SkinPatch& s = skin_.patches[static_cast<std::size_t>(at.patch)];
  const Patch& p = patches_[static_cast<std::size_t>(at.patch)];
  const Point &a = p.x[static_cast<std::size_t>(at.edge)], &b = p.x[static_cast<std::size_t>((at.edge + 1) & 3)], &c = p.x[4];
  Point off{};
  for (std::size_t d = 0; d < 3; ++d) {
    off[d] = point[d] - at.weight[0] * a[d] - at.weight[1] * b[d] - at.weight[2] * c[d];
  }
  const bool in_triangle = at.weight[0] > 0 && at.weight[1] > 0 && at.weight[2] > 0;
  const std::array<double, 4> end = {s.low[1], s.high[0], s.high[1], s.low[0]};
  const double is_end = at.edge == 0 || at.edge == 3 ? 0 : 1;
  bool at_rim = at.weight[2] == 0 && end[static_cast<std::size_t>(at.edge)] == is_end; // of the whole quadrilateral
  if (at.weight[2] == 0 && !at_rim && (at.weight[0] == 0 || at.weight[1] == 0)) { // a corner: the other edge there
    const int other = at.weight[1] == 0 ? (at.edge + 3) & 3 : (at.edge + 1) & 3;
    at_rim = end[static_cast<std::size_t>(other)] == (other == 0 || other == 3 ? 0 : 1);
  }
  Point normal = cross(minus(b, a), minus(c, a));
  if (at_rim) {
    const auto [u, v] = place(at);
    const auto w = corner_weights(u, v);
    normal = {0, 0, 0};
    for (std::size_t q = 0; q < 4; ++q) {
      for (std::size_t d = 0; d < 3; ++d) {
        normal[d] += w[q] * skin_.vertices[static_cast<std::size_t>(s.vertex[q])].normal[d];
      }
    }
  } else if (!in_triangle) { // between two of its triangles
    normal = cross(minus(p.x[2], p.x[0]), minus(p.x[3], p.x[1]));
  }
  const bool outside = dot(off, normal) > 0;
  const double distance = std::sqrt(at.square);
  if (!in_triangle && distance > 1e-9 * p.size) {
    for (std::size_t d = 0; d < 3; ++d) {
      outward[d] = (outside ? 1 : -1) * off[d] / distance;
    }
    return outside;
  }
  const double length = std::sqrt(dot(normal, normal));
  for (std::size_t d = 0; d < 3; ++d) {
    outward[d] = length > 0 ? normal[d] / length : d == 2 ? 1.0 : 0.0;
  }
  return outside;
}

template <class Body> bool LayerBody<3>::any_near(const Point& point, const double& square, Kind kind, Body&& body) const {
  constexpr double rounding = 1 - 1e-12; // of two as near the same one is found whatever was looked at first
  const Columns& c = binned_[kind];
  const auto beyond = [&](const Point& low, const Point& high) {
    double sum = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double off = std::max({low[d] - point[d], point[d] - high[d], 0.0});
      sum += off * off;
    }
    return rounding * sum;
  };
  const auto in_column = [&](std::size_t at) {
    if (!(beyond(c.box[at].low, c.box[at].high) <= square)) {
      return false;
    }
    for (int q = c.first[at]; q < c.first[at + 1]; ++q) {
      const int p = c.patch[static_cast<std::size_t>(q)];
      const Patch& patch = patches_[static_cast<std::size_t>(p)];
      if (beyond(patch.low, patch.high) <= square && body(p)) {
        return true;
      }
    }
    return false;
  };
  const std::size_t across = ends_[0].size() - 1, own = column(1, point[1]) * across + column(0, point[0]);
  if (in_column(own)) {
    return true;
  }
  const double reach = std::sqrt(square);
  const auto [x, y] = columns(point, {reach, reach});
  for (std::size_t j = y[0]; j <= y[1]; ++j) {
    for (std::size_t i = x[0]; i <= x[1]; ++i) {
      if (j * across + i != own && in_column(j * across + i)) {
        return true;
      }
    }
  }
  return false;
}

LayerBody<3>::OnPatch LayerBody<3>::nearest(const Point& point, double square, int side, int start) const {
  OnPatch best;
  const auto look = [&](int p) {
    if (p != best.patch) {
      const OnPatch on = on_patch(p, point);
      if (on.square <= square && on.before(best)) {
        best = on;
        square = on.square;
      }
    }
    return false;
  };
  if (start >= 0 && (side < 0 || skin_.patches[static_cast<std::size_t>(start)].side != 1 - side)) {
    look(start);
  }
  for (const Kind kind : {lower, upper, rim}) {
    if (side < 0 || static_cast<int>(kind) != 1 - side) {
      any_near(point, square, kind, look);
    }
  }
  return best;
}

bool LayerBody<3>::foot(const Point& where, double reach, BodyFoot<3>& out, int side, int* start) const {
  if (patches_.empty()) {
    return false;
  }
  const Point point = held(where);
  const double far = reach + thickest_;
  OnPatch at = nearest(point, reach * reach, side, start != nullptr ? *start : -1);
  if (at.patch < 0 && thickest_ > 0 && any_near(point, far * far, padded, [](int) { return true; })) { // farther, but made thicker
    at = nearest(point, far * far, side);
  }
  if (at.patch < 0) {
    return false;
  }
  if (start != nullptr) {
    *start = at.patch;
  }
  const bool in_front = outside_of(at, point, out.normal);
  // Nearer to what is hidden: in a layer, or in a slit that is closed. Of a given side what counts is how the point stands to that.
  const bool inside = !in_front || (side < 0 && any_near(point, at.square, hidden, [&](int p) { return on_patch(p, point).square < nearer * at.square; }));
  const double distance = std::sqrt(at.square);
  const SkinPatch& s = skin_.patches[static_cast<std::size_t>(at.patch)];
  out.weight = weights(at);
  out.node = s.node;
  double offset = 0;
  Point to = {0, 0, 0};
  for (std::size_t q = 0; q < 4; ++q) {
    const SkinVertex& vertex = skin_.vertices[static_cast<std::size_t>(s.vertex[q])];
    offset += out.weight[q] * vertex.offset;
    for (std::size_t d = 0; d < 3; ++d) {
      to[d] += out.weight[q] * vertex.x[d];
    }
  }
  if (inside == in_front && distance > 0) { // the way to it leads through a slit or another layer
    const Point off = minus(point, to);
    const double length = std::sqrt(dot(off, off));
    for (std::size_t d = 0; d < 3 && length > 0; ++d) {
      out.normal[d] = (inside ? -1 : 1) * off[d] / length;
    }
  }
  out.level = (inside ? -distance : distance) - offset;
  out.side = s.side;
  return std::abs(out.level) <= reach;
}

bool LayerBody<3>::near(double low, double high, double reach) const {
  const double far = reach + thickest_;
  return !patches_.empty() && high > low_[2] - far && low < high_[2] + far;
}

bool LayerBody<3>::may_touch(const Point& where, const Point& box) const {
  const Point point = held(where);
  const std::size_t across = ends_[0].size() - 1;
  for (const Kind kind : {lower, upper, rim, padded}) {
    const Columns& c = binned_[kind];
    const double more = kind == padded ? c.offset : 0.0;
    if (c.patch.empty()) {
      continue;
    }
    const auto [x, y] = columns(point, {box[0] + more, box[1] + more});
    for (std::size_t j = y[0]; j <= y[1]; ++j) {
      for (std::size_t i = x[0]; i <= x[1]; ++i) {
        const Box& around = c.box[j * across + i];
        bool touches = true;
        for (std::size_t d = 0; d < 3; ++d) {
          touches = touches && point[d] + box[d] + more >= around.low[d] && point[d] - box[d] - more <= around.high[d];
        }
        if (touches) {
          return true;
        }
      }
    }
  }
  return false;
}

} // namespace ballast
