#include "post/profile_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>
#include <ostream>

#include "post/field_scale.hpp"
#include "post/line_plot.hpp"

namespace ballast::post {
namespace {

constexpr double long_sided = 20;

/// Values at the cells' centres in the order of their place.
Line profile(const Section& section, float SectionCell::*field, std::size_t axis) {
  std::vector<std::pair<double, double>> samples;
  for (const SectionBlock& block : section.blocks)
    for (const SectionCell& cell : block.cells) {
      double centre = 0;
      for (const Corner& corner : cell.corners)
        centre += static_cast<double>(corner[axis]) / 4;
      samples.emplace_back(centre, static_cast<double>(cell.*field));
    }
  std::stable_sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  Line line;
  for (const auto& [place, value] : samples) {
    line.x.push_back(place);
    line.y.push_back(value);
  }
  return line;
}

bool has_fabric(const std::vector<Section>& sections) {
  for (const SectionBlock& block : sections.front().blocks)
    if (std::any_of(block.cells.begin(), block.cells.end(), [](const SectionCell& cell) { return cell.part > 0; }))
      return true;
  return false;
}

bool has_values(const LinePlot& plot) {
  return std::any_of(plot.lines.begin(), plot.lines.end(), [](const Line& line) {
    return std::any_of(
        line.y.begin(), line.y.end(), [](double value) { return std::isfinite(value); });
  });
}

} // namespace

bool is_one_dimensional(const std::vector<Section>& sections) {
  if (has_fabric(sections))
    return false; // a wide vest is thin, too
  const View view = whole_view(sections, false);
  return std::max(view.width(), view.height()) > long_sided * std::min(view.width(), view.height());
}

int draw_profile_pictures(const std::vector<Section>& sections,
                          const std::string& title,
                          const std::filesystem::path& folder,
                          std::ostream& log) {
  const View view = whole_view(sections, false);
  const std::size_t axis = view.width() > view.height() ? 0 : 1;
  const std::string& geometry = sections.front().geometry;
  const std::string across = geometry == "axisymmetric" ? "r" : "x",
                    up = geometry == "planar" ? "y" : "z";
  const ScaledUnit time_unit = scaled_unit("s", sections.back().time);
  int pictures = 0;
  for (const bool pressure : {true, false}) {
    LinePlot plot{title,
                  axis == 0 ? across : up,
                  "m",
                  pressure ? "Pressure" : "Speed",
                  pressure ? "Pa" : "m/s",
                  {}};
    for (const Section& section : sections) {
      plot.lines.push_back(
          profile(section, pressure ? &SectionCell::pressure : &SectionCell::speed, axis));
      plot.lines.back().name =
          fmt::format("t = {:.2f} {}", section.time / time_unit.scale, time_unit.name);
    }
    if (!has_values(plot))
      continue;
    const std::filesystem::path path =
        folder / (pressure ? "profile_pressure.png" : "profile_speed.png");
    draw_line_plot(plot, path);
    log << path.string() << '\n';
    ++pictures;
  }
  return pictures;
}

} // namespace ballast::post
