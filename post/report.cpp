#include "post/report.hpp"

#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <ostream>
#include <optional>
#include <regex>
#include <sstream>

#include "core/error.hpp"
#include "core/io/history.hpp"
#include "core/io/vtk.hpp"
#include "core/units.hpp"
#include "post/back_face_pictures.hpp"
#include "post/field_pictures.hpp"
#include "post/history_pictures.hpp"
#include "post/profile_pictures.hpp"

namespace ballast::post {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_times = 6;

/// The deck's title, else the folder's name.
std::string run_title(const fs::path& dir) {
  std::ifstream deck(dir / "deck.toml");
  static const std::regex pattern(R"re(^\s*title\s*=\s*["']([^"']*)["'])re");
  std::smatch match;
  for (std::string line; std::getline(deck, line);)
    if (std::regex_search(line, match, pattern))
      return match[1];
  const fs::path whole = fs::absolute(dir).lexically_normal();
  return whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
}

/// First and last included, the rest evenly between.
std::vector<io::PvdEntry> chosen_times(const std::vector<io::PvdEntry>& all) {
  if (all.size() <= most_times)
    return all;
  std::vector<io::PvdEntry> chosen;
  for (std::size_t k = 0; k < most_times; ++k)
    chosen.push_back(all[(k * (all.size() - 1) + (most_times - 1) / 2) / (most_times - 1)]);
  return chosen;
}

/// An earlier report may have had more pictures; only names that a report gives are removed.
void remove_old_pictures(const fs::path& folder) {
  static const std::regex ours(R"re((fields|closeup|profile|history|back_face)_.*\.png)re");
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (std::regex_match(entry.path().filename().string(), ours))
      old.push_back(entry.path());
  for (const fs::path& path : old)
    fs::remove(path);
}

int report_fields(const fs::path& dir,
                  const std::string& title,
                  const fs::path& folder,
                  std::ostream& log,
                  const std::optional<View>& close) {
  std::vector<Section> sections;
  const std::vector<io::PvdEntry> times = chosen_times(io::read_pvd(dir / "fields.pvd"));
  for (const io::PvdEntry& entry : times)
    sections.push_back(read_section(dir / entry.file, entry.time));
  if (sections.empty())
    return 0;
  const int maps = is_one_dimensional(sections) ? draw_profile_pictures(sections, title, folder, log)
                                                : draw_field_pictures(sections, title, folder, log, close);
  return maps + draw_back_face_pictures(dir, times, title, folder, log);
}

View read_view(const std::string& text) {
  std::vector<double> ends;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const Quantity q = parse_quantity(part, Dimension::length);
    if (!q.ok())
      throw Error(fmt::format("--view {}: {}", text, q.problem));
    ends.push_back(q.value);
  }
  if (ends.size() != 4 || !(ends[0] < ends[1]) || !(ends[2] < ends[3]))
    throw Error(fmt::format("--view {}: four lengths are wanted, each end above its start: \"-8 mm, 8 mm, 0 mm, 30 mm\"", text));
  return {{ends[0], ends[1]}, {ends[2], ends[3]}};
}

} // namespace

int report(const std::string& run_dir, std::ostream& log, const std::string& view) {
  const std::optional<View> close = view.empty() ? std::nullopt : std::optional(read_view(view));
  const fs::path dir = run_dir, folder = dir / "pictures";
  const bool fields = fs::exists(dir / "fields.pvd"), history = fs::exists(dir / "history.csv");
  if (!fields && !history)
    throw Error(fmt::format(
        "{}: holds neither fields.pvd nor history.csv. Name the output folder of a `ballast run`.",
        run_dir));
  fs::create_directories(folder);
  remove_old_pictures(folder);
  const std::string title = run_title(dir);
  int pictures = 0;
  if (fields)
    pictures += report_fields(dir, title, folder, log, close);
  if (history)
    pictures += draw_history_pictures(io::read_csv(dir / "history.csv"), title, folder, log);
  log << fmt::format("{} pictures in {}\n", pictures, folder.string());
  return pictures;
}

} // namespace ballast::post
