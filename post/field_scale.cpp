#include "post/field_scale.hpp"

#include <algorithm>
#include <cmath>

namespace ballast::post {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

template <class Visit> void for_each_cell(const std::vector<Section>& sections, Visit&& visit) {
  for (const Section& section : sections)
    for (const SectionBlock& block : section.blocks)
      for (const SectionCell& cell : block.cells)
        visit(cell);
}

View empty_view() {
  return {{infinite, -infinite}, {infinite, -infinite}};
}

void include(View& view, const SectionCell& cell) {
  for (const Corner& corner : cell.corners) {
    const double x = static_cast<double>(corner[0]), y = static_cast<double>(corner[1]);
    view.x = {std::min(view.x.low, x), std::max(view.x.high, x)};
    view.y = {std::min(view.y.low, y), std::max(view.y.high, y)};
  }
}

View mirror(View view, bool mirrored) {
  if (mirrored)
    view.x = {-view.x.high, view.x.high};
  return view;
}

float percentile(std::vector<float>& values, double fraction) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       fraction * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// How much of a field is shown in full: pressures peak sharply, so their scale ends at a
/// percentile.
struct Cut {
  double fraction, tolerance;
};
constexpr Cut pressure_cut{0.99, 1.25}, speed_cut{0.999, 3};

/// The extreme itself unless it is beyond `tolerance` times nearly all other values.
double cut_outliers(double extreme, double nearly_all, double tolerance) {
  return std::fabs(extreme) > tolerance * std::fabs(nearly_all) ? nearly_all : extreme;
}

} // namespace

namespace {

/// From 0 to rupture; what unloads beyond it is in the tip of the bar.
std::optional<FieldScale> damage_scale(const std::vector<Section>& sections) {
  float most = -1;
  for_each_cell(sections, [&](const SectionCell& cell) { most = std::isfinite(cell.damage) ? std::max(most, cell.damage) : most; });
  if (most < 0)
    return std::nullopt;
  return FieldScale{.low = 0, .high = 1, .below = false, .above = most > 1, .map = positive_half(), .unit = {"1", 1}};
}

} // namespace

std::optional<FieldScale> field_scale(const std::vector<Section>& sections, Field field) {
  if (field == Field::damage)
    return damage_scale(sections);
  std::vector<float> values;
  for_each_cell(sections, [&](const SectionCell& cell) {
    const float value = field == Field::pressure ? cell.pressure : cell.speed;
    if (std::isfinite(value))
      values.push_back(value);
  });
  if (values.empty())
    return std::nullopt;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double lowest = static_cast<double>(*least), highest = static_cast<double>(*most);
  const float active = static_cast<float>(1e-2 * std::max(std::fabs(lowest), std::fabs(highest)));
  std::erase_if(values, [&](float value) { return std::fabs(value) < active; });
  const Cut cut = field == Field::pressure ? pressure_cut : speed_cut;
  double high = 1, low = 0;
  if (!values.empty()) {
    high =
        cut_outliers(highest, static_cast<double>(percentile(values, cut.fraction)), cut.tolerance);
    low = cut_outliers(
        lowest, static_cast<double>(percentile(values, 1 - cut.fraction)), cut.tolerance);
  }
  const bool both_signs = field == Field::pressure && low < -0.03 * std::fabs(high);
  if (both_signs)
    high = std::max(high, -low);
  high = rounded_up(high);
  FieldScale scale{.low = both_signs ? -high : 0,
                   .high = high,
                   .map = field == Field::speed ? viridis()
                          : both_signs          ? diverging()
                                                : positive_half(),
                   .unit = field == Field::speed ? ScaledUnit{"m/s", 1} : scaled_unit("Pa", high)};
  scale.below = lowest < scale.low - 1e-3 * high;
  scale.above = highest > scale.high * (1 + 1e-3);
  return scale;
}

View whole_view(const std::vector<Section>& sections, bool mirrored) {
  View view = empty_view();
  for_each_cell(sections, [&](const SectionCell& cell) { include(view, cell); });
  return mirror(view, mirrored);
}

std::optional<View>
close_up(const std::vector<Section>& sections, const View& whole, bool mirrored, double fast) {
  View view = empty_view();
  for_each_cell(sections, [&](const SectionCell& cell) {
    if (static_cast<double>(cell.speed) > 0.1 * fast && cell.material != SectionCell::none)
      include(view, cell);
  });
  if (!(view.width() > 0 && view.height() > 0))
    return std::nullopt;
  view = mirror(view, mirrored);
  const double margin = 0.12 * std::max(view.width(), view.height());
  view.x = {std::max(whole.x.low, view.x.low - margin),
            std::min(whole.x.high, view.x.high + margin)};
  view.y = {std::max(whole.y.low, view.y.low - margin),
            std::min(whole.y.high, view.y.high + margin)};
  if (view.width() * view.height() > 0.4 * whole.width() * whole.height())
    return std::nullopt;
  return view;
}

} // namespace ballast::post
