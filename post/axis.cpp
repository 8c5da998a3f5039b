#include "post/axis.hpp"

#include <algorithm>
#include <array>
#include <fmt/core.h>

namespace ballast::post {
namespace {

constexpr double tick_text = 19, label_text = 21;

bool takes_prefix(const std::string& unit) {
  static const std::array<std::string_view, 7> units{"Pa", "J", "N", "W", "s", "m", "J/m"};
  return std::find(units.begin(), units.end(), unit) != units.end();
}

} // namespace

std::string Ticks::label(std::size_t tick) const {
  const double value = values[tick];
  const bool huge = std::fabs(values.front()) >= 1e6 || std::fabs(values.back()) >= 1e6;
  if (huge || decimals > 6)
    return fmt::format("{:.4g}", value);
  return fmt::format("{:.{}f}", value == 0 ? 0.0 : value, decimals);
}

Ticks round_ticks(double low, double high, double count) {
  const double rough = (high - low) / std::max(count, 1.0),
               power = std::pow(10, std::floor(std::log10(rough)));
  const double leading = rough / power, step = (leading <= 1   ? 1
                                                : leading <= 2 ? 2
                                                : leading <= 5 ? 5
                                                               : 10) *
                                               power;
  Ticks ticks;
  ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double first = std::ceil(low / step - 1e-4);
  for (double k = first; k * step <= high + 1e-4 * step; ++k)
    ticks.values.push_back(k * step);
  if (ticks.values.empty())
    ticks.values.push_back(low);
  return ticks;
}

double rounded_up(double value) {
  if (!(value > 0))
    return 1;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double leading : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (value <= leading * power * (1 + 1e-9))
      return leading * power;
  return 10 * power;
}

ScaledUnit scaled_unit(const std::string& unit, double largest) {
  if (!takes_prefix(unit) || !(largest > 0))
    return {unit, 1};
  const int group =
      std::clamp(static_cast<int>(std::floor(std::log10(largest * 1.0001) / 3)), -4, 4);
  if (unit == "m" && group > 0)
    return {unit, 1};
  static const std::array<const char*, 9> prefixes{"p", "n", "µ", "m", "", "k", "M", "G", "T"};
  return {prefixes[static_cast<std::size_t>(group + 4)] + unit, std::pow(10, 3 * group)};
}

void draw_axes(Canvas& canvas,
               const PlotArea& area,
               const std::string& x_label,
               const std::string& y_label,
               bool grid) {
  const Box& box = area.box;
  const Ticks x = round_ticks(area.x.low, area.x.high, std::clamp(box.width / 80, 2.0, 10.0));
  const Ticks y = round_ticks(area.y.low, area.y.high, std::clamp(box.height / 75, 2.0, 8.0));
  for (std::size_t k = 0; k < x.values.size(); ++k) {
    const double at = area.pixel(x.values[k], 0).x;
    if (grid)
      canvas.line({at, box.y}, {at, box.bottom()}, 1, light_grey);
    canvas.line({at, box.bottom()}, {at, box.bottom() + 7}, 1.5, black);
    canvas.text({at, box.bottom() + 11},
                x.label(k),
                {.size = tick_text, .x = AlignX::centre, .y = AlignY::top});
  }
  double widest = 0;
  for (std::size_t k = 0; k < y.values.size(); ++k) {
    const double at = area.pixel(0, y.values[k]).y;
    const TextStyle style{.size = tick_text, .x = AlignX::right};
    if (grid)
      canvas.line({box.x, at}, {box.right(), at}, 1, light_grey);
    canvas.line({box.x - 7, at}, {box.x, at}, 1.5, black);
    canvas.text({box.x - 11, at}, y.label(k), style);
    widest = std::max(widest, Canvas::text_width(y.label(k), style));
  }
  canvas.frame(box, 1.5, black);
  canvas.text({box.x + box.width / 2, box.bottom() + 39},
              x_label,
              {.size = label_text, .x = AlignX::centre, .y = AlignY::top});
  canvas.text({box.x - 20 - widest, box.y + box.height / 2},
              y_label,
              {.size = label_text, .x = AlignX::right, .upright = true});
}

} // namespace ballast::post
