#include "post/section_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ballast::post {
namespace {

/// From metres to samples of the raster.
struct Projection {
  PlotArea area;
  bool flipped;
  Point operator()(const Corner& corner) const {
    const double x = static_cast<double>(corner[0]);
    const Point p = area.pixel(flipped ? -x : x, static_cast<double>(corner[1]));
    return {(p.x - area.box.x) * Canvas::fine, (p.y - area.box.y) * Canvas::fine};
  }
};

/// Samples between the lower and the upper side of a cell.
double height(const std::array<Point, 4>& shape) {
  return std::min(std::hypot(shape[3].x - shape[0].x, shape[3].y - shape[0].y), std::hypot(shape[2].x - shape[1].x, shape[2].y - shape[1].y));
}

constexpr double told_apart = 10; // samples

void draw_cell(const SectionCell& cell, const Projection& project, SectionRaster& raster) {
  const std::array<Point, 4> shape{project(cell.corners[0]),
                                   project(cell.corners[1]),
                                   project(cell.corners[2]),
                                   project(cell.corners[3])};
  const int part = height(shape) < told_apart ? 0 : cell.part;
  for_each_span(shape, raster.columns, raster.rows, [&](int row, int first, int end) {
    for (int column = first; column < end; ++column) {
      const std::size_t s = raster.index(column, row);
      if (cell.material == SectionCell::none && raster.material[s] != SectionCell::none)
        continue; // see through
      raster.material[s] = cell.material;
      raster.pressure[s] = cell.pressure;
      raster.speed[s] = cell.speed;
      raster.damage[s] = cell.damage;
      raster.part[s] = part;
    }
  });
}

void draw_polygon(const SectionPolygon& polygon, const Projection& project, SectionRaster& raster) {
  if (polygon.corners.size() < 3)
    return;
  std::vector<Point> shape;
  for (const Corner& corner : polygon.corners)
    shape.push_back(project(corner));
  for_each_span(shape, raster.columns, raster.rows, [&](int row, int first, int end) {
    for (int column = first; column < end; ++column)
      raster.material[raster.index(column, row)] = polygon.material;
  });
}

} // namespace

SectionRaster sample(const Section& section, const PlotArea& area, bool mirrored) {
  const auto fine = [](double pixels) {
    return static_cast<int>(std::lround(pixels * Canvas::fine));
  };
  SectionRaster raster{
      fine(area.box.x), fine(area.box.y), fine(area.box.width), fine(area.box.height), {}, {}, {}, {}, {}};
  const std::size_t samples = raster.index(0, raster.rows);
  raster.material.assign(samples, SectionCell::none);
  raster.pressure.assign(samples, std::numeric_limits<float>::quiet_NaN());
  raster.speed = raster.damage = raster.pressure;
  raster.part.assign(samples, 0);
  for (const SectionBlock& block : section.blocks)
    for (const bool flipped : {false, true}) {
      if (flipped && !mirrored)
        continue;
      const Projection project{area, flipped};
      for (const SectionCell& cell : block.cells)
        draw_cell(cell, project, raster);
      for (const SectionPolygon& polygon : block.polygons)
        draw_polygon(polygon, project, raster);
    }
  return raster;
}

std::vector<bool> interface_samples(const SectionRaster& raster) {
  std::vector<bool> marked(raster.material.size(), false);
  const auto mark = [&](int column, int row) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (column + dx >= 0 && column + dx < raster.columns && row + dy >= 0 &&
            row + dy < raster.rows)
          marked[raster.index(column + dx, row + dy)] = true;
  };
  for (int row = 0; row < raster.rows; ++row)
    for (int column = 0; column < raster.columns; ++column) {
      const std::size_t here = raster.index(column, row);
      const auto differs = [&](std::size_t there) {
        return raster.material[there] != raster.material[here] || raster.part[there] != raster.part[here];
      };
      const bool right = column + 1 < raster.columns && differs(raster.index(column + 1, row));
      const bool below = row + 1 < raster.rows && differs(raster.index(column, row + 1));
      if (right || below)
        mark(column, row);
    }
  return marked;
}

} // namespace ballast::post
