// Tracks on which segment of a surface a node has its foot, from step to step.
//
// Which segment: x = X(a, b) + g N(a, b), with N the interpolated normals of nodes, has one solution near the surface that is
// continuous from segment to segment, over ridges and valleys. The foot itself is then the orthogonal one on that segment's
// patch or its continuation: the gap changes at the rate n.(u_s - sum phi_k u_k) and the force along n turns nothing.
// g < 0: the node is inside, however deep. Newton's method from the last foot, then a walk from segment to segment; a node
// that has lost its foot is looked for among all segments (ale/layers/contact_search).
//
// Most nodes neither come closer nor slide far in a step: between full updates (`refresh`) the last foot's shares and normal serve
// to see that. Nodes that would come inside get the orthogonal foot anew, those that leave their segment or go far the walk.
#pragma once

#include "ale/layers/contact_foot.hpp"

#include <vector>

namespace ballast {

enum class FootStatus : char {
  away,   ///< none near; looked for when the surfaces have moved far enough
  lost,   ///< lost in this step: to be looked for now
  beside, ///< past an edge, or over a hole
  behind, ///< came in past an edge or through a hole: no contact until it is outside again
  front   ///< has its foot on the surface and its side is known
};

/// Where the nodes of one surface have their feet on another. Status, segment, local and normal carry over from step to step.
template <int Dim> struct ContactTrack {
  std::vector<FootStatus> status;
  std::vector<int> segment;
  std::vector<std::array<double, 2>> local;

  std::vector<double> gap;     ///< m, at the step's start
  std::vector<double> opening; ///< m/s: the rate of the gap over the step
  std::vector<unsigned char> leaves; ///< where it may touch: sides of its segment within the step's reach, bits low and high of axis 0, then of axis 1
  std::array<std::vector<double>, Dim> normal; ///< at the foot
  std::vector<char> current;   ///< the foot is that of this step
  std::vector<char> moved;     ///< relative to its foot, since that was found

  void resize(int nodes);
  std::array<double, Dim> normal_at(std::size_t node) const {
    std::array<double, Dim> v;
    for (std::size_t d = 0; d < Dim; ++d) {
      v[d] = normal[d][node];
    }
    return v;
  }
};

/// The foot lies on its segment, or so little past an outer edge that the segment's continuation serves: sheets whose edges
/// meet keep touching there while they bend.
template <int Dim> bool touches(const ContactSurface<Dim>& s, int segment, const std::array<double, 2>& local) {
  const std::array<int, 2> at = {segment % s.segments[0], segment / s.segments[0]};
  bool in = true;
  for (std::size_t axis = 0; axis < Dim - 1; ++axis) {
    const double low = at[axis] == 0 ? s.rim : 1e-9, high = at[axis] == s.segments[axis] - 1 ? s.rim : 1e-9;
    in = in && local[axis] >= -low && local[axis] <= 1 + high;
  }
  return in;
}

/// Two surfaces as seen by the nodes of the first.
template <int Dim> struct TrackPair {
  const ContactSurface<Dim>&nodes, &other;
  double dt;
};

/// Follows the feet of nodes [begin, end). `refresh`: all of them.
template <int Dim> void track_nodes(const TrackPair<Dim>& pair, std::array<int, 2> range, bool refresh, ContactTrack<Dim>& track);

/// Walks from a node's last foot to that of this step. Past an edge: the status says so and the last segment is kept.
template <int Dim> void track_node(const TrackPair<Dim>& pair, int node, ContactTrack<Dim>& track);

/// Velocity over the step of a node relative to its foot, m/s.
template <int Dim>
std::array<double, Dim> relative_velocity(const ContactSurface<Dim>& nodes, int node, const ContactSurface<Dim>& other, int segment, const std::array<double, 2>& local);

/// Notes a foot that find_foot gave: side, gap and rate of the orthogonal one. A node that comes in past an edge or a hole, or
/// that was looked for, counts as behind if it is deeper than what it can have gone since it was outside: two steps' approach, or a
/// tenth of the segment; past an edge it only begins to touch outside.
template <int Dim> void note_foot(const TrackPair<Dim>& pair, int node, int segment, const Foot<Dim>& foot, ContactTrack<Dim>& track);

} // namespace ballast
