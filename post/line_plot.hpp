// Line plots: values over time or place, with a legend beside the frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "post/axis.hpp"

namespace ballast::post {

struct Line {
  std::string name;
  std::vector<double> x, y; // SI; a y that is not finite leaves a gap
};

struct LinePlot {
  std::string title;
  std::string x_name, x_unit; // SI unit; scaled by a prefix as suits
  std::string y_name, y_unit;
  std::vector<Line> lines; // eight at most are told apart
};

/// Throws Error if the picture cannot be written.
void draw_line_plot(const LinePlot& plot, const std::filesystem::path& path);

} // namespace ballast::post
