// Axes: round tick values, SI prefixes and the drawing of a framed plot area.
#pragma once

#include <string>
#include <vector>

#include "post/canvas.hpp"

namespace ballast::post {

struct Ticks {
  std::vector<double> values;
  int decimals = 0;
  std::string label(std::size_t tick) const;
};

/// About `count` ticks at 1, 2 or 5 x 10^n inside [low, high].
Ticks round_ticks(double low, double high, double count);
/// The next round number not below `value` (two leading digits at most).
double rounded_up(double value);

/// A unit with the prefix that suits numbers up to `largest`: {"GPa", 1e9}. Units that take no
/// prefix stay.
struct ScaledUnit {
  std::string name;
  double scale = 1;
};
ScaledUnit scaled_unit(const std::string& unit, double largest);

struct AxisRange {
  double low, high;
};

/// A framed plot area with ticks and labels on its left and lower side.
struct PlotArea {
  Box box;
  AxisRange x, y;
  Point pixel(double px, double py) const {
    return {box.x + (px - x.low) / (x.high - x.low) * box.width,
            box.bottom() - (py - y.low) / (y.high - y.low) * box.height};
  }
};
void draw_axes(Canvas& canvas,
               const PlotArea& area,
               const std::string& x_label,
               const std::string& y_label,
               bool grid);

} // namespace ballast::post
