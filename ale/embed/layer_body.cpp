#include "ale/embed/layer_body.hpp"

#include "ale/embed/outline.hpp"

#include <algorithm>
#include <cmath>

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

} // namespace

/// The body lies to the left.
template <> void LayerBody<2>::add_faces(const LayerStack<2>& s, const std::vector<char>& alive, const std::vector<double>& least) {
  for (const Outline& o : find_outlines(s, alive, least)) {
    const auto add = [&](const std::vector<OutlineVertex>& chain) {
      const auto first = static_cast<int>(vertices_.size());
      for (const OutlineVertex& v : chain) {
        vertices_.push_back({v.node, v.weight, v.x, v.offset, {}, false});
      }
      return first;
    };
    const int lower = add(o.lower), upper = add(o.upper);
    const int lower_end = lower + static_cast<int>(o.lower.size()) - 1, upper_end = upper + static_cast<int>(o.upper.size()) - 1;
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
    for (int k = lower; k < lower_end; ++k) {
      face(k, k + 1, o.lower[static_cast<std::size_t>(k - lower)].side);
    }
    if (!o.goes_on_high) {
      face(lower_end, upper_end, 2);
    }
    for (int k = upper_end; k > upper; --k) {
      face(k, k - 1, o.upper[static_cast<std::size_t>(k - 1 - upper)].side);
    }
    if (!o.goes_on_low) {
      face(upper, lower, 2);
    }
    for (const std::vector<OutlineVertex>& gap : o.gaps) {
      const int first = add(gap), count = static_cast<int>(gap.size());
      for (int k = 0; k < count; ++k) {
        face(first + k, first + (k + 1) % count, gap[static_cast<std::size_t>(k)].side);
      }
    }
    vertices_[static_cast<std::size_t>(lower)].end = vertices_[static_cast<std::size_t>(upper)].end = o.goes_on_low;
    vertices_[static_cast<std::size_t>(lower_end)].end = vertices_[static_cast<std::size_t>(upper_end)].end = o.goes_on_high;
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
  out.node = {va.node[0], va.node[1], vb.node[0], vb.node[1]};
  out.weight = {(1 - best_part) * va.weight[0], (1 - best_part) * va.weight[1], best_part * vb.weight[0], best_part * vb.weight[1]};
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
