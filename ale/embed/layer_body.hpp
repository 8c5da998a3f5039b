// LayerBody: a stack of layers as what lies in a mesh's way, its surface and the signed distance to it.
//
// A point is in the body if it is in a layer, or in a slit between two that is too narrow for a mesh (ale/embed/outline). The
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
  static constexpr int most = 2 * Dim; ///< two nodes a vertex of the face
  double level = 0;                        ///< signed distance, m: positive outside
  std::array<double, Dim> normal = {};     ///< its gradient, a unit vector
  std::array<std::size_t, most> node = {}; ///< of the stack, that carry the foot
  std::array<double, most> weight = {};    ///< their sum is one
  int side = 0;                            ///< 0: on the lower face, 1: upper, 2: rim
};

template <int Dim> class LayerBody {
public:
  /// The outer faces of a stack as it stands. `alive`: the elements that count; `least_thickness` (m) by node of a plane; `bin` (m): about the distance at which points
  /// are asked for.
  LayerBody(const LayerStack<Dim>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, double bin);

  /// The foot of a point if it is within `reach` (m) of the body's faces. Sides alike: the lower-numbered face. `side` 0 or 1: on that
  /// side's faces or a rim's, however far inside.
  bool foot(const std::array<double, Dim>& point, double reach, BodyFoot<Dim>& out, int side = -1) const;

  /// Is a point inside, however far from the faces?
  bool inside(const std::array<double, Dim>& point) const;

  /// Is a point within `reach` of the box around the faces? Beyond ends that go on, too.
  bool near(const std::array<double, Dim>& point, double reach) const;

  /// m: the farthest that feet are asked for.
  void set_longest_reach(double reach) { longest_reach_ = reach; }
  double longest_reach() const { return longest_reach_; }

  bool empty() const { return faces_.empty(); }

private:
  struct Vertex {
    std::array<std::size_t, 2> node;
    std::array<double, 2> weight;
    std::array<double, Dim> x;
    double offset;                 ///< m, outward: what the body is made thicker
    std::array<double, Dim> normal; ///< sum of its faces', not unit
    bool end = false;              ///< beyond it the face goes on straight: what holds the stack's edge
  };
  struct Face {
    std::array<int, Dim> vertex;
    std::array<double, Dim> normal; ///< unit
    int side;
    bool hidden; ///< under another layer: no part of the body's surface
  };

  /// The point of a face nearest to another.
  struct OnFace {
    double square = std::numeric_limits<double>::infinity(), part = 0; ///< m2; of the way along the face
    int face = -1;
    bool before(const OnFace& other) const { return square < other.square || (square == other.square && face < other.face); }
  };
  OnFace on_face(int face, const std::array<double, Dim>& point) const;
  /// Is `point` outside of the layer of the face it is nearest to, and which way is out?
  bool outside_of(const OnFace& at, const std::array<double, Dim>& point, std::array<double, Dim>& outward) const;

  enum Kind : std::size_t { surface, hidden, padded, kinds }; ///< padded: of the surface, what is made thicker
  /// Calls body(face) for faces of a kind in bins within `far` of a point, until it returns true.
  template <class Body> bool any_near(const std::array<double, Dim>& point, double far, Kind kind, Body&& body) const;

  void add_faces(const LayerStack<Dim>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness);
  void fill_bins(double bin);

  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;
  std::array<double, Dim> low_ = {}, high_ = {};
  std::array<int, Dim> bins_ = {};
  double bin_ = 0, thickest_ = 0, longest_reach_ = 0; ///< m; thickest: what the body is made thicker at most
  struct Bins {
    std::vector<int> first, face;
  };
  std::array<Bins, kinds> binned_;
};

} // namespace ballast
