// Voxels among the shapes: distance, inside, shares, and the planes that cut boxes and voxels into boxes.
#include "problems/shape_cuts.hpp"
#include "problems/shape_geometry.hpp"
#include "problems/voxel_solid.hpp"

#include <algorithm>

namespace ballast {

double distance_to(const Voxels& v, const Point& p) {
  return v.solid->distance(p);
}

bool holds(const Voxels& v, const Point& p) {
  return v.solid->contains(p);
}

const Bounds& bounds_of(const Voxels& v) {
  return v.solid->box();
}

double covered_share(const Voxels& v, const Point& lo, const Point& hi) {
  constexpr double rounding = 1e-12;
  const Point size = hi - lo;
  const double share = v.solid->overlap(lo, hi) / (size[0] * size[1] * size[2]);
  return share < rounding ? 0.0 : share > 1 - rounding ? 1.0 : share;
}

bool has_voxels(const Shape& shape) {
  if (const auto* c = std::get_if<Combination>(&shape.form)) {
    return std::any_of(c->parts.begin(), c->parts.end(), has_voxels);
  }
  return std::holds_alternative<Voxels>(shape.form);
}

bool made_of_boxes(const Shape& shape) {
  if (const auto* c = std::get_if<Combination>(&shape.form)) {
    return std::all_of(c->parts.begin(), c->parts.end(), made_of_boxes);
  }
  return std::holds_alternative<Voxels>(shape.form) || std::holds_alternative<Box>(shape.form);
}

void box_planes(const Shape& shape, std::size_t k, double lo, double hi, std::vector<double>& out) {
  if (const auto* c = std::get_if<Combination>(&shape.form)) {
    for (const Shape& part : c->parts) {
      box_planes(part, k, lo, hi, out);
    }
  } else if (const auto* box = std::get_if<Box>(&shape.form)) {
    out.insert(out.end(), {box->from[k], box->to[k]});
  } else if (const auto* v = std::get_if<Voxels>(&shape.form)) {
    v->solid->planes(k, lo, hi, out);
  }
}

void cut(const Voxels& v, const Line& line, Cuts& cuts) {
  std::vector<double> places;
  v.solid->changes(line.p, line.k, line.lo, line.hi, places);
  for (const double t : places) {
    cuts.add(t);
  }
}

} // namespace ballast
