// Colours of numbers and of materials. Maps are perceptually uniform: viridis (van der Walt, Smith
// 2015) and vik (Crameri 2018, diverging: white at zero).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "post/canvas.hpp"

namespace ballast::post {

class ColourMap {
public:
  /// `part_from`..1 of the table is used (0.5: the upper half of a diverging map).
  ColourMap(std::span<const Colour> table, double part_from) : table_(table), from_(part_from) {}
  /// The colour at `fraction`, clipped to 0..1.
  Colour operator()(double fraction) const;

private:
  std::span<const Colour> table_;
  double from_;
};

ColourMap viridis();
ColourMap diverging();
/// Zero is white, as in diverging(), and only the positive side is used.
ColourMap positive_half();

/// A colour for each material: by a telling word in its name (lead grey, copper, tissue rose, gases
/// pale), else from a palette that most colour-blind readers can tell apart.
std::vector<Colour> material_colours(std::span<const std::string> names);
/// Colour of line number `index` in a plot; repeats after 8.
Colour line_colour(std::size_t index);

} // namespace ballast::post
