// What a run of a study left behind, and how far it is from another.
#include "problems/study.hpp"

#include "core/io/history.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

namespace ballast {

namespace {

namespace fs = std::filesystem;

void flatten(const nlohmann::json& node, const std::string& path, std::map<std::string, double>& out) {
  if (node.is_object()) {
    for (const auto& [key, value] : node.items()) {
      flatten(value, path.empty() ? key : path + "." + key, out);
    }
  } else if (node.is_number()) {
    out[path] = node.get<double>();
  }
}

/// Linear between samples; `at` within the range of `x`.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin() || above == x.end()) {
    return above == x.end() ? y.back() : y.front();
  }
  const auto i = static_cast<std::size_t>(above - x.begin());
  const double part = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + part * (y[i] - y[i - 1]);
}

/// Largest size by unit, of what has one: what is nothing beside others of its kind has no relative error.
using Largest = std::map<std::string, double>;
constexpr double nothing = 1e-9;

void note(Largest& largest, const std::string& unit, double value) {
  double& most = largest[unit];
  most = std::max(most, std::abs(value));
}

/// "bullet.velocity_m_per_s" -> "m_per_s": what follows the last word; results of one unit end alike.
std::string unit_of_result(const std::string& name) {
  const std::size_t per = name.rfind("_per_"), at = name.rfind('_', per == std::string::npos ? std::string::npos : per - 1);
  return at == std::string::npos ? name : name.substr(at + 1);
}

/// Results of the scene; neither the round-off of conservation nor a run's own error is an answer to measure another by.
bool answers(const std::string& result) {
  return result.rfind("conservation.", 0) != 0 && result.rfind("exact.", 0) != 0;
}

/// Columns that say how the scene went, not how the run did.
bool of_the_scene(const std::string& column) {
  return column != "t" && column.rfind("dt", 0) != 0 && column.rfind("energy_", 0) != 0 && column.rfind("momentum", 0) != 0;
}

} // namespace

StudyRow read_study_row(const fs::path& folder) {
  StudyRow row;
  std::ifstream in(folder / "summary.json"), cost(folder / "study.json");
  const auto j = nlohmann::json::parse(in, nullptr, false), c = nlohmann::json::parse(cost, nullptr, false);
  if (j.is_discarded()) {
    return row;
  }
  row.ended = j.value("ended", "");
  row.message = j.value("message", "");
  row.wall = j.value("wall_seconds", 0.0);
  row.cells = j.value("cells", 0.0);
  row.steps = j.value("steps", 0.0);
  row.rate = j.value("cell_steps_per_second", 0.0);
  if (!c.is_discarded()) {
    row.cpu = c.value("cpu_seconds", 0.0);
    row.peak_memory = c.value("peak_memory_bytes", 0.0);
  }
  flatten(j.value("results", nlohmann::json::object()), "", row.results);
  flatten(j.value("conservation_errors", nlohmann::json::object()), "conservation", row.results);
  return row;
}

void measure_errors(StudyRow& row, const fs::path& folder, const StudyRow& reference, const fs::path& reference_folder) {
  if (row.ended != "finished") {
    return;
  }
  Largest of_results, of_columns;
  for (const auto& [name, value] : reference.results) {
    note(of_results, unit_of_result(name), value);
  }
  for (const auto& [name, value] : row.results) {
    const auto exact = reference.results.find(name);
    if (exact != reference.results.end() && std::abs(exact->second) > nothing * of_results[unit_of_result(name)] && answers(name)) {
      row.errors[name] = std::abs(value - exact->second) / std::abs(exact->second);
    }
  }
  const io::Table mine = io::read_csv(folder / "history.csv"), theirs = io::read_csv(reference_folder / "history.csv");
  const std::vector<double>&t = mine.columns[0], &t_ref = theirs.columns[0];
  for (std::size_t c = 1; c < theirs.names.size(); ++c) {
    for (const double x : theirs.columns[c]) {
      note(of_columns, io::split_column_name(theirs.names[c]).unit, std::isfinite(x) ? x : 0);
    }
  }
  for (std::size_t c = 1; c < mine.names.size(); ++c) {
    const std::string name = io::split_column_name(mine.names[c]).name;
    const std::vector<double>* exact = theirs.find(mine.names[c]);
    if (!of_the_scene(name) || exact == nullptr || t_ref.size() < 2) {
      continue;
    }
    double sum = 0, most = 0, scale = 0, weight = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (t[i] < t_ref.front() || t[i] > t_ref.back() * (1 + 1e-12)) {
        continue;
      }
      const double want = interpolate(t_ref, *exact, t[i]), off = std::abs(mine.columns[c][i] - want);
      const double span = 0.5 * (t[std::min(i + 1, t.size() - 1)] - t[i > 0 ? i - 1 : 0]);
      if (std::isfinite(off)) {
        sum += span * off;
        weight += span;
        most = std::max(most, off);
        scale = std::max(scale, std::abs(want));
      }
    }
    if (weight > 0 && scale > nothing * of_columns[io::split_column_name(mine.names[c]).unit]) {
      row.errors["L1 " + name] = sum / weight / scale;
      row.errors["Linf " + name] = most / scale;
    }
  }
}

void take_exact_errors(StudyRow& row) {
  for (const char* kind : {"L1", "Linf"}) {
    for (const char* what : {"density", "velocity", "pressure"}) {
      const auto at = row.results.find(fmt::format("exact.{}_{}", kind, what));
      if (at != row.results.end()) {
        row.errors[fmt::format("{} {}", kind, what)] = at->second;
      }
    }
  }
}

} // namespace ballast
