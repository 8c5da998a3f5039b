#include "ale/embed/layer_body.hpp"

#include "ale/embed/outline.hpp"
#include "ale/embed/padding.hpp"
#include "ale/embed/points.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

/// A layer lies to the left of its faces.
void LayerBody<2>::add_faces(const LayerStack<2>& s, const std::vector<char>& alive, const std::vector<double>& least, const std::vector<double>& own) {
  for (const Outline& o : find_outlines(s, alive, least, own)) {
    const auto first = static_cast<int>(vertices_.size()), count = static_cast<int>(o.size());
    std::vector<int> mirrored;
    for (const OutlineVertex& v : o) {
      vertices_.push_back({v.node, v.weight, v.x, v.offset, {}, false});
    }
    for (int k = 0; k < count; ++k) {
      const OutlineVertex& v = o[static_cast<std::size_t>(k)];
      const int a = first + k, b = first + (k + 1) % count;
      auto &va = vertices_[static_cast<std::size_t>(a)], &vb = vertices_[static_cast<std::size_t>(b)];
      const std::array<double, 2> along = minus(vb.x, va.x);
      const double length = std::sqrt(dot(along, along));
      if (v.side < 0) {
        va.end = vb.end = v.side == -1;
        if (v.side == -2) {
          mirrored.insert(mirrored.end(), {a, b});
        }
      } else if (length > 0) {
        const std::array<double, 2> normal = {along[1] / length, -along[0] / length};
        for (std::size_t d = 0; d < 2; ++d) {
          va.normal[d] += normal[d];
          vb.normal[d] += normal[d];
        }
        faces_.push_back({{a, b}, normal, v.side, v.hidden});
      }
    }
    for (const int vertex : mirrored) { // with its mirror image's faces
      vertices_[static_cast<std::size_t>(vertex)].normal[0] = 0;
    }
  }
}

LayerBody<2>::LayerBody(const LayerStack<2>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, double bin, const std::vector<double>& own) {
  add_faces(stack, alive, least_thickness, own);
  if (!faces_.empty()) {
    fill_bins(bin);
  }
}

void LayerBody<2>::fill_bins(double bin) {
  low_ = high_ = vertices_.front().x;
  for (const Vertex& v : vertices_) {
    for (std::size_t d = 0; d < 2; ++d) {
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
  for (std::size_t d = 0; d < 2; ++d) {
    bin_ = std::max(bin_, (high_[d] - low_[d]) / most);
  }
  for (std::size_t d = 0; d < 2; ++d) {
    bins_[d] = static_cast<int>((high_[d] - low_[d]) / bin_) + 1;
    count *= static_cast<std::size_t>(bins_[d]);
  }
  const auto for_bins = [&](const Face& f, auto&& body) {
    std::array<int, 2> a{}, b{};
    for (std::size_t d = 0; d < 2; ++d) {
      double lo = vertices_[static_cast<std::size_t>(f.vertex[0])].x[d], hi = lo;
      for (const int v : f.vertex) {
        lo = std::min(lo, vertices_[static_cast<std::size_t>(v)].x[d]);
        hi = std::max(hi, vertices_[static_cast<std::size_t>(v)].x[d]);
      }
      a[d] = static_cast<int>((lo - low_[d]) / bin_);
      b[d] = static_cast<int>((hi - low_[d]) / bin_);
    }
    std::array<int, 2> at = a;
    for (;;) {
      std::size_t where = 0;
      for (std::size_t d = 2; d-- > 0;) {
        where = where * static_cast<std::size_t>(bins_[d]) + static_cast<std::size_t>(at[d]);
      }
      body(where);
      std::size_t d = 0;
      while (d < 2 && ++at[d] > b[d]) {
        at[d] = a[d];
        ++d;
      }
      if (d == 2) {
        return;
      }
    }
  };
  const auto for_kinds = [&](const Face& f, auto&& body) {
    body(f.hidden ? hidden : surface);
    if (!f.hidden && std::any_of(f.vertex.begin(), f.vertex.end(), [&](int v) { return vertices_[static_cast<std::size_t>(v)].offset > 0; })) {
      body(padded);
    }
  };
  for (Bins& bins : binned_) {
    bins.first.assign(count + 1, 0);
  }
  for (const Face& f : faces_) {
    for_kinds(f, [&](Kind kind) { for_bins(f, [&](std::size_t at) { ++binned_[kind].first[at + 1]; }); });
  }
  std::array<std::vector<int>, kinds> next;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    Bins& bins = binned_[kind];
    for (std::size_t at = 0; at < count; ++at) {
      bins.first[at + 1] += bins.first[at];
    }
    bins.face.resize(static_cast<std::size_t>(bins.first.back()));
    next[kind].assign(bins.first.begin(), bins.first.end() - 1);
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    for_kinds(faces_[f], [&](Kind kind) { for_bins(faces_[f], [&](std::size_t at) { binned_[kind].face[static_cast<std::size_t>(next[kind][at]++)] = static_cast<int>(f); }); });
  }
}

bool LayerBody<2>::outside_of(const OnFace& at, const std::array<double, 2>& point, std::array<double, 2>& outward) const {
  const Face& face = faces_[static_cast<std::size_t>(at.face)];
  const Vertex &va = vertices_[static_cast<std::size_t>(face.vertex[0])], &vb = vertices_[static_cast<std::size_t>(face.vertex[1])];
  const auto along = minus(vb.x, va.x), from = minus(point, va.x);
  const std::array<double, 2> off = {from[0] - at.part * along[0], from[1] - at.part * along[1]};
  const bool at_a = at.part == 0 && !va.end, at_b = at.part == 1 && !vb.end;
  outward = at_a ? va.normal : at_b ? vb.normal : face.normal;
  const double distance = std::sqrt(at.square), scale = std::sqrt(dot(along, along));
  const bool outside = dot(off, outward) > 0;
  if (distance > 1e-9 * scale && (at_a || at_b)) {
    for (std::size_t d = 0; d < 2; ++d) {
      outward[d] = (outside ? 1 : -1) * off[d] / distance;
    }
  } else {
    const double length = std::sqrt(dot(outward, outward));
    for (std::size_t d = 0; d < 2; ++d) {
      outward[d] = length > 0 ? outward[d] / length : face.normal[d];
    }
  }
  return outside;
}

LayerBody<2>::OnFace LayerBody<2>::on_face(int f, const std::array<double, 2>& point) const {
  const Face& face = faces_[static_cast<std::size_t>(f)];
  const Vertex &va = vertices_[static_cast<std::size_t>(face.vertex[0])], &vb = vertices_[static_cast<std::size_t>(face.vertex[1])];
  const auto along = minus(vb.x, va.x), from = minus(point, va.x);
  double t = dot(from, along) / dot(along, along);
  t = va.end && t < 0 ? t : std::max(t, 0.0);
  t = vb.end && t > 1 ? t : std::min(t, 1.0);
  const std::array<double, 2> off = {from[0] - t * along[0], from[1] - t * along[1]};
  return {dot(off, off), t, f};
}

template <class Body> bool LayerBody<2>::any_near(const std::array<double, 2>& point, double far, Kind kind, Body&& body) const {
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
  const Bins& bins = binned_[kind];
  for (int y = a[1]; y <= b[1]; ++y) {
    for (int x = a[0]; x <= b[0]; ++x) {
      const auto at = static_cast<std::size_t>(y * bins_[0] + x);
      for (int q = bins.first[at]; q < bins.first[at + 1]; ++q) {
        if (body(bins.face[static_cast<std::size_t>(q)])) {
          return true;
        }
      }
    }
  }
  return false;
}

bool LayerBody<2>::foot(const std::array<double, 2>& point, double reach, BodyFoot<2>& out, int side) const {
  if (faces_.empty()) {
    return false;
  }
  const auto nearest = [&](double within) {
    OnFace best;
    any_near(point, within, surface, [&](int f) {
      const bool counts = side < 0 || faces_[static_cast<std::size_t>(f)].side != 1 - side;
      const OnFace on = counts ? on_face(f, point) : OnFace{};
      best = on.before(best) ? on : best;
      return false;
    });
    return best.square <= within * within ? best : OnFace{};
  };
  OnFace at = nearest(std::min(reach, bin_)); // few bins
  at = at.face < 0 ? nearest(reach) : at;
  const double far = reach + thickest_;
  if (at.face < 0 && any_near(point, far, padded, [](int) { return true; })) { // farther, but made thicker
    at = nearest(far);
  }
  if (at.face < 0) {
    return false;
  }
  const bool in_front = outside_of(at, point, out.normal);
  // Nearer to what is hidden: in a layer, or in a slit that is closed. Of a given side what counts is how the point stands to that.
  const bool inside = !in_front || (side < 0 && any_near(point, std::sqrt(at.square), hidden, [&](int f) { return on_face(f, point).square < nearer * at.square; }));
  const Face& face = faces_[static_cast<std::size_t>(at.face)];
  const Vertex &va = vertices_[static_cast<std::size_t>(face.vertex[0])], &vb = vertices_[static_cast<std::size_t>(face.vertex[1])];
  const double distance = std::sqrt(at.square), part = at.part;
  if (inside == in_front) { // the way to it leads through a slit or another layer
    for (std::size_t d = 0; d < 2; ++d) {
      const double off = point[d] - va.x[d] - part * (vb.x[d] - va.x[d]);
      out.normal[d] = distance > 0 ? (inside ? -1 : 1) * off / distance : out.normal[d];
    }
  }
  out.node = {va.node[0], va.node[1], vb.node[0], vb.node[1]};
  out.weight = {(1 - part) * va.weight[0], (1 - part) * va.weight[1], part * vb.weight[0], part * vb.weight[1]};
  out.level = (inside ? -distance : distance) - ((1 - part) * va.offset + part * vb.offset);
  out.side = face.side;
  return std::abs(out.level) <= reach;
}

bool LayerBody<2>::near(double low, double high, double reach) const {
  const double far = reach + thickest_;
  return !faces_.empty() && high > low_[1] - far && low < high_[1] + far;
}

} // namespace ballast
