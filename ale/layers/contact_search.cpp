#include "ale/layers/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast {

namespace {

template <int Dim> using Vec = std::array<double, Dim>;

/// Segments by the bucket of their centre. A bucket is twice the largest extent wide: a segment whose foot lies within its
/// extent of a point has its centre in one of the buckets around the point.
template <int Dim> class Buckets {
public:
  explicit Buckets(const ContactSurface<Dim>& s) : surface_(s) {
    low_.fill(std::numeric_limits<double>::max());
    Vec<Dim> high;
    high.fill(-std::numeric_limits<double>::max());
    double extent = 0;
    for (int e = 0; e < s.segment_count(); ++e) {
      if (s.there(e)) {
        const Vec<Dim> x = centre(e);
        extent = std::max(extent, segment_extent(s, e));
        for (std::size_t d = 0; d < Dim; ++d) {
          low_[d] = std::min(low_[d], x[d]);
          high[d] = std::max(high[d], x[d]);
        }
      }
    }
    width_ = extent > 0 ? 2 * extent : 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      width_ = std::max(width_, (high[d] - low_[d]) / most_along);
    }
    std::size_t total = 1;
    for (std::size_t d = 0; d < Dim; ++d) {
      count_[d] = high[d] >= low_[d] ? static_cast<int>((high[d] - low_[d]) / width_) + 1 : 1;
      total *= static_cast<std::size_t>(count_[d]);
    }
    sort(total);
  }

  Vec<Dim> centre(int segment) const {
    Vec<Dim> x{};
    const auto corner = surface_.corners_of(segment);
    for (const int c : corner) {
      for (std::size_t d = 0; d < Dim; ++d) {
        x[d] += surface_.position[d][c] / static_cast<double>(corner.size());
      }
    }
    return x;
  }

  /// Calls visit(segment) for the segments in the buckets around a point.
  template <class Visit> void around(const Vec<Dim>& x, Visit&& visit) const {
    std::array<std::array<int, 2>, 3> range = {{{0, 0}, {0, 0}, {0, 0}}};
    for (std::size_t d = 0; d < Dim; ++d) {
      const double at = (x[d] - low_[d]) / width_;
      if (!(at > -1 && at < count_[d] + 1)) {
        return;
      }
      const int b = static_cast<int>(std::floor(at));
      range[d] = {std::max(b - 1, 0), std::min(b + 1, count_[d] - 1)};
    }
    for (int k = range[2][0]; k <= range[2][1]; ++k) {
      for (int j = range[1][0]; j <= range[1][1]; ++j) {
        for (int i = range[0][0]; i <= range[0][1]; ++i) {
          const std::size_t b = bucket({i, j, k});
          for (std::size_t e = first_[b]; e < first_[b + 1]; ++e) {
            visit(segment_[e]);
          }
        }
      }
    }
  }

private:
  std::size_t bucket(const std::array<int, 3>& at) const {
    std::size_t b = 0;
    for (std::size_t d = Dim; d-- > 0;) {
      b = b * static_cast<std::size_t>(count_[d]) + static_cast<std::size_t>(at[d]);
    }
    return b;
  }
  std::size_t bucket_of(int segment) const {
    std::array<int, 3> at = {0, 0, 0};
    const Vec<Dim> x = centre(segment);
    for (std::size_t d = 0; d < Dim; ++d) {
      at[d] = std::min(static_cast<int>((x[d] - low_[d]) / width_), count_[d] - 1);
    }
    return bucket(at);
  }
  void sort(std::size_t total) {
    first_.assign(total + 1, 0);
    std::vector<std::size_t> of(static_cast<std::size_t>(surface_.segment_count()), total);
    for (int e = 0; e < surface_.segment_count(); ++e) {
      if (surface_.there(e)) {
        of[static_cast<std::size_t>(e)] = bucket_of(e);
        ++first_[of[static_cast<std::size_t>(e)] + 1];
      }
    }
    for (std::size_t b = 0; b < total; ++b) {
      first_[b + 1] += first_[b];
    }
    segment_.resize(first_[total]);
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (int e = 0; e < surface_.segment_count(); ++e) {
      if (surface_.there(e)) {
        segment_[next[of[static_cast<std::size_t>(e)]]++] = e;
      }
    }
  }

  static constexpr double most_along = 200; ///< buckets along an axis

  const ContactSurface<Dim>& surface_;
  Vec<Dim> low_;
  double width_ = 1;
  std::array<int, 3> count_ = {1, 1, 1};
  std::vector<std::size_t> first_;
  std::vector<int> segment_;
};

template <int Dim> void search_foot(const TrackPair<Dim>& pair, int node, const Buckets<Dim>& buckets, ContactTrack<Dim>& track) {
  const ContactSurface<Dim>& other = pair.other;
  const Vec<Dim> x = pair.nodes.place(node);
  Foot<Dim> best;
  int segment = -1, nearest = -1;
  double closest = std::numeric_limits<double>::max();
  buckets.around(x, [&](int e) {
    const Vec<Dim> c = buckets.centre(e);
    double square = 0;
    for (std::size_t d = 0; d < Dim; ++d) {
      square += (x[d] - c[d]) * (x[d] - c[d]);
    }
    if (square < closest) {
      closest = square;
      nearest = e;
    }
    const double extent = segment_extent(other, e);
    if (square > 4 * extent * extent) {
      return;
    }
    const Foot<Dim> foot = find_foot<Dim>(other, e, x, {0.5, 0.5});
    if (foot.found && touches(other, e, foot.local) && std::abs(foot.gap) <= extent && (segment < 0 || std::abs(foot.gap) < std::abs(best.gap))) {
      best = foot;
      segment = e;
    }
  });
  const auto n = static_cast<std::size_t>(node);
  if (segment >= 0) {
    note_foot(pair, node, segment, best, track);
    return;
  }
  const bool was_away = track.status[n] == FootStatus::away;
  track.status[n] = nearest >= 0 && was_away ? FootStatus::beside : FootStatus::away;
  if (nearest >= 0) {
    track.segment[n] = nearest;
    track.local[n] = {0.5, 0.5};
  }
}

} // namespace

template <int Dim> void search_feet(const TrackPair<Dim>& pair, bool all, ContactTrack<Dim>& track) {
  const Buckets<Dim> buckets(pair.other);
  for (int node = 0; node < pair.nodes.node_count(); ++node) {
    const auto n = static_cast<std::size_t>(node);
    const FootStatus status = track.status[n];
    if (status == FootStatus::lost || (all && status == FootStatus::away && on_sheet(pair.nodes, node))) {
      search_foot(pair, node, buckets, track);
    }
  }
}

template <int Dim> double search_again_after(const ContactSurface<Dim>& other) {
  double smallest = std::numeric_limits<double>::max();
  for (int e = 0; e < other.segment_count(); ++e) {
    if (other.there(e)) {
      smallest = std::min(smallest, segment_extent(other, e));
    }
  }
  return 0.05 * smallest;
}

template void search_feet<2>(const TrackPair<2>&, bool, ContactTrack<2>&);
template void search_feet<3>(const TrackPair<3>&, bool, ContactTrack<3>&);
template double search_again_after<2>(const ContactSurface<2>&);
template double search_again_after<3>(const ContactSurface<3>&);

} // namespace ballast
