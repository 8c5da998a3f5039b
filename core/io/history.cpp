#include "core/io/history.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fmt/core.h>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/io/summary.hpp"

namespace ballast::io {
namespace {

std::string header_line(const std::vector<std::string>& columns) {
  std::string line = "t";
  for (const std::string& column : columns) {
    if (column.find_first_of(",\"\n\r") != std::string::npos)
      throw Error(
          fmt::format("history column '{}': a name may hold no comma, quote or line end", column));
    line += ',' + column;
  }
  return line + '\n';
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(',', begin);
    parts.push_back(line.substr(begin, end - begin));
    if (end == std::string_view::npos)
      return parts;
    begin = end + 1;
  }
}

bool to_double(std::string_view text, double& value) {
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  return code == std::errc() && end == text.data() + text.size();
}

std::string read_all(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw Error(fmt::format("{}: cannot be read ({}). Is this a run directory of `ballast run`?",
                            path.string(),
                            std::strerror(errno)));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The header and the whole rows with t <= `time`.
std::string rows_until(const std::string& text, std::size_t fields, double time) {
  std::size_t begin = text.find('\n') + 1;
  std::string kept = text.substr(0, begin);
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string_view row(text.data() + begin, end - begin);
    const auto parts = split(row);
    double t = 0;
    if (parts.size() == fields && to_double(parts[0], t) && t <= time)
      kept.append(row).push_back('\n');
  }
  return kept;
}

} // namespace

HistoryWriter::HistoryWriter(const std::filesystem::path& path,
                             std::size_t columns,
                             const std::string& text)
    : path_(path), columns_(columns) {
  write_text_atomically(path, text);
  file_.reset(std::fopen(path.c_str(), "ab"));
  if (!file_)
    throw Error(fmt::format("{}: cannot be opened ({})", path.string(), std::strerror(errno)));
}

HistoryWriter::HistoryWriter(const std::filesystem::path& path,
                             const std::vector<std::string>& columns)
    : HistoryWriter(path, columns.size(), header_line(columns)) {}

HistoryWriter HistoryWriter::reopen(const std::filesystem::path& path,
                                    const std::vector<std::string>& columns,
                                    double time) {
  if (!std::filesystem::exists(path))
    return {path, columns};
  const std::string header = header_line(columns), text = read_all(path);
  if (text.compare(0, header.size(), header) != 0)
    throw Error(
        fmt::format("{}: its columns are not those of this run:\n  found    {}\n  expected {}"
                    "Restart with the deck that wrote it, or choose another --out.",
                    path.string(),
                    text.substr(0, text.find('\n')),
                    header));
  return {path, columns.size(), rows_until(text, columns.size() + 1, time)};
}

void HistoryWriter::add(double t, std::span<const double> values) {
  if (values.size() != columns_)
    throw Error(fmt::format(
        "{}: a row has {} values, the header {}", path_.string(), values.size(), columns_));
  std::string row = fmt::format("{:.17g}", t);
  for (double value : values)
    row += fmt::format(",{:.17g}", value);
  row += '\n';
  if (std::fwrite(row.data(), 1, row.size(), file_.get()) != row.size() ||
      std::fflush(file_.get()) != 0)
    throw Error(fmt::format(
        "{}: cannot be written ({}). Free space.", path_.string(), std::strerror(errno)));
}

ColumnName split_column_name(std::string_view header) {
  const std::size_t open = header.rfind(" [");
  if (header == "t")
    return {"t", "s"};
  if (open == std::string_view::npos || header.back() != ']')
    return {std::string(header), ""};
  return {std::string(header.substr(0, open)),
          std::string(header.substr(open + 2, header.size() - open - 3))};
}

const std::vector<double>* Table::find(std::string_view name) const {
  for (std::size_t c = 0; c < names.size(); ++c)
    if (names[c] == name || split_column_name(names[c]).name == name)
      return &columns[c];
  return nullptr;
}

Table read_csv(const std::filesystem::path& path) {
  const std::string text = read_all(path);
  Table table;
  std::size_t begin = 0, line = 1;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos;
       begin = end + 1, ++line) {
    const auto parts = split(std::string_view(text.data() + begin, end - begin));
    if (line == 1) {
      table.names.assign(parts.begin(), parts.end());
      table.columns.resize(parts.size());
      continue;
    }
    if (parts.size() != table.names.size())
      throw Error(fmt::format("{}:{}: {} values in a table of {} columns",
                              path.string(),
                              line,
                              parts.size(),
                              table.names.size()));
    for (std::size_t c = 0; c < parts.size(); ++c) {
      double value = 0;
      if (!to_double(parts[c], value))
        throw Error(fmt::format("{}:{}: '{}' is not a number", path.string(), line, parts[c]));
      table.columns[c].push_back(value);
    }
  }
  if (table.names.empty())
    throw Error(fmt::format("{}: is empty; a history starts with a header line", path.string()));
  return table;
}

} // namespace ballast::io
