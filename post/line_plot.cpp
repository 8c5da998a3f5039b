#include "post/line_plot.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "post/colour_map.hpp"

namespace ballast::post {
namespace {

AxisRange finite_range(const LinePlot& plot, std::vector<double> Line::*values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Line& line : plot.lines)
    for (double value : line.*values)
      if (std::isfinite(value))
        low = std::min(low, value), high = std::max(high, value);
  return low <= high ? AxisRange{low, high} : AxisRange{0, 1};
}

double largest(AxisRange range) {
  return std::max(std::fabs(range.low), std::fabs(range.high));
}

/// The range of the values with 4 % of air; zero is included where it is near.
AxisRange value_range(const LinePlot& plot) {
  auto [low, high] = finite_range(plot, &Line::y);
  if (low > 0 && low < 0.5 * high)
    low = 0;
  if (high < 0 && high > 0.5 * low)
    high = 0;
  const double span = high - low, size = largest({low, high});
  const double air = span > 1e-6 * size ? 0.04 * span : std::max(0.05 * size, 1e-300);
  return {low == 0 && span > 0 ? 0 : low - air, high == 0 && span > 0 ? 0 : high + air};
}

/// First, least, greatest and last value of every half pixel: a million points look the same and
/// draw fast.
std::vector<Point> thinned(const std::vector<Point>& points) {
  std::vector<Point> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    const double column = std::floor(points[begin].x * 2);
    std::size_t end = begin + 1, least = begin, most = begin;
    for (; end < points.size() && std::floor(points[end].x * 2) == column; ++end) {
      if (points[end].y < points[least].y)
        least = end;
      if (points[end].y > points[most].y)
        most = end;
    }
    const std::array<std::size_t, 4> picks{
        begin, std::min(least, most), std::max(least, most), end - 1};
    for (std::size_t k = 0; k < picks.size(); ++k)
      if (k == 0 || picks[k] != picks[k - 1])
        kept.push_back(points[picks[k]]);
    begin = end;
  }
  return kept;
}

void draw_line(Canvas& canvas, const PlotArea& area, const Line& line, Colour colour) {
  std::vector<Point> run;
  const auto flush = [&] {
    canvas.polyline(thinned(run), 2.6, colour);
    run.clear();
  };
  for (std::size_t k = 0; k < line.x.size(); ++k)
    if (std::isfinite(line.y[k]))
      run.push_back(area.pixel(line.x[k], line.y[k]));
    else
      flush();
  flush();
}

double legend_width(const LinePlot& plot) {
  double widest = 60;
  for (const Line& line : plot.lines)
    widest = std::max(widest, Canvas::text_width(line.name, {.size = 20}));
  return widest + 90;
}

std::string axis_label(const std::string& name, const ScaledUnit& unit) {
  return unit.name.empty() ? name : name + " [" + unit.name + "]";
}

} // namespace

void draw_line_plot(const LinePlot& plot, const std::filesystem::path& path) {
  AxisRange x = finite_range(plot, &Line::x);
  if (!(x.high > x.low))
    x.high = x.low + 1;
  const AxisRange y = value_range(plot);
  const ScaledUnit x_unit = scaled_unit(plot.x_unit, largest(x)),
                   y_unit = scaled_unit(plot.y_unit, largest(y));
  const Box box{150, 96, 1080, 620};
  Canvas canvas(static_cast<int>(box.right() + legend_width(plot)), 830);
  const PlotArea labelled{box,
                          {x.low / x_unit.scale, x.high / x_unit.scale},
                          {y.low / y_unit.scale, y.high / y_unit.scale}};
  draw_axes(
      canvas, labelled, axis_label(plot.x_name, x_unit), axis_label(plot.y_name, y_unit), true);
  canvas.clip({box.x, box.y - 2, box.width, box.height + 4});
  for (std::size_t k = 0; k < plot.lines.size(); ++k)
    draw_line(canvas, {box, x, y}, plot.lines[k], line_colour(k));
  canvas.unclip();
  for (std::size_t k = 0; k < plot.lines.size(); ++k) {
    const double at = box.y + 16 + 32 * static_cast<double>(k), left = box.right() + 20;
    canvas.line({left, at}, {left + 34, at}, 4, line_colour(k));
    canvas.text({left + 46, at}, plot.lines[k].name, {.size = 20});
  }
  canvas.text({box.x, 44}, plot.title, {.size = 30});
  canvas.save_png(path);
}

} // namespace ballast::post
