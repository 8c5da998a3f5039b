#include "problems/voxel_solid.hpp"

#include "problems/shape_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace ballast {

VoxelSolid::VoxelSolid(const VoxelIndex& size, const Point& corner, const Point& spacing, const std::vector<bool>& all)
    : corner_(corner), spacing_(spacing) {
  VoxelIndex lo = size, hi{};
  std::size_t at = 0;
  for (std::ptrdiff_t z = 0; z < size[2]; ++z) {
    for (std::ptrdiff_t y = 0; y < size[1]; ++y) {
      for (std::ptrdiff_t x = 0; x < size[0]; ++x, ++at) {
        if (all[at]) {
          lo = {std::min(lo[0], x), std::min(lo[1], y), std::min(lo[2], z)};
          hi = {std::max(hi[0], x + 1), std::max(hi[1], y + 1), std::max(hi[2], z + 1)};
        }
      }
    }
  }
  first_ = lo;
  for (std::size_t k = 0; k < 3; ++k) {
    size_[k] = hi[k] - lo[k];
    box_.lo[k] = plane(k, lo[k]);
    box_.hi[k] = plane(k, hi[k]);
  }
  filled_.reserve(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]));
  for (std::ptrdiff_t z = lo[2]; z < hi[2]; ++z) {
    for (std::ptrdiff_t y = lo[1]; y < hi[1]; ++y) {
      const auto row = all.begin() + (z * size[1] + y) * size[0];
      filled_.insert(filled_.end(), row + lo[0], row + hi[0]);
      count_ += static_cast<std::size_t>(std::count(row + lo[0], row + hi[0], true));
    }
  }
}

VoxelIndex VoxelSolid::voxel_at(const Point& p) const {
  VoxelIndex at{};
  for (std::size_t k = 0; k < 3; ++k) { // kept within what a whole number holds: one beyond the block is outside like any
    const double i = std::floor((p[k] - corner_[k]) / spacing_[k]);
    at[k] = static_cast<std::ptrdiff_t>(std::clamp(i, static_cast<double>(first_[k] - 1), static_cast<double>(first_[k] + size_[k])));
  }
  return at;
}

bool VoxelSolid::filled(const VoxelIndex& at) const {
  std::array<std::size_t, 3> i{}, n{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (at[k] < first_[k] || at[k] >= first_[k] + size_[k]) {
      return false;
    }
    i[k] = static_cast<std::size_t>(at[k] - first_[k]);
    n[k] = static_cast<std::size_t>(size_[k]);
  }
  return filled_[(i[2] * n[1] + i[1]) * n[0] + i[0]];
}

std::array<std::ptrdiff_t, 2> VoxelSolid::range(std::size_t k, double lo, double hi) const {
  const auto least = static_cast<double>(first_[k]), most = static_cast<double>(first_[k] + size_[k]);
  const double from = std::floor((lo - corner_[k]) / spacing_[k]) - 1, to = std::ceil((hi - corner_[k]) / spacing_[k]) + 1;
  return {static_cast<std::ptrdiff_t>(std::clamp(from, least, most)), static_cast<std::ptrdiff_t>(std::clamp(to, least, most))};
}

double VoxelSolid::overlap(const Point& lo, const Point& hi) const {
  std::array<std::array<std::ptrdiff_t, 2>, 3> in{};
  std::array<std::vector<double>, 3> widths;
  for (std::size_t k = 0; k < 3; ++k) {
    in[k] = range(k, lo[k], hi[k]);
    for (std::ptrdiff_t i = in[k][0]; i < in[k][1]; ++i) {
      widths[k].push_back(std::max(0.0, std::min(hi[k], plane(k, i + 1)) - std::max(lo[k], plane(k, i))));
    }
  }
  double volume = 0;
  for (std::size_t z = 0; z < widths[2].size(); ++z) {
    double slice = 0;
    for (std::size_t y = 0; y < widths[1].size() && widths[2][z] > 0; ++y) {
      double row = 0;
      const std::ptrdiff_t start = ((in[2][0] + static_cast<std::ptrdiff_t>(z) - first_[2]) * size_[1] + in[1][0] + static_cast<std::ptrdiff_t>(y) - first_[1]) * size_[0];
      const auto bits = filled_.begin() + start + in[0][0] - first_[0];
      for (std::size_t x = 0; x < widths[0].size() && widths[1][y] > 0; ++x) {
        row += bits[static_cast<std::ptrdiff_t>(x)] ? widths[0][x] : 0.0;
      }
      slice += row * widths[1][y];
    }
    volume += slice * widths[2][z];
  }
  return volume;
}

bool VoxelSolid::alike(const VoxelIndex& at, std::ptrdiff_t reach, bool value) const {
  VoxelIndex from{}, to{};
  for (std::size_t k = 0; k < 3; ++k) {
    from[k] = std::max(at[k] - reach, first_[k]);
    to[k] = std::min(at[k] + reach + 1, first_[k] + size_[k]);
    if (value && to[k] - from[k] != 2 * reach + 1) {
      return false; // beyond the block nothing is filled
    }
  }
  for (std::ptrdiff_t z = from[2]; z < to[2]; ++z) {
    for (std::ptrdiff_t y = from[1]; y < to[1]; ++y) {
      for (std::ptrdiff_t x = from[0]; x < to[0]; ++x) {
        if (filled({x, y, z}) != value) {
          return false;
        }
      }
    }
  }
  return true;
}

double VoxelSolid::distance(const Point& p) const {
  Point beyond{};
  for (std::size_t k = 0; k < 3; ++k) {
    beyond[k] = std::max({0.0, box_.lo[k] - p[k], p[k] - box_.hi[k]});
  }
  const double outside = std::sqrt(dot(beyond, beyond));
  if (outside > 0) {
    return outside;
  }
  const VoxelIndex at = voxel_at(p);
  const bool value = filled(at);
  constexpr std::ptrdiff_t furthest = 8; // voxels: further is not looked, and not claimed
  std::ptrdiff_t reach = 0;
  while (2 * reach <= furthest && alike(at, std::max<std::ptrdiff_t>(1, 2 * reach), value)) {
    reach = std::max<std::ptrdiff_t>(1, 2 * reach);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const double own = std::min(p[k] - plane(k, at[k]), plane(k, at[k] + 1) - p[k]);
    least = std::min(least, std::max(0.0, own) + static_cast<double>(reach) * spacing_[k]);
  }
  return value ? -least : least;
}

void VoxelSolid::planes(std::size_t k, double lo, double hi, std::vector<double>& out) const {
  const auto in = range(k, lo, hi);
  for (std::ptrdiff_t i = in[0]; i <= in[1]; ++i) {
    if (plane(k, i) > lo && plane(k, i) < hi) {
      out.push_back(plane(k, i));
    }
  }
}

void VoxelSolid::changes(const Point& p, std::size_t k, double lo, double hi, std::vector<double>& out) const {
  VoxelIndex at = voxel_at(p);
  const auto in = range(k, lo, hi);
  bool before = false;
  for (std::ptrdiff_t i = in[0]; i <= in[1]; ++i) {
    at[k] = i;
    const bool now = i < in[1] && filled(at);
    if (now != before) {
      out.push_back(plane(k, i));
    }
    before = now;
  }
}

VoxelSolid VoxelSolid::moved(const Point& corner_at) const {
  VoxelSolid out = *this;
  out.corner_ = corner_at;
  for (std::size_t k = 0; k < 3; ++k) {
    out.box_.lo[k] = out.plane(k, first_[k]);
    out.box_.hi[k] = out.plane(k, first_[k] + size_[k]);
  }
  return out;
}

VoxelSolid VoxelSolid::turned(const std::array<Point, 3>& turn, const Point& corner_at) const {
  VoxelIndex size{}, step{};
  Point corner = corner_at, spacing{};
  std::ptrdiff_t start = 0, next = 1;
  for (std::size_t from = 0; from < 3; ++from) { // axis `from` comes to lie along axis `to`
    std::size_t to = 0;
    while (turn[to][from] == 0) {
      ++to;
    }
    const bool up = turn[to][from] > 0;
    size[to] = size_[from];
    spacing[to] = spacing_[from];
    corner[to] += up ? static_cast<double>(first_[from]) * spacing_[from] : -static_cast<double>(first_[from] + size_[from]) * spacing_[from];
    step[to] = up ? next : -next;
    start += up ? 0 : (size_[from] - 1) * next;
    next *= size_[from];
  }
  std::vector<bool> filled;
  filled.reserve(filled_.size());
  for (std::ptrdiff_t z = 0; z < size[2]; ++z) {
    for (std::ptrdiff_t y = 0; y < size[1]; ++y) {
      for (std::ptrdiff_t x = 0; x < size[0]; ++x) {
        filled.push_back(filled_[static_cast<std::size_t>(start + x * step[0] + y * step[1] + z * step[2])]);
      }
    }
  }
  return VoxelSolid(size, corner, spacing, filled);
}

} // namespace ballast
