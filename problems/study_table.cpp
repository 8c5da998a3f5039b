// The tables of a study: CSV for programs, Markdown for people, JSON for pictures.
#include "problems/study.hpp"

#include "core/io/summary.hpp"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <set>

namespace ballast {

namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string out(1, '"');
  for (const char c : text) {
    out.append(c == '"' ? 2 : 1, c == '\n' ? ' ' : c);
  }
  out.push_back('"');
  return out;
}

/// Names that any row has, in order.
std::vector<std::string> names_of(const std::vector<StudyRow>& rows, std::map<std::string, double> StudyRow::*values) {
  std::set<std::string> names;
  for (const StudyRow& row : rows) {
    for (const auto& [name, value] : row.*values) {
      names.insert(name);
    }
  }
  return {names.begin(), names.end()};
}

std::string number(const std::map<std::string, double>& values, const std::string& name) {
  const auto at = values.find(name);
  return at == values.end() ? std::string() : fmt::format("{:.9g}", at->second);
}

std::string csv(const std::vector<Variation>& variations, const std::vector<StudyRow>& rows) {
  const auto results = names_of(rows, &StudyRow::results), errors = names_of(rows, &StudyRow::errors);
  std::string out = "run";
  for (const Variation& v : variations) {
    out.append(1, ',').append(quoted(v.name));
  }
  out += ",ended,wall_seconds,cpu_seconds,cells,steps,cell_steps_per_second,peak_memory_bytes";
  for (const std::string& name : results) {
    out.append(1, ',').append(quoted(name));
  }
  for (const std::string& name : errors) {
    out.append(1, ',').append(quoted(fmt::format("error {}", name)));
  }
  out += "\n";
  for (const StudyRow& row : rows) {
    out += quoted(row.name);
    for (std::size_t v = 0; v < variations.size(); ++v) {
      out.append(1, ',').append(v < row.values.size() ? quoted(row.values[v]) : std::string());
    }
    out += fmt::format(",{},{:.6g},{:.6g},{:.10g},{:.10g},{:.6g},{:.10g}", row.ended.empty() ? "not run" : row.ended, row.wall, row.cpu, row.cells,
                       row.steps, row.rate, row.peak_memory);
    for (const std::string& name : results) {
      out.append(1, ',').append(number(row.results, name));
    }
    for (const std::string& name : errors) {
      out.append(1, ',').append(number(row.errors, name));
    }
    out += "\n";
  }
  return out;
}

/// A | would end a cell of the table.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') {
      out.push_back('\\');
    }
    out.push_back(c);
  }
  return out;
}

std::string markdown(const StudyOptions& options, const std::vector<Variation>& variations, const std::vector<StudyRow>& rows, const std::string& reference) {
  auto results = names_of(rows, &StudyRow::results);
  if (options.reference == "exact") { // then they are the errors
    std::erase_if(results, [](const std::string& name) { return name.rfind("exact.", 0) == 0; });
  }
  const auto errors = names_of(rows, &StudyRow::errors);
  std::string out = fmt::format("# Study of {}\n\nReference: {}. Errors: relative; L1 and Linf {}.\n\n", options.deck,
                                reference.empty() ? "none that finished" : reference,
                                options.reference == "exact" ? "over the last state, by its mean and its largest value" : "over the history, by the largest value");
  std::string head = "|", rule = "|";
  const auto column = [&](const std::string& name) {
    head += fmt::format(" {} |", cell(name));
    rule += "---|";
  };
  for (const Variation& v : variations) {
    column(v.name);
  }
  for (const char* name : {"ended", "wall s", "cpu s", "cells", "steps", "Mcell-steps/s", "memory MB"}) {
    column(name);
  }
  for (const std::string& name : results) {
    column(name);
  }
  for (const std::string& name : errors) {
    if (name.rfind("Linf ", 0) != 0) {
      column(fmt::format("error {}", name));
    }
  }
  out += head + "\n" + rule + "\n";
  for (const StudyRow& row : rows) {
    out += "|";
    for (std::size_t v = 0; v < variations.size(); ++v) {
      out += fmt::format(" {} |", v < row.values.size() ? cell(row.values[v]) : std::string("reference"));
    }
    out += fmt::format(" {} | {:.3g} | {:.3g} | {:.0f} | {:.0f} | {:.3g} | {:.3g} |", row.ended.empty() ? "not run" : row.ended, row.wall, row.cpu,
                       row.cells, row.steps, 1e-6 * row.rate, 1e-6 * row.peak_memory);
    for (const std::string& name : results) {
      const auto at = row.results.find(name);
      out += at == row.results.end() ? " |" : fmt::format(" {:.5g} |", at->second);
    }
    for (const std::string& name : errors) {
      if (name.rfind("Linf ", 0) != 0) {
        const auto at = row.errors.find(name);
        out += at == row.errors.end() ? " |" : fmt::format(" {:.3g} |", at->second);
      }
    }
    out += "\n";
  }
  for (const StudyRow& row : rows) {
    if (!row.message.empty()) {
      out += fmt::format("\n{}: {}\n", row.name, row.message);
    }
  }
  return out;
}

std::string json(const StudyOptions& options, const std::vector<Variation>& variations, const std::vector<StudyRow>& rows, const std::string& reference) {
  nlohmann::ordered_json j;
  j["deck"] = options.deck;
  j["reference"] = reference;
  for (const Variation& v : variations) {
    j["varied"].push_back({{"name", v.name}, {"values", v.values}});
  }
  for (const StudyRow& row : rows) {
    j["runs"].push_back({{"name", row.name}, {"values", row.values}, {"ended", row.ended}, {"wall_seconds", row.wall}, {"cpu_seconds", row.cpu},
                         {"cells", row.cells}, {"steps", row.steps}, {"results", row.results}, {"errors", row.errors}});
  }
  return j.dump(1) + "\n";
}

} // namespace

void write_study(const std::filesystem::path& folder, const StudyOptions& options, const std::vector<Variation>& variations,
                 const std::vector<StudyRow>& rows, const std::string& reference) {
  io::write_text_atomically(folder / "study.csv", csv(variations, rows));
  io::write_text_atomically(folder / "study.md", markdown(options, variations, rows, reference));
  io::write_text_atomically(folder / "study.json", json(options, variations, rows, reference));
}

} // namespace ballast
