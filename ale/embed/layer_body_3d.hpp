// LayerBody<3>, included by ale/embed/layer_body.hpp: the skin's quadrilaterals as four triangles each around their middles, found by
// columns across the layers.
#pragma once

#include "ale/embed/layer_body.hpp"
#include "ale/embed/layer_skin.hpp"

namespace ballast {

/// As in a plane (layer_body.hpp). Past an edge that is held, or a plane of symmetry, faces go on straight across it.
template <> class LayerBody<3> {
public:
  LayerBody(const LayerStack<3>& stack, const std::vector<char>& alive, const std::vector<double>& least_thickness, double bin, ThreadPool& pool);

  /// `start`: a patch to look at first (a neighbour's foot), or -1; becomes the foot's. It changes nothing but the time taken.
  bool foot(const std::array<double, 3>& point, double reach, BodyFoot<3>& out, int side = -1, int* start = nullptr) const;
  bool may_touch(const std::array<double, 3>& point, const std::array<double, 3>& box) const;
  bool near(double low, double high, double reach) const;

  void set_longest_reach(double reach) { longest_reach_ = reach; }
  double longest_reach() const { return longest_reach_; }

  bool empty() const { return patches_.empty(); }

private:
  using Point = std::array<double, 3>;

  struct Patch {
    std::array<Point, 5> x; ///< corners, middle
    Point low, high;        ///< m: its box
    double size, offset;    ///< m: largest edge of that; largest offset
  };
  /// The point of a patch nearest to another.
  struct OnPatch {
    double square = std::numeric_limits<double>::infinity(); ///< m2
    int patch = -1, edge = 0;                                ///< triangle: from corner `edge` to the next one to the middle
    std::array<double, 3> weight = {};                       ///< of these three
    bool before(const OnPatch& other) const { return square < other.square || (square == other.square && patch < other.patch); }
  };
  OnPatch on_patch(int patch, const Point& point) const;
  /// Where in its quadrilateral that is.
  std::array<double, 2> place(const OnPatch& at) const;
  /// Of the quadrilateral's nodes: the point lies on a triangle, so they are not those of its place on a bent one.
  std::array<double, 4> weights(const OnPatch& at) const;
  /// Is `point` outside of the layer of the patch it is nearest to, and which way is out?
  bool outside_of(const OnPatch& at, const Point& point, Point& outward) const;

  enum Kind : std::size_t { lower, upper, rim, hidden, padded, kinds }; ///< the surface by side; padded: of it, what is made thicker
  struct Box {
    Point low, high; ///< m
  };
  /// Of patches whose middles lie in them.
  struct Columns {
    std::vector<int> first, patch;
    std::vector<Box> box;
    double offset = 0; ///< m: largest
  };
  /// Calls body(patch) for those of a kind in columns that may be nearer than the square root of `square` (m2, body may lower it), until it returns true.
  template <class Body> bool any_near(const Point& point, const double& square, Kind kind, Body&& body) const;
  /// The nearest patch of the surface within the square root of `square`, m2; of a given side: not of the other one's faces. `start` is looked at first.
  OnPatch nearest(const Point& point, double square, int side, int start = -1) const;

  Patch measure(const SkinPatch& p) const;
  void fill_columns();
  /// The column that x lies in along an axis; beyond the first or last: that one.
  std::size_t column(std::size_t axis, double x) const;
  /// First and last one along both axes that may have patches so near to a point.
  std::array<std::array<std::size_t, 2>, 2> columns(const Point& point, std::array<double, 2> reach) const;
  Point held(Point point) const;

  Skin skin_;
  std::vector<Patch> patches_;
  std::array<double, 2> hold_low_, hold_high_; ///< m: held edges
  std::array<double, 3> low_ = {}, high_ = {}; ///< m: across the layers only
  std::array<std::vector<double>, 2> ends_;    ///< m: of columns, lines of the stack at rest
  std::array<double, 2> overhang_ = {0, 0};    ///< m: of patches beyond their columns, at most
  double thickest_ = 0, longest_reach_ = 0;    ///< m
  std::array<Columns, kinds> binned_;
};

} // namespace ballast
