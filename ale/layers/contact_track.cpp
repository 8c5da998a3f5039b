#include "ale/layers/contact_track.hpp"
#include "ale/layers/contact_vector.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

namespace {

constexpr double entry_depth = 0.1; ///< of a segment's extent: a node found deeper was there before
constexpr int longest_walk = 64;    ///< segments
constexpr double least_slide = 1e-9, least_depth = 1e-9; ///< of a segment: less is round-off

template <int Dim> using Vec = std::array<double, Dim>;

/// How many segments to walk along an axis: none inside, and past the outer edge none either.
int walk(double local, int at, int count) {
  const int by = local < -1e-9 ? std::max(static_cast<int>(std::floor(std::max(local, -16.0))), -at) : local > 1 + 1e-9 ? std::min(static_cast<int>(std::min(local, 16.0)), count - 1 - at) : 0;
  return by;
}

} // namespace

template <int Dim> void ContactTrack<Dim>::resize(int nodes) {
  const auto n = static_cast<std::size_t>(nodes);
  status.resize(n, FootStatus::lost);
  segment.resize(n, 0);
  local.resize(n, {0.5, 0.5});
  gap.resize(n);
  opening.resize(n);
  leaves.resize(n);
  current.resize(n);
  moved.resize(n, 1);
  for (std::vector<double>& c : normal) {
    c.resize(n);
  }
}

template <int Dim>
std::array<double, Dim> relative_velocity(const ContactSurface<Dim>& nodes, int node, const ContactSurface<Dim>& other, int segment, const std::array<double, 2>& local) {
  const auto corner = other.corners_of(segment);
  const auto share = corner_shares<Dim>(local);
  const auto moved = [](const ContactSurface<Dim>& s, std::size_t d, int n) { return s.weight * s.velocity[d][n] + s.fixed_at(d, n); };
  Vec<Dim> u;
  for (std::size_t d = 0; d < Dim; ++d) {
    u[d] = moved(nodes, d, node);
    for (std::size_t c = 0; c < corner.size(); ++c) {
      u[d] -= share[c] * moved(other, d, corner[c]);
    }
  }
  return u;
}

namespace {

/// Bits of the sides of its segment that a foot can come to within `reach`.
template <int Dim> unsigned char sides_near(const ContactSurface<Dim>& s, int segment, const std::array<double, 2>& local, double reach) {
  unsigned bits = 0;
  const Patch<Dim> place = places(s, segment);
  for (std::size_t axis = 0; axis < Dim - 1; ++axis) {
    const Vec<Dim> along = axis == 0 ? place.along_a(local[1]) : place.along_b(local[0]);
    const double by = reach / std::sqrt(dot(along, along));
    bits |= ((by > local[axis] ? 1U : 0U) | (by > 1 - local[axis] ? 2U : 0U)) << 2 * axis;
  }
  return static_cast<unsigned char>(bits);
}

/// A foot leaves its segment while it moves by `way`.
template <int Dim> bool goes_off(const ContactSurface<Dim>& s, int segment, const std::array<double, 2>& local, const Vec<Dim>& way) {
  const Patch<Dim> place = places(s, segment);
  bool off = false;
  for (std::size_t axis = 0; axis < Dim - 1; ++axis) {
    const Vec<Dim> along = axis == 0 ? place.along_a(local[1]) : place.along_b(local[0]);
    const double by = dot(way, along) / dot(along, along);
    off = off || (by < -least_slide && local[axis] + by < 0) || (by > least_slide && local[axis] + by > 1);
  }
  return off;
}

} // namespace

template <int Dim> void note_foot(const TrackPair<Dim>& pair, int node, int segment, const Foot<Dim>& found, ContactTrack<Dim>& track) {
  const ContactSurface<Dim>&nodes = pair.nodes, &other = pair.other;
  const double dt = pair.dt;
  const Foot<Dim> foot = orthogonal_foot<Dim>(other, segment, nodes.place(node), found);
  const auto n = static_cast<std::size_t>(node);
  track.segment[n] = segment;
  track.local[n] = foot.local;
  track.gap[n] = foot.gap;
  Vec<Dim> u = relative_velocity<Dim>(nodes, node, other, segment, track.local[n]);
  FootStatus& status = track.status[n];
  const auto past = [](double a) { return a < -1e-6 || a > 1 + 1e-6; };
  const bool tracked = status == FootStatus::front || status == FootStatus::behind, beside = status == FootStatus::beside;
  if (tracked) {
    status = foot.gap >= 0 ? FootStatus::front : status;
  } else if (foot.gap < 0 && (past(found.local[0]) || (Dim == 3 && past(found.local[1])))) {
    status = FootStatus::beside;
  } else {
    const double depth = beside ? 2 * dt * std::abs(dot(u, foot.normal)) : entry_depth * segment_extent(other, segment);
    status = foot.gap < -depth ? FootStatus::behind : FootStatus::front;
  }
  track.opening[n] = dot(u, foot.normal);
  for (std::size_t d = 0; d < Dim; ++d) {
    track.normal[d][n] = foot.normal[d];
    u[d] *= dt;
  }
  track.current[n] = 1;
  const double reach = std::sqrt(dot(u, u));
  track.leaves[n] = reach > 0 && foot.gap <= reach ? sides_near<Dim>(other, segment, track.local[n], reach) : static_cast<unsigned char>(0);
}

template <int Dim> void track_node(const TrackPair<Dim>& pair, int node, ContactTrack<Dim>& track) {
  const ContactSurface<Dim>& other = pair.other;
  const auto n = static_cast<std::size_t>(node);
  const Vec<Dim> x = pair.nodes.place(node);
  int segment = track.segment[n];
  std::array<double, 2> start = track.local[n];
  for (int step = 0; step < longest_walk; ++step) {
    const Foot<Dim> foot = find_foot<Dim>(other, segment, x, start);
    if (!foot.found) {
      break;
    }
    const int i = segment % other.segments[0], j = segment / other.segments[0];
    const int di = walk(foot.local[0], i, other.segments[0]), dj = Dim == 3 ? walk(foot.local[1], j, other.segments[1]) : 0;
    if (di == 0 && dj == 0) {
      if (touches(other, segment, foot.local) && other.there(segment)) {
        note_foot(pair, node, segment, foot, track);
      } else {
        track.status[n] = FootStatus::beside;
        track.segment[n] = segment;
        track.local[n] = {std::clamp(foot.local[0], 0.0, 1.0), std::clamp(foot.local[1], 0.0, 1.0)};
      }
      return;
    }
    segment += di + dj * other.segments[0];
    start = {std::clamp(foot.local[0] - di, 0.0, 1.0), std::clamp(foot.local[1] - dj, 0.0, 1.0)};
  }
  track.status[n] = FootStatus::lost;
}

namespace {

enum class Outlook { clear, touches, moves };

/// With the last foot's shares and normal: gap and rate; what a node in front does in this step.
template <int Dim> Outlook look_ahead(const TrackPair<Dim>& pair, int node, ContactTrack<Dim>& track) {
  const auto n = static_cast<std::size_t>(node);
  const int segment = track.segment[n];
  const std::array<double, 2> local = track.local[n];
  const ContactSurface<Dim>& other = pair.other;
  const Vec<Dim> u = relative_velocity<Dim>(pair.nodes, node, other, segment, local);
  const double slid = pair.dt * pair.dt * dot(u, u);
  track.current[n] = 0;
  track.leaves[n] = 0;
  track.opening[n] = 0;
  if (!other.there(segment)) {
    return Outlook::moves;
  }
  if (slid == 0) {
    return Outlook::clear;
  }
  track.moved[n] = 1;
  const auto corner = other.corners_of(segment);
  const auto share = corner_shares<Dim>(local);
  double gap = 0, opening = 0, size = 0;
  Vec<Dim> way; // from the old foot to where the node will be
  for (std::size_t d = 0; d < Dim; ++d) {
    way[d] = pair.nodes.position[d][node];
    for (std::size_t c = 0; c < corner.size(); ++c) {
      way[d] -= share[c] * other.position[d][corner[c]];
    }
    const double side = other.position[d][corner[1]] - other.position[d][corner[0]];
    gap += track.normal[d][n] * way[d];
    opening += track.normal[d][n] * u[d];
    size += side * side;
    way[d] += pair.dt * u[d];
  }
  track.gap[n] = gap;
  track.opening[n] = opening;
  const double next = gap + pair.dt * opening;
  double along = 0;
  for (std::size_t d = 0; d < Dim; ++d) {
    way[d] -= next * track.normal[d][n];
    along += way[d] * way[d];
  }
  const bool inside = next < 0 && next * next > least_depth * least_depth * size;
  if (!(slid < 1e-4 * size && along < 1e-3 * size) || goes_off<Dim>(other, segment, local, way)) {
    return Outlook::moves;
  }
  return inside ? Outlook::touches : Outlook::clear;
}

} // namespace

template <int Dim> void track_nodes(const TrackPair<Dim>& pair, std::array<int, 2> range, bool refresh, ContactTrack<Dim>& track) {
  for (int node = range[0]; node < range[1]; ++node) {
    const auto n = static_cast<std::size_t>(node);
    FootStatus& status = track.status[n];
    if (refresh && !on_sheet(pair.nodes, node)) {
      status = FootStatus::away;
    }
    if (status == FootStatus::away || status == FootStatus::lost || (status == FootStatus::behind && !refresh)) {
      continue;
    }
    Outlook outlook = status == FootStatus::front ? look_ahead(pair, node, track) : Outlook::moves;
    if (refresh && track.moved[n] != 0) {
      outlook = Outlook::moves;
    }
    if (outlook == Outlook::moves) {
      track.moved[n] = 0;
      track_node(pair, node, track);
    } else if (outlook == Outlook::touches) {
      note_foot(pair, node, track.segment[n], Foot<Dim>{track.local[n], track.gap[n], track.normal_at(n), true}, track);
    }
  }
}

#define BALLAST_INSTANTIATE(D)                                                                                                   \
  template struct ContactTrack<D>;                                                                                               \
  template void track_nodes<D>(const TrackPair<D>&, std::array<int, 2>, bool, ContactTrack<D>&);                                 \
  template void track_node<D>(const TrackPair<D>&, int, ContactTrack<D>&);                                                       \
  template std::array<double, D> relative_velocity<D>(const ContactSurface<D>&, int, const ContactSurface<D>&, int, const std::array<double, 2>&); \
  template void note_foot<D>(const TrackPair<D>&, int, int, const Foot<D>&, ContactTrack<D>&);
BALLAST_INSTANTIATE(2)
BALLAST_INSTANTIATE(3)
#undef BALLAST_INSTANTIATE

} // namespace ballast
