#include "ale/embed/layer_body_3d.hpp"

#include "ale/embed/padding.hpp"
#include "ale/embed/points.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

using Point = std::array<double, 3>;

/// Weights of a triangle's corners at its point nearest to p, by the regions of C. Ericson, Real-Time Collision Detection (2005), 5.1.5.
Point nearest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) {
    return {1, 0, 0};
  }
  const Point bp = minus(p, b);
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) {
    return {0, 1, 0};
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 / (d1 - d3);
    return {1 - t, t, 0};
  }
  const Point cp = minus(p, c);
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) {
    return {0, 0, 1};
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 / (d2 - d6);
    return {1 - t, 0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double scale = 1 / (va + vb + vc);
  return {1 - (vb + vc) * scale, vb * scale, vc * scale};
}

/// Parameters of a patch's corners.
std::array<double, 2> corner_place(const SkinPatch& p, std::size_t corner) { return {corner == 1 || corner == 2 ? p.high[0] : p.low[0], corner > 1 ? p.high[1] : p.low[1]}; }

} // namespace

LayerBody<3>::LayerBody(const LayerStack<3>& s, const std::vector<char>& alive, const std::vector<double>& least, double bin) : skin_(find_skin(s, alive, least)) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    constexpr double none = std::numeric_limits<double>::infinity();
    hold_low_[axis] = s.edge[axis][0] == LayerEdge::free ? -none : s.lines[axis].front();
    hold_high_[axis] = s.edge[axis][1] == LayerEdge::free ? none : s.lines[axis].back();
  }
  for (const SkinPatch& p : skin_.patches) {
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
    thickest_ = std::max(thickest_, out.offset);
    patches_.push_back(out);
  }
  if (!patches_.empty()) {
    fill_columns(bin);
  }
}

void LayerBody<3>::fill_columns(double bin) {
  low_ = high_ = patches_.front().x[0];
  for (const Patch& p : patches_) {
    for (std::size_t d = 0; d < 3; ++d) {
      low_[d] = std::min(low_[d], p.low[d]);
      high_[d] = std::max(high_[d], p.high[d]);
    }
  }
  bin_ = bin;
  constexpr double most = 512; // columns along an axis
  for (std::size_t d = 0; d < 2; ++d) {
    bin_ = std::max(bin_, (high_[d] - low_[d]) / most);
  }
  for (std::size_t d = 0; d < 2; ++d) {
    columns_[d] = static_cast<int>((high_[d] - low_[d]) / bin_) + 1;
  }
  const auto count = static_cast<std::size_t>(columns_[0]) * static_cast<std::size_t>(columns_[1]);
  const auto for_columns = [&](const Patch& p, auto&& body) {
    std::array<int, 2> from{}, to{};
    for (std::size_t d = 0; d < 2; ++d) {
      from[d] = static_cast<int>((p.low[d] - low_[d]) / bin_);
      to[d] = static_cast<int>((p.high[d] - low_[d]) / bin_);
    }
    for (int y = from[1]; y <= to[1]; ++y) {
      for (int x = from[0]; x <= to[0]; ++x) {
        body(static_cast<std::size_t>(y * columns_[0] + x));
      }
    }
  };
  const auto for_kinds = [&](std::size_t p, auto&& body) {
    body(skin_.patches[p].hidden ? hidden : surface);
    if (!skin_.patches[p].hidden && patches_[p].offset > 0) {
      body(padded);
    }
  };
  constexpr double none = std::numeric_limits<double>::infinity();
  for (Columns& c : binned_) {
    c.first.assign(count + 1, 0);
    c.low.assign(count, none);
    c.high.assign(count, -none);
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    for_kinds(p, [&](Kind kind) { for_columns(patches_[p], [&](std::size_t at) { ++binned_[kind].first[at + 1]; }); });
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
      c.offset = std::max(c.offset, patches_[p].offset);
      for_columns(patches_[p], [&](std::size_t at) {
        c.patch[static_cast<std::size_t>(next[kind][at]++)] = static_cast<int>(p);
        c.low[at] = std::min(c.low[at], patches_[p].low[2]);
        c.high[at] = std::max(c.high[at], patches_[p].high[2]);
      });
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
  const Columns& c = binned_[kind];
  std::array<int, 2> own{};
  for (std::size_t d = 0; d < 2; ++d) {
    own[d] = static_cast<int>(std::clamp((point[d] - low_[d]) / bin_, 0.0, columns_[d] - 1.0));
  }
  const auto beyond = [](double x, double low, double high) { return std::max({low - x, x - high, 0.0}); };
  const int rings = std::max({own[0], columns_[0] - 1 - own[0], own[1], columns_[1] - 1 - own[1]});
  for (int ring = 0; ring <= rings; ++ring) {
    const double nearest = (ring - 1) * bin_;
    if (ring > 1 && nearest * nearest > square) {
      break;
    }
    for (int y = std::max(0, own[1] - ring); y <= std::min(columns_[1] - 1, own[1] + ring); ++y) {
      const bool whole_row = std::abs(y - own[1]) == ring;
      const double dy = beyond(point[1], low_[1] + y * bin_, low_[1] + (y + 1) * bin_);
      for (int x = own[0] - ring; x <= own[0] + ring; x += whole_row || ring == 0 ? 1 : 2 * ring) {
        if (x < 0 || x >= columns_[0]) {
          continue;
        }
        const auto at = static_cast<std::size_t>(y * columns_[0] + x);
        const double dx = beyond(point[0], low_[0] + x * bin_, low_[0] + (x + 1) * bin_), dz = beyond(point[2], c.low[at], c.high[at]);
        if (!(dx * dx + dy * dy + dz * dz <= square)) {
          continue;
        }
        for (int q = c.first[at]; q < c.first[at + 1]; ++q) {
          const int p = c.patch[static_cast<std::size_t>(q)];
          const Patch& patch = patches_[static_cast<std::size_t>(p)];
          double least = 0; // to its box
          for (std::size_t d = 0; d < 3; ++d) {
            const double off = beyond(point[d], patch.low[d], patch.high[d]);
            least += off * off;
          }
          if (least <= square && body(p)) {
            return true;
          }
        }
      }
    }
  }
  return false;
}

LayerBody<3>::OnPatch LayerBody<3>::nearest(const Point& point, double square, Kind kind, int side) const {
  OnPatch best;
  any_near(point, square, kind, [&](int p) {
    if (p != best.patch && (side < 0 || skin_.patches[static_cast<std::size_t>(p)].side != 1 - side)) {
      const OnPatch on = on_patch(p, point);
      if (on.square <= square && on.before(best)) {
        best = on;
        square = on.square;
      }
    }
    return false;
  });
  return best;
}

bool LayerBody<3>::foot(const Point& where, double reach, BodyFoot<3>& out, int side) const {
  if (patches_.empty()) {
    return false;
  }
  const Point point = held(where);
  const double far = reach + thickest_;
  OnPatch at = nearest(point, reach * reach, surface, side);
  if (at.patch < 0 && thickest_ > 0 && any_near(point, far * far, padded, [](int) { return true; })) { // farther, but made thicker
    at = nearest(point, far * far, surface, side);
  }
  if (at.patch < 0) {
    return false;
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

bool LayerBody<3>::near(const Point& p, double reach) const {
  const double far = reach + thickest_;
  return !patches_.empty() && p[2] > low_[2] - far && p[2] < high_[2] + far; // along the layers faces may go on
}

bool LayerBody<3>::may_touch(const Point& where, const Point& box) const {
  const Point point = held(where);
  std::array<int, 2> from{}, to{};
  for (const Kind kind : {surface, padded}) {
    const Columns& c = binned_[kind];
    const double more = kind == padded ? c.offset : 0.0;
    for (std::size_t d = 0; d < 2; ++d) {
      from[d] = static_cast<int>(std::clamp((point[d] - box[d] - more - low_[d]) / bin_, 0.0, columns_[d] - 1.0));
      to[d] = static_cast<int>(std::clamp((point[d] + box[d] + more - low_[d]) / bin_, 0.0, columns_[d] - 1.0));
    }
    for (int y = from[1]; y <= to[1]; ++y) {
      for (int x = from[0]; x <= to[0]; ++x) {
        const auto at = static_cast<std::size_t>(y * columns_[0] + x);
        if (point[2] + box[2] + more >= c.low[at] && point[2] - box[2] - more <= c.high[at]) {
          return true;
        }
      }
    }
  }
  return false;
}

} // namespace ballast
