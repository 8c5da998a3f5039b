// A solid of voxels: equal boxes of a block along x, y, z, each filled or not.
//
// Only the smallest block around the filled ones is kept, a bit a voxel. Faces keep the places that they have in the whole image,
// plane i at corner + i spacing, so that solids of one image's labels meet at the same numbers.
#pragma once

#include "problems/shapes.hpp"

#include <cstddef>
#include <vector>

namespace ballast {

using VoxelIndex = std::array<std::ptrdiff_t, 3>;

class VoxelSolid {
public:
  /// `filled`: of all size[0] size[1] size[2] voxels, x fastest, at least one of them; corner and spacing (> 0) in m.
  VoxelSolid(const VoxelIndex& size, const Point& corner, const Point& spacing, const std::vector<bool>& filled);

  const Bounds& box() const { return box_; }
  std::size_t count() const { return count_; }
  double volume() const { return static_cast<double>(count_) * spacing_[0] * spacing_[1] * spacing_[2]; } ///< m3

  bool contains(const Point& p) const { return filled(voxel_at(p)); }
  /// Volume shared with the box lo..hi, m3: exact but for rounding. Time goes with the voxels in the box.
  double overlap(const Point& lo, const Point& hi) const;
  /// As signed_distance: a lower bound of the distance to the surface, 0 only at voxels that have one.
  double distance(const Point& p) const;
  /// Planes between voxels that cross axis k between lo and hi.
  void planes(std::size_t k, double lo, double hi, std::vector<double>& out) const;
  /// Where the line through p along axis k goes in or out, between lo and hi.
  void changes(const Point& p, std::size_t k, double lo, double hi, std::vector<double>& out) const;

  /// The same with the image's corner there.
  VoxelSolid moved(const Point& corner_at) const;
  /// Turned by right angles as well; `corner_at`: where the image's corner comes to lie.
  VoxelSolid turned(const std::array<Point, 3>& turn, const Point& corner_at) const;
  const Point& corner() const { return corner_; }

private:
  double plane(std::size_t k, std::ptrdiff_t i) const { return corner_[k] + static_cast<double>(i) * spacing_[k]; }
  VoxelIndex voxel_at(const Point& p) const;
  bool filled(const VoxelIndex& at) const;
  /// Are all voxels within `reach` of `at` as `value` says?
  bool alike(const VoxelIndex& at, std::ptrdiff_t reach, bool value) const;
  /// Voxels from first to second (excluded) that may meet lo..hi along axis k.
  std::array<std::ptrdiff_t, 2> range(std::size_t k, double lo, double hi) const;

  VoxelIndex first_{}, size_{}; ///< of what is kept, in the whole image
  Point corner_, spacing_;      ///< of the whole image
  std::vector<bool> filled_;    ///< of what is kept
  std::size_t count_ = 0;
  Bounds box_;
};

} // namespace ballast
