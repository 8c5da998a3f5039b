#include "post/back_face_pictures.hpp"

#include <fmt/core.h>
#include <map>
#include <ostream>
#include <regex>
#include <set>

#include "core/io/history.hpp"
#include "post/line_plot.hpp"

namespace ballast::post {
namespace {

namespace fs = std::filesystem;

/// "fields_0012.vtm" -> "0012"; empty for another name.
std::string number_of(const std::string& file) {
  static const std::regex pattern(R"re(.*_(\d+)\.vtm)re");
  std::smatch match;
  return std::regex_match(file, match, pattern) ? match[1].str() : std::string{};
}

/// What stands between "back_face" and the number in the names of profiles: "" of an only stack, else "_NAME".
std::set<std::string> stacks_in(const fs::path& dir) {
  static const std::regex pattern(R"re(back_face(_.*)?_(\d+)\.csv)re");
  std::set<std::string> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(dir)) {
    const std::string file = entry.path().filename().string();
    std::smatch match;
    if (std::regex_match(file, match, pattern))
      found.insert(match[1]);
  }
  return found;
}

/// One plot a deflection column, each with the lines of all times.
std::map<std::string, LinePlot> plots_of(const fs::path& dir, const std::string& stack, const std::vector<io::PvdEntry>& times, const std::string& title) {
  std::map<std::string, LinePlot> plots;
  const ScaledUnit unit = scaled_unit("s", times.back().time);
  for (const io::PvdEntry& entry : times) {
    const fs::path path = dir / fmt::format("back_face{}_{}.csv", stack, number_of(entry.file));
    if (!fs::exists(path))
      continue;
    const io::Table table = io::read_csv(path);
    for (std::size_t c = 1; c < table.names.size(); ++c) {
      const std::string name = io::split_column_name(table.names[c]).name;
      if (!name.starts_with("deflection_"))
        continue;
      LinePlot& plot = plots.try_emplace(name, LinePlot{title, name.substr(name.find('_') + 1), "m", "Deflection of the back face", "m", {}}).first->second;
      plot.lines.push_back({fmt::format("t = {:.4g} {}", entry.time / unit.scale, unit.name), table.columns[0], table.columns[c]});
    }
  }
  return plots;
}

} // namespace

int draw_back_face_pictures(const fs::path& dir, const std::vector<io::PvdEntry>& times, const std::string& title, const fs::path& folder, std::ostream& log) {
  int pictures = 0;
  for (const std::string& stack : stacks_in(dir))
    for (const auto& [name, plot] : times.empty() ? std::map<std::string, LinePlot>{} : plots_of(dir, stack, times, title)) {
      const fs::path path = folder / fmt::format("back_face{}_{}.png", stack, name);
      draw_line_plot(plot, path);
      log << path.string() << '\n';
      ++pictures;
    }
  return pictures;
}

} // namespace ballast::post
