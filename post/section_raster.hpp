// SectionRaster: a section sampled on the fine grid of a canvas: the material, pressure and speed
// under each sample. Later blocks lie over earlier ones; polygons lie over the cells of their
// block. Interfaces are where neighbouring samples differ in material, so they can be drawn over
// any field; those between fabric layers where the layers are thick enough in the picture to stand apart.
#pragma once

#include <cstddef>
#include <vector>

#include "post/axis.hpp"
#include "post/section.hpp"

namespace ballast::post {

struct SectionRaster {
  int left, top, columns, rows; // place on the canvas' fine grid
  std::vector<int> material;    // SectionCell::none where there is nothing
  std::vector<float> pressure, speed, damage;
  std::vector<int> part; // fabric layer, from 1; 0: none, or too thin to be told from the next

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// Samples `section` over area.box; axis ranges are in m; `mirrored` adds the image at -x.
SectionRaster sample(const Section& section, const PlotArea& area, bool mirrored);

/// True for the samples within about one pixel of a change of material.
std::vector<bool> interface_samples(const SectionRaster& raster);

} // namespace ballast::post
