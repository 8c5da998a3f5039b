#include "post/history_pictures.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <map>
#include <ostream>

#include "post/line_plot.hpp"

namespace ballast::post {
namespace {

constexpr std::size_t lines_a_picture = 8;

std::string quantity_of(const std::string& unit) {
  static const std::map<std::string, std::string> names{{"m/s", "Velocity"},
                                                        {"m", "Length"},
                                                        {"m/s2", "Acceleration"},
                                                        {"m/s^2", "Acceleration"},
                                                        {"Pa", "Pressure and stress"},
                                                        {"J", "Energy"},
                                                        {"kg", "Mass"},
                                                        {"N", "Force"},
                                                        {"K", "Temperature"},
                                                        {"s", "Time"},
                                                        {"kg m/s", "Momentum"},
                                                        {"N s", "Momentum"},
                                                        {"kg/m3", "Density"},
                                                        {"J/kg", "Specific energy"},
                                                        {"m3", "Volume"},
                                                        {"m2", "Area"},
                                                        {"W", "Power"}};
  const auto found = names.find(unit);
  if (found != names.end())
    return found->second;
  return unit.empty() || unit == "-" || unit == "1" ? "Dimensionless" : "Value";
}

std::string file_stem(const LinePlot& plot) {
  std::string stem = plot.y_name == "Value" ? plot.y_unit : plot.y_name;
  for (char& c : stem)
    c = std::isalnum(static_cast<unsigned char>(c))
            ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
            : '_';
  return "history_" + stem;
}

/// Columns by unit in the order of the file; more than eight lines make another picture.
std::vector<LinePlot> group_by_unit(const io::Table& history, const std::string& title) {
  std::vector<LinePlot> plots;
  for (std::size_t c = 1; c < history.names.size(); ++c) {
    const io::ColumnName column = io::split_column_name(history.names[c]);
    auto plot = std::find_if(plots.begin(), plots.end(), [&](const LinePlot& p) {
      return p.y_unit == column.unit && p.lines.size() < lines_a_picture;
    });
    if (plot == plots.end())
      plot = plots.insert(plots.end(),
                          LinePlot{title, "t", "s", quantity_of(column.unit), column.unit, {}});
    std::string words = column.name;
    std::replace(words.begin(), words.end(), '_', ' ');
    plot->lines.push_back({words, history.columns[0], history.columns[c]});
  }
  return plots;
}

} // namespace

int draw_history_pictures(const io::Table& history,
                          const std::string& title,
                          const std::filesystem::path& folder,
                          std::ostream& log) {
  if (history.names.front() != "t" || history.columns.front().size() < 2) {
    log << "no plot of the history: fewer than two rows, or the first column is not t\n";
    return 0;
  }
  std::map<std::string, int> used;
  int pictures = 0;
  for (const LinePlot& plot : group_by_unit(history, title)) {
    const std::string stem = file_stem(plot);
    const int number = ++used[stem];
    const std::filesystem::path path =
        folder / (stem + (number > 1 ? fmt::format("_{}", number) : "") + ".png");
    draw_line_plot(plot, path);
    log << path.string() << '\n';
    ++pictures;
  }
  return pictures;
}

} // namespace ballast::post
