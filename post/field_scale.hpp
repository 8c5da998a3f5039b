// The scales and views that all pictures of a series share.
#pragma once

#include <optional>
#include <vector>

#include "post/axis.hpp"
#include "post/colour_map.hpp"
#include "post/section.hpp"

namespace ballast::post {

enum class Field { material, pressure, speed, damage };

/// Values beyond low..high are drawn in the end colours; the colour bar then ends in a tip.
struct FieldScale {
  double low = 0, high = 1;
  bool below = false, above = false;
  ColourMap map;
  ScaledUnit unit;
};

/// The scale of a field over all sections; none if no section has it. Taken from the active cells
/// (above a hundredth of the largest value): pressure ends at the percentile 99 if the extreme lies
/// well beyond, speed at the largest value unless a few cells stand out threefold. Pressure with
/// tension gets a scale symmetric about zero. Damage of fabric goes from 0 to 1, rupture.
std::optional<FieldScale> field_scale(const std::vector<Section>& sections, Field field);

/// What is shown, m.
struct View {
  AxisRange x, y;
  double width() const { return x.high - x.low; }
  double height() const { return y.high - y.low; }
};
View whole_view(const std::vector<Section>& sections, bool mirrored);
/// The part in motion (speed above 10 % of `fast`) with a margin; none if that is more than 40 % of
/// `whole`.
std::optional<View>
close_up(const std::vector<Section>& sections, const View& whole, bool mirrored, double fast);

} // namespace ballast::post
