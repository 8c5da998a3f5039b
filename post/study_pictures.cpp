#include "post/study_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "core/error.hpp"
#include "post/axis.hpp"
#include "post/canvas.hpp"
#include "post/colour_map.hpp"

namespace ballast::post {
namespace {

constexpr std::size_t most_measures = 12;

struct Run {
  std::vector<std::string> values;
  std::string label; // the values in one
  double time = 0;   // of processors, all threads: what else the machine does matters least to it
  std::map<std::string, double> errors;
};

struct Study {
  std::string deck;
  std::vector<std::string> varied;
  std::vector<std::vector<std::string>> values; // by what was varied
  std::vector<Run> runs;                        // the finished ones
};

std::string unquoted(std::string text) {
  std::erase(text, '"');
  return text;
}

Study read_study(const std::filesystem::path& folder) {
  std::ifstream in(folder / "study.json");
  const auto j = nlohmann::json::parse(in, nullptr, false);
  if (j.is_discarded() || !j.contains("runs"))
    throw Error(fmt::format("{}: no study.json of a `ballast study` in it", folder.string()));
  Study s;
  s.deck = j.value("deck", "");
  for (const auto& v : j["varied"]) {
    s.varied.push_back(v.value("name", ""));
    s.values.push_back(v["values"].get<std::vector<std::string>>());
  }
  for (const auto& r : j["runs"]) {
    Run run{r["values"].get<std::vector<std::string>>(), "", r.value("cpu_seconds", 0.0) > 0 ? r.value("cpu_seconds", 0.0) : r.value("wall_seconds", 0.0), {}};
    if (r.value("ended", "") != "finished" || run.values.size() != s.varied.size())
      continue;
    for (const std::string& value : run.values)
      run.label += (run.label.empty() ? "" : ", ") + unquoted(value);
    for (const auto& [name, error] : r["errors"].items())
      if (error.is_number())
        run.errors[name] = error.get<double>();
    s.runs.push_back(std::move(run));
  }
  return s;
}

/// Results first, then histories' means; the largest errors of histories are in the table only.
std::vector<std::string> measures_of(const Study& study) {
  std::set<std::string> results, means;
  for (const Run& run : study.runs)
    for (const auto& [name, error] : run.errors)
      if (error > 0 && name.rfind("Linf ", 0) != 0)
        (name.rfind("L1 ", 0) == 0 ? means : results).insert(name);
  std::vector<std::string> all(results.begin(), results.end());
  all.insert(all.end(), means.begin(), means.end());
  all.resize(std::min(all.size(), most_measures));
  return all;
}

/// An axis of logarithms, ticks at 1, 2, 5 or at decades.
struct LogAxis {
  double low = 0, high = 1; // log10
  std::vector<std::pair<double, std::string>> ticks;
};

LogAxis log_axis(double least, double most) {
  const double air = std::max(0.08 * std::log10(most / least), 0.05);
  LogAxis axis{std::log10(least) - air, std::log10(most) + air, {}};
  const std::vector<double> decades = {1}, some = {1, 2, 5}, many = {1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9};
  const double width = axis.high - axis.low;
  for (double decade = std::floor(axis.low); decade <= axis.high; ++decade)
    for (const double digit : width > 2.5 ? decades : width > 0.9 ? some : many) {
      const double at = decade + std::log10(digit);
      if (at >= axis.low && at <= axis.high)
        axis.ticks.emplace_back(at, fmt::format("{:.3g}", std::pow(10, at)));
    }
  return axis;
}

struct LogPanel {
  Box box;
  LogAxis x, y;
  bool named_x = false; // x is 0, 1, 2, ...: names

  Point pixel(double px, double py) const {
    return {box.x + (px - x.low) / (x.high - x.low) * box.width, box.bottom() - (py - y.low) / (y.high - y.low) * box.height};
  }
  void draw(Canvas& canvas, const std::string& x_name, const std::string& y_name) const {
    for (const auto& [at, label] : x.ticks) {
      const Point p = pixel(at, y.low);
      canvas.line({p.x, box.y}, p, 1, light_grey);
      canvas.text({p.x, p.y + 10}, label, {.size = 20, .x = AlignX::centre, .y = AlignY::top});
    }
    for (const auto& [at, label] : y.ticks) {
      const Point p = pixel(x.low, at);
      canvas.line(p, {box.right(), p.y}, 1, light_grey);
      canvas.text({p.x - 10, p.y}, label, {.size = 20, .x = AlignX::right});
    }
    canvas.frame(box, 2, black);
    canvas.text({box.x + box.width / 2, box.bottom() + 44}, x_name, {.size = 24, .x = AlignX::centre, .y = AlignY::top});
    canvas.text({box.x - 96, box.y + box.height / 2}, y_name, {.size = 24, .x = AlignX::centre, .upright = true});
  }
};

void dot(Canvas& canvas, Point at, double radius, Colour colour) {
  std::vector<Point> circle;
  constexpr int corners = 24;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * M_PI * k / corners;
    circle.push_back({at.x + radius * std::cos(angle), at.y + radius * std::sin(angle)});
  }
  canvas.fill(circle, colour);
}

std::string file_of(const std::string& start, const std::string& name) {
  std::string out = start;
  for (const char c : name)
    out += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return out + ".png";
}

/// Error against processor time; a run that none beats in both is on the front.
void draw_front(const Study& study, const std::string& measure, const std::filesystem::path& path) {
  std::vector<const Run*> runs;
  for (const Run& run : study.runs)
    if (const auto at = run.errors.find(measure); at != run.errors.end() && at->second > 0 && run.time > 0)
      runs.push_back(&run);
  std::sort(runs.begin(), runs.end(), [](const Run* a, const Run* b) { return a->time < b->time; });
  const auto error = [&](const Run* r) { return r->errors.at(measure); };
  const auto [least, most] = std::minmax_element(runs.begin(), runs.end(), [&](auto* a, auto* b) { return error(a) < error(b); });
  const LogPanel panel{{170, 96, 900, 620}, log_axis(runs.front()->time, runs.back()->time), log_axis(error(*least), error(*most))};
  double widest = 120;
  for (const Run* run : runs)
    widest = std::max(widest, Canvas::text_width(run->label, {.size = 18}) + 40);
  Canvas canvas(static_cast<int>(panel.box.right() + widest), 830);
  panel.draw(canvas, "processor time, all threads [s]", "relative error");
  std::vector<Point> front;
  double best = std::numeric_limits<double>::infinity();
  for (const Run* run : runs)
    if (error(run) < best) {
      best = error(run);
      front.push_back(panel.pixel(std::log10(run->time), std::log10(best)));
    }
  canvas.polyline(front, 2.6, line_colour(0));
  best = std::numeric_limits<double>::infinity();
  for (const Run* run : runs) {
    const Point at = panel.pixel(std::log10(run->time), std::log10(error(run)));
    const bool on_front = error(run) < best;
    best = std::min(best, error(run));
    dot(canvas, at, 7, on_front ? line_colour(0) : grey);
    canvas.text({at.x + 14, at.y - 14}, run->label, {.size = 18, .colour = on_front ? black : grey});
  }
  canvas.text({panel.box.x, 44}, measure + ": error against time", {.size = 30});
  canvas.save_png(path);
}

/// Numbers in the order of their size if all values of what was varied begin with one, else names in the order given.
std::vector<double> places(const std::vector<std::string>& values, bool& numbers) {
  std::vector<double> out;
  numbers = true;
  for (const std::string& value : values) {
    const auto digit = value.find_first_of("0123456789.");
    char* end = nullptr;
    const double x = digit == std::string::npos ? 0 : std::strtod(value.c_str() + digit, &end);
    numbers = numbers && digit != std::string::npos && digit <= 2 && x > 0;
    out.push_back(x);
  }
  for (std::size_t k = 0; k < out.size() && !numbers; ++k)
    out[k] = static_cast<double>(k);
  return out;
}

/// Error and time against one of the varied keys, a line for each choice of the others.
void draw_varied(const Study& study, std::size_t key, const std::string& measure, const std::filesystem::path& path) {
  bool numbers = false;
  const std::vector<std::string>& values = study.values[key];
  const std::vector<double> at = places(values, numbers);
  std::map<std::string, std::vector<std::pair<double, const Run*>>> lines;
  double least[2] = {1e300, 1e300}, most[2] = {0, 0};
  for (const Run& run : study.runs) {
    std::string others;
    for (std::size_t v = 0; v < run.values.size(); ++v)
      others += v == key ? "" : (others.empty() ? "" : ", ") + unquoted(run.values[v]);
    const auto place = static_cast<std::size_t>(std::find(values.begin(), values.end(), run.values[key]) - values.begin());
    lines[others].emplace_back(numbers ? std::log10(at[place]) : at[place], &run);
    const auto found = run.errors.find(measure);
    const double both[2] = {found == run.errors.end() ? 0 : found->second, run.time};
    for (std::size_t q = 0; q < 2; ++q)
      if (both[q] > 0)
        least[q] = std::min(least[q], both[q]), most[q] = std::max(most[q], both[q]);
  }
  LogAxis x;
  if (numbers) {
    const auto [a, b] = std::minmax_element(at.begin(), at.end());
    x = log_axis(*a, *b);
    x.ticks.clear();
    for (std::size_t k = 0; k < values.size(); ++k)
      x.ticks.emplace_back(std::log10(at[k]), values[k]);
  } else {
    x = {-0.3, static_cast<double>(values.size()) - 0.7, {}};
    for (std::size_t k = 0; k < values.size(); ++k)
      x.ticks.emplace_back(static_cast<double>(k), unquoted(values[k]));
  }
  double widest = 60;
  for (const auto& [name, runs] : lines)
    widest = std::max(widest, Canvas::text_width(name, {.size = 20}) + 100);
  Canvas canvas(static_cast<int>(1720 + widest), 830);
  const std::string names[2] = {"relative error", "processor time, all threads [s]"};
  for (std::size_t q = 0; q < 2; ++q) {
    if (!(most[q] > 0))
      continue;
    const LogPanel panel{{170 + 790 * static_cast<double>(q), 96, 620, 600}, x, log_axis(least[q], most[q]), !numbers};
    panel.draw(canvas, study.varied[key], names[q]);
    std::size_t k = 0;
    for (auto& [name, runs] : lines) {
      std::sort(runs.begin(), runs.end());
      std::vector<Point> points;
      for (const auto& [place, run] : runs) {
        const auto found = run->errors.find(measure);
        const double y = q == 1 ? run->time : found == run->errors.end() ? 0 : found->second;
        if (y > 0) {
          points.push_back(panel.pixel(place, std::log10(y)));
          dot(canvas, points.back(), 6, line_colour(k));
        }
      }
      canvas.polyline(points, 2.6, line_colour(k));
      if (q == 1 && !name.empty()) {
        const double y = panel.box.y + 16 + 32 * static_cast<double>(k), left = panel.box.right() + 20;
        canvas.line({left, y}, {left + 34, y}, 4, line_colour(k));
        canvas.text({left + 46, y}, name, {.size = 20});
      }
      ++k;
    }
  }
  canvas.text({170, 44}, fmt::format("{}: error and time against {}", measure, study.varied[key]), {.size = 30});
  canvas.save_png(path);
}

/// An earlier study of the folder may have had other measures; only names that a study gives are removed.
void remove_old_pictures(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".png" && (name.starts_with("front_") || name.starts_with("by_")))
      old.push_back(entry.path());
  }
  for (const auto& path : old)
    std::filesystem::remove(path);
}

} // namespace

bool is_study(const std::filesystem::path& folder) {
  std::ifstream in(folder / "study.json");
  const auto j = nlohmann::json::parse(in, nullptr, false);
  return !j.is_discarded() && j.contains("runs");
}

int draw_study(const std::filesystem::path& folder, std::ostream& log) {
  const Study study = read_study(folder);
  const std::filesystem::path pictures = folder / "pictures";
  std::filesystem::create_directories(pictures);
  remove_old_pictures(pictures);
  int drawn = 0;
  const auto done = [&](const std::filesystem::path& path) {
    log << path.string() << '\n';
    ++drawn;
  };
  for (const std::string& measure : measures_of(study)) {
    const std::filesystem::path front = pictures / file_of("front_", measure);
    draw_front(study, measure, front);
    done(front);
    for (std::size_t key = 0; key < study.varied.size(); ++key)
      if (study.values[key].size() > 1) {
        const std::filesystem::path path = pictures / file_of("by_" + study.varied[key] + "_", measure);
        draw_varied(study, key, measure, path);
        done(path);
      }
  }
  log << fmt::format("{} pictures in {}\n", drawn, pictures.string());
  return drawn;
}

} // namespace ballast::post
