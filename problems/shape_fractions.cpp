// Volume fractions of a cell that shapes cover: lines cast through it.
#include "problems/shape_cuts.hpp"
#include "problems/shape_geometry.hpp"
#include "problems/surface_volume.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ballast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Cell {
  Geometry geometry;
  Point lo, hi;
  int dim() const { return dimensions(geometry); }
  double size(std::size_t k) const { return hi[k] - lo[k]; }
  Point centre() const {
    Point c{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim()); ++k) {
      c[k] = 0.5 * (lo[k] + hi[k]);
    }
    return c;
  }
  double half_diagonal() const {
    double d2 = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(dim()); ++k) {
      d2 += size(k) * size(k);
    }
    return 0.5 * std::sqrt(d2);
  }
};

enum class Side { outside, inside, cut };

Side side_of(const Shape& shape, const Cell& cell) {
  const Bounds b = bounds(shape);
  for (std::size_t k = 0; k < static_cast<std::size_t>(cell.dim()); ++k) {
    if (cell.hi[k] <= b.lo[k] || cell.lo[k] >= b.hi[k]) {
      return Side::outside;
    }
  }
  if (const auto* s = std::get_if<Surface>(&shape.form)) { // cheaper than the distance, and sharper
    return enters(*s, cell.lo, cell.hi) ? Side::cut
           : holds(*s, cell.centre())   ? Side::inside
                                        : Side::outside;
  }
  if (const auto* v = std::get_if<Voxels>(&shape.form)) {
    const double share = covered_share(*v, cell.lo, cell.hi);
    return share <= 0 ? Side::outside : share >= 1 ? Side::inside : Side::cut;
  }
  const double d = signed_distance(shape, cell.centre());
  if (std::abs(d) < cell.half_diagonal()) {
    return Side::cut;
  }
  return d < 0 ? Side::inside : Side::outside;
}

/// The last of `candidates` that holds p, or -1.
int owner(std::span<const Shape* const> shapes,
          std::span<const std::size_t> candidates,
          const Point& p) {
  for (auto it = candidates.rbegin(); it != candidates.rend(); ++it) {
    if (contains(*shapes[*it], p)) {
      return static_cast<int>(*it);
    }
  }
  return -1;
}

/// The axis nearest to the normal of the surface nearest to the cell's centre.
std::size_t normal_axis(std::span<const Shape* const> shapes,
                        std::span<const std::size_t> candidates,
                        const Cell& cell) {
  const Point c = cell.centre();
  double nearest = infinity;
  std::size_t axis = 0;
  for (const std::size_t s : candidates) {
    const double d = std::abs(signed_distance(*shapes[s], c));
    if (d >= nearest) {
      continue;
    }
    nearest = d;
    double steepest = -1;
    for (std::size_t k = 0; k < static_cast<std::size_t>(cell.dim()); ++k) {
      Point a = c, b = c;
      a[k] -= 1e-3 * cell.half_diagonal();
      b[k] += 1e-3 * cell.half_diagonal();
      const double slope =
          std::abs(signed_distance(*shapes[s], b) - signed_distance(*shapes[s], a));
      if (slope > steepest) {
        steepest = slope;
        axis = k;
      }
    }
  }
  return axis;
}

/// The axis along which the owner changes most often on a coarse grid: lines along it meet the
/// surfaces most squarely. Where the grid hardly sees them (a corner cut off), the nearest surface
/// decides.
std::size_t best_axis(std::span<const Shape* const> shapes,
                      std::span<const std::size_t> candidates,
                      const Cell& cell) {
  constexpr int n = 5;
  const int nk = cell.dim() == 3 ? n : 1;
  std::array<int, n * n * n> owners{};
  const auto at = [&](int i, int j, int k) -> int& {
    return owners[static_cast<std::size_t>((k * n + j) * n + i)];
  };
  const auto place = [&](std::size_t axis, int i) {
    return cell.lo[axis] + (i + 0.5) / n * cell.size(axis);
  };
  std::array<int, 3> changes{};
  for (int k = 0; k < nk; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Point p{place(0, i), place(1, j), nk > 1 ? place(2, k) : 0.0};
        at(i, j, k) = owner(shapes, candidates, p);
        changes[0] += i > 0 && at(i, j, k) != at(i - 1, j, k);
        changes[1] += j > 0 && at(i, j, k) != at(i, j - 1, k);
        changes[2] += k > 0 && at(i, j, k) != at(i, j, k - 1);
      }
    }
  }
  const auto most = std::max_element(changes.begin(), changes.end());
  return 2 * *most < n * nk ? normal_axis(shapes, candidates, cell)
                            : static_cast<std::size_t>(most - changes.begin());
}

struct Abscissa {
  double x, weight;
};

/// Midpoints and widths of equal lines across axis k, `density` of them on a whole cell.
std::vector<Abscissa> lines_across(const Cell& part, std::size_t k, double whole, int density) {
  const int n = std::max(3, static_cast<int>(std::ceil(density * part.size(k) / whole)));
  std::vector<Abscissa> out;
  for (int i = 0; i < n; ++i) {
    const double x = part.lo[k] + (i + 0.5) * part.size(k) / n;
    const bool radius = part.geometry == Geometry::axisymmetric && k == 0;
    out.push_back({x, part.size(k) / n * (radius ? x : 1.0)});
  }
  return out;
}

/// Adds each owner's share of one line, `weight` its cross-section; r-lines weigh with r
/// themselves.
void cast_line(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               const Line& line,
               bool weigh_with_r,
               double weight,
               std::span<double> sums) {
  Cuts cuts(line);
  for (const std::size_t s : candidates) {
    cut(*shapes[s], line, cuts);
  }
  cuts.values.insert(cuts.values.end(), {line.lo, line.hi});
  std::sort(cuts.values.begin(), cuts.values.end());
  Point p = line.p;
  for (std::size_t i = 0; i + 1 < cuts.values.size(); ++i) {
    const double a = cuts.values[i], b = cuts.values[i + 1];
    if (b <= a) {
      continue;
    }
    p[line.k] = 0.5 * (a + b);
    const int who = owner(shapes, candidates, p);
    if (who >= 0) {
      sums[static_cast<std::size_t>(who)] += weight * (b - a) * (weigh_with_r ? p[line.k] : 1.0);
    }
  }
}

/// One part of a cell, free of aligned faces inside.
void cast_part(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               const Cell& part,
               const Cell& cell,
               std::span<double> sums) {
  const std::size_t k = best_axis(shapes, candidates, part);
  const bool flat = cell.dim() == 2;
  const std::size_t j = k == 0 ? 1 : 0;
  const std::size_t l = 3 - j - k; // the other transverse axis, 3D only
  const bool weigh = cell.geometry == Geometry::axisymmetric && k == 0;
  const auto across_j = lines_across(part, j, cell.size(j), flat ? 40 : 24);
  const auto across_l =
      flat ? std::vector<Abscissa>{{0.0, 1.0}} : lines_across(part, l, cell.size(l), 24);
  for (const Abscissa& b : across_l) {
    for (const Abscissa& a : across_j) {
      Line line{{}, k, part.lo[k], part.hi[k]};
      line.p[j] = a.x;
      line.p[l] = b.x;
      cast_line(shapes, candidates, line, weigh, a.weight * b.weight, sums);
    }
  }
}

/// The marks inside axis k of a cell and its ends, in order.
std::vector<double> ends_of(std::vector<double> marks, const Cell& cell, std::size_t k) {
  const double least = 1e-12 * cell.size(k);
  std::erase_if(marks,
                [&](double m) { return !(m > cell.lo[k] + least && m < cell.hi[k] - least); });
  marks.insert(marks.end(), {cell.lo[k], cell.hi[k]});
  std::sort(marks.begin(), marks.end());
  const auto same = [&](double a, double b) { return b - a <= least; };
  marks.erase(std::unique(marks.begin(), marks.end(), same), marks.end());
  return marks;
}

/// Where voxels meet inside the cell, if that is in few places: lines are good enough for many.
void add_voxel_planes(const Shape& shape, const Cell& cell, std::size_t k, std::vector<double>& marks) {
  constexpr std::size_t many = 8;
  std::vector<double> planes;
  if (has_voxels(shape)) {
    box_planes(shape, k, cell.lo[k], cell.hi[k], planes);
  }
  if (planes.size() <= many) {
    marks.insert(marks.end(), planes.begin(), planes.end());
  }
}

/// Ends of the stretches that the jumps cut axis k of a cell into.
std::vector<double> stretches(std::span<const Shape* const> shapes,
                              std::span<const std::size_t> candidates,
                              const Cell& cell,
                              std::size_t k) {
  if (k == 2 && cell.dim() == 2) {
    return {0, 0};
  }
  std::vector<double> marks;
  for (const std::size_t s : candidates) {
    jumps(*shapes[s], k, cell.dim() == 2, marks);
    add_voxel_planes(*shapes[s], cell, k, marks);
  }
  return ends_of(std::move(marks), cell, k);
}

/// Between boxes along the axes there are only boxes: each part has one owner.
void add_boxes(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               std::span<const std::size_t> cut,
               const Cell& cell,
               std::span<double> sums) {
  std::array<std::vector<double>, 3> marks;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const std::size_t s : cut) {
      box_planes(*shapes[s], k, cell.lo[k], cell.hi[k], marks[k]);
    }
    marks[k] = ends_of(std::move(marks[k]), cell, k);
  }
  for (std::size_t k = 0; k + 1 < marks[2].size(); ++k) {
    for (std::size_t j = 0; j + 1 < marks[1].size(); ++j) {
      for (std::size_t i = 0; i + 1 < marks[0].size(); ++i) {
        const double size[3] = {marks[0][i + 1] - marks[0][i], marks[1][j + 1] - marks[1][j], marks[2][k + 1] - marks[2][k]};
        const int who = owner(shapes, candidates, {marks[0][i] + 0.5 * size[0], marks[1][j] + 0.5 * size[1], marks[2][k] + 0.5 * size[2]});
        if (who >= 0) {
          sums[static_cast<std::size_t>(who)] += size[0] * size[1] * size[2];
        }
      }
    }
  }
}

/// Cuts the cell at aligned faces, which lines along any axis would miss or graze, and casts each
/// part.
void cast_cell(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               const Cell& cell,
               std::span<double> sums) {
  std::array<std::vector<double>, 3> marks;
  for (std::size_t k = 0; k < 3; ++k) {
    marks[k] = stretches(shapes, candidates, cell, k);
  }
  for (std::size_t k = 0; k + 1 < marks[2].size(); ++k) {
    for (std::size_t j = 0; j + 1 < marks[1].size(); ++j) {
      for (std::size_t i = 0; i + 1 < marks[0].size(); ++i) {
        const Cell part{cell.geometry,
                        {marks[0][i], marks[1][j], marks[2][k]},
                        {marks[0][i + 1], marks[1][j + 1], marks[2][k + 1]}};
        cast_part(shapes, candidates, part, cell, sums);
      }
    }
  }
}

/// The same where there are surfaces of facets, each cut down to what this cell sees of it.
void cast_seen(std::span<const Shape* const> shapes,
               std::span<const std::size_t> candidates,
               const Cell& cell,
               std::span<double> sums) {
  std::vector<Shape> seen;
  seen.reserve(candidates.size());
  std::vector<const Shape*> all(shapes.begin(), shapes.end());
  for (const std::size_t s : candidates) {
    all[s] = &seen.emplace_back(seen_from(*shapes[s], cell.lo, cell.hi));
  }
  cast_cell(all, candidates, cell, sums);
}

/// The share of a surface or of voxels that alone are cut by the cell: exact, and quicker than lines.
std::optional<double> share_alone(const Shape& shape, const Cell& cell) {
  if (const auto* v = std::get_if<Voxels>(&shape.form)) {
    return covered_share(*v, cell.lo, cell.hi);
  }
  const auto* s = std::get_if<Surface>(&shape.form);
  return s != nullptr ? covered_share(SurfacePiece(*s->whole, cell.lo, cell.hi), cell.lo, cell.hi) : std::nullopt;
}

double measure(const Cell& cell) {
  double v = cell.size(0) * cell.size(1);
  if (cell.geometry == Geometry::axisymmetric) {
    v *= 0.5 * (cell.lo[0] + cell.hi[0]);
  }
  return cell.dim() == 3 ? v * cell.size(2) : v;
}

} // namespace

void visible_fractions(std::span<const Shape* const> shapes,
                       Geometry geometry,
                       const Point& lo,
                       const Point& hi,
                       std::span<double> shares) {
  const Cell cell{geometry, lo, hi};
  std::fill(shares.begin(), shares.end(), 0.0);
  std::vector<std::size_t> candidates, cut; // ascending
  for (std::size_t s = shapes.size();
       s-- > 0;) { // from the top: what lies under a full one is hidden
    const Side side = side_of(*shapes[s], cell);
    if (side == Side::outside) {
      continue;
    }
    candidates.insert(candidates.begin(), s);
    if (side == Side::cut) {
      cut.insert(cut.begin(), s);
    }
    if (side == Side::inside) {
      break;
    }
  }
  if (candidates.empty()) {
    return;
  }
  if (cut.empty()) {
    shares[candidates.front()] = 1;
    return;
  }
  if (const auto share = cut.size() == 1 ? share_alone(*shapes[candidates.back()], cell) : std::nullopt) {
    shares[candidates.front()] = 1 - *share; // of what lies under it, if anything does
    shares[candidates.back()] = *share;
    return;
  }
  const bool voxels = std::any_of(cut.begin(), cut.end(), [&](std::size_t i) { return has_voxels(*shapes[i]); });
  const bool boxes = voxels && std::all_of(cut.begin(), cut.end(), [&](std::size_t i) { return made_of_boxes(*shapes[i]); });
  const bool facets = std::any_of(candidates.begin(), candidates.end(), [&](std::size_t i) { return has_surface(*shapes[i]); });
  if (boxes) {
    add_boxes(shapes, candidates, cut, cell, shares);
  } else if (facets) {
    cast_seen(shapes, candidates, cell, shares);
  } else {
    cast_cell(shapes, candidates, cell, shares);
  }
  const double whole = measure(cell);
  for (double& share : shares) {
    share /= whole;
    share = share < 1e-12 ? 0.0 : (share > 1 - 1e-12 ? 1.0 : share);
  }
}

double fraction(const Shape& shape, Geometry geometry, const Point& lo, const Point& hi) {
  const Shape* one = &shape;
  double share = 0;
  visible_fractions({&one, 1}, geometry, lo, hi, {&share, 1});
  return share;
}

} // namespace ballast
