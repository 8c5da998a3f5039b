// LayerBody: a stack of layers as what lies in a mesh's way, its surface and the signed distance to it.
//
// A point is in the body if it is in a layer, or in a slit between two that is too narrow for a mesh (ale/embed/outline, in 3D ale/embed/layer_skin). The
// surface is what is left of the layers' faces. A mesh sees a body only if it is thick enough: a cell must not have open corners on both
// sides, so a stack thinner than `least_thickness` is taken as that thick, the room added to its lower face
// first where it has lost elements. Distances are to straight faces; the foot says which nodes carry it.
#pragma once

#include "ale/layers/layer_stack.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace ballast {

/// Where a point stands to a body.
template <int Dim> struct BodyFoot {
  static constexpr int most = 4; ///< two at either end of a stretch of an outline; a quadrilateral's corners
  double level = 0;                        ///< signed distance, m: positive outside
  std::array<double, Dim> normal = {};     ///< its gradient, a unit vector
  std::array<std::size_t, most> node = {}; ///< of the stack, that carry the foot
  std::array<double, most> weight = {};    ///< their sum is one
  int side = 0;                            ///< 0: on the lower face, 1: upper, 2: rim
};

/// The outer faces of a stack.
template <int Dim> class LayerBody;

template <> class LayerBody<2> {
public:
  /// The outer faces of a stack as it stands. `alive`: the elements that count; `least_thickness` (m) by node of a plane; `bin` (m): about the distance at which points
  /// are asked for. `own`: as in ale/embed/outline.
  LayerBody(const LayerStack<2>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, double bin, const std::vector<double>& own = {});

  /// The foot of a point if it is within `reach` (m) of the body's faces. Sides alike: the lower-numbered face. `side` 0 or 1: on that
  /// side's faces or a rim's, however far inside.
  bool foot(const std::array<double, 2>& point, double reach, BodyFoot<2>& out, int side = -1) const;

  /// May a face be in the box around a point, `box` (m) to either side along each axis? For skipping points that are far.
  bool may_touch(const std::array<double, 2>&, const std::array<double, 2>&) const { return true; }

  /// Is anything between two places across the layers (m) within `reach` of the faces, wherever along them?
  bool near(double low, double high, double reach) const;

  /// m: the farthest that feet are asked for.
  void set_longest_reach(double reach) { longest_reach_ = reach; }
  double longest_reach() const { return longest_reach_; }

  bool empty() const { return faces_.empty(); }

private:
  struct Vertex {
    std::array<std::size_t, 2> node;
    std::array<double, 2> weight;
    std::array<double, 2> x;
    double offset;                 ///< m, outward: what the body is made thicker
    std::array<double, 2> normal; ///< sum of its faces', not unit
    bool end = false;              ///< beyond it the face goes on straight: what holds the stack's edge
  };
  struct Face {
    std::array<int, 2> vertex;
    std::array<double, 2> normal; ///< unit
    int side;
    bool hidden; ///< under another layer: no part of the body's surface
  };

  /// The point of a face nearest to another.
  struct OnFace {
    double square = std::numeric_limits<double>::infinity(), part = 0; ///< m2; of the way along the face
    int face = -1;
    bool before(const OnFace& other) const { return square < other.square || (square == other.square && face < other.face); }
  };
  OnFace on_face(int face, const std::array<double, 2>& point) const;
  /// Is `point` outside of the layer of the face it is nearest to, and which way is out?
  bool outside_of(const OnFace& at, const std::array<double, 2>& point, std::array<double, 2>& outward) const;

  enum Kind : std::size_t { surface, hidden, padded, kinds }; ///< padded: of the surface, what is made thicker
  /// Calls body(face) for faces of a kind in bins within `far` of a point, until it returns true.
  template <class Body> bool any_near(const std::array<double, 2>& point, double far, Kind kind, Body&& body) const;

  void add_faces(const LayerStack<2>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, const std::vector<double>& own);
  void fill_bins(double bin);

  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;
  std::array<double, 2> low_ = {}, high_ = {};
  std::array<int, 2> bins_ = {};
  double bin_ = 0, thickest_ = 0, longest_reach_ = 0; ///< m; thickest: what the body is made thicker at most
  struct Bins {
    std::vector<int> first, face;
  };
  std::array<Bins, kinds> binned_;
};

} // namespace ballast

#include "ale/embed/layer_body_3d.hpp"
